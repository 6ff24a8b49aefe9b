//! Why there is no plan, for people.

use super::style::{FAINT, HEADING};
use crate::answers::Reason;
use std::fmt::Write;

/// The most relaxations that are shown.
const SHOWN: usize = 8;

/// The reason, what weighs most, and what would help.
pub(crate) fn reason(reason: &Reason) -> String {
    let mut text = format!("  {}\n", reason.text);
    if !reason.heaviest.is_empty() {
        let _ = writeln!(
            text,
            "\n{HEADING}what weighs most{HEADING:#} {FAINT}in the plan that needs least{FAINT:#}"
        );
        for heavy in &reason.heaviest {
            let _ = writeln!(text, "  {}", heavy.text);
        }
    }
    if !reason.relaxations.is_empty() {
        let _ = writeln!(
            text,
            "\n{HEADING}what would make a plan possible{HEADING:#} {FAINT}each alone{FAINT:#}"
        );
        for relaxation in reason.relaxations.iter().take(SHOWN) {
            let _ = writeln!(text, "  {}", relaxation.text);
        }
        if reason.relaxations.len() > SHOWN {
            let _ = writeln!(text, "  and {} more: see --json", reason.relaxations.len() - SHOWN);
        }
    }
    text
}
