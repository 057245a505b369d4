//! Normal maps: what lies below a pixel in a texture, as a mean slope and one more Σ.
//!
//! Averaged normals lose the roughness of the bumps between which they lie. [`Moments`] of slopes
//! keep it through mip maps and layers (LEAN mapping); [`variance_toksvig2005`] guesses it from the
//! length of the averaged normal.
//!
//! Moments are kept central, as mean and covariance. Textures hold the raw E\[t\] and E\[ttᵀ\],
//! which are averaged by the hardware: [`Moments::from_raw`] and [`Moments::raw`] convert, and the
//! difference E\[ttᵀ\] − E\[t\]E\[t\]ᵀ cancels. An entry stored with relative precision ε leaves a
//! variance uncertain by ε|E\[t\]|²: with slopes of 1 and 11 bits (half floats) no σ below 0.022
//! survives, in f32 none below 3e-4. Moments about a `reference` slope near the mean
//! ([`Moments::raw_about`]), the same for all texels that are averaged together, are as easily
//! averaged and lose only ε|E\[t\] − r|².
//!
//! # Example
//! The footprint of the pixel and the texture below it, in one filter:
//! ```
//! use microsurface::filter::{Footprint, normal_map::Moments};
//! use microsurface::{Ggx, glam::Vec2};
//! let texels = [0.1_f32, 0.3, -0.1, 0.1].map(|x| Moments::of_slope(Vec2::new(x, 0.0)));
//! let texture = Moments::mean(texels).ok_or("no texels")?;
//! let (frame, covariance) = texture.tilted();
//! // Directions and footprints are then those in `frame`.
//! let footprint = Footprint::new(Vec2::new(0.02, 0.0), Vec2::new(0.0, 0.02));
//! let surface = Ggx::isotropic(0.1)?.filtered(footprint.covariance(0.25) + covariance)?;
//! assert!(surface.roughness_matrix()?.principal()[0] > 0.2 && frame.axes()[2].z < 1.0);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # References
//! Olano and Baker 2010, "LEAN mapping"; Dupuy, Heitz, Iehl, Poulin, Neyret and Ostromoukhov 2013,
//! "Linear efficient antialiased displacement and reflectance mapping"; Toksvig 2005, "Mipmapping
//! normal maps"; Kaplanyan, Hill, Patney and Lefohn 2016, §5.5.

mod toksvig;

use core::ops::Add;

use crate::elementary::exact::difference_of_products;
use crate::filter::Covariance;
use crate::frame::{Frame, normal_to_slope, slope_to_normal};
use crate::real::{Real, Vector};

pub use toksvig::{alpha_toksvig2005, exponent_toksvig2005, variance_toksvig2005};

/// The mean and the covariance of the slopes of a part of a surface.
///
/// `+` is the sum of two independent height fields, layers of bumps: slopes add, and so do means
/// and covariances. In raw moments it is E₁ + E₂ + E\[t₁\]E\[t₂\]ᵀ + E\[t₂\]E\[t₁\]ᵀ.
///
/// # Special cases
/// Made of numbers that are not finite they are not [finite](Self::is_finite):
/// [`covariance`](Self::covariance) then is not either, and filters refuse it. Means leave such
/// parts out, so that one bad texel does not spoil the levels above it.
///
/// # Accuracy
/// Means and covariances are formed in f64. With no difference of moments, a covariance is as
/// accurate as the slopes are: f32 slopes 1 ± 1e-4 have their variance to 1e-3, where raw f32
/// moments have no digit of it.
///
/// # References
/// Olano and Baker 2010, §3 and §5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments<T> {
    mean: [T; 2],
    /// xx, xy, yy.
    covariance: [T; 3],
}

impl<T: Real> Moments<T> {
    /// The moments of one slope.
    #[inline]
    #[must_use]
    pub fn of_slope(slope: impl Vector<2, Scalar = T>) -> Self {
        let slope = T::Vec2::from(slope.components());
        Self { mean: slope.into(), covariance: [T::ZERO; 3] }
    }

