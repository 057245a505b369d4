//! Scattering functions and the choice of normals they sample.

use serde::de::Visitor;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::name::named;
use super::{Name, Named, OfName, Version, stored};
use crate::Real;
use crate::bsdf::{AllNormals, RoughConductor, UniformMixture, VisibleNormals};
use crate::error::Error;

named!(AllNormals, "all_normals");

impl Named for VisibleNormals {
    const NAME: &'static str = "visible_normals";
}

/// An optional entry: what is left out is the usual choice.
impl Serialize for VisibleNormals {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_some(&OfName::<Self>::new())
    }
}

impl<'de> Deserialize<'de> for VisibleNormals {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Optional;
        impl<'de> Visitor<'de> for Optional {
            type Value = VisibleNormals;
            fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.write_str("a table with the name visible_normals, or none")
            }
            fn visit_none<E>(self) -> Result<VisibleNormals, E> {
                Ok(VisibleNormals)
            }
            fn visit_unit<E>(self) -> Result<VisibleNormals, E> {
                Ok(VisibleNormals)
            }
            fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<VisibleNormals, D::Error> {
                OfName::<VisibleNormals>::deserialize(deserializer).map(|_| VisibleNormals)
            }
        }
        deserializer.deserialize_option(Optional)
    }
}

impl<S, T> Named for UniformMixture<S, T> {
    const NAME: &'static str = "uniform_mixture";
}

/// The table of a mixture.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(
    serialize = "S: Serialize, T: Serialize",
    deserialize = "S: Deserialize<'de>, T: Deserialize<'de>"
))]
struct Mixture<S, T> {
    name: Name<UniformMixture<S, T>>,
    probability: T,
    other: S,
}

impl<S: Clone, T: Real> From<&UniformMixture<S, T>> for Mixture<S, T> {
    fn from(mixture: &UniformMixture<S, T>) -> Self {
        Self { name: Name::new(), probability: mixture.probability(), other: mixture.other().clone() }
    }
}

impl<S, T: Real> TryFrom<Mixture<S, T>> for UniformMixture<S, T> {
    type Error = Error;
    fn try_from(table: Mixture<S, T>) -> Result<Self, Error> {
        Self::new(table.other, table.probability)
    }
}

stored!(
    UniformMixture<S, T> as Mixture<S, T>,
    [S, T: Real] where [S: Clone + serde::Serialize, T: serde::Serialize]
    where [S: serde::Deserialize<'de>, T: serde::Deserialize<'de>]
);

/// The table of a conductor; `N`, `F` and `S` are its parts or references to them.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Conductor<N, F, S> {
    #[serde(default)]
    version: Version,
    surface: N,
    fresnel: F,
    sampling: S,
}

impl<'a, N, F, S> From<&'a RoughConductor<N, F, S>> for Conductor<&'a N, &'a F, &'a S> {
    fn from(brdf: &'a RoughConductor<N, F, S>) -> Self {
        let (surface, fresnel, sampling) = (brdf.surface(), brdf.fresnel(), brdf.sampling());
        Self { version: Version, surface, fresnel, sampling }
    }
}

impl<N: Serialize, F: Serialize, S: Serialize> Serialize for RoughConductor<N, F, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Conductor::from(self).serialize(serializer)
    }
}

impl<'de, N, F, S> Deserialize<'de> for RoughConductor<N, F, S>
where
    N: Deserialize<'de>,
    F: Deserialize<'de>,
    S: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let table = Conductor::deserialize(deserializer)?;
        Ok(RoughConductor::new(table.surface, table.fresnel).sampled_by(table.sampling))
    }
}
