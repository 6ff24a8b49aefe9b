//! How tokens come and go along a run, as bars.

use super::{AtomTrack, Diagnosis, Track};
use cotama_core::text::markup;
use cotama_drawing::elements::Elements;

/// The most markings that are drawn; of a longer run the last ones.
const SHOWN: usize = 80;

/// Pixels: the height of a row, the space above, and about the width of a character.
const ROW: usize = 24;
const TOP: usize = 8;
const CHARACTER: usize = 7;

/// Longer names are cut.
const NAME: usize = 36;

/// Bars, row by row.
struct Bars {
    out: Elements,
    /// The first marking that is drawn, and how many are.
    first: usize,
    count: usize,
    cell: usize,
    rows: usize,
    /// Left edge of the first bar, in pixels.
    left: usize,
}

/// The bars of the places that are watched, and of the atoms that are more than marked places;
/// `None` without any.
pub(super) fn timeline(diagnosis: &Diagnosis) -> Option<String> {
    let atoms: Vec<&AtomTrack> = diagnosis.atoms.iter().filter(|it| !it.is_mark).collect();
    let rows = diagnosis.watched.len() + atoms.len();
    if rows == 0 {
        return None;
    }
    let all = diagnosis.trace.len() + 1;
    let count = all.min(SHOWN);
    let names = diagnosis.watched.iter().map(|it| &it.place).chain(atoms.iter().map(|it| &it.atom));
    let longest =
        names.map(|it| super::words::printable(it).chars().count().min(NAME)).max().unwrap_or(0);
    let left = longest.max(4) * CHARACTER + 20;
    let cell = (720 / count).clamp(9, 44);
    let mut bars =
        Bars { out: Elements::default(), first: all - count, count, cell, rows: 0, left };
    let (width, height) = (left + count * cell + 12, TOP + rows * ROW + 26);
    bars.out.add(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"timeline\" width=\"{width}\" \
         height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
         <title>Tokens after each step</title>\n",
    ));
    bars.axis(diagnosis, rows);
    for track in &diagnosis.watched {
        bars.place(track);
    }
    for track in atoms {
        bars.atom(track);
    }
    bars.out.push_str("</svg>\n");
    Some(bars.out.into_string())
}

impl Bars {
    fn x(&self, marking: usize) -> usize {
        self.left + (marking - self.first) * self.cell
    }

    /// Numbers of steps below, a line where the cycle begins.
    fn axis(&mut self, diagnosis: &Diagnosis, rows: usize) {
        let bottom = TOP + rows * ROW;
        let every = 28_usize.div_ceil(self.cell);
        for marking in self.first..self.first + self.count {
            let x = self.x(marking);
            self.out.path("grid", format_args!("M{x} {TOP}V{bottom}"));
            if marking.is_multiple_of(every) {
                let text = if marking == 0 { "start".to_owned() } else { marking.to_string() };
                self.out.text("number", [x + self.cell / 2, bottom + 16], &text);
                self.out.push_str("\n");
            }
        }
        if let Some(start) =
            diagnosis.cycle_starts_at.map(|it| it + 1).filter(|it| *it >= self.first)
        {
            let (x, end) = (self.x(start), self.x(self.first + self.count));
            self.out.add(format_args!(
                "<rect class=\"cycle\" x=\"{x}\" y=\"{TOP}\" width=\"{}\" height=\"{}\">\
                 <title>repeats for ever</title></rect>\n",
                end - x,
                bottom - TOP
            ));
        }
    }

    fn label(&mut self, text: &str) -> usize {
        let y = TOP + self.rows * ROW;
        self.rows += 1;
        let text = super::words::printable(text);
        let short: String = if text.chars().count() > NAME {
            text.chars().take(NAME - 1).chain(['…']).collect()
        } else {
            text.clone()
        };
        let text = format!("{}<title>{}</title>", markup(&short), markup(&text));
        self.out.rich_text("row", [self.left - 10, y + ROW / 2 + 4], &text);
        y
    }

    fn place(&mut self, track: &Track) {
        let y = self.label(&track.place);
        let is_counted = track.tokens.iter().any(|it| *it > 1);
        let shown: Vec<u32> = track.tokens.iter().skip(self.first).copied().collect();
        self.bars(y, &shown, "bar", |tokens| match tokens {
            0 => None,
            _ if is_counted => Some(tokens.to_string()),
            _ => Some(String::new()),
        });
    }

    fn atom(&mut self, track: &AtomTrack) {
        let y = self.label(&track.atom);
        let shown: Vec<bool> = track.holds.iter().skip(self.first).copied().collect();
        self.bars(y, &shown, "bar atom", |holds| holds.then(String::new));
    }

    /// A bar for each stretch of equal values that has a text.
    fn bars<T: Copy + PartialEq>(
        &mut self,
        y: usize,
        values: &[T],
        class: &str,
        text: impl Fn(T) -> Option<String>,
    ) {
        let mut at = self.first;
        for stretch in values.chunk_by(|a, b| a == b) {
            let (from, to) = (self.x(at), self.x(at + stretch.len()));
            at += stretch.len();
            let Some(text) = stretch.first().and_then(|it| text(*it)) else { continue };
            self.out.rounded(class, [from + 1, y + 4], [to - from - 2, ROW - 8], 3);
            if !text.is_empty() {
                self.out.text("count", [usize::midpoint(from, to), y + ROW / 2 + 4], &text);
            }
        }
        self.out.push_str("\n");
    }
}
