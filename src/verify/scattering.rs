//! The checks of a BSDF.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::{Cell, RefCell};
use core::panic::AssertUnwindSafe;
use std::panic::catch_unwind;

use super::bsdf::{About, Bsdf};
use super::directions::{Names, Sampler};
use super::float::{Float, dot, hex, narrow, relative, view, wide};
use super::report::{Report, Seen, Verdict};
use super::{ARGUMENTS, Kit};
use crate::real::Vector;

/// A direction, its weight and its pdf.
type Drawn<T> = Option<([T; 3], T, T)>;

/// The closures at arguments in f64, with what went wrong in them.
struct Tested<'a, T> {
    eval: &'a dyn Fn([T; 3], [T; 3]) -> T,
    pdf: &'a dyn Fn([T; 3], [T; 3]) -> T,
    sample: &'a dyn Fn([T; 3], [T; 2]) -> Drawn<T>,
    transmits: bool,
    /// The first panic, and how many there were.
    panicked: RefCell<Option<String>>,
    panics: Cell<usize>,
}

/// The components of two directions, each of which may be rounded by an ulp.
const COMPONENTS: f64 = 6.0;
/// After so many panics nothing is called any more by a group of checks.
const MOST_PANICS: usize = 20;

impl<T: Float> Tested<'_, T> {
    fn caught<R>(&self, what: &str, at: impl Fn() -> String, call: impl FnOnce() -> R) -> Option<R> {
        if self.panics.get() >= MOST_PANICS {
            return None;
        }
        let result = catch_unwind(AssertUnwindSafe(call)).ok();
        if result.is_none() {
            self.panics.set(self.panics.get() + 1);
            self.panicked.borrow_mut().get_or_insert_with(|| format!("{what} panicked at {}", at()));
        }
        result
    }

    fn eval(&self, wi: [T; 3], wo: [T; 3]) -> f64 {
        let at = || format!("wi {} wo {}", hex(&wi), hex(&wo));
        self.caught("eval", at, || (self.eval)(wi, wo).to_f64()).unwrap_or(f64::NAN)
    }

    fn pdf(&self, wi: [T; 3], wo: [T; 3]) -> f64 {
        let at = || format!("wi {} wo {}", hex(&wi), hex(&wo));
        self.caught("pdf", at, || (self.pdf)(wi, wo).to_f64()).unwrap_or(f64::NAN)
    }

    fn sample(&self, wo: [T; 3], u: [T; 2]) -> Option<([T; 3], f64, f64)> {
        let at = || format!("wo {} u {}", hex(&wo), hex(&u));
        let sample = self.caught("sample", at, || (self.sample)(wo, u))?;
        let (wi, weight, pdf) = sample?;
        // Renderers have it for none: to the other side, with nothing.
        let none = !self.transmits && (wi[2] < T::ZERO) != (wo[2] < T::ZERO) && weight == T::ZERO;
        (!none).then(|| (wi, weight.to_f64(), pdf.to_f64()))
    }

    /// The relative change of a function where a component of wi or wo changes by an ulp: what its
    /// value may be off by without being wrong.
    fn spread(wi: [T; 3], wo: [T; 3], f: impl Fn([T; 3], [T; 3]) -> f64) -> f64 {
        let middle = f(wi, wo);
        let mut spread = 0.0_f64;
        for k in 0..3 {
            for ulps in [-1, 1] {
                let (mut i, mut o) = (wi, wo);
                i[k] = i[k].stepped(ulps);
                o[k] = o[k].stepped(ulps);
                for moved in [f(i, wo), f(wi, o)] {
                    let change = (moved - middle).abs() / middle.abs().max(f64::MIN_POSITIVE);
                    // Next to an edge of its support a function is 0 or not.
                    spread = spread.max(if change.is_nan() { 0.0 } else { change });
                }
            }
        }
        spread
    }
}

/// The value of a closure, or NaN, which no check accepts, if it panics.
fn or_nan(call: impl FnOnce() -> f64) -> f64 {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or(f64::NAN)
}

const SAMPLES: Names = Names {
    usable: "samples: unit vectors with a pdf",
    integral: "∫ pdf = the share of samples that are",
    cells: "sample against pdf, χ²",
    near: "sample against pdf, distance from the peak, KS",
    around: "sample against pdf, azimuth, KS",
    weights: "mean weight = ∫ f |cos|",
};

