//! The cells of a χ² test as text: where are too many samples, and where too few?

use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt::Write as _;

use super::directions::Hemisphere;
use super::statistics::count;

/// The cells that deviate most, and a map of all: a row for each distance from the peak, a column
/// for each part of the azimuth. `none` are the samples without a direction, seen and expected.
pub(super) fn cell_map(hemispheres: &[Hemisphere], n: f64, none: Option<(usize, f64)>) -> String {
    let mut text = String::new();
    let sigma = |observed: usize, expected: f64| (count(observed) - expected) / expected.max(1.0).sqrt();
    for hemisphere in hemispheres {
        let side = if hemisphere.cells.chart.upper { "above" } else { "below" };
        let cells: Vec<_> = hemisphere.cells.cells().collect();
        let mut worst: Vec<(f64, usize)> = (0..cells.len())
            .map(|i| (sigma(hemisphere.counts[i], n * hemisphere.integrals[i].value[0]), i))
            .collect();
        let _ = writeln!(
            text,
            "  {side} the horizon, from the peak (top) outwards; observed − expected in standard deviations:"
        );
        let mut row = usize::MAX;
        for (deviation, i) in &worst {
            if cells[*i].0 != row {
                row = cells[*i].0;
                let s = cells[*i].1.s;
                let degrees = |s: f64| 2.0 * s.exp().atan().to_degrees();
                let _ = write!(text, "\n    {:>9.3}°…{:<9.3}° ", degrees(s[0]), degrees(s[1]));
            }
            let _ = write!(text, "{}", shade(*deviation));
        }
        text.push('\n');
        worst.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
        for (deviation, i) in worst.iter().take(4) {
            let (_, cell) = cells[*i];
            let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
            let (d, _) = hemisphere.cells.chart.direction(middle(cell.s).clamp(-20.0, 3.0), middle(cell.phi));
            let _ = writeln!(
                text,
                "    about ({:+.3}, {:+.3}, {:+.3}): observed {}, expected {:.1}, {deviation:+.1} σ{}",
                d[0],
                d[1],
                d[2],
                hemisphere.counts[*i],
                n * hemisphere.integrals[*i].value[0],
                if d[2].abs() < 0.1 { ", grazing" } else { "" }
            );
        }
    }
    if let Some((observed, expected)) = none {
        let _ = writeln!(text, "  no direction: observed {observed}, expected {expected:.1}");
    }
    text
}

/// A deviation as one character: + and # for too many, - and = for too few.
fn shade(deviation: f64) -> String {
    match deviation {
        d if d > 10.0 => "#",
        d if d > 3.5 => "+",
        d if d < -10.0 => "=",
        d if d < -3.5 => "-",
        _ => "·",
    }
    .to_string()
}
