//! The checks of a distribution of micronormals.

use alloc::format;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::directions::{Names, Sampler};
use super::float::{Float, dot, hex, narrow, relative, unit, view, wide, within};
use super::integral::{Integral, Precision, double};
use super::report::{Report, Seen};
use super::{ARGUMENTS, Kit};
use crate::Real;
use crate::ndf::{Ndf, SampleNdf, SampleVndf};

/// ln of the slopes between which everything is.
const U_ENDS: [f64; 2] = [-28.0, 32.0];

const NORMALS: Names = Names {
    usable: "sample_d: unit vectors with a density",
    integral: "∫ pdf_d = 1",
    cells: "sample_d against pdf_d, χ²",
    near: "sample_d, distance from the peak, KS",
    around: "sample_d, azimuth, KS",
    weights: "sample_d, weights",
};

const VISIBLE: Names = Names {
    usable: "sample_vndf: unit vectors with a density",
    integral: "∫ vndf = 1",
    cells: "sample_vndf against vndf, χ²",
    near: "sample_vndf, distance from the peak, KS",
    around: "sample_vndf, azimuth, KS",
    weights: "sample_vndf, weights",
};

/// A distribution in f64, at arguments rounded to its scalar.
struct Wide<'a, N: ?Sized>(&'a N);

impl<N: Ndf<Scalar: Float> + ?Sized> Wide<'_, N> {
    fn d(&self, m: [f64; 3]) -> f64 {
        self.0.d(narrow::<N::Scalar, 3>(m).into()).to_f64()
    }
    fn sigma(&self, w: [f64; 3]) -> f64 {
        self.0.sigma(narrow::<N::Scalar, 3>(w).into()).to_f64()
    }
    fn g1(&self, w: [f64; 3], m: [f64; 3]) -> f64 {
        self.0.g1(narrow::<N::Scalar, 3>(w).into(), narrow::<N::Scalar, 3>(m).into()).to_f64()
    }
    fn vndf(&self, w: [f64; 3], m: [f64; 3]) -> f64 {
        self.0.vndf(narrow::<N::Scalar, 3>(w).into(), narrow::<N::Scalar, 3>(m).into()).to_f64()
    }
}

/// ∫ f(m) dm over the normals that face w, in slopes of logarithmic size.
fn over_visible<const K: usize>(
    w: [f64; 3],
    f: impl Fn([f64; 3]) -> [f64; K],
    precision: Precision,
) -> Integral<K> {
    let breaks: Vec<f64> = (0..=8).map(|i| f64::from(i) * TAU / 8.0).collect();
    double(
        |phi, u| {
            let (r, (sin, cos)) = (u.exp(), phi.sin_cos());
            let z = 1.0 / r.hypot(1.0);
            // The area of slopes is r dr dφ, and dm = z³ of it.
            f([-r * z * cos, -r * z * sin, z]).map(|value| value * z * z * z * r * r)
        },
        &breaks,
        |phi| {
            let (sin, cos) = phi.sin_cos();
            // w·m > 0 is r (w.x cos + w.y sin) < w.z.
            let along = w[0] * cos + w[1] * sin;
            let [low, high] = U_ENDS;
            let edge = (w[2] / along).abs().ln().clamp(low, high);
            match (w[2] > 0.0, along > 0.0) {
                (true, true) => [low, edge],
                (true, false) => [low, high],
                (false, true) => [high, high],
                (false, false) => [edge, high],
            }
        },
        5.0,
        precision,
    )
}

/// The largest deviations of the values of D, Λ, G1, G2 and P22 from what they are made of.
#[derive(Default)]
struct Values {
    finite: Seen,
    range: Seen,
    definitions: Seen,
    slopes: Seen,
}

