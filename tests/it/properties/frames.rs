//! Shading frames.

use microsurface::frame::{Frame, normal_to_slope, reflected, slope_to_normal};
use proptest::prelude::*;

use super::{Outcome, check, for_both_scalars, near};
use crate::scalar::{Scalar, dot, unit, wide};
use crate::strategies::{anywhere, strictly_above};

for_both_scalars! {
    frames_of_normals_are_orthonormal
    frames_next_to_the_poles_are_orthonormal
    tangents_are_followed_where_they_have_a_direction
    tangents_next_to_the_normal_have_a_direction
    steep_slopes_have_a_normal
    frames_come_back
    slopes_come_back
    mirror_images_are_on_the_other_side
}

/// Axes of unit length, at right angles and right-handed, each to `roundings` ε; z is the normal
/// itself.
fn orthonormal<T: Scalar>(frame: &Frame<T>, normal: [T; 3], roundings: f64) -> Outcome {
    let [x, y, z]: [[T; 3]; 3] = frame.axes().map(Into::into);
    prop_assert_eq!(z, normal);
    let limit = roundings * T::EPSILON.to_f64();
    let [x, y, z] = [x, y, z].map(|axis| axis.map(T::to_f64));
    for (a, b, expected) in [(x, x, 1.0), (y, y, 1.0), (x, y, 0.0), (y, z, 0.0), (z, x, 0.0)] {
        let deviation = (dot(a, b) - expected).abs();
        prop_assert!(deviation <= limit, "{frame:?}: {a:?}·{b:?} is {deviation:e} off");
    }
    let handed = dot([x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]], z);
    prop_assert!((handed - 1.0).abs() <= 2.0 * limit, "{frame:?}: x × y · z = {handed}");
    Ok(())
}

fn frames_of_normals_are_orthonormal<T: Scalar>() {
    check(3000, anywhere::<T>(), |n| orthonormal(&Frame::from_normal(n), n, 4.0));
}

/// Every normal within 200 ulps of both poles, along 16 azimuths.
fn frames_next_to_the_poles_are_orthonormal<T: Scalar>() {
    for ulps in 0..200 {
        let z = T::ONE.stepped(-ulps);
        let radius = (1.0 - z.to_f64() * z.to_f64()).max(0.0).sqrt();
        for k in 0..16 {
            let (s, c) = (f64::from(k) * core::f64::consts::PI / 8.0).sin_cos();
            for n in [z, -z].map(|z| [T::lit(radius * c), T::lit(radius * s), z]) {
                orthonormal(&Frame::from_normal(n), n, 4.0).expect("orthonormal");
            }
        }
    }
}

fn tangents_are_followed_where_they_have_a_direction<T: Scalar>() {
    // Lengths whose squares are no numbers, too.
    let lengths = if T::NAME == "f32" { -60.0..60.0 } else { -500.0..500.0 };
    let arguments = (anywhere::<T>(), anywhere::<T>(), lengths, -70.0..1.0, any::<bool>());
    check(3000, arguments, |(n, t, length, angle, parallel)| {
        let (length, angle) = (f64::exp2(length), f64::exp2(angle));
        // Any tangent, or one at a tiny angle to the normal.
        let t: [T; 3] = core::array::from_fn(|k| {
            let along = if parallel { n[k].to_f64() } else { 0.0 };
            T::lit(length * (along + if parallel { angle } else { 1.0 } * t[k].to_f64()))
        });
        let frame = Frame::from_normal_and_tangent(n, t);
        orthonormal(&frame, n, 8.0)?;
        let [x, _, _]: [[T; 3]; 3] = frame.axes().map(Into::into);
        if !parallel {
            let t = wide(t).map(|c| c / length);
            let (along, t2) = (dot(wide(n), t), dot(t, t));
            let across2 = t2 - along * along;
            if across2 > 0.01 * t2 {
                let cosine = dot(wide(x), t) / across2.sqrt();
                prop_assert!((cosine - 1.0).abs() < 1e3 * T::EPSILON.to_f64(), "x·t = {cosine}");
            }
        }
        Ok(())
    });
}

/// Tangents that hardly differ from the normal have a direction across it all the same, down to 8ε.
fn tangents_next_to_the_normal_have_a_direction<T: Scalar>() {
    let n = [0.0, 0.6, 0.8].map(T::lit);
    for (angle, follows) in [(1e3, true), (20.0, true), (2.0, false)] {
        let mut t = n;
        t[0] = T::lit(angle) * T::EPSILON;
        let [x, _, _]: [[T; 3]; 3] = Frame::<T>::from_normal_and_tangent(n, t).axes().map(Into::into);
        let [other, _, _] = Frame::<T>::from_normal(n).axes();
        assert!((x[0] - T::ONE).abs() < T::lit(0.01) || !follows, "{angle}: {x:?}");
        assert!(follows || T::Vec3::from(x) == other, "{angle}: {x:?}");
    }
}

fn steep_slopes_have_a_normal<T: Scalar>() {
    for slope in [1.0, 1e20, 1e38].into_iter().chain((T::NAME == "f64").then_some(1e300)) {
        let m: [T; 3] = slope_to_normal([T::lit(slope), T::lit(-slope)]).into();
        let expected = unit([-1.0, 1.0, 1.0 / slope]);
        for (a, b) in m.into_iter().zip(expected) {
            near("component", a, T::lit(b), 3.0).expect("the normal");
        }
    }
}

fn frames_come_back<T: Scalar>() {
    check(2000, (anywhere::<T>(), anywhere::<T>()), |(n, w)| {
        let frame = Frame::<T>::from_normal(n);
        let local: [T; 3] = frame.to_local(w.into()).into();
        let world: [T; 3] = frame.to_world(local.into()).into();
        for (a, b) in world.into_iter().zip(w) {
            let deviation = (a - b).to_f64().abs() / T::EPSILON.to_f64();
            prop_assert!(deviation <= 6.0, "{w:?} came back as {world:?}");
        }
        near(
            "height",
            T::ONE + local[2],
            T::ONE + dot(n, w),
            4.0 + 4.0 / (1.0 + dot(n, w).to_f64()).max(1e-9),
        )
    });
}

fn slopes_come_back<T: Scalar>() {
    check(1000, strictly_above::<T>(), |m| {
        prop_assume!(m[2].to_f64() > 1e-15);
        let back: [T; 3] = slope_to_normal::<T>(normal_to_slope(m)).into();
        for (a, b) in back.into_iter().zip(m) {
            near("component", a, b, 3.0)?;
        }
        Ok(())
    });
}

fn mirror_images_are_on_the_other_side<T: Scalar>() {
    check(2000, (anywhere::<T>(), anywhere::<T>()), |(w, m)| {
        let image: [T; 3] = reflected(w, m).into();
        let sum: [T; 3] = core::array::from_fn(|k| image[k] + w[k]);
        let twice = T::TWO * dot(w, m);
        for (s, m) in sum.into_iter().zip(m) {
            let deviation = (s - twice * m).to_f64().abs() / T::EPSILON.to_f64();
            prop_assert!(deviation <= 4.0, "{w:?} and {image:?} about {m:?}");
        }
        Ok(())
    });
}
