//! Fresnel reflectances: Schlick's approximation and the exact dielectric and conductor, scalar or
//! RGB.
//!
//! Each takes its parameters as a [`Spectrum`], a scalar or a glam vector of three, and returns the
//! same; a material pays for three channels only where it has three.

use crate::elementary::exact::{two_product, two_sum};
use crate::error::Error;
use crate::real::Real;
pub use crate::real::Spectrum;

/// A Fresnel reflectance as a function of the angle between a direction and a facet's normal.
pub trait Fresnel {
    /// The reflectance: f32, f64, or a glam vector of three.
    type Output: Spectrum;

    /// The share of unpolarised light that a facet reflects.
    ///
    /// # Domain
    /// `cos`, the cosine between the direction and the facet's normal, 0 … 1. Values above 1 by
    /// rounding are harmless.
    ///
    /// # Returns
    /// 0 … 1 in every channel.
    fn reflectance(&self, cos: Scalar<Self>) -> Self::Output;
}

/// The scalar of a Fresnel term's output.
pub type Scalar<F> = <<F as Fresnel>::Output as Spectrum>::Scalar;

macro_rules! forwarded {
    ($($pointer:ty),*) => {
        $(impl<F: Fresnel + ?Sized> Fresnel for $pointer {
            type Output = F::Output;
            #[inline(always)]
            fn reflectance(&self, cos: Scalar<F>) -> F::Output {
                (**self).reflectance(cos)
            }
        })*
    };
}
forwarded!(&F);
#[cfg(feature = "alloc")]
forwarded!(alloc::boxed::Box<F>, alloc::sync::Arc<F>);

/// A facet that reflects everything: for furnace tests and mirrors without colour.
///
/// The output cannot be inferred from an argument: `Perfect::<f32>::new()`,
/// `Perfect::<Vec3>::new()`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
/// # Example
/// ```
/// use microsurface::fresnel::{Fresnel, Schlick};
/// let glass = Schlick::new(0.04_f32)?;
/// assert!((glass.reflectance(0.5) - 0.07).abs() < 1e-7);
/// assert!(Schlick::new(7.5_f32).is_err());
/// # Ok::<(), microsurface::Error>(())
/// ```
///
/// # References
/// Schlick 1994, "An inexpensive BRDF model for physically-based rendering", Eq. 15.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schlick<S> {
    f0: S,
}

impl<S: Spectrum> Schlick<S> {
    /// The approximation with reflectance `f0` at normal incidence.
    ///
    /// # Errors
    /// [`Error::Reflectance`] unless every channel is within 0 … 1.
    pub fn new(f0: S) -> Result<Self, Error> {
        let (zero, one) = (S::Scalar::ZERO, S::Scalar::ONE);
        check(f0, |f0| f0 >= zero && f0 <= one, |value| Error::Reflectance { value })?;
        Ok(Self { f0 })
    }

