//! Prints the hash of the build's own platform.

fn main() {
    println!("{}", wasm::hash());
}
