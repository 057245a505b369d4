//! The scalar types, f32 and f64, and the glam vectors that belong to each.
//!
//! Every formula of the crate has one generic body over [`Real`]. This is also the one file where
//! the square root and the constructor-time functions are taken from `std` or from the `libm`
//! crate.

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::elementary::bits::Bits;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("microsurface needs one of the features `std` (the default) or `libm`");

/// A scalar: f32 or f64. Sealed.
///
/// Vectors are converted to arrays where components are needed (`let [x, y, z]: [T; 3] =
/// w.into();`), which costs nothing once compiled.
pub trait Real:
    Bits
    + Spectrum<Scalar = Self>
    + Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// glam's two-component vector of this scalar.
    type Vec2: Vector<2, Scalar = Self>
        + Debug
        + PartialEq
        + Send
        + Sync
        + 'static
        + From<[Self; 2]>
        + Into<[Self; 2]>;
    /// glam's three-component vector of this scalar.
    type Vec3: Vector<3, Scalar = Self>
        + Debug
        + PartialEq
        + Send
        + Sync
        + 'static
        + From<[Self; 3]>
        + Into<[Self; 3]>;
    /// glam's 2×2 matrix of this scalar, stored by columns.
    type Mat2: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// The scalar in which ill-conditioned arguments are formed: f64 for both.
    type Wide: Real<Wide = Self::Wide>;

    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// 2.
    const TWO: Self;
    /// π.
    const PI: Self;
    /// 1/π.
    const FRAC_1_PI: Self;
    /// √π.
    const SQRT_PI: Self;
    /// 1/√π.
    const FRAC_1_SQRT_PI: Self;
    /// The distance from 1 to the next larger number: 2⁻²³ or 2⁻⁵².
    const EPSILON: Self;
    /// The smallest positive normal number.
    const MIN_POSITIVE: Self;
    /// The largest finite number.
    const MAX: Self;
    /// +∞.
    const INFINITY: Self;

    /// The number nearest to `x`; for literals, folded by the compiler.
    #[must_use]
    fn lit(x: f64) -> Self;
    /// This number as f64, exactly.
    #[must_use]
    fn to_f64(self) -> f64;
    /// This number in the wide scalar, exactly.
    #[must_use]
    fn widen(self) -> Self::Wide;
    /// The number nearest to a wide one.
    #[must_use]
    fn narrow(x: Self::Wide) -> Self;
    /// √x, correctly rounded; NaN below 0.
    #[must_use]
    fn sqrt(self) -> Self;
    /// |x|.
    #[must_use]
    fn abs(self) -> Self;
    /// |x| with the sign of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// The larger of both; the other where one is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of both; the other where one is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// Neither infinite nor NaN.
    #[must_use]
    fn is_finite(self) -> bool;
    /// The columns of a matrix: `[[m00, m10], [m01, m11]]`.
    #[must_use]
    fn columns(matrix: Self::Mat2) -> [[Self; 2]; 2];
    /// The matrix of these columns.
    #[must_use]
    fn matrix(columns: [[Self; 2]; 2]) -> Self::Mat2;
}

/// A vector of `N` components that says of which scalar it is, so that calls need not name it: a
/// glam vector, or an array. Sealed.
pub trait Vector<const N: usize>: Copy + sealed::Sealed {
    /// f32 or f64.
    type Scalar: Real;
    /// The components.
    #[must_use]
    fn components(self) -> [Self::Scalar; N];
}

mod sealed {
    pub trait Sealed {}
}

impl<T: Real, const N: usize> sealed::Sealed for [T; N] {}

impl<T: Real, const N: usize> Vector<N> for [T; N] {
    type Scalar = T;
    #[inline(always)]
    fn components(self) -> Self {
        self
    }
}

macro_rules! vector {
    ($t:ident, $($vec:ident $n:literal),*) => {
        $(impl sealed::Sealed for glam::$vec {}

        impl Vector<$n> for glam::$vec {
            type Scalar = $t;
            #[inline(always)]
            fn components(self) -> [$t; $n] {
                self.into()
            }
        })*
    };
}
vector!(f32, Vec2 2, Vec3 3, Vec4 4);
vector!(f64, DVec2 2, DVec3 3, DVec4 4);

/// The number of `B` nearest to `x`: nothing, once compiled, where `A` is `B`.
#[inline(always)]
pub(crate) fn converted<A: Real, B: Real>(x: A) -> B {
    B::lit(x.to_f64())
}

/// `a` if `condition`, else `b`; both are at hand.
#[inline(always)]
pub(crate) fn select<W>(condition: bool, a: W, b: W) -> W {
    if condition { a } else { b }
}

