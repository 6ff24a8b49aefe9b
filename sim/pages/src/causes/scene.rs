//! Drawings as data: shapes and texts with their places, so that what is drawn can also be
//! measured.

use cotama_drawing::elements::Elements;
use cotama_drawing::svg::{bold_width, width};

/// How a text looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Face {
    /// The function in the head.
    Head,
    /// A component.
    Component,
    /// A failure.
    Failure,
    /// A cause, and other words that explain.
    Quiet,
    /// An identifier or a letter on colour, centred.
    Badge,
    /// The same on dark colour.
    DarkBadge,
}

impl Face {
    /// Returns the size in pixels.
    const fn size(self) -> i64 {
        match self {
            Self::Head => 15,
            Self::Component | Self::Failure => 12,
            Self::Quiet | Self::Badge | Self::DarkBadge => 11,
        }
    }

    /// The height of a line.
    pub(super) const fn line(self) -> i64 {
        self.size() + 3
    }

    /// The height of several lines.
    pub(super) fn height(self, lines: &[String]) -> i64 {
        lines.iter().map(|_| self.line()).sum()
    }

    const fn class(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::Component => "component",
            Self::Failure => "failure",
            Self::Quiet => "quiet",
            Self::Badge => "badge",
            Self::DarkBadge => "badge dark",
        }
    }

    /// How wide a text is.
    pub(super) fn width(self, text: &str) -> i64 {
        match self {
            Self::Failure | Self::Quiet => width(text, self.size()),
            Self::Head | Self::Component | Self::Badge | Self::DarkBadge => {
                bold_width(text, self.size())
            }
        }
    }

    /// A text in as few lines as it needs if they are hardly wider than this, about equally long.
    pub(super) fn lines(self, text: &str, most: i64) -> Vec<String> {
        let few = self.filled(text, most);
        let narrower = (1..most).step_by(4).map(|width| self.filled(text, width));
        narrower.into_iter().find(|lines| lines.len() <= few.len()).unwrap_or(few)
    }

    /// A text in lines as long as they can be, broken between words.
    fn filled(self, text: &str, most: i64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ') {
            match lines.last_mut() {
                Some(line) if self.width(&format!("{line} {word}")) <= most => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines
    }
}

/// A place, to the right and down.
pub(super) type Place = (i64, i64);

/// One thing in a drawing; `class` is for the style sheet.
#[derive(Clone, Debug)]
pub(super) enum Item {
    /// A line, with an arrow at its end or without.
    Line { class: &'static str, from: Place, to: Place, arrow: bool },
    /// A box with a corner radius.
    Rect { class: String, corner: Place, size: Place, radius: i64 },
    /// A text whose line begins at, or is centred on, this place; its base line.
    Text { face: Face, at: Place, text: String },
}

/// Things that belong together, with words for who points at them.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    pub(super) title: String,
    pub(super) items: Vec<Item>,
}

/// A drawing.
#[derive(Clone, Debug, Default)]
pub(super) struct Scene {
    pub(super) width: i64,
    pub(super) height: i64,
    pub(super) groups: Vec<Group>,
}

impl Group {
    /// Adds a text.
    pub(super) fn text(&mut self, face: Face, at: Place, text: impl Into<String>) {
        self.items.push(Item::Text { face, at, text: text.into() });
    }

    /// Adds a line.
    pub(super) fn line(&mut self, class: &'static str, from: Place, to: Place) {
        self.items.push(Item::Line { class, from, to, arrow: false });
    }

    /// Adds a line with an arrow at its end.
    pub(super) fn arrow(&mut self, class: &'static str, from: Place, to: Place) {
        self.items.push(Item::Line { class, from, to, arrow: true });
    }

    /// Adds a box.
    pub(super) fn rect(
        &mut self,
        class: impl Into<String>,
        corner: Place,
        size: Place,
        radius: i64,
    ) {
        self.items.push(Item::Rect { class: class.into(), corner, size, radius });
    }
}

impl Scene {
    /// Returns the shapes as SVG elements, moved to a place.
    pub(super) fn elements(&self, (right, down): Place) -> String {
        let mut out = Elements::default();
        out.add(format_args!("<g transform=\"translate({right} {down})\">\n"));
        for group in &self.groups {
            out.push_str("<g>");
            out.title(&group.title);
            for item in &group.items {
                draw(&mut out, item);
            }
            out.push_str("</g>\n");
        }
        out.push_str("</g>\n");
        out.into_string()
    }
}

fn draw(out: &mut Elements, item: &Item) {
    match *item {
        Item::Line { class, from, to: (x, y), arrow } => {
            out.line(class, from.into(), [x, y]);
            if arrow {
                out.path(&format!("tip {class}"), format_args!("M{x} {y}l-10 -5v10z"));
            }
        }
        Item::Rect { ref class, corner, size, radius } => {
            out.rounded(class, corner.into(), size.into(), radius);
        }
        Item::Text { face, at, ref text } => out.text(face.class(), at.into(), text),
    }
}

/// Measurements for tests.
#[cfg(test)]
impl Scene {
    /// The texts with their boxes: left, top, right, bottom.
    pub(super) fn texts(&self) -> Vec<(&str, [i64; 4])> {
        let items = self.groups.iter().flat_map(|group| &group.items);
        let text = |item| match item {
            &Item::Text { face, at: (x, y), ref text } => {
                let wide = face.width(text);
                let is_centred = matches!(face, Face::Badge | Face::DarkBadge);
                let left = if is_centred { x - wide / 2 } else { x };
                // A line of Helvetica has 0.72 above the base line and 0.21 below.
                let (up, down) = ((face.size() * 72 + 99) / 100, (face.size() * 21 + 99) / 100);
                Some((text.as_str(), [left, y - up, left + wide, y + down]))
            }
            Item::Line { .. } | Item::Rect { .. } => None,
        };
        items.filter_map(text).collect()
    }

    /// The lines.
    pub(super) fn lines(&self) -> Vec<(Place, Place)> {
        let items = self.groups.iter().flat_map(|group| &group.items);
        let line = |item: &Item| match item {
            &Item::Line { from, to, .. } => Some((from, to)),
            Item::Rect { .. } | Item::Text { .. } => None,
        };
        items.filter_map(line).collect()
    }
}
