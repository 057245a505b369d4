//! The cost of a filter per pixel: knowing the footprint, making the filtered surface,
//! evaluating it?
//!
//! Every call has its own pixel, so that nothing of a filter is made once for many: steps of the
//! half vector from 1e-4 to 1 in slopes, in any two directions, and a slope in or beside the
//! footprint. The widths are about 0.01, one for each of the materials.

use core::f64::consts::TAU;

use criterion::Criterion;
use microsurface::filter::MeanOverParallelogram;
use microsurface::filter::deferred::{self, Bound};
use microsurface::filter::jacobian::{Curvature, HalfVector, Motion};
use microsurface::filter::quad::Quad;
use microsurface::filter::{Covariance, Footprint, covariance, gaussian, polygon, projected, rectangle};
use microsurface::frame::{Frame, normal_to_slope};
use microsurface::{Beckmann, Ggx, Gtr, Isotropic, Microsurface, Ndf, Real, elementary};
use rand::{Rng, RngExt};

use crate::input::{CALLS, calls, direction, generator, group, materials};
use crate::textbook::{Elementary, filter as textbook};

/// What a pixel knows of its half vectors.
#[derive(Clone, Copy)]
struct Pixel<T: Real> {
    slope: T::Vec2,
    footprint: Footprint<T>,
    covariance: Covariance<T>,
}

/// Widths of one decade about 0.01.
fn narrow<T: Real, N>(surface: impl Fn(T) -> Option<N>) -> Vec<N> {
    materials(|alpha: T| surface(T::lit(0.03 * alpha.to_f64().sqrt())))
}

/// A vector of this length, in any direction.
fn turned(rng: &mut impl Rng, length: f64) -> [f64; 2] {
    let (sin, cos) = rng.random_range(0.0..TAU).sin_cos();
    [length * cos, length * sin]
}

fn pixels<T: Real>() -> Vec<Pixel<T>> {
    let mut rng = generator();
    let mut pixel = || {
        let [u, v] = [(); 2].map(|()| {
            let length = 10_f64.powf(rng.random_range(-4.0..0.0));
            turned(&mut rng, length)
        });
        let [a, b] = [(); 2].map(|()| rng.random_range(-1.0..1.0));
        let beside = turned(&mut rng, 0.01);
        let slope = [0, 1].map(|i| T::lit(a * u[i] + b * v[i] + beside[i])).into();
        let footprint = Footprint::new(u.map(T::lit), v.map(T::lit));
        let covariance = footprint.covariance(T::lit(covariance::variance_of_box::<f64>()));
        Pixel { slope, footprint, covariance }
    };
    (0..CALLS).map(|_| pixel()).collect()
}

pub(crate) fn bench(criterion: &mut Criterion) {
    gaussians::<f32>(criterion);
    gaussians::<f64>(criterion);
    means::<f32>(criterion);
    means::<f64>(criterion);
    deferred::<f32>(criterion);
    footprints::<f32>(criterion);
    footprints::<f64>(criterion);
    angles::<f32>(criterion);
    angles::<f64>(criterion);
}

/// P22 of a filtered surface; NaN where it was refused, which no pixel here is.
#[inline(always)]
fn p22_of<N: Ndf, E>(filtered: Result<N, E>, slope: <N::Scalar as Real>::Vec2) -> N::Scalar {
    filtered.map_or(N::Scalar::lit(f64::NAN), |surface| surface.p22(slope))
}

