//! Coordinates of the sphere about a peak, and the cells that samples are counted in.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::float::{cross, dot, unit};
use super::integral::{Integral, Precision, double};

/// Polar coordinates about a pole: s = ln tan(θ/2) and an azimuth. A lobe of any width is some
/// units of s wide.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chart {
    pole: [f64; 3],
    /// Perpendicular to the pole; the second is level.
    axes: [[f64; 3]; 2],
    /// The hemisphere it covers: z ≥ 0 or z ≤ 0.
    pub(super) upper: bool,
}

/// tan(θ/2) of 1e-14 and 1e14: what is beyond has no area.
const S_END: f64 = 32.0;

impl Chart {
    pub(super) fn new(pole: [f64; 3], upper: bool) -> Self {
        let pole = unit(pole);
        let level =
            if pole[0].hypot(pole[1]) > 1e-8 { unit([-pole[1], pole[0], 0.0]) } else { [0.0, 1.0, 0.0] };
        // Once more, so that it is perpendicular next to the z axis too.
        let first = unit(cross(level, pole));
        Self { pole, axes: [first, cross(pole, first)], upper }
    }

    /// (s, φ) with φ in [0, 2π).
    pub(super) fn coordinates(&self, d: [f64; 3]) -> [f64; 2] {
        let [near, far] = [-1.0, 1.0].map(|sign| {
            let v: [f64; 3] = core::array::from_fn(|k| d[k] + sign * self.pole[k]);
            dot(v, v)
        });
        let phi = dot(d, self.axes[1]).atan2(dot(d, self.axes[0]));
        [(0.5 * (near / far).ln()).clamp(-S_END, S_END), if phi < 0.0 { phi + TAU } else { phi }]
    }

    /// The direction, and dω/(ds dφ) there.
    pub(super) fn direction(&self, s: f64, phi: f64) -> ([f64; 3], f64) {
        let v = s.exp();
        let scale = 1.0 / (1.0 + v * v);
        let (sin, cos) = (2.0 * v * scale, (1.0 - v) * (1.0 + v) * scale);
        let (sin_phi, cos_phi) = phi.sin_cos();
        let [a, b] = self.axes;
        let d = core::array::from_fn(|k| cos * self.pole[k] + sin * (cos_phi * a[k] + sin_phi * b[k]));
        (d, sin * sin)
    }

    /// The s at which the horizon is met along an azimuth.
    fn horizon(&self, phi: f64) -> f64 {
        let side = if self.upper { 1.0 } else { -1.0 };
        let (z, b) = (side * self.pole[2].abs().max(f64::MIN_POSITIVE), side * self.axes[0][2] * phi.cos());
        let z = z.abs();
        // z (1 − v²) + 2 b v = 0.
        let root = z.hypot(b);
        let v = if b > 0.0 { (b + root) / z } else { z / (root - b) };
        v.ln().clamp(-S_END, S_END)
    }

    /// The ends of a cell and breaks between them: at most an eighth of a turn apart, and closer
    /// where the horizon comes near to a pole that is next to it.
    fn azimuths(&self, cell: &Cell) -> Vec<f64> {
        let [low, high] = cell.phi;
        let mut breaks: Vec<f64> = vec![low, high];
        breaks.extend((1..8).map(|i| f64::from(i) * TAU / 8.0));
        let width = (self.pole[2] / self.axes[0][2]).abs();
        if width < 0.3 {
            let level = [0.25 * TAU, 0.75 * TAU];
            breaks.extend(level.iter().flat_map(|at| [1.0, 4.0, 16.0].map(|k| at - k * width)));
            breaks.extend(level.iter().flat_map(|at| [1.0, 4.0, 16.0].map(|k| at + k * width)));
        }
        breaks.retain(|phi| (low..=high).contains(phi));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }

    /// ∫ f dω over a cell, as far as it is in the hemisphere.
    pub(super) fn integral<const K: usize>(
        &self,
        f: impl Fn([f64; 3]) -> [f64; K],
        cell: &Cell,
        precision: Precision,
    ) -> Integral<K> {
        double(
            |phi, s| {
                let (d, solid_angle) = self.direction(s, phi);
                f(d).map(|value| value * solid_angle)
            },
            &self.azimuths(cell),
            |phi| [cell.s[0], cell.s[1].min(self.horizon(phi))],
            4.0,
            precision,
        )
    }
}

/// A rectangle of the coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) s: [f64; 2],
    pub(super) phi: [f64; 2],
}

/// The cells of one hemisphere: rows of s, each cut into columns of φ, so that every cell holds
/// about as many of the pilot's directions.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    pub(super) chart: Chart,
    /// The inner edges of the rows.
    rows: Vec<f64>,
    /// The inner edges of the columns of each row.
    columns: Vec<Vec<f64>>,
}

