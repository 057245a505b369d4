//! Adaptive quadrature with an error bound of its own.

use alloc::vec;
use alloc::vec::Vec;

/// The abscissae of the 15-point rule of Kronrod in (0, 1], from the end inwards; every second is
/// one of Gauss's 7.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_64,
    0.949_107_912_342_758_52,
    0.864_864_423_359_769_07,
    0.741_531_185_599_394_44,
    0.586_087_235_467_691_13,
    0.405_845_151_377_397_17,
    0.207_784_955_007_898_47,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_225,
    0.063_092_092_629_978_553,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_41,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_83,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_69, 0.279_705_391_489_276_67, 0.381_830_050_505_118_94, 0.417_959_183_673_469_39];

/// Integrals of `K` functions, and a bound of the error of each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integral<const K: usize> {
    pub(super) value: [f64; K],
    pub(super) bound: [f64; K],
}

impl<const K: usize> Integral<K> {
    pub(super) const ZERO: Self = Self { value: [0.0; K], bound: [0.0; K] };

    pub(super) fn add(&mut self, other: &Self) {
        self.value.iter_mut().zip(other.value).for_each(|(sum, value)| *sum += value);
        self.bound.iter_mut().zip(other.bound).for_each(|(sum, bound)| *sum += bound);
    }

    pub(super) fn pair(&self, k: usize) -> [f64; 2] {
        [self.value[k], self.bound[k]]
    }
}

/// One panel: both rules, and QUADPACK's estimate of the error (Piessens et al. 1983, QK15).
fn panel<const K: usize>(f: &mut impl FnMut(f64) -> [f64; K], low: f64, high: f64) -> Integral<K> {
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    let mut values = [[0.0; K]; 15];
    for (i, &node) in NODES.iter().enumerate() {
        values[i] = f(centre - half * node);
        if i < 7 {
            values[14 - i] = f(centre + half * node);
        }
    }
    let mut result = Integral::ZERO;
    for (k, (value, bound)) in result.value.iter_mut().zip(&mut result.bound).enumerate() {
        let at = |i: usize| if i == 7 { values[7][k] } else { values[i][k] + values[14 - i][k] };
        let kronrod: f64 = (0..8).map(|i| KRONROD[i] * at(i)).sum();
        let gauss: f64 = (0..4).map(|j| GAUSS[j] * at(2 * j + 1)).sum();
        let mean = 0.5 * kronrod;
        let spread: f64 = (0..15).map(|i| KRONROD[i.min(14 - i)] * (values[i][k] - mean).abs()).sum();
        let difference = (kronrod - gauss).abs();
        let estimate =
            if spread > 0.0 { spread * (200.0 * difference / spread).powf(1.5).min(1.0) } else { difference };
        // The rounding of the sum.
        let rounding = 16.0 * f64::EPSILON * kronrod.abs();
        *value = half * kronrod;
        // NaN stays, and is no bound.
        *bound = if kronrod.is_finite() { half.abs() * (estimate.max(rounding)) } else { f64::INFINITY };
    }
    result
}

/// The precision wanted: absolute, and relative to the integral.
#[derive(Debug, Clone, Copy)]
pub(super) struct Precision {
    pub(super) absolute: f64,
    pub(super) relative: f64,
    /// The largest number of panels.
    pub(super) panels: usize,
}

/// ∫ f over the panels between `breaks`, which are halved where the error is largest.
pub(super) fn integral<const K: usize>(
    mut f: impl FnMut(f64) -> [f64; K],
    breaks: &[f64],
    precision: Precision,
) -> Integral<K> {
    let mut panels: Vec<([f64; 2], Integral<K>)> = breaks
        .windows(2)
        .filter(|e| e[0] < e[1])
        .map(|e| ([e[0], e[1]], panel(&mut f, e[0], e[1])))
        .collect();
    loop {
        let mut total = Integral::ZERO;
        for (_, part) in &panels {
            total.add(part);
        }
        let wanted = total.value.map(|value| precision.absolute.max(precision.relative * value.abs()));
        // How many times too large an error is.
        let excess = |bound: &[f64; K]| {
            (0..K).map(|k| bound[k] / wanted[k].max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
        };
        let hopeless = total.bound.iter().any(|bound| bound.is_infinite());
        if panels.is_empty() || hopeless || excess(&total.bound) <= 1.0 || panels.len() >= precision.panels {
            return total;
        }
        let worst = (0..panels.len())
            .max_by(|&i, &j| excess(&panels[i].1.bound).total_cmp(&excess(&panels[j].1.bound)))
            .unwrap_or(0);
        let ([low, high], _) = panels.swap_remove(worst);
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return total;
        }
        for [low, high] in [[low, middle], [middle, high]] {
            panels.push(([low, high], panel(&mut f, low, high)));
        }
    }
}

