//! Profiles.

use serde::{Deserialize, Serialize};

use super::name::named;
use super::{Name, Named, OfName, stored};
use crate::Real;
use crate::beckmann::{Beckmann, BeckmannTo1e6};
use crate::error::Error;
use crate::ggx::Ggx;
use crate::gtr::closed::Closed;
use crate::gtr::mixture::Mixture;
use crate::gtr::nodes::{GgxNodes, Nodes};
use crate::gtr::spline::Spline;
use crate::gtr::{Gtr, Masking};

named!(Ggx, "ggx");
named!(Beckmann, "beckmann");
named!(BeckmannTo1e6, "beckmann_to_1e6");

/// The kind of mask. The number of nodes is the type's alone.
macro_rules! masks {
    ($($name:literal: [$($generics:tt)*] $mask:ty;)*) => {$(
        impl<$($generics)*> Named for $mask {
            const NAME: &'static str = $name;
        }
    )*};
}
masks! {
    "mixture": [T, const N: usize] Mixture<T, N>;
    "nodes": [T, const N: usize] GgxNodes<T, N>;
    "nodes": [T, const N: usize] Nodes<T, N>;
    "closed": [T, const G: u8] Closed<T, G>;
    "spline": [T] Spline<T>;
}

impl<T: Real, K> Named for Gtr<T, K> {
    const NAME: &'static str = "gtr";
}

/// The numbers a GTR is built from.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(
    serialize = "T: Real + Serialize, K: Named",
    deserialize = "T: Real + Deserialize<'de>, K: Named"
))]
struct Parameters<T: Real, K> {
    name: Name<Gtr<T, K>>,
    mask: Name<K>,
    alpha: T,
    gamma: T,
}

impl<T: Real, K> From<&Gtr<T, K>> for Parameters<T, K> {
    fn from(gtr: &Gtr<T, K>) -> Self {
        Self { name: Name::new(), mask: Name::new(), alpha: gtr.alpha(), gamma: gtr.gamma() }
    }
}

impl<T: Real, K: Masking<T>> TryFrom<Parameters<T, K>> for Gtr<T, K> {
    type Error = Error;
    fn try_from(parameters: Parameters<T, K>) -> Result<Self, Error> {
        Self::new(parameters.alpha, parameters.gamma)
    }
}

stored!(
    Gtr<T, K> as Parameters<T, K>,
    [T: Real, K: Named] where [T: serde::Serialize] where [T: serde::Deserialize<'de>, K: Masking<T>]
);
