//! D, σ, Λ, G1, G2, visible normals and the reflection, evaluated.

use microsurface::Ndf;
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::{Conductor, Perfect};
use proptest::prelude::*;

use super::{Outcome, check, for_both_scalars, near, roundings_of_d, roundings_of_sigma, skewness};
use crate::rows::{Mask, Row};
use crate::scalar::{Scalar, dot, unit, vec3, wide};
use crate::strategies::{above, anywhere, distribution, pairs, strictly_above, surface};
use crate::surfaces::{Move, Shape, Spec, Surface, Widths};

for_both_scalars! {
    density_is_not_negative_and_zero_below
    projected_area_bounds_the_cosine
    projected_areas_of_both_sides_differ_by_the_cosine
    lambda_is_that_of_the_projected_area
    masking_is_ordered
    masking_does_not_multiply_cosines
    reflection_is_reciprocal
    reflection_is_made_of_its_factors
    density_along_a_half_vector_is_that_of_its_direction
    slope_density_is_that_of_the_normal
    visible_normals_are_those_of_the_definition
}

/// The surface, or none where rounding to the scalar leaves the domain.
pub(super) fn built<T: Scalar>(spec: &Spec) -> Result<Surface<T>, TestCaseError> {
    spec.build().map_err(|_| TestCaseError::reject("outside the range of the scalar"))
}

fn density_is_not_negative_and_zero_below<T: Scalar>() {
    check(4000, (distribution(), anywhere::<T>()), |(spec, m)| {
        let surface = built::<T>(&spec)?;
        let d = surface.d(m.into());
        prop_assert!(d >= T::ZERO && d.is_finite(), "D = {}", d.hex());
        prop_assert!(m[2] >= T::ZERO || d == T::ZERO, "D = {} below", d.hex());
        Ok(())
    });
}

fn projected_area_bounds_the_cosine<T: Scalar>() {
    check(6000, (distribution(), anywhere::<T>()), |(spec, w)| {
        let surface = built::<T>(&spec)?;
        let sigma = surface.sigma(w.into());
        prop_assert!(sigma.is_finite() && sigma >= w[2].max(T::ZERO), "σ = {}", sigma.hex());
        if w[2] >= T::ZERO {
            prop_assert_eq!(sigma, surface.sigma_above(w.into()));
        }
        Ok(())
    });
}

fn projected_areas_of_both_sides_differ_by_the_cosine<T: Scalar>() {
    check(4000, (distribution(), above::<T>()), |(spec, w)| {
        let surface = built::<T>(&spec)?;
        let other = w.map(|c| -c);
        let (front, back) = (surface.sigma(w.into()), surface.sigma(other.into()));
        near("σ(w) and σ(−w) + z", front, back + w[2], roundings_of_sigma(&spec))
    });
}

fn lambda_is_that_of_the_projected_area<T: Scalar>() {
    check(4000, (distribution(), above::<T>()), |(spec, w)| {
        let surface = built::<T>(&spec)?;
        let lambda = surface.lambda(w.into());
        prop_assert!(lambda >= T::ZERO, "Λ = {}", lambda.hex());
        if w[2] == T::ZERO {
            prop_assert!(lambda == T::INFINITY, "Λ = {} at the horizon", lambda.hex());
            return Ok(());
        }
        let below = surface.lambda(w.map(|c| -c).into());
        if matches!(spec.shape, Shape::Halves { .. }) {
            // A mean of two that are reflected, not a reflected mean.
            near("Λ(−w) and −1 − Λ(w)", below, -T::ONE - lambda, 2.0)?;
        } else {
            prop_assert_eq!(below, -T::ONE - lambda);
        }
        if lambda.is_finite() {
            near(
                "z (1 + Λ) and σ",
                w[2] * (T::ONE + lambda),
                surface.sigma(w.into()),
                roundings_of_sigma(&spec) + 1.0,
            )?;
        }
        Ok(())
    });
}

