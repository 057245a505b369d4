//! A GGX metal, a clear coat and rough glass, as renderers write them; nothing here is the crate's.

use core::f64::consts::{PI, TAU};

use microsurface::glam::DVec3;

use crate::mistake::Mistake;

/// A direction with its weight and its pdf.
pub(crate) type Sample = Option<(DVec3, f64, f64)>;

fn d(h: DVec3, [x, y]: [f64; 2]) -> f64 {
    let t = h / DVec3::new(x, y, 1.0);
    if h.z > 0.0 { 1.0 / (PI * x * y * t.length_squared() * t.length_squared()) } else { 0.0 }
}

fn lambda(w: DVec3, [x, y]: [f64; 2]) -> f64 {
    let tan2 = ((x * w.x) * (x * w.x) + (y * w.y) * (y * w.y)) / (w.z * w.z);
    0.5 * ((1.0 + tan2).sqrt() - 1.0)
}

fn g1(w: DVec3, alpha: [f64; 2]) -> f64 {
    1.0 / (1.0 + lambda(w, alpha))
}

/// Height-correlated masking of two directions on one side.
fn g2(wi: DVec3, wo: DVec3, alpha: [f64; 2]) -> f64 {
    1.0 / (1.0 + lambda(wi, alpha) + lambda(wo, alpha))
}

/// Heitz 2018.
fn visible_normal(wo: DVec3, u: [f64; 2], [x, y]: [f64; 2]) -> DVec3 {
    let v = DVec3::new(x * wo.x, y * wo.y, wo.z).normalize();
    let length2 = v.x * v.x + v.y * v.y;
    let t1 = if length2 > 0.0 { DVec3::new(-v.y, v.x, 0.0) / length2.sqrt() } else { DVec3::X };
    let t2 = v.cross(t1);
    let (r, (sin, cos)) = (u[0].sqrt(), (TAU * u[1]).sin_cos());
    let (p1, s) = (r * cos, 0.5 * (1.0 + v.z));
    let p2 = (1.0 - s) * (1.0 - p1 * p1).max(0.0).sqrt() + s * r * sin;
    let n = p1 * t1 + p2 * t2 + (1.0 - p1 * p1 - p2 * p2).max(0.0).sqrt() * v;
    DVec3::new(x * n.x, y * n.y, n.z.max(0.0)).normalize()
}

fn schlick(cos: f64) -> f64 {
    let f0 = 0.9;
    f0 + (1.0 - f0) * (1.0 - cos).powi(5)
}

/// An anisotropic GGX metal.
pub(crate) struct Metal {
    pub(crate) alpha: [f64; 2],
    pub(crate) mistake: Mistake,
}

impl Metal {
    pub(crate) fn eval(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        let alpha_of_g = match self.mistake {
            Mistake::AveragedAlphaInG => [(self.alpha[0] * self.alpha[1]).sqrt(); 2],
            Mistake::AnotherAlphaInG => [0.25; 2],
            _ => self.alpha,
        };
        let pi = if self.mistake == Mistake::NoPiInD { PI } else { 1.0 };
        pi * schlick(wo.dot(h)) * d(h, self.alpha) * g2(wi, wo, alpha_of_g) / (4.0 * wi.z * wo.z)
    }

    pub(crate) fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        let visible = g1(wo, self.alpha) * d(h, self.alpha) * wo.dot(h) / wo.z;
        if self.mistake == Mistake::NoJacobianInPdf { visible } else { visible / (4.0 * wo.dot(h)) }
    }

    pub(crate) fn sample(&self, wo: DVec3, u: [f64; 2]) -> Sample {
        if wo.z <= 0.0 {
            return None;
        }
        let alpha = match self.mistake {
            Mistake::AlphaForItsSquare => self.alpha.map(|alpha| alpha * alpha),
            Mistake::ClampedInOnePlace => self.alpha.map(|alpha| alpha.max(0.2)),
            _ => self.alpha,
        };
        let mirrored = DVec3::new(wo.x, -wo.y, wo.z);
        let seen_from = if self.mistake == Mistake::WrongHandedness { mirrored } else { wo };
        let h = visible_normal(seen_from, u, alpha);
        let wi = 2.0 * wo.dot(h) * h - wo;
        if wi.z <= 0.0 || wo.dot(h) <= 0.0 {
            return None;
        }
        let alpha_of_g = match self.mistake {
            Mistake::AveragedAlphaInG => [(self.alpha[0] * self.alpha[1]).sqrt(); 2],
            _ => self.alpha,
        };
        let masking = if self.mistake == Mistake::SeparableInWeight {
            g1(wi, alpha_of_g)
        } else {
            g2(wi, wo, alpha_of_g) / g1(wo, alpha_of_g)
        };
        Some((wi, schlick(wo.dot(h)) * masking, self.pdf(wi, wo)))
    }
}

/// Disney's clear coat: GTR of γ = 1, sampled by all normals.
pub(crate) struct ClearCoat {
    pub(crate) alpha: f64,
    pub(crate) mistake: Mistake,
}

impl ClearCoat {
    fn d(&self, h: DVec3) -> f64 {
        let a2 = self.alpha * self.alpha;
        (a2 - 1.0) / (PI * a2.ln() * (1.0 + (a2 - 1.0) * h.z * h.z))
    }

    pub(crate) fn eval(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        let fresnel = 0.04 + 0.96 * (1.0 - wo.dot(h)).powi(5);
        fresnel * self.d(h) * g1(wi, [0.25; 2]) * g1(wo, [0.25; 2]) / (4.0 * wi.z * wo.z)
    }

