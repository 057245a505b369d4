//! Elementary functions, frames, artists' maps, matrices and Jacobians.

use microsurface::elementary as e;
use microsurface::frame::{Frame, normal_to_slope, reflected, slope_to_normal};
use microsurface::roughness::{
    alpha_burley2012, alpha_dimov2015, alpha_pbrt4, alpha_walter2007, alphas_burley2012, alphas_kulla2017,
    alphas_openpbr, clamped,
};
use microsurface::transform::tension::{Mean, Mesh, Triangle, interpolated};
use microsurface::transform::{jacobian_of_normals, jacobian_of_uv_map};
use microsurface::{Ggx, Real, RoughnessMatrix};

use crate::random::Random;
use crate::{Record, name};

const COUNT: usize = 3000;

macro_rules! of_one_number {
    ($record:expr, $t:ident, $($function:ident, $from:expr, $to:expr;)*) => {$(
        $record.group(concat!(stringify!($function), " ", stringify!($t)).into(), |hash| {
            let mut random = Random(9);
            for _ in 0..COUNT {
                let x = $t::lit(if random.below(4) == 0 {
                    let sign = if $from < 0.0 && random.below(2) == 0 { -1.0 } else { 1.0 };
                    (sign * random.decades(-40.0, 0.0)).clamp($from, $to)
                } else {
                    random.within($from, $to)
                });
                hash.add(e::$function(x));
            }
        });
    )*};
}

macro_rules! elementary_of {
    ($record:expr, $t:ident) => {
        of_one_number! {
            $record, $t,
            exp, -110.0, 90.0; exp2, -150.0, 128.0; exp_m1, -50.0, 80.0; exp_neg_square, -11.0, 11.0;
            ln, 0.0, 1e10; log2, 0.0, 1e10; ln_1p, -0.999, 1e6;
            erf, -5.0, 5.0; erfc, -5.0, 12.0; erfcx, -6.0, 100.0; ierfcx, 0.0, 100.0;
            erf_inv, -1.0, 1.0; erfc_inv, 0.0, 2.0;
        }
        $record.group(concat!("others ", stringify!($t)).into(), |hash| {
            let mut random = Random(10);
            for _ in 0..COUNT {
                let (x, y) = ($t::lit(random.within(-3.0, 3.0)), $t::lit(random.within(-3.0, 3.0)));
                let (s, c) = e::sin_cos_turns(x);
                hash.all(&[s, c, e::atan2(y, x)]);
                let positive = random.decades(-5.0, 5.0);
                hash.add(e::exp_wide::<$t>(random.within(-90.0, 80.0)));
                hash.add(e::pow_wide::<$t>(positive, x));
                hash.add(e::ln_wide::<$t>(positive));
            }
        });
    };
}

pub(crate) fn elementary(record: &mut Record) {
    elementary_of!(record, f32);
    elementary_of!(record, f64);
}

pub(crate) fn others<T: Real>(record: &mut Record) {
    let scalar = name::<T>();
    record.group(format!("frames {scalar}"), |hash| {
        let mut random = Random(11);
        for _ in 0..1000 {
            let (n, t, w) = (random.anywhere::<T>(), random.vector::<T>(), random.anywhere::<T>());
            for frame in [Frame::<T>::from_normal(n), Frame::<T>::from_normal_and_tangent(n, t)] {
                for axis in frame.axes() {
                    hash.three::<T>(axis);
                }
                hash.three::<T>(frame.to_local(w.into()));
                hash.three::<T>(frame.to_world(w.into()));
            }
            hash.three::<T>(reflected(w, n));
            hash.two::<T>(normal_to_slope(w));
            hash.three::<T>(slope_to_normal(random.slope::<T>(1.0)));
        }
    });
    record.group(format!("artists' maps {scalar}"), |hash| {
        let mut random = Random(12);
        for _ in 0..1000 {
            let [r, a] = [random.within(0.01, 1.0), random.within(0.0, 0.99)].map(T::lit);
            hash.all(
                &[alpha_burley2012(r), alpha_pbrt4(r), alpha_dimov2015(a), alpha_walter2007(r)]
                    .map(Result::unwrap),
            );
            for both in [alphas_burley2012(r, a), alphas_kulla2017(r, a), alphas_openpbr(r, a)] {
                hash.all(&both.unwrap());
            }
            hash.add(clamped(r));
        }
    });
    record.group(format!("roughness matrices {scalar}"), |hash| {
        let mut random = Random(13);
        for _ in 0..1000 {
            let [x, y] = [random.decades(-4.0, 1.0), random.decades(-4.0, 1.0)].map(T::lit);
            let matrix = RoughnessMatrix::rotated(x, y, T::lit(random.within(-3.0, 3.0))).unwrap();
            hash.all(&matrix.entries());
            hash.all(&matrix.principal());
            let moved = Ggx::from_roughness_matrix(matrix).transformed(T::matrix(random.matrix()));
            if let Ok(surface) = moved {
                hash.all(&surface.roughness_matrix().unwrap().principal());
            }
        }
    });
    deformations::<T>(record);
}

fn deformations<T: Real>(record: &mut Record) {
    record.group(format!("deformations {}", name::<T>()), |hash| {
        let mut random = Random(14);
        for _ in 0..500 {
            let m = T::matrix(random.matrix::<T>());
            let w = random.above::<T>();
            if w[2] > T::lit(1e-3) {
                hash.matrix::<T>(jacobian_of_normals::<T>(m, w.into()));
            }
            let map = |uv: T::Vec2| -> T::Vec2 {
                let [u, v]: [T; 2] = uv.into();
                [u + v * v, v - u * u].into()
            };
            hash.matrix::<T>(jacobian_of_uv_map::<T>(map, random.numbers::<T>().into(), T::lit(1e-3)));
            let corners = |random: &mut Random| core::array::from_fn(|_| random.vector::<T>().into());
            let triangle = Triangle::<T> {
                rest: corners(&mut random),
                deformed: corners(&mut random),
                uv: core::array::from_fn(|_| random.slope::<T>(1.0).into()),
            };
            if let Ok(tension) = triangle.tension() {
                hash.matrix::<T>(tension);
                hash.matrix::<T>(interpolated::<T>(
                    [tension, m, tension],
                    [T::HALF, T::lit(0.3), T::lit(0.2)],
                ));
            }
            if let Ok(frame) = triangle.frame() {
                for axis in frame.axes() {
                    hash.three::<T>(axis);
                }
            }
            let mesh = Mesh::<T> {
                rest: &triangle.rest,
                deformed: &triangle.deformed,
                uv: &triangle.uv,
                triangles: &[[0, 1, 2]],
            };
            let mut means = [Mean::<T>::default(); 3];
            if mesh.add_tension_of_vertices(&mut means) == Ok(0) {
                hash.matrix::<T>(means[1].matrix());
            }
        }
    });
}
