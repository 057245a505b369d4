//! Maps and roughness matrices.

use core::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::stored;
use crate::error::Error;
use crate::map::{AxisAligned, Isotropic, Linear, Map};
use crate::{Real, RoughnessMatrix};

/// The widths of a map, in one of the ways in which they are given.
#[derive(Clone, Copy)]
enum Widths<T> {
    Alpha(T),
    Alphas([T; 2]),
    Rotated([T; 2], T),
    Matrix([T; 3]),
    Factor([T; 3]),
}

/// Widths as named entries.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Map", deny_unknown_fields)]
struct Entries<T> {
    #[serde(skip_serializing_if = "Option::is_none")]
    alpha: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    alphas: Option<[T; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    matrix: Option<[T; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    factor: Option<[T; 3]>,
}

impl<T> From<Widths<T>> for Entries<T> {
    fn from(widths: Widths<T>) -> Self {
        let nothing = Self { alpha: None, alphas: None, angle: None, matrix: None, factor: None };
        match widths {
            Widths::Alpha(alpha) => Self { alpha: Some(alpha), ..nothing },
            Widths::Alphas(alphas) => Self { alphas: Some(alphas), ..nothing },
            Widths::Rotated(alphas, angle) => Self { alphas: Some(alphas), angle: Some(angle), ..nothing },
            Widths::Matrix(matrix) => Self { matrix: Some(matrix), ..nothing },
            Widths::Factor(factor) => Self { factor: Some(factor), ..nothing },
        }
    }
}

impl<T> TryFrom<Entries<T>> for Widths<T> {
    type Error = &'static str;
    fn try_from(entries: Entries<T>) -> Result<Self, &'static str> {
        let Entries { alpha, alphas, angle, matrix, factor } = entries;
        match (alpha, alphas, angle, matrix, factor) {
            (Some(alpha), None, None, None, None) => Ok(Self::Alpha(alpha)),
            (None, Some(alphas), None, None, None) => Ok(Self::Alphas(alphas)),
            (None, Some(alphas), Some(angle), None, None) => Ok(Self::Rotated(alphas, angle)),
            (None, None, None, Some(matrix), None) => Ok(Self::Matrix(matrix)),
            (None, None, None, None, Some(factor)) => Ok(Self::Factor(factor)),
            _ => Err("a map has exactly one of alpha, alphas, alphas with angle, matrix, factor"),
        }
    }
}

/// Formats without names hold the number of the way and three numbers.
impl<T: Real + Serialize> Serialize for Widths<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            return Entries::from(*self).serialize(serializer);
        }
        let zero = T::ZERO;
        let (way, numbers) = match *self {
            Self::Alpha(alpha) => (0_u8, [alpha, zero, zero]),
            Self::Alphas([x, y]) => (1, [x, y, zero]),
            Self::Rotated([x, y], angle) => (2, [x, y, angle]),
            Self::Matrix(entries) => (3, entries),
            Self::Factor(entries) => (4, entries),
        };
        (way, numbers).serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Widths<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return Entries::deserialize(deserializer)?.try_into().map_err(de::Error::custom);
        }
        let (way, numbers) = <(u8, [T; 3])>::deserialize(deserializer)?;
        let [a, b, c] = numbers;
        match way {
            0 => Ok(Self::Alpha(a)),
            1 => Ok(Self::Alphas([a, b])),
            2 => Ok(Self::Rotated([a, b], c)),
            3 => Ok(Self::Matrix([a, b, c])),
            4 => Ok(Self::Factor([a, b, c])),
            _ => Err(de::Error::custom("an unknown way to give the widths of a map")),
        }
    }
}

/// Why widths do not make a map.
enum Refused {
    /// The constructor says why.
    By(Error),
    /// A map of this type has no room for them.
    Needs(&'static str),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::By(error) => error.fmt(f),
            Self::Needs(what) => f.write_str(what),
        }
    }
}

impl From<Error> for Refused {
    fn from(error: Error) -> Self {
        Self::By(error)
    }
}

impl<T: Real> From<&Isotropic<T>> for Widths<T> {
    fn from(map: &Isotropic<T>) -> Self {
        Self::Alpha(map.alpha())
    }
}

impl<T: Real> TryFrom<Widths<T>> for Isotropic<T> {
    type Error = Refused;
    fn try_from(widths: Widths<T>) -> Result<Self, Refused> {
        match widths {
            Widths::Alpha(alpha) => Ok(Self::new(alpha)?),
            _ => Err(Refused::Needs("an isotropic map has alpha")),
        }
    }
}

impl<T: Real> From<&AxisAligned<T>> for Widths<T> {
    fn from(map: &AxisAligned<T>) -> Self {
        Self::Alphas(map.alphas())
    }
}

impl<T: Real> TryFrom<Widths<T>> for AxisAligned<T> {
    type Error = Refused;
    fn try_from(widths: Widths<T>) -> Result<Self, Refused> {
        match widths {
            Widths::Alpha(alpha) => Ok(Self::new(alpha, alpha)?),
            Widths::Alphas([x, y]) => Ok(Self::new(x, y)?),
            _ => Err(Refused::Needs("an axis-aligned map has alphas or alpha")),
        }
    }
}

impl<T: Real> From<&RoughnessMatrix<T>> for Widths<T> {
    fn from(matrix: &RoughnessMatrix<T>) -> Self {
        Self::Factor(matrix.factor())
    }
}

impl<T: Real> TryFrom<Widths<T>> for RoughnessMatrix<T> {
    type Error = Refused;
    fn try_from(widths: Widths<T>) -> Result<Self, Refused> {
        Ok(match widths {
            Widths::Alpha(alpha) => Self::rotated(alpha, alpha, T::ZERO),
            Widths::Alphas([x, y]) => Self::rotated(x, y, T::ZERO),
            Widths::Rotated([x, y], angle) => Self::rotated(x, y, angle),
            Widths::Matrix([xx, xy, yy]) => Self::new(xx, xy, yy),
            Widths::Factor(factor) => Self::checked_factor(factor),
        }?)
    }
}

impl<T: Real> From<&Linear<T>> for Widths<T> {
    fn from(map: &Linear<T>) -> Self {
        let [[r11, r12], [_, r22]] = map.inverse();
        Self::Factor([r11, r12, r22])
    }
}

impl<T: Real> TryFrom<Widths<T>> for Linear<T> {
    type Error = Refused;
    fn try_from(widths: Widths<T>) -> Result<Self, Refused> {
        RoughnessMatrix::try_from(widths).map(Self::from)
    }
}

macro_rules! stored_by_widths {
    ($($type:ident),*) => {$(
        stored!(
            $type<T> as Widths<T>,
            [T: Real] where [T: serde::Serialize] where [T: serde::Deserialize<'de>]
        );
    )*};
}
stored_by_widths!(Isotropic, AxisAligned, Linear, RoughnessMatrix);
