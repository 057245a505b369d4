//! Batches: of one material, of a slice, and of one varied by numbers of each element.

use microsurface::batch::{
    self, AlphaPairs, Alphas, Directions, DirectionsMut, Filtered, FilteredProjected, Footprints, NdfBatch,
    Numbers, ReflectionBatch, RoughnessMatrices, Samples, Varied,
};
use microsurface::beckmann::BeckmannTo1e6;
use microsurface::bsdf::{AllNormals, RoughConductor, UniformMixture};
use microsurface::fresnel::{Schlick, Spectrum};
use microsurface::{Beckmann, Ggx, Gtr, Real};

use crate::random::Random;
use crate::{Hash, Record, name};

/// Elements, no multiple of a block.
const COUNT: usize = 999;

/// Components in slices.
struct Arguments<T> {
    wi: [Vec<T>; 3],
    wo: [Vec<T>; 3],
    wm: [Vec<T>; 3],
    u: [Vec<T>; 2],
}

impl<T: Real> Arguments<T> {
    fn new() -> Self {
        let mut random = Random(26);
        let mut three = |below: bool| {
            let all: Vec<[T; 3]> =
                (0..COUNT).map(|_| if below { random.anywhere() } else { random.above() }).collect();
            [0, 1, 2].map(|k| all.iter().map(|v| v[k]).collect())
        };
        let (wi, wo, wm) = (three(false), three(true), three(false));
        let numbers: Vec<[T; 2]> = (0..COUNT).map(|_| random.numbers()).collect();
        Self { wi, wo, wm, u: [0, 1].map(|k| numbers.iter().map(|u| u[k]).collect()) }
    }

    fn u(&self) -> Numbers<'_, T> {
        Numbers { x: &self.u[0], y: &self.u[1] }
    }
}

fn directions<T>([x, y, z]: &[Vec<T>; 3]) -> Directions<'_, T> {
    Directions { x, y, z }
}

/// The functions of distributions, by a macro: generic code over batches is not writable yet.
macro_rules! evaluated {
    ($record:expr, $name:expr, $t:ident, $surface:expr) => {
        $record.group(format!("batch of {} {}", $name, name::<$t>()), |hash: &mut Hash| {
            let a = Arguments::<$t>::new();
            let (wi, wo, wm) = (directions(&a.wi), directions(&a.wo), directions(&a.wm));
            let mut out = vec![$t::ZERO; COUNT];
            $surface.d_batch(wm, &mut out);
            hash.all(&out);
            $surface.sigma_batch(wo, &mut out);
            hash.all(&out);
            $surface.lambda_batch(wo, &mut out);
            hash.all(&out);
            $surface.g1_batch(wo, wm, &mut out);
            hash.all(&out);
            $surface.g2_batch(wi, wo, wm, &mut out);
            hash.all(&out);
            $surface.vndf_batch(wo, wm, &mut out);
            hash.all(&out);
            let (mut x, mut y, mut z) = (out.clone(), out.clone(), out.clone());
            $surface.sample_d_batch(a.u(), DirectionsMut { x: &mut x, y: &mut y, z: &mut z });
            hash.all(&[&x[..], &y[..], &z[..]].concat());
            $surface.sample_vndf_batch(wo, a.u(), DirectionsMut { x: &mut x, y: &mut y, z: &mut z });
            hash.all(&[&x[..], &y[..], &z[..]].concat());
        });
    };
}

macro_rules! reflected {
    ($record:expr, $name:expr, $t:ident, $brdf:expr) => {
        $record.group(format!("batch of reflection by {} {}", $name, name::<$t>()), |hash: &mut Hash| {
            let a = Arguments::<$t>::new();
            let (wi, wo) = (directions(&a.wi), directions(&a.wo));
            let mut out = vec![$t::ZERO; COUNT];
            $brdf.eval_batch(wi, wo, &mut out);
            hash.all(&out);
            $brdf.pdf_batch(wi, wo, &mut out);
            hash.all(&out);
            let mut pdf = out.clone();
            $brdf.eval_and_pdf_batch(wi, wo, &mut out, &mut pdf);
            hash.all(&[&out[..], &pdf[..]].concat());
            let (mut x, mut y, mut z) = (out.clone(), out.clone(), out.clone());
            let wi = DirectionsMut { x: &mut x, y: &mut y, z: &mut z };
            $brdf.sample_batch(wo, a.u(), Samples { wi, weight: &mut out, pdf: &mut pdf });
            // The direction of what is no sample has no meaning.
            for i in 0..COUNT {
                let lives = if pdf[i] > $t::ZERO { $t::ONE } else { $t::ZERO };
                hash.all(&[out[i], pdf[i]]);
                hash.all(&[x[i], y[i], z[i]].map(|c| if lives > $t::ZERO { c } else { lives }));
            }
        });
    };
}

