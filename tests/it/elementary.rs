//! The elementary functions against 50-digit values (f64), and f32 against f64.
//!
//! All 2³² f32 numbers of every function are in `elementary/every_f32.rs`.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::float_cmp,
    reason = "tests round to f32 on purpose, and compare special values exactly"
)]

mod every_f32;

use microsurface::elementary as e;

use crate::random::Random;
use crate::worst::Worst;

/// A function and the largest error it may have, in ulp of the exact value.
struct Budget {
    name: &'static str,
    double: fn(f64, f64) -> f64,
    single: fn(f32, f32) -> f32,
    /// f64: bound, and where the worst of the table is attained.
    f64: (f64, f64),
    /// f32: bound, and where the worst known is attained.
    f32: (f64, f64),
    /// Where half of the random f32 arguments are drawn uniformly; the others are random bits.
    domain: (f32, f32),
}

macro_rules! budget {
    ($($name:literal, $double:expr, $single:expr, $f64:expr, $f32:expr, $domain:expr;)*) => {
        &[$(Budget { name: $name, double: $double, single: $single, f64: $f64, f32: $f32, domain: $domain }),*]
    };
}

/// Function for f64 and f32; bound in ulp and where the worst is for f64, the same for f32; domain.
#[rustfmt::skip]
const BUDGET: &[Budget] = budget! {
    "exp",            |x, _| e::exp(x),              |x, _| e::exp(x),              (1.1, -710.4536), (1.0, 48.908), (-104.0, 89.0);
    "exp2",           |x, _| e::exp2(x),             |x, _| e::exp2(x),             (1.0, -132.44773), (1.1, 0.5534895), (-151.0, 129.0);
    "exp_neg_square", |x, _| e::exp_neg_square(x),   |x, _| e::exp_neg_square(x),   (1.0, 9.618), (1.0, 0.5857), (-10.5, 10.5);
    "exp_m1",         |x, _| e::exp_m1(x),           |x, _| e::exp_m1(x),           (1.5, 0.3465736), (2.0, 0.34835047), (-2.0, 2.0);
    "ln",             |x, _| e::ln(x),               |x, _| e::ln(x),               (0.9, core::f64::consts::SQRT_2), (0.9, 1.40546), (0.5, 2.0);
    "log2",           |x, _| e::log2(x),             |x, _| e::log2(x),             (0.7, core::f64::consts::SQRT_2), (0.9, 1.4129), (0.5, 2.0);
    "ln_1p",          |x, _| e::ln_1p(x),            |x, _| e::ln_1p(x),            (1.5, 0.4142136), (1.6, 0.42009), (-1.0, 2.0);
    "pow",            e::pow_wide,                   |x, g| e::pow_wide(f64::from(x), g), (0.9, 0.2314177), (0.8, 1.495945), (0.0, 4.0);
    "sin_turns",      |x, _| e::sin_cos_turns(x).0,  |x, _| e::sin_cos_turns(x).0,  (1.7, -0.4167125), (1.75, -7.917152), (-2.0, 2.0);
    "cos_turns",      |x, _| e::sin_cos_turns(x).1,  |x, _| e::sin_cos_turns(x).1,  (1.7, 0.3402042), (1.75, -1.832848), (-2.0, 2.0);
    "atan2",          e::atan2,                      e::atan2,                      (1.8, 0.4142136), (1.85, 0.3905881), (-3.0, 3.0);
    "erf",            |x, _| e::erf(x),              |x, _| e::erf(x),              (5.5, 3.93), (6.0, 3.3330584), (-4.0, 4.0);
    "erfc",           |x, _| e::erfc(x),             |x, _| e::erfc(x),             (5.5, 5.567562), (6.0, 3.6562011), (-4.0, 10.1);
    "erfcx",          |x, _| e::erfcx(x),            |x, _| e::erfcx(x),            (5.5, 16384.0), (7.0, 1189.482), (-9.5, 20.0);
    "ierfcx",         |x, _| e::ierfcx(x),           |x, _| e::ierfcx(x),           (6.0, 10534456.0), (8.5, 192.51855), (0.0, 20.0);
    "erf_inv",        |x, _| e::erf_inv(x),          |x, _| e::erf_inv(x),          (4.5, 0.9841825), (5.5, 0.99527097), (-1.0, 1.0);
    "erfc_inv",       |x, _| e::erfc_inv(x),         |x, _| e::erfc_inv(x),         (6.0, 1.967934e-19), (8.0, 1.544362e-29), (0.0, 2.0);
};

