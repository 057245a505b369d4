//! Pictures: tone mapping and PNG files.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use microsurface::glam::Vec3;

/// Linear radiance, row by row from the top.
pub(crate) struct Image {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: Vec<Vec3>,
}

impl Image {
    /// Writes the picture as an sRGB PNG.
    pub(crate) fn write_png(&self, path: &Path) -> Result<(), String> {
        let describe = |problem: String| format!("cannot write {}: {problem}", path.display());
        let file = File::create(path).map_err(|error| describe(error.to_string()))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let bytes: Vec<u8> = self.pixels.iter().flat_map(|&pixel| displayed(pixel)).collect();
        let write = |mut writer: png::Writer<_>| {
            writer.write_image_data(&bytes)?;
            writer.finish()
        };
        encoder.write_header().and_then(write).map_err(|error| describe(error.to_string()))
    }
}

/// The luminance that becomes white.
const WHITE: f32 = 6.0;
const EXPOSURE: f32 = 1.7;

/// Reinhard's curve of the luminance (2002, Eq. 4), which keeps the hue, in sRGB.
fn displayed(radiance: Vec3) -> [u8; 3] {
    let exposed = radiance * EXPOSURE;
    let luminance = exposed.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    let toned = exposed * ((1.0 + luminance / (WHITE * WHITE)) / (1.0 + luminance));
    toned.to_array().map(|linear| (srgb(linear.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}
