//! Instructions, counted by Valgrind.
//!
//! One run under Callgrind counts all kernels: it collects while [`Kernel::counted_passes`] runs,
//! whatever is inlined into it, and writes a file whenever that returns. Each kernel runs once with
//! one pass over its arguments and once with two. The difference is one pass, and neither
//! beginnings nor ends are in it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::COUNTED;
use crate::kernel::{Kernel, Table};

/// [`Kernel::counted_passes`] as a pattern. With a star at its end too, Valgrind 3.19 heeds but one
/// of two options for it.
const FUNCTION: &str = "*counted_passes";

fn kernels(tables: &[Table]) -> impl Iterator<Item = &Kernel> {
    tables.iter().flat_map(|table| &table.rows).flat_map(|row| &row.kernels)
}

/// Runs what is counted; called under Valgrind.
pub(crate) fn count(tables: &[Table]) {
    for kernel in kernels(tables) {
        kernel.counted_passes(1);
        kernel.counted_passes(2);
    }
}

/// Instructions per call of each kernel, in their order; `None` without Valgrind. `calls` is what
/// the tables were made with.
pub(crate) fn instructions(tables: &[Table], calls: u32) -> io::Result<Option<Vec<f64>>> {
    let directory = Path::new("target/cost/callgrind");
    if directory.exists() {
        std::fs::remove_dir_all(directory)?;
    }
    std::fs::create_dir_all(directory)?;
    let run = Command::new("valgrind")
        .args(["--tool=callgrind", "--collect-atstart=no", "--dump-line=no"])
        .arg(format!("--toggle-collect={FUNCTION}"))
        .arg(format!("--dump-after={FUNCTION}"))
        .arg(format!("--callgrind-out-file={}", directory.join("out").display()))
        .arg(std::env::current_exe()?)
        .args([COUNTED, &calls.to_string()])
        .output();
    let run = match run {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        run => run?,
    };
    if !run.status.success() {
        return Err(io::Error::other(String::from_utf8_lossy(&run.stderr)));
    }
    let total = |part: usize| total(&directory.join(format!("out.{part}")));
    let counts = kernels(tables).enumerate().map(|(i, kernel)| {
        let [once, twice] = [total(2 * i + 1)?, total(2 * i + 2)?];
        Ok((twice - once) / f64::from(kernel.elements))
    });
    counts.collect::<io::Result<_>>().map(Some)
}

/// The sum of a file of Callgrind's.
fn total(file: &PathBuf) -> io::Result<f64> {
    let text = std::fs::read_to_string(file);
    let text =
        text.map_err(|error| io::Error::other(format!("{FUNCTION} in {}: {error}", file.display())))?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok());
    total.ok_or_else(|| io::Error::other(format!("no total in {}", file.display())))
}