impl Kit {
    /// Checks D, σ, Λ, G1, G2, D_w and P22 of a distribution: ∫ D cos = 1, ∫ D max(0, w·m) = σ, the
    /// weak white furnace over normals and over directions, ∫ D_w = 1, and what follows from them
    /// at every argument.
    ///
    /// Views are the [`angles`](Kit::angles), and two below the horizon.
    pub fn ndf<N: Ndf<Scalar: Float> + ?Sized>(&self, ndf: &N) -> Report {
        let mut report = Report::new(self.false_alarms);
        let allowed = self.tolerance::<N::Scalar>();
        self.identities(&mut report, &Wide(ndf), allowed);
        self.values(&mut report, ndf, allowed);
        report.judge()
    }

    fn identities<N: Ndf<Scalar: Float> + ?Sized>(
        &self,
        report: &mut Report,
        ndf: &Wide<'_, N>,
        allowed: f64,
    ) {
        let [mut normalised, mut area, mut furnace, mut reflected, mut visible] =
            [(); 5].map(|()| Seen::default());
        // Rounding of D is noise to the quadrature.
        let noise = 4.0 * N::Scalar::EPSILON.to_f64();
        let precision = Precision { absolute: 0.0, relative: (0.1 * allowed).max(noise), panels: 400 };
        let [cos] = [over_visible([0.0, 0.0, 1.0], |m| [ndf.d(m) * m[2]], precision)];
        normalised.see_integral(cos.pair(0), 1.0, allowed, || "all normals".into());
        let mut arguments = self.arguments(1);
        let mut views = self.views::<N::Scalar>(&mut arguments);
        let below = |z: f64, phi: f64| {
            let r = (1.0 - z * z).sqrt();
            narrow([r * phi.cos(), r * phi.sin(), -z])
        };
        views.extend([below(0.05, 1.0), below(0.3, 4.0)]);
        for view in views {
            let w = wide(view);
            let at = || self::view(view);
            let sigma = ndf.sigma(w);
            if within(sigma, 1e-4) || sigma.is_nan() {
                // The little that is seen from far below has another scale than the quadrature.
                continue;
            }
            let found = over_visible(
                w,
                |m| {
                    let facing = ndf.d(m) * dot(w, m);
                    [
                        facing,
                        ndf.vndf(w, m),
                        if w[2] > 0.0 { facing * ndf.g1(w, m) } else { 0.0 },
                        half(ndf, w, m),
                    ]
                },
                precision,
            );
            area.see_integral(found.pair(0), sigma, allowed, at);
            visible.see_integral(found.pair(1), 1.0, allowed, at);
            if w[2] > 0.0 {
                furnace.see_integral(found.pair(2), w[2], allowed, at);
                reflected.see_integral(found.pair(3), 1.0, allowed, at);
            }
        }
        report.push("∫ D cos = 1", normalised, allowed);
        report.push("∫ D max(0, w·m) = σ(w)", area, allowed);
        report.push("∫ G1 D max(0, w·m) = w.z (weak white furnace)", furnace, allowed);
        report.push("∫ D(h) G1/(4 w.z) dwi = 1 (the same, over wi)", reflected, allowed);
        report.push("∫ D_w = 1", visible, allowed);
    }

    fn values<N: Ndf<Scalar: Float> + ?Sized>(&self, report: &mut Report, ndf: &N, allowed: f64) {
        let mut seen = Values::default();
        let mut arguments = self.arguments(2);
        for _ in 0..ARGUMENTS {
            let wo = arguments.direction::<N::Scalar>();
            let (wi, wm) = (arguments.partner(wo), arguments.partner(wo));
            values_at(ndf, [wi, wo, wm], &mut seen);
        }
        let Values { finite, range, definitions, slopes } = seen;
        report.push("D, σ, P22, D_w finite, not negative, 0 below", finite, 0.0);
        report.push("0 ≤ G2 ≤ G1 ≤ 1, G2 reciprocal, σ ≥ w.z", range, 16.0 * N::Scalar::EPSILON.to_f64());
        report.push("Λ, G1, G2, D_w by σ, D along h", definitions, allowed);
        report.push("P22 = D wm.z⁴", slopes, allowed);
    }

