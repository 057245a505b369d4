//! Exact masks of GTR for integer γ, as closed forms whose terms are all positive.
//!
//! γ = 0 is GGX of α = 1. γ = 1, with t = α², L = ln t, r = √(z² + t s²), R = √(z² + s²) and δ =
//! (1−t) s²/(R + r), is z Λ = (z ln(1 + δ/(z + r)) − δ)/L. From γ = 2 on the density is a finite
//! mixture of Student-t profiles of width α, whose masks are elementary: see `integer.rs`. With e =
//! r − z they are
//!
//! γ = 2: z Λ = e/2;  γ = 3: e (w₀/2 + w₁ e/(4r)), w₀ = 2t/(1+t), w₁ = (1−t)/(1+t); …
//!
//! They are Dimov's G1 at γ = 0, 1, 2, 3, 4, freed of the cancellation between their terms, and
//! those up to γ = 10.
//!
//! References: Dimov 2015, §3; Atanasov, Koylazov, Dimov and Wilkie 2022, Eqs. 35–39.

use crate::Real;
use crate::elementary::ln_1p;
use crate::error::Error;
use crate::ggx::Ggx;
use crate::gtr::integer::{LARGEST_DEGREE, Seen, series};
use crate::gtr::{Gtr, Masking, VisibleMasking, range_and_log};
use crate::map::Isotropic;
use crate::microsurface::Microsurface;
use crate::ndf::staged::Forms;
use crate::profile::Profile;

/// The exact mask of GTR at the integer γ = `G`, 0 … 10.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closed<T, const G: u8> {
    /// α².
    alpha2: T,
    /// γ = 1: 1 − α² and 1/ln α².  γ ≥ 3: aᵢ Vᵢ, i = 1 … γ − 2.
    terms: [[T; 1]; LARGEST_DEGREE],
}

impl<T, const G: u8> Closed<T, G> {
    /// n of γ = n + 2.
    const DEGREE: usize = {
        assert!(G as usize <= LARGEST_DEGREE + 2, "closed masks of GTR exist for gamma = 0, 1, ..., 10");
        (G as usize).saturating_sub(2)
    };
}

impl<T: Real, const G: u8> Forms for Closed<T, G> {}

impl<T: Real, const G: u8> Masking<T> for Closed<T, G> {
    fn new(alpha: T, gamma: T) -> Result<Self, Error> {
        if gamma != T::lit(f64::from(G)) {
            return Err(Error::Parameter {
                name: "gamma",
                value: gamma.to_f64(),
                smallest: f64::from(G),
                largest: f64::from(G),
            });
        }
        let alpha = alpha.to_f64();
        let alpha2 = alpha * alpha;
        let terms = if G == 1 {
            let (range, log) = range_and_log(alpha);
            let mut terms = [[0.0]; LARGEST_DEGREE];
            (terms[0], terms[1]) = ([range], [1.0 / log]);
            terms
        } else {
            series(Self::DEGREE, &[alpha2])
        };
        Ok(Self { alpha2: T::lit(alpha2), terms: terms.map(|[term]| [T::lit(term)]) })
    }

    #[inline(always)]
    fn root_of_power(n: T::Wide, d: T::Wide, _: T) -> T {
        let inverse = d / n;
        let mut power = if G.is_multiple_of(2) { T::Wide::ONE } else { inverse.sqrt() };
        for _ in 0..G / 2 {
            power *= inverse;
        }
        T::narrow(power)
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
        match G {
            0 => Ggx.sigma_backfacing(s2, z),
            1 => {
                let [[range], [inv_log], ..] = self.terms;
                let r = (z * z + self.alpha2 * s2).sqrt();
                let delta = range * s2 / ((z * z + s2).sqrt() + r);
                (z * ln_1p(delta / (z + r)) - delta) * inv_log
            }
            2 => Ggx.sigma_backfacing(self.alpha2 * s2, z),
            _ => {
                let seen = Seen::new(self.alpha2, s2, z);
                T::HALF * seen.twice_backfacing(Self::DEGREE, |i| self.terms[i][0])
            }
        }
    }
}

impl<T: Real, const G: u8> VisibleMasking<T> for Closed<T, G> {}

impl<T: Real> Gtr<T, ()> {
    /// GTR at the integer γ = `G` ∈ {0, 1, …, 10} with its exact mask.
    ///
    /// `Gtr::closed::<1>(alpha)` is the Berry distribution. A larger `G` does not compile.
    ///
    /// It keeps no components: visible normals of γ = 1 make them for each sample, in 0.5 µs. Who
    /// draws many and does not mind 0.8 kB takes `Gtr::isotropic(alpha, 1.0)`.
    ///
    /// # Errors
    /// [`Error::Alpha`] or [`Error::AlphaAboveOne`] unless 0 < α ≤ 1.
    /// [`Error::Gamma`] unless |γ − 1| |ln α²| ≤ 700.
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
    /// let unknown = microsurface::Gtr::closed::<11>(0.05_f64);
    /// ```
    #[expect(clippy::type_complexity, reason = "the type names the distribution, its masking and its map")]
    pub fn closed<const G: u8>(alpha: T) -> Result<Microsurface<Gtr<T, Closed<T, G>>, Isotropic<T>>, Error> {
        Gtr::surface(alpha, T::lit(f64::from(G)))
    }
}
