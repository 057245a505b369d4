//! What is counted.

use alloc::rc::Rc;

use microsurface::bsdf::RoughConductor;
use microsurface::filter::{Covariance, Footprint, gaussian, projected};
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Perfect, Schlick, Spectrum};
use microsurface::glam::{Mat2, Vec2, Vec3};
use microsurface::transform::Transformed;
use microsurface::{
    Beckmann, Error, Ggx, Gtr, Isotropic, Microsurface, Ndf, Real, RoughnessMatrix, SampleVndf,
    profile::SampleVisibleProfile,
};

use crate::batches::batches;
use crate::kernel::{Arguments, Claim, Kernel, Row, Table};

const ALPHA: f64 = 0.3;
const F0: f64 = 0.9;
/// The columns of a matrix that shears and turns.
const MATRIX: [[f64; 2]; 2] = [[0.8, 0.3], [-0.4, 1.1]];
const INVALID: &str = "within the ranges of the constructors";

/// All tables, of functions called with `calls` arguments.
pub(crate) fn all(calls: u32) -> Vec<Table> {
    let arguments = Arguments::many(calls);
    vec![
        by_map::<f32>("f32", &arguments),
        by_map::<f64>("f64", &Arguments::many(calls)),
        Table {
            head: "GGX reflection, f32",
            columns: &["eval"],
            rows: surfaces(&arguments).expect(INVALID),
            claim: Claim::LinearAlike,
        },
        Table {
            head: "GGX reflection, isotropic, f32, eval",
            columns: &["scalar", "RGB"],
            rows: spectra(&arguments).expect(INVALID),
            claim: Claim::Rising,
        },
        Table {
            head: "per element, isotropic, f32, vectors of the build's target",
            columns: &["scalar call", "batch of 1", "of 64", "of 1024"],
            rows: batches(&arguments).expect(INVALID),
            claim: Claim::Nothing,
        },
    ]
}

/// Every function of every distribution under every map: of the same distribution, in numbers the
/// map could be spared for, so that branches are taken alike and only the maps' code differs.
fn by_map<T: Real + Spectrum<Scalar = T>>(head: &'static str, arguments: &Rc<[Arguments<T>]>) -> Table {
    let (alpha, gamma) = (T::lit(ALPHA), T::lit(1.5));
    let mut rows = Vec::new();
    rows.extend(under_maps("GGX", &Ggx::isotropic(alpha).expect(INVALID), arguments));
    rows.extend(under_maps("Beckmann", &Beckmann::isotropic(alpha).expect(INVALID), arguments));
    rows.extend(under_maps("GTR 1.5", &Gtr::isotropic(alpha, gamma).expect(INVALID), arguments));
    let nothing = || Kernel::of_calls((), arguments, |(), _| ());
    rows.push(Row { name: "no call: the loop".into(), kernels: vec![nothing(), nothing(), nothing()] });
    Table { head, columns: &["isotropic", "axis-aligned", "linear"], rows, claim: Claim::Rising }
}

fn under_maps<T: Real + Spectrum<Scalar = T>, P: SampleVisibleProfile<T> + 'static>(
    profile: &str,
    surface: &Microsurface<P, Isotropic<T>>,
    arguments: &Rc<[Arguments<T>]>,
) -> Vec<Row>
where
    Microsurface<P, Isotropic<T>>: Ndf<Scalar = T>,
{
    let stretched = surface.stretched(T::ZERO).expect(INVALID);
    let moved = surface.transformed(T::matrix([[T::ONE, T::ZERO], [T::ZERO, T::ONE]])).expect(INVALID);
    let (isotropic, axis_aligned, linear) =
        (functions(*surface, arguments), functions(stretched, arguments), functions(moved, arguments));
    isotropic
        .into_iter()
        .zip(axis_aligned)
        .zip(linear)
        .map(|((isotropic, axis_aligned), linear)| Row {
            name: format!("{profile} {}", isotropic.0),
            kernels: vec![isotropic.1, axis_aligned.1, linear.1],
        })
        .collect()
}

/// Every function of a surface.
fn functions<T: Real + Spectrum<Scalar = T>, N: SampleVndf + Ndf<Scalar = T> + Copy + 'static>(
    surface: N,
    arguments: &Rc<[Arguments<T>]>,
) -> [(&'static str, Kernel); 9] {
    let brdf = RoughConductor::new(surface, Schlick::new(T::lit(F0)).expect("a share"));
    [
        ("d", Kernel::of_calls(surface, arguments, |n, a| n.d(a.wm))),
        ("sigma", Kernel::of_calls(surface, arguments, |n, a| n.sigma(a.wo))),
        ("g1", Kernel::of_calls(surface, arguments, |n, a| n.g1(a.wo, a.wm))),
        ("g2", Kernel::of_calls(surface, arguments, |n, a| n.g2(a.wi, a.wo, a.wm))),
        ("vndf", Kernel::of_calls(surface, arguments, |n, a| n.vndf(a.wo, a.wm))),
        ("sample_vndf", Kernel::of_calls(surface, arguments, |n, a| n.sample_vndf(a.wo, a.u))),
        ("eval", Kernel::of_calls(brdf, arguments, |f, a| f.eval(a.wi, a.wo))),
        ("pdf", Kernel::of_calls(brdf, arguments, |f, a| f.pdf(a.wi, a.wo))),
        ("sample", Kernel::of_calls(brdf, arguments, |f, a| f.sample(a.wo, a.u))),
    ]
}

/// f of a surface with Schlick's Fresnel term.
fn eval<N: Ndf<Scalar = f32> + 'static>(name: &str, surface: N, arguments: &Rc<[Arguments<f32>]>) -> Row {
    let brdf = RoughConductor::new(surface, Schlick::new(0.9_f32).expect("a share"));
    let kernel = Kernel::of_calls(brdf, arguments, |f, a| f.eval(a.wi, a.wo));
    Row { name: name.into(), kernels: vec![kernel] }
}