pub(crate) fn all<T: Real + Spectrum<Scalar = T>>(record: &mut Record) {
    let l = T::lit;
    let (ggx, beckmann) = (Ggx::isotropic(l(0.2)).unwrap(), Beckmann::anisotropic(l(0.1), l(0.4)).unwrap());
    let quick = BeckmannTo1e6::isotropic(l(0.3)).unwrap();
    evaluated!(record, "GGX", T, ggx);
    evaluated!(record, "Beckmann", T, beckmann);
    evaluated!(record, "Beckmann to 1e-6", T, quick);
    for (gamma, which) in [(1.5, "1.5"), (2.5, "2.5"), (3.5, "3.5"), (5.5, "5.5")] {
        evaluated!(record, format!("GTR {which}"), T, Gtr::isotropic(l(0.2), l(gamma)).unwrap());
    }
    evaluated!(record, "GTR heavy", T, Gtr::heavy_tailed::<8>(l(0.2), l(1.2)).unwrap());
    evaluated!(record, "GTR closed", T, Gtr::closed::<3>(l(0.2)).unwrap());
    let mut random = Random(27);
    let mut numbers =
        |low: f64, high: f64| -> Vec<T> { (0..COUNT).map(|_| l(random.decades(low, high))).collect() };
    let (alphas, others, steps) = (numbers(-3.0, 0.0), numbers(-3.0, 0.0), numbers(-4.0, 0.0));
    let slice: Vec<_> = alphas.iter().map(|&alpha| Ggx::isotropic(alpha).unwrap()).collect();
    evaluated!(record, "a slice", T, slice[..]);
    evaluated!(record, "varied α", T, Varied::new(&ggx, Alphas::new(&alphas).unwrap()));
    evaluated!(
        record,
        "varied α of two axes",
        T,
        Varied::new(&beckmann, AlphaPairs::new(&alphas, &others).unwrap())
    );
    let (xx, yy): (Vec<T>, Vec<T>) = (alphas.clone(), others.clone());
    let xy: Vec<T> = xx.iter().zip(&yy).map(|(&x, &y)| l(0.5) * (x * y).sqrt()).collect();
    evaluated!(record, "varied A", T, Varied::new(&ggx, RoughnessMatrices::new(&xx, &xy, &yy).unwrap()));
    let footprints = Footprints { du_x: &steps, du_y: &alphas, dv_x: &others, dv_y: &steps };
    evaluated!(record, "filtered", T, Varied::new(&beckmann, Filtered::new(footprints, l(0.1)).unwrap()));
    evaluated!(
        record,
        "filtered in projected space",
        T,
        Varied::new(&ggx, FilteredProjected::new(footprints, l(0.1)).unwrap())
    );

    let fresnel = Schlick::new(l(0.3)).unwrap();
    reflected!(record, "GGX", T, RoughConductor::new(ggx, fresnel));
    reflected!(record, "Beckmann", T, RoughConductor::new(beckmann, fresnel));
    reflected!(record, "Beckmann to 1e-6", T, RoughConductor::new(quick, fresnel));
    reflected!(record, "GTR", T, RoughConductor::new(Gtr::isotropic(l(0.2), l(2.5)).unwrap(), fresnel));
    let mixture = UniformMixture::new(AllNormals, l(0.2)).unwrap();
    reflected!(record, "a mixture", T, RoughConductor::new(ggx, fresnel).sampled_by(mixture));
    reflected!(
        record,
        "a texture",
        T,
        Varied::new(&RoughConductor::new(ggx, fresnel), Alphas::new(&alphas).unwrap())
    );
    record.group(format!("batch of a function {}", name::<T>()), |hash| {
        let mut out = vec![T::ZERO; COUNT];
        batch::map(&alphas[..], &mut out[..], |alpha| microsurface::elementary::exp(alpha));
        hash.all(&out);
    });
}
