//! What the tests need of a scalar beyond `Real`: neighbours, bits and a name.

use microsurface::Real;
use microsurface::fresnel::Spectrum;

/// f32 or f64, one ulp at a time.
pub(crate) trait Scalar: Real + Spectrum<Scalar = Self> {
    /// For messages.
    const NAME: &'static str;
    /// The largest number below 1.
    const BELOW_ONE: Self;
    /// The smallest positive number.
    const TINIEST: Self;
    /// Not a number.
    const NAN: Self;

    /// The next number away from 0, or towards 0 for a negative `ulps`; by that many steps.
    fn stepped(self, ulps: i32) -> Self;

    /// The value and its bits, to reproduce a failure exactly.
    fn hex(self) -> String;
}

macro_rules! scalar {
    ($t:ident, $bits:ident, $signed:ident) => {
        impl Scalar for $t {
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
scalar!(f32, u32, i32);
scalar!(f64, u64, i64);

/// A vector of a scalar from f64 components, each rounded once.
pub(crate) fn vec3<T: Real>(v: [f64; 3]) -> T::Vec3 {
    v.map(T::lit).into()
}

/// a·b.
pub(crate) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// v as f64, exactly.
pub(crate) fn wide<T: Real>(v: [T; 3]) -> [f64; 3] {
    v.map(T::to_f64)
}

/// v/|v| in f64.
pub(crate) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v[0].hypot(v[1]).hypot(v[2]);
    v.map(|c| c / length)
}

#[test]
fn steps_reach_the_neighbours() {
    assert_eq!(1.0_f32.stepped(1), 1.0 + f32::EPSILON);
    assert_eq!(1.0_f64.stepped(-1), f64::BELOW_ONE);
    assert_eq!((-0.0_f32).stepped(1).to_bits(), (-f32::TINIEST).to_bits());
    assert_eq!(0.0_f64.stepped(-3), 0.0);
}