impl Kit {
    /// Checks a BSDF: its sampler against its pdf, its weights against quadrature of its values,
    /// reciprocity, the furnace, and that everything is finite.
    pub fn bsdf<V, T, E, P, S>(&self, bsdf: &Bsdf<V, E, P, S>) -> Report
    where
        V: Vector<3, Scalar = T> + From<[T; 3]>,
        T: Float,
        E: Fn(V, V) -> T,
        P: Fn(V, V) -> T,
        S: Fn(V, [T; 2]) -> Option<(V, T, T)>,
    {
        let eval = |wi: [T; 3], wo: [T; 3]| (bsdf.eval)(wi.into(), wo.into());
        let pdf = |wi: [T; 3], wo: [T; 3]| (bsdf.pdf)(wi.into(), wo.into());
        let sample = |wo: [T; 3], u: [T; 2]| {
            (bsdf.sample)(wo.into(), u).map(|(wi, weight, pdf)| (wi.components(), weight, pdf))
        };
        let transmits = bsdf.about.eta.is_some();
        let tested = Tested {
            eval: &eval,
            pdf: &pdf,
            sample: &sample,
            transmits,
            panicked: RefCell::default(),
            panics: Cell::new(0),
        };
        let about = bsdf.about;
        let mut report = Report::new(self.false_alarms);
        self.every_argument(&mut report, &tested, about);
        tested.panics.set(0);
        self.every_sample(&mut report, &tested, about);
        tested.panics.set(0);
        self.every_view(&mut report, &tested, about);
        let panicked = tested.panicked.into_inner();
        let verdict = if panicked.is_some() { Verdict::Failed } else { Verdict::Passed };
        report.push_verdict("no panic", verdict, panicked.unwrap_or_default());
        report.judge()
    }
}

impl Kit {
    fn every_view<T: Float>(&self, report: &mut Report, tested: &Tested<'_, T>, about: About) {
        let mut arguments = self.arguments(5);
        let mut views = self.views::<T>(&mut arguments);
        if about.both() {
            let below: Vec<[T; 3]> = views.iter().map(|&[x, y, z]| [x, y, -z]).collect();
            views.extend(below);
        }
        let mut furnace = Seen::default();
        for wo in views {
            let view = view(wo);
            let sampler = Sampler {
                view: view.clone(),
                sample: &|u| tested.sample(wo, u).map(|(wi, weight, _)| (wi, weight)),
                density: &|wi| tested.pdf(narrow(wi), wo),
                integrand: Some(&|wi| about.with_cos(tested.eval(narrow(wi), wo), wi)),
                may_miss: true,
                below: about.both(),
            };
            let sides = self.sampler(report, &sampler, &SAMPLES, &mut arguments);
            // In equilibrium radiance is proportional to the square of the index.
            let of = about.index(wide(wo));
            let scale = |upper: bool| {
                let index = about.index([0.0, 0.0, if upper { 1.0 } else { -1.0 }]);
                (index / of) * (index / of)
            };
            let sum = |k: usize| -> f64 { sides.iter().map(|(upper, found)| scale(*upper) * found[k]).sum() };
            let (value, bound) = (sum(0), sum(1));
            furnace.see((value - bound - 1.0).max(0.0), || {
                format!("{value:.6} ± {bound:.0e} is reflected, {view}")
            });
        }
        report.push("∫ f |cos| ≤ 1 (furnace)", furnace, self.tolerance::<T>());
    }