    /// Checks [`sample_d`](SampleNdf::sample_d) against [`pdf_d`](SampleNdf::pdf_d), and this
    /// against D cos.
    pub fn normals<N: SampleNdf<Scalar: Float> + ?Sized>(&self, ndf: &N) -> Report {
        let mut report = Report::new(self.false_alarms);
        let density = |m: [f64; 3]| ndf.pdf_d(narrow::<N::Scalar, 3>(m).into()).to_f64();
        let mut arguments = self.arguments(3);
        let mut defined = Seen::default();
        for _ in 0..ARGUMENTS {
            let wm = arguments.direction::<N::Scalar>();
            let (pdf, d) = (ndf.pdf_d(wm.into()), ndf.d(wm.into()));
            let expected = (d * wm[2]).to_f64();
            let off = (pdf.to_f64() - expected).abs();
            let tiny = N::Scalar::MIN_POSITIVE.to_f64();
            defined.see(if off <= tiny { 0.0 } else { off / expected }, || format!("wm {}", hex(&wm)));
        }
        report.push("pdf_d = D wm.z", defined, self.tolerance::<N::Scalar>());
        let sampler = Sampler {
            view: "all normals".into(),
            sample: &|u: [N::Scalar; 2]| Some((ndf.sample_d(u.into()).into(), 1.0)),
            density: &density,
            integrand: None,
            may_miss: false,
            below: false,
        };
        self.sampler(&mut report, &sampler, &NORMALS, &mut arguments);
        report.judge()
    }

    /// Checks [`sample_vndf`](SampleVndf::sample_vndf) against [`vndf`](Ndf::vndf) from every
    /// angle, and from below the horizon.
    pub fn visible_normals<N: SampleVndf<Scalar: Float> + ?Sized>(&self, ndf: &N) -> Report {
        let mut report = Report::new(self.false_alarms);
        let mut arguments = self.arguments(4);
        let mut views = self.views::<N::Scalar>(&mut arguments);
        views.push(narrow([0.98, 0.17, -0.1]));
        for view in views {
            let w: [N::Scalar; 3] = narrow(unit(wide(view)));
            if within(ndf.sigma(w.into()).to_f64(), 1e-6) {
                continue;
            }
            let sampler = Sampler {
                view: self::view(w),
                sample: &|u: [N::Scalar; 2]| Some((ndf.sample_vndf(w.into(), u.into()).into(), 1.0)),
                density: &|m: [f64; 3]| ndf.vndf(w.into(), narrow::<N::Scalar, 3>(m).into()).to_f64(),
                integrand: None,
                may_miss: false,
                below: false,
            };
            self.sampler(&mut report, &sampler, &VISIBLE, &mut arguments);
        }
        report.judge()
    }
}

/// D(h) G1/(4 w.z) at the wi that mirrors w about m, with its half vector made anew, times
/// dwi/dm = 4 w·m.
fn half<N: Ndf<Scalar: Float> + ?Sized>(ndf: &Wide<'_, N>, w: [f64; 3], m: [f64; 3]) -> f64 {
    let cos = dot(w, m);
    if w[2] <= 0.0 || cos <= 0.0 {
        return 0.0;
    }
    let wi: [f64; 3] = core::array::from_fn(|k| 2.0 * cos * m[k] - w[k]);
    let h = unit(core::array::from_fn(|k| wi[k] + w[k]));
    ndf.d(h) * ndf.g1(w, h) * cos / w[2]
}

