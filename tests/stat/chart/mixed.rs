//! Visible normals of GTR: a mixture of profiles whose slopes along and across the view have closed
//! forms.

use core::f64::consts::PI;

use super::{Chart, Inverse, root};

/// The largest k of the profiles P22 = (k + 1)/(π(1 + r²)^{k+2}): γ up to 6.
const MOST: usize = 4;
/// A number for each k.
type ByExponent = [f64; MOST + 1];

/// The chart of the normals visible from w, with x, y and ν as in [`View`](super::View).
///
/// With n = max(0, ⌈γ⌉ − 2) and p = n + 2 − γ, Euler's Beta integral over y = eˢ of the squared
/// widths t = (α² + y)/(1 + y) makes
///
/// P22 ∝ ∫ y^p (1 + y)^{−n−2} (1 + r²)ⁿ/(t + r²)^{n+2} ds, (1 + r²)ⁿ/(t + r²)^{n+2} = Σₖ C(n, k) (1
/// − t)ᵏ/(t + r²)^{k+2}.
///
/// The trapezoid rule of step 2 is off by some e^{−π²}, so that few components make a chart in
/// which GTR is flat to 1e-2. The first coordinate is x, the second the distribution function of y
/// given x.
#[derive(Debug, Clone)]
pub(crate) struct Mixed {
    inverse: Inverse,
    nu: f64,
    along: [f64; 2],
    alpha: f64,
    components: Vec<Component>,
}

/// The profiles of one width √t, weighted so that the visible slopes integrate to 1.
#[derive(Debug, Clone, Copy)]
struct Component {
    width: f64,
    weights: ByExponent,
}

/// The slopes across the view of one width, given x, with weights that sum to 1.
struct Across {
    width: f64,
    weights: ByExponent,
}

impl Mixed {
    pub(crate) fn new(alpha: f64, gamma: f64, inverse: Inverse, w: [f64; 3]) -> Self {
        let [x, y] = inverse.direction(w);
        let s = x.hypot(y);
        let along = if s > 0.0 { [x / s, y / s] } else { [1.0, 0.0] };
        // Beyond ν = 1e9 all normals are visible to rounding.
        let nu = w[2] / s.max(1e-9 * w[2].abs());
        let mut components = mixture(alpha, gamma);
        let total: f64 = components.iter().map(|c| c.integral(nu, nu)).sum();
        components.iter_mut().flat_map(|c| &mut c.weights).for_each(|weight| *weight /= total);
        Self { inverse, nu, along, alpha, components }
    }

    /// The density of x, and the slopes across given x.
    fn across(&self, x: f64) -> (f64, Vec<Across>) {
        let parts = self.components.iter().map(|c| Across { width: c.width.hypot(x), weights: c.density(x) });
        let mut across: Vec<Across> = parts.collect();
        let sum: f64 = across.iter().flat_map(|part| part.weights).sum();
        across.iter_mut().flat_map(|part| &mut part.weights).for_each(|weight| *weight /= sum);
        ((self.nu - x) * sum, across)
    }
}

/// The components, with the mass of their slopes for a weight.
fn mixture(alpha: f64, gamma: f64) -> Vec<Component> {
    // The nearer ends leave t off by e⁻⁷ of itself.
    const STEP: f64 = 2.0;
    const END: f64 = 7.0;
    let n = (0..MOST).take_while(|&n| gamma > number(n + 2)).count();
    let (p, alpha2) = (number(n + 2) - gamma, alpha * alpha);
    let component = |t: f64, factor: f64| {
        let mut weights = [0.0; MOST + 1];
        let mut binomial = factor;
        for (k, weight) in weights[..=n].iter_mut().enumerate() {
            *weight = binomial * ((1.0 - t) / t).powf(number(k)) / (t * number(k + 1));
            binomial *= number(n - k) / number(k + 1);
        }
        Component { width: t.sqrt(), weights }
    };
    if p == 0.0 {
        return vec![component(alpha2, 1.0)];
    }
    let start = alpha2.ln() - END;
    let steps = (0..1000).take_while(|&i| start + STEP * f64::from(i - 1) < END).count();
    let points = (0..steps).map(|i| {
        let y = (start + STEP * number(i)).exp();
        // What is left beyond either end is a geometric series.
        let first = if i == 0 { 1.0 / (1.0 - (-p * STEP).exp()) } else { 1.0 };
        let last = if i + 1 == steps { 1.0 / (1.0 - (-gamma * STEP).exp()) } else { 1.0 };
        component((alpha2 + y) / (1.0 + y), first * last * y.powf(p) * (1.0 + y).powf(-number(n + 2)))
    });
    points.collect()
}

fn number(n: usize) -> f64 {
    crate::special::count(n)
}

/// ∫ (1 + τ²)^{−k−2} dτ.
const TOTALS: ByExponent = {
    let mut totals = [0.5 * PI; MOST + 1];
    let mut factor = 1.0;
    let mut k = 1;
    while k <= MOST {
        factor += 1.0;
        totals[k] = totals[k - 1] * (2.0 * factor - 1.0) / (2.0 * factor);
        k += 1;
    }
    totals
};