macro_rules! real {
    ($t:ident, $vec2:ident, $vec3:ident, $mat2:ident, $sqrt_libm:ident) => {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_lossless,
            reason = "one body for both scalars: rounding to f32 is what is meant, and f64 → f64 is free"
        )]
        impl Real for $t {
            type Vec2 = glam::$vec2;
            type Vec3 = glam::$vec3;
            type Mat2 = glam::$mat2;
            type Wide = f64;

            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const PI: Self = core::$t::consts::PI;
            const FRAC_1_PI: Self = core::$t::consts::FRAC_1_PI;
            const SQRT_PI: Self = 1.7724538509055160273;
            const FRAC_1_SQRT_PI: Self = core::$t::consts::FRAC_2_SQRT_PI / 2.0;
            const EPSILON: Self = $t::EPSILON;
            const MIN_POSITIVE: Self = $t::MIN_POSITIVE;
            const MAX: Self = $t::MAX;
            const INFINITY: Self = $t::INFINITY;

            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn widen(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn narrow(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(not(feature = "std"))]
                return libm::$sqrt_libm(self);
                #[cfg(feature = "std")]
                return $t::sqrt(self);
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $t::copysign(self, sign)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $t::max(self, other)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $t::min(self, other)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $t::is_finite(self)
            }
            #[inline(always)]
            fn columns(matrix: Self::Mat2) -> [[Self; 2]; 2] {
                matrix.to_cols_array_2d()
            }
            #[inline(always)]
            fn matrix(columns: [[Self; 2]; 2]) -> Self::Mat2 {
                Self::Mat2::from_cols_array_2d(&columns)
            }
        }
    };
}
real!(f32, Vec2, Vec3, Mat2, sqrtf);
real!(f64, DVec2, DVec3, DMat2, sqrt);

/// A reflectance: one number, or three.
pub trait Spectrum: Copy + Send + Sync + 'static {
    /// f32 or f64.
    type Scalar: Real;

    /// The spectrum with this value in every channel.
    #[must_use]
    fn splat(value: Self::Scalar) -> Self;

    /// `f` of every channel.
    #[must_use]
    fn map(self, f: impl FnMut(Self::Scalar) -> Self::Scalar) -> Self;

    /// `f` of every channel of two.
    #[must_use]
    fn zip(self, other: Self, f: impl FnMut(Self::Scalar, Self::Scalar) -> Self::Scalar) -> Self;

    /// Every channel times a number.
    #[inline(always)]
    #[must_use]
    fn scaled(self, factor: Self::Scalar) -> Self {
        self.map(|channel| channel * factor)
    }
}

macro_rules! spectrum {
    ($scalar:ident, $vec3:ident) => {
        impl Spectrum for $scalar {
            type Scalar = $scalar;
            #[inline(always)]
            fn splat(value: $scalar) -> Self {
                value
            }
            #[inline(always)]
            fn map(self, mut f: impl FnMut($scalar) -> $scalar) -> Self {
                f(self)
            }
            #[inline(always)]
            fn zip(self, other: Self, mut f: impl FnMut($scalar, $scalar) -> $scalar) -> Self {
                f(self, other)
            }
        }

        impl<const N: usize> Spectrum for [$scalar; N] {
            type Scalar = $scalar;
            #[inline(always)]
            fn splat(value: $scalar) -> Self {
                [value; N]
            }
            #[inline(always)]
            fn map(self, f: impl FnMut($scalar) -> $scalar) -> Self {
                self.map(f)
            }
            #[inline(always)]
            fn zip(self, other: Self, mut f: impl FnMut($scalar, $scalar) -> $scalar) -> Self {
                core::array::from_fn(|i| f(self[i], other[i]))
            }
        }

        impl Spectrum for glam::$vec3 {
            type Scalar = $scalar;
            #[inline(always)]
            fn splat(value: $scalar) -> Self {
                Self::splat(value)
            }
            #[inline(always)]
            fn map(self, f: impl FnMut($scalar) -> $scalar) -> Self {
                self.to_array().map(f).into()
            }
            #[inline(always)]
            fn zip(self, other: Self, mut f: impl FnMut($scalar, $scalar) -> $scalar) -> Self {
                Self::new(f(self.x, other.x), f(self.y, other.y), f(self.z, other.z))
            }
        }
    };
}
spectrum!(f32, Vec3);
spectrum!(f64, DVec3);

/// Functions of f64 that only constructors call: what a material fixes once.
pub(crate) mod construction {
    macro_rules! from_std_or_libm {
        ($($(#[$doc:meta])* $name:ident, $std:ident, $libm:ident;)*) => {
            $($(#[$doc])*
            pub(crate) fn $name(x: f64) -> f64 {
                #[cfg(feature = "libm")]
                return libm::$libm(x);
                #[cfg(not(feature = "libm"))]
                return f64::$std(x);
            })*
        };
    }
    from_std_or_libm! {
        /// Natural logarithm.
        ln, ln, log;
        /// Exponential.
        exp, exp, exp;
        /// eˣ − 1 without cancellation.
        exp_m1, exp_m1, expm1;
        /// Sine.
        sin, sin, sin;
        /// Cosine.
        cos, cos, cos;
    }
    /// The angle of (x, y) from the x axis, in (−π, π].
    pub(crate) fn atan2(y: f64, x: f64) -> f64 {
        #[cfg(feature = "libm")]
        return libm::atan2(y, x);
        #[cfg(not(feature = "libm"))]
        return f64::atan2(y, x);
    }
}
