//! The pictures: which materials, in which rows and columns.

use microsurface::RoughnessMatrix;
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Perfect;
use microsurface::glam::{Mat2, Vec3};
use microsurface::{Beckmann, Error, Ggx, Gtr, Ndf, SampleVndf};

use crate::material::Material;
use crate::metals::{ALUMINIUM, COPPER, GOLD, Metal};

/// A material of a picture.
pub(crate) struct Entry {
    pub(crate) label: String,
    pub(crate) material: Box<dyn Material>,
    /// The same surface, reflecting everything.
    pub(crate) furnace: Box<dyn Material>,
}

pub(crate) struct Picture {
    /// The name of the file.
    pub(crate) name: &'static str,
    pub(crate) title: String,
    /// One list of materials for each row, the furthest row first.
    pub(crate) rows: Vec<Vec<Entry>>,
}

/// A surface of metal, sampled by its visible normals.
fn entry<N>(label: String, surface: N, metal: &Metal) -> Result<Entry, Error>
where
    N: SampleVndf + Ndf<Scalar = f32> + Copy + Sync + 'static,
{
    let material = RoughConductor::new(surface, metal.fresnel()?);
    Ok(Entry {
        label,
        material: Box::new(material),
        furnace: Box::new(material.with_fresnel(Perfect::<Vec3>::new())),
    })
}

/// Tails from the heaviest to the lightest, by roughness.
pub(crate) fn tails() -> Result<Picture, Error> {
    let row = |alpha: f32| -> Result<Vec<Entry>, Error> {
        let metal = &ALUMINIUM;
        let gtr = |gamma: &str| format!("GTR gamma={gamma}, alpha={alpha}");
        Ok(vec![
            entry(gtr("0.5"), Gtr::isotropic(alpha, 0.5)?, metal)?,
            entry(gtr("1"), Gtr::closed::<1>(alpha)?, metal)?,
            entry(gtr("1.5"), Gtr::isotropic(alpha, 1.5)?, metal)?,
            entry(format!("GGX, alpha={alpha}"), Ggx::isotropic(alpha)?, metal)?,
            entry(gtr("3"), Gtr::closed::<3>(alpha)?, metal)?,
            entry(gtr("4"), Gtr::closed::<4>(alpha)?, metal)?,
            entry(format!("Beckmann, alpha={alpha}"), Beckmann::isotropic(alpha)?, metal)?,
        ])
    };
    Ok(Picture {
        name: "tails",
        title: "Tails, aluminium. Columns: GTR of gamma 0.5, 1, 1.5, GGX (gamma 2), GTR 3, 4, Beckmann. \
                Rows from the back: alpha 0.02, 0.08, 0.2, 0.5."
            .to_owned(),
        rows: [0.02, 0.08, 0.2, 0.5].into_iter().map(row).collect::<Result<_, _>>()?,
    })
}

/// One width stretched along the tangents and between them.
pub(crate) fn brushed() -> Result<Picture, Error> {
    const ALPHA: f32 = 0.16;
    const STRETCH: f32 = 0.65;
    let metal = &COPPER;
    // A surface drawn out along x by 1/(1 − s) and compressed along y by 1 − s has these widths.
    let (along, across) = (ALPHA * (1.0 - STRETCH), ALPHA / (1.0 - STRETCH));
    let widths = format!("alpha={along:.3} (across {across:.3}) along");
    let turn = core::f32::consts::FRAC_PI_4;
    let matrix = |angle| RoughnessMatrix::rotated(along, across, angle);

    let beckmann = vec![
        entry(format!("Beckmann, alpha={ALPHA}"), Beckmann::isotropic(ALPHA)?, metal)?,
        entry(format!("Beckmann, {widths} x"), Beckmann::anisotropic(along, across)?, metal)?,
        entry(format!("Beckmann, {widths} y"), Beckmann::anisotropic(across, along)?, metal)?,
        entry(format!("Beckmann, {widths} 45°"), Beckmann::from_roughness_matrix(matrix(turn)?), metal)?,
        entry(format!("Beckmann, {widths} -45°"), Beckmann::from_roughness_matrix(matrix(-turn)?), metal)?,
    ];
    let ggx = vec![
        entry(format!("GGX, alpha={ALPHA}"), Ggx::isotropic(ALPHA)?, metal)?,
        entry(format!("GGX, {widths} x"), Ggx::anisotropic(along, across)?, metal)?,
        entry(format!("GGX, {widths} y"), Ggx::anisotropic(across, along)?, metal)?,
        entry(format!("GGX, {widths} 45°"), Ggx::from_roughness_matrix(matrix(turn)?), metal)?,
        entry(format!("GGX, {widths} -45°"), Ggx::from_roughness_matrix(matrix(-turn)?), metal)?,
    ];
    // The same by moving the microsurface, which any profile can be.
    let surface = Gtr::isotropic(ALPHA, 1.5)?;
    let rotation = Mat2::from_angle(turn);
    let moved = "GTR gamma=1.5";
    let gtr = vec![
        entry(format!("{moved}, alpha={ALPHA}"), surface, metal)?,
        entry(format!("{moved}, stretched by {STRETCH}"), surface.stretched(STRETCH)?, metal)?,
        entry(format!("{moved}, stretched by -{STRETCH}"), surface.stretched(-STRETCH)?, metal)?,
        entry(format!("{moved}, turned 45°"), surface.stretched(STRETCH)?.transformed(rotation)?, metal)?,
        entry(
            format!("{moved}, turned -45°"),
            surface.stretched(STRETCH)?.transformed(rotation.transpose())?,
            metal,
        )?,
    ];
    Ok(Picture {
        name: "brushed",
        title: "Brushed copper, x around the vertical axis. Columns: isotropic, brushed along x, along y, \
                at 45°, at -45°. Rows from the back: Beckmann, GGX, GTR of gamma 1.5."
            .to_owned(),
        rows: vec![beckmann, ggx, gtr],
    })
}

/// Metals from smooth to rough.
pub(crate) fn metals() -> Result<Picture, Error> {
    let row = |metal: &Metal| -> Result<Vec<Entry>, Error> {
        [0.005, 0.05, 0.12, 0.25, 0.5]
            .into_iter()
            .map(|alpha| entry(format!("{}, GGX alpha={alpha}", metal.name), Ggx::isotropic(alpha)?, metal))
            .collect()
    };
    Ok(Picture {
        name: "metals",
        title: "Metals, GGX. Columns: alpha 0.005, 0.05, 0.12, 0.25, 0.5. Rows from the back: gold, copper, \
                aluminium."
            .to_owned(),
        rows: [GOLD, COPPER, ALUMINIUM].iter().map(row).collect::<Result<_, _>>()?,
    })
}

/// The material of a mesh.
pub(crate) fn mesh() -> Result<Picture, Error> {
    let brushed = Ggx::anisotropic(0.08, 0.3)?;
    let entry = entry("gold, GGX alpha=0.08 (across 0.3) along x".to_owned(), brushed, &GOLD)?;
    Ok(Picture {
        name: "mesh",
        title: "A mesh of gold, brushed along x, around the vertical axis.".to_owned(),
        rows: vec![vec![entry]],
    })
}