/// Convolutions with a Gaussian: the surface alone, with P22, and P22 of a surface made before.
fn gaussians<T: Elementary>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "filter-gaussian");
    let group = &mut group;
    let pixels = pixels::<T>();
    let ggx = narrow(|alpha: T| Ggx::isotropic(alpha).ok());
    let aligned = narrow(|alpha: T| Ggx::anisotropic(alpha, T::TWO * alpha).ok());
    let quarter = T::lit(0.25);

    calls(group, ("unfiltered", "p22"), &ggx, &pixels, |s, p| s.p22(p.slope));
    calls(group, ("change-by-filter", "1"), &ggx, &pixels, |s, p| s.change_by_filter(p.covariance));
    calls(group, ("change-by-filter-at", "1"), &ggx, &pixels, |s, p| {
        s.change_by_filter_at(p.slope, p.covariance)
    });
    calls(group, ("covariance", "make"), &ggx, &pixels, |_, p| p.footprint.covariance(quarter));

    calls(group, ("filtered", "make"), &ggx, &pixels, |s, p| s.filtered(p.covariance));
    calls(group, ("filtered", "make+p22"), &ggx, &pixels, |s, p| p22_of(s.filtered(p.covariance), p.slope));
    calls(group, ("filtered-isotropic", "make+p22"), &ggx, &pixels, |s, p| {
        p22_of(s.filtered_isotropic(p.covariance.trace()), p.slope)
    });
    calls(group, ("filtered-axis-aligned", "make+p22"), &aligned, &pixels, |s, p| {
        let [xx, _, yy] = p.covariance.entries();
        p22_of(s.filtered_axis_aligned([xx, yy]), p.slope)
    });
    calls(group, ("projected", "make"), &ggx, &pixels, |s, p| projected::filtered(s, p.footprint, quarter));
    calls(group, ("projected", "make+p22"), &ggx, &pixels, |s, p| {
        p22_of(projected::filtered(s, p.footprint, quarter), p.slope)
    });
    calls(group, ("projected-by", "make+p22"), &ggx, &pixels, |s, p| {
        p22_of(projected::filtered_by(s, p.covariance), p.slope)
    });
    calls(group, ("gaussian-by-two", "make"), &ggx, &pixels, |s, p| {
        gaussian::filtered_by_two(s, p.covariance)
    });
    calls(group, ("gaussian-by-two", "make+p22"), &ggx, &pixels, |s, p| {
        p22_of(gaussian::filtered_by_two(s, p.covariance), p.slope)
    });
    calls(group, ("gaussian", "make"), &ggx, &pixels, |s, p| gaussian::filtered(s, p.covariance));
    calls(group, ("gaussian", "make+p22"), &ggx, &pixels, |s, p| {
        p22_of(gaussian::filtered(s, p.covariance), p.slope)
    });
    calls(group, ("gaussian-integral", "p22"), &ggx, &pixels, |s, p| gaussian::p22(s, p.slope, p.covariance));

    // Made before, one for each material.
    let made: Vec<_> = ggx.iter().zip(&pixels).filter_map(|(s, p)| s.filtered(p.covariance).ok()).collect();
    calls(group, ("filtered", "p22"), &made, &pixels, |s, p| s.p22(p.slope));
    let by_two = ggx.iter().zip(&pixels).filter_map(|(s, p)| gaussian::filtered_by_two(s, p.covariance).ok());
    calls(group, ("gaussian-by-two", "p22"), &by_two.collect::<Vec<_>>(), &pixels, |s, p| s.p22(p.slope));
    let by_seven = ggx.iter().zip(&pixels).filter_map(|(s, p)| gaussian::filtered(s, p.covariance).ok());
    calls(group, ("gaussian", "p22"), &by_seven.collect::<Vec<_>>(), &pixels, |s, p| s.p22(p.slope));
    calls(group, ("textbook-proxy", "rectangle"), &ggx, &pixels, |s, p| {
        let alpha = s.map().alpha();
        textbook::proxy_of_rectangle([alpha; 2], p.slope.into(), p.footprint.steps().map(Into::into))
    });
}

/// Means over what the half vector covers.
fn means<T: Elementary>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "filter-mean");
    let group = &mut group;
    let pixels = pixels::<T>();
    let ggx = narrow(|alpha: T| Ggx::isotropic(alpha).ok());
    let beckmann = narrow(|alpha: T| Beckmann::isotropic(alpha).ok());
    let gtr = narrow(|alpha: T| Gtr::isotropic(alpha, T::lit(1.5)).ok());

    calls(group, ("ggx", "parallelogram"), &ggx, &pixels, over_parallelogram);
    calls(group, ("ggx", "rectangle"), &ggx, &pixels, over_rectangle);
    calls(group, ("beckmann", "parallelogram"), &beckmann, &pixels, over_parallelogram);
    calls(group, ("beckmann", "rectangle"), &beckmann, &pixels, over_rectangle);
    calls(group, ("gtr-1.5", "parallelogram"), &gtr, &pixels, over_parallelogram);
    calls(group, ("textbook-ggx", "rectangle"), &ggx, &pixels, |s, p| {
        let alpha = s.map().alpha();
        textbook::mean_of_rectangle([alpha; 2], p.slope.into(), p.footprint.steps().map(Into::into))
    });
}

fn over_parallelogram<T: Real, P: MeanOverParallelogram<T>>(
    surface: &Microsurface<P, Isotropic<T>>,
    pixel: Pixel<T>,
) -> T {
    let [du, dv] = pixel.footprint.steps();
    polygon::mean_p22(surface, pixel.slope, du, dv)
}

fn over_rectangle<T: Real, P: MeanOverParallelogram<T>>(
    surface: &Microsurface<P, Isotropic<T>>,
    pixel: Pixel<T>,
) -> T {
    let [x, y]: [T; 2] = pixel.footprint.extents().into();
    rectangle::mean_p22(surface, pixel.slope, [T::HALF * x, T::HALF * y].into())
}