impl Component {
    /// The weighted densities of x, ∫ P22 dy = c (1 + x²)^{−k−3/2} at unit width.
    fn density(&self, x: f64) -> ByExponent {
        let x = x / self.width;
        let inverse2 = 1.0 / (1.0 + x * x);
        let mut power = inverse2 * inverse2.sqrt() / (self.width * PI);
        let mut densities = [0.0; MOST + 1];
        for (k, &weight) in self.weights.iter().enumerate().take_while(|(_, weight)| **weight > 0.0) {
            densities[k] = weight * TOTALS[k] * number(k + 1) * power;
            power *= inverse2;
        }
        densities
    }

    /// ∫_{−∞}^x (ν − x') P₂ dx', weighted: with sin = x/√(1 + x²), ∫ (1 + x²)^{−k−3/2} dx = ∫ (1 −
    /// sin²)ᵏ d sin, a polynomial in the distance e = 1 + sin from its end.
    fn integral(&self, nu: f64, x: f64) -> f64 {
        let (nu, x) = (nu / self.width, x / self.width);
        let h = x.hypot(1.0);
        let e = 1.0 / (h * (h + x.abs()));
        let terms = (0..=MOST).filter(|&k| self.weights[k] > 0.0).map(|k| {
            let tail = power_integral(k, e);
            let below = if x < 0.0 { tail } else { 2.0 * power_integral(k, 1.0) - tail };
            let product = nu * below + h.powf(-number(2 * k + 1)) / number(2 * k + 1);
            self.weights[k] * number(k + 1) / PI * TOTALS[k] * product
        });
        self.width * terms.sum::<f64>()
    }
}

/// ∫₀^e zᵏ (2 − z)ᵏ dz, e ≤ 1.
fn power_integral(k: usize, e: f64) -> f64 {
    let mut term = 2_f64.powf(number(k)) * e.powf(number(k + 1));
    let mut sum = 0.0;
    for i in 0..=k {
        sum += term / number(k + i + 1);
        term *= -0.5 * e * number(k - i) / number(i + 1);
    }
    sum
}

impl Across {
    /// ∫₀^y of the density, weighted, with ∫ (1 + τ²)^{−m−1} = (τ (1 + τ²)^{−m} + (2m − 1) ∫ (1 +
    /// τ²)^{−m})/2m.
    fn share(&self, y: f64) -> f64 {
        let tau = y / self.width;
        let inverse = 1.0 / (1.0 + tau * tau);
        let (mut integral, mut power, mut sum) = (tau.atan(), 1.0, 0.0);
        for (k, &weight) in self.weights.iter().enumerate().take_while(|(_, weight)| **weight > 0.0) {
            power *= inverse;
            integral = (tau * power + number(2 * k + 1) * integral) / number(2 * k + 2);
            sum += weight * integral / TOTALS[k];
        }
        sum
    }

    fn density(&self, y: f64) -> f64 {
        let tau = y / self.width;
        let inverse = 1.0 / (1.0 + tau * tau);
        let (mut power, mut sum) = (inverse / self.width, 0.0);
        for (weight, total) in self.weights.iter().zip(TOTALS) {
            power *= inverse;
            sum += weight * power / total;
        }
        sum
    }
}

fn share(across: &[Across], y: f64) -> f64 {
    across.iter().map(|part| part.share(y)).sum()
}

impl Chart for Mixed {
    fn coordinates(&self, m: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.inverse.profile_slope(m);
        let [c, s] = self.along;
        let x_along = c * x + s * y;
        [x_along, 0.5 + share(&self.across(x_along).1, c * y - s * x)]
    }

    fn quantile(&self, axis: usize, u: f64) -> f64 {
        if axis == 1 {
            return u;
        }
        let scale = self.alpha;
        scale * root(|xi| self.cdf(0, scale * xi.sinh()) - u, -60.0, (self.nu / scale).asinh()).sinh()
    }

    fn cdf(&self, axis: usize, c: f64) -> f64 {
        if axis == 1 {
            return c;
        }
        self.components.iter().map(|component| component.integral(self.nu, c.min(self.nu))).sum()
    }

    fn point(&self, [x, u]: [f64; 2]) -> ([f64; 3], f64) {
        let (density, across) = self.across(x);
        let scale = self.alpha.hypot(x);
        let target = (u - 0.5).abs();
        // All but (1/1000)³ of the widest profile.
        let end = (1000.0 * x.hypot(1.0) / scale).asinh();
        let y = scale * root(|xi| share(&across, scale * xi.sinh()) - target, 0.0, end).sinh();
        let y = y.copysign(u - 0.5);
        let [c, s] = self.along;
        let (m, area) = self.inverse.normal([c * x - s * y, s * x + c * y]);
        (m, area / (density * across.iter().map(|part| part.density(y)).sum::<f64>()))
    }
}
