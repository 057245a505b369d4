//! The forms printed in papers and books, as they are commonly programmed: to compare with, not to
//! use.
//!
//! Angles enter through the cosine alone (cos² = z², sin² = 1 − cos², tan² = sin²/cos²), Λ is a
//! difference, G follows from two Λ, and the BRDF is F D G/(4 cos cos) of a normalised half vector.
//! Elementary functions are those of `std`, as in most renderers, except the inverse error
//! function, which it lacks.

use microsurface::Real;
use microsurface::fresnel::Spectrum;

// With their paths, so that an example can have this file by its own.
#[path = "textbook/beckmann.rs"]
pub(crate) mod beckmann;
#[path = "textbook/filter.rs"]
pub(crate) mod filter;
#[path = "textbook/ggx.rs"]
pub(crate) mod ggx;

/// The functions of `std` that the textbook calls.
pub(crate) trait Elementary: Real + Spectrum<Scalar = Self> {
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn acos(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn powf(self, exponent: Self) -> Self;
    fn atan(self) -> Self;
    fn atan2(self, x: Self) -> Self;
}

macro_rules! elementary {
    ($($t:ident)*) => {$(
        impl Elementary for $t {
            #[inline(always)]
            fn sin(self) -> Self {
                $t::sin(self)
            }
            #[inline(always)]
            fn cos(self) -> Self {
                $t::cos(self)
            }
            #[inline(always)]
            fn acos(self) -> Self {
                $t::acos(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $t::exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $t::ln(self)
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                $t::powf(self, exponent)
            }
            #[inline(always)]
            fn atan(self) -> Self {
                $t::atan(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $t::atan2(self, x)
            }
        }
    )*};
}
elementary!(f32 f64);

/// One slope width.
#[derive(Clone, Copy)]
pub(crate) struct Width<T> {
    alpha: T,
}

impl<T> Width<T> {
    pub(crate) fn new(alpha: T) -> Self {
        Self { alpha }
    }
}

/// A slope width along each axis.
#[derive(Clone, Copy)]
pub(crate) struct Anisotropic<T> {
    pub(crate) alpha_x: T,
    pub(crate) alpha_y: T,
}

impl<T: Real> Anisotropic<T> {
    /// The same stretch as the crate's materials have under axis-aligned maps.
    pub(crate) fn new(alpha: T) -> Self {
        Self { alpha_x: alpha / T::lit(0.7), alpha_y: alpha * T::lit(0.7) }
    }
}

#[inline(always)]
fn cos2<T: Real>(w: [T; 3]) -> T {
    w[2] * w[2]
}

#[inline(always)]
fn sin2<T: Real>(w: [T; 3]) -> T {
    (T::ONE - cos2(w)).max(T::ZERO)
}

#[inline(always)]
fn tan2<T: Real>(w: [T; 3]) -> T {
    sin2(w) / cos2(w)
}

/// The cosine of the azimuth; 1 at the pole.
#[inline(always)]
fn cos_phi<T: Real>(w: [T; 3]) -> T {
    let sin = sin2(w).sqrt();
    if sin == T::ZERO { T::ONE } else { (w[0] / sin).max(-T::ONE).min(T::ONE) }
}

/// The sine of the azimuth; 0 at the pole.
#[inline(always)]
fn sin_phi<T: Real>(w: [T; 3]) -> T {
    let sin = sin2(w).sqrt();
    if sin == T::ZERO { T::ZERO } else { (w[1] / sin).max(-T::ONE).min(T::ONE) }
}

#[inline(always)]
fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn normalized<T: Real>(v: [T; 3]) -> [T; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}

/// Schlick 1994, Eq. 15, as printed, the power as two squares and a product.
#[inline(always)]
fn schlick<T: Real>(f0: T, cos: T) -> T {
    let m = T::ONE - cos;
    let m2 = m * m;
    f0 + (T::ONE - f0) * (m2 * m2 * m)
}

/// F D G/(4 cos cos), Walter 2007, Eq. 20, with the height-correlated G of two Λ (Heitz 2014, Eq.
/// 99).
#[inline(always)]
fn reflection<T: Real>(
    f0: T,
    wi: [T; 3],
    wo: [T; 3],
    d: impl Fn([T; 3]) -> T,
    lambda: impl Fn([T; 3]) -> T,
) -> T {
    if wi[2] <= T::ZERO || wo[2] <= T::ZERO {
        return T::ZERO;
    }
    let half = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
    if half == [T::ZERO; 3] {
        return T::ZERO;
    }
    let wm = normalized(half);
    let f = schlick(f0, dot(wo, wm));
    let g = T::ONE / (T::ONE + lambda(wi) + lambda(wo));
    f * d(wm) * g / (T::lit(4.0) * wi[2] * wo[2])
}
