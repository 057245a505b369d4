//! Stored materials: the form in which serde writes and reads them.
//!
//! Every material is a table of a few named entries, which a person can write too. It names its
//! distribution, so that the file of one is never read as another, and what is read is checked as
//! by the constructors. The same tables serve JSON, TOML, RON and binary formats.
//!
//! ```toml
//! version = 1                 # of this form; may be left out
//!
//! [surface.profile]
//! name = "ggx"
//!
//! [surface.map]               # alpha = 0.05 along 30 degrees, 0.3 across
//! alphas = [0.05, 0.3]
//! angle = 0.5235988
//!
//! [fresnel]
//! name = "conductor"
//! n = [0.14, 0.43, 1.38]
//! k = [3.697, 2.455, 1.914]
//! ```
//!
//! | type | entries |
//! |---|---|
//! | [`Microsurface`] | `version`, `profile`, `map` |
//! | [`Ggx`](crate::Ggx), [`Beckmann`](crate::Beckmann) | `name` = `"ggx"`, `"beckmann"`, `"beckmann_to_1e6"` |
//! | [`Gtr`](crate::Gtr) | `name` = `"gtr"`, `alpha`, `gamma`, `mask` = `"mixture"`, `"nodes"`, `"closed"` or `"spline"` |
//! | [`Isotropic`](crate::Isotropic) | `alpha` |
//! | [`AxisAligned`](crate::AxisAligned) | `alphas` = [αx, αy], or `alpha` |
//! | [`Linear`](crate::Linear), [`RoughnessMatrix`](crate::RoughnessMatrix) | the same, or `alphas` and `angle`, or `matrix` = [xx, xy, yy] of A, or `factor` |
//! | [`RoughConductor`](crate::bsdf::RoughConductor) | `version`, `surface`, `fresnel`, `sampling` |
//! | [`Schlick`](crate::fresnel::Schlick) | `name` = `"schlick"`, `f0` |
//! | [`Dielectric`](crate::fresnel::Dielectric) | `name` = `"dielectric"`, `eta` |
//! | [`Conductor`](crate::fresnel::Conductor) | `name` = `"conductor"`, `n`, `k` |
//! | [`Perfect`](crate::fresnel::Perfect) | `name` = `"perfect"` |
//! | [`VisibleNormals`](crate::bsdf::VisibleNormals), [`AllNormals`](crate::bsdf::AllNormals) | `name` = `"visible_normals"`, which may be left out; `"all_normals"` |
//! | [`UniformMixture`](crate::bsdf::UniformMixture) | `name` = `"uniform_mixture"`, `probability`, `other` |
//!
//! Entries that are not in the table are refused, so a misspelt one is an error and not a default.
//!
//! # What comes back
//! A material that is written and read again is the same to the last bit, where the format keeps
//! the digits of its numbers. Hence a general map is written as its `factor` [r11, r12, r22]: the
//! upper triangular R of A = RᵀR, which is what it holds. Authors write `alphas` and `angle`.
//!
//! # Versions
//! This is version 1. A file without `version` is of version 1. A file of a later version is
//! refused with both numbers. A later release of this crate reads version 1.
//!
//! # Example
//! ```
//! # #[cfg(not(feature = "serde"))] fn main() {}
//! # #[cfg(feature = "serde")] fn main() -> Result<(), Box<dyn core::error::Error>> {
//! use microsurface::{Beckmann, Ggx, Isotropic, Microsurface, Ndf};
//! let text = r#"{ "profile": { "name": "ggx" }, "map": { "alpha": 0.2 } }"#;
//! let surface: Microsurface<Ggx, Isotropic<f32>> = serde_json::from_str(text)?;
//! assert_eq!(surface, Ggx::isotropic(0.2)?);
//! // The type has to be that of the file.
//! let wrong = serde_json::from_str::<Microsurface<Beckmann, Isotropic<f32>>>(text).unwrap_err();
//! assert!(wrong.to_string().starts_with("invalid value: string \"ggx\", expected beckmann"));
//! # Ok(())
//! # }
//! ```

mod bsdf;
mod fresnel;
mod map;
mod name;
mod profile;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use self::name::{Name, Named, OfName};
use crate::Microsurface;

/// The version of the form written here.
const VERSION: u32 = 1;

/// The `version` of a table.
struct Version;

impl Default for Version {
    /// A table that names no version is of the first.
    fn default() -> Self {
        Self
    }
}

impl Serialize for Version {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(VERSION)
    }
}

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match u32::deserialize(deserializer)? {
            VERSION => Ok(Self),
            other => Err(serde::de::Error::custom(format_args!(
                "a material of version {other}; this release reads version {VERSION}"
            ))),
        }
    }
}

/// Writes and reads a type by way of the table it is stored as.
macro_rules! stored {
    (
        $type:ty as $table:ty,
        [$($generics:tt)*] where [$($write:tt)*] where [$($read:tt)*]
    ) => {
        impl<$($generics)*> serde::Serialize for $type
        where
            $($write)*
        {
            fn serialize<W: serde::Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
                <$table>::from(self).serialize(serializer)
            }
        }

        impl<'de, $($generics)*> serde::Deserialize<'de> for $type
        where
            $($read)*
        {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let table = <$table as serde::Deserialize>::deserialize(deserializer)?;
                Self::try_from(table).map_err(serde::de::Error::custom)
            }
        }
    };
}
use stored;

/// The table of a microsurface.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Surface<P, M> {
    #[serde(default)]
    version: Version,
    profile: P,
    map: M,
}

impl<P: Copy, M: Copy> From<&Microsurface<P, M>> for Surface<P, M> {
    fn from(surface: &Microsurface<P, M>) -> Self {
        Self { version: Version, profile: *surface.profile(), map: *surface.map() }
    }
}

impl<P, M> From<Surface<P, M>> for Microsurface<P, M> {
    fn from(table: Surface<P, M>) -> Self {
        Self::new(table.profile, table.map)
    }
}

stored!(
    Microsurface<P, M> as Surface<P, M>,
    [P, M] where [P: Copy + serde::Serialize, M: Copy + serde::Serialize]
    where [P: serde::Deserialize<'de>, M: serde::Deserialize<'de>]
);
