//! What constructors refuse, and why.

use core::fmt;

/// Why a constructor refused its arguments; every variant names the offending value.
///
/// Values are kept as f64, which holds an f32 exactly. Evaluation has no errors: it never panics
/// and says in its documentation what it returns at the ends of its domain.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A slope width α is not a finite number within
    /// [`alpha_range`](crate::roughness::alpha_range).
    Alpha {
        /// The α given.
        value: f64,
        /// The smallest α accepted for the scalar type.
        smallest: f64,
        /// The largest α accepted for the scalar type.
        largest: f64,
    },
    /// GTR is defined for α ≤ 1 only.
    AlphaAboveOne {
        /// The α given.
        value: f64,
    },
    /// A tail exponent γ is negative, not finite, or above what the constructor covers.
    Gamma {
        /// The γ given.
        value: f64,
        /// The largest γ this constructor accepts.
        largest: f64,
    },
    /// A roughness matrix is not finite, not positive definite, or has a principal α outside
    /// [`alpha_range`](crate::roughness::alpha_range).
    RoughnessMatrix {
        /// Its xx entry, α² units.
        xx: f64,
        /// Its xy entry.
        xy: f64,
        /// Its yy entry.
        yy: f64,
        /// Its determinant, computed without cancellation.
        determinant: f64,
    },
    /// A covariance of slopes is not finite, not positive semidefinite, or too large to be added to
    /// a roughness.
    Covariance {
        /// Its xx entry, slope² units.
        xx: f64,
        /// Its xy entry.
        xy: f64,
        /// Its yy entry.
        yy: f64,
    },
    /// A linear map is not finite, singular, or leaves the representable range of α.
    Map {
        /// The determinant of the map.
        determinant: f64,
    },
    /// A triangle of a mesh names a vertex that does not exist.
    Mesh {
        /// Its index.
        triangle: usize,
    },
    /// A stretch is not inside (−1, 1).
    Stretch {
        /// The stretch given.
        value: f64,
    },
    /// A reflectance at normal incidence is not within 0 … 1.
    Reflectance {
        /// The reflectance given.
        value: f64,
    },
    /// A refractive index η or n is not positive, not finite, or above what the constructor covers.
    RefractiveIndex {
        /// The index given.
        value: f64,
        /// The largest index this constructor accepts.
        largest: f64,
    },
    /// An extinction coefficient k is negative, not finite, or above what the constructor covers.
    Extinction {
        /// The coefficient given.
        value: f64,
        /// The largest coefficient this constructor accepts.
        largest: f64,
    },
    /// A parameter, such as the roughness of an artist's map, is not a number within its domain.
    Parameter {
        /// The name of the parameter.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The smallest value of the domain.
        smallest: f64,
        /// The largest value of the domain.
        largest: f64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Alpha { value, smallest, largest } => {
                write!(f, "alpha = {value} is not a finite number in [{smallest:e}, {largest:e}]")
            }
            Self::AlphaAboveOne { value } => write!(f, "alpha = {value}: GTR is defined for alpha <= 1"),
            Self::Gamma { value, largest } => {
                write!(f, "gamma = {value} is not a finite number in [0, {largest}]")
            }
            Self::RoughnessMatrix { xx, xy, yy, determinant } => write!(
                f,
                "roughness matrix [[{xx}, {xy}], [{xy}, {yy}]] with determinant {determinant} is not positive \
                 definite with principal alphas in range"
            ),
            Self::Covariance { xx, xy, yy } => write!(
                f,
                "covariance [[{xx}, {xy}], [{xy}, {yy}]] is not finite, not positive semidefinite or too large"
            ),
            Self::Map { determinant } => {
                write!(f, "the map with determinant {determinant} is singular, not finite or out of range")
            }
            Self::Mesh { triangle } => write!(f, "triangle {triangle} names a vertex that does not exist"),
            Self::Stretch { value } => write!(f, "stretch = {value} is not inside (-1, 1)"),
            Self::Reflectance { value } => write!(f, "reflectance = {value} is not a number in [0, 1]"),
            Self::RefractiveIndex { value, largest } => {
                write!(f, "refractive index = {value} is not a positive number up to {largest:e}")
            }
            Self::Extinction { value, largest } => {
                write!(f, "extinction coefficient = {value} is not a number in [0, {largest:e}]")
            }
            Self::Parameter { name, value, smallest, largest } => {
                write!(f, "{name} = {value} is not ")?;
                match (smallest > f64::MIN, largest < f64::MAX) {
                    (false, _) => write!(f, "finite"),
                    (true, false) => write!(f, "a number in [{smallest}, ∞)"),
                    (true, true) if smallest >= largest => write!(f, "{largest}"),
                    (true, true) => write!(f, "a number in [{smallest}, {largest}]"),
                }
            }
        }
    }
}

impl core::error::Error for Error {}
