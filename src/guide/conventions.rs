//! Signs, frames and units, and what others call the same things.
//!
//! - Directions are unit vectors of the shading frame, z along the normal, and point away from the
//!   surface: `wo` to the viewer, `wi` to the light.
//! - Angles are radians. Random numbers are in [0, 1), 0 included.
//! - BSDFs come without the cosine: reflected radiance is ∫ f L(wi) wi.z dwi.
//! - α is a slope width, never an artist's roughness; [`roughness`](crate::roughness) converts.
//! - A roughness matrix A is in units of α², twice the covariance of Beckmann slopes.
//!
//! # Notation
//! | here | pbrt | Mitsuba | Filament | Heitz 2014 | Walter 2007 | Atanasov 2022 |
//! |---|---|---|---|---|---|---|
//! | `wo`, to the viewer | wo | wi | v | ωo | o (v in G1) | o |
//! | `wi`, to the light | wi | wo | l | ωi | i | i |
//! | `wm`, micronormal | wm | m | h | ωm | m | m |
//! | D, `d` | D | `eval` | D | D | D | D |
//! | Λ, `lambda` | Lambda | – | – | Λ | – | – |
//! | σ, `sigma` | – | – | – | cos θo/G1, §3 | – | – |
//! | G1, `g1` | G1 | `smith_g1` | – | G1 | G1 | G1 |
//! | D_w, `vndf` | D(w, wm) | `pdf` with visible normals | – | D_ωo | – | D_v |
//! | α, `alpha` | alpha | alpha | α = roughness | α | α_b, α_g | α |
//! | artist's roughness | `RoughnessToAlpha` | – | `perceptualRoughness` | – | – | – |
//! | M | – | – | – | – | – | M |
//!
//! # Differences that matter when porting
//! | here | there |
//! |---|---|
//! | `g1` of Beckmann is exact | Mitsuba's `smith_g1` is [`g1_walter2007`](crate::Microsurface::g1_walter2007), off by up to 0.003 |
//! | `g2` is height-correlated, as in pbrt-v4 and MaterialX | `G` of Mitsuba is [`g2_separable`](crate::Ndf::g2_separable) |
//! | BSDFs come without the cosine, as in pbrt | `eval` of Mitsuba and of Falcor includes it |
//! | Λ(w) below the horizon is −1 − Λ(−w) | Falcor's has the other sign |
//! | f = F D/(4 (zo σi + zi σo − zi zo)) | Filament's visibility V is that over F D |
//!
//! # Other vector libraries
//! glam comes with the crate, as [`microsurface::glam`](crate::glam). Its vectors convert from and
//! to arrays, which every library has: `let wm: [f32; 3] = wm.into();`. Constructors take arrays as
//! they are. With glam's feature `mint-05`, `mint` types convert as well.
//! ```
//! use microsurface::{Ggx, Ndf, filter::Footprint};
//! let yours: [f32; 3] = [0.0, 0.6, 0.8];
//! let d = Ggx::isotropic(0.2_f32)?.d(yours.into());
//! let footprint = Footprint::new([0.1_f32, 0.0], [0.0, 0.1]);
//! # let _ = (d, footprint);
//! # Ok::<(), microsurface::Error>(())
//! ```
