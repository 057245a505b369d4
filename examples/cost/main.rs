//! What a scene pays for what it uses: bytes, instructions, code.
//!
//! ```text
//! cargo run --release --example cost              # bytes and instructions, ten seconds
//! cargo run --release --example cost -- --quick   # the same, of fewer calls
//! cargo run --release --example cost -- --build   # size and compile time of programs that use it, five minutes
//! ```
//!
//! Prints Markdown tables. Bytes are the same on every machine of a word size; instructions are
//! counted by Valgrind, if there is one, and are the same in every run of a binary; seconds are
//! those of this machine.

extern crate alloc;

use core::error::Error;
use std::io;

mod batches;
mod build;
mod callgrind;
mod elf;
mod instructions;
mod kernel;
mod memory;
mod questions;

/// The argument with which the example runs itself under Valgrind, followed by the number of
/// arguments of a kernel.
pub(crate) const COUNTED: &str = "--counted-by-valgrind";

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut out = io::stdout().lock();
    match arguments[..] {
        [COUNTED, calls] => callgrind::count(&questions::all(calls.parse()?)),
        [] | ["--quick"] => {
            memory::report(&mut out)?;
            instructions::report(&mut out, if arguments.is_empty() { 512 } else { 32 })?;
        }
        ["--build"] => build::report(&mut out)?,
        _ => return Err(format!("{}: none of --quick and --build", arguments.join(" ")).into()),
    }
    Ok(())
}
