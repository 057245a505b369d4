//! The slopes that a pixel covers: footprints, covariances, derivatives of half vectors, rays,
//! quads, normal maps.

use microsurface::Real;
use microsurface::filter::deferred::{quad_in_slopes, quad_projected};
use microsurface::filter::jacobian::{
    Amplification, Curvature, HalfVector, InterpolatedNormals, Motion, disk_to_slope, sphere_to_disk,
    sphere_to_slope,
};
use microsurface::filter::normal_map::{
    Moments, alpha_toksvig2005, exponent_toksvig2005, variance_toksvig2005,
};
use microsurface::filter::quad::Quad;
use microsurface::filter::ray::{FocusPlane, RayDifferential};
use microsurface::filter::{Covariance, Footprint};
use microsurface::frame::Frame;

use crate::random::Random;
use crate::{Hash, Record, name};

const COUNT: usize = 500;

fn covariance<T: Real>(hash: &mut Hash, covariance: Covariance<T>) {
    hash.all(&covariance.entries());
    hash.all(&covariance.principal());
    hash.all(&[covariance.trace(), covariance.determinant()]);
}

fn footprint<T: Real>(hash: &mut Hash, footprint: Footprint<T>) {
    for step in footprint.steps() {
        hash.two::<T>(step);
    }
}

fn ray<T: Real>(hash: &mut Hash, ray: &RayDifferential<T>, direction: T::Vec3, normal: T::Vec3) {
    for step in ray.transferred(T::lit(2.0)).onto_plane(direction, T::lit(3.0), normal) {
        hash.three::<T>(step);
    }
}

fn half_vectors<T: Real>(random: &mut Random, hash: &mut Hash) {
    let l = T::lit;
    let frame = Frame::<T>::from_normal_and_tangent(random.above::<T>(), random.vector::<T>());
    let [point, eye, light] = core::array::from_fn(|_| random.vector::<T>().into());
    let [wi, wo] = core::array::from_fn(|_| random.above::<T>().into());
    let mut motion = || Motion::<T> {
        point: random.vector::<T>().into(),
        eye: random.vector::<T>().into(),
        light: random.vector::<T>().into(),
        normal: random.vector::<T>().into(),
        twist: l(0.1),
        ..Motion::default()
    };
    let (du, dv) = (motion(), motion());
    for half in [HalfVector::<T>::new(&frame, point, eye, light), HalfVector::<T>::far(&frame, wi, wo)] {
        hash.three::<T>(half.wm());
        hash.two::<T>(half.slope());
        hash.two::<T>(half.projected());
        footprint(hash, half.slope_footprint(&du, &dv));
        footprint(hash, half.projected_footprint(&du, &dv));
        hash.matrix::<T>(half.slope_per_point(Curvature::new(l(0.3), l(-0.1), l(0.7))));
    }
    let moved = du.perturbed(&frame, eye, light);
    hash.three::<T>(moved.normal);
    hash.add(moved.twist);
    hash.add(du.with_tangent(&frame, eye, light).twist);
    let normals = InterpolatedNormals::<T> { positions: [point, eye, light], normals: [wi, wo, du.normal] };
    let inside = [0.2, 0.5, 0.3].map(l);
    hash.three::<T>(normals.normal(inside));
    hash.three::<T>(normals.normal_step(inside, dv.point));
    hash.three::<T>(
        Curvature::principal(l(2.0), l(0.5), [l(0.6), l(0.8)].into()).normal_step(&frame, dv.point),
    );
}

