//! Where the linker finds the memory of the board.

use std::path::Path;
use std::{env, fs};

fn main() {
    let board = if env::var_os("CARGO_FEATURE_NRF52840").is_some() { "nrf52840" } else { "mps2" };
    let out = env::var("OUT_DIR").expect("cargo sets it");
    let memory = format!("memory/{board}.x");
    fs::copy(&memory, Path::new(&out).join("memory.x")).expect("a folder to write to");
    println!("cargo:rerun-if-changed={memory}");
    println!("cargo:rustc-link-search={out}");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-link-arg-bins=--nmagic"); // sections are not aligned to pages
}