    /// Checks every argument: values are finite, reciprocal and have the symmetry of the surface.
    fn every_argument<T: Float>(&self, report: &mut Report, tested: &Tested<'_, T>, about: About) {
        let [mut finite, mut reciprocal, mut symmetric, mut long] = [(); 4].map(|()| Seen::default());
        let mut arguments = self.arguments(6);
        for i in 0..ARGUMENTS {
            let mut wo = arguments.direction::<T>();
            let mut wi = arguments.partner(wo);
            if about.both() && i % 2 == 1 {
                wo[2] = -wo[2];
            }
            if about.eta.is_some() && i % 3 == 1 {
                wi[2] = -wi[2];
            }
            let at = || format!("wi {} wo {}", hex(&wi), hex(&wo));
            let (f, pdf) = (tested.eval(wi, wo), tested.pdf(wi, wo));
            for (name, x) in [("f", f), ("pdf", pdf)] {
                let wrong = if x.is_finite() && x >= 0.0 { 0.0 } else { f64::INFINITY };
                finite.see(wrong, || format!("{name} = {x:e}, {}", at()));
            }
            // A renderer's vectors are not of unit length to the last bit.
            let scale = T::ONE + T::lit(if i % 2 == 0 { 3.0 } else { -3.0 }) * T::EPSILON;
            let stretched = |w: [T; 3]| w.map(|c| c * scale);
            for x in [tested.eval(stretched(wi), stretched(wo)), tested.pdf(stretched(wi), stretched(wo))] {
                let wrong = if x.is_finite() && x >= 0.0 { 0.0 } else { f64::INFINITY };
                long.see(wrong, || format!("{x:e}, {} times {}", at(), scale.hex()));
            }
            let cosine = wi[2].abs().min(wo[2].abs()).to_f64();
            if i % 4 != 0 || cosine <= 0.0 {
                continue;
            }
            let rounding = Self::rounding_of::<T>(cosine);
            let f = |wi: [T; 3], wo: [T; 3]| {
                tested.eval(wi, wo) / if about.with_cosine { wi[2].to_f64().abs() } else { 1.0 }
            };
            let value = f(wi, wo);
            if about.reciprocal {
                let square = |w: [T; 3]| about.index(wide(w)) * about.index(wide(w));
                let deviation = relative::<T>(value * square(wi), f(wo, wi) * square(wo));
                if deviation > 0.0 {
                    let slack = rounding + 8.0 * Tested::spread(wi, wo, f);
                    reciprocal.see((deviation - slack).max(0.0), at);
                } else {
                    reciprocal.see(deviation, at);
                }
            }
            if about.isotropic {
                // A quarter of a turn, and the mirror image, are exact.
                let turned = |[x, y, z]: [T; 3]| [-y, x, z];
                let mirrored = |[x, y, z]: [T; 3]| [x, -y, z];
                let deviation = relative::<T>(value, f(turned(wi), turned(wo)))
                    .max(relative::<T>(value, f(mirrored(wi), mirrored(wo))));
                let slack = if deviation > 0.0 { rounding + 8.0 * Tested::spread(wi, wo, f) } else { 0.0 };
                symmetric.see((deviation - slack).max(0.0), at);
            }
        }
        let allowed = self.tolerance::<T>();
        report.push("f and pdf finite and not negative", finite, 0.0);
        report.push("the same of vectors 3 ε too long or short", long, 0.0);
        if about.reciprocal {
            report.push("f(wi, wo) = f(wo, wi), with η² if transmitted", reciprocal, allowed);
        }
        if about.isotropic {
            report.push("f turned and mirrored is f", symmetric, allowed);
        }
    }

