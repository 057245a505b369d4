//! The README shows the code of the quickstart example.

#[test]
fn the_readme_shows_the_quickstart() {
    let (readme, example) = (include_str!("../../README.md"), include_str!("../../examples/quickstart.rs"));
    assert!(readme.contains(&format!("```rust\n{}\n```", example.trim_end())));
}