/// α' before any light is known.
fn deferred<T: Real>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "filter-deferred");
    let group = &mut group;
    let pixels = pixels::<T>();
    let alphas = narrow(|alpha: T| Some(alpha));
    let kernel = deferred::Kernel::tokuyoshi2019();

    calls(group, ("isotropic", "footprint"), &alphas, &pixels, |&alpha, p| {
        deferred::isotropic(alpha, p.footprint, &kernel, Bound::Upper)
    });
    calls(group, ("isotropic", "normals"), &alphas, &pixels, |&alpha, p| {
        let [du, dv] = p.footprint.steps().map(|step| {
            let [x, y]: [T; 2] = step.into();
            [x, y, T::ZERO].into()
        });
        deferred::isotropic_from_normals(alpha, du, dv, &kernel, Bound::Upper)
    });
    calls(group, ("max-eigenvalue", "footprint"), &alphas, &pixels, |&alpha, p| {
        deferred::max_eigenvalue(alpha, p.footprint, &kernel)
    });
    calls(group, ("rectangle", "footprint"), &alphas, &pixels, |&alpha, p| {
        deferred::rectangle([alpha; 2], p.footprint, &kernel)
    });
    calls(group, ("rectangle-maximum", "footprint"), &alphas, &pixels, |&alpha, p| {
        deferred::rectangle_maximum(alpha, p.footprint, &kernel)
    });
    let frames: Vec<[Frame<T>; 4]> = quads();
    calls(group, ("quad-in-slopes", "frames"), &alphas, &frames, |_, quad| deferred::quad_in_slopes(&quad));
    calls(group, ("quad-projected", "frames"), &alphas, &frames, |_, quad| deferred::quad_projected(&quad));
}

/// The frames of four neighbouring pixels.
fn quads<T: Real>() -> Vec<[Frame<T>; 4]> {
    let mut rng = generator();
    let mut quad = || {
        let bend = 10_f64.powf(rng.random_range(-3.0..-1.0));
        let base = direction::<f64>(&mut rng);
        [(); 4].map(|()| {
            let normal = base.map(|c| c + bend * rng.random_range(-1.0..1.0));
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            Frame::from_normal(normal.map(|c| T::lit(c / length)))
        })
    };
    (0..CALLS).map(|_| quad()).collect()
}

/// A point on a surface, where eye and lamp are, and the steps to the next pixels.
#[derive(Clone, Copy)]
struct Shaded<T: Real> {
    frame: Frame<T>,
    eye: T::Vec3,
    light: T::Vec3,
    curvature: Curvature<T>,
    steps: [T::Vec3; 2],
}

/// The footprint of a half vector, from derivatives and from four pixels.
fn footprints<T: Real>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "footprint");
    let group = &mut group;
    let mut rng = generator();
    let mut shaded = || {
        let [eye, light] = [(); 2].map(|()| direction::<T>(&mut rng).map(|c| T::lit(5.0) * c).into());
        let bend = 0.01 * rng.random_range(0.1..1.0);
        Shaded {
            frame: Frame::from_normal([T::ZERO, T::ZERO, T::ONE]),
            eye,
            light,
            curvature: Curvature::sphere(T::lit(rng.random_range(0.1..10.0))),
            steps: [[bend, 0.0, 0.0], [0.0, bend, 0.0]].map(|step| step.map(T::lit).into()),
        }
    };
    let shaded: Vec<Shaded<T>> = (0..CALLS).map(|_| shaded()).collect();
    let origin = [T::ZERO; 3];
    let half = |at: &Shaded<T>| HalfVector::<T>::new(&at.frame, origin.into(), at.eye, at.light);
    let motions = |at: &Shaded<T>| {
        at.steps.map(|point| {
            let normal = at.curvature.normal_step(&at.frame, point);
            Motion { point, normal, ..Motion::default() }
        })
    };
    calls(group, ("half-vector", "slope"), &[()], &shaded, |(), at| half(&at).slope());
    calls(group, ("half-vector", "slope-footprint"), &[()], &shaded, |(), at| {
        let [du, dv] = motions(&at);
        half(&at).slope_footprint(&du, &dv)
    });
    calls(group, ("half-vector", "projected-footprint"), &[()], &shaded, |(), at| {
        let [du, dv] = motions(&at);
        half(&at).projected_footprint(&du, &dv)
    });
    let mut rng = generator();
    let normals: Vec<[T::Vec3; 4]> =
        (0..CALLS).map(|_| [(); 4].map(|()| direction::<T>(&mut rng).into())).collect();
    calls(group, ("quad", "coarse"), &[()], &normals, |(), normals| {
        Quad::<T, 2>::new(normals.map(normal_to_slope::<T>)).coarse_footprint()
    });
    calls(group, ("quad", "fine"), &[()], &normals, |(), normals| {
        Quad::<T, 2>::new(normals.map(normal_to_slope::<T>)).fine_footprint([1, 0])
    });
}

/// The angle that the closed means consist of.
fn angles<T: Elementary>(criterion: &mut Criterion) {
    let mut group = group::<T>(criterion, "atan2");
    let mut rng = generator();
    let points: Vec<[T; 2]> = (0..CALLS).map(|_| turned(&mut rng, 1.0).map(T::lit)).collect();
    calls(&mut group, ("elementary", "1"), &[()], &points, |(), [x, y]| elementary::atan2(y, x));
    calls(&mut group, ("std", "1"), &[()], &points, |(), [x, y]| Elementary::atan2(y, x));
}
