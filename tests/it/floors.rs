//! Imports of the library run down the floors of DESIGN.md.

use std::fs;
use std::path::Path;

/// The modules of `src/`, from the lowest floor up; those of one row may import one another.
const FLOORS: [&[&str]; 17] = [
    &["error"],
    &["elementary", "real"],
    &["vector", "alpha"],
    &["roughness"],
    &["map"],
    &["ndf"],
    &["profile"],
    &["microsurface"],
    &["ggx", "beckmann", "student_t"],
    &["gtr", "blend"],
    &["frame", "fresnel"],
    &["transform"],
    &["filter"],
    &["bsdf"],
    &["batch"],
    &["stored", "verify"],
    &["guide"],
];

/// Names with a shorter path in `lib.rs`, and their modules.
const SHORT: [(&str, &str); 15] = [
    ("AxisAligned", "map"),
    ("Beckmann", "beckmann"),
    ("Blend", "blend"),
    ("Error", "error"),
    ("Ggx", "ggx"),
    ("Gtr", "gtr"),
    ("Isotropic", "map"),
    ("Linear", "map"),
    ("Microsurface", "microsurface"),
    ("Ndf", "ndf"),
    ("Real", "real"),
    ("RoughnessMatrix", "map"),
    ("SampleNdf", "ndf"),
    ("SampleVndf", "ndf"),
    ("StudentT", "student_t"),
];

fn floor(name: &str) -> Option<usize> {
    let module = SHORT.iter().find(|(short, _)| *short == name).map_or(name, |(_, module)| *module);
    FLOORS.iter().position(|floor| floor.contains(&module))
}

/// The names after `crate::` in code, comments and tests left out.
fn imported(source: &str) -> Vec<String> {
    let code = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let code =
        code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let name = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    // `$crate::` of macros counts too.
    code.split("crate::").skip(1).map(name).filter(|name: &String| !name.is_empty()).collect()
}

fn check(folder: &Path, top: Option<&str>, seen: &mut usize, faults: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("the sources") {
        let path = entry.expect("a file").path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
        let module = top.unwrap_or(&stem);
        if path.is_dir() {
            check(&path, Some(module), seen, faults);
        } else if stem != "lib" {
            let own = floor(module).unwrap_or_else(|| panic!("{module} is on no floor"));
            for name in imported(&fs::read_to_string(&path).expect("a source")) {
                *seen += 1;
                // A name on no floor is a macro.
                if floor(&name).is_some_and(|floor| floor > own) {
                    faults.push(format!("{} imports {name}", path.display()));
                }
            }
        }
    }
}

#[test]
fn imports_run_down() {
    let (mut seen, mut faults) = (0, Vec::new());
    check(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), None, &mut seen, &mut faults);
    assert!(seen > 300, "{seen} imports");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    // The test sees what it should.
    assert_eq!(imported("use crate::batch::map;\n// use crate::x;\n"), ["batch"]);
    assert!(floor("batch") > floor("Ndf"));
}
