//! What programs that use the crate take to compile, and how large they get.
//!
//! Each program is a crate in `target/cost`, which depends on this one by its path and is built
//! offline: first with all it depends on, then, touched, alone. Seconds are of the wall clock, the
//! linker's included; an empty program shows what of them is nobody's. The size is that of code and
//! constants, without symbols, beyond the empty program's.

use std::io::{self, Write};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use crate::elf;

struct Program {
    name: &'static str,
    /// What is in it, for the table.
    contents: &'static str,
    source: &'static str,
    /// With the feature of that name.
    batches: bool,
}

const PROGRAMS: [Program; 5] = [
    Program { name: "empty", contents: "an empty `main`", source: "fn main() {}\n", batches: false },
    Program {
        name: "minimal",
        contents: "D of isotropic GGX",
        source: include_str!("programs/minimal.rs"),
        batches: false,
    },
    Program {
        name: "typical",
        contents: "eval, pdf, sample of isotropic GGX, RGB conductor",
        source: include_str!("programs/typical.rs"),
        batches: false,
    },
    Program {
        name: "every",
        contents: "the same of GGX, Beckmann and two GTR under every map, and of filtered GGX: 15 types of material",
        source: include_str!("programs/full.rs"),
        batches: false,
    },
    Program {
        name: "full",
        contents: "the same, and two batches of each type",
        source: include_str!("programs/full.rs"),
        batches: true,
    },
];

struct Built {
    /// From scratch, and the program alone.
    seconds: [f64; 2],
    bytes: u64,
}

pub(crate) fn report(out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "## Programs\n")?;
    writeln!(
        out,
        "| program | | seconds from scratch | of the program alone | kB beyond the empty one |\n|---|---|---|---|---|"
    )?;
    let mut empty = None;
    for program in &PROGRAMS {
        let Program { name, contents, .. } = program;
        let Built { seconds: [scratch, alone], bytes } = built(program)?;
        let beyond = i64::try_from(bytes).unwrap_or(i64::MAX)
            - *empty.get_or_insert(i64::try_from(bytes).unwrap_or(0));
        #[expect(clippy::cast_precision_loss, reason = "far below 2⁵³")]
        let kilobytes = beyond as f64 / 1000.0;
        writeln!(out, "| {name} | {contents} | {scratch:.1} | {alone:.1} | {kilobytes:.1} |")?;
    }
    writeln!(out)
}

/// Builds a program twice.
fn built(&Program { name, source, batches, .. }: &Program) -> io::Result<Built> {
    let directory = Path::new("target/cost").join(name);
    let target = directory.join("target");
    if target.exists() {
        std::fs::remove_dir_all(&target)?;
    }
    std::fs::create_dir_all(directory.join("src"))?;
    std::fs::write(directory.join("Cargo.toml"), manifest(name, batches))?;
    let main = directory.join("src/main.rs");
    std::fs::write(&main, source)?;
    let scratch = build(&directory)?;
    // Newer than what was built from it.
    std::fs::write(&main, source)?;
    let alone = build(&directory)?;
    let program = target.join("release").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    Ok(Built { seconds: [scratch, alone], bytes: elf::loaded(&std::fs::read(program)?) })
}

/// The release profile as it is, but for what an executable holds besides its code.
fn manifest(name: &str, batches: bool) -> String {
    let dependency = env!("CARGO_MANIFEST_DIR");
    let default = if batches { "\"batches\"" } else { "" };
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n\
         [dependencies]\nmicrosurface = {{ path = {dependency:?} }}\n\n\
         [features]\nbatches = []\ndefault = [{default}]\n\n\
         [profile.release]\nopt-level = 3\npanic = \"abort\"\nstrip = true\n\n[workspace]\n"
    )
}

/// Seconds of a build.
fn build(directory: &Path) -> io::Result<f64> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let start = Instant::now();
    let run = Command::new(cargo)
        .args(["build", "--release", "--offline"])
        .current_dir(directory)
        .env("CARGO_TARGET_DIR", "target")
        .output()?;
    let seconds = start.elapsed().as_secs_f64();
    if run.status.success() {
        Ok(seconds)
    } else {
        Err(io::Error::other(String::from_utf8_lossy(&run.stderr)))
    }
}
