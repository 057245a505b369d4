//! The whole parameter space, hammered: nothing may be NaN, negative, infinite where the
//! documentation does not say so, above 1 where it is a share, or of the wrong length, and every
//! sample must have a density.
//!
//! The long form, 10⁸ evaluations or as many as the variable says, with its progress on stderr:
//! `MICROSURFACE_HAMMER=1e9 cargo test --release --test it hammer -- --ignored --nocapture`

use core::fmt::Write as _;
use std::collections::BTreeMap;

use microsurface::bsdf::{AllNormals, NormalSampling, RoughConductor, UniformMixture};
use microsurface::fresnel::{Conductor, Dielectric, Fresnel, Schlick};
use microsurface::roughness::alpha_range;
use microsurface::verify::Arguments;
use microsurface::{Ndf, SampleNdf, SampleVndf};
use rand_pcg::Pcg64Mcg;

use crate::properties::skewness;
use crate::rows::Row;
use crate::scalar::{Scalar, dot, wide};
use crate::surfaces::{Move, Shape, Spec, Surface, Widths};

/// The kit's arguments, and what surfaces are made of.
struct Random(Arguments<Pcg64Mcg>);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0.uniform()
    }

    fn below(&mut self, n: u32) -> u32 {
        (self.unit() * f64::from(n)) as u32
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0.within(low, high)
    }

    fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.0.decades(low, high)
    }

    fn alpha(&mut self) -> f64 {
        match self.below(8) {
            0 => 1.0,
            1 => 1e-8,
            2 => 1e4,
            3 => self.within(0.01, 1.0),
            _ => self.decades(-8.0, 4.0),
        }
    }

    fn gamma(&mut self) -> f64 {
        match self.below(4) {
            0 => f64::from(self.below(11)),
            1 => (f64::from(self.below(10)) + self.decades(-16.0, -1.0)).min(10.0),
            _ => self.within(0.0, 10.0),
        }
    }

    /// A refractive index: of glass, next to 1, or of any size.
    fn index(&mut self, largest: f64) -> f64 {
        let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
        match self.below(4) {
            0 => 1.0,
            1 => self.within(0.2, 5.0),
            2 => 1.0 + sign * self.decades(-17.0, -1.0),
            _ => self.decades(-largest, largest),
        }
    }

    fn correlation(&mut self) -> f64 {
        let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
        sign * if self.below(2) == 0 { self.unit() } else { 1.0 - self.decades(-6.0, 0.0) }
    }

    fn spec(&mut self) -> Spec {
        let shape = match self.below(6) {
            0 if self.below(2) == 0 => {
                let deviations = [self.alpha(), self.alpha()].map(|x| if x == 1e4 { 0.0 } else { x });
                Shape::Filtered { deviations, by_two: self.below(2) == 0 }
            }
            0 => Shape::Halves { alpha: self.alpha() },
            _ => {
                let alpha = if self.below(4) == 0 { 1.0 } else { self.decades(-8.0, 0.0) };
                Row::drawn(self.unit()).with(alpha, self.gamma()).into()
            }
        };
        let own_width = shape.distribution().is_some_and(|d| d.row.columns().own_width);
        let alpha = if own_width && self.below(2) == 0 { 1.0 } else { self.alpha() };
        let other = (alpha * self.decades(-6.0, 6.0)).clamp(1e-8, 1e4);
        let widths = match self.below(3) {
            0 => Widths::Isotropic(alpha),
            1 => Widths::AxisAligned(alpha, other),
            _ => Widths::Matrix { x: alpha, y: other, correlation: self.correlation() },
        };
        let moved = match self.below(6) {
            0 => Move::Transform(self.matrix()),
            1 => Move::Wrap(self.matrix()),
            2 => Move::Stretch(self.within(-1.0, 1.0)),
            _ => Move::Stay,
        };
        // What is no profile under a map is moved by a wrapper alone.
        let moved = match (shape, moved) {
            (Shape::Filtered { .. } | Shape::Halves { .. }, Move::Transform(_) | Move::Stretch(_)) => {
                Move::Stay
            }
            _ => moved,
        };
        Spec::new(shape, widths, moved)
    }

    fn matrix(&mut self) -> [[f64; 2]; 2] {
        core::array::from_fn(|_| core::array::from_fn(|_| self.within(-2.0, 2.0)))
    }

    /// A random number, 1 among them: generators of f32 round to it.
    fn number<T: Scalar>(&mut self) -> T {
        if self.below(9) == 0 { T::ONE } else { self.0.number() }
    }
}

