//! The frame of the pages of runs and campaigns: the shared theme, their style sheet, their main
//! part.

use cotama_drawing::page::{THEME, write};

/// Writes a page with more style sheets than those that all have.
pub(crate) fn page(title: &str, more: &[&str], main: &str) -> String {
    let styles = [&[THEME, include_str!("style.css")], more].concat();
    write(title, &styles, &format!("<main>\n{main}</main>\n"))
}
