//! The Jacobian of a map of directions, against finite differences.

use alloc::format;

use super::float::{cross, dot, hex, unit, wide, within};
use super::report::{Report, Seen};
use super::{ARGUMENTS, Kit};

impl Kit {
    /// Checks the Jacobian of a map of unit vectors: |d map(v)/dv|, by solid angle, against central
    /// differences at arguments above the horizon. Where the map gives none, nothing is compared.
    ///
    /// The differences bound their own error by two step sizes; where that is above what is
    /// [allowed](Self::allowing) a point is left out, and with more than half of them the check is
    /// undecided.
    ///
    /// # Example
    /// Reflection about a normal m: dm/dwi = 1/(4 wo·m).
    /// ```
    /// use microsurface::verify::Kit;
    /// let wo = [0.6, 0.0, 0.8];
    /// let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    /// let half = |wi: [f64; 3]| {
    ///     let h = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
    ///     let length = dot(h, h).sqrt();
    ///     (length > 0.1).then(|| h.map(|c| c / length))
    /// };
    /// Kit::new().jacobian(half, |wi| 1.0 / (4.0 * dot(half(wi).unwrap(), wo))).assert();
    /// assert!(!Kit::new().jacobian(half, |wi| 1.0 / (2.0 * dot(half(wi).unwrap(), wo))).passed());
    /// ```
    pub fn jacobian(
        &self,
        map: impl Fn([f64; 3]) -> Option<[f64; 3]>,
        jacobian: impl Fn([f64; 3]) -> f64,
    ) -> Report {
        let mut report = Report::new(self.false_alarms);
        let mut arguments = self.arguments(9);
        let (mut seen, mut skipped, mut tried) = (Seen::default(), 0, 0);
        let allowed = self.tolerance::<f64>();
        for _ in 0..ARGUMENTS / 4 {
            let v = unit(wide(arguments.direction::<f64>()));
            if map(v).is_none() {
                continue;
            }
            tried += 1;
            let areas = [1e-3, 5e-4].map(|step| area(&map, v, step));
            let [Some(coarse), Some(fine)] = areas else {
                skipped += 1;
                continue;
            };
            // Richardson: the error is of second order in the step.
            let (found, bound) = ((4.0 * fine - coarse) / 3.0, (fine - coarse).abs());
            let claimed = jacobian(v);
            if !within(bound * bound, allowed * claimed.abs().max(f64::MIN_POSITIVE) * claimed.abs()) {
                skipped += usize::from(claimed.is_finite());
                if claimed.is_finite() {
                    continue;
                }
            }
            seen.see((found / claimed - 1.0).abs(), || {
                format!("{found:e}, claimed {claimed:e}, at {}", hex(&v))
            });
        }
        let seen = if 2 * skipped > tried { Seen::default() } else { seen };
        report.push("Jacobian against finite differences", seen, allowed.max(1e-6));
        report.judge()
    }
}

/// The area that the map makes of a small square about v, by central differences.
fn area(map: &impl Fn([f64; 3]) -> Option<[f64; 3]>, v: [f64; 3], step: f64) -> Option<f64> {
    let side = if v[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let a = unit(cross(v, side));
    let b = cross(v, a);
    let moved = |axis: [f64; 3], by: f64| map(core::array::from_fn(|k| v[k] * by.cos() + axis[k] * by.sin()));
    let derivative = |axis: [f64; 3]| -> Option<[f64; 3]> {
        let (forth, back) = (moved(axis, step)?, moved(axis, -step)?);
        Some(core::array::from_fn(|k| (forth[k] - back[k]) / (2.0 * step)))
    };
    let normal = cross(derivative(a)?, derivative(b)?);
    Some(dot(normal, normal).sqrt())
}
