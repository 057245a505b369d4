//! Filtered distributions and means over footprints.

use microsurface::filter::deferred::{self, Bound, Kernel};
use microsurface::filter::{
    Covariance, Footprint, determinant_tokuyoshi2019, gaussian, polygon, projected, rectangle,
};
use microsurface::{Beckmann, Ggx, Gtr, Microsurface, Real, RoughnessMatrix};

use crate::random::Random;
use crate::{Hash, Record, name};

const COUNT: usize = 1000;

fn footprint<T: Real>(random: &mut Random) -> Footprint<T> {
    Footprint::new(random.slope::<T>(0.1), random.slope::<T>(0.1))
}

fn map<T: Real, P>(hash: &mut Hash, surface: &Microsurface<P, microsurface::Linear<T>>) {
    hash.all(&surface.roughness_matrix().unwrap().entries());
}

pub(crate) fn all<T: Real>(record: &mut Record) {
    let (scalar, l) = (name::<T>(), T::lit);
    let ggx = Ggx::isotropic(l(0.05)).unwrap();
    let aligned = Ggx::anisotropic(l(0.02), l(0.4)).unwrap();
    let matrix = RoughnessMatrix::new(l(0.04), l(-0.07), l(0.3)).unwrap();
    let turned = Ggx::from_roughness_matrix(matrix);
    let mut each = |name: &str, seed: u64, count: usize, f: &dyn Fn(&mut Random, &mut Hash)| {
        record.group(format!("{name} {scalar}"), |hash| {
            let mut random = Random(seed);
            for _ in 0..count {
                f(&mut random, hash);
            }
        });
    };
    each("widened by covariances", 15, COUNT, &|random, hash| {
        let covariance = footprint::<T>(random).covariance(l(0.25));
        map(hash, &ggx.filtered(covariance).unwrap());
        map(hash, &turned.filtered(covariance).unwrap());
        hash.add(turned.change_by_filter(covariance));
        hash.add(determinant_tokuyoshi2019(&matrix, covariance));
        let [x, y] = random.numbers::<T>();
        hash.add(ggx.filtered_isotropic(x).unwrap().map().alpha());
        hash.all(&aligned.filtered_axis_aligned([x, y]).unwrap().map().alphas());
    });
    each("filtered in projected space", 16, COUNT, &|random, hash| {
        let footprint = footprint::<T>(random);
        map(hash, &projected::filtered(&turned, footprint, l(0.16)).unwrap());
        map(hash, &projected::filtered_by(&aligned, footprint.covariance(l(0.1))).unwrap());
        map(hash, &projected::filtered_tokuyoshi2017(&ggx, footprint, l(0.25)).unwrap());
        let kernel = Kernel::tokuyoshi2021();
        hash.all(&projected::filtered_by_bounds(&aligned, footprint, &kernel).unwrap().map().alphas());
        let [x, y] = random.numbers::<T>();
        hash.add(projected::filtered_isotropic(&ggx, x).unwrap().map().alpha());
        hash.all(&projected::filtered_axis_aligned(&aligned, [x, y]).unwrap().map().alphas());
    });
    each("deferred", 17, COUNT, &|random, hash| {
        let footprint = footprint::<T>(random);
        for kernel in [Kernel::kaplanyan2016(), Kernel::tokuyoshi2019(), Kernel::tokuyoshi2021()] {
            let alpha = l(0.1);
            hash.all(&[
                deferred::isotropic(alpha, footprint, &kernel, Bound::Upper),
                deferred::isotropic(alpha, footprint, &kernel, Bound::Mean),
                deferred::max_eigenvalue(alpha, footprint, &kernel),
                deferred::rectangle_maximum(alpha, footprint, &kernel),
            ]);
            hash.all(&deferred::rectangle([alpha, l(0.3)], footprint, &kernel));
            let [du, dv] = [random.vector::<T>(), random.vector()].map(|v| v.map(|c| l(0.1) * c).into());
            hash.add(deferred::isotropic_from_normals(alpha, du, dv, &kernel, Bound::Mean));
        }
    });
    each("convolved with Gaussians", 18, 300, &|random, hash| {
        let covariance: Covariance<T> = footprint::<T>(random).covariance(l(0.25));
        hash.add(gaussian::p22(&turned, random.slope::<T>(1.0).into(), covariance));
    });
    each("means over footprints of GGX", 19, COUNT, &|random, hash| {
        let (slope, [du, dv]) = (random.slope::<T>(0.3).into(), footprint::<T>(random).steps());
        hash.add(polygon::mean_p22(&ggx, slope, du, dv));
        hash.add(polygon::mean_p22(&turned, slope, du, dv));
        hash.add(rectangle::mean_p22(&aligned, slope, du));
        hash.add(polygon::integral_p22(&turned, &[slope, du, dv]));
    });
    let (beckmann, gtr) =
        (Beckmann::anisotropic(l(0.05), l(0.2)).unwrap(), Gtr::isotropic(l(0.2), l(1.5)).unwrap());
    each("means over footprints of others", 20, 200, &|random, hash| {
        let (slope, [du, dv]) = (random.slope::<T>(0.1).into(), footprint::<T>(random).steps());
        hash.add(polygon::mean_p22(&beckmann, slope, du, dv));
        hash.add(rectangle::mean_p22(&beckmann, slope, du));
        hash.add(polygon::mean_p22(&gtr, slope, du, dv));
    });
}