/// Surfaces by the way they were made: what is not used costs nothing.
fn surfaces(arguments: &Rc<[Arguments<f32>]>) -> Result<Vec<Row>, Error> {
    let isotropic = Ggx::isotropic(0.3_f32)?;
    let anisotropic = Ggx::anisotropic(0.2_f32, 0.4)?;
    let matrix = Mat2::from_cols_array_2d(&MATRIX.map(|column| column.map(f32::lit)));
    let turned = RoughnessMatrix::rotated(0.2_f32, 0.4, 0.5)?;
    let footprint = Footprint::new(Vec2::new(0.1, 0.02), Vec2::new(-0.03, 0.06));
    let covariance: Covariance<f32> = footprint.covariance(0.25);
    let chrome = RoughConductor::new(isotropic, Schlick::new(0.9_f32)?);
    let over = Kernel::of_calls(chrome, arguments, move |f, a| f.eval_over(a.wi, a.wo, footprint));
    Ok(vec![
        eval("`isotropic`", isotropic, arguments),
        eval("`filtered_isotropic`: isotropic", isotropic.filtered_isotropic(0.01)?, arguments),
        eval("`anisotropic`", anisotropic, arguments),
        eval("isotropic `stretched`: axis-aligned", isotropic.stretched(0.3)?, arguments),
        eval(
            "`filtered_axis_aligned`: axis-aligned",
            anisotropic.filtered_axis_aligned([0.01, 0.02])?,
            arguments,
        ),
        eval("`from_roughness_matrix`: linear", Ggx::from_roughness_matrix(turned), arguments),
        eval("isotropic `transformed`: linear", isotropic.transformed(matrix)?, arguments),
        eval("isotropic `filtered`, A + 2Σ: linear", isotropic.filtered(covariance)?, arguments),
        eval(
            "transformed and `filtered`: linear",
            isotropic.transformed(matrix)?.filtered(covariance)?,
            arguments,
        ),
        eval("`projected::filtered`: linear", projected::filtered(&isotropic, footprint, 0.25)?, arguments),
        eval("`transform::Transformed`, a wrapper", Transformed::new(isotropic, matrix)?, arguments),
        eval("`gaussian::filtered_by_two`", gaussian::filtered_by_two(&isotropic, covariance)?, arguments),
        eval("`gaussian::filtered`", gaussian::filtered(&isotropic, covariance)?, arguments),
        Row { name: "`eval_over` a footprint".into(), kernels: vec![over] },
    ])
}

/// Fresnel terms of one and of three channels.
fn spectra(arguments: &Rc<[Arguments<f32>]>) -> Result<Vec<Row>, Error> {
    let surface = Ggx::isotropic(0.3_f32)?;
    let (f0, n, k) = (Vec3::new(1.0, 0.7, 0.3), Vec3::new(0.2, 0.5, 1.3), Vec3::new(3.9, 2.4, 1.8));
    let row = |name: &str, kernels| Row { name: name.into(), kernels };
    Ok(vec![
        row(
            "`Perfect`",
            vec![
                of_fresnel(surface, Perfect::<f32>::new(), arguments),
                of_fresnel(surface, Perfect::<Vec3>::new(), arguments),
            ],
        ),
        row(
            "`Schlick`",
            vec![
                of_fresnel(surface, Schlick::new(f0.x)?, arguments),
                of_fresnel(surface, Schlick::new(f0)?, arguments),
            ],
        ),
        row(
            "`Dielectric`",
            vec![
                of_fresnel(surface, Dielectric::new(n.z)?, arguments),
                of_fresnel(surface, Dielectric::new(k)?, arguments),
            ],
        ),
        row(
            "`Conductor`",
            vec![
                of_fresnel(surface, Conductor::new(n.x, k.x)?, arguments),
                of_fresnel(surface, Conductor::new(n, k)?, arguments),
            ],
        ),
    ])
}

fn of_fresnel<N, F>(surface: N, fresnel: F, arguments: &Rc<[Arguments<f32>]>) -> Kernel
where
    N: Ndf<Scalar = f32> + 'static,
    F: Fresnel<Output: Spectrum<Scalar = f32>> + 'static,
{
    Kernel::of_calls(RoughConductor::new(surface, fresnel), arguments, |f, a| f.eval(a.wi, a.wo))
}
