//! What the elementary functions need of a scalar.
/// Sealed.
pub trait Kernel {}
impl Kernel for f32 {}
impl Kernel for f64 {}