    /// Moments of the facet whose normal has the direction of m, of any length.
    ///
    /// # Special cases
    /// m.z ≤ 0, an upright or an overhanging facet, has no slope: the moments are not
    /// [finite](Self::is_finite), and means leave them out.
    ///
    /// # Example
    /// ```
    /// use microsurface::{filter::normal_map::Moments, glam::Vec3};
    /// let texels = [Vec3::new(-0.5, 0.0, 1.0), Vec3::X, Vec3::new(0.5, 0.0, -1.0)];
    /// let texels = texels.map(Moments::of_normal);
    /// assert_eq!(texels.map(|texel| texel.is_finite()), [true, false, false]);
    /// assert_eq!(Moments::mean(texels), Some(texels[0]));
    /// ```
    #[inline]
    #[must_use]
    pub fn of_normal(m: impl Vector<3, Scalar = T>) -> Self {
        let m = T::Vec3::from(m.components());
        let [_, _, z]: [T; 3] = m.into();
        // NaN has none either.
        let none = T::ZERO * T::INFINITY;
        Self::of_slope(if z > T::ZERO { normal_to_slope::<T>(m) } else { [none, none].into() })
    }

    /// Whether the mean and the covariance are.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.mean.iter().chain(&self.covariance).all(|x| x.is_finite())
    }

    /// The moments of slopes of this mean and covariance.
    #[inline]
    #[must_use]
    pub fn new(mean: T::Vec2, covariance: Covariance<T>) -> Self {
        Self { mean: mean.into(), covariance: covariance.entries() }
    }

    /// From a texture: E\[t\] and the entries [xx, xy, yy] of E\[ttᵀ\].
    ///
    /// # Accuracy
    /// The difference is exact for the numbers given, which are not: see the [module](self).
    #[inline]
    #[must_use]
    pub fn from_raw(mean: T::Vec2, second: [T; 3]) -> Self {
        Self::from_raw_about([T::ZERO; 2].into(), mean, second)
    }

    /// E\[t\] and the entries [xx, xy, yy] of E\[ttᵀ\], for a texture.
    #[inline]
    #[must_use]
    pub fn raw(&self) -> (T::Vec2, [T; 3]) {
        self.raw_about([T::ZERO; 2].into())
    }

    /// From E\[t − r\] and E\[(t − r)(t − r)ᵀ\] of the slopes' differences to a reference r.
    #[inline]
    #[must_use]
    pub fn from_raw_about(reference: T::Vec2, mean: T::Vec2, second: [T; 3]) -> Self {
        let ([rx, ry], d): ([T; 2], [T; 2]) = (reference.into(), mean.into());
        let ([x, y], [xx, xy, yy]) = (d.map(T::to_f64), second.map(T::to_f64));
        let minus = |e: f64, a: f64, b: f64| T::lit(difference_of_products(e, 1.0, a, b));
        Self { mean: [rx + d[0], ry + d[1]], covariance: [minus(xx, x, x), minus(xy, x, y), minus(yy, y, y)] }
    }

    /// E\[t − r\] and E\[(t − r)(t − r)ᵀ\] for a reference slope r: linear in the distribution of t
    /// like the raw moments, and without their loss where r is near the mean.
    #[inline]
    #[must_use]
    pub fn raw_about(&self, reference: T::Vec2) -> (T::Vec2, [T; 3]) {
        let r: [T; 2] = reference.into();
        let [x, y] = [0, 1].map(|i| self.mean[i].to_f64() - r[i].to_f64());
        let [xx, xy, yy] = self.covariance.map(T::to_f64);
        ([x, y].map(T::lit).into(), [xx + x * x, xy + x * y, yy + y * y].map(T::lit))
    }

    /// Moments of equal parts: a texel of the next mip level from its four.
    ///
    /// # Returns
    /// `None` without a part that is finite.
    ///
    /// # Example
    /// ```
    /// use microsurface::{filter::normal_map::Moments, glam::Vec2};
    /// let ridges = [1.0, -1.0].map(|x| Moments::of_slope(Vec2::new(x, 0.0)));
    /// let flat = Moments::mean(ridges).ok_or("none")?;
    /// assert!(flat.mean_slope() == Vec2::ZERO && flat.covariance().entries() == [1.0, 0.0, 0.0]);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn mean(parts: impl IntoIterator<Item = Self>) -> Option<Self> {
        Self::weighted_mean(parts.into_iter().map(|part| (part, T::ONE)))
    }

    /// Moments of parts with weights, which need not sum to 1: a filter kernel over texels, the
    /// areas of facets.
    ///
    /// Var = Σ wᵢ(Varᵢ + δᵢδᵢᵀ)/Σ wᵢ with δᵢ = meanᵢ − mean, in one pass whose terms are all
    /// positive.
    ///
    /// # Returns
    /// `None` unless the weights of the parts that are finite have a sum above 0.
    ///
    /// # Domain
    /// Weights from 0; with negative ones the covariance may be indefinite.
    ///
    /// # References
    /// Chan, Golub and LeVeque 1979, "Updating formulae and a pairwise algorithm for computing
    /// sample variances".
    #[must_use]
    pub fn weighted_mean(parts: impl IntoIterator<Item = (Self, T)>) -> Option<Self> {
        let (mut total, mut mean, mut covariance) = (0.0, [0.0; 2], [0.0; 3]);
        for (part, weight) in parts {
            // A part of no weight says nothing, nor does one without a slope.
            if weight == T::ZERO || !part.is_finite() {
                continue;
            }
            let weight = weight.to_f64();
            total += weight;
            let (m, c) = (part.mean.map(T::to_f64), part.covariance.map(T::to_f64));
            (mean, covariance) = mixed((mean, covariance), (m, c), weight / total);
        }
        // Not for NaN either.
        (total > 0.0).then(|| Self { mean: mean.map(T::lit), covariance: covariance.map(T::lit) })
    }

    /// Moments of `1 − share` of these slopes and `share` of the others: a step of bilinear and
    /// trilinear filtering.
    ///
    /// # Special cases
    /// Where one of the two is not finite → the other.
    #[inline]
    #[must_use]
    pub fn lerp(&self, other: &Self, share: T) -> Self {
        match [self, other].map(Self::is_finite) {
            [_, false] => return *self,
            [false, true] => return *other,
            [true, true] => {}
        }
        let [a, b] = [self, other].map(|m| (m.mean.map(T::to_f64), m.covariance.map(T::to_f64)));
        let (mean, covariance) = mixed(a, b, share.to_f64());
        Self { mean: mean.map(T::lit), covariance: covariance.map(T::lit) }
    }

    /// The moments of bumps `scale` times as high. The strength of a layer: `base +
    /// detail.scaled(strength)`.
    #[inline]
    #[must_use]
    pub fn scaled(&self, scale: T) -> Self {
        Self { mean: self.mean.map(|x| scale * x), covariance: self.covariance.map(|x| (scale * x) * scale) }
    }

    /// The moments of J t: slopes in other coordinates.
    ///
    /// A slope is a gradient: if q are coordinates of the plane and u = f(q) those of the texture,
    /// a height h(u) has the slopes J ∂h/∂u with J = (∂u/∂q)ᵀ. A texture repeated k times (u = kq)
    /// is k times as steep.
    #[inline]
    #[must_use]
    pub fn transformed(&self, jacobian: T::Mat2) -> Self {
        let [[a, b], [c, d]] = T::columns(jacobian).map(|column| column.map(T::to_f64));
        let ([x, y], [xx, xy, yy]) = (self.mean.map(T::to_f64), self.covariance.map(T::to_f64));
        // The rows of J are (a, c) and (b, d).
        let form = |[p, q]: [f64; 2], [r, s]: [f64; 2]| p * r * xx + (p * s + q * r) * xy + q * s * yy;
        let (u, v) = ([a, c], [b, d]);
        Self {
            mean: [a * x + c * y, b * x + d * y].map(T::lit),
            covariance: [form(u, u), form(u, v), form(v, v)].map(T::lit),
        }
    }

    /// E\[t\].
    #[inline]
    #[must_use]
    pub fn mean_slope(&self) -> T::Vec2 {
        self.mean.into()
    }

    /// The normal of the mean slope.
    #[inline]
    #[must_use]
    pub fn mesonormal(&self) -> T::Vec3 {
        slope_to_normal(self.mean)
    }

    /// The covariance E\[ttᵀ\] − E\[t\]E\[t\]ᵀ about the mean slope, in the frame of the surface;
    /// the nearest that is positive semidefinite.
    #[inline]
    #[must_use]
    pub fn covariance(&self) -> Covariance<T> {
        // 0, or NaN for a mean that is not finite.
        let zero = T::ZERO * self.mean[0] + T::ZERO * self.mean[1];
        let [xx, xy, yy] = self.covariance.map(|entry| entry + zero);
        Covariance::nearest(xx, xy, yy)
    }

    /// The frame tilted to the [`mesonormal`](Self::mesonormal) and the covariance of slopes in it,
    /// to first order.
    ///
    /// For shading with the mesonormal as the normal. The frame is turned about z × n, as
    /// [`Frame::from_normal`] does; along the tilt a slope t + dt becomes cos²θ dt there, across it
    /// cosθ dt: J = cosθ (I − (1 − cosθ) r rᵀ), r the direction of the tilt.
    ///
    /// # Accuracy
    /// Relative to the covariance, of the order of σ tanθ; exact for a mean of 0.
    ///
    /// # Example
    /// ```
    /// use microsurface::{filter::{Covariance, normal_map::Moments}, glam::Vec2};
    /// let kernel = Covariance::isotropic(0.01_f32);
    /// let tilted_by_45_degrees = Moments::new(Vec2::new(1.0, 0.0), kernel);
    /// let (_, covariance) = tilted_by_45_degrees.tilted();
    /// let [along, _, across] = covariance.entries();
    /// assert!((along - 0.01 / 4.0).abs() < 1e-8 && (across - 0.01 / 2.0).abs() < 1e-8);
    /// ```
    #[must_use]
    pub fn tilted(&self) -> (Frame<T>, Covariance<T>) {
        let normal = self.mesonormal();
        let [x, y, z]: [T; 3] = normal.into();
        // z r rᵀ (1 − z), with sin²θ = (1 − z)(1 + z) and n.xy = sinθ r.
        let s = z / (T::ONE + z);
        let off_diagonal = -(s * (x * y));
        let jacobian = T::matrix([[z - s * (x * x), off_diagonal], [off_diagonal, z - s * (y * y)]]);
        (Frame::from_normal(normal), self.covariance().transformed(jacobian))
    }
}

impl<T: Real> Add for Moments<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            mean: [0, 1].map(|i| self.mean[i] + other.mean[i]),
            covariance: [0, 1, 2].map(|i| self.covariance[i] + other.covariance[i]),
        }
    }
}

type Wide = ([f64; 2], [f64; 3]);

/// 1 − f of the one and f of the other.
#[inline]
fn mixed((m, c): Wide, (n, d): Wide, f: f64) -> Wide {
    let [x, y] = [n[0] - m[0], n[1] - m[1]];
    let g = f * (1.0 - f);
    let between = [g * (x * x), g * (x * y), g * (y * y)];
    ([m[0] + f * x, m[1] + f * y], [0, 1, 2].map(|i| (1.0 - f) * c[i] + f * d[i] + between[i]))
}