/// ulp of `exp_wide` for f32; relative error of `ln_wide` for f32.
const EXP_WIDE: (f64, f64) = (0.75, -25.247);
const LN_WIDE: f64 = 5e-12;

/// The worst error, in ulp, and its arguments.
type WorstUlp = Worst<(f64, f64)>;

impl WorstUlp {
    /// `error` is the difference from `want` of a number with `digits` digits and this least
    /// exponent.
    fn see_ulp(&mut self, at: (f64, f64), error: f64, want: f64, digits: i32, least: i32) {
        let exponent = ((want.abs().to_bits() >> 52) as i32 - 1023).max(least);
        self.see(error * 2f64.powi(digits - 1) / 2f64.powi(exponent), || at);
    }

    /// Within the bound, and not so far within that the bound is a lie.
    fn check(self, name: &str, (bound, seen_at): (f64, f64), failures: &mut Vec<String>) {
        let Self { error: ulp, at: (x, g), .. } = self;
        println!("{name:22} {ulp:6.3} ulp at {x:e} {g:e}   (bound {bound}, once at {seen_at:e})");
        if !(ulp <= bound && ulp >= bound / 2.0) {
            failures.push(format!("{name}: worst {ulp} ulp at {x:e} {g:e}, stated {bound}"));
        }
    }
}

fn double(worst: &mut WorstUlp, at: (f64, f64), got: f64, high: f64, low: f64) {
    if got != high || got.is_finite() {
        worst.see_ulp(at, (got - high) - low, high, 53, -1022);
    }
}

fn single(worst: &mut WorstUlp, at: (f32, f32), got: f32, want: f64) {
    // NaN with NaN, infinity with what rounds to it
    if !(got.is_nan() && want.is_nan() || got == want as f32) || got.is_finite() {
        worst.see_ulp((f64::from(at.0), f64::from(at.1)), f64::from(got) - want, want, 24, -126);
    }
}

/// The rows of the table for a function: arguments and the value as a sum.
fn rows(name: &str) -> impl Iterator<Item = [f64; 4]> {
    include_str!("../reference/elementary.tsv").lines().filter_map(move |line| {
        let mut fields = line.split('\t');
        (fields.next() == Some(name)).then(|| {
            let mut number = || fields.next().expect("five columns").parse().expect("a number");
            [number(), number(), number(), number()]
        })
    })
}

