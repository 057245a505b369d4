//! TODO
#![expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixel indices are small"
)]

#[path = "../tour/image.rs"]
mod image;
mod materials;
mod methods;
mod pebble;
mod pixel;
mod rows;
mod sampled;
mod scene;
mod water;
mod waves;

use crate::image::Image;
use crate::rows::Region;
use std::path::Path;
fn main() {
    std::fs::create_dir_all("target/shimmer").unwrap();
    let methods = methods::methods().unwrap();
    for scene in [water::scene(), pebble::scene()] {
        let region = Region::whole(200);
        let t = std::time::Instant::now();
        let reference = sampled::means(&scene, region, 0.0, 16, 0).unwrap();
        println!("{} ref {:.1}s", scene.name, t.elapsed().as_secs_f64());
        let px = pixel::pixels(&scene, region, 0.0);
        let write = |name: String, values: Vec<[f32; 2]>| {
            let pixels = values.iter().map(|&[r, d]| scene.tint * d + microsurface::glam::Vec3::splat(r - d)).collect();
            Image { width: region.size[0] as u32, height: region.size[1] as u32, pixels }
                .write_png(&Path::new("target/shimmer").join(name).with_extension("png"))
                .unwrap();
        };
        for m in 0..2 {
            write(format!("{}-{m}-ref", scene.name), reference.iter().map(|r| [r.radiance[m], r.diffuse]).collect());
            for (i, method) in methods[m].iter().enumerate() {
                let list: Vec<_> = px.iter().flatten().copied().collect();
                let mut out = vec![0.0; list.len()];
                (method.shade)(&list, &mut out);
                let (mut k, mut e, mut sum, mut rs) = (0, 0.0, 0.0, 0.0);
                let v = px.iter().zip(&reference).map(|(p, r)| match p {
                    None => [0.0; 2],
                    Some(p) => {
                        let x = out[k];
                        k += 1;
                        if r.coverage == 1.0 { e += f64::from((x - r.radiance[m]).powi(2)); sum += x; rs += r.radiance[m]; }
                        [x, p.diffuse]
                    }
                }).collect();
                println!("{m} {} rmse {:.3} energy {:.3}", method.name, (e / k as f64).sqrt(), sum / rs);
                write(format!("{}-{m}-{i}", scene.name), v);
            }
        }
    }
}
