//! Arithmetic of 160 bits, rounded correctly: the oracle of the searches.

use core::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A number of 160 bits.
#[derive(Clone, Debug)]
pub(super) struct Exact(Big);

type Big = FBig<HalfEven, 2>;

impl Exact {
    /// The number that f64 holds.
    pub(super) fn new(x: f64) -> Self {
        let exact = Big::try_from(x).expect("a finite number");
        Self(exact.with_precision(160).value())
    }

    pub(super) fn sqrt(&self) -> Self {
        Self(self.0.sqrt())
    }

    pub(super) fn exp(&self) -> Self {
        Self(self.0.exp())
    }

    pub(super) fn ln(&self) -> Self {
        Self(self.0.ln())
    }

    /// π to 212 bits, as a sum of four f64.
    pub(super) fn pi() -> Self {
        let parts = [
            core::f64::consts::PI,
            1.224_646_799_147_353_2e-16,
            -2.994_769_809_718_339_7e-33,
            1.112_454_220_863_365_3e-49,
        ];
        parts.iter().rev().fold(Self::new(0.0), |sum, &part| &sum + part)
    }

    pub(super) fn square(&self) -> Self {
        self * self
    }

    pub(super) fn abs(&self) -> Self {
        if self.negative() { -self } else { self.clone() }
    }

    pub(super) fn negative(&self) -> bool {
        self.0 < Big::ZERO
    }

    pub(super) fn zero(&self) -> bool {
        self.0 == Big::ZERO
    }

    /// The nearest f64.
    pub(super) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident)*) => {$(
        impl $trait for &Exact {
            type Output = Exact;
            fn $method(self, other: &Exact) -> Exact {
                Exact((&self.0).$method(&other.0))
            }
        }
        impl $trait<f64> for &Exact {
            type Output = Exact;
            fn $method(self, other: f64) -> Exact {
                self.$method(&Exact::new(other))
            }
        }
    )*};
}
operators!(Add add Sub sub Mul mul Div div);

impl Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact(-self.0.clone())
    }
}
