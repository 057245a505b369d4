//! Means over the largest footprints that there are.

use core::f64::consts::{PI, TAU};

use microsurface::filter::{polygon, rectangle};
use microsurface::glam::DVec2;
use microsurface::{Beckmann, Ggx};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Edges and centres out to the largest numbers, where the sums over edges are nothing but
/// rounding.
#[test]
fn means_over_the_largest_footprints_are_at_least_zero() {
    let mut rng = Pcg64::seed_from_u64(31);
    for i in 0..50_000 {
        let vector = |rng: &mut Pcg64, greatest: f64| {
            let length = 10.0_f64.powf(rng.random_range(-3.0..greatest));
            length * DVec2::from_angle(rng.random_range(0.0..TAU))
        };
        let [centre, mut u, mut v] = [(); 3].map(|()| vector(&mut rng, 69.0));
        if i % 4 == 0 {
            v = u * rng.random_range(1e-20..1.0) + u.perp() * 10.0_f64.powf(rng.random_range(-40.0..0.0));
        }
        if i % 3 == 0 {
            u = vector(&mut rng, 17.0);
        }
        let (ggx, peak) = (Ggx::isotropic(1.0_f64).unwrap(), 1.0 / PI);
        for centre in [centre, 0.3 * (u + v), DVec2::ZERO, vector(&mut rng, 3.0)] {
            for mean in [
                polygon::mean_p22(&ggx, centre, u, v),
                polygon::mean_p22(&Beckmann::isotropic(1.0_f64).unwrap(), centre, u, v),
                rectangle::mean_p22(&ggx, centre, u),
                rectangle::mean_p22(&Beckmann::isotropic(1.0_f64).unwrap(), centre, u),
            ] {
                assert!(mean >= 0.0 && mean <= peak * (1.0 + 1e-9), "{mean:e} over {centre} {u} {v}");
            }
            let corners = [-0.5 * u - 0.5 * v, 0.5 * u - 0.5 * v, 0.5 * u + 0.5 * v, 0.5 * v - 0.5 * u];
            let share = polygon::integral_p22(&ggx, &corners.map(|corner| centre + corner));
            assert!((0.0..=1.0).contains(&share), "{share:e} within {corners:?} about {centre}");
        }
    }
}
