//! Proptest strategies biased to where microfacet code breaks: grazing to the last ulp, poles,
//! below the horizon, denormal components, wi ≈ ±wo, tiny and huge α, random numbers at both ends.

use core::f64::consts::TAU;

use proptest::prelude::*;
use proptest::strategy::{Union, ValueTree};

use crate::rows::{Mask, Row};
use crate::scalar::Scalar;
use crate::surfaces::{Move, Shape, Spec, Widths};

/// A number between 2^`low` and 2^`high`, log-uniform.
fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(f64::exp2)
}

/// The unit vector of height z and azimuth φ, rounded once.
pub(crate) fn at_height<T: Scalar>(z: f64, phi: f64) -> [T; 3] {
    let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    [radius * phi.cos(), radius * phi.sin(), z].map(T::lit)
}

/// The unit vector of sine r and azimuth φ.
pub(crate) fn at_radius<T: Scalar>(r: f64, phi: f64) -> [T; 3] {
    [r * phi.cos(), r * phi.sin(), ((1.0 - r) * (1.0 + r)).sqrt()].map(T::lit)
}

/// The smallest numbers of the scalar, by the index of a power of two above them; for f64 1e-308 is
/// not a radius whose square anything resolves, but it is a component.
fn smallest_exponent<T: Scalar>() -> f64 {
    T::TINIEST.to_f64().max(f64::MIN_POSITIVE).log2() + 0.5
}

/// An azimuth: anything, or along and next to the axes.
fn azimuth() -> impl Strategy<Value = f64> {
    prop_oneof![3 => 0.0..TAU, 1 => (0..8_u8).prop_map(|k| f64::from(k) * TAU / 8.0)]
}

/// Directions on and above the horizon.
pub(crate) fn above<T: Scalar>() -> impl Strategy<Value = [T; 3]> {
    let tiny = smallest_exponent::<T>();
    prop_oneof![
        4 => (0.0..1.0, azimuth()).prop_map(|(z, phi)| at_height(z, phi)),
        2 => (log_uniform(tiny, 0.0), azimuth()).prop_map(|(z, phi)| at_height(z, phi)),
        1 => (1..64_i32, azimuth()).prop_map(|(ulps, phi)| {
            let [x, y, _] = at_height::<T>(0.0, phi);
            [x, y, T::ZERO.stepped(ulps)]
        }),
        2 => (log_uniform(tiny, 0.0), azimuth()).prop_map(|(r, phi)| at_radius(r, phi)),
        1 => (-4..=1_i32, azimuth()).prop_map(|(ulps, phi)| {
            let z = T::ONE.stepped(ulps);
            let r = (1.0 - z.to_f64() * z.to_f64()).max(0.0).sqrt();
            [T::lit(r * phi.cos()), T::lit(r * phi.sin()), z]
        }),
        1 => prop_oneof![Just([0.0, 0.0, 1.0]), Just([1.0, 0.0, 0.0]), Just([0.0, -1.0, 0.0]), Just([-0.6, 0.8, 0.0])]
            .prop_map(|w| w.map(T::lit)),
    ]
}

/// Directions strictly above the horizon.
pub(crate) fn strictly_above<T: Scalar>() -> impl Strategy<Value = [T; 3]> {
    above::<T>().prop_map(|[x, y, z]| if z > T::ZERO { [x, y, z] } else { [x, y, T::MIN_POSITIVE] })
}

/// Directions of the whole sphere, the nadir among them.
pub(crate) fn anywhere<T: Scalar>() -> impl Strategy<Value = [T; 3]> {
    (above::<T>(), any::<bool>()).prop_map(|([x, y, z], up)| [x, y, if up { z } else { -z }])
}

/// Two directions above the horizon: unrelated, equal, a few ulps apart, mirrored, or almost
/// opposite at the horizon.
pub(crate) fn pairs<T: Scalar>() -> impl Strategy<Value = ([T; 3], [T; 3])> {
    prop_oneof![
        4 => (above::<T>(), above::<T>()),
        1 => above::<T>().prop_map(|w| (w, w)),
        1 => (above::<T>(), -9..9_i32, -9..9_i32)
            .prop_map(|(w, i, j)| (w, [w[0].stepped(i), w[1].stepped(j), w[2]])),
        1 => above::<T>().prop_map(|w| (w, [-w[0], -w[1], w[2]])),
        1 => (above::<T>(), -9..9_i32, log_uniform(smallest_exponent::<T>(), -8.0), log_uniform(-60.0, 0.0))
            .prop_map(|(w, ulps, z, ratio)| {
                let phi = w[1].to_f64().atan2(w[0].to_f64());
                let [x, y, z_other] = at_height::<T>(z * ratio, phi);
                (at_height(z, phi), [-x.stepped(ulps), -y, z_other])
            }),
    ]
}

