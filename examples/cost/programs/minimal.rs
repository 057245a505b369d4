//! One function of one distribution.

use std::hint::black_box;

use microsurface::glam::Vec3;
use microsurface::{Ggx, Ndf};

fn main() {
    if let Ok(surface) = Ggx::isotropic(black_box(0.3_f32)) {
        black_box(surface.d(black_box(Vec3::Z)));
    }
}
