//! The bits of scalars.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::Real;

/// f32 or f64, one ulp at a time.
pub trait Float: Real {
    /// `"f32"` or `"f64"`.
    const NAME: &'static str;
    /// The largest number below 1.
    const BELOW_ONE: Self;
    /// The smallest positive number.
    const TINIEST: Self;
    /// Not a number.
    const NAN: Self;

    /// The next number away from 0, or towards 0 for a negative `ulps`; by that many steps.
    #[must_use]
    fn stepped(self, ulps: i32) -> Self;

    /// The value and its bits, to reproduce a failure exactly.
    #[must_use]
    fn hex(self) -> String;
}

macro_rules! float {
    ($t:ident, $signed:ident) => {
        impl Float for $t {
            const NAME: &'static str = stringify!($t);
            const BELOW_ONE: Self = 1.0 - $t::EPSILON / 2.0;
            const TINIEST: Self = $t::from_bits(1);
            const NAN: Self = $t::NAN;

            fn stepped(self, ulps: i32) -> Self {
                let magnitude = self.abs().to_bits().saturating_add_signed($signed::from(ulps));
                $t::from_bits(magnitude).copysign(self)
            }

            fn hex(self) -> String {
                format!("{self:e}={:#x}", self.to_bits())
            }
        }
    };
}
float!(f32, i32);
float!(f64, i64);

/// The components of a vector, each with its bits.
pub(super) fn hex<T: Float>(v: &[T]) -> String {
    let parts: Vec<String> = v.iter().map(|c| c.hex()).collect();
    format!("[{}]", parts.join(", "))
}

/// A view, short: its angle from the normal and its azimuth.
pub(super) fn view<T: Float>(w: [T; 3]) -> String {
    let [x, y, z] = wide(w);
    format!("from {:.4}°, azimuth {:.1}°", x.hypot(y).atan2(z).to_degrees(), y.atan2(x).to_degrees())
}

/// The numbers as f64, exactly.
pub(super) fn wide<T: Real>(v: [T; 3]) -> [f64; 3] {
    v.map(T::to_f64)
}

/// Each number rounded once.
pub(super) fn narrow<T: Real, const N: usize>(v: [f64; N]) -> [T; N] {
    v.map(T::lit)
}

/// Whether x is at most `limit`; NaN is not.
pub(super) fn within(x: f64, limit: f64) -> bool {
    x <= limit
}

/// |a − b| over the larger of both; 0 where both are too small to have digits, or equal.
pub(super) fn relative<T: Real>(a: f64, b: f64) -> f64 {
    let (off, tiny) = ((a - b).abs(), 64.0 * T::MIN_POSITIVE.to_f64());
    let infinite = a.is_infinite() && a.to_bits() == b.to_bits();
    if off <= tiny || infinite { 0.0 } else { off / a.abs().max(b.abs()) }
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v[0].hypot(v[1]).hypot(v[2]);
    v.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_reach_the_neighbours() {
        assert_eq!(1.0_f32.stepped(1).to_bits(), (1.0 + f32::EPSILON).to_bits());
        assert_eq!(1.0_f64.stepped(-1).to_bits(), f64::BELOW_ONE.to_bits());
        assert_eq!((-0.0_f32).stepped(1).to_bits(), (-f32::TINIEST).to_bits());
        assert_eq!(0.0_f64.stepped(-3).to_bits(), 0);
    }
}
