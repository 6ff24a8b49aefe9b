//! Pages of HTML: their frame, and the theme that they share.

use cotama_core::text::markup;

/// The style sheet that pages share: colours by name, in light and in dark, text, tables, controls,
/// paper. A page adds rules of its own.
pub const THEME: &str = include_str!("theme.css");

/// Writes a page that needs nothing else: a title, style sheets, and what stands in the body.
///
/// ```
/// use cotama_verification::drawing::page::{THEME, write};
/// let page = write("A & B", &[THEME, "main { max-width: 64rem; }\n"], "<main></main>\n");
/// assert!(page.contains("<title>A &amp; B</title>") && page.contains(THEME));
/// ```
pub fn write(title: &str, styles: &[&str], body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n<title>{}</title>\n\
         <style>\n{}</style>\n</head>\n<body>\n{body}</body>\n</html>\n",
        markup(title),
        styles.concat()
    )
}
