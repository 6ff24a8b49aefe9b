//! The story of a supervised run: point after point, what was found, decided and done.

use super::numbers::{metres, seconds};
use super::style::{BAD, FAINT, GOOD, HEADING, NOTICE};
use super::wrapped;
use crate::answers::supervised::{Point, Supervised};
use std::fmt::Write;

/// The most points that are shown.
const SHOWN_POINTS: usize = 40;

/// The points, in the order of time.
pub(crate) fn story(run: &Supervised, width: usize) -> String {
    let mut text = format!(
        "\n{HEADING}what happened{HEADING:#} {FAINT}times are since each failure; in capitals: \
         rows of `cotama fmeca`, sets of modules{FAINT:#}\n"
    );
    for point in run.points.iter().take(SHOWN_POINTS) {
        text += &told(point, width);
    }
    if run.points.len() > SHOWN_POINTS {
        let _ = writeln!(text, "  and {} more: see --json", run.points.len() - SHOWN_POINTS);
    }
    text
}

fn told(point: &Point, width: usize) -> String {
    let Point { number, text: title, .. } = point;
    let head = format!("  {number:>2}  {:>7}  {:>8}  ", metres(point.x_mm), seconds(point.t_ms));
    let indent = " ".repeat(head.chars().count());
    let mut text = format!("{head}{HEADING}{}{HEADING:#}\n", beside(title, width, &indent));
    for (name, style, words) in [
        ("found", BAD, &point.found),
        ("decided", NOTICE, &point.decided),
        ("done", GOOD, &point.done),
    ] {
        let Some(words) = words else { continue };
        let inner = format!("{indent}         ");
        let _ =
            writeln!(text, "{indent}{style}{name:7}{style:#}  {}", beside(words, width, &inner));
    }
    text
}

/// A text in lines, all but the first behind the indent.
fn beside(text: &str, width: usize, indent: &str) -> String {
    // Not narrower than some words.
    let lines = wrapped(text, width.max(indent.len() + 24), indent);
    lines.trim().replace(&format!("\n{indent}  "), &format!("\n{indent}"))
}