/// How often each defect was seen, and where first.
#[derive(Default)]
struct Defects {
    evaluations: u64,
    seen: BTreeMap<String, (u64, String)>,
}

/// What a number may be besides finite and not negative.
#[derive(Clone, Copy, PartialEq)]
enum Range {
    Finite,
    UpToOne,
    /// The documentation names where it overflows.
    MayOverflow,
}

/// Above 0, and a number.
fn positive<T: Scalar>(x: T) -> bool {
    x > T::ZERO
}

/// The arguments of one round of evaluations.
struct Round<'a, T: Scalar> {
    defects: &'a mut Defects,
    surface: &'a Surface<T>,
    wi: [T; 3],
    wo: [T; 3],
    wm: [T; 3],
    u: [T; 2],
}

impl<T: Scalar> Round<'_, T> {
    fn defect(&mut self, name: &str, kind: &str, value: &str) {
        let Self { surface, wi, wo, wm, u, .. } = self;
        let place = || {
            let hex = |v: &[T]| v.iter().map(|c| c.hex()).collect::<Vec<_>>().join(", ");
            format!(
                "{value}\n  {surface:?}\n  wi [{}]\n  wo [{}]\n  wm [{}]\n  u [{}]",
                hex(wi),
                hex(wo),
                hex(wm),
                hex(u)
            )
        };
        let key = format!("{} {name}: {kind}", T::NAME);
        self.defects.seen.entry(key).or_insert_with(|| (0, place())).0 += 1;
    }

    fn number(&mut self, name: &str, value: T, range: Range) {
        self.defects.evaluations += 1;
        let kind = if value.to_f64().is_nan() {
            "NaN"
        } else if value < T::ZERO {
            "negative"
        } else if value == T::INFINITY && range != Range::MayOverflow {
            "∞"
        } else if value > T::ONE && range == Range::UpToOne {
            "above 1"
        } else {
            return;
        };
        self.defect(name, kind, &value.hex());
    }

    fn unit(&mut self, name: &str, v: [T; 3], roundings: f64) {
        let length2: f64 = wide(v).iter().map(|c| c * c).sum();
        let limit = 2.0 * roundings * T::EPSILON.to_f64();
        if length2.is_nan() || (length2 - 1.0).abs() > limit {
            self.defect(name, "not of unit length", &format!("|v|² − 1 = {:e}", length2 - 1.0));
        }
    }

    fn distribution(&mut self) {
        let Self { surface, wi: i, wo: o, wm: m, u, .. } = *self;
        let (wi, wo, wm): (T::Vec3, T::Vec3, T::Vec3) = (i.into(), o.into(), m.into());
        let below = o.map(|c| -c);
        self.number("d", surface.d(wm), Range::Finite);
        self.number("pdf_d", surface.pdf_d(wm), Range::Finite);
        self.number("d below", surface.d(m.map(|c| -c).into()), Range::Finite);
        self.number("sigma", surface.sigma(wo), Range::Finite);
        self.number("sigma below", surface.sigma(below.into()), Range::Finite);
        self.number("sigma − cos", surface.sigma(wo) - o[2], Range::Finite);
        // ∞ at the horizon, and where z Λ = σ is more than z times the largest number.
        self.number("lambda", surface.lambda(wo), Range::MayOverflow);
        self.number("g1", surface.g1(wo, wm), Range::UpToOne);
        self.number("g2", surface.g2(wi, wo, wm), Range::UpToOne);
        self.number("g2_separable", surface.g2_separable(wi, wo, wm), Range::UpToOne);
        self.number("vndf", surface.vndf(wo, wm), Range::Finite);
        if surface.sigma(below.into()) >= T::MIN_POSITIVE.sqrt() {
            self.number("vndf from below", surface.vndf(below.into(), wm), Range::Finite);
        }
        if m[2] > T::EPSILON {
            self.number("p22", surface.p22([-m[0] / m[2], -m[1] / m[2]].into()), Range::Finite);
        }
        let normal: [T; 3] = surface.sample_d(u.into()).into();
        self.unit("sample_d", normal, 3.0);
        self.number("sample_d z", normal[2], Range::Finite);
        if normal[2] > T::ZERO && !positive(surface.pdf_d(normal.into())) {
            self.defect("pdf_d of a sample", "zero", &format!("{normal:?}"));
        }
        self.defects.evaluations += 1;
        if !surface.samples_visible() {
            return;
        }
        for w in [o, below] {
            if w[2] < T::ZERO && surface.sigma(w.into()) < T::MIN_POSITIVE.sqrt() {
                // Next to the nadir nothing is visible: outside the domain.
                continue;
            }
            let normal: [T; 3] = surface.sample_vndf(w.into(), u.into()).into();
            let side = if w == below { "sample_vndf from below" } else { "sample_vndf" };
            self.unit(side, normal, 8.0);
            self.number(side, normal[2], Range::Finite);
            if !positive(dot(w, normal)) {
                self.defect(side, "turned away", &format!("w·m = {} of {normal:?}", dot(w, normal).hex()));
            }
            // A steep normal of a surface with very different widths is rounded to another slope: by
            // ε (1 + t²) beside the smaller width.
            let z2 = normal[2].to_f64() * normal[2].to_f64();
            let resolved = w == o || skewness(&surface.spec) * T::EPSILON.to_f64() <= 0.25 * z2;
            if resolved && !positive(surface.vndf(w.into(), normal.into())) {
                self.defect(side, "density zero", &format!("{normal:?}"));
            }
        }
    }

    fn reflection<F: Fresnel<Output = T>, S: NormalSampling<Surface<T>>>(
        &mut self,
        name: &str,
        brdf: &RoughConductor<Surface<T>, F, S>,
        bounded: bool,
    ) {
        let (wi, wo, u): (T::Vec3, T::Vec3, T::Vec2) = (self.wi.into(), self.wo.into(), self.u.into());
        self.number(&format!("{name} eval"), brdf.eval(wi, wo), Range::Finite);
        let h: [T; 3] = core::array::from_fn(|k| self.wi[k] + self.wo[k]);
        self.number(&format!("{name} pdf"), brdf.pdf(wi, wo), pdf_range(self.surface, h, bounded));
        self.defects.evaluations += 1;
        let Some(sample) = brdf.sample(wo, u) else { return };
        let direction: [T; 3] = sample.wi.into();
        self.unit(&format!("{name} sample"), direction, 12.0);
        self.number(&format!("{name} weight"), sample.weight, Range::Finite);
        if bounded && sample.weight > T::ONE + T::lit(16.0) * T::EPSILON {
            self.defect(&format!("{name} weight"), "above 1", &sample.weight.hex());
        }
        let h: [T; 3] = core::array::from_fn(|k| direction[k] + self.wo[k]);
        self.number(&format!("{name} sample pdf"), sample.pdf, pdf_range(self.surface, h, bounded));
        if !(positive(sample.pdf) && positive(direction[2])) {
            self.defect(&format!("{name} sample"), "without density", &format!("{sample:?}"));
        }
    }
}

