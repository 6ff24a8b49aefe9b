//! Why there is no plan, for people.

use super::style::{FAINT, HEADING};
use super::wrapped;
use crate::answers::Reason;
use std::fmt::Write;

const INDENT: &str = "  ";
/// The most relaxations that are shown.
const SHOWN: usize = 8;

/// The reason, what weighs most, and what would help.
pub(crate) fn reason(reason: &Reason, width: usize) -> String {
    let mut text = wrapped(&reason.text, width, INDENT);
    if !reason.heaviest.is_empty() {
        let _ = writeln!(
            text,
            "\n{HEADING}what weighs most{HEADING:#} {FAINT}in the plan that needs least{FAINT:#}"
        );
        for heavy in &reason.heaviest {
            text += &wrapped(&heavy.text, width, INDENT);
        }
    }
    if !reason.relaxations.is_empty() {
        let _ = writeln!(
            text,
            "\n{HEADING}what would make a plan possible{HEADING:#} {FAINT}each alone{FAINT:#}"
        );
        for relaxation in reason.relaxations.iter().take(SHOWN) {
            text += &wrapped(&relaxation.text, width, INDENT);
        }
        if reason.relaxations.len() > SHOWN {
            let _ = writeln!(text, "  and {} more: see --json", reason.relaxations.len() - SHOWN);
        }
    }
    text
}
