//! Scalar calls, loops and batches: what vectors save, and that they change no number.
//!
//! Errors of f32: relative, of reflected radiance from the same in f64 (a mask by few nodes from the same few nodes), where f64
//! is at least 1e-30; of visible normals as in [`vndf`](crate::vndf). Beside them the textbook's forms.

use std::io::{self, Write};

use microsurface::batch::dispatch::{Level, highest, limit_to};
use microsurface::batch::{Directions, DirectionsMut, NdfBatch, Numbers, ReflectionBatch};
use microsurface::bsdf::RoughConductor;
use microsurface::elementary::{erf, erf_inv};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real, SampleVndf};

use crate::Effort;
use crate::blocks::{Arguments, Call, call, uniform};
use crate::measure::{Errors, Run, pairs_of_times, times};
use crate::report::{Row, report};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};
use crate::vndf::{displacement, extreme, usual};

/// Few enough to stay in the second-level cache.
const TIMED: usize = 1 << 13;
/// The width that is timed, and those that errors are taken of.
const ALPHA: f64 = 0.3;
const ALPHAS: [f64; 4] = [0.01, 0.1, ALPHA, 0.8];
/// Reflectance at normal incidence.
const F0: f64 = 0.9;

/// A scalar that is a Fresnel term's as well.
pub(crate) trait Scalar: Elementary + Spectrum<Scalar = Self> {}
impl<T: Elementary + Spectrum<Scalar = T>> Scalar for T {}

type Brdf<T, N> = RoughConductor<N, Schlick<T>>;

#[inline(always)]
fn eval<T: Scalar, N: Ndf<Scalar = T> + Copy + 'static>(brdf: &Brdf<T, N>, [ix, iy, iz, ox, oy, oz]: [T; 6]) -> [T; 1] {
    [brdf.eval([ix, iy, iz].into(), [ox, oy, oz].into())]
}

#[inline(always)]
fn sample<T: Scalar, N: SampleVndf<Scalar = T> + Copy + 'static>(brdf: &Brdf<T, N>, [x, y, z, u1, u2]: [T; 5]) -> [T; 3] {
    brdf.surface().sample_vndf([x, y, z].into(), [u1, u2].into()).into()
}

#[inline(always)]
fn textbook_ggx<T: Scalar>(&width: &Width<T>, [ix, iy, iz, ox, oy, oz]: [T; 6]) -> [T; 1] {
    [ggx::reflection(width, T::lit(F0), [ix, iy, iz], [ox, oy, oz])]
}

#[inline(always)]
fn textbook_beckmann<T: Scalar>(&width: &Width<T>, [ix, iy, iz, ox, oy, oz]: [T; 6]) -> [T; 1] {
    [beckmann::reflection_walter2007(width, T::lit(F0), [ix, iy, iz], [ox, oy, oz])]
}

#[inline(always)]
fn heitz<T: Scalar>(&widths: &Anisotropic<T>, [x, y, z, u1, u2]: [T; 5]) -> [T; 3] {
    ggx::visible_normal_heitz2018(widths, [x, y, z], [u1, u2])
}

#[inline(always)]
fn jakob<T: Scalar>(&width: &Width<T>, [x, y, z, u1, u2]: [T; 5]) -> [T; 3] {
    beckmann::visible_normal_jakob2014(width, [x, y, z], [u1, u2], erf, erf_inv)
}