    pub(crate) fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        let all = if wo.dot(h) > 0.0 { self.d(h) * h.z } else { return 0.0 };
        if self.mistake == Mistake::NoJacobianOfClearCoat { all } else { all / (4.0 * wo.dot(h)) }
    }

    pub(crate) fn sample(&self, wo: DVec3, u: [f64; 2]) -> Sample {
        if wo.z <= 0.0 {
            return None;
        }
        let a2 = self.alpha * self.alpha;
        let z2 = (1.0 - a2.powf(1.0 - u[0])) / (1.0 - a2);
        let (r, (sin, cos)) = ((1.0 - z2).max(0.0).sqrt(), (TAU * u[1]).sin_cos());
        let h = DVec3::new(r * cos, r * sin, z2.sqrt());
        let wi = 2.0 * wo.dot(h) * h - wo;
        if wi.z <= 0.0 || wo.dot(h) <= 0.0 {
            return None;
        }
        let pdf = self.pdf(wi, wo);
        (pdf > 0.0).then(|| (wi, self.eval(wi, wo) * wi.z / pdf, pdf))
    }
}

/// Rough glass: Walter 2007, radiance scaled by the square of the index.
pub(crate) struct Glass {
    pub(crate) alpha: f64,
    pub(crate) eta: f64,
    pub(crate) mistake: Mistake,
}

/// The part that is reflected, and the cosine behind the interface; `eta` is the index behind
/// relative to that in front.
fn fresnel(cos: f64, eta: f64) -> (f64, f64) {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    if sin2 >= 1.0 {
        return (1.0, 0.0);
    }
    let behind = (1.0 - sin2).sqrt();
    let s = (cos - eta * behind) / (cos + eta * behind);
    let p = (eta * cos - behind) / (eta * cos + behind);
    (0.5 * (s * s + p * p), behind)
}

impl Glass {
    /// The index of the side of wi relative to that of wo.
    fn index(&self, wo: DVec3) -> f64 {
        if wo.z > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    /// The half vector of reflection or transmission, above the surface.
    fn half(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if wi.z * wo.z > 0.0 {
            let h = wi + wo;
            return (if h.z < 0.0 { -h } else { h }).normalize();
        }
        let index = if self.mistake == Mistake::InvertedEta { 1.0 / self.index(wo) } else { self.index(wo) };
        let h = wo + index * wi;
        if h.z < 0.0 && self.mistake != Mistake::HalfVectorNotFlipped {
            -h.normalize()
        } else {
            h.normalize()
        }
    }

    /// f |cos wi|/|cos wo·h| without masking, and the density of h: both without D_w.
    fn parts(&self, wi: DVec3, wo: DVec3) -> Option<(DVec3, f64, f64)> {
        let h = self.half(wi, wo);
        let (i, o) = (wi.dot(h), wo.dot(h));
        // Facets are seen from the side that the surface is seen from.
        if h.z <= 0.0 || o * wo.z <= 0.0 || i * wi.z <= 0.0 {
            return None;
        }
        let eta = self.index(wo);
        let (reflected, _) = fresnel(o.abs(), eta);
        if wi.z * wo.z > 0.0 {
            return Some((h, reflected / (4.0 * o.abs()), reflected / (4.0 * o.abs())));
        }
        let sum = o + eta * i;
        let jacobian = eta * eta * i.abs() / (sum * sum);
        // Radiance is compressed by the square of the index.
        Some((h, (1.0 - reflected) * jacobian / (eta * eta), (1.0 - reflected) * jacobian))
    }

    fn masking(&self, wi: DVec3, wo: DVec3) -> f64 {
        let alpha = [self.alpha; 2];
        if wi.z * wo.z > 0.0 { g2(wi, wo, alpha) } else { g1(wi, alpha) * g1(wo, alpha) }
    }

    pub(crate) fn eval(&self, wi: DVec3, wo: DVec3) -> f64 {
        let Some((h, f, _)) = self.parts(wi, wo) else { return 0.0 };
        f * d(h, [self.alpha; 2]) * self.masking(wi, wo) * wo.dot(h).abs() / (wi.z * wo.z).abs()
    }

    pub(crate) fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        let Some((h, _, p)) = self.parts(wi, wo) else { return 0.0 };
        p * d(h, [self.alpha; 2]) * g1(wo, [self.alpha; 2]) * wo.dot(h).abs() / wo.z.abs()
    }

    pub(crate) fn sample(&self, wo: DVec3, u: [f64; 2]) -> Sample {
        let side = wo.z.signum();
        let up = side * wo;
        let eta = self.index(wo);
        // One number chooses and is used again.
        let h = visible_normal(up, [u[0], u[1]], [self.alpha; 2]);
        let (reflected, behind) = fresnel(up.dot(h), eta);
        let choice = (1e6 * u[1]).fract();
        let wi = if choice < reflected {
            2.0 * up.dot(h) * h - up
        } else {
            (up.dot(h) / eta - behind) * h - up / eta
        };
        let wi = side * wi;
        if (wi.z * wo.z > 0.0) != (choice < reflected) || wi.z == 0.0 {
            return None;
        }
        let pdf = self.pdf(wi, wo);
        if pdf <= 0.0 && self.mistake == Mistake::None {
            return None;
        }
        let scale = if choice < reflected { 1.0 } else { 1.0 / (eta * eta) };
        Some((wi, scale * self.masking(wi, wo) / g1(wo, [self.alpha; 2]), pdf))
    }
}