impl Cells {
    pub(super) fn new(chart: Chart, pilot: &[[f64; 3]], rows: usize, columns: usize) -> Self {
        let mut pilot: Vec<[f64; 2]> = pilot.iter().map(|&d| chart.coordinates(d)).collect();
        pilot.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let n = pilot.len();
        let cut = |numbers: &[f64], parts: usize| -> Vec<f64> {
            let at = |i: usize| numbers.get(i * numbers.len() / parts).copied();
            let mut edges: Vec<f64> = (1..parts).filter_map(at).collect();
            // Many that are equal, which those of a density are not, have a cell of their own.
            let tied = edges.windows(2).filter(|e| e[0] >= e[1]).map(|e| e[0] + 1e-9).collect::<Vec<_>>();
            edges.extend(tied);
            edges.sort_by(f64::total_cmp);
            edges.dedup();
            edges
        };
        let heights: Vec<f64> = pilot.iter().map(|c| c[0]).collect();
        let mut cells = Self { chart, rows: cut(&heights, rows), columns: Vec::new() };
        // Rows that lost an edge to a tie are put together.
        let mut start = 0;
        for row in 0..=cells.rows.len() {
            let end = cells.rows.get(row).map_or(n, |&edge| heights.partition_point(|&s| s < edge));
            let mut azimuths: Vec<f64> = pilot[start..end].iter().map(|c| c[1]).collect();
            azimuths.sort_by(f64::total_cmp);
            cells.columns.push(if azimuths.len() < columns { vec![] } else { cut(&azimuths, columns) });
            start = end;
        }
        cells
    }

    pub(super) fn len(&self) -> usize {
        self.columns.iter().map(|columns| columns.len() + 1).sum()
    }

    /// The index of a direction's cell.
    pub(super) fn index(&self, d: [f64; 3]) -> usize {
        let [s, phi] = self.chart.coordinates(d);
        let row = self.rows.partition_point(|&edge| edge <= s);
        let before: usize = self.columns[..row].iter().map(|columns| columns.len() + 1).sum();
        before + self.columns[row].partition_point(|&edge| edge <= phi)
    }

    /// The cells in the order of their indices, with the index of their row.
    pub(super) fn cells(&self) -> impl Iterator<Item = (usize, Cell)> {
        let row_ends = |row: usize| {
            let low = if row == 0 { -S_END } else { self.rows[row - 1] };
            [low, self.rows.get(row).copied().unwrap_or(S_END)]
        };
        self.columns.iter().enumerate().flat_map(move |(row, columns)| {
            (0..=columns.len()).map(move |i| {
                let low = if i == 0 { 0.0 } else { columns[i - 1] };
                let phi = [low, columns.get(i).copied().unwrap_or(TAU)];
                (row, Cell { s: row_ends(row), phi })
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_cover_the_hemisphere_once() {
        for pole in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [-0.8, 0.599, 1e-3], [0.5, 0.5, -0.7], [0.6, 0.8, 0.0]]
        {
            for upper in [true, false] {
                let pole = if upper == (pole[2] > 0.0) { pole } else { pole.map(|c| -c) };
                let chart = Chart::new(pole, upper);
                let pilot: Vec<[f64; 3]> = (0..500)
                    .map(|i| {
                        let (z, phi) = (0.002 * (f64::from(i) + 0.5), 2.4 * f64::from(i));
                        let r = (1.0 - z * z).sqrt();
                        [r * phi.cos(), r * phi.sin(), if upper { z } else { -z }]
                    })
                    .collect();
                let cells = Cells::new(chart, &pilot, 8, 4);
                assert_eq!(cells.len(), cells.cells().count());
                let precision = Precision { absolute: 1e-9, relative: 1e-9, panels: 200 };
                let mut total = Integral::ZERO;
                for (index, (_, cell)) in cells.cells().enumerate() {
                    total.add(&chart.integral(|_| [1.0], &cell, precision));
                    let (d, _) =
                        chart.direction(0.5 * (cell.s[0] + cell.s[1]), 0.5 * (cell.phi[0] + cell.phi[1]));
                    assert_eq!(cells.index(d), index);
                }
                assert!((total.value[0] - TAU).abs() < 1e-7, "{pole:?} {upper}: {total:?}");
                for d in pilot {
                    let [s, phi] = chart.coordinates(d);
                    let back = chart.direction(s, phi).0;
                    assert!((0..3).all(|k| (back[k] - d[k]).abs() < 1e-13));
                }
            }
        }
    }
}
