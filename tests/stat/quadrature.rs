//! Integrals of a density over the cells of a chart.

use crate::chart::Chart;
use crate::special::gauss_legendre;

/// The probability of a cell and an estimate of its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mass {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// The sum of masses.
pub(crate) fn total(masses: &[Mass]) -> Mass {
    let sum = |f: fn(&Mass) -> f64| masses.iter().map(f).sum();
    Mass { value: sum(|m| m.value), error: sum(|m| m.error) }
}

/// Gauss–Legendre rules of 4 and 6 points; their difference is the (pessimistic) error of the
/// second.
pub(crate) struct Quadrature<'a> {
    chart: &'a dyn Chart,
    density: &'a dyn Fn([f64; 3]) -> f64,
    rules: [Vec<[f64; 2]>; 2],
    depth: u32,
}

/// The nodes of one rule on an interval of one axis: coordinate and weight.
type Nodes = Vec<[f64; 2]>;

impl<'a> Quadrature<'a> {
    /// Cells are quartered at most `depth` times, along a discontinuity of the density for example.
    pub(crate) fn new(chart: &'a dyn Chart, density: &'a dyn Fn([f64; 3]) -> f64, depth: u32) -> Self {
        Self { chart, density, rules: [gauss_legendre(4), gauss_legendre(6)], depth }
    }

    /// The mass of every cell of the grid with these edges in (u₁, u₂), row by row. The error of a
    /// cell of mass p is brought below `tolerance(p)` where the depth allows it.
    pub(crate) fn grid(&self, edges: &[Vec<f64>; 2], tolerance: &dyn Fn(f64) -> f64) -> Vec<Mass> {
        let axis = |axis: usize| -> Vec<[Nodes; 2]> {
            edges[axis].windows(2).map(|e| self.nodes(axis, [e[0], e[1]])).collect()
        };
        let (rows, columns) = (axis(0), axis(1));
        let mut masses = Vec::with_capacity(rows.len() * columns.len());
        for (row, e1) in rows.iter().zip(edges[0].windows(2)) {
            for (column, e2) in columns.iter().zip(edges[1].windows(2)) {
                let mass = self.both(row, column);
                let tolerance = tolerance(mass.value);
                masses.push(self.refined(mass, [[e1[0], e1[1]], [e2[0], e2[1]]], tolerance, self.depth));
            }
        }
        masses
    }

    fn nodes(&self, axis: usize, [low, high]: [f64; 2]) -> [Nodes; 2] {
        self.rules.each_ref().map(|rule| {
            let node =
                |&[x, w]: &[f64; 2]| [self.chart.quantile(axis, low + (high - low) * x), w * (high - low)];
            rule.iter().map(node).collect()
        })
    }

    fn both(&self, first: &[Nodes; 2], second: &[Nodes; 2]) -> Mass {
        let [coarse, fine] = [0, 1].map(|rule| {
            let mut sum = 0.0;
            for &[a, wa] in &first[rule] {
                for &[b, wb] in &second[rule] {
                    let (m, solid_angle) = self.chart.point([a, b]);
                    sum += wa * wb * solid_angle * (self.density)(m);
                }
            }
            sum
        });
        assert!(fine.is_finite(), "the density is {fine} somewhere in a cell");
        Mass { value: fine, error: (fine - coarse).abs() }
    }

    fn refined(&self, mass: Mass, [e1, e2]: [[f64; 2]; 2], tolerance: f64, depth: u32) -> Mass {
        if depth == 0 || mass.error <= tolerance {
            return mass;
        }
        let halves = |[low, high]: [f64; 2]| [[low, 0.5 * (low + high)], [0.5 * (low + high), high]];
        let mut sum = Mass { value: 0.0, error: 0.0 };
        for first in halves(e1) {
            for second in halves(e2) {
                let quarter = self.both(&self.nodes(0, first), &self.nodes(1, second));
                let quarter = self.refined(quarter, [first, second], 0.25 * tolerance, depth - 1);
                sum.value += quarter.value;
                sum.error += quarter.error;
            }
        }
        sum
    }
}
