//! Inline SVG with coordinates of one decimal, and lines that leave out the texts in their way.

use cotama_core::text::markup;
use cotama_drawing::elements::Elements;
use std::fmt::Write;

/// A coordinate: one decimal, without a needless one.
pub(crate) fn fixed(value: f64) -> String {
    let tenths = (value.clamp(-1e6, 1e6) * 10.0).round() as i64;
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, tenth) = (tenths.abs() / 10, tenths.abs() % 10);
    if tenth == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{tenth}") }
}

/// The size of small text, in wide drawings and in narrow ones.
pub(crate) const SMALL: f64 = 11.0;

/// Returns about how wide a text is at most: the fonts of the style sheet differ, and these are the
/// widths of the widest (`DejaVu Sans`), rounded up.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    let width = |it: char| match it {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '|' | '\'' | ' ' | '\u{a0}'
        | '\u{202f}' => 0.34,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '-' | '/' | '!' => 0.43,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '…' => 1.0,
        'A'..='Z' | '<' | '>' | '=' | '+' | '≤' | '→' | '\u{2212}' => 0.84,
        _ => 0.65,
    };
    text.chars().map(width).sum::<f64>() * size
}

/// A text that is cut where it is wider than there is room.
pub(crate) fn fitted(text: &str, size: f64, room: f64) -> String {
    if text_width(text, size) <= room {
        return text.into();
    }
    let mut cut = String::new();
    for it in text.chars() {
        if text_width(&cut, size) + text_width(&format!("{it}…"), size) > room {
            break;
        }
        cut.push(it);
    }
    cut.push('…');
    cut
}

/// About where a text stands: left, top, right, bottom. Its class tells its size and its anchor.
pub(crate) fn text_box(class: &str, [x, y]: [f64; 2], text: &str) -> [f64; 4] {
    let is = |name: &str| class.split(' ').any(|it| it == name);
    let size = if is("small") || is("pin") { SMALL } else { 12.0 };
    let bold = if is("strong") || is("pin") { 1.1 } else { 1.0 };
    let width = text_width(text, size) * bold;
    let left = match (is("m"), is("e")) {
        (true, _) => x - width / 2.0,
        (_, true) => x - width,
        _ => x,
    };
    [left, y - size * 0.8, left + width, y + size * 0.25]
}

/// A vertical line behind everything, which stops where text stands.
struct Guide {
    class: &'static str,
    title: String,
    x: f64,
    top: f64,
    bottom: f64,
}

/// Draws a rectangle; a negative width or height is none.
fn rect(out: &mut Elements, class: &str, corner: [f64; 2], size: [f64; 2]) {
    out.rect(class, corner.map(fixed), size.map(|it| fixed(it.max(0.0))));
}

/// A drawing under construction.
#[derive(Default)]
pub(crate) struct Svg {
    /// Elements under the guides.
    ground: Elements,
    guides: Vec<Guide>,
    body: Elements,
    /// The boxes of all texts: left, top, right, bottom.
    texts: Vec<[f64; 4]>,
}

impl Svg {
    /// An empty drawing.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// A rectangle under everything.
    pub(crate) fn ground(&mut self, class: &str, corner: [f64; 2], size: [f64; 2]) {
        rect(&mut self.ground, class, corner, size);
    }

    /// A shape under everything.
    pub(crate) fn ground_path(&mut self, class: &str, commands: &str) {
        self.ground.path(class, commands);
    }

    /// A vertical line that runs behind everything and leaves out the texts in its way.
    pub(crate) fn guide(&mut self, class: &'static str, title: &str, x: f64, ends: [f64; 2]) {
        let [top, bottom] = ends;
        self.guides.push(Guide { class, title: title.into(), x, top, bottom });
    }

    /// A rectangle; a negative width or height is none.
    pub(crate) fn rect(&mut self, class: &str, corner: [f64; 2], size: [f64; 2]) {
        rect(&mut self.body, class, corner, size);
    }

    /// A straight line.
    pub(crate) fn line(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        self.body.line(class, from.map(fixed), to.map(fixed));
    }

