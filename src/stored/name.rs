//! Names that say what a table holds.

use core::marker::PhantomData;

use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A type that is stored under a name.
pub trait Named {
    /// The name, as it is written.
    const NAME: &'static str;
}

/// The name of `N`; any other is refused.
pub(super) struct Name<N>(PhantomData<N>);

impl<N> Name<N> {
    pub(super) const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<N: Named> Serialize for Name<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(N::NAME)
    }
}

impl<'de, N: Named> Deserialize<'de> for Name<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Exactly<N>(PhantomData<N>);
        impl<N: Named> Visitor<'_> for Exactly<N> {
            type Value = Name<N>;
            fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.write_str(N::NAME)
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<Name<N>, E> {
                if name == N::NAME {
                    Ok(Name::new())
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(name), &self))
                }
            }
        }
        deserializer.deserialize_str(Exactly(PhantomData))
    }
}

/// The table of a type without numbers: its name alone.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(serialize = "N: Named", deserialize = "N: Named"))]
pub(super) struct OfName<N> {
    name: Name<N>,
}

impl<N> OfName<N> {
    pub(super) const fn new() -> Self {
        Self { name: Name::new() }
    }
}

/// Stores a type without numbers under a name.
macro_rules! named {
    ($type:ty, $name:literal $(, [$($generics:tt)*])?) => {
        impl$(<$($generics)*>)? Named for $type {
            const NAME: &'static str = $name;
        }

        impl$(<$($generics)*>)? serde::Serialize for $type {
            fn serialize<W: serde::Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
                OfName::<Self>::new().serialize(serializer)
            }
        }

        impl<'de, $($($generics)*)?> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                OfName::<Self>::deserialize(deserializer).map(|_| Self::default())
            }
        }
    };
}
pub(super) use named;
