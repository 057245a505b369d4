//! The slope at which a visible Beckmann micronormal is found: the exact inverse of its
//! distribution.
//!
//! # The equation
//!
//! For the unit profile seen along w = (s, 0, z), ν = z/s = cot θ, the slope x of the visible
//! normals towards the viewer has the density (ν − x)·e^(−x²) on x ≤ ν, up to a factor (Heitz and
//! d'Eon 2014). Given u we need the x with F(x) = u·F(ν), where
//!
//! F(x) = ∫₋∞ˣ (ν − t)·e^(−t²)/√π dt = ½[ν·erfc(−x) + e^(−x²)/√π],
//!
//! which has no closed inverse. Earlier inversions were tabulated (Heitz and d'Eon) or iterated to
//! a tolerance (Jakob 2014). Here one guess and one step (two for f64) of high order reach
//! rounding, without branches. The guess is made in the scalar of u; F and the step, for an f32, in
//! f64, or in f32 too where 1e-6 of u will do.
//!
//! # F without cancellation
//!
//! Below the horizon (ν < 0) the two terms nearly cancel. Write ierfc t = e^(−t²)/√π − t·erfc t and
//! h(t) = ierfc t/erfc t, a function that falls slowly from 1/√π at 0 to 1/(2t). One rational fit
//! h = P/Q with positive coefficients gives both functions,
//!
//! erfc t = e^(−t²)/√π · Q/(tQ + P),  ierfc t = e^(−t²)/√π · P/(tQ + P),
//!
//! and with the distance to the end w = ν − x ≥ 0 and t = |x| every F is
//!
//! - x ≤ 0: F = e^(−t²)/(2√π) · (P + wQ)/(tQ + P), a sum of positive terms,
//! - x > 0: F = ν + e^(−t²)/(2√π) · (P − wQ)/(tQ + P), where ν ≤ 2F is the larger term.
//!
//! Two rescalings keep all numbers finite. For ν < 0 everything is divided by e^(−ν²): the exponent
//! becomes −ξ(ξ + 2n) with n = −ν and ξ = w. For ν ≥ 0, n = 0 and ξ = −x. Above ν = 1 everything is
//! divided by ν, that is multiplied by b = 1/max(ν, 1): bν and f = bw = bν + bξ stay finite up to
//! normal incidence, ν = ∞, where b = 0.
//!
//! # The step
//!
//! The density vanishes at x = ν, so x has a square root singularity at u = 1, and F decays like
//! e^(−x²) at the other end. As a relation between v = w² and G = −ln(F(x)/F(ν)) both are gone:
//! dv/dG = 2√π·e^(x²)·F is smooth and positive, and for ν = 0 simply v = G. With the derivatives by
//! G, where H = F′/F,
//!
//! τ = 1/H, ρ = τ/w, q = 1 + 2xτ:  x′ = −τ, τ′ = −τ(q + ρ), ρ′ = −ρ(q + 2ρ), v′ = 2wτ, v″ = −q·v′,
//!
//! all algebraic, the Taylor series of v to δ⁴ costs one erfc and one e^(−x²). Its δ =
//! ln(F/(u·F(ν))) is 2 artanh y of y = (F − uF(ν))/(F + uF(ν)). It is exact, whatever the guess,
//! for ν = 0.
//!
//! # The guess
//!
//! Three formulas meet exactly: where u is above F(0)/F(ν) (then x > 0), below it, and for ν < 0.
//! - ν ≥ 0, x ≤ 0, X = −x: a = −ln(F(x)/F(0)) = hX + X²/γ with h = F′(0)/F(0) and a γ that drifts
//!   from 1/(1 − s + 2s²/π), s = ½ν/F(0), towards 1. So X = √((hγ/2)² + γa) − hγ/2.
//! - x > 0: where ν is large, erfc x is the fraction β of the mass beyond 0 that is still to come,
//!   and a = −ln erfc x gives x by the same formula with s = 1. Where ν is small, e = (erfc x −
//!   erfc ν)/(1 − erfc ν) is √β. Between, e is the root of e² = β(η + (1 − η)e), with η such that e
//!   is right to first order at x = ν. What remains, at most 0.2, is removed by a rational function
//!   of x and w.
//! - ν < 0: a = G = w² + 2nw − ln A, where ln A = √a·B grows from 0 and B = 2n·√(√π·ierfcx n)/(1 +
//!   …√a), whence w.
//!
//! In the end each is √(c² + r) − c = r/(c + √(c² + r)), where c and r have a common divisor d: rd,
//! cd and d give it with one division. For f32 a rough logarithm is enough; that of f64 is exact,
//! and so is then the guess for ν = 0.
//!
//! # Many at once
//!
//! All this is one chain of operations, each of which waits for the one before, longer than a
//! processor looks ahead: two vectors of it take twice the time of one. In a batch the parts of the
//! chain are loops of their own over a block.
//!
//! # References
//!
//! - E. Heitz and E. d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
//!   Visible Normals", 2014, doi 10.1111/cgfm.12417.
//! - W. Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution", 2014.

