//! Arguments biased to where microfacet code breaks.

use core::f64::consts::TAU;

use rand::Rng;

use super::float::Float;

/// Arguments for a BSDF or a distribution, drawn where such code breaks: grazing, poles, wi ≈ ±wo,
/// numbers at both ends.
///
/// # Example
/// ```
/// use microsurface::verify::Arguments;
/// use rand_pcg::Pcg64Mcg;
/// let mut arguments = Arguments::new(Pcg64Mcg::new(1));
/// let wo = arguments.direction::<f32>();
/// let wi = arguments.partner(wo);
/// let u = arguments.numbers::<f32>();
/// assert!(wo[2] >= 0.0 && wi[2] >= 0.0 && u.iter().all(|u| (0.0..1.0).contains(u)));
/// ```
#[derive(Debug, Clone)]
pub struct Arguments<R> {
    random: R,
    merciless: bool,
}

impl<R: Rng> Arguments<R> {
    /// Arguments from a generator. Components of directions are 0, or at least about ε².
    pub const fn new(random: R) -> Self {
        Self { random, merciless: false }
    }

    /// Makes components reach down to the smallest subnormal number.
    #[must_use]
    pub fn merciless(self) -> Self {
        Self { merciless: true, ..self }
    }

    /// Uniform in [0, 1).
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    pub fn uniform(&mut self) -> f64 {
        (self.random.next_u64() >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    /// Uniform in [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Log-uniform between two powers of ten.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.within(low, high))
    }

    fn below(&mut self, n: u32) -> u32 {
        self.random.next_u32() % n
    }

    /// A few ulps either way.
    #[expect(clippy::cast_possible_wrap, reason = "below 9")]
    fn ulps(&mut self) -> i32 {
        self.below(9) as i32 - 4
    }

    /// The decade of the smallest component.
    fn smallest<T: Float>(&self) -> f64 {
        if self.merciless {
            T::TINIEST.to_f64().max(f64::MIN_POSITIVE).log10()
        } else {
            2.0 * T::EPSILON.to_f64().log10()
        }
    }

    /// A unit vector on or above the horizon.
    #[expect(clippy::cast_possible_wrap, reason = "below 64")]
    pub fn direction<T: Float>(&mut self) -> [T; 3] {
        let phi =
            if self.below(4) == 0 { f64::from(self.below(8)) * TAU / 8.0 } else { TAU * self.uniform() };
        let smallest = self.smallest::<T>();
        let (z, r) = match self.below(8) {
            0 => {
                let steps = self.below(64) as i32;
                let z = if self.merciless { T::ZERO.stepped(steps) } else { T::ZERO };
                return [T::lit(phi.cos()), T::lit(phi.sin()), z];
            }
            1 => {
                let z = T::ONE.stepped(self.ulps() - 3).to_f64();
                (z, ((1.0 - z) * (1.0 + z)).max(0.0).sqrt())
            }
            2 => {
                let z = self.decades(smallest, 0.0);
                (z, ((1.0 - z) * (1.0 + z)).sqrt())
            }
            3 => {
                let r = self.decades(smallest, 0.0);
                (((1.0 - r) * (1.0 + r)).sqrt(), r)
            }
            4 if self.below(4) == 0 => (1.0, 0.0),
            _ => {
                let z = self.uniform();
                (z, ((1.0 - z) * (1.0 + z)).sqrt())
            }
        };
        [r * phi.cos(), r * phi.sin(), z].map(T::lit)
    }

    /// A second direction above the horizon: unrelated, next to the first, mirrored, or almost
    /// opposite.
    pub fn partner<T: Float>(&mut self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self.below(8) {
            0 => [x, y, z],
            1 => [x.stepped(self.ulps()), y.stepped(self.ulps()), z],
            2 => [-x, -y, z],
            3 if x != T::ZERO || y != T::ZERO => {
                let z = z.to_f64() * self.decades(-9.0, 0.0);
                let z = if self.merciless { z } else { z.max(10_f64.powf(self.smallest::<T>())) };
                let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt() / x.to_f64().hypot(y.to_f64());
                let [x, y, z] = [-radius * x.to_f64(), -radius * y.to_f64(), z].map(T::lit);
                [x.stepped(self.ulps()), y.stepped(self.ulps()), z]
            }
            _ => self.direction(),
        }
    }

    /// A random number of [0, 1): anything, both ends, and next to them.
    pub fn number<T: Float>(&mut self) -> T {
        match self.below(8) {
            0 => T::ZERO,
            1 => T::BELOW_ONE,
            2 => T::ONE.stepped(-1 - self.ulps().abs()),
            3 => T::lit(self.decades(-40.0, 0.0)).min(T::BELOW_ONE),
            _ => T::lit(self.uniform()).min(T::BELOW_ONE),
        }
    }

    /// Two of them.
    pub fn numbers<T: Float>(&mut self) -> [T; 2] {
        [self.number(), self.number()]
    }

    /// Two ordinary numbers, on the grid of the scalar.
    pub(super) fn point<T: Float>(&mut self) -> [T; 2] {
        // Rounded down, so that none is 1.
        let grid = 1.0 / (0.5 * T::EPSILON.to_f64());
        [self.uniform(), self.uniform()].map(|u| T::lit((u * grid).floor() / grid))
    }
}
