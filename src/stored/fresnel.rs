//! Fresnel terms.

use serde::{Deserialize, Serialize};

use super::name::named;
use super::{Name, Named, OfName, stored};
use crate::error::Error;
use crate::fresnel::{Conductor, Dielectric, Perfect, Schlick, Spectrum};

named!(Perfect<S>, "perfect", [S: Default]);

/// A Fresnel term with numbers: its table, and the way there and back.
macro_rules! fresnel {
    ($($type:ident as $table:ident, $name:literal, $($entry:ident),+;)*) => {$(
        impl<S> Named for $type<S> {
            const NAME: &'static str = $name;
        }

        #[derive(Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        #[serde(bound(serialize = "S: Serialize", deserialize = "S: Deserialize<'de>"))]
        struct $table<S> {
            name: Name<$type<S>>,
            $($entry: S,)+
        }

        impl<S: Spectrum> From<&$type<S>> for $table<S> {
            fn from(term: &$type<S>) -> Self {
                Self { name: Name::new(), $($entry: term.$entry(),)+ }
            }
        }

        impl<S: Spectrum> TryFrom<$table<S>> for $type<S> {
            type Error = Error;
            fn try_from(table: $table<S>) -> Result<Self, Error> {
                Self::new($(table.$entry),+)
            }
        }

        stored!(
            $type<S> as $table<S>,
            [S: Spectrum] where [S: serde::Serialize] where [S: serde::Deserialize<'de>]
        );
    )*};
}
fresnel! {
    Schlick as SchlickTable, "schlick", f0;
    Dielectric as DielectricTable, "dielectric", eta;
    Conductor as ConductorTable, "conductor", n, k;
}
