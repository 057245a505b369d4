//! Fresnel reflectances: Schlick's approximation and the exact dielectric and conductor, scalar or RGB.
//!
//! Each takes its parameters as a [`Spectrum`], a scalar or a glam vector of three, and returns the same; a
//! material pays for three channels only where it has three.

use crate::Real;
use crate::error::Error;

/// A reflectance: one number, or three.
pub trait Spectrum: Copy + core::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// f32 or f64.
    type Scalar: Real;

    /// The same value in every channel.
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

/// The wide scalar of a spectrum.
type Wide<S> = <<S as Spectrum>::Scalar as Real>::Wide;

/// A Fresnel reflectance as a function of the angle between a direction and a facet's normal.
pub trait Fresnel {
    /// The reflectance: f32, f64, or a glam vector of three.
    type Output: Spectrum;

    /// The share of unpolarised light that a facet reflects.
    ///
    /// # Domain
    /// `cos`, the cosine between the direction and the facet's normal, 0 … 1. Values above 1 by rounding are
    /// harmless.
    ///
    /// # Returns
    /// 0 … 1 in every channel.
    fn reflectance(&self, cos: Scalar<Self>) -> Self::Output;
}

/// The scalar of a Fresnel term's output.
pub type Scalar<F> = <<F as Fresnel>::Output as Spectrum>::Scalar;

/// A facet that reflects everything: for furnace tests and mirrors without colour.
///
/// The output cannot be inferred from an argument: `Perfect::<f32>::new()`, `Perfect::<Vec3>::new()`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Perfect<S>(core::marker::PhantomData<S>);

impl<S> Perfect<S> {
    /// Reflectance 1.
    #[inline]
    #[must_use]
    pub const fn new() -> Self {
        Self(core::marker::PhantomData)
    }
}

impl<S: Spectrum> Fresnel for Perfect<S> {
    type Output = S;
    #[inline(always)]
    fn reflectance(&self, _: S::Scalar) -> S {
        S::splat(S::Scalar::ONE)
    }
}

/// Schlick's approximation F0 + (1 − F0)(1 − cos)⁵.
///
/// # References
/// Schlick 1994, "An inexpensive BRDF model for physically-based rendering", Eq. 15.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Schlick<S> {
    f0: S,
}

impl<S: Spectrum> Schlick<S> {
    /// The approximation with reflectance `f0` at normal incidence, 0 … 1.
    #[inline]
    #[must_use]
    pub const fn new(f0: S) -> Self {
        Self { f0 }
    }
}

impl<S: Spectrum> Fresnel for Schlick<S> {
    type Output = S;
    #[inline(always)]
    fn reflectance(&self, cos: S::Scalar) -> S {
        let one = S::Scalar::ONE;
        let m = if cos > one { S::Scalar::ZERO } else { one - cos };
        let m2 = m * m;
        let weight = m2 * m2 * m;
        // As F0 (1 − w) + w: within [F0, 1] to rounding.
        self.f0.map(|f0| f0 * (one - weight) + weight)
    }
}

/// The exact reflectance of a dielectric, for light coming from the side of index 1 to that of index η.
///
/// With g² = η² − 1 + cos², r_s = (1 − η²)/(cos + g)² and r_p = (η² − 1)((η² + 1)cos² − 1)/(η² cos + g)²,
/// F = ½(r_s² + r_p²); 1 where g² < 0, total internal reflection. These forms keep all digits when η is near 1,
/// where (cos − g)/(cos + g) loses them; at η = 1 exactly F = 0.
///
/// # Accuracy
/// Absolute: 5 ε (f32), 3 ε (f64), worst just above the critical angle, of arguments taken as exact (budget row
/// `fresnel_dielectric`). There F has an infinite slope: in f64, rounding the cosine itself moves it by √ε.
///
/// # Special cases
/// η = 1 → 0 at every angle.
///
/// # Example
/// ```
/// use microsurface::fresnel::{Dielectric, Fresnel};
/// let glass = Dielectric::new(1.5_f64)?;
/// assert!((glass.reflectance(1.0) - 0.04).abs() < 1e-15);
/// assert_eq!(Dielectric::new(1.0 / 1.5)?.reflectance(0.7), 1.0);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Born and Wolf, "Principles of Optics", §1.5; the form in g of Walter 2007, Eq. 22.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::Dielectric<S>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "S: serde::Serialize", deserialize = "S: Spectrum + serde::Deserialize<'de>"))
)]
pub struct Dielectric<S> {
    eta: S,
}

