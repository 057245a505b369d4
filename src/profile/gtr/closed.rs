//! Exact masks of GTR for integer γ, as closed forms whose terms are all positive.
//!
//! For integer γ ≥ 2 the density is a mixture of Student-t profiles of integer exponent b,
//! (b−1) t^{b−1}/(π (r² + t)^b) with t = α², because
//! (r² + 1)^{γ−2}/(r² + t)^γ = Σₖ C(γ−2, k) (1−t)ᵏ/(r² + t)^{k+2}. Normalised, the weights are
//!
//! | γ | b = 2 | b = 3 | b = 4 |
//! |---|---|---|---|
//! | 2 | 1 | | |
//! | 3 | 2t/(1+t) | (1−t)/(1+t) | |
//! | 4 | 3t²/(1+t+t²) | 3t(1−t)/(1+t+t²) | (1−t)²/(1+t+t²) |
//!
//! and each component has, with r = √(z² + t s²) and e = r − z = t s²/(r + z),
//!
//! z Λ = e/2 (b = 2),  e²/(4r) (b = 3),  e³(3r + z)/(16r³) (b = 4).
//!
//! They are Dimov's G1 at γ = 2, 3, 4, freed of the cancellation between their terms. γ = 1, with
//! L = ln t, R = √(z² + s²) and δ = (1−t) s²/(R + r), is z Λ = (z ln(1 + δ/(z + r)) − δ)/L, and γ = 0 is GGX of
//! α = 1.
//!
//! References: Dimov 2015, §3; Atanasov, Koylazov, Dimov and Wilkie 2022, Eqs. 35–39.

use crate::Real;
use crate::elementary::ln_1p;
use crate::error::Error;
use crate::map::Isotropic;
use crate::microsurface::Microsurface;
use crate::profile::Profile;
use crate::profile::ggx::Ggx;
use crate::profile::gtr::{Gtr, Masking, range_and_log};

/// The exact mask of GTR at the integer γ = `G`, 0 … 4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closed<T, const G: u8> {
    /// α².
    alpha2: T,
    /// γ = 1: 1 − α² and 1/ln α².  γ = 3, 4: the weights of b = 2, b = 3 and, for γ = 4, b = 4.
    first: T,
    second: T,
    third: T,
}

impl<T: Real, const G: u8> Masking<T> for Closed<T, G> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        const { assert!(G <= 4, "closed masks of GTR exist for gamma = 0, 1, 2, 3, 4") };
        if gamma != T::lit(f64::from(G)) {
            return Err(Error::Parameter { name: "gamma", value: gamma.to_f64() });
        }
        let (range, log) = range_and_log(alpha.to_f64());
        let t = alpha.to_f64() * alpha.to_f64();
        let (first, second) = match G {
            1 => (range, 1.0 / log),
            3 => (2.0 * t / (1.0 + t), range / (1.0 + t)),
            4 => (3.0 * t * t / (1.0 + t + t * t), 3.0 * t * range / (1.0 + t + t * t)),
            _ => (1.0, 0.0),
        };
        let (first, second) = (T::lit(first), T::lit(second));
        // From the rounded two, so that the weights sum to 1.
        Ok(Self { alpha2: T::lit(t), first, second, third: T::ONE - first - second })
    }

    #[inline(always)]
    fn root_of_power(x: T::Wide, _: T) -> T {
        let inverse = T::Wide::ONE / x;
        T::narrow(match G {
            0 => T::Wide::ONE,
            1 => inverse.sqrt(),
            2 => inverse,
            3 => inverse * inverse.sqrt(),
            _ => inverse * inverse,
        })
    }

    #[inline(always)]
    fn sigma_above(&self, s2: T, z: T) -> T {
        match G {
            0 => Ggx.sigma_above(s2, z),
            2 => Ggx.sigma_above(self.alpha2 * s2, z),
            _ => z + self.sigma_backfacing(s2, z),
        }
    }

    #[inline(always)]
    fn sigma_backfacing(&self, s2: T, z: T) -> T {
        let scaled = self.alpha2 * s2;
        let r = (z * z + scaled).sqrt();
        let e = scaled / (r + z);
        let e_over_r = e / r;
        match G {
            0 => Ggx.sigma_backfacing(s2, z),
            1 => {
                let delta = self.first * s2 / ((z * z + s2).sqrt() + r);
                (z * ln_1p(delta / (z + r)) - delta) * self.second
            }
            2 => Ggx.sigma_backfacing(scaled, z),
            3 => e * (T::HALF * self.first + T::lit(0.25) * self.second * e_over_r),
            _ => {
                let b4 = self.third * (e_over_r * e_over_r) * (T::lit(3.0) + z / r);
                e * (T::HALF * self.first + T::lit(0.25) * self.second * e_over_r + T::lit(1.0 / 16.0) * b4)
            }
        }
    }
}

impl<T: Real> Gtr<T, ()> {
    /// GTR at the integer γ = `G` ∈ {0, 1, 2, 3, 4} with its exact mask.
    ///
    /// `Gtr::closed::<1>(alpha)` is the Berry distribution. Another `G` does not compile.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1.
    ///
    /// # Example
    /// ```
    /// use microsurface::{Gtr, Ndf, glam::DVec3};
    /// let surface = Gtr::closed::<1>(0.05_f64)?;
    /// let (s, c) = 80_f64.to_radians().sin_cos();
    /// assert!((surface.lambda(DVec3::new(s, 0.0, c)) / 0.587697936515194 - 1.0).abs() < 1e-13);
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    /// ```compile_fail
    /// let unknown = microsurface::Gtr::closed::<5>(0.05_f64);
    /// ```
    #[expect(clippy::type_complexity, reason = "the type names the distribution, its masking and its map")]
    pub fn closed<const G: u8>(alpha: T) -> Result<Microsurface<Gtr<T, Closed<T, G>>, Isotropic<T>>, Error> {
        Gtr::surface(alpha, T::lit(f64::from(G)))
    }
}