mod block;
mod fit;
mod guess;
mod view;

use self::fit::{DOUBLE, Fit, SHORT, SINGLE};
use self::guess::Outset;
use self::view::View;
use crate::elementary::{erfc_inv_inside, erfc_inv_inside_wide};
use crate::real::{Real, converted};

pub(super) use self::block::VisibleSlopes;

/// How the equation is solved for a scalar.
pub trait Inversion<T: Real> {
    /// The scalar of F and of the steps.
    type Wide: Real;
    /// The fit of h.
    const FIT: Fit;
    /// The slope across the view, of a Gaussian: erfc x = 2u, u at least ε/4.
    fn slope_across(u: T) -> T;
}

/// As a difference of u to 3e-8 in f32, half the step of u below 1, and to 2e-15 in f64. Both
/// slopes are monotone in u, for every f32, and for f64 at steps of 2⁻⁴⁴.
#[derive(Debug)]
pub struct ToRounding;

impl<T: Real> Inversion<T> for ToRounding {
    type Wide = T::Wide;
    const FIT: Fit = if T::WIDENS { SINGLE } else { DOUBLE };
    #[inline(always)]
    fn slope_across(u: T) -> T {
        T::narrow(-erfc_inv_inside_wide::<T>((T::TWO * u).widen()))
    }
}

/// In the arithmetic of the scalar: in f32 to 1e-6 as a difference of u, not monotone ulp by ulp;
/// in f64 [`ToRounding`].
#[derive(Debug)]
pub struct To1e6;

impl<T: Real> Inversion<T> for To1e6 {
    type Wide = T;
    const FIT: Fit = if T::WIDENS { SHORT } else { DOUBLE };
    #[inline(always)]
    fn slope_across(u: T) -> T {
        -erfc_inv_inside(T::TWO * u)
    }
}

/// u as it is taken: from ε/4, the middle of the first cell of random numbers, so that slopes stay
/// finite.
#[inline(always)]
fn within<T: Real>(u: T) -> T {
    u.max(T::lit(0.25) * T::EPSILON).min(T::ONE - T::HALF * T::EPSILON)
}

/// How many steps a scalar takes: f32 is content with one.
#[inline(always)]
fn steps<T: Real>() -> usize {
    if T::WIDENS { 1 } else { 2 }
}

/// The slope x towards the viewer with F(x) = u·F(ν), in the notation of the module.
///
/// # Domain
///
/// Any ν, also negative and +∞; u in [0, 1), see [`within`].
///
/// # Returns
///
/// A finite x ≤ ν, x < ν unless they differ by less than rounding (ν below about −10³).
#[inline(always)]
fn visible_slope<I: Inversion<T>, T: Real>(nu: I::Wide, u: T) -> I::Wide {
    let (view, outset) = View::new(nu, I::FIT);
    slope_at(&view, nu, solve::<I, T>(&view, &outset, u).0)
}

/// (ξ, f) of u.
#[inline(always)]
fn solve<I: Inversion<T>, T: Real>(view: &View<I::Wide>, outset: &Outset<T>, u: T) -> (I::Wide, I::Wide) {
    let u = within(u);
    let mut at = view.at(outset.guess(u));
    for _ in 0..steps::<T>() {
        at = view.step(at, converted(u), view.distribution(at, I::FIT));
    }
    at
}

/// x at ξ.
#[inline(always)]
fn slope_at<W: Real>(view: &View<W>, nu: W, xi: W) -> W {
    (-(xi + view.n)).min(nu)
}

/// The slopes along and across the view, of a random number each.
#[inline(always)]
pub(crate) fn slopes<I: Inversion<T>, T: Real>(nu: I::Wide, [u1, u2]: [T; 2]) -> [T; 2] {
    [converted(visible_slope::<I, T>(nu, u1)), I::slope_across(within(u2))]
}

#[cfg(test)]
mod tests;
