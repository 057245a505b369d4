//! Value stability: hashes of about a million results of the public functions, scalar and batched,
//! f32 and f64.
//!
//! A change of structure leaves every row of `hashes.tsv` as it is. A change of numbers changes
//! some, and is listed under "Values" in the changelog. Square roots apart, only the `libm` crate
//! is used, so that the numbers are the same on every platform:
//!
//! `cargo test --features libm --test values`
//!
//! `MICROSURFACE_VALUES=write` writes the file anew instead of comparing.
#![cfg(feature = "libm")]
#![expect(clippy::unwrap_used, reason = "a surface that cannot be built is a failed test")]

mod arguments;
mod batches;
mod distributions;
mod filters;
mod footprints;
mod functions;
#[path = "../random/mod.rs"]
#[expect(dead_code, reason = "not every crate draws everything")]
mod random;
mod reflection;
#[path = "../surfaces/mod.rs"]
#[expect(dead_code, reason = "not every crate reads every column")]
mod rows;

use core::fmt::Write as _;

use microsurface::Real;

/// FNV-1a over the bits of numbers.
struct Hash {
    state: u64,
    count: usize,
}

impl Hash {
    fn add<T: Real>(&mut self, x: T) {
        let x = x.to_f64();
        let bits = if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
        for byte in bits.to_le_bytes() {
            self.state = (self.state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        self.count += 1;
    }

    fn all<T: Real>(&mut self, numbers: &[T]) {
        for &x in numbers {
            self.add(x);
        }
    }

    fn two<T: Real>(&mut self, v: T::Vec2) {
        self.all::<T>(&Into::<[T; 2]>::into(v));
    }

    fn three<T: Real>(&mut self, v: T::Vec3) {
        self.all::<T>(&Into::<[T; 3]>::into(v));
    }

    fn matrix<T: Real>(&mut self, m: T::Mat2) {
        self.all::<T>(T::columns(m).as_flattened());
    }
}

/// The hash of each group of results.
#[derive(Default)]
struct Record(Vec<(String, Hash)>);

impl Record {
    fn group(&mut self, name: String, results: impl FnOnce(&mut Hash)) {
        let mut hash = Hash { state: 0xcbf2_9ce4_8422_2325, count: 0 };
        results(&mut hash);
        self.0.push((name, hash));
    }
}

/// The name of a scalar.
fn name<T: Real>() -> &'static str {
    if T::EPSILON.to_f64() > 1e-10 { "f32" } else { "f64" }
}

#[test]
fn no_value_has_changed() {
    let mut record = Record::default();
    functions::elementary(&mut record);
    functions::others::<f32>(&mut record);
    functions::others::<f64>(&mut record);
    distributions::all::<f32>(&mut record);
    distributions::all::<f64>(&mut record);
    reflection::all::<f32>(&mut record);
    reflection::all::<f64>(&mut record);
    filters::all::<f32>(&mut record);
    filters::all::<f64>(&mut record);
    footprints::all::<f32>(&mut record);
    footprints::all::<f64>(&mut record);
    batches::all::<f32>(&mut record);
    batches::all::<f64>(&mut record);

    let mut text = String::from("# group\tresults\thash; see main.rs\n");
    let mut total = 0;
    for (name, hash) in &record.0 {
        writeln!(text, "{name}\t{}\t{:016x}", hash.count, hash.state).unwrap();
        total += hash.count;
    }
    println!("{total} results in {} groups", record.0.len());
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/values/hashes.tsv");
    if std::env::var("MICROSURFACE_VALUES").is_ok_and(|what| what == "write") {
        std::fs::write(path, text).unwrap();
        return;
    }
    let committed = std::fs::read_to_string(path).unwrap();
    let changed: Vec<_> =
        text.lines().filter(|line| !committed.lines().any(|known| known == *line)).collect();
    assert!(changed.is_empty(), "{} groups have changed:\n{}", changed.len(), changed.join("\n"));
    assert_eq!(text.lines().count(), committed.lines().count(), "groups are missing");
    assert!(total > 900_000, "{total} results");
}
