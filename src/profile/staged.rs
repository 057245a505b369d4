//! Profiles whose visible normals are drawn in stages.

use crate::Real;
use crate::ndf::staged::{Forms, Solver};
use crate::profile::SampleVisibleProfile;

/// The stages of [`StagedVndf`](crate::ndf::staged::StagedVndf) for a profile. Vectors are of any
/// length; `s2` is v.x² + v.y².
pub trait StagedProfile<T: Real>: SampleVisibleProfile<T> + Forms {
    /// Whether the stages are straight-line code.
    const STRAIGHT: bool;
    type Solver: Solver;
    /// The equation of a sample.
    fn ask(&self, v: [T; 3], s2: T, u: [T; 2]) -> <Self::Solver as Solver>::Question;
    /// A normal by the common path, and whether that path applies.
    fn normal(&self, v: [T; 3], s2: T, u: [T; 2], answer: <Self::Solver as Solver>::Answer)
    -> ([T; 3], bool);
}
