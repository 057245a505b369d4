//! Reflection, and the Fresnel terms.

use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture, VisibleNormals};
use microsurface::filter::Footprint;
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Perfect, Schlick, Spectrum};
use microsurface::glam;
use microsurface::{Beckmann, Ggx, Gtr, Ndf, Real, SampleNdf, SampleVndf};

use crate::random::Random;
use crate::{Record, name};

const COUNT: usize = 1000;

fn reflected<N, S>(record: &mut Record, of: &str, surface: N, sampling: S)
where
    N: Ndf + Copy,
    N::Scalar: Spectrum<Scalar = N::Scalar>,
    S: NormalSampling<N> + Copy,
{
    let one = Schlick::new(N::Scalar::lit(0.3)).unwrap();
    let brdf = RoughConductor::new(surface, one).sampled_by(sampling);
    record.group(format!("{of} {} reflection", name::<N::Scalar>()), |hash| {
        let mut random = Random(5);
        for _ in 0..COUNT {
            let [i, o] = [random.above::<N::Scalar>(), random.anywhere()].map(Into::into);
            hash.all(&[brdf.eval(i, o), brdf.pdf(i, o)]);
            if let Some(sample) = brdf.sample(o, random.numbers::<N::Scalar>().into()) {
                hash.three::<N::Scalar>(sample.wi);
                hash.all(&[sample.weight, sample.pdf]);
            }
        }
    });
}

fn every_sampling<N>(record: &mut Record, of: &str, surface: N)
where
    N: SampleNdf + SampleVndf + Copy,
    N::Scalar: Spectrum<Scalar = N::Scalar>,
{
    reflected(record, of, surface, VisibleNormals);
    reflected(record, &format!("{of} by all normals"), surface, AllNormals);
    let mixture = UniformMixture::new(AllNormals, N::Scalar::lit(0.2)).unwrap();
    reflected(record, &format!("{of} by a mixture"), surface, mixture);
    let mixture = UniformMixture::new(VisibleNormals, N::Scalar::lit(0.3)).unwrap();
    reflected(record, &format!("{of} by a mixture of visible normals"), surface, mixture);
}

fn terms<T: Real + Spectrum<Scalar = T>>(record: &mut Record) {
    record.group(format!("Fresnel {}", name::<T>()), |hash| {
        let mut random = Random(6);
        for _ in 0..5000 {
            let cos = T::lit(if random.below(4) == 0 { random.decades(-6.0, 0.0) } else { random.unit() });
            let (n, k) = (T::lit(random.decades(-1.0, 1.0)), T::lit(random.decades(-3.0, 1.5)));
            hash.all(&[
                Perfect::<T>::new().reflectance(cos),
                Schlick::new(T::lit(random.unit())).unwrap().reflectance(cos),
                Dielectric::new(n).unwrap().reflectance(cos),
                Conductor::new(n, k).unwrap().reflectance(cos),
            ]);
        }
    });
}

fn gold(record: &mut Record) {
    record.group("gold".into(), |hash| {
        let gold =
            Conductor::new(glam::Vec3::new(0.19, 0.54, 1.33), glam::Vec3::new(3.40, 2.23, 1.87)).unwrap();
        let brdf = RoughConductor::new(Ggx::anisotropic(0.1_f32, 0.3).unwrap(), gold);
        let mut random = Random(7);
        for _ in 0..COUNT {
            let [i, o] = [random.above::<f32>(), random.above()].map(Into::into);
            hash.three::<f32>(brdf.eval(i, o));
        }
    });
}

fn over_footprints<T: Real + Spectrum<Scalar = T>>(record: &mut Record) {
    record.group(format!("reflection over footprints {}", name::<T>()), |hash| {
        let mut random = Random(8);
        let ggx = RoughConductor::new(Ggx::isotropic(T::lit(0.02)).unwrap(), Schlick::new(T::HALF).unwrap());
        let beckmann =
            RoughConductor::new(Beckmann::isotropic(T::lit(0.3)).unwrap(), Schlick::new(T::HALF).unwrap());
        for _ in 0..500 {
            let [i, o] = [random.above::<T>(), random.above()].map(Into::into);
            let footprint = Footprint::<T>::new(random.slope::<T>(0.05), random.slope::<T>(0.05));
            hash.all(&[ggx.eval_over(i, o, footprint), beckmann.eval_over(i, o, footprint)]);
        }
    });
}

pub(crate) fn all<T: Real + Spectrum<Scalar = T>>(record: &mut Record) {
    let l = T::lit;
    every_sampling(record, "GGX", Ggx::isotropic(l(0.3)).unwrap());
    every_sampling(record, "anisotropic GGX", Ggx::anisotropic(l(0.01), l(0.3)).unwrap());
    every_sampling(record, "Beckmann", Beckmann::isotropic(l(0.3)).unwrap());
    every_sampling(record, "GTR", Gtr::isotropic(l(0.3), l(1.5)).unwrap());
    every_sampling(record, "light GTR", Gtr::isotropic(l(0.3), l(3.5)).unwrap());
    terms::<T>(record);
    over_footprints::<T>(record);
    if name::<T>() == "f32" {
        gold(record);
    }
}
