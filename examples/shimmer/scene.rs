//! What is seen: one shape, one point light, one pinhole camera that moves a little.

use microsurface::frame::Frame;
use microsurface::glam::{DMat3, DVec2, DVec3, Vec3};

/// A half line; the direction is a unit vector.
#[derive(Clone, Copy)]
pub(crate) struct Ray {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

/// A place on a shape, whose shading normals are those of the levels of a function.
#[derive(Clone, Copy)]
pub(crate) struct Hit {
    pub(crate) position: DVec3,
    /// Of the surface that rays meet.
    pub(crate) geometric_normal: DVec3,
    /// Of the function.
    pub(crate) gradient: DVec3,
}

pub(crate) trait Shape: Sync {
    fn hit(&self, ray: &Ray) -> Option<Hit>;

    /// The second derivatives of the function.
    fn hessian(&self, position: DVec3) -> DMat3;
}

/// A pinhole camera.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    pub(crate) eye: DVec3,
    pub(crate) target: DVec3,
    /// The height of the picture at distance 1.
    pub(crate) view: f64,
    /// What moves from one frame to the next, of the target too.
    pub(crate) step: DVec3,
}

pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) shape: Box<dyn Shape>,
    pub(crate) camera: Camera,
    /// Where the light is, and its radiant intensity.
    pub(crate) light: DVec3,
    pub(crate) intensity: f64,
    /// The faint diffuse term, and the radiance that it receives from everywhere.
    pub(crate) albedo: f64,
    pub(crate) ambient: f64,
    /// Of the tangent frames: all that matters is that it changes slowly.
    pub(crate) tangent: DVec3,
    /// The colour of the diffuse term in pictures.
    pub(crate) tint: Vec3,
    /// Enlarged crops, as shares of the picture: the left upper corner of a quarter of its width
    /// and height.
    pub(crate) crops: [[f64; 2]; 2],
}

/// What there is to shade at a place, in its tangent frame.
#[derive(Clone, Copy)]
pub(crate) struct Lit {
    pub(crate) wi: DVec3,
    pub(crate) wo: DVec3,
    /// What the BRDF is multiplied by: irradiance.
    pub(crate) irradiance: f64,
    /// What is added: the diffuse term.
    pub(crate) diffuse: f64,
}

impl Scene {
    /// The scene's camera in a frame of the camera's move.
    pub(crate) fn camera(&self, frame: f64) -> Camera {
        let step = self.camera.step * frame;
        Camera { eye: self.camera.eye + step, target: self.camera.target + step, ..self.camera }
    }

    pub(crate) fn frame(&self, hit: &Hit) -> Frame<f64> {
        Frame::from_normal_and_tangent(hit.gradient.normalize(), self.tangent)
    }

    /// How the shading normal ∇f/|∇f| changes with the place: dn = matrix · dp.
    pub(crate) fn normal_derivative(&self, hit: &Hit) -> DMat3 {
        let inv_length = hit.gradient.length().recip();
        let n = hit.gradient * inv_length;
        let across = DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        across * self.shape.hessian(hit.position) * inv_length
    }

    /// The light that arrives at a place, unshadowed, and the directions there.
    pub(crate) fn lit(&self, hit: &Hit, eye: DVec3) -> Lit {
        let frame = self.frame(hit);
        let (to_light, to_eye) = (self.light - hit.position, eye - hit.position);
        let wi = frame.to_local(to_light.normalize());
        let wo = frame.to_local(to_eye.normalize());
        let irradiance = self.intensity / to_light.length_squared() * wi.z.max(0.0);
        Lit { wi, wo, irradiance, diffuse: self.albedo * (irradiance / core::f64::consts::PI + self.ambient) }
    }
}

impl Camera {
    /// The direction through a place of the picture, measured in picture heights from its centre, y
    /// down, not normalised, and its derivatives by the place.
    pub(crate) fn direction(&self, place: DVec2) -> (DVec3, [DVec3; 2]) {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(DVec3::Z).normalize() * self.view;
        let down = forward.cross(right);
        (forward + right * place.x + down * place.y, [right, down])
    }

    pub(crate) fn ray(&self, place: DVec2) -> Ray {
        Ray { origin: self.eye, direction: self.direction(place).0.normalize() }
    }
}
