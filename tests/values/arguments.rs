//! Arguments: fixed numbers, biased to the ends of the domain.

use core::f64::consts::TAU;

use microsurface::Real;

/// splitmix64.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Log-uniform between two powers of ten.
    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        libm::pow(10.0, self.within(low, high))
    }

    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// A direction on or above the horizon: one in four grazes or is steep.
    pub(crate) fn above<T: Real>(&mut self) -> [T; 3] {
        let z = match self.below(16) {
            0 => self.decades(-30.0, 0.0),
            1 => self.decades(-6.0, 0.0),
            2 => 1.0 - self.decades(-12.0, 0.0),
            3 => 1.0,
            4 => 0.0,
            _ => self.unit(),
        };
        let (r, phi) = (Real::sqrt((1.0 - z) * (1.0 + z)), TAU * self.unit());
        [r * libm::cos(phi), r * libm::sin(phi), z].map(T::lit)
    }

    /// A direction of the whole sphere.
    pub(crate) fn anywhere<T: Real>(&mut self) -> [T; 3] {
        let [x, y, z] = self.above();
        if self.below(4) == 0 { [x, y, -z] } else { [x, y, z] }
    }

    /// Two numbers for a sampler, their ends among them.
    pub(crate) fn numbers<T: Real>(&mut self) -> [T; 2] {
        let mut number = || match self.below(12) {
            0 => 0.0,
            1 => 1.0 - T::EPSILON.to_f64() / 2.0,
            2 => self.decades(-20.0, 0.0),
            _ => self.unit(),
        };
        [number(), number()].map(T::lit)
    }

    /// A vector of slopes, of any length.
    pub(crate) fn slope<T: Real>(&mut self, size: f64) -> [T; 2] {
        let size = size * self.decades(-3.0, 1.0);
        [self.within(-size, size), self.within(-size, size)].map(T::lit)
    }

    /// The columns of an invertible matrix.
    pub(crate) fn matrix<T: Real>(&mut self) -> [[T; 2]; 2] {
        let [a, b, c] = core::array::from_fn(|_| self.within(-1.0, 1.0));
        [[a + 1.5, b], [c, 1.7 - a]].map(|column| column.map(T::lit))
    }

    /// A vector in space.
    pub(crate) fn vector<T: Real>(&mut self) -> [T; 3] {
        core::array::from_fn(|_| T::lit(self.within(-2.0, 2.0)))
    }
}