    /// A vertical line that a script moves between two places.
    pub(crate) fn cursor(&mut self, [left, right]: [f64; 2], ends: [f64; 2]) {
        let ([left, right], [top, bottom]) = ([left, right].map(fixed), ends.map(fixed));
        self.body.add(format_args!(
            "<line class=\"cursor\" data-left=\"{left}\" data-right=\"{right}\" x1=\"{left}\" \
             y1=\"{top}\" x2=\"{left}\" y2=\"{bottom}\"/>"
        ));
    }

    /// A path given by its commands.
    pub(crate) fn path(&mut self, class: &str, commands: &str) {
        if !commands.is_empty() {
            self.body.path(class, commands);
        }
    }

    /// A circle.
    pub(crate) fn circle(&mut self, class: &str, centre: [f64; 2], radius: f64) {
        self.body.circle(class, centre.map(fixed), fixed(radius));
    }

    /// Text with its base line at `y`; classes `m` and `e` put its middle or its end at `x`.
    pub(crate) fn text(&mut self, class: &str, at: [f64; 2], text: &str) {
        self.texts.push(text_box(class, at, text));
        self.body.text(class, at.map(fixed), text);
    }

    /// Shapes that belong together, with words for those who point at them.
    pub(crate) fn titled(&mut self, title: &str, draw: impl FnOnce(&mut Self)) {
        self.body.add(format_args!("<g><title>{}</title>", markup(title)));
        draw(self);
        self.body.push_str("</g>");
    }

    /// Draws another drawing on top.
    pub(crate) fn append(&mut self, other: &Self) {
        self.ground.push_str(other.ground.as_str());
        self.body.push_str(other.body.as_str());
        self.texts.extend_from_slice(&other.texts);
    }

    /// The pieces of a guide between the texts in its way.
    fn pieces(&self, guide: &Guide) -> String {
        // Fonts differ in width.
        let room = |it: &[f64; 4]| 2.0 + (it[2] - it[0]) * 0.08;
        let on = |it: &&[f64; 4]| it[0] - room(it) < guide.x && guide.x < it[2] + room(it);
        let mut breaks: Vec<[f64; 2]> =
            self.texts.iter().filter(on).map(|it| [it[1] - 1.0, it[3] + 1.0]).collect();
        breaks.sort_by(|a, b| a[0].total_cmp(&b[0]));
        breaks.push([guide.bottom, guide.bottom]);
        let mut path = String::new();
        let mut from = guide.top;
        for [top, bottom] in breaks {
            let to = top.min(guide.bottom);
            if to - from >= 2.0 {
                let _ = write!(path, "M{} {}V{}", fixed(guide.x), fixed(from), fixed(to));
            }
            from = from.max(bottom);
        }
        path
    }

    /// The element; `label` says in words what it shows.
    pub(crate) fn finish(self, class: &str, [width, height]: [f64; 2], label: &str) -> String {
        let (width, height, label) = (fixed(width), fixed(height), markup(label));
        let mut guides = String::new();
        for it in &self.guides {
            let (class, title, pieces) = (it.class, markup(&it.title), self.pieces(it));
            let _ = write!(
                guides,
                "<path class=\"{class}\" d=\"{pieces}\"><title>{title}</title></path>"
            );
        }
        format!(
            "<svg class=\"{class}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-label=\"{label}\">{}{guides}{}</svg>\n",
            self.ground.as_str(),
            self.body.as_str()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_one_decimal_at_most_and_no_negative_zero() {
        let written = [1.0, 1.26, -0.04, -12.34, f64::NAN, f64::INFINITY].map(fixed);
        assert_eq!(written, ["1", "1.3", "0", "-12.3", "0", "1000000"]);
    }

    #[test]
    fn a_guide_leaves_out_the_texts_in_its_way_wherever_they_are_added() {
        let mut svg = Svg::new();
        svg.guide("replan", "plan 1", 50.0, [0.0, 100.0]);
        svg.text("m small", [50.0, 40.0], "label");
        svg.text("small", [80.0, 60.0], "aside");
        assert!(svg.finish("", [100.0, 100.0], "").contains("d=\"M50 0V30.2M50 43.8V100\""));
    }
}
