//! Batches of several lengths beside scalar calls.
//!
//! In the vectors of the build's own target, because Valgrind knows none wider than AVX2.

use alloc::rc::Rc;
use core::cell::RefCell;
use core::hint::black_box;

use microsurface::batch::simd::{Level, limit_to};
use microsurface::batch::{Directions, DirectionsMut, NdfBatch, Numbers, ReflectionBatch};
use microsurface::bsdf::RoughConductor;
use microsurface::fresnel::Schlick;
use microsurface::{Beckmann, Error, Ggx, SampleVndf};

use crate::kernel::{Arguments, Kernel, Row};

const LENGTHS: [u16; 3] = [1, 64, 1024];

/// wi, wo and u, an array for each component.
type Read<'a> = ([&'a [f32]; 3], [&'a [f32]; 3], [&'a [f32]; 2]);
type Written<'a> = [&'a mut [f32]; 3];

pub(crate) fn batches(arguments: &Rc<[Arguments<f32>]>) -> Result<Vec<Row>, Error> {
    let ggx = Ggx::isotropic(0.3_f32)?;
    let (metal, gaussian) = (Schlick::new(0.9_f32)?, Beckmann::isotropic(0.3_f32)?);
    let (ggx_brdf, beckmann_brdf) = (RoughConductor::new(ggx, metal), RoughConductor::new(gaussian, metal));
    Ok(vec![
        row(
            "GGX eval",
            arguments,
            Kernel::of_calls(ggx_brdf, arguments, |f, a| f.eval(a.wi, a.wo)),
            move |(wi, wo, _), [f, ..]| {
                black_box(&ggx_brdf).eval_batch(directions(wi), directions(wo), f);
            },
        ),
        row("GGX sample_vndf", arguments, normal(ggx, arguments), move |(_, wo, [x, y]), out| {
            black_box(&ggx).sample_vndf_batch(directions(wo), Numbers { x, y }, directions_mut(out));
        }),
        row(
            "Beckmann eval",
            arguments,
            Kernel::of_calls(beckmann_brdf, arguments, |f, a| f.eval(a.wi, a.wo)),
            move |(wi, wo, _), [f, ..]| {
                black_box(&beckmann_brdf).eval_batch(directions(wi), directions(wo), f);
            },
        ),
        row("Beckmann sample_vndf", arguments, normal(gaussian, arguments), move |(_, wo, [x, y]), out| {
            black_box(&gaussian).sample_vndf_batch(directions(wo), Numbers { x, y }, directions_mut(out));
        }),
    ])
}

fn normal<N>(surface: N, arguments: &Rc<[Arguments<f32>]>) -> Kernel
where
    N: SampleVndf<Scalar = f32> + 'static,
{
    Kernel::of_calls(surface, arguments, |n, a| n.sample_vndf(a.wo, a.u))
}

fn directions([x, y, z]: [&[f32]; 3]) -> Directions<'_, f32> {
    Directions { x, y, z }
}

fn directions_mut([x, y, z]: Written<'_>) -> DirectionsMut<'_, f32> {
    DirectionsMut { x, y, z }
}

/// Scalar calls, and batches of all lengths.
fn row(
    name: &str,
    arguments: &[Arguments<f32>],
    call: Kernel,
    run: impl Fn(Read<'_>, Written<'_>) + Copy + 'static,
) -> Row {
    let batches = LENGTHS.map(|len| batch(len, arguments, run));
    Row { name: name.into(), kernels: core::iter::once(call).chain(batches).collect() }
}

fn batch(len: u16, arguments: &[Arguments<f32>], run: impl Fn(Read<'_>, Written<'_>) + 'static) -> Kernel {
    let column = |of: &dyn Fn(&Arguments<f32>) -> f32| -> Vec<f32> {
        arguments.iter().cycle().map(of).take(len.into()).collect()
    };
    let wi = [0, 1, 2].map(|axis| column(&|a| a.wi[axis]));
    let wo = [0, 1, 2].map(|axis| column(&|a| a.wo[axis]));
    let u = [0, 1].map(|axis| column(&|a| a.u[axis]));
    let out = RefCell::new([0, 1, 2].map(|_| vec![0.0; len.into()]));
    Kernel::new(len.into(), move |passes| {
        limit_to(Level::Target);
        let (wi, wo) = (wi.each_ref().map(Vec::as_slice), wo.each_ref().map(Vec::as_slice));
        let u = u.each_ref().map(Vec::as_slice);
        for _ in 0..passes {
            let mut out = out.borrow_mut();
            run(black_box((wi, wo, u)), black_box(&mut out).each_mut().map(Vec::as_mut_slice));
        }
    })
}