/// D wm.z/(4 wo·wm), the density of reflection by all normals, overflows where the cosine
/// wo·wm = |h|/2 is small beside D: there ∞ is documented.
fn pdf_range<T: Scalar>(surface: &Surface<T>, h: [T; 3], bounded: bool) -> Range {
    let cosine = dot(h, h).sqrt().to_f64();
    let small = surface.d(h.map(|c| T::lit(c.to_f64() / cosine)).into()).to_f64().max(1.0) / T::MAX.to_f64();
    if bounded || cosine > 8.0 * small { Range::Finite } else { Range::MayOverflow }
}

/// Surfaces that can be built but not evaluated: principal widths so different that the nearest
/// normals are far apart in slope, or a GTR under a map so narrow that both together leave the
/// range of α.
fn beyond_the_scalar<T: Scalar>(spec: &Spec) -> bool {
    let [[a, b], [c, d]] = spec.factor::<T>();
    let smallest = (a * d - b * c).abs() / (a * a + b * b + c * c + d * d).sqrt();
    let own = spec.shape.distribution().map_or(1.0, |distribution| distribution.alpha);
    skewness(spec) > 0.25 / T::EPSILON.to_f64() || own * smallest < alpha_range::<T>().0.to_f64()
}

/// Rounds over both scalars until `evaluations` are done.
fn hammer(evaluations: u64, progress: impl Fn(u64)) {
    let mut defects = Defects::default();
    let mut random = Random(Arguments::new(Pcg64Mcg::new(0x6d69_6372_6f73)).merciless());
    while defects.evaluations < evaluations {
        let spec = random.spec();
        rounds::<f32>(&mut defects, &mut random, spec);
        rounds::<f64>(&mut defects, &mut random, spec);
        progress(defects.evaluations);
    }
    let mut report = String::new();
    for (kind, (count, first)) in &defects.seen {
        writeln!(report, "{kind}: {count} times, first {first}").expect("a string");
    }
    println!("{} evaluations, {} kinds of defects\n{report}", defects.evaluations, defects.seen.len());
    assert!(defects.seen.is_empty(), "{report}");
}

