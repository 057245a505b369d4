//! Distributions: every profile under every map, wrappers and mixtures.

use microsurface::beckmann::BeckmannTo1e6;
use microsurface::filter::{Covariance, gaussian};
use microsurface::gtr::Density;
use microsurface::gtr::components::Components;
use microsurface::gtr::table::GtrTable;
use microsurface::profile::{Profile, SampleProfile, SampleVisibleProfile};
use microsurface::transform::Transformed;
use microsurface::{
    Beckmann, Error, Ggx, Gtr, Isotropic, Linear, Microsurface, Real, RoughnessMatrix, SampleNdf, SampleVndf,
};

use crate::random::Random;
use crate::rows::{Distribution, Row, Visitor};
use crate::{Hash, Record, name};

/// Arguments of a function of one surface.
const COUNT: usize = 500;

fn evaluated<N: SampleNdf>(record: &mut Record, of: &str, surface: &N) {
    let scalar = name::<N::Scalar>();
    let mut each = |function: &str, f: &dyn Fn(&mut Random, &mut Hash)| {
        record.group(format!("{of} {scalar} {function}"), |hash| {
            let mut random = Random(1);
            for _ in 0..COUNT {
                f(&mut random, hash);
            }
        });
    };
    each("d", &|r, h| h.add(surface.d(r.anywhere::<N::Scalar>().into())));
    each("d_along", &|r, h| {
        let size = N::Scalar::lit(r.decades(-3.0, 3.0));
        h.add(surface.d_along(r.above::<N::Scalar>().map(|c| size * c).into()));
    });
    each("p22", &|r, h| h.add(surface.p22(r.slope::<N::Scalar>(1.0).into())));
    each("sigma", &|r, h| h.add(surface.sigma(r.anywhere::<N::Scalar>().into())));
    each("sigma_above", &|r, h| h.add(surface.sigma_above(r.above::<N::Scalar>().into())));
    each("lambda", &|r, h| h.add(surface.lambda(r.anywhere::<N::Scalar>().into())));
    each("g1", &|r, h| h.add(surface.g1(r.anywhere::<N::Scalar>().into(), r.above::<N::Scalar>().into())));
    each("g2", &|r, h| {
        let [i, o, m] = [r.anywhere::<N::Scalar>(), r.above(), r.above()].map(Into::into);
        h.add(surface.g2(i, o, m));
        h.add(surface.g2_separable(i, o, m));
    });
    each("vndf", &|r, h| {
        h.add(surface.vndf(r.anywhere::<N::Scalar>().into(), r.above::<N::Scalar>().into()));
    });
    each("sample_d", &|r, h| {
        let normal = surface.sample_d(r.numbers::<N::Scalar>().into());
        h.three::<N::Scalar>(normal);
        h.add(surface.pdf_d(normal));
    });
}

fn sampled<N: SampleVndf>(record: &mut Record, of: &str, surface: &N) {
    record.group(format!("{of} {} sample_vndf", name::<N::Scalar>()), |hash| {
        let mut random = Random(2);
        for _ in 0..COUNT {
            let (w, u) = (random.anywhere::<N::Scalar>(), random.numbers::<N::Scalar>());
            hash.three::<N::Scalar>(surface.sample_vndf(w.into(), u.into()));
        }
    });
}

fn both<N: SampleNdf + SampleVndf>(record: &mut Record, of: &str, surface: &N) {
    evaluated(record, of, surface);
    sampled(record, of, surface);
}

/// The matrices that surfaces are moved by.
fn moves<T: Real>() -> [T::Mat2; 2] {
    [[[1.3, -0.4], [0.7, 0.9]], [[0.2, 1.1], [-2.0, 0.5]]]
        .map(|columns| T::matrix(columns.map(|column| column.map(T::lit))))
}

/// The same profile under each map, moved and stretched.
macro_rules! under_every_map {
    ($record:expr, $name:literal, $profile:ident, $t:ident) => {
        let l = $t::lit;
        let isotropic = $profile::isotropic(l(0.2)).unwrap();
        both($record, concat!($name, " isotropic"), &isotropic);
        both($record, concat!($name, " smooth"), &$profile::isotropic(l(1e-4)).unwrap());
        both($record, concat!($name, " rough"), &$profile::isotropic(l(30.0)).unwrap());
        let aligned = $profile::anisotropic(l(0.05), l(0.7)).unwrap();
        both($record, concat!($name, " axis-aligned"), &aligned);
        let matrix = RoughnessMatrix::new(l(0.04), l(-0.07), l(0.3)).unwrap();
        both($record, concat!($name, " linear"), &$profile::from_roughness_matrix(matrix));
        let rotated = RoughnessMatrix::rotated(l(1.0), l(1e-3), l(0.7)).unwrap();
        both($record, concat!($name, " rotated"), &$profile::from_roughness_matrix(rotated));
        both($record, concat!($name, " moved"), &aligned.transformed(moves::<$t>()[0]).unwrap());
        both($record, concat!($name, " stretched"), &isotropic.stretched(l(0.6)).unwrap());
    };
}

