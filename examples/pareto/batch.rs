//! Scalar calls, loops and batches: what vectors save, and that they change no number.
//!
//! Errors of f32: relative, of reflected radiance from the same in f64 (a mask by few nodes from
//! the same few nodes), where f64 is at least 1e-30; of visible normals as in
//! [`vndf`](crate::vndf). Beside them the textbook's forms.

use core::hint::black_box;
use std::io::{self, Write};

use microsurface::batch::simd::{Level, highest, limit_to};
use microsurface::batch::{
    Directions, DirectionsMut, Material, NdfBatch, Numbers, ReflectionBatch, StagedVndf,
};
use microsurface::bsdf::RoughConductor;
use microsurface::elementary::{erf, erf_inv};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real, SampleVndf};

use rand_pcg::Pcg64Mcg;

use crate::Effort;
use crate::blocks::{Arguments, Call, call};
use crate::measure::{Errors, Run, times};
use crate::report::{Row, report};
use crate::textbook::{Anisotropic, Elementary, Width, beckmann, ggx};
use crate::vndf::{displacement, extreme, usual};

/// Few enough to stay in the second-level cache.
const TIMED: usize = 1 << 13;
const CALLS: u32 = 1 << 13;
/// The width that is timed, and those that errors are taken of.
const ALPHA: f64 = 0.3;
const ALPHAS: [f64; 4] = [0.01, 0.1, ALPHA, 0.8];
const GAMMA: f64 = 1.5;
/// Reflectance at normal incidence.
const F0: f64 = 0.9;

/// A scalar that is a Fresnel term's as well.
pub(crate) trait Scalar: Elementary + Spectrum<Scalar = Self> {}
impl<T: Elementary + Spectrum<Scalar = T>> Scalar for T {}

type Brdf<T, N> = RoughConductor<N, Schlick<T>>;

#[inline(always)]
fn eval<T: Scalar, N: Ndf<Scalar = T> + Copy + 'static>(
    brdf: &Brdf<T, N>,
    [ix, iy, iz, ox, oy, oz]: [T; 6],
) -> [T; 1] {
    [brdf.eval([ix, iy, iz].into(), [ox, oy, oz].into())]
}

