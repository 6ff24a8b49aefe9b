//! A diagnosis as a drawing of its own.

use super::picture::Frame;
use super::words::printable;
use super::{Diagnosis, Unused};
use cotama_core::net::Net;
use cotama_core::text::markup;
use cotama_drawing::elements::Elements;
use cotama_drawing::svg::{STYLE, bold_width, short, width};
use std::fmt::Write as _;

/// Pixels: around everything, between frames, the least width and the most with frames beside each
/// other, the size of monospaced text and the width of its characters.
const MARGIN: i64 = 24;
const GAP: i64 = 16;
const WIDTH: i64 = 960;
const WIDEST: i64 = 1600;
const MONO: i64 = 12;
const MONO_WIDTH: i64 = 8;

/// The most drawings of a run.
const FRAMES: usize = 9;

const MORE_STYLE: &str = "\
.cotama .heading{font-size:17px;font-weight:600}
.cotama .said{font-size:13px}
.cotama .mono{font-family:'DejaVu Sans Mono',Menlo,Consolas,monospace;font-size:12px;\
white-space:pre}
.cotama .caption{font-size:12px;font-weight:600}
.cotama .frame{fill:none;stroke:#d0d7de;stroke:var(--fill);stroke-width:2}
.cotama .frame.last{stroke:#c2410c;stroke:var(--hot)}
";

/// Lines and frames, one below the other.
struct Sheet {
    out: Elements,
    /// Top of the next line or frame, in pixels.
    y: i64,
    width: i64,
}

impl Diagnosis {
    /// A drawing of its own, in SVG: the verdict and its cause, and the net at the start and after
    /// each step, if net and run are short; else the net after the last step, and the steps as
    /// lines. It needs no other file; colours follow the reader's light or dark mode.
    pub fn svg(&self) -> String {
        let frames =
            self.picture.as_ref().map_or_else(Vec::new, |it| it.frames(&self.trace, FRAMES));
        let shows_all = frames.len() == self.trace.len() + 1;
        let mut sheet = Sheet::around(&frames);
        sheet.said("quiet", 12, &printable(&self.net));
        sheet.said("heading", 17, &self.summary);
        for line in std::iter::once(&self.cause).chain(&self.notes) {
            sheet.said("said", 13, line);
        }
        if !shows_all {
            sheet.lines(&self.steps_as_text());
        }
        sheet.frames(&frames);
        match self.cycle_starts_at.map(|it| it + 1) {
            Some(start) if start == self.trace.len() => {
                sheet.said("said", 13, &format!("Step {start} repeats for ever."));
            }
            Some(start) => {
                sheet.said(
                    "said",
                    13,
                    &format!("Steps {start} to {} repeat for ever.", self.trace.len()),
                );
            }
            None => {}
        }
        sheet.finished(&format!("{}: {}", printable(&self.net), printable(&self.name)))
    }
}

impl Unused<'_> {
    /// A drawing of its own, in SVG: what is unused, and a small net in which it is pointed out; of
    /// the net with its events and documentation, if that is given.
    pub fn svg(&self, net: Option<&Net<'_>>) -> String {
        let frame = self.picture(net).map(|it| it.frame("start".to_owned(), "at-0-", None));
        let frames: Vec<Frame> =
            frame.map(|it| Frame { is_last: false, ..it }).into_iter().collect();
        let mut sheet = Sheet::around(&frames);
        sheet.said("quiet", 12, &printable(self.net_name()));
        sheet.lines(&self.to_string());
        sheet.frames(&frames);
        sheet.finished(&format!("{}: what no run uses", printable(self.net_name())))
    }
}

/// A count to calculate pixels with; no drawing is a million characters wide.
fn count(items: usize) -> i64 {
    u32::try_from(items).map_or(1_000_000, |it| i64::from(it).min(1_000_000))
}

fn widest(frames: &[Frame]) -> i64 {
    frames.iter().map(|it| it.part.width).max().unwrap_or(0).max(180)
}

impl Sheet {
    /// An empty one, wide enough for about as many of these beside as below each other.
    fn around(frames: &[Frame]) -> Self {
        let columns = (1..=3).find(|it| it * it >= count(frames.len())).unwrap_or(3);
        let across = |columns: i64| columns * (widest(frames) + GAP) - GAP + 2 * MARGIN;
        let width =
            (1..=columns).map(across).take_while(|it| *it <= WIDEST).last().unwrap_or(across(1));
        Self { out: Elements::default(), y: MARGIN, width: WIDTH.max(width) }
    }

    /// A sentence with names in backticks, in as many lines as it takes.
    fn said(&mut self, class: &str, size: i64, text: &str) {
        let (mut line, mut used, mut is_name) = (String::new(), 0, false);
        for word in text.split_whitespace() {
            let mut parts = Vec::new();
            for (at, part) in word.split('`').enumerate() {
                is_name ^= at > 0;
                parts.push((part, is_name));
            }
            let wide = |&(part, is_name): &(&str, bool)| {
                if is_name || class == "heading" {
                    bold_width(part, size)
                } else {
                    width(part, size)
                }
            };
            let needed = parts.iter().map(wide).sum::<i64>() + width(" ", size);
            if used > 0 && used + needed > self.width - 2 * MARGIN {
                self.line(class, size, &std::mem::take(&mut line));
                used = 0;
            }
            line += if used > 0 { " " } else { "" };
            used += needed;
            for (part, is_name) in parts.into_iter().filter(|it| !it.0.is_empty()) {
                let part = markup(part);
                if is_name {
                    let _ = write!(line, "<tspan class=\"strong\">{part}</tspan>");
                } else {
                    line += &part;
                }
            }
        }
        if !line.is_empty() {
            self.line(class, size, &line);
            self.y += 4;
        }
    }

    /// A line of markup.
    fn line(&mut self, class: &str, size: i64, markup: &str) {
        let base = self.y + size;
        self.out.rich_text(class, [MARGIN, base], markup);
        self.out.push_str("\n");
        self.y += size + size / 2;
    }

    /// Lines with columns.
    fn lines(&mut self, text: &str) {
        self.y += GAP;
        for line in text.lines() {
            self.width = self.width.max(count(line.chars().count()) * MONO_WIDTH + 2 * MARGIN);
            // Not every reader keeps spaces.
            self.line("mono", MONO, &markup(&line.replace(' ', "\u{a0}")));
        }
    }

    /// Frames beside each other, as many as fit.
    fn frames(&mut self, frames: &[Frame]) {
        let widest = widest(frames);
        let columns =
            usize::try_from((self.width - 2 * MARGIN + GAP) / (widest + GAP)).unwrap_or(1).max(1);
        for row in frames.chunks(columns) {
            let top = self.y + GAP;
            let height = row.iter().map(|it| it.part.height).max().unwrap_or(0);
            for (at, frame) in row.iter().enumerate() {
                let x = MARGIN + count(at) * (widest + GAP);
                let mut caption = short(&frame.caption);
                while bold_width(&caption, 12) > widest && caption.pop().is_some() {}
                let last = if frame.is_last { "frame last" } else { "frame" };
                let inset = (widest - frame.part.width) / 2;
                self.out.text("caption", [x, top + 12], &caption);
                self.out.push_str("\n");
                self.out.rounded(last, [x, top + 20], [widest, height], 6);
                self.out.add(format_args!(
                    "\n<g transform=\"translate({} {})\">\n{}</g>\n",
                    x + inset,
                    top + 20,
                    frame.part.text
                ));
            }
            self.y = top + 20 + height;
        }
        self.y += GAP;
    }

    fn finished(self, title: &str) -> String {
        let Self { out, y, width } = self;
        let height = y + MARGIN;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cotama\" width=\"{width}\" \
             height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"title\">\n\
             <title id=\"title\">{}</title>\n<style>\n{STYLE}{MORE_STYLE}</style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n{}</svg>\n",
            markup(title),
            out.as_str()
        )
    }
}
