//! Samples: where they lie, and that densities and weights belong to them.

use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::fresnel::{Fresnel, Schlick};
use microsurface::{Ndf, SampleNdf, SampleVndf};
use proptest::prelude::*;

use super::evaluation::built;
use super::{Outcome, check, for_both_scalars, near, roundings_of_d, skewness};
use crate::scalar::{Scalar, dot, unit, wide};
use crate::strategies::{
    anywhere, distribution, pairs, strictly_above, surface, unit_interval, visible_distribution,
    visible_surface,
};
use crate::surfaces::{Spec, Surface};

for_both_scalars! {
    normals_are_of_the_upper_hemisphere
    visible_normals_are_visible
    a_sample_of_visible_normals_is_that_of_the_reflection
    a_sample_of_all_normals_is_that_of_the_reflection
    a_sample_of_a_mixture_is_that_of_the_reflection
    mixtures_have_the_density_of_the_balance_heuristic
}

fn is_unit<T: Scalar>(v: [T; 3], roundings: f64) -> Outcome {
    let length2: f64 = wide(v).iter().map(|c| c * c).sum();
    let deviation = (length2 - 1.0).abs() / T::EPSILON.to_f64();
    prop_assert!(deviation <= 2.0 * roundings, "|v|² of {v:?} is {deviation} ε off");
    Ok(())
}

fn normals_are_of_the_upper_hemisphere<T: Scalar>() {
    check(5000, (distribution(), unit_interval::<T>(), unit_interval::<T>()), |(spec, u1, u2)| {
        let surface = built::<T>(&spec)?;
        let m: [T; 3] = surface.sample_d([u1, u2].into()).into();
        is_unit(m, 3.0)?;
        prop_assert!(m[2] >= T::ZERO, "m.z = {}", m[2].hex());
        let pdf = surface.pdf_d(m.into());
        prop_assert!(pdf > T::ZERO || m[2] == T::ZERO, "pdf = {} of a sample {m:?}", pdf.hex());
        Ok(())
    });
}

fn visible_normals_are_visible<T: Scalar>() {
    let arguments = (visible_distribution(), anywhere::<T>(), unit_interval::<T>(), unit_interval::<T>());
    check(6000, arguments, |(spec, w, u1, u2)| {
        let surface = built::<T>(&spec)?;
        // Next to the nadir nothing is visible: outside the domain.
        prop_assume!(w[2] >= T::ZERO || surface.sigma(w.into()) >= T::MIN_POSITIVE.sqrt());
        let m: [T; 3] = surface.sample_vndf(w.into(), [u1, u2].into()).into();
        is_unit(m, 8.0)?;
        prop_assert!(m[2] >= T::ZERO, "m.z = {}", m[2].hex());
        prop_assert!(dot(w, m) > T::ZERO, "w·m = {} for m = {m:?}", dot(w, m).hex());
        let density = surface.vndf(w.into(), m.into());
        prop_assert!(density > T::ZERO, "D_w = {} of a sample {m:?}", density.hex());
        Ok(())
    });
}

fn a_sample_of_visible_normals_is_that_of_the_reflection<T: Scalar>() {
    reflected_samples::<T, _>(visible_surface(), VisibleNormals, true);
}

fn a_sample_of_all_normals_is_that_of_the_reflection<T: Scalar>() {
    reflected_samples::<T, _>(surface(), AllNormals, false);
}

fn a_sample_of_a_mixture_is_that_of_the_reflection<T: Scalar>() {
    let mixture = |p: f64| UniformMixture::new(AllNormals, T::lit(p)).expect("below 1");
    reflected_samples::<T, _>(surface(), mixture(0.3), false);
    reflected_samples::<T, _>(surface(), mixture(0.999), false);
    let of_visible = UniformMixture::new(VisibleNormals, T::HALF).expect("below 1");
    reflected_samples::<T, _>(visible_surface(), of_visible, true);
}