/// A random number of [0, 1): anything, both ends, and next to them.
pub(crate) fn unit_interval<T: Scalar>() -> impl Strategy<Value = T> {
    prop_oneof![
        4 => (0.0..1.0).prop_map(|u| T::lit(u).min(T::BELOW_ONE)),
        1 => Just(T::ZERO),
        1 => Just(T::BELOW_ONE),
        1 => log_uniform(-70.0, -1.0).prop_map(T::lit),
        1 => (1..9_i32).prop_map(|ulps| T::ONE.stepped(-ulps)),
        1 => Just(T::HALF),
    ]
}

/// A slope width: log-uniform over 1e-6 … 1e3 and the ends.
pub(crate) fn alpha() -> impl Strategy<Value = f64> {
    prop_oneof![8 => log_uniform(-19.9, 9.9), 1 => Just(1e-6), 1 => Just(1e3), 2 => Just(1.0), 4 => 0.01..1.0]
}

fn correlation() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -0.9..0.9,
        1 => (log_uniform(-19.9, -1.0), any::<bool>())
            .prop_map(|(rest, up)| if up { 1.0 - rest } else { rest - 1.0 }),
        1 => Just(0.0),
    ]
}

/// α and a ratio of up to 1e4 between the axes, within the range of α.
fn two_alphas() -> impl Strategy<Value = (f64, f64)> {
    (alpha(), -13.2..13.2).prop_map(|(a, log)| (a, (a * f64::exp2(log)).clamp(1e-6, 1e3)))
}

pub(crate) fn widths() -> impl Strategy<Value = Widths> {
    prop_oneof![
        2 => alpha().prop_map(Widths::Isotropic),
        2 => two_alphas().prop_map(|(x, y)| Widths::AxisAligned(x, y)),
        1 => (two_alphas(), correlation())
            .prop_map(|((x, y), correlation)| Widths::Matrix { x, y, correlation }),
    ]
}

/// The columns of an invertible matrix: rotation × diagonal × rotation, singular values 1/16 … 16,
/// either handed.
pub(crate) fn matrix() -> impl Strategy<Value = [[f64; 2]; 2]> {
    (0.0..TAU, -4.0..4.0, -4.0..4.0, 0.0..TAU, any::<bool>()).prop_map(|(a, p, q, b, flipped)| {
        let (x, y) = (f64::exp2(p), f64::exp2(q) * if flipped { -1.0 } else { 1.0 });
        let ((s, c), (t, d)) = (a.sin_cos(), b.sin_cos());
        [[c * x * d - s * y * t, s * x * d + c * y * t], [-c * x * t - s * y * d, -s * x * t + c * y * d]]
    })
}

fn moves() -> impl Strategy<Value = Move> {
    prop_oneof![
        3 => Just(Move::Stay),
        1 => matrix().prop_map(Move::Transform),
        1 => matrix().prop_map(Move::Wrap),
        1 => (-0.99..0.99).prop_map(Move::Stretch),
    ]
}

fn own_width() -> impl Strategy<Value = f64> {
    prop_oneof![3 => log_uniform(-19.9, 0.0), 1 => Just(1.0), 1 => Just(1.0 - 1e-7), 1 => Just(1e-6)]
}

/// An exponent of the tail of `row`: anything, next to the ends, and next to an integer.
fn gamma(row: Row) -> impl Strategy<Value = f64> {
    let [low, high] = row.columns().range;
    // Of a row of one γ, finite or not, that one.
    let within = move |gamma: f64| gamma.clamp(low, high);
    prop_oneof![4 => 0.0..=4.0, 1 => 4.0..=10.0, 1 => (0..=10_u8).prop_map(f64::from), 1 => Just(2.0 + 1e-9), 1 => Just(1e-9)]
        .prop_map(within)
}

/// A distribution of `row` under every kind of map.
fn surface_of(row: Row) -> impl Strategy<Value = Spec> {
    let widths = if row.columns().own_width {
        prop_oneof![2 => Just(Widths::Isotropic(1.0)), 1 => widths()].boxed()
    } else {
        widths().boxed()
    };
    (own_width(), gamma(row), widths, moves())
        .prop_map(move |(alpha, gamma, widths, moved)| Spec::new(row.with(alpha, gamma), widths, moved))
}

/// Every profile under every kind of map.
pub(crate) fn surface() -> impl Strategy<Value = Spec> {
    let rows = Row::ALL.iter().map(|&row| (row.columns().share.into(), surface_of(row).boxed()));
    Union::new_weighted(rows.collect())
}

/// Mixtures of distributions, which are no profile under a map: filtered ones, and a caller's own.
fn compound() -> impl Strategy<Value = Spec> {
    let kept = || prop_oneof![2 => Just(Move::Stay), 1 => matrix().prop_map(Move::Wrap)];
    let share = || prop_oneof![4 => log_uniform(-13.0, 13.0), 1 => Just(0.0)];
    let filtered =
        (alpha(), share(), share(), any::<bool>(), kept()).prop_map(|(alpha, x, y, by_two, moved)| {
            let deviations = [x, y].map(|share| (alpha * share).min(1e3));
            Spec::new(Shape::Filtered { deviations, by_two }, Widths::Isotropic(alpha), moved)
        });
    let halves = (alpha(), widths(), kept())
        .prop_map(|(alpha, widths, moved)| Spec::new(Shape::Halves { alpha }, widths, moved));
    prop_oneof![2 => filtered, 1 => halves]
}

