//! A ball whose highlight is smaller than a pixel: what the choice of a filter means for a picture.

use microsurface::Ggx;
use microsurface::bsdf::RoughConductor;
use microsurface::filter::jacobian::{Curvature, HalfVector, Motion};
use microsurface::filter::{Footprint, gaussian};
use microsurface::frame::Frame;
use microsurface::fresnel::Perfect;
use microsurface::glam::{DVec2, DVec3};

/// Pixels along an edge of the picture, which the ball fills; both are seen and lit from afar.
const PIXELS: u32 = 48;

/// Directions in the frame of the pixel, and the footprint of its half vectors.
struct Seen {
    wi: DVec3,
    wo: DVec3,
    footprint: Footprint<f64>,
}

/// The ball at a place of the picture, −1 to 1; `None` beside it and in its shadow.
fn seen(place: DVec2, light: DVec3) -> Option<Seen> {
    let normal = place.extend((1.0 - place.length_squared()).max(0.0).sqrt());
    if normal.z < 0.2 || normal.dot(light) < 0.1 {
        return None;
    }
    let frame = Frame::<f64>::from_normal(normal);
    let step = 2.0 / f64::from(PIXELS);
    // Along the tangent plane, as far as a pixel is wide.
    let [du, dv] = [DVec2::X, DVec2::Y].map(|axis| {
        let point = step * axis.extend(-axis.dot(place) / normal.z);
        Motion { point, normal: Curvature::sphere(1.0).normal_step(&frame, point), ..Motion::default() }
    });
    let half = HalfVector::<f64>::far(&frame, light, DVec3::Z);
    Some(Seen {
        wi: frame.to_local(light),
        wo: frame.to_local(DVec3::Z),
        footprint: half.slope_footprint(&du, &dv).clamped(1.0),
    })
}

/// Root mean square errors over the ball, relative to its root mean square: unfiltered, A + 2Σ, the
/// convolution with a Gaussian of the variance of a box, and the mean over the footprint.
fn errors(light: DVec3, alpha: f64, tone: impl Fn(f64) -> f64) -> [f64; 4] {
    let surface = Ggx::isotropic(alpha).unwrap();
    let material = RoughConductor::new(surface, Perfect::<f64>::new());
    let (mut squares, mut reference) = ([0.0_f64; 4], 0.0);
    for pixel in 0..PIXELS * PIXELS {
        let corner = DVec2::new(f64::from(pixel % PIXELS), f64::from(pixel / PIXELS));
        let at = |x: f64, y: f64| 2.0 / f64::from(PIXELS) * (corner + DVec2::new(x, y)) - DVec2::ONE;
        let Some(Seen { wi, wo, footprint }) = seen(at(0.5, 0.5), light) else { continue };
        let mut exact = 0.0;
        for k in 0..256 {
            let place = at((f64::from(k % 16) + 0.5) / 16.0, (f64::from(k / 16) + 0.5) / 16.0);
            if let Some(Seen { wi, wo, .. }) = seen(place, light) {
                exact += material.eval(wi, wo) * wi.z / 256.0;
            }
        }
        let widened = surface.filtered(footprint.covariance(0.25)).unwrap();
        let convolved = gaussian::filtered(&surface, footprint.covariance(1.0 / 12.0)).unwrap();
        let values = [
            material.eval(wi, wo),
            RoughConductor::new(widened, Perfect::<f64>::new()).eval(wi, wo),
            RoughConductor::new(convolved, Perfect::<f64>::new()).eval(wi, wo),
            material.eval_over(wi, wo, footprint),
        ];
        for (square, value) in squares.iter_mut().zip(values) {
            *square += (tone(value * wi.z) - tone(exact)).powi(2);
        }
        reference += tone(exact).powi(2);
    }
    squares.map(|square| (square / reference).sqrt())
}

/// The warning in the documentation of `filter`: away from its peak GGX needs no filter, and A + 2Σ
/// makes it brighter there.
#[test]
fn a_small_highlight_on_a_ball() {
    let alpha = 0.02;
    let lights = (0..8).map(|i| {
        let i = f64::from(i);
        DVec3::new(0.1 * i, 0.37 - 0.09 * i, 1.0).normalize()
    });
    let (mut linear_worse, mut sums) = (0, [0.0_f64; 4]);
    for light in lights {
        // Whether a pixel's centre meets the peak is chance: what all pixels show is seen in r/(1 +
        // r).
        let toned = errors(light, alpha, |r| r / (1.0 + r));
        let linear = errors(light, alpha, |r| r);
        println!("{toned:.4?} {linear:.4?}");
        linear_worse += u32::from(linear[1] > linear[0]);
        for (sum, error) in sums.iter_mut().zip(toned) {
            *sum += error * error / 8.0;
        }
    }
    let [unfiltered, widened, convolved, mean] = sums.map(f64::sqrt);
    println!(
        "unfiltered {unfiltered:.4}, A + 2Σ {widened:.4}, convolved {convolved:.4}, mean {mean:.4}; {linear_worse}"
    );
    assert!(widened > 30.0 * unfiltered && convolved < 0.2 * unfiltered && mean < 0.04 * unfiltered);
    // In the mean square of radiance itself, where one pixel with the peak outweighs all, it is so
    // for most lights.
    assert!(linear_worse >= 6, "{linear_worse}");
}
