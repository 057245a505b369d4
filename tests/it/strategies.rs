//! Strategies for surfaces, beside those of the kit; and that all of them reach the hard cases.

pub(crate) use microsurface::verify::strategies::{
    above, alpha, anywhere, at_height, at_radius, footprint, matrix, pairs, strictly_above, unit_interval,
};
use microsurface::verify::strategies::{correlation, log_uniform, two_alphas};
use proptest::prelude::*;
use proptest::strategy::{Union, ValueTree};

use crate::rows::{Mask, Row};
use crate::scalar::Scalar;
use crate::surfaces::{Move, Shape, Spec, Widths};

pub(crate) fn widths() -> impl Strategy<Value = Widths> {
    prop_oneof![
        2 => alpha().prop_map(Widths::Isotropic),
        2 => two_alphas().prop_map(|(x, y)| Widths::AxisAligned(x, y)),
        1 => (two_alphas(), correlation())
            .prop_map(|((x, y), correlation)| Widths::Matrix { x, y, correlation }),
    ]
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

/// An exponent of the tail of `row`.
fn gamma(row: Row) -> impl Strategy<Value = f64> {
    let [low, high] = row.columns().range;
    // Of a row of one γ, finite or not, that one.
    microsurface::verify::strategies::gamma().prop_map(move |gamma| gamma.clamp(low, high))
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