/// The values at one pair of directions and a normal.
fn values_at<N: Ndf<Scalar: Float> + ?Sized>(ndf: &N, [wi, wo, wm]: [[N::Scalar; 3]; 3], seen: &mut Values) {
    let at = || format!("wi {} wo {} wm {}", hex(&wi), hex(&wo), hex(&wm));
    let f = |x: N::Scalar| x.to_f64();
    let tiny = f(N::Scalar::MIN_POSITIVE) * 64.0;
    let relative = relative::<N::Scalar>;
    let (vi, vo, vm) = (wi.into(), wo.into(), wm.into());
    let opposite = wm.map(|c| -c);
    let d = f(ndf.d(vm));
    let sigma = f(ndf.sigma(vo));
    let vndf = f(ndf.vndf(vo, vm));
    let mut numbers: Vec<(&str, f64)> = alloc::vec![("D", d), ("σ", sigma), ("D_w", vndf)];
    if opposite[2] < N::Scalar::ZERO {
        numbers.push(("D below", if ndf.d(opposite.into()) == N::Scalar::ZERO { 0.0 } else { f64::NAN }));
    }
    let slope = [-wm[0] / wm[2], -wm[1] / wm[2]];
    // Where the square of the slope has digits.
    let has_slope = wm[2] > N::Scalar::lit(1e-4);
    let p22 = if has_slope { f(ndf.p22(slope.into())) } else { 0.0 };
    numbers.push(("P22", p22));
    for (name, x) in numbers {
        let wrong = if x.is_finite() && x >= 0.0 { 0.0 } else { f64::INFINITY };
        seen.finite.see(wrong, || format!("{name} = {x:e}, {}", at()));
    }

    let (g1i, g1o) = (f(ndf.g1(vi, vm)), f(ndf.g1(vo, vm)));
    let (g2, back) = (f(ndf.g2(vi, vo, vm)), f(ndf.g2(vo, vi, vm)));
    let outside = [
        -g2,
        g1i - 1.0,
        g1o - 1.0,
        g2 - g1i.min(g1o),
        (g2 - back).abs(),
        (f(wo[2]) - sigma) / sigma.max(tiny),
    ];
    let outside = outside.into_iter().fold(0.0, |a: f64, b| if b.is_nan() { f64::NAN } else { a.max(b) });
    seen.range.see(outside, at);

    let facing = |w: [N::Scalar; 3]| dot(wide(w), wide(wm));
    // Nearer to the edge than rounding either side may be right.
    let faces = |w: [N::Scalar; 3]| facing(w) > 4.0 * N::Scalar::EPSILON.to_f64();
    if wo[2] > N::Scalar::lit(1e-6) && wi[2] > N::Scalar::lit(1e-6) {
        let lambda = f(ndf.lambda(vo));
        let z = f(wo[2]);
        let mut off = relative(z * (1.0 + lambda), sigma);
        if faces(wo) {
            off = off.max(relative(g1o, z / sigma));
            let rounding = Kit::rounding_of::<N::Scalar>(facing(wo));
            off = off.max((relative(vndf * sigma, facing(wo) * d) - rounding).max(0.0));
            if faces(wi) {
                off = off.max(relative(g2, 1.0 / (1.0 + lambda + f(ndf.lambda(vi)))));
            }
        }
        seen.definitions.see(off, || format!("Λ {lambda:e}, {}", at()));
    }
    if wm[2] > N::Scalar::ZERO {
        // Twice the normal is exact; what a direction an ulp away changes is no fault.
        let along = f(ndf.d_along(wm.map(|c| c + c).into()));
        let moved = [1, -1].map(|ulps| f(ndf.d(wm.map(|c| c.stepped(ulps)).into())));
        let spread = relative(moved[0], d).max(relative(moved[1], d));
        seen.definitions.see((relative(along, d) - 8.0 * spread).max(0.0), || format!("D along, {}", at()));
    }
    if has_slope {
        let z2 = f(wm[2]) * f(wm[2]);
        // A slope is rounded: at most by so much is D another.
        let moved = [1, -1].map(|ulps| f(ndf.p22(slope.map(|c| c.stepped(ulps)).into())));
        let spread = relative(moved[0], moved[1]);
        seen.slopes.see((relative(p22, d * z2 * z2) - 8.0 * spread).max(0.0), at);
    }
}
