//! Bytes of every material type, in f32 and f64.

use std::io::{self, Write};

use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::filter::gaussian::FilteredGgx;
use microsurface::filter::normal_map::Moments;
use microsurface::filter::quad::Quad;
use microsurface::filter::ray::RayDifferential;
use microsurface::filter::{Covariance, Footprint, deferred, jacobian};
use microsurface::frame::Frame;
use microsurface::fresnel::{Conductor, Dielectric, Perfect, Schlick};
use microsurface::gtr::closed::Closed;
use microsurface::gtr::components::Components;
use microsurface::gtr::mixture::Mixture;
use microsurface::gtr::nodes::{GgxNodes, Nodes};
use microsurface::gtr::spline::Spline;
use microsurface::gtr::table::GtrTable;
use microsurface::transform::{Transformed, tension};
use microsurface::{AxisAligned, Beckmann, Ggx, Gtr, Isotropic, Linear, Microsurface, Real, RoughnessMatrix};

/// A name, and bytes in f32 and f64.
struct Row(&'static str, [usize; 2]);

/// The bytes of a type that is generic over the scalar.
macro_rules! row {
    ($name:literal, |$t:ident| $type:ty) => {{
        type Of<$t> = $type;
        Row($name, [size_of::<Of<f32>>(), size_of::<Of<f64>>()])
    }};
}

/// The bytes of a profile under each map.
macro_rules! under_maps {
    ($name:literal, |$t:ident| $profile:ty) => {
        [
            row!($name, |$t| Microsurface<$profile, Isotropic<$t>>),
            row!($name, |$t| Microsurface<$profile, AxisAligned<$t>>),
            row!($name, |$t| Microsurface<$profile, Linear<$t>>),
        ]
    };
}

/// The bytes of a reflection of isotropic GGX with a scalar and an RGB Fresnel term.
macro_rules! of_spectra {
    ($name:literal, |$s:ident| $fresnel:ty) => {{
        type OfSpectrum<$s> = $fresnel;
        [
            row!($name, |T| RoughConductor<Microsurface<Ggx, Isotropic<T>>, OfSpectrum<T>>),
            row!($name, |T| RoughConductor<Microsurface<Ggx, Isotropic<T>>, OfSpectrum<<T as Real>::Vec3>>),
        ]
    }};
}

pub(crate) fn report(out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "## Bytes\n\nEach as f32 / f64.\n")?;
    table(
        out,
        "| distribution | isotropic | axis-aligned | linear |\n|---|---|---|---|",
        &[
            under_maps!("GGX", |T| Ggx),
            under_maps!("Beckmann", |T| Beckmann),
            under_maps!("GTR, `closed`", |T| Gtr<T, Closed<T, 3>>),
            under_maps!("GTR, `spline`", |T| Gtr<T, Spline<T>>),
            under_maps!("GTR, `heavy_tailed`, 4 nodes", |T| Gtr<T, GgxNodes<T, 4>>),
            under_maps!("GTR, `heavy_tailed`, 8 nodes", |T| Gtr<T, GgxNodes<T, 8>>),
            under_maps!("GTR, `heavy_tailed`, 12 nodes", |T| Gtr<T, GgxNodes<T, 12>>),
            under_maps!("GTR of a `GtrTable`, 8 nodes", |T| Gtr<T, Nodes<T, 8>>),
            under_maps!("GTR, `with_nodes`, 4 nodes", |T| Gtr<T, Mixture<T, 4>>),
            under_maps!("GTR, `isotropic`, 8 nodes", |T| Gtr<T, Mixture<T, 8>>),
            under_maps!("GTR, `with_nodes`, 12 nodes", |T| Gtr<T, Mixture<T, 12>>),
        ],
    )?;
    table(
        out,
        "| reflection of isotropic GGX | scalar | RGB |\n|---|---|---|",
        &[
            of_spectra!("`Perfect`", |S| Perfect<S>),
            of_spectra!("`Schlick`", |S| Schlick<S>),
            of_spectra!("`Dielectric`", |S| Dielectric<S>),
            of_spectra!("`Conductor`", |S| Conductor<S>),
        ],
    )?;
    table(out, "| other | |\n|---|---|", &others().map(|row| [row]))
}

fn others() -> [Row; 21] {
    [
        row!("GGX ⊛ Gaussian, `gaussian::filtered_by_two`", |T| FilteredGgx<T, 1>),
        row!("GGX ⊛ Gaussian, `gaussian::filtered`", |T| FilteredGgx<T, 6>),
        row!("`Transformed` of isotropic GGX", |T| Transformed<Microsurface<Ggx, Isotropic<T>>>),
        row!("`UniformMixture<AllNormals>`", |T| UniformMixture<AllNormals, T>),
        Row("`VisibleNormals`", [size_of::<VisibleNormals>(); 2]),
        Row("`AllNormals`", [size_of::<AllNormals>(); 2]),
        row!("`Components`", |T| Components<T>),
        row!("`GtrTable`, 8 nodes", |T| GtrTable<T, 8>),
        row!("`RoughnessMatrix`", |T| RoughnessMatrix<T>),
        row!("`Frame`", |T| Frame<T>),
        row!("`Footprint`", |T| Footprint<T>),
        row!("`Covariance`", |T| Covariance<T>),
        row!("`Moments` of a normal map", |T| Moments<T>),
        row!("`RayDifferential`", |T| RayDifferential<T>),
        row!("`Quad` of slopes", |T| Quad<T, 2>),
        row!("`deferred::Kernel`", |T| deferred::Kernel<T>),
        row!("`HalfVector`", |T| jacobian::HalfVector<T>),
        row!("`Motion`", |T| jacobian::Motion<T>),
        row!("`Curvature`", |T| jacobian::Curvature<T>),
        row!("`tension::Mean`", |T| tension::Mean<T>),
        row!("`Sample`", |T| microsurface::bsdf::Sample<T, T>),
    ]
}

fn table<const N: usize>(out: &mut impl Write, head: &str, rows: &[[Row; N]]) -> io::Result<()> {
    writeln!(out, "{head}")?;
    for row in rows {
        write!(out, "| {} |", row[0].0)?;
        for Row(_, [single, double]) in row {
            write!(out, " {single} / {double} |")?;
        }
        writeln!(out)?;
    }
    writeln!(out)
}