#[inline(always)]
fn sample<T: Scalar, N: SampleVndf<Scalar = T> + Copy + 'static>(
    brdf: &Brdf<T, N>,
    [x, y, z, u1, u2]: [T; 5],
) -> [T; 3] {
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
fn pair(rng: &mut Pcg64Mcg) -> [f64; 6] {
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

/// What is asked in one scalar, and its rows by their runs.
struct Questions<T> {
    pairs: Arguments<T, 6>,
    views: Arguments<T, 5>,
    rows: Vec<Row>,
    /// Each with the row and the kind of time that it is for.
    runs: Vec<(usize, usize, Run)>,
}

/// The levels, and what they are called.
const LEVELS: [(&str, Level); 3] =
    [("batch", Level::Target), ("batch, AVX2", Level::Avx2), ("batch, AVX-512", Level::Avx512)];

impl<T: Scalar> Questions<T> {
    fn new() -> Self {
        let (pairs, views) = (Arguments::draw(TIMED, pair), Arguments::draw(TIMED, usual));
        Self { pairs, views, rows: Vec::new(), runs: Vec::new() }
    }

    fn row(&mut self, group: &str, name: &str, errors: &Errors, runs: [Option<Run>; 2]) {
        let (group, scalar, errors) = (group.into(), core::any::type_name::<T>(), errors.clone());
        for (time, run) in runs.into_iter().enumerate() {
            self.runs.extend(run.map(|run| (self.rows.len(), time, run)));
        }
        self.rows.push(Row { group, name: name.into(), scalar, errors, ..Row::default() });
    }

    /// Calls, loops and batches of a family; errors of radiance and of normals.
    fn family<N>(&mut self, name: &str, surface: N, [of_eval, of_normals]: &[Errors; 2])
    where
        N: StagedVndf<Scalar = T> + Material<Local = N> + 'static,
    {
        let brdf = RoughConductor::new(surface, Schlick::new(T::lit(F0)).expect("a share"));
        let eval = format!("{name}: eval");
        let timed = self.pairs.timed(&[brdf], Eval).map(Some);
        self.row(&eval, "call and loop", of_eval, timed);
        for (name, level) in LEVELS.into_iter().filter(|&(_, level)| level <= highest()) {
            let ([ix, iy, iz, ox, oy, oz], mut out) = (self.pairs.arrays(), vec![T::ZERO; TIMED]);
            let run = Run::new(CALLS, move || {
                limit_to(level);
                let (wi, wo) = (Directions { x: &ix, y: &iy, z: &iz }, Directions { x: &ox, y: &oy, z: &oz });
                brdf.eval_batch(wi, wo, black_box(&mut out));
            });
            self.row(&eval, name, of_eval, [None, Some(run)]);
        }
        let normals = format!("{name}: visible normals");
        let timed = self.views.timed(&[brdf], Sample).map(Some);
        self.row(&normals, "call and loop", of_normals, timed);
        for (name, level) in LEVELS.into_iter().filter(|&(_, level)| level <= highest()) {
            let ([x, y, z, u1, u2], mut out) = (self.views.arrays(), [(); 3].map(|()| vec![T::ZERO; TIMED]));
            let run = Run::new(CALLS, move || {
                limit_to(level);
                let [mx, my, mz] = black_box(&mut out);
                let wm = DirectionsMut { x: mx, y: my, z: mz };
                surface.sample_vndf_batch(Directions { x: &x, y: &y, z: &z }, Numbers { x: &u1, y: &u2 }, wm);
            });
            self.row(&normals, name, of_normals, [None, Some(run)]);
        }
    }

    /// The textbook's forms; they are scalar.
    fn textbook<M: Clone + 'static, const N: usize, const OUT: usize>(
        &mut self,
        (group, name): (&str, &str),
        material: M,
        arguments: &Arguments<T, N>,
        call: impl Call<M, T, N, OUT>,
        errors: &Errors,
    ) {
        self.row(group, name, errors, arguments.timed(&[material], call).map(Some));
    }

    fn all(mut self, errors: &[[Errors; 2]; 5]) -> (Vec<Row>, Vec<(usize, usize, Run)>) {
        let alpha = T::lit(ALPHA);
        let (pairs, views) = (self.pairs.clone(), self.views.clone());
        let [ggx, beckmann, gtr, of_ggx, of_beckmann] = errors;
        let widths = Anisotropic { alpha_x: alpha, alpha_y: alpha };
        self.family("GGX", Ggx::isotropic(alpha).expect("a width"), ggx);
        self.textbook(("GGX: eval", "textbook"), Width::new(alpha), &pairs, TextbookGgx, &of_ggx[0]);
        self.textbook(("GGX: visible normals", "Heitz 2018"), widths, &views, Heitz, &of_ggx[1]);
        self.family("Beckmann", Beckmann::isotropic(alpha).expect("a width"), beckmann);
        let name = ("Beckmann: eval", "textbook, Walter's mask");
        self.textbook(name, Width::new(alpha), &pairs, TextbookBeckmann, &of_beckmann[0]);
        let name = ("Beckmann: visible normals", "Jakob 2014");
        self.textbook(name, Width::new(alpha), &views, Jakob, &of_beckmann[1]);
        self.family("GTR, γ = 1.5", Gtr::isotropic(alpha, T::lit(GAMMA)).expect("a width"), gtr);
        (self.rows, self.runs)
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
    draw: fn(&mut Pcg64Mcg) -> [f64; 5],
    exact: impl Fn(f64, [f64; 5]) -> ([f64; 3], f64),
) -> Errors {
    let materials = ALPHAS.map(material);
    let mut errors = Errors::default();
    Arguments::draw(effort.samples / 4, draw).each(&materials, call, |which, at, got| {
        let at = at.map(f64::from);
        let (normal, density) = exact(ALPHAS[which], at);
        errors.add(displacement(got.map(f64::from), normal, density), || {
            format!("α = {}, u = {:.3e}, {:.3e}", ALPHAS[which], at[3], at[4])
        });
    });
    errors
}

/// A family's errors of radiance and of normals, those of the crate and of the textbook, from the
/// family in f64.
fn exact_eval<N: Ndf<Scalar = f64>>(surface: N, at: [f64; 6]) -> f64 {
    let [ix, iy, iz, ox, oy, oz] = at;
    RoughConductor::new(surface, Schlick::new(f64::from(f32::lit(F0))).expect("a share"))
        .eval([ix, iy, iz].into(), [ox, oy, oz].into())
}

#[inline(never)]
fn exact_normal<N: SampleVndf<Scalar = f64>>(surface: N, [x, y, z, u1, u2]: [f64; 5]) -> ([f64; 3], f64) {
    let (w, u) = ([x, y, z].into(), [u1, u2].into());
    let normal = surface.sample_vndf(w, u);
    (normal.into(), surface.vndf(w, normal))
}

/// Errors of a family.
fn errors<N, W>(
    effort: &Effort,
    draw: fn(&mut Pcg64Mcg) -> [f64; 5],
    single: impl Fn(f32) -> N + Copy,
    double: impl Fn(f64) -> W + Copy,
) -> [Errors; 2]
where
    N: SampleVndf<Scalar = f32> + Copy + 'static,
    W: SampleVndf<Scalar = f64> + Copy,
{
    let brdf =
        |alpha| RoughConductor::new(single(f32::lit(alpha)), Schlick::new(f32::lit(F0)).expect("a share"));
    let wide = |alpha: f64| double(f32::lit(alpha).into());
    [
        errors_of_eval(effort, brdf, Eval, |alpha, at| exact_eval(wide(alpha), at)),
        errors_of_normals(effort, brdf, Sample, draw, |alpha, at| exact_normal(wide(alpha), at)),
    ]
}

pub(crate) fn run(effort: &Effort, out: &mut impl Write) -> io::Result<()> {
    let ggx = |alpha: f64| Ggx::isotropic(f64::from(f32::lit(alpha))).expect("a width");
    let beckmann = |alpha: f64| Beckmann::isotropic(f64::from(f32::lit(alpha))).expect("a width");
    let width = |alpha| Width::new(f32::lit(alpha));
    let widths = |alpha: f64| Anisotropic { alpha_x: f32::lit(alpha), alpha_y: f32::lit(alpha) };
    let wide_widths =
        |alpha: f64| Anisotropic { alpha_x: f64::from(f32::lit(alpha)), alpha_y: f32::lit(alpha).into() };
    let all = [
        errors(
            effort,
            extreme,
            |a| Ggx::isotropic(a).expect("a width"),
            |a| Ggx::isotropic(a).expect("a width"),
        ),
        errors(
            effort,
            extreme,
            |a| Beckmann::isotropic(a).expect("a width"),
            |a| Beckmann::isotropic(a).expect("a width"),
        ),
        errors(
            effort,
            usual,
            |a| Gtr::isotropic(a, f32::lit(GAMMA)).expect("a width"),
            |a| Gtr::isotropic(a, GAMMA).expect("a width"),
        ),
        [
            errors_of_eval(effort, width, TextbookGgx, |alpha, at| exact_eval(ggx(alpha), at)),
            errors_of_normals(effort, widths, Heitz, extreme, |alpha, at| {
                let normal = heitz(&wide_widths(alpha), at);
                (normal, ggx(alpha).vndf([at[0], at[1], at[2]].into(), normal.into()))
            }),
        ],
        [
            errors_of_eval(effort, width, TextbookBeckmann, |alpha, at| exact_eval(beckmann(alpha), at)),
            errors_of_normals(effort, width, Jakob, extreme, |alpha, at| exact_normal(beckmann(alpha), at)),
        ],
    ];
    let (mut rows, mut runs) = Questions::<f32>::new().all(&all);
    let (wide_rows, wide_runs) = Questions::<f64>::new().all(&Default::default());
    runs.extend(wide_runs.into_iter().map(|(row, time, run)| (row + rows.len(), time, run)));
    rows.extend(wide_rows);
    let (places, mut runs): (Vec<_>, Vec<_>) =
        runs.into_iter().map(|(row, time, run)| ((row, time), run)).unzip();
    for ((row, time), ns) in places.into_iter().zip(times(&mut runs, effort.rounds)) {
        rows[row].ns[time] = Some(ns);
    }
    limit_to(highest());
    report(out, effort, "batch", "Calls, loops and batches", &rows)
}
