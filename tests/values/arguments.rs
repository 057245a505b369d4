//! Arguments: fixed numbers, biased to the ends of the domain.

use core::f64::consts::TAU;

use microsurface::Real;

use crate::random::Random;

impl Random {
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