fn masking_is_ordered<T: Scalar>() {
    check(6000, (distribution(), pairs::<T>(), anywhere::<T>()), |(spec, (i, o), m)| {
        let surface = built::<T>(&spec)?;
        let (wi, wo, wm) = (i.into(), o.into(), m.into());
        let (g1i, g1o) = (surface.g1(wi, wm), surface.g1(wo, wm));
        let (g2, separable) = (surface.g2(wi, wo, wm), surface.g2_separable(wi, wo, wm));
        for g in [g1i, g1o, g2, separable] {
            prop_assert!(g >= T::ZERO && g <= T::ONE, "G = {}", g.hex());
        }
        let slack = T::ONE + T::lit(2.0) * T::EPSILON;
        prop_assert!(g2 <= g1i.min(g1o) * slack + T::MIN_POSITIVE, "G2 = {} above G1", g2.hex());
        prop_assert!(separable <= g2 * slack + T::MIN_POSITIVE, "G1 G1 = {} above G2", separable.hex());
        prop_assert_eq!(g2, surface.g2(wo, wi, wm));
        if !(dot(i, m) > T::ZERO && dot(o, m) > T::ZERO) {
            prop_assert!(g2 == T::ZERO, "G2 = {} on the back", g2.hex());
        }
        Ok(())
    });
}

/// G2 is 1/(1 + Λ(wi) + Λ(wo)) also where the product of the cosines is no number.
fn masking_does_not_multiply_cosines<T: Scalar>() {
    for distribution in Row::ALL.iter().flat_map(|row| row.of_width(0.5)) {
        let spec = Spec::new(distribution, Widths::Isotropic(0.7), Move::Stay);
        let surface = built::<T>(&spec).expect("in range");
        for ratio in [1.0, 1.5, 1e3, 1e6, 1e9] {
            let z = T::lit(4096.0) * T::MIN_POSITIVE;
            let wi: T::Vec3 = [T::ONE, T::ZERO, z].into();
            let wo: T::Vec3 = [T::lit(-0.6), T::lit(0.8), T::lit(ratio) * z].into();
            let normal: T::Vec3 = [T::ZERO, T::ZERO, T::ONE].into();
            let expected = T::ONE / (T::ONE + surface.lambda(wi) + surface.lambda(wo));
            near("G2", surface.g2(wi, wo, normal), expected, 8.0).unwrap();
            near("G2", surface.g2(wo, wi, normal), expected, 8.0).unwrap();
        }
    }
}

fn reflection_is_reciprocal<T: Scalar>() {
    check(4000, (distribution(), pairs::<T>()), |(spec, (i, o))| {
        let fresnel = Conductor::new(T::lit(0.21), T::lit(3.67)).expect("copper");
        let copper = RoughConductor::new(built::<T>(&spec)?, fresnel);
        let (f, g) = (copper.eval(i.into(), o.into()), copper.eval(o.into(), i.into()));
        prop_assert!(f >= T::ZERO, "f = {}", f.hex());
        prop_assert!(f == g, "f = {} one way and {} the other", f.hex(), g.hex());
        Ok(())
    });
}

/// f = F D G2/(4 zi zo) with D along the half vector and G2 of its own: the masked cosines that
/// evaluation divides by are made otherwise.
fn reflection_is_made_of_its_factors<T: Scalar>() {
    check(6000, (distribution(), pairs::<T>()), |(spec, (i, o))| {
        let surface = built::<T>(&spec)?;
        let h: [T; 3] = core::array::from_fn(|k| i[k] + o[k]);
        let length2 = dot(h, h);
        let least = T::lit(1e-6);
        prop_assume!(i[2] > least && o[2] > least && length2 > least);
        let normal = unit(wide(h)).map(T::lit);
        let g2 = surface.g2(i.into(), o.into(), normal.into());
        prop_assume!(dot(i, normal) > T::ZERO && dot(o, normal) > T::ZERO);
        let cosines = T::lit(4.0) * i[2] * o[2];
        let d = surface.d_along(h.into());
        let expected = d * (g2 / cosines);
        prop_assume!(expected.is_finite() && d > T::lit(1e6) * T::MIN_POSITIVE);
        let f = RoughConductor::new(surface, Perfect::<T>::new()).eval(i.into(), o.into());
        near("f and D G2/(4 zi zo)", f, expected, 16.0)
    });
}