impl<S: Spectrum> Dielectric<S> {
    /// A dielectric of relative index η = n_inside/n_outside, seen from outside. For the way out take 1/η.
    ///
    /// # Errors
    /// [`Error::RefractiveIndex`] unless every channel is positive and finite.
    pub fn new(eta: S) -> Result<Self, Error> {
        check(eta, |eta| eta > S::Scalar::ZERO, |value| Error::RefractiveIndex { value })?;
        Ok(Self { eta })
    }
}

/// The first channel that is not finite or not `valid`, as an error.
fn check<S: Spectrum>(
    values: S,
    valid: impl Fn(S::Scalar) -> bool,
    error: impl Fn(f64) -> Error,
) -> Result<(), Error> {
    let mut result = Ok(());
    let _ = values.map(|value| {
        if result.is_ok() && !(valid(value) && value.is_finite()) {
            result = Err(error(value.to_f64()));
        }
        value
    });
    result
}

/// min(f, 1); NaN stays NaN.
#[inline(always)]
fn at_most_one<T: Real>(f: T) -> T {
    if f > T::ONE { T::ONE } else { f }
}

impl<S: Spectrum> Fresnel for Dielectric<S> {
    type Output = S;
    #[inline(always)]
    fn reflectance(&self, cos: S::Scalar) -> S {
        let (zero, one) = (S::Scalar::ZERO, S::Scalar::ONE);
        self.eta.map(|eta| {
            let contrast = (eta - one) * (eta + one);
            let eta2 = eta * eta;
            // Near the critical angle g² cancels and its root is the error of F: formed in the wide scalar.
            let (eta_wide, cos_wide) = (eta.widen(), cos.widen());
            let g2 = S::Scalar::narrow((eta_wide * eta_wide - Wide::<S>::ONE) + cos_wide * cos_wide);
            let g = (if g2 < zero { zero } else { g2 }).sqrt();
            let (sum_s, sum_p) = (cos + g, eta2 * cos + g);
            let r_s = contrast / (sum_s * sum_s);
            let r_p = contrast * ((eta2 + one) * (cos * cos) - one) / (sum_p * sum_p);
            let f = S::Scalar::HALF * (r_s * r_s + r_p * r_p);
            // At cos = 0 and η = 1 both sums vanish; the limit is that of a surface that is not there.
            let transparent = contrast * contrast <= zero;
            if g2 < zero {
                one
            } else if transparent {
                zero
            } else {
                at_most_one(f)
            }
        })
    }
}

/// The exact reflectance of a conductor of complex index n + ik, seen from air or vacuum.
///
/// With a² + b² = |ε − sin²|, a the real part of √(ε − sin²), ε = (n + ik)²:
/// R_s = ((a − cos)² + b²)/((a + cos)² + b²) and R_p = R_s ((a cos − sin²)² + b² cos²)/((a cos + sin²)² + b² cos²).
///
/// # Accuracy
/// Absolute: 2.4 ε, worst for weak absorbers at grazing angles (budget row `fresnel_conductor`). At k = 0 it is a
/// [`Dielectric`].
///
/// # Example
/// Copper reflects red.
/// ```
/// use microsurface::{fresnel::{Conductor, Fresnel}, glam::Vec3};
/// let copper = Conductor::new(Vec3::new(0.21, 1.02, 1.25), Vec3::new(3.67, 2.58, 2.30))?;
/// let f = copper.reflectance(1.0);
/// assert!(f.x > 0.9 && f.z < 0.6);
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Born and Wolf, §14.2; the real form of Lagarde 2013, "Memo on Fresnel equations".
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::Conductor<S>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "S: serde::Serialize", deserialize = "S: Spectrum + serde::Deserialize<'de>"))
)]
pub struct Conductor<S> {
    n: S,
    k: S,
}

