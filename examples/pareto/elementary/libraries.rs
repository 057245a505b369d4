//! The functions of std and of the libm crate, for both scalars.

use crate::textbook::Elementary;

/// Those that the textbook does not call.
pub(super) trait Libraries: Elementary {
    fn std_floor(self) -> Self;
    fn std_exp2(self) -> Self;
    fn std_exp_m1(self) -> Self;
    fn std_log2(self) -> Self;
    fn std_ln_1p(self) -> Self;
    fn std_sin_cos(self) -> (Self, Self);
    fn libm_exp(self) -> Self;
    fn libm_exp2(self) -> Self;
    fn libm_exp_m1(self) -> Self;
    fn libm_ln(self) -> Self;
    fn libm_log2(self) -> Self;
    fn libm_ln_1p(self) -> Self;
    fn libm_pow(self, exponent: Self) -> Self;
    fn libm_sin_cos(self) -> (Self, Self);
    fn libm_atan2(self, x: Self) -> Self;
    fn libm_erf(self) -> Self;
    fn libm_erfc(self) -> Self;
}

macro_rules! libraries {
    ($t:ident: $($name:ident($($x:ident)?) -> $out:ty = $function:path;)*) => {
        impl Libraries for $t {
            $(#[inline(always)]
            fn $name(self $(, $x: Self)?) -> $out {
                $function(self $(, $x)?)
            })*
        }
    };
}
libraries! { f32:
    std_floor() -> f32 = f32::floor;
    std_exp2() -> f32 = f32::exp2;
    std_exp_m1() -> f32 = f32::exp_m1;
    std_log2() -> f32 = f32::log2;
    std_ln_1p() -> f32 = f32::ln_1p;
    std_sin_cos() -> (f32, f32) = f32::sin_cos;
    libm_exp() -> f32 = libm::expf;
    libm_exp2() -> f32 = libm::exp2f;
    libm_exp_m1() -> f32 = libm::expm1f;
    libm_ln() -> f32 = libm::logf;
    libm_log2() -> f32 = libm::log2f;
    libm_ln_1p() -> f32 = libm::log1pf;
    libm_pow(exponent) -> f32 = libm::powf;
    libm_sin_cos() -> (f32, f32) = libm::sincosf;
    libm_atan2(x) -> f32 = libm::atan2f;
    libm_erf() -> f32 = libm::erff;
    libm_erfc() -> f32 = libm::erfcf;
}
libraries! { f64:
    std_floor() -> f64 = f64::floor;
    std_exp2() -> f64 = f64::exp2;
    std_exp_m1() -> f64 = f64::exp_m1;
    std_log2() -> f64 = f64::log2;
    std_ln_1p() -> f64 = f64::ln_1p;
    std_sin_cos() -> (f64, f64) = f64::sin_cos;
    libm_exp() -> f64 = libm::exp;
    libm_exp2() -> f64 = libm::exp2;
    libm_exp_m1() -> f64 = libm::expm1;
    libm_ln() -> f64 = libm::log;
    libm_log2() -> f64 = libm::log2;
    libm_ln_1p() -> f64 = libm::log1p;
    libm_pow(exponent) -> f64 = libm::pow;
    libm_sin_cos() -> (f64, f64) = libm::sincos;
    libm_atan2(x) -> f64 = libm::atan2;
    libm_erf() -> f64 = libm::erf;
    libm_erfc() -> f64 = libm::erfc;
}