#[test]
fn f64_is_as_accurate_as_stated() {
    let mut failures = Vec::new();
    for budget in BUDGET {
        let mut worst = WorstUlp::default();
        for [x, g, high, low] in rows(budget.name) {
            double(&mut worst, (x, g), (budget.double)(x, g), high, low);
        }
        worst.check(budget.name, budget.f64, &mut failures);
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn f32_is_within_its_bound_on_the_table() {
    for budget in BUDGET {
        let mut worst = WorstUlp::default();
        for [x, g, high, _] in rows(budget.name) {
            let at = (x as f32, g as f32);
            if f64::from(at.0) == x && f64::from(at.1) == g {
                single(&mut worst, at, (budget.single)(at.0, at.1), high);
            }
        }
        assert!(worst.error <= budget.f32.0, "{}: {worst:?}", budget.name);
    }
}

#[test]
fn f32_is_as_accurate_as_stated() {
    let mut failures = Vec::new();
    for budget in BUDGET {
        let (mut worst, mut random) = (WorstUlp::default(), Random(1));
        for i in 0..1_000_000 {
            let bits = random.bits() as u32;
            let uniform = f64::from(bits) * 2f64.powi(-32);
            let (from, to) = budget.domain;
            let x = if i % 2 == 0 { f32::from_bits(bits) } else { from + (to - from) * uniform as f32 };
            let span = 90.0 * (2.0 * random.unit() - 1.0);
            let g = match budget.name {
                "pow" => (span / e::ln(f64::from(x))) as f32,
                "atan2" => (span / 30.0) as f32,
                _ => 0.0,
            };
            single(&mut worst, (x, g), (budget.single)(x, g), (budget.double)(f64::from(x), f64::from(g)));
        }
        worst.check(budget.name, budget.f32, &mut failures);
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// e^x and ln x of f64 arguments, for f32: in ulp, and relative.
#[test]
fn wide_arguments_are_used_to_all_digits() {
    let (mut exp, mut ln, mut random, mut failures) = (WorstUlp::default(), 0f64, Random(2), Vec::new());
    for _ in 0..500_000 {
        let x = -104.0 + 193.0 * random.unit();
        single(&mut exp, (x as f32, 0.0), e::exp_wide(x), e::exp(x));
        let x = f64::from_bits(random.bits() >> 1);
        let x = if x.is_finite() { x } else { 0.5 + random.unit() };
        for x in [x, 0.5 + random.unit(), 1.0 - 1e-3 * random.unit()] {
            ln = ln.max((e::ln_wide::<f32>(x) / e::ln(x) - 1.0).abs());
        }
    }
    exp.check("exp_wide", EXP_WIDE, &mut failures);
    println!("ln_wide 2^{}", ln.log2());
    assert!((LN_WIDE / 2.0..=LN_WIDE).contains(&ln), "{ln:e}");
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn nan_gives_nan() {
    // Also those whose digits are all in the lower half.
    let singles = [f32::NAN, -f32::NAN, f32::from_bits(0x7f80_0001), f32::from_bits(0xff80_0100)];
    let doubles = [f64::NAN, f64::from_bits(0x7ff0_0000_0000_0001), f64::from_bits(0xfff0_0000_0010_0000)];
    for budget in BUDGET {
        for x in doubles {
            assert!((budget.double)(x, 1.0).is_nan(), "{}", budget.name);
        }
        for x in singles {
            assert!((budget.single)(x, 1.0).is_nan(), "{}", budget.name);
        }
    }
    assert!(e::pow_wide(1.5, f64::NAN).is_nan() && e::pow_wide(1.5, f32::NAN).is_nan());
    assert!(e::pow_wide(f64::NAN, 0.0_f64).is_nan() && e::pow_wide(f64::NAN, 0.0_f32).is_nan());
    assert!(e::exp_wide::<f32>(f64::NAN).is_nan() && e::ln_wide::<f32>(f64::NAN).is_nan());
}

/// Function, argument, exact value, for both scalars; NaN stands for NaN.
#[test]
#[rustfmt::skip]
fn special_values() {
    let (inf, nan) = (f32::INFINITY, f32::NAN);
    let cases: &[(&str, f32, f32)] = &[
        ("exp", -inf, 0.0), ("exp", inf, inf), ("exp", 0.0, 1.0), ("exp", -0.0, 1.0), ("exp", 800.0, inf),
        ("exp", -800.0, 0.0), ("exp", f32::MAX, inf), ("exp", -f32::MAX, 0.0),
        ("exp2", -inf, 0.0), ("exp2", inf, inf), ("exp2", 0.0, 1.0), ("exp2", -0.0, 1.0), ("exp2", 1024.0, inf),
        ("exp2", -1076.0, 0.0), ("exp2", f32::MAX, inf), ("exp2", -f32::MAX, 0.0), ("exp2", -149.0, 1e-45),
        ("exp2", 127.0, 1.701_411_8e38), ("exp2", -3.0, 0.125),
        ("exp_neg_square", inf, 0.0), ("exp_neg_square", -inf, 0.0), ("exp_neg_square", 0.0, 1.0),
        ("exp_m1", -inf, -1.0), ("exp_m1", inf, inf), ("exp_m1", 0.0, 0.0), ("exp_m1", -0.0, -0.0),
        ("exp_m1", -1e4, -1.0), ("exp_m1", 1e4, inf), ("exp_m1", 1e-40, 1e-40),
        ("ln", 0.0, -inf), ("ln", -0.0, -inf), ("ln", inf, inf), ("ln", -inf, nan), ("ln", -1.0, nan),
        ("ln", 1.0, 0.0), ("ln", -1e-40, nan),
        ("log2", 0.0, -inf), ("log2", -0.0, -inf), ("log2", inf, inf), ("log2", -inf, nan), ("log2", -1.0, nan),
        ("log2", 1.0, 0.0), ("log2", -1e-40, nan), ("log2", 1e-45, -149.0), ("log2", 1.701_411_8e38, 127.0),
        ("log2", 0.125, -3.0),
        ("ln_1p", -1.0, -inf), ("ln_1p", -1.5, nan), ("ln_1p", inf, inf), ("ln_1p", -inf, nan),
        ("ln_1p", 0.0, 0.0), ("ln_1p", -0.0, -0.0), ("ln_1p", -1e-40, -1e-40),
        ("sin_turns", 0.0, 0.0), ("sin_turns", -0.0, -0.0), ("sin_turns", inf, nan), ("sin_turns", 0.25, 1.0),
        ("sin_turns", 0.5, 0.0), ("sin_turns", -0.75, 1.0), ("sin_turns", 8388609.0, 0.0),
        ("sin_turns", 4194304.5, 0.0), ("sin_turns", -4194303.75, 1.0),
        ("cos_turns", 0.25, 0.0), ("cos_turns", 0.5, -1.0), ("cos_turns", -inf, nan), ("cos_turns", 1e30, 1.0),
        ("cos_turns", 4194304.5, -1.0), ("cos_turns", -7.5, -1.0),
        ("erf", inf, 1.0), ("erf", -inf, -1.0), ("erf", 0.0, 0.0), ("erf", -0.0, -0.0), ("erf", 6.0, 1.0),
        ("erfc", inf, 0.0), ("erfc", -inf, 2.0), ("erfc", 0.0, 1.0), ("erfc", 28.0, 0.0), ("erfc", -7.0, 2.0),
        ("erfcx", inf, 0.0), ("erfcx", -inf, inf), ("erfcx", 0.0, 1.0), ("erfcx", -27.0, inf),
        ("ierfcx", inf, 0.0), ("ierfcx", -inf, nan), ("ierfcx", -1e-30, nan),
        ("erf_inv", 1.0, inf), ("erf_inv", -1.0, -inf), ("erf_inv", 0.0, 0.0), ("erf_inv", -0.0, -0.0),
        ("erf_inv", 1.0000001, nan), ("erf_inv", -2.0, nan), ("erf_inv", inf, nan), ("erf_inv", -inf, nan),
        ("erfc_inv", 0.0, inf), ("erfc_inv", 2.0, -inf), ("erfc_inv", 1.0, 0.0), ("erfc_inv", -1e-30, nan),
        ("erfc_inv", 2.0000002, nan), ("erfc_inv", inf, nan), ("erfc_inv", -inf, nan),
    ];
    for &(name, x, want) in cases {
        let budget = BUDGET.iter().find(|budget| budget.name == name).expect("a function of the table");
        let (single, double) = ((budget.single)(x, 0.0), (budget.double)(f64::from(x), 0.0));
        let same = |got: f64| got.is_nan() && want.is_nan() || got == f64::from(want);
        let signed = |got: f64| want != 0.0 || x != 0.0 || got.is_sign_negative() == want.is_sign_negative();
        let single = f64::from(single);
        let double_same = same(double) || x.abs() < 1e-38 && double == f64::from(x);
        assert!(same(single) && signed(single), "{name} {x}: f32 {single}");
        assert!(double_same && signed(double), "{name} {x}: f64 {double}");
    }
    assert_eq!(e::ierfcx(0.0_f64), core::f64::consts::FRAC_2_SQRT_PI / 2.0);
}

#[test]
#[rustfmt::skip]
fn special_powers() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for (x, g, want) in [
        (0.0, 2.0, 0.0), (0.0, -2.0, inf), (0.0, 0.0, 1.0), (inf, 0.0, 1.0), (inf, 0.5, inf), (inf, -0.5, 0.0),
        (1.0, 1e30, 1.0), (-1.0, 2.0, nan), (-1.0, 0.0, nan), (2.0, 1e30, inf), (2.0, -1e30, 0.0),
        (0.5, 1e30, 0.0), (2.0, 10.0, 1024.0), (2.0, inf, inf), (0.5, inf, 0.0), (4.0, -0.5, 0.5),
    ] {
        for got in [e::pow_wide(x, g), f64::from(e::pow_wide(x, g as f32))] {
            assert!(got == want || got.is_nan() && want.is_nan(), "{x}^{g}: {got}");
        }
    }
}

#[test]
#[rustfmt::skip]
fn special_angles() {
    let (inf, pi) = (f64::INFINITY, core::f64::consts::PI);
    for (y, x, want) in [
        (0.0, 1.0, 0.0), (-0.0, 1.0, -0.0), (0.0, -1.0, pi), (-0.0, -1.0, -pi), (0.0, 0.0, 0.0), (0.0, -0.0, pi),
        (-0.0, -0.0, -pi), (1.0, 0.0, pi / 2.0), (-1.0, 0.0, -pi / 2.0), (inf, 1.0, pi / 2.0), (1.0, inf, 0.0),
        (1.0, -inf, pi), (inf, inf, pi / 4.0), (-inf, -inf, -0.75 * pi), (1e-300, -1e300, pi),
        (f64::MAX, f64::MAX, pi / 4.0), (5e-324, 5e-324, pi / 4.0), (1.0, 1.0, pi / 4.0), (-1.0, 1.0, -pi / 4.0),
    ] {
        for (got, want) in [(e::atan2(y, x), want), (f64::from(e::atan2(y as f32, x as f32)), f64::from(want as f32))] {
            // Denormals of f64 are 0 in f32.
            if (y as f32 != 0.0 || y == 0.0) && (x as f32 != 0.0 || x == 0.0) {
                assert!(got == want && got.is_sign_negative() == want.is_sign_negative(), "{y} {x}: {got} {want}");
            }
        }
    }
    for (y, x) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN), (f64::NAN, inf), (0.0, f64::NAN)] {
        assert!(e::atan2(y, x).is_nan() && e::atan2(y as f32, x as f32).is_nan(), "{y} {x}");
    }
}

/// Values that must not jump where intervals or exponents meet: neighbours differ by the slope and
/// a few ulp.
#[test]
fn monotonic_where_the_slope_exceeds_the_error() {
    let decreasing: [fn(f32) -> f32; 3] = [e::erfc, e::erfcx, e::ierfcx];
    for f in decreasing {
        for i in 0..20_000 {
            let x = i as f32 * 2f32.powi(-11);
            assert!(f(x + 2f32.powi(-11)) < f(x) || f(x) == 0.0, "{x}");
        }
    }
    let increasing: [fn(f32) -> f32; 4] = [e::exp, e::exp_m1, e::ln, e::ln_1p];
    for f in increasing {
        for i in 0..20_000 {
            let x = i as f32 * 2f32.powi(-11);
            assert!(f(x + 2f32.powi(-11)) > f(x), "{x}");
        }
    }
}

/// The error function of its inverse is its argument, and so for the complement.
#[test]
fn inverses_invert() {
    let mut random = Random(3);
    for _ in 0..100_000 {
        let p = 2.0 * random.unit() - 1.0;
        assert!((e::erf(e::erf_inv(p)) - p).abs() < 1e-15, "{p}");
        let q = e::exp(-700.0 * random.unit());
        let x = e::erfc_inv(q);
        assert!((e::erfc(x) / q - 1.0).abs() < 1e-15 * (4.0 + 2.0 * x * x), "{q:e}");
    }
}
