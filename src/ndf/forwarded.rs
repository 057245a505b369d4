//! The traits of references, boxes, shared pointers and wrappers, handed on to what is inside.

use crate::ndf::{Ndf, SampleNdf, SampleVndf, Vec2, Vec3};

/// Hands every method on. Clippy refuses an implementation that forgets one.
macro_rules! forwarded {
    ([$n:ident $(, $sized:tt)?] $pointer:ty, |$this:ident| $inner:expr) => {
        #[deny(clippy::missing_trait_methods, reason = "a forgotten method would take the slow default")]
        impl<$n: Ndf $(+ ?$sized)?> Ndf for $pointer {
            type Scalar = $n::Scalar;
            $crate::ndf::forwarded::methods! { $this, $inner =>
                fn d(wm: Vec3<$n>) -> $n::Scalar;
                fn sigma(w: Vec3<$n>) -> $n::Scalar;
                fn lambda(w: Vec3<$n>) -> $n::Scalar;
                fn sigma_above(w: Vec3<$n>) -> $n::Scalar;
                fn d_along(h: Vec3<$n>) -> $n::Scalar;
                fn d_times(m: Vec3<$n>, length2: $n::Scalar, fraction: [$n::Scalar; 2]) -> $n::Scalar;
                fn masked_cosines(wi: Vec3<$n>, wo: Vec3<$n>) -> $n::Scalar;
                fn p22(slope: Vec2<$n>) -> $n::Scalar;
                fn g1(w: Vec3<$n>, wm: Vec3<$n>) -> $n::Scalar;
                fn g2(wi: Vec3<$n>, wo: Vec3<$n>, wm: Vec3<$n>) -> $n::Scalar;
                fn g2_separable(wi: Vec3<$n>, wo: Vec3<$n>, wm: Vec3<$n>) -> $n::Scalar;
                fn vndf(w: Vec3<$n>, wm: Vec3<$n>) -> $n::Scalar;
            }
        }

        #[deny(clippy::missing_trait_methods, reason = "a forgotten method would take the slow default")]
        impl<$n: SampleNdf $(+ ?$sized)?> SampleNdf for $pointer {
            $crate::ndf::forwarded::methods! { $this, $inner =>
                fn sample_d(u: Vec2<$n>) -> Vec3<$n>;
                fn pdf_d(wm: Vec3<$n>) -> $n::Scalar;
            }
        }

        #[deny(clippy::missing_trait_methods, reason = "a forgotten method would take the slow default")]
        impl<$n: SampleVndf $(+ ?$sized)?> SampleVndf for $pointer {
            $crate::ndf::forwarded::methods! { $this, $inner =>
                fn sample_vndf(w: Vec3<$n>, u: Vec2<$n>) -> Vec3<$n>;
                fn sample_vndf_along(w: Vec3<$n>, u: Vec2<$n>) -> Vec3<$n>;
            }
        }
    };
}

/// The methods of [`forwarded`].
macro_rules! methods {
    ($this:ident, $inner:expr => $(fn $method:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        $(#[inline(always)]
        fn $method(&self, $($argument: $type),*) -> $result {
            let $this = self;
            ($inner).$method($($argument),*)
        })*
    };
}
pub(crate) use {forwarded, methods};

forwarded!([N, Sized] & N, |this| **this);
#[cfg(feature = "alloc")]
forwarded!([N, Sized] alloc::boxed::Box<N>, |this| **this);
#[cfg(feature = "alloc")]
forwarded!([N, Sized] alloc::sync::Arc<N>, |this| **this);
