//! Elements of SVG, as text.

use cotama_core::text::markup;
use std::fmt::{Arguments, Display, Write as _};

/// Shapes with classes, one behind the other. Colours and widths of lines are in style sheets, so
/// that drawings follow light, dark and print.
///
/// Numbers are pixels, written as they display. An empty class is left out.
///
/// ```
/// use cotama_verification::drawing::elements::Elements;
/// let mut out = Elements::default();
/// out.circle("token", [5, 8], 2);
/// out.text("", [5.5, 8.0], "a < b");
/// let circle = "<circle class=\"token\" cx=\"5\" cy=\"8\" r=\"2\"/>";
/// assert_eq!(out.as_str(), format!("{circle}<text x=\"5.5\" y=\"8\">a &lt; b</text>"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Elements {
    text: String,
}

impl Elements {
    /// Returns the text.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns the text.
    pub fn into_string(self) -> String {
        self.text
    }

    /// Adds markup as it is.
    pub fn push_str(&mut self, markup: &str) {
        self.text.push_str(markup);
    }

    /// Adds markup as it is.
    pub fn add(&mut self, markup: Arguments<'_>) {
        // Writing into a string cannot fail.
        let _ = self.text.write_fmt(markup);
    }

    fn begin(&mut self, name: &str, class: &str) {
        self.add(format_args!("<{name}"));
        if !class.is_empty() {
            self.add(format_args!(" class=\"{class}\""));
        }
    }

    /// Adds a rectangle by its left upper corner.
    pub fn rect<T: Display>(&mut self, class: &str, [x, y]: [T; 2], [width, height]: [T; 2]) {
        self.begin("rect", class);
        self.add(format_args!(" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>"));
    }

    /// Adds a rectangle with round corners.
    pub fn rounded<T: Display>(
        &mut self,
        class: &str,
        [x, y]: [T; 2],
        [width, height]: [T; 2],
        radius: T,
    ) {
        self.begin("rect", class);
        self.add(format_args!(
            " x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"{radius}\"/>"
        ));
    }

    /// Adds a straight line.
    pub fn line<T: Display>(&mut self, class: &str, [x1, y1]: [T; 2], [x2, y2]: [T; 2]) {
        self.begin("line", class);
        self.add(format_args!(" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>"));
    }

    /// Adds a path given by its commands.
    pub fn path(&mut self, class: &str, commands: impl Display) {
        self.begin("path", class);
        self.add(format_args!(" d=\"{commands}\"/>"));
    }

    /// Adds a circle.
    pub fn circle<T: Display>(&mut self, class: &str, [x, y]: [T; 2], radius: T) {
        self.begin("circle", class);
        self.add(format_args!(" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>"));
    }

    /// Adds a text on its base line.
    pub fn text<T: Display>(&mut self, class: &str, at: [T; 2], text: &str) {
        self.rich_text(class, at, &markup(text));
    }

    /// Adds a text that is markup already.
    pub fn rich_text<T: Display>(&mut self, class: &str, [x, y]: [T; 2], markup: &str) {
        self.begin("text", class);
        self.add(format_args!(" x=\"{x}\" y=\"{y}\">{markup}</text>"));
    }

    /// Adds the words for those who point at what it stands in; none if there are none.
    pub fn title(&mut self, title: &str) {
        if !title.is_empty() {
            self.add(format_args!("<title>{}</title>", markup(title)));
        }
    }
}
