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
pub(crate) mod mutations;
pub(crate) mod nets;
mod own;
mod quick;
mod replay;
mod small;
mod splits;
mod timed;
mod timed_logic;
mod unbounded;

use cotama_verification::property::{Property, Question};
use cotama_verification::pt::Pt;
use std::path::PathBuf;

/// The folder of public nets; `None`, said loudly, without it.
fn folder(what: &str) -> Option<PathBuf> {
    cotama_golden::public_folder("COTAMA_MCC_DIR", what)
}

/// A question named by its text.
pub(crate) fn named(question: Question, pt: &Pt) -> Property {
    let name = question.display(pt).to_string();
    Property { name, question }
}