fn rounds<T: Scalar>(defects: &mut Defects, random: &mut Random, spec: Spec) {
    // Outside the range of the scalar; that such are refused is tested elsewhere.
    let Ok(surface) = spec.build::<T>() else { return };
    if beyond_the_scalar::<T>(&spec) {
        return;
    }
    let schlick = Schlick::new(random.number::<T>().min(T::ONE)).expect("a share");
    let glass = Dielectric::new(T::lit(random.index(37.0))).expect("an index");
    let glass = RoughConductor::new(surface.clone(), glass);
    let absorbs = if random.below(2) == 0 { 0.0 } else { random.index(8.9) };
    let metal = Conductor::new(T::lit(random.index(8.9)), T::lit(absorbs)).expect("indices");
    let metal = RoughConductor::new(surface.clone(), metal).sampled_by(AllNormals);
    // p = 0, both ends of what is left of the rounding, and anything between.
    let probability = random.number::<T>().min(T::BELOW_ONE);
    let mixture = UniformMixture::new(AllNormals, probability).expect("below 1");
    let mixed = RoughConductor::new(surface.clone(), schlick).sampled_by(mixture);
    let schlick = RoughConductor::new(surface.clone(), schlick);
    for _ in 0..8 {
        let wo = random.0.direction();
        let (wi, wm) = (random.0.partner(wo), random.0.partner(wo));
        let u = [random.number(), random.number()];
        let mut round = Round { defects, surface: &surface, wi, wo, wm, u };
        round.distribution();
        if surface.samples_visible() {
            round.reflection("Schlick", &schlick, true);
            round.reflection("dielectric", &glass, true);
        }
        round.reflection("conductor, all normals", &metal, false);
        round.reflection("mixture", &mixed, false);
    }
}

#[test]
fn a_million_evaluations() {
    hammer(1_000_000, |_| ());
}

#[test]
#[ignore = "minutes: see the module's documentation"]
fn as_many_evaluations_as_asked_for() {
    let asked = std::env::var("MICROSURFACE_HAMMER").map_or(1e8, |n| n.parse::<f64>().expect("a number"));
    let (total, shown) = (asked as u64, core::cell::Cell::new(0));
    hammer(total, |done| {
        let percent = 100 * done / total;
        if percent > shown.replace(percent) {
            eprintln!("{percent} % of {total} evaluations");
        }
    });
}