    /// The reflectance at normal incidence.
    #[inline]
    #[must_use]
    pub const fn f0(&self) -> S {
        self.f0
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

/// The exact reflectance of a dielectric, for light coming from the side of index 1 to that of
/// index η.
///
/// With g² = η² − 1 + cos², sin² = 1 − cos²: F = ½ ((g − cos)/(g + cos))² (1 + ((g cos − sin²)/(g
/// cos + sin²))²), and 1 where g² < 0, total internal reflection. Where g − cos would cancel it is
/// (η² − 1)/(g + cos). g² is a sum of exact squares.
///
/// # Accuracy
/// Absolute: 4 ε, at η of a thousand and more. This is the largest found by a search over all η and
/// cosines (`tests/it/accuracy/search/fresnel.rs`, budget row `fresnel_dielectric`). The arguments
/// are taken as exact: at the critical angle F has an infinite slope, and rounding the cosine
/// itself moves F by √ε.
///
/// # Special cases
/// η = 1 → 0 at every angle. η below ε and η above 1/ε → 1, the limits.
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
#[doc(alias("glass", "ior"))]
pub struct Dielectric<S> {
    eta: S,
}

impl<S: Spectrum> Dielectric<S> {
    /// A dielectric of relative index η = n_inside/n_outside, seen from outside. For the way out
    /// take 1/η.
    ///
    /// # Errors
    /// [`Error::RefractiveIndex`] unless every channel is positive and finite.
    pub fn new(eta: S) -> Result<Self, Error> {
        let largest = S::Scalar::MAX.to_f64();
        check(eta, |eta| eta > S::Scalar::ZERO, |value| Error::RefractiveIndex { value, largest })?;
        Ok(Self { eta })
    }

    /// The relative index.
    #[inline]
    #[must_use]
    pub const fn eta(&self) -> S {
        self.eta
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

/// n² − sin² = (n² − 1) + cos² to an ulp of itself, for n below 2²⁷; the arguments are exact.
///
/// Near the critical angle it cancels, and its root is the error of a reflectance.
#[inline(always)]
fn square_less_sine<T: Real>(n: T, cos: T) -> T {
    let (n, cos) = (n.to_f64(), cos.to_f64());
    // Squares of f32 are exact in f64; so is the rest of n² − 1 where it matters, below 1.
    if T::EPSILON.to_f64() > f64::EPSILON {
        let n2 = n * n;
        let contrast = n2 - 1.0;
        return T::lit((contrast + cos * cos) + (n2 - (contrast + 1.0)));
    }
    let ((n2, n2_rest), (cos2, cos2_rest)) = (two_product(n, n), two_product(cos, cos));
    let (contrast, contrast_rest) = two_sum(n2, -1.0);
    let (sum, sum_rest) = two_sum(contrast, cos2);
    // Where the sum cancels, so do the rests of the two larger, exactly.
    T::lit(sum + (((contrast_rest + cos2_rest) + sum_rest) + n2_rest))
}

impl<S: Spectrum> Fresnel for Dielectric<S> {
    type Output = S;
    #[inline(always)]
    fn reflectance(&self, cos: S::Scalar) -> S {
        let (zero, one) = (S::Scalar::ZERO, S::Scalar::ONE);
        let sin2 = (one - cos) * (one + cos);
        self.eta.map(|eta| {
            let g2 = square_less_sine(eta, cos);
            // From 2²⁷ on g is η to the last bit, and its square may overflow.
            let g = if eta < S::Scalar::lit(134217728.0) { g2.sqrt() } else { eta };
            let sum = cos + g;
            // g − cos, from the contrast where it cancels: there η is below 2.
            let close = g <= cos + cos && cos <= g + g;
            let difference = if close { (eta - one) * (eta + one) / sum } else { g - cos };
            let r_s = difference / sum;
            let ratio = (g * cos - sin2) / (g * cos + sin2);
            let f = S::Scalar::HALF * (r_s * r_s) * (one + ratio * ratio);
            if eta == one {
                // The limit at cos = 0 too: a surface that is not there.
                zero
            } else if g2 <= zero {
                one
            } else {
                at_most_one(f)
            }
        })
    }
}

/// The exact reflectance of a conductor of complex index n + ik, seen from air or vacuum.
///
/// With a² + b² = |ε − sin²|, a the real part of √(ε − sin²), ε = (n + ik)²: R_s = ((a − cos)² +
/// b²)/((a + cos)² + b²) and R_p = R_s ((a cos − sin²)² + b² cos²)/((a cos + sin²)² + b² cos²).
///
/// # Accuracy
/// Absolute: 4.5 ε, the largest found by a search over all n, k and cosines
/// (`tests/it/accuracy/search/fresnel.rs`, budget row `fresnel_conductor`). The arguments are taken
/// as exact. At k = 0 it is a [`Dielectric`].
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
pub struct Conductor<S> {
    n: S,
    k: S,
}

impl<S: Spectrum> Conductor<S> {
    /// A conductor of refractive index n and extinction coefficient k per channel.
    ///
    /// # Errors
    /// [`Error::RefractiveIndex`] unless every n is positive and at most 10⁹, [`Error::Extinction`]
    /// unless every k is within 0 … 10⁹: their fourth powers must be finite. Measured ones are
    /// below 300; a mirror is [`Perfect`].
    pub fn new(n: S, k: S) -> Result<Self, Error> {
        let (zero, largest) = (S::Scalar::ZERO, S::Scalar::lit(1e9));
        check(
            n,
            |n| n > zero && n <= largest,
            |value| Error::RefractiveIndex { value, largest: largest.to_f64() },
        )?;
        check(
            k,
            |k| k >= zero && k <= largest,
            |value| Error::Extinction { value, largest: largest.to_f64() },
        )?;
        Ok(Self { n, k })
    }

    /// The refractive index.
    #[inline]
    #[must_use]
    pub const fn n(&self) -> S {
        self.n
    }

    /// The extinction coefficient.
    #[inline]
    #[must_use]
    pub const fn k(&self) -> S {
        self.k
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
            // p + iq = ε − sin², and its root a + ib: the larger of a², b² by a sum, the other by
            // q = 2ab.
            let p = square_less_sine(n, cos) - k * k;
            let q = n * k + n * k;
            let larger = half * ((p * p + q * q).sqrt() + p.abs());
            let smaller = if larger > zero { q * q / (S::Scalar::lit(4.0) * larger) } else { zero };
            let (a2, b2) = if p < zero { (smaller, larger) } else { (larger, smaller) };
            let a = a2.sqrt();
            let square = |x: S::Scalar| x * x;
            let r_s = (square(a - cos) + b2) / (square(a + cos) + b2);
            let ratio = (square(a * cos - sin2) + b2 * cos2) / (square(a * cos + sin2) + b2 * cos2);
            let f = half * (r_s + r_s * ratio);
            // ε − sin² vanishes only at k = 0 and the critical angle, where all is reflected unless
            // there is no surface.
            let critical = if n == one { zero } else { one };
            if a2 + b2 < S::Scalar::MIN_POSITIVE { critical } else { at_most_one(f) }
        })
    }
}