    /// Checks every sample: its pdf is `pdf`, its weight is f cos/pdf.
    fn every_sample<T: Float>(&self, report: &mut Report, tested: &Tested<'_, T>, about: About) {
        let [mut usable, mut pdfs, mut weights] = [(); 3].map(|()| Seen::default());
        let mut arguments = self.arguments(7);
        for i in 0..ARGUMENTS {
            // By turns ordinary views and points, and those where code breaks.
            let (mut wo, u) = if i % 2 == 0 {
                (arguments.direction::<T>(), arguments.numbers::<T>())
            } else {
                let view = self.angles[i % self.angles.len()].to_radians();
                let phi = arguments.within(0.0, core::f64::consts::TAU);
                let w = [view.sin() * phi.cos(), view.sin() * phi.sin(), view.cos()];
                (narrow(w), arguments.point::<T>())
            };
            if about.both() && i % 4 > 1 {
                wo[2] = -wo[2];
            }
            let Some((wi, weight, own)) = tested.sample(wo, u) else { continue };
            let at = || format!("wo {} u {} gives wi {}", hex(&wo), hex(&u), hex(&wi));
            let d = wide(wi);
            let unit = (dot(d, d) - 1.0).abs() <= 64.0 * T::EPSILON.to_f64();
            let side = about.eta.is_some() || (d[2] >= 0.0) == (wo[2] >= T::ZERO);
            let fine = unit && side && weight.is_finite() && weight >= 0.0 && own.is_finite() && own > 0.0;
            usable.see(if fine { 0.0 } else { f64::INFINITY }, || {
                format!("weight {weight:e}, pdf {own:e}, {}", at())
            });
            let cosine = wi[2].abs().min(wo[2].abs()).to_f64();
            if !fine || cosine <= 0.0 {
                continue;
            }
            let rounding = Self::rounding_of::<T>(cosine);
            let (pdf, f) = (tested.pdf(wi, wo), tested.eval(wi, wo));
            let slack = |f: &dyn Fn([T; 3], [T; 3]) -> f64| rounding + COMPONENTS * Tested::spread(wi, wo, f);
            let allowed = self.tolerance::<T>();
            let off_pdf = relative::<T>(own, pdf);
            let excess = if off_pdf > allowed { off_pdf - slack(&|i, o| tested.pdf(i, o)) } else { off_pdf };
            pdfs.see(excess.max(0.0), || format!("returned {own:e}, pdf {pdf:e}, {}", at()));
            let expected = about.with_cos(f, d) / pdf;
            let off_weight = relative::<T>(weight, expected);
            let excess = if off_weight > allowed {
                off_weight - slack(&|i, o| about.with_cos(tested.eval(i, o), wide(i)) / tested.pdf(i, o))
            } else {
                off_weight
            };
            weights.see(excess.max(0.0), || format!("returned {weight:e}, f cos/pdf {expected:e}, {}", at()));
        }
        let allowed = self.tolerance::<T>();
        report.push("every sample usable", usable, 0.0);
        report.push("the pdf of a sample is pdf at it", pdfs, allowed);
        report.push("the weight of a sample is f cos/pdf", weights, allowed);
    }

    /// Compares a BSDF in f32 with the same in f64, at arguments that both hold. A difference that
    /// rounding the arguments would make is none.
    pub fn precision<V, W, E, P, S, D, Q, R>(
        &self,
        single: &Bsdf<V, E, P, S>,
        double: &Bsdf<W, D, Q, R>,
    ) -> Report
    where
        V: Vector<3, Scalar = f32> + From<[f32; 3]>,
        W: Vector<3, Scalar = f64> + From<[f64; 3]>,
        E: Fn(V, V) -> f32,
        P: Fn(V, V) -> f32,
        D: Fn(W, W) -> f64,
        Q: Fn(W, W) -> f64,
    {
        let mut report = Report::new(self.false_alarms);
        let [mut values, mut pdfs] = [(); 2].map(|()| Seen::default());
        let mut arguments = self.arguments(8);
        for _ in 0..ARGUMENTS {
            let wo = arguments.direction::<f32>();
            let wi = arguments.partner(wo);
            let cosine = wi[2].min(wo[2]);
            if cosine <= 0.0 {
                continue;
            }
            let rounding = Self::rounding_of::<f32>(cosine.into());
            let at = |a: f64, b: f64| format!("{a:e} and {b:e}, wi {} wo {}", hex(&wi), hex(&wo));
            let exact = |f: &dyn Fn(W, W) -> f64, wi: [f32; 3], wo: [f32; 3]| {
                or_nan(|| f(wide(wi).into(), wide(wo).into()))
            };
            let compare = |seen: &mut Seen, narrow: f64, f: &dyn Fn(W, W) -> f64| {
                let wide = exact(f, wi, wo);
                if wide < f64::from(f32::MIN_POSITIVE) && narrow < 2.0 * f64::from(f32::MIN_POSITIVE) {
                    return;
                }
                let off = (narrow - wide).abs() / wide.abs().max(f64::MIN_POSITIVE);
                let slack = if off > 0.0 {
                    rounding + COMPONENTS * Tested::spread(wi, wo, |i, o| exact(f, i, o))
                } else {
                    0.0
                };
                seen.see((off - slack).max(0.0), || at(narrow, wide));
            };
            compare(&mut values, or_nan(|| (single.eval)(wi.into(), wo.into()).into()), &double.eval);
            compare(&mut pdfs, or_nan(|| (single.pdf)(wi.into(), wo.into()).into()), &double.pdf);
        }
        let allowed = self.tolerance::<f32>();
        report.push("f in f32 against f64", values, allowed);
        report.push("pdf in f32 against f64", pdfs, allowed);
        report.judge()
    }
}