pub(crate) fn all<T: Real>(record: &mut Record) {
    let (scalar, l) = (name::<T>(), T::lit);
    let mut each = |name: &str, seed: u64, f: &dyn Fn(&mut Random, &mut Hash)| {
        record.group(format!("{name} {scalar}"), |hash| {
            let mut random = Random(seed);
            for _ in 0..COUNT {
                f(&mut random, hash);
            }
        });
    };
    each("covariances", 21, &|random, hash| {
        let f = Footprint::<T>::new(random.slope::<T>(1.0), random.slope::<T>(1.0));
        let m = T::matrix(random.matrix::<T>());
        let a = f.covariance(l(0.25));
        covariance(hash, a);
        covariance(hash, f.covariance_of_bounds(l(0.25)));
        covariance(hash, a + Covariance::isotropic(l(0.01)));
        covariance(hash, a.scaled(l(0.3)).transformed(m));
        covariance(hash, a.clamped(l(0.1)));
        let [x, y] = random.numbers::<T>();
        covariance(hash, Covariance::nearest(x, y, l(0.2)));
        footprint(hash, f.transformed(m).scaled(l(0.5)));
        footprint(hash, f.clamped(l(1.0)));
        hash.two::<T>(f.extents());
        hash.two::<T>(f.clamped_extents(l(1.0)));
    });
    each("jacobians", 22, &|random, hash| {
        let m: T::Vec3 = random.above::<T>().into();
        hash.matrix::<T>(sphere_to_disk::<T>(m));
        hash.matrix::<T>(disk_to_slope::<T>(m));
        hash.matrix::<T>(sphere_to_slope::<T>(m));
        for Amplification { largest, smallest } in
            [Amplification::<T>::in_slopes(m), Amplification::<T>::on_disk(m)]
        {
            hash.all(&[largest, smallest]);
        }
    });
    each("half vectors", 23, &half_vectors::<T>);
    each("rays and quads", 24, &|random, hash| {
        let [direction, du, dv, normal] = core::array::from_fn(|_| random.vector::<T>().into());
        ray(hash, &RayDifferential::<T>::pinhole(direction, du, dv), direction, normal);
        let focus = FocusPlane::<T> { distance: l(4.0), axis: normal };
        hash.three::<T>(focus.direction(du, direction));
        ray(hash, &RayDifferential::<T>::thin_lens(focus, normal, direction, du, dv), direction, normal);
        ray(hash, &RayDifferential::<T>::across_lens(focus, normal, du, dv, direction), direction, normal);
        let frames: [Frame<T>; 4] = core::array::from_fn(|_| Frame::from_normal(random.above::<T>()));
        footprint(hash, quad_in_slopes(&frames));
        footprint(hash, quad_projected(&frames));
        let quad = Quad::<T, 2>::new(core::array::from_fn::<[T; 2], 4, _>(|_| random.slope(1.0)));
        footprint(hash, quad.coarse_footprint());
        footprint(hash, quad.fine_footprint([1, 0]));
        hash.all(&quad.mean());
    });
    each("normal maps", 25, &|random, hash| {
        let texels: [Moments<T>; 4] = core::array::from_fn(|_| {
            let [x, y, z] = random.above::<T>();
            Moments::of_normal([x, y, z + l(0.1)])
        });
        let mean = Moments::mean(texels).unwrap();
        let weighted = Moments::weighted_mean(texels.into_iter().zip([0.1, 0.2, 0.3, 0.4].map(l))).unwrap();
        for moments in [mean, weighted + texels[0], mean.lerp(&texels[1], l(0.3)), mean.scaled(l(2.0))] {
            hash.two::<T>(moments.mean_slope());
            hash.three::<T>(moments.mesonormal());
            let (slope, second) = moments.raw();
            hash.two::<T>(slope);
            hash.all(&second);
            let (frame, tilted) = moments.tilted();
            hash.three::<T>(frame.axes()[0]);
            covariance(hash, tilted);
            covariance(hash, moments.transformed(T::matrix(random.matrix::<T>())).covariance());
        }
        let average: T::Vec3 = random.vector::<T>().map(|c| l(0.25) * c).into();
        hash.add(variance_toksvig2005::<T>(average));
        hash.add(exponent_toksvig2005::<T>(l(50.0), average));
        hash.add(alpha_toksvig2005::<T>(l(0.1), average).unwrap());
    });
}