impl<S: Spectrum> Conductor<S> {
    /// A conductor of refractive index n and extinction coefficient k per channel.
    ///
    /// # Errors
    /// [`Error::RefractiveIndex`] unless every n is positive and finite, [`Error::Extinction`] unless every k is
    /// at least 0 and finite.
    pub fn new(n: S, k: S) -> Result<Self, Error> {
        check(n, |n| n > S::Scalar::ZERO, |value| Error::RefractiveIndex { value })?;
        check(k, |k| k >= S::Scalar::ZERO, |value| Error::Extinction { value })?;
        Ok(Self { n, k })
    }
}

impl<S: Spectrum> Fresnel for Conductor<S> {
    type Output = S;
    #[inline(always)]
    fn reflectance(&self, cos: S::Scalar) -> S {
        let (zero, one, half) = (S::Scalar::ZERO, S::Scalar::ONE, S::Scalar::HALF);
        let cos2 = cos * cos;
        let sin2 = (one - cos) * (one + cos);
        self.n.zip(self.k, |n, k| {
            // p + iq = ε − sin², and its root a + ib: the larger of a², b² by a sum, the other by q = 2ab.
            // p cancels at the critical angle of a weak absorber: formed in the wide scalar, from ε − 1 or from ε.
            let (n_wide, k_wide, cos_wide) = (n.widen(), k.widen(), cos.widen());
            let unit = Wide::<S>::ONE;
            let from_contrast = ((n_wide - unit) * (n_wide + unit) - k_wide * k_wide) + cos_wide * cos_wide;
            let from_index = (n_wide - k_wide) * (n_wide + k_wide) - (unit - cos_wide) * (unit + cos_wide);
            let p = S::Scalar::narrow(if n < half { from_index } else { from_contrast });
            let q = n * k + n * k;
            let larger = half * ((p * p + q * q).sqrt() + p.abs());
            let smaller = if larger > zero { q * q / (S::Scalar::lit(4.0) * larger) } else { zero };
            let (a2, b2) = if p < zero { (smaller, larger) } else { (larger, smaller) };
            let a = a2.sqrt();
            let square = |x: S::Scalar| x * x;
            let r_s = (square(a - cos) + b2) / (square(a + cos) + b2);
            let ratio = (square(a * cos - sin2) + b2 * cos2) / (square(a * cos + sin2) + b2 * cos2);
            let f = half * (r_s + r_s * ratio);
            // ε − sin² vanishes only at k = 0 and the critical angle, where all is reflected unless there is no
            // surface.
            let critical = if n == one { zero } else { one };
            if a2 + b2 < S::Scalar::MIN_POSITIVE { critical } else { at_most_one(f) }
        })
    }
}

#[cfg(feature = "serde")]
mod stored {
    //! What is deserialised: the numbers given, which are then checked again.
    use super::Spectrum;
    use crate::error::Error;

    #[derive(serde::Deserialize)]
    pub(super) struct Dielectric<S> {
        eta: S,
    }
    impl<S: Spectrum> TryFrom<Dielectric<S>> for super::Dielectric<S> {
        type Error = Error;
        fn try_from(stored: Dielectric<S>) -> Result<Self, Error> {
            Self::new(stored.eta)
        }
    }

    #[derive(serde::Deserialize)]
    pub(super) struct Conductor<S> {
        n: S,
        k: S,
    }
    impl<S: Spectrum> TryFrom<Conductor<S>> for super::Conductor<S> {
        type Error = Error;
        fn try_from(stored: Conductor<S>) -> Result<Self, Error> {
            Self::new(stored.n, stored.k)
        }
    }
}