fn gtr<T: Real>(record: &mut Record) {
    let l = T::lit;
    for (gamma, which) in
        [(0.5, "0.5"), (1.0, "1"), (1.5, "1.5"), (2.0, "2"), (2.5, "2.5"), (3.4, "3.4"), (8.5, "8.5")]
    {
        let surface = Gtr::isotropic(l(0.1), l(gamma)).unwrap();
        both(record, &format!("GTR {which} isotropic"), &surface);
        both(record, &format!("GTR {which} moved"), &surface.transformed(moves::<T>()[1]).unwrap());
    }
    both(record, "GTR narrow", &Gtr::isotropic(l(1e-3), l(1.2)).unwrap());
    both(record, "GTR wide", &Gtr::isotropic(l(1.0), l(3.0)).unwrap());
    both(record, "GTR 4 nodes", &Gtr::with_nodes::<4>(l(0.3), l(1.7)).unwrap());
    both(record, "GTR 12 nodes", &Gtr::with_nodes::<12>(l(0.3), l(2.7)).unwrap());
    both(record, "GTR heavy", &Gtr::heavy_tailed::<8>(l(0.3), l(1.3)).unwrap());
    both(
        record,
        "GTR heavy stretched",
        &Gtr::heavy_tailed::<6>(l(0.3), l(1.3)).unwrap().stretched(l(-0.3)).unwrap(),
    );
    evaluated(record, "GTR spline", &Gtr::spline(l(0.2), l(1.4)).unwrap());
    let table = GtrTable::<T, 8>::new(l(2.5), l(1e-3)).unwrap();
    both(record, "GTR of a table", &table.isotropic(l(0.17)).unwrap());
    let table = GtrTable::<T, 8>::new(l(1.5), l(1e-3)).unwrap();
    both(record, "heavy GTR of a table", &table.heavy_tailed(l(0.017)).unwrap());
    record.group(format!("GTR {} density and components", name::<T>()), |hash| {
        let mut random = Random(3);
        for _ in 0..200 {
            let (alpha, gamma) = (l(random.decades(-3.0, 0.0)), l(random.within(0.0, 10.0)));
            hash.add(Density::new(alpha, gamma).unwrap().d(random.anywhere::<T>().into()));
            for component in Components::new(alpha, gamma).unwrap().iter() {
                hash.all(&[component.weight, component.alpha, component.gamma]);
            }
        }
    });
}

/// Every row: below its widths, and moved.
struct Every<'a>(&'a mut Record, Distribution);

impl Every<'_> {
    /// The name, and the surfaces.
    fn surfaces<T: Real, P: Profile<T>>(
        &self,
        profile: impl Fn(T, T) -> Result<P, Error>,
    ) -> [(String, Microsurface<P, Linear<T>>); 2] {
        let profile = self.1.profile(profile).unwrap();
        let still = Microsurface::new(profile, Linear::from(Isotropic::new(T::lit(0.6)).unwrap()));
        let moved = still.transformed(moves::<T>()[1]).unwrap();
        [(format!("row {:?}", self.1), still), (format!("row {:?} moved", self.1), moved)]
    }
}

impl<T: Real> Visitor<T> for Every<'_> {
    type Output = ();

    fn visible<P>(self, profile: impl Fn(T, T) -> Result<P, Error>)
    where
        P: SampleProfile<T> + SampleVisibleProfile<T>,
    {
        self.surfaces(profile).iter().for_each(|(name, surface)| both(self.0, name, surface));
    }

    fn all_normals<P: SampleProfile<T>>(self, profile: impl Fn(T, T) -> Result<P, Error>) {
        self.surfaces(profile).iter().for_each(|(name, surface)| evaluated(self.0, name, surface));
    }
}

pub(crate) fn all<T: Real>(record: &mut Record) {
    under_every_map!(record, "GGX", Ggx, T);
    under_every_map!(record, "Beckmann", Beckmann, T);
    both(record, "Beckmann to 1e-6", &BeckmannTo1e6::isotropic(T::lit(0.3)).unwrap());
    gtr::<T>(record);
    for distribution in Row::ALL.iter().flat_map(|row| row.of_width(0.2)) {
        distribution.row.visit::<T, _>(Every(record, distribution));
    }
    let [x, y] = [0.02, 0.3].map(T::lit);
    let ggx = Ggx::isotropic(T::lit(0.1)).unwrap();
    both(record, "convolved GGX", &gaussian::filtered(&ggx, Covariance::axis_aligned(x, y)).unwrap());
    both(
        record,
        "convolved GGX of two",
        &gaussian::filtered_by_two(&ggx, Covariance::axis_aligned(x, y)).unwrap(),
    );
    let [first, second] = moves::<T>();
    both(record, "wrapped GGX", &Transformed::new(ggx, first).unwrap());
    let beckmann = Beckmann::anisotropic(x, y).unwrap();
    both(
        record,
        "wrapped Beckmann",
        &Transformed::new(beckmann, first).unwrap().transformed(second).unwrap(),
    );
    let gtr = Gtr::isotropic(T::lit(0.1), T::lit(2.5)).unwrap();
    both(record, "wrapped GTR", &Transformed::new(gtr, second).unwrap());
    both(record, "borrowed Beckmann", &&beckmann);
    walter::<T>(record);
}

fn walter<T: Real>(record: &mut Record) {
    record.group(format!("Beckmann {} fits of Walter", name::<T>()), |hash| {
        let surface = Beckmann::anisotropic(T::lit(0.3), T::lit(0.6)).unwrap();
        let mut random = Random(4);
        for _ in 0..COUNT {
            let w = random.anywhere::<T>().into();
            hash.all(&[surface.g1_walter2007(w), surface.lambda_walter2007(w)]);
        }
    });
}