/// ∬ f dy dx, where y runs between `ends(x)`; the inner panels are no longer than `longest`.
pub(super) fn double<const K: usize>(
    f: impl Fn(f64, f64) -> [f64; K],
    breaks: &[f64],
    ends: impl Fn(f64) -> [f64; 2],
    longest: f64,
    precision: Precision,
) -> Integral<K> {
    let length = breaks.last().copied().unwrap_or(0.0) - breaks.first().copied().unwrap_or(0.0);
    let inner = Precision {
        absolute: 0.1 * precision.absolute / length,
        relative: 0.1 * precision.relative,
        ..precision
    };
    // The errors that inner integrals leave beyond what is asked of them.
    let mut left = [0.0_f64; K];
    let mut outer = integral(
        |x| {
            let [low, high] = ends(x);
            if low >= high {
                return [0.0; K];
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few panels")]
            let parts = ((high - low) / longest).ceil().clamp(1.0, 64.0) as u32;
            let at = |i: u32| low + (high - low) * f64::from(i) / f64::from(parts);
            let mut breaks: Vec<f64> = vec![low];
            breaks.extend((1..parts).map(at));
            breaks.push(high);
            let found = integral(|y| f(x, y), &breaks, inner);
            for (k, left) in left.iter_mut().enumerate() {
                let wanted = inner.absolute.max(inner.relative * found.value[k].abs());
                *left = left.max(found.bound[k] - wanted);
            }
            found.value
        },
        breaks,
        precision,
    );
    for (k, left) in left.into_iter().enumerate() {
        // The error asked of the inner integrals, and what one of them has left, as if all had.
        let asked = 0.1 * precision.absolute.max(precision.relative * outer.value[k].abs());
        outer.bound[k] += asked + left * length;
    }
    outer
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Precision = Precision { absolute: 0.0, relative: 1e-10, panels: 500 };

    #[test]
    fn integrals_are_within_their_bounds() {
        for width in [1.0, 1e-2, 1e-4] {
            let lorentz = |x: f64| [width / (x * x + width * width), 1.0];
            let exact = 2.0 * (1.0 / width).atan();
            let found = integral(lorentz, &[-1.0, -0.3, 1.0], FINE);
            assert!((found.value[0] - exact).abs() <= found.bound[0] && found.bound[0] < 1e-9 * exact);
            assert!((found.value[1] - 2.0).abs() < 1e-14);
        }
        // A kink, and a jump.
        let found = integral(|x: f64| [(x - 0.3).abs(), if x < 0.3 { 1.0 } else { 0.0 }], &[0.0, 1.0], FINE);
        assert!((found.value[0] - 0.29).abs() <= found.bound[0] && found.bound[0] < 1e-9, "{found:?}");
        assert!((found.value[1] - 0.3).abs() <= found.bound[1] && found.bound[1] < 1e-9);
    }

    #[test]
    fn what_cannot_be_integrated_has_no_small_bound() {
        let few = Precision { panels: 4, ..FINE };
        let found = integral(|x: f64| [(1e4 * x).sin().abs()], &[0.0, 1.0], few);
        assert!(found.bound[0] > 1e-3, "{found:?}");
        assert!(integral(|x: f64| [1.0 / x], &[-1.0, 1.0], few).bound[0] > 1.0);
    }

    #[test]
    fn areas_of_disks() {
        let ends = |x: f64| [-(1.0 - x * x).max(0.0).sqrt(), (1.0 - x * x).max(0.0).sqrt()];
        let found = double(|_, _| [1.0], &[-1.0, 1.0], ends, 1.0, FINE);
        assert!((found.value[0] - core::f64::consts::PI).abs() <= found.bound[0] && found.bound[0] < 1e-8);
    }
}
