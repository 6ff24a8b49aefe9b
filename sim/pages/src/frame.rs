//! The frame of the pages of runs and campaigns: the shared theme, their style sheet, their main
//! part.

use cotama_drawing::page::{THEME, write};

/// The style of a drawing of a floor.
pub(crate) const FLOOR: &str = include_str!("floor.css");

/// Writes a page with more style sheets than those that all have.
pub(crate) fn page(title: &str, more: &[&str], main: &str) -> String {
    let styles = [&[THEME, include_str!("style.css"), FLOOR], more].concat();
    write(title, &styles, &format!("<main>\n{main}</main>\n"))
}