/// Every distribution: profiles under maps, wrappers and mixtures.
pub(crate) fn distribution() -> impl Strategy<Value = Spec> {
    prop_oneof![3 => surface(), 1 => compound()]
}

/// Distributions whose visible normals can be drawn.
pub(crate) fn visible_distribution() -> impl Strategy<Value = Spec> {
    distribution().prop_filter("visible normals", Spec::samples_visible)
}

/// Profiles under maps whose visible normals can be drawn.
pub(crate) fn visible_surface() -> impl Strategy<Value = Spec> {
    surface().prop_filter("visible normals", Spec::samples_visible)
}

/// The share of 4000 draws with a property.
fn share<S: Strategy>(strategy: &S, property: impl Fn(S::Value) -> bool) -> f64 {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let hits = (0..4000)
        .filter(|_| property(strategy.new_tree(&mut runner).expect("no rejections").current()))
        .count();
    f64::from(u16::try_from(hits).expect("4000")) / 4000.0
}

fn reaches_the_hard_cases<T: Scalar>() {
    let unit = |w: [T; 3]| {
        let length2: f64 = w.iter().map(|c| c.to_f64() * c.to_f64()).sum();
        (length2 - 1.0).abs() <= 3.0 * T::EPSILON.to_f64()
    };
    assert!(share(&anywhere::<T>(), unit) >= 1.0, "{}", T::NAME);
    assert!(share(&strictly_above::<T>(), |w| w[2] > T::ZERO && unit(w)) >= 1.0, "{}", T::NAME);
    let frequent: [(&str, f64); 9] = [
        ("grazing", share(&above::<T>(), |w| w[2] < T::EPSILON)),
        ("denormal height", share(&above::<T>(), |w| w[2] > T::ZERO && w[2] < T::MIN_POSITIVE)),
        ("pole", share(&above::<T>(), |w| w[2] == T::ONE)),
        ("below", share(&anywhere::<T>(), |w| w[2] < T::ZERO)),
        ("equal", share(&pairs::<T>(), |(i, o)| i == o)),
        ("opposite", share(&pairs::<T>(), |(i, o)| (0..3).all(|k| (i[k] + o[k]).to_f64().abs() < 1e-3))),
        ("u = 0", share(&unit_interval::<T>(), |u| u == T::ZERO)),
        ("u = 1 − ε/2", share(&unit_interval::<T>(), |u| u == T::BELOW_ONE)),
        ("u inside", share(&unit_interval::<T>(), |u| u.to_f64() > 0.01 && u.to_f64() < 0.99)),
    ];
    for (name, share) in frequent {
        assert!(share > 0.02, "{name} {}: {share}", T::NAME);
    }
    assert!(share(&unit_interval::<T>(), |u| u >= T::ZERO && u < T::ONE) >= 1.0, "{}", T::NAME);
}

#[test]
fn strategies_reach_the_hard_cases_f32() {
    reaches_the_hard_cases::<f32>();
}

#[test]
fn strategies_reach_the_hard_cases_f64() {
    reaches_the_hard_cases::<f64>();
}

#[test]
fn surfaces_of_every_kind_build() {
    let spec = surface();
    let builds = share(&spec, |spec| spec.build::<f32>().is_ok() && spec.build::<f64>().is_ok());
    assert!(builds > 0.97, "{builds}");
    for (name, share) in [
        ("GGX", share(&spec, |s| s.shape == Shape::GGX)),
        ("Beckmann", share(&spec, |s| s.shape == Shape::BECKMANN)),
        (
            "exact masks of γ",
            share(&spec, |s| s.mask() == Mask::Exact && s.distribution().row.columns().own_width),
        ),
        ("masks of nodes", share(&spec, |s| s.mask() == Mask::Nodes)),
        ("splines", share(&spec, |s| s.mask() == Mask::Spline)),
        ("transformed", share(&spec, |s| matches!(s.moved, Move::Transform(_)))),
        ("wrapped", share(&spec, |s| matches!(s.moved, Move::Wrap(_)))),
        ("filtered", share(&compound(), |s| matches!(s.shape, Shape::Filtered { .. }))),
        ("stretched", share(&spec, |s| matches!(s.moved, Move::Stretch(_)))),
        ("smooth", share(&alpha().boxed(), |alpha| alpha < 1e-4)),
        ("rough", share(&alpha().boxed(), |alpha| alpha > 10.0)),
        ("nearly singular", share(&correlation().boxed(), |c| c.abs() > 0.999)),
        ("ratio above 1000", share(&two_alphas().boxed(), |(x, y)| x / y > 1e3 || y / x > 1e3)),
    ] {
        assert!(share > 0.04, "{name}: {share}");
    }
}
