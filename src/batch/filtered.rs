//! Materials filtered over the footprint of each element.

use crate::Real;
use crate::alpha::alpha_range;
use crate::batch::blocks::{Source, composed};
use crate::batch::varied::Variation;
use crate::error::Error;
use crate::filter::{Covariance, Footprint, projected};
use crate::ggx::Ggx;
use crate::map::{Linear, Map};
use crate::microsurface::Microsurface;
use crate::profile::ShapeInvariant;

/// A [`Footprint`] for each element, its steps by components in four slices of equal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprints<'a, T> {
    /// First components of the steps along u.
    pub du_x: &'a [T],
    /// Second components of the steps along u.
    pub du_y: &'a [T],
    /// First components of the steps along v.
    pub dv_x: &'a [T],
    /// Second components of the steps along v.
    pub dv_y: &'a [T],
}

/// Footprints whose A + 2Σ is within the range of α, and the variance of the pixel's kernel: Σ =
/// σ²(uᵀu + vᵀv).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InRange<'a, T> {
    footprints: Footprints<'a, T>,
    variance: T,
}

impl<'a, T: Real> InRange<'a, T> {
    fn new(footprints: Footprints<'a, T>, variance: T) -> Result<Self, Error> {
        let (_, largest) = alpha_range::<T>();
        let Footprints { du_x, du_y, dv_x, dv_y } = footprints;
        let scale = variance.sqrt();
        // NaN and negative variances are refused too. A quarter: 2Σ has up to eight squares, A one.
        let valid = |&step: &T| scale * step.abs() <= T::lit(0.25) * largest;
        if [du_x, du_y, dv_x, dv_y].iter().all(|steps| steps.iter().fold(true, |all, step| all & valid(step)))
        {
            return Ok(Self { footprints, variance });
        }
        let invalid = |&[ux, uy, vx, vy]: &[T; 4]| ![ux, uy, vx, vy].iter().all(valid);
        let steps =
            du_x.iter().zip(du_y).zip(dv_x).zip(dv_y).map(|(((&ux, &uy), &vx), &vy)| [ux, uy, vx, vy]);
        let [ux, uy, vx, vy] = steps.into_iter().find(invalid).unwrap_or([T::INFINITY; 4]).map(T::to_f64);
        let variance = variance.to_f64();
        let entry = |a: f64, b: f64, c: f64, d: f64| variance * (a * b + c * d);
        Err(Error::Covariance {
            xx: entry(ux, ux, vx, vx),
            xy: entry(ux, uy, vx, vy),
            yy: entry(uy, uy, vy, vy),
        })
    }
}

#[inline(always)]
fn covariance<T: Real>([ux, uy, vx, vy]: [T; 4], variance: T) -> Covariance<T> {
    Footprint::new([ux, uy], [vx, vy]).covariance(variance)
}

macro_rules! filtered {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name<'a, T> {
            in_range: InRange<'a, T>,
        }

        impl<'a, T: Real> $name<'a, T> {
            /// Filtered over these footprints by a kernel of this variance, in pixels²;
            /// [`covariance`](crate::filter::covariance) names the usual ones.
            ///
            /// # Errors
            /// [`Error::Covariance`] with the Σ of the first footprint that is not finite or has a
            /// step larger than a quarter of the largest α; of the variance, if it is not finite or
            /// negative.
            pub fn new(footprints: Footprints<'a, T>, variance: T) -> Result<Self, Error> {
                Ok(Self { in_range: InRange::new(footprints, variance)? })
            }
        }

        composed!(source ['a, T: Copy] $name<'a, T>, [T; 4] = (in_range: InRange<'a, T> => 0), |steps| steps.0);
    };
}
filtered!(
    /// Surfaces filtered over the footprint in slopes of each element, as by
    /// [`Microsurface::filtered`]: A + 2Σ.
    ///
    /// # Example
    /// ```
    /// use microsurface::batch::{Directions, Filtered, Footprints, NdfBatch, Varied};
    /// use microsurface::filter::{Footprint, covariance::variance_of_box};
    /// use microsurface::{Beckmann, Ndf, glam::{Vec2, Vec3}};
    /// let surface = Beckmann::isotropic(0.01_f32)?;
    /// let footprints = Footprints {
    ///     du_x: &[0.02, 0.0],
    ///     du_y: &[0.0, 0.0],
    ///     dv_x: &[0.01, 0.0],
    ///     dv_y: &[0.01, 0.0],
    /// };
    /// let filtered = Varied::new(&surface, Filtered::new(footprints, variance_of_box())?);
    /// let mut d = [0.0; 2];
    /// filtered.d_batch(Directions { x: &[0.0; 2], y: &[0.0; 2], z: &[1.0; 2] }, &mut d);
    /// let footprint = Footprint::new(Vec2::new(0.02, 0.0), Vec2::new(0.01, 0.01));
    /// assert_eq!(d[0], surface.filtered(footprint.covariance(variance_of_box()))?.d(Vec3::Z));
    /// # Ok::<(), microsurface::Error>(())
    /// ```
    Filtered
);
filtered!(
    /// GGX surfaces filtered over the footprint of each element in the projected space of m.xy, as
    /// by [`projected::filtered`].
    FilteredProjected
);

impl<P: ShapeInvariant, M: Map> Variation<Microsurface<P, M>> for Filtered<'_, M::Scalar> {
    type Surface = Microsurface<P, Linear<M::Scalar>>;
    type Prepared = (Microsurface<P, M>, M::Scalar);
    #[inline(always)]
    fn prepared(&self, surface: &Microsurface<P, M>) -> Self::Prepared {
        (*surface, self.in_range.variance)
    }
    #[inline(always)]
    fn varied((surface, variance): &Self::Prepared, steps: [M::Scalar; 4]) -> Self::Surface {
        surface.filtered_in_range(covariance(steps, *variance))
    }
}

impl<M: Map> Variation<Microsurface<Ggx, M>> for FilteredProjected<'_, M::Scalar> {
    type Surface = Microsurface<Ggx, Linear<M::Scalar>>;
    type Prepared = (projected::OnDisc, M::Scalar);
    #[inline(always)]
    fn prepared(&self, surface: &Microsurface<Ggx, M>) -> Self::Prepared {
        (projected::OnDisc::new(surface.map()), self.in_range.variance)
    }
    #[inline(always)]
    fn varied((surface, variance): &Self::Prepared, steps: [M::Scalar; 4]) -> Self::Surface {
        Microsurface::new(Ggx, Linear::triangular(surface.convolved(covariance(steps, *variance))))
    }
}

composed!(
    source ['a, T: Copy] Footprints<'a, T>, [T; 4] =
    (du_x: &'a [T] => 0, du_y: &'a [T] => 1, dv_x: &'a [T] => 2, dv_y: &'a [T] => 3), |steps| steps.into()
);
composed!(source ['a, T: Copy] InRange<'a, T>, [T; 4] = (footprints: Footprints<'a, T> => 0), |steps| steps.0);
