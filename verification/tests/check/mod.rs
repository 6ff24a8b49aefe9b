//! Answers of the checker's front: by the book on thousands of small nets, by known verdicts on
//! public ones; every certificate verifies, every run replays, and what is changed is refused.
//!
//! Public files are in the folder that `COTAMA_MCC_DIR` names: `*.pnml`, and `properties` with
//! files `NET.EXAMINATION.xml` and `verdicts.tsv`, whose columns start with file, property and
//! verdict.

mod contest;
mod fair;
mod laws;
mod limits;
mod message;
mod mutations;
pub(crate) mod nets;
mod quick;
mod replay;
mod small;
mod splits;
mod timed;
mod timed_logic;
mod unbounded;

use cotama_verification::property::{Property, Question};
use cotama_verification::pt::Pt;
use std::io::Write as _;
use std::path::PathBuf;

/// The folder of public nets; `None`, said loudly, without it.
fn folder(what: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("COTAMA_MCC_DIR").map(PathBuf::from);
    if folder.is_none() {
        // Not by `eprintln`, which says nothing when a test passes.
        let message =
            format!("SKIPPED: COTAMA_MCC_DIR names no folder of public nets, to check {what}\n");
        let _ = std::io::stderr().write_all(message.as_bytes());
    }
    folder
}

/// A question named by its text.
fn named(question: Question, pt: &Pt) -> Property {
    let name = question.display(pt).to_string();
    Property { name, question }
}