#[derive(Clone, Copy)]
struct Eval;
impl<T: Scalar, N: Ndf<Scalar = T> + Copy + 'static> Call<Brdf<T, N>, T, 6, 1> for Eval {
    #[inline(always)]
    fn call(self, brdf: &Brdf<T, N>, arguments: [T; 6]) -> [T; 1] {
        eval(brdf, arguments)
    }
}
#[derive(Clone, Copy)]
struct Sample;
impl<T: Scalar, N: SampleVndf<Scalar = T> + Copy + 'static> Call<Brdf<T, N>, T, 5, 3> for Sample {
    #[inline(always)]
    fn call(self, brdf: &Brdf<T, N>, arguments: [T; 5]) -> [T; 3] {
        sample(brdf, arguments)
    }
}
call!(TextbookGgx<T: Scalar>: (Width<T>), 6 => 1, textbook_ggx);
call!(TextbookBeckmann<T: Scalar>: (Width<T>), 6 => 1, textbook_beckmann);
call!(Heitz<T: Scalar>: (Anisotropic<T>), 5 => 3, heitz);
call!(Jakob<T: Scalar>: (Width<T>), 5 => 3, jakob);

/// Two directions, half of the pairs near the mirror's.
fn pair(rng: &mut rand_pcg::Pcg64Mcg) -> [f64; 6] {
    let [ix, iy, iz, kind, offset] = usual(rng);
    let [ox, oy, oz, ..] = usual(rng);
    if kind < 0.5 {
        return [ix, iy, iz, ox, oy, oz];
    }
    let scale = 10_f64.powf(-3.0 * offset);
    let near = [scale * ox - ix, scale * oy - iy, iz];
    let length = crate::vndf::dot(near, near).sqrt();
    [ix, iy, iz, near[0] / length, near[1] / length, near[2] / length]
}

/// The relative error of radiance.
fn relative(got: f64, exact: f64) -> Option<f64> {
    (exact >= 1e-30).then(|| got / exact - 1.0)
}

/// Everything that is asked about a family, in one scalar.
struct Family<'a, T> {
    name: &'a str,
    effort: &'a Effort,
    pairs: Arguments<T, 6>,
    views: Arguments<T, 5>,
    rows: Vec<Row>,
    runs: Vec<[Run; 2]>,
}

impl<T: Scalar> Family<'_, T> {
    fn row<M: Clone + 'static, const N: usize, const OUT: usize>(
        &mut self,
        (what, name): (&str, &str),
        material: M,
        arguments: &Arguments<T, N>,
        call: impl Call<M, T, N, OUT>,
        errors: Errors,
    ) {
        let group = format!("{}, {what}", self.name);
        let scalar = core::any::type_name::<T>();
        self.rows.push(Row { group, name: name.into(), scalar, errors, ..Row::default() });
        self.runs.push(arguments.timed(&[material], call));
    }
}

fn errors_of_eval<M>(
    effort: &Effort,
    material: impl Fn(f64) -> M,
    call: impl Call<M, f32, 6, 1>,
    exact: impl Fn(f64, [f64; 6]) -> f64,
) -> Errors {
    let materials = ALPHAS.map(material);
    let mut errors = Errors::default();
    Arguments::draw(effort.samples / 4, pair).each(&materials, call, |which, at, [got]| {
        let at = at.map(f64::from);
        if let Some(error) = relative(got.into(), exact(ALPHAS[which], at)) {
            errors.add(error, || {
                let [elevation_i, elevation_o] = [at[2], at[5]].map(|z| z.asin().to_degrees());
                format!("α = {}, {elevation_i:.1}° and {elevation_o:.1}° high", ALPHAS[which])
            });
        }
    });
    errors
}

fn errors_of_normals<M>(
    effort: &Effort,
    material: impl Fn(f64) -> M,
    call: impl Call<M, f32, 5, 3>,
    exact: impl Fn(f64, [f64; 5]) -> ([f64; 3], f64),
) -> Errors {
    let materials = ALPHAS.map(material);
    let mut errors = Errors::default();
    Arguments::draw(effort.samples / 4, extreme).each(&materials, call, |which, at, got| {
        let at = at.map(f64::from);
        let (normal, density) = exact(ALPHAS[which], at);
        errors.add(displacement(got.map(f64::from), normal, density), || {
            format!("α = {}, u = {:.3e}, {:.3e}", ALPHAS[which], at[3], at[4])
        });
    });
    errors
}