/// At a normal that is not at the horizon, where D of a Beckmann surface has no condition.
fn density_along_a_half_vector_is_that_of_its_direction<T: Scalar>() {
    check(3000, (surface(), pairs::<T>()), |(spec, (i, o))| {
        let surface = built::<T>(&spec)?;
        let h: [T; 3] = core::array::from_fn(|k| i[k] + o[k]);
        let m = unit(wide(h));
        prop_assume!(m[2] > 1e-6 && wide(h)[2] > 1e-6);
        let roundings = roundings_of_d(&spec, m, 0.0) * skewness(&spec);
        prop_assume!(roundings * T::EPSILON.to_f64() < 0.1);
        near("D along h", surface.d_along(h.into()), surface.d(vec3::<T>(m)), 1.5 * roundings)
    });
}

fn slope_density_is_that_of_the_normal<T: Scalar>() {
    check(3000, (surface(), strictly_above::<T>()), |(spec, m)| {
        let surface = built::<T>(&spec)?;
        let [x, y, z] = m;
        prop_assume!(z.to_f64() > 1e-6);
        let slope: T::Vec2 = [-x / z, -y / z].into();
        let z2 = z * z;
        let roundings = roundings_of_d(&spec, wide(m), 0.0) * skewness(&spec);
        prop_assume!(roundings * T::EPSILON.to_f64() < 0.1);
        near("P22 and D z⁴", surface.p22(slope), surface.d(m.into()) * z2 * z2, 1.5 * roundings)
    });
}

fn visible_normals_are_those_of_the_definition<T: Scalar>() {
    check(3000, (surface(), anywhere::<T>(), anywhere::<T>()), |(spec, w, m)| {
        let surface = built::<T>(&spec)?;
        let (direction, normal) = (w.into(), m.into());
        let vndf = surface.vndf(direction, normal);
        prop_assert!(vndf >= T::ZERO, "D_w = {}", vndf.hex());
        let facing = dot(w, m);
        if facing <= T::ZERO || m[2] < T::ZERO {
            prop_assert!(vndf == T::ZERO, "D_w = {} of what is not seen", vndf.hex());
        } else if vndf.is_finite()
            && vndf > T::lit(16.0) * T::MIN_POSITIVE
            && surface.sigma(direction) > T::MIN_POSITIVE
        {
            // D_w of GGX is not made of D but of one quotient: seven halves of ε here, five on the
            // other side.
            let roundings = if spec.shape == Shape::GGX { 4.5 } else { 2.0 };
            near("D_w σ", vndf * surface.sigma(direction), facing * surface.d(normal), roundings)?;
        }
        Ok(())
    });
}

#[test]
fn single_precision_agrees_with_double() {
    fn agree(spec: &Spec, w: [f32; 3]) -> Outcome {
        let spec = spec.rounded();
        let (narrow, exact) = (built::<f32>(&spec)?, built::<f64>(&spec)?);
        let (v, direction) = (vec3::<f64>(wide(w)), w.into());
        let skew = skewness(&spec);
        // Below the horizon a tail is seen: a Gaussian's exponent is that of the direction's slope.
        let gamma = spec.distribution().gamma;
        let exponent = if w[2] >= 0.0 {
            0.0
        } else if gamma == f64::INFINITY {
            let [x, y] = spec.factor::<f64>().map(|c| c[0] * v.x + c[1] * v.y);
            v.z * v.z / (x * x + y * y)
        } else {
            (gamma - 4.0).max(0.0)
        };
        let area = |name, a: f32, b: f64| near(name, a, b as f32, (8.0 + 3.0 * exponent) * skew);
        // A spline's σ from below is a difference; and next to the nadir the closed mask of α = 1
        // underflows.
        if w[2] >= 0.0 || (spec.mask() == Mask::Exact && exact.sigma(v) > 1e-20) {
            area("σ", narrow.sigma(direction), exact.sigma(v))?;
        }
        if w[2] > 0.0 {
            let brdf = RoughConductor::new(exact.clone(), Perfect::<f64>::new());
            prop_assert!(brdf.eval(v, v) >= 0.0);
            let roundings = roundings_of_d(&spec, wide(w), 0.0) * skew;
            if roundings < 1e5 {
                near("D", narrow.d(direction), exact.d(v) as f32, roundings)?;
            }
        }
        Ok(())
    }
    check(6000, (surface(), anywhere::<f32>()), |(spec, w)| agree(&spec, w));
}
