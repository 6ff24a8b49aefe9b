//! Reads exported JANI models and SCXML charts with SCAN, a statistical model checker (crates
//! `smc_scan_*`).
//!
//! ```text
//! cd tests/evidence/compare/read_exports
//! cargo run --release -- ../../../../verification/tests/golden/exports/*.{jani,scxml}
//! ```
//!
//! SCAN reads a dialect of either format. What it does not know is taken away or put in its terms
//! before it gets the file, and every such change is printed. A file is accepted when SCAN parses
//! it and builds its model; where SCAN can also estimate a reachability, it does, and must find it
//! reached. The exit status is 1 when a file is refused.

mod jani;
mod scxml;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let folder = std::env::temp_dir().join(format!("cotama-read-exports-{}", std::process::id()));
    let mut accepted = !files.is_empty();
    for file in &files {
        let read = fs::create_dir_all(&folder)
            .map_err(anyhow::Error::from)
            .and_then(|()| read(file, &folder));
        match read {
            Ok(said) => println!("{}: accepted\n{said}", file.display()),
            Err(error) => {
                println!("{}: REFUSED: {error:#}", file.display());
                accepted = false;
            }
        }
        let _ = fs::remove_dir_all(&folder); // only a copy for SCAN
    }
    if files.is_empty() {
        eprintln!("name the files to read");
    }
    if accepted { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn read(file: &Path, folder: &Path) -> anyhow::Result<String> {
    let text = fs::read_to_string(file)?;
    match file.extension().and_then(|it| it.to_str()) {
        Some("jani") => jani::read(&text, folder),
        Some("scxml") => scxml::read(&text, folder),
        _ => anyhow::bail!("neither .jani nor .scxml"),
    }
}
