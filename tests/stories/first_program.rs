//! The program on the page for beginners, as its reader makes and runs it.

use std::fs;
use std::path::Path;
use std::process::Command;

const PAGE: &str = include_str!("../../docs/first-supervisor.md");

/// The text of the block in this language.
fn block(language: &str) -> &'static str {
    let (_, rest) = PAGE.split_once(&format!("```{language}\n")).expect("the page has it");
    rest.split_once("```").expect("it ends").0
}

#[test]
fn the_first_program_has_at_most_40_lines_and_prints_the_text_of_its_page() {
    let (dependencies, program) = (block("toml"), block("rust"));
    assert!(program.lines().count() <= 40);
    assert!(program.lines().all(|it| it.len() <= 100));
    assert_eq!(dependencies.lines().count(), 2);

    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let beside = here.display().to_string();
    let manifest = format!(
        "[workspace]\n[package]\nname = 'first-program'\nversion = '0.0.0'\nedition = '2024'\n\
         {}",
        dependencies.replace("../cotama", &beside)
    );
    let package = Path::new(env!("CARGO_TARGET_TMPDIR")).join("first_program");
    fs::create_dir_all(package.join("src")).expect("the directory for tests can be written");
    fs::write(package.join("Cargo.toml"), manifest).expect("the manifest can be written");
    fs::write(package.join("src/main.rs"), program).expect("the program can be written");
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline"])
        .current_dir(&package)
        .env("CARGO_TARGET_DIR", package.join("target"))
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .expect("cargo runs");
    let warned = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && warned.is_empty(), "{warned}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), block("text"));
}
