//! Sampling of visible normals in stages, a block at a time: what batches ask of a distribution.

use crate::ndf::{SampleVndf, Vec2, Vec3};

/// Elements in a block: a multiple of the lanes of any vectors, several times over, and few enough
/// for a dozen arrays to stay in the first-level cache.
pub(crate) const BLOCK: usize = 64;

/// An equation that each normal of a block depends on, solved for the whole block at once.
pub trait Solver {
    /// Parameters of one equation.
    type Question: Copy;
    /// Its solution.
    type Answer: Copy;
    /// The questions of a block, then their answers.
    type Block;
    /// A block without questions.
    fn block() -> Self::Block;
    /// Stores the question of an element.
    fn ask(block: &mut Self::Block, lane: usize, question: Self::Question);
    /// Replaces the questions by their answers.
    fn solve(block: &mut Self::Block);
    /// The answer of an element.
    fn answer(block: &Self::Block, lane: usize) -> Self::Answer;
}

/// Nothing to solve.
impl Solver for () {
    type Question = ();
    type Answer = ();
    type Block = ();
    #[inline(always)]
    fn block() {}
    #[inline(always)]
    fn ask((): &mut (), _: usize, (): ()) {}
    #[inline(always)]
    fn solve((): &mut ()) {}
    #[inline(always)]
    fn answer((): &(), _: usize) {}
}

/// A distribution whose visible normals are drawn in three stages: ask, solve, and the normal.
///
/// Sealed: the crate's own distributions, and [`batch::Custom`](crate::batch::Custom) for others.
pub trait StagedVndf: SampleVndf + Forms {
    /// Whether the stages are straight-line code; if not, they are compiled for the build's own
    /// vectors alone.
    #[doc(hidden)]
    const STRAIGHT: bool;
    #[doc(hidden)]
    type Solver: Solver;
    /// The equation of a sample.
    #[doc(hidden)]
    fn ask(&self, w: Vec3<Self>, u: Vec2<Self>) -> <Self::Solver as Solver>::Question;
    /// A vector along the normal by the common path, and whether that path applies. Where it does
    /// not for one element, the block is sampled again in full.
    #[doc(hidden)]
    fn normal(
        &self,
        w: Vec3<Self>,
        u: Vec2<Self>,
        answer: <Self::Solver as Solver>::Answer,
    ) -> (Vec3<Self>, bool);
    /// The sample of a vector along it.
    #[doc(hidden)]
    fn sample_of_along(&self, along: Vec3<Self>) -> Vec3<Self>;
}

/// Code paths between which the numbers of a distribution choose: a batch branches once, out of its
/// loop.
pub trait Forms: Copy {
    /// The number of the path; 0 where there is only one.
    #[inline(always)]
    fn form(&self) -> usize {
        0
    }

    /// This distribution, with the compiler told the number that [`form`](Self::form) returns.
    /// Any other number gives meaningless results.
    #[inline(always)]
    #[must_use]
    fn with_form(self, _form: usize) -> Self {
        self
    }
}
