//! Light from infinitely far away: a sky and a few studio lights.
//!
//! The lights are sampled in proportion to what they exceed the mean brightness by; the rest, the
//! sky, is left to the sampler of the material, which multiple importance sampling combines with
//! this one.
//!
//! Reference: Karlík, Šik, Vévoda, Skřivan and Křivánek 2019, "MIS compensation".

use core::f32::consts::{PI, TAU};

use microsurface::glam::{Vec2, Vec3};

/// A soft-edged rectangle of light.
pub(crate) struct Softbox {
    /// Right, up and towards the light.
    axes: [Vec3; 3],
    /// Half the width and height, seen from distance 1.
    half: Vec2,
    radiance: Vec3,
}

impl Softbox {
    pub(crate) fn new(towards: Vec3, half: Vec2, radiance: Vec3) -> Self {
        let z = towards.normalize();
        let x = Vec3::Y.cross(z).normalize();
        Self { axes: [x, z.cross(x), z], half, radiance }
    }

    fn radiance(&self, direction: Vec3) -> Vec3 {
        let [x, y, z] = self.axes.map(|axis| axis.dot(direction));
        if z <= 0.0 {
            return Vec3::ZERO;
        }
        let outside = (Vec2::new(x, y) / z).abs() / self.half;
        let edge = ((1.0 - outside.max_element()) / 0.2).clamp(0.0, 1.0);
        self.radiance * (edge * edge * (3.0 - 2.0 * edge))
    }
}

/// Cells of equal solid angle: azimuth by height.
const COLUMNS: usize = 512;
const ROWS: usize = 256;

/// The environment, and how likely each of its cells is sampled.
pub(crate) struct Environment {
    /// The sky's radiance at the horizon and at the zenith.
    sky: [Vec3; 2],
    lights: Vec<Softbox>,
    /// Cumulative shares of the rows, and of the cells of each row.
    rows: Vec<f32>,
    columns: Vec<Vec<f32>>,
}

impl Environment {
    /// A studio under an overcast sky: key light, strip light, rim light and a small bright lamp.
    pub(crate) fn studio() -> Self {
        let lights = vec![
            Softbox::new(Vec3::new(-0.75, 0.85, 0.55), Vec2::new(0.34, 0.26), Vec3::new(8.4, 7.4, 6.0)),
            Softbox::new(Vec3::new(0.95, 0.55, 0.35), Vec2::new(0.09, 0.42), Vec3::new(6.2, 6.4, 6.6)),
            Softbox::new(Vec3::new(0.1, 0.42, -1.0), Vec2::new(0.75, 0.10), Vec3::new(3.6, 3.5, 3.4)),
            Softbox::new(Vec3::new(0.22, 1.0, 0.5), Vec2::new(0.07, 0.07), Vec3::new(26.0, 23.5, 20.0)),
        ];
        Self::new([Vec3::new(0.26, 0.25, 0.24), Vec3::new(0.07, 0.075, 0.085)], lights)
    }

    /// Lights under a sky of these radiances at the horizon and at the zenith.
    pub(crate) fn new(sky: [Vec3; 2], lights: Vec<Softbox>) -> Self {
        let mut environment = Self { sky, lights, rows: Vec::new(), columns: Vec::new() };
        environment.tabulate();
        environment
    }

    /// The radiance that arrives from a direction; below the horizon there is a floor.
    pub(crate) fn radiance(&self, direction: Vec3) -> Vec3 {
        if direction.y < 0.0 {
            return Vec3::ZERO;
        }
        let height = direction.y.sqrt();
        let sky = self.sky[0].lerp(self.sky[1], height);
        self.lights.iter().fold(sky, |sum, light| sum + light.radiance(direction))
    }

    fn tabulate(&mut self) {
        // Finer than the small lights' edges, or the edges would be found by chance.
        const FINE: usize = 4;
        let brightness = |row, column| {
            let fine = (0..FINE * FINE).map(|i| {
                let offset = Vec2::new((i % FINE) as f32 + 0.5, (i / FINE) as f32 + 0.5) / FINE as f32;
                self.radiance(direction(row, column, offset)).element_sum()
            });
            fine.sum::<f32>()
        };
        let table: Vec<Vec<f32>> =
            (0..ROWS).map(|row| (0..COLUMNS).map(|column| brightness(row, column)).collect()).collect();
        let mean = table.iter().flatten().sum::<f32>() / (ROWS * COLUMNS) as f32;

        let mut row_sums = Vec::with_capacity(ROWS);
        for cells in table {
            let mut cumulative = vec![0.0; COLUMNS + 1];
            for (column, cell) in cells.into_iter().enumerate() {
                cumulative[column + 1] = cumulative[column] + (cell - mean).max(0.0);
            }
            let sum = cumulative[COLUMNS];
            if sum > 0.0 {
                for share in &mut cumulative {
                    *share /= sum;
                }
            }
            self.columns.push(cumulative);
            row_sums.push(sum);
        }
        let total: f32 = row_sums.iter().sum();
        let mut below = 0.0;
        self.rows.push(0.0);
        for sum in row_sums {
            below += sum;
            self.rows.push(below / total);
        }
    }

    /// A direction to the light, its radiance and its density, 1/sr.
    pub(crate) fn sample(&self, u: Vec2) -> (Vec3, Vec3, f32) {
        let (row, fraction_y) = invert(&self.rows, u.y);
        let (column, fraction_x) = invert(&self.columns[row], u.x);
        let direction = direction(row, column, Vec2::new(fraction_x, fraction_y));
        (direction, self.radiance(direction), self.cell_density(row, column))
    }

    /// The density of `sample`, 1/sr.
    pub(crate) fn pdf(&self, direction: Vec3) -> f32 {
        let turns = direction.z.atan2(direction.x) / TAU;
        let column = ((turns - turns.floor()) * COLUMNS as f32) as usize;
        let row = (0.5 * (direction.y + 1.0) * ROWS as f32) as usize;
        self.cell_density(row.min(ROWS - 1), column.min(COLUMNS - 1))
    }

    fn cell_density(&self, row: usize, column: usize) -> f32 {
        let cells = &self.columns[row];
        let share = (self.rows[row + 1] - self.rows[row]) * (cells[column + 1] - cells[column]);
        share * (ROWS * COLUMNS) as f32 / (4.0 * PI)
    }
}

/// The direction at a place inside a cell.
fn direction(row: usize, column: usize, offset: Vec2) -> Vec3 {
    let y = 2.0 * (row as f32 + offset.y) / ROWS as f32 - 1.0;
    let (sin, cos) = (TAU * (column as f32 + offset.x) / COLUMNS as f32).sin_cos();
    let radius = ((1.0 - y) * (1.0 + y)).max(0.0).sqrt();
    Vec3::new(radius * cos, y, radius * sin)
}

/// The interval of a cumulative distribution that contains u, and where in it u lies.
fn invert(cumulative: &[f32], u: f32) -> (usize, f32) {
    let above = cumulative.partition_point(|&c| c <= u).clamp(1, cumulative.len() - 1);
    let (start, end) = (cumulative[above - 1], cumulative[above]);
    let fraction = if end > start { (u - start) / (end - start) } else { 0.5 };
    (above - 1, fraction.clamp(0.0, 1.0))
}
