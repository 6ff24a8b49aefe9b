//! Puts the memory layout of the board where the linker finds it.

use std::path::Path;
use std::{env, fs};

fn main() {
    let chosen = |feature| env::var_os(feature).is_some();
    let board = match () {
        () if chosen("CARGO_FEATURE_NRF51822") => "nrf51822",
        () if chosen("CARGO_FEATURE_NRF52840") => "nrf52840",
        () => "mps2",
    };
    let out = env::var("OUT_DIR").expect("cargo sets it");
    let memory = format!("memory/{board}.x");
    fs::copy(&memory, Path::new(&out).join("memory.x")).expect("a folder to write to");
    println!("cargo:rerun-if-changed={memory}");
    println!("cargo:rustc-link-search={out}");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-link-arg-bins=--nmagic"); // sections are not aligned to pages
}