/// p/(2π) + (1 − p) times the pdf of the other sampling; no density below the horizon, nor without
/// a half vector but the uniform one; a mixture of a mixture is a mixture.
fn mixtures_have_the_density_of_the_balance_heuristic<T: Scalar>() {
    let arguments = (surface(), pairs::<T>(), unit_interval::<T>());
    check(3000, arguments, |(spec, (i, o), p)| {
        let brdf = RoughConductor::new(built::<T>(&spec)?, Schlick::new(T::lit(0.3)).unwrap())
            .sampled_by(AllNormals);
        let once = UniformMixture::new(AllNormals, p).map_err(|_| TestCaseError::reject("p = 1"))?;
        prop_assert!((once.probability() - p).abs() <= T::HALF * T::HALF * T::EPSILON, "{once:?}");
        let twice = UniformMixture::new(once, T::HALF).expect("below 1");
        let (wi, wo) = (i.into(), o.into());
        let (p, other) = (once.probability(), brdf.pdf(wi, wo));
        let uniform = |p: T| p * T::HALF * T::FRAC_1_PI;
        let above = i[2] > T::ZERO && o[2] > T::ZERO;
        let mix = |p: T, other| if above { uniform(p) + (T::ONE - p) * other } else { T::ZERO };
        let of_one = brdf.clone().sampled_by(once).pdf(wi, wo);
        near("the pdf", of_one, mix(p, other), 4.0)?;
        near("the pdf of both", brdf.clone().sampled_by(twice).pdf(wi, wo), mix(T::HALF, of_one), 4.0)?;
        let below = i.map(|c| -c).into();
        let pdf = brdf.sampled_by(once).pdf(below, wo);
        prop_assert!(pdf == T::ZERO || i[2] == T::ZERO, "{} below the horizon", pdf.hex());
        Ok(())
    });
}

fn reflected_samples<T, S>(surfaces: impl Strategy<Value = Spec>, sampling: S, bounded: bool)
where
    T: Scalar,
    S: NormalSampling<Surface<T>> + Copy,
{
    let arguments = (surfaces, strictly_above::<T>(), unit_interval::<T>(), unit_interval::<T>());
    check(6000, arguments, |(spec, o, u1, u2)| {
        let fresnel = Schlick::new(T::lit(0.3)).unwrap();
        let brdf = RoughConductor::new(built::<T>(&spec)?, fresnel).sampled_by(sampling);
        let wo = o.into();
        let Some(sample) = brdf.sample(wo, [u1, u2].into()) else { return Ok(()) };
        let i: [T; 3] = sample.wi.into();
        is_unit(i, 12.0)?;
        prop_assert!(i[2] > T::ZERO && sample.pdf > T::ZERO, "{sample:?}");
        prop_assert!(sample.weight >= T::ZERO && sample.weight.is_finite(), "{sample:?}");
        let h: [T; 3] = core::array::from_fn(|k| i[k] + o[k]);
        let length = dot(h, h).sqrt();
        if bounded && sampling.constant_density().is_none() {
            let limit = fresnel.reflectance(T::HALF * length) * (T::ONE + T::lit(16.0) * T::EPSILON);
            // The cosine behind the weight is w·m, a few roundings of 1 from |h|/2.
            prop_assert!(
                sample.weight <= limit + T::lit(16.0) * T::EPSILON,
                "{sample:?} above {}",
                limit.hex()
            );
        }
        // Where the half vector is short, wi determines it no longer.
        let (pdf, f) = (brdf.pdf(sample.wi, wo), brdf.eval(sample.wi, wo));
        let m = unit(wide(h));
        let roundings = roundings_of_d(&spec, m, 4.0 / length.to_f64()) * skewness(&spec);
        if roundings * T::EPSILON.to_f64() < 0.05 {
            near("pdf of the sample and of wi", sample.pdf, pdf, 2.0 * roundings)?;
        }
        if length.to_f64() > 1e-3
            && brdf.surface().d_along(h.into()) > T::MIN_POSITIVE
            && f > T::MIN_POSITIVE
            && f < T::MAX
            && pdf > T::MIN_POSITIVE
            && pdf < T::MAX
        {
            // D is in the weight of a mixture.
            let of_d = if sampling.constant_density().is_some() { 2.0 * roundings } else { 0.0 };
            near("weight and f cos/pdf", sample.weight, f / pdf * i[2], 64.0 / length.to_f64() + of_d)?;
        }
        Ok(())
    });
}
