//! Text: how wide it is, where lines break, how it is written in XML.

use crate::figure::Label;

/// The size of names, in pixels.
pub(super) const NAME: i64 = 13;

/// The size of labels, in pixels.
pub(super) const LABEL: i64 = 11;

/// The height of a line of a label.
pub(super) const LINE: i64 = 14;

/// More space between the labels of different transitions.
const BETWEEN: i64 = 5;

/// Labels break into lines that are hardly wider.
const WRAP: i64 = 150;

/// Longer names are cut in the middle; the title of the element has them whole.
const LONGEST: usize = 40;

/// Widths of the characters from space to tilde in Helvetica, in thousandths of the size (Adobe
/// font metrics).
const HELVETICA: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// The width of a text at a size, in pixels, rounded up. Characters beyond ASCII count as an
/// average capital, those from the East Asian scripts on as a square.
pub fn width(text: &str, size: i64) -> i64 {
    let thousandths = |c: char| match c {
        ' '..='~' => i64::from(HELVETICA[c as usize - ' ' as usize]),
        '\u{1100}'.. => 1000,
        _ => 700,
    };
    (text.chars().map(thousandths).sum::<i64>() * size + 999) / 1000
}

/// The same in bold.
pub fn bold_width(text: &str, size: i64) -> i64 {
    (width(text, size) * 108 + 99) / 100
}

/// A name as it is drawn: in one line, not too long.
pub fn short(name: &str) -> String {
    let plain: Vec<char> = name.chars().map(|c| if c.is_whitespace() { ' ' } else { c }).collect();
    if plain.len() <= LONGEST {
        return plain.into_iter().collect();
    }
    let half = LONGEST / 2;
    plain[..half].iter().chain(&['…']).chain(&plain[plain.len() - half..]).collect()
}

/// Lines of text, with the space they need.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) lines: Vec<Line>,
    pub(super) width: i64,
    pub(super) height: i64,
}

/// A line of a block.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    /// Base line, from the top of the block.
    pub(super) base: i64,
    pub(super) spans: Vec<Span>,
    /// Whether it belongs to something that is pointed out.
    pub(super) hot: bool,
}

/// A piece of a line that looks the same throughout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) face: Face,
    pub(super) text: String,
}

/// How text looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Face {
    Plain,
    /// The name of a transition.
    Strong,
    /// Actions and intervals.
    Quiet,
    /// The states that an entry comes from.
    Sources,
}

impl Block {
    /// Adds text, broken into lines at spaces where it is too wide.
    pub(super) fn text(&mut self, face: Face, text: &str, hot: bool) {
        self.words(text.split(' ').map(|word| (face, word.to_owned())), hot);
    }

    /// Adds a label: in one line if it is short, otherwise event and guard, actions and timing in
    /// lines of their own.
    pub(super) fn label(&mut self, label: &Label<'_>, hot: bool) {
        let words = |face, items: Vec<String>| -> Vec<(Face, String)> {
            items
                .iter()
                .flat_map(|item| item.split(' '))
                .map(|word| (face, word.to_owned()))
                .collect()
        };
        let joined = |items: &[String], open: &str, with: &str, close: &str| -> Vec<String> {
            let last = items.len().saturating_sub(1);
            let item = |(at, item): (usize, &String)| {
                let (open, close) =
                    (if at == 0 { open } else { "" }, if at == last { close } else { with });
                // Within an item the space does not break.
                format!("{open}{}{close}", short(item).replace(' ', "\u{a0}"))
            };
            items.iter().enumerate().map(item).collect()
        };
        let mut trigger = words(
            Face::Plain,
            label.event.map(|event| short(event).replace(' ', "\u{a0}")).into_iter().collect(),
        );
        trigger.extend(words(Face::Plain, joined(&label.guard, "[", " &", "]")));
        let actions = words(Face::Quiet, joined(&label.actions, "/\u{a0}", ",", ""));
        let timing = words(Face::Quiet, joined(&label.timing, "", ",", ""));
        for places in &label.places {
            self.text(Face::Sources, places, hot);
        }
        let sections = [trigger, actions, timing];
        let all: Vec<(Face, String)> = sections.concat();
        let total: i64 = all.iter().map(|(_, word)| width(word, LABEL) + width(" ", LABEL)).sum();
        // Actions and timing look alike.
        if total <= WRAP && (sections[1].is_empty() || sections[2].is_empty()) {
            self.words(all.into_iter(), hot);
        } else {
            for words in sections {
                self.words(words.into_iter(), hot);
            }
        }
    }

    /// Leaves space for what follows, if something is there.
    pub(super) fn pause(&mut self) {
        if !self.lines.is_empty() {
            self.height += BETWEEN;
        }
    }

    fn words(&mut self, words: impl Iterator<Item = (Face, String)>, hot: bool) {
        let mut line: Vec<Span> = Vec::new();
        for (face, word) in words {
            let wide = line_width(&line) + width(" ", LABEL) + width(&word, LABEL) > WRAP;
            match line.last_mut() {
                Some(_) if wide => {
                    self.push(std::mem::take(&mut line), hot);
                    line.push(Span { face, text: word });
                }
                Some(last) if last.face == face => {
                    last.text.push(' ');
                    last.text.push_str(&word);
                }
                Some(last) => {
                    last.text.push(' ');
                    line.push(Span { face, text: word });
                }
                None => line.push(Span { face, text: word }),
            }
        }
        if !line.is_empty() {
            self.push(line, hot);
        }
    }

    fn push(&mut self, spans: Vec<Span>, hot: bool) {
        self.width = self.width.max(line_width(&spans));
        let base = self.height + LABEL;
        self.height += LINE;
        self.lines.push(Line { base, spans, hot });
    }
}

fn line_width(spans: &[Span]) -> i64 {
    let span = |it: &Span| match it.face {
        Face::Strong => bold_width(&it.text, LABEL),
        Face::Plain | Face::Quiet | Face::Sources => width(&it.text, LABEL),
    };
    spans.iter().map(span).sum()
}

#[cfg(test)]
mod tests {
    use super::{Block, Face, Label, short, width};

    #[test]
    fn widths_are_those_of_helvetica() {
        assert_eq!(width("", 11), 0);
        assert_eq!(width("A", 1000), 667);
        assert_eq!(width("~", 1000), 584);
        assert_eq!(width("ij", 1000), 444);
        assert_eq!(width("日", 1000), 1000);
    }

    #[test]
    fn a_long_name_keeps_its_ends() {
        assert_eq!(short("two\nlines"), "two lines");
        assert_eq!(short(&"ab".repeat(30)), format!("{}…{}", "ab".repeat(10), "ab".repeat(10)));
    }

    #[test]
    fn a_wide_label_breaks_before_its_actions() {
        let mut block = Block::default();
        let actions = ["stop_PP", "stop_robot", "op_request"].map(str::to_owned).to_vec();
        block.label(&Label { event: Some("local_event"), actions, ..Label::default() }, false);
        let lines: Vec<Vec<(Face, &str)>> = block
            .lines
            .iter()
            .map(|line| line.spans.iter().map(|it| (it.face, it.text.as_str())).collect())
            .collect();
        let expected = [
            vec![(Face::Plain, "local_event")],
            vec![(Face::Quiet, "/\u{a0}stop_PP, stop_robot,")],
            vec![(Face::Quiet, "op_request")],
        ];
        assert_eq!(lines, expected);
        assert_eq!((block.height, block.lines[1].base), (42, 25));
    }
}
