//! How long the lists of a net will be, and the names that its lowering makes.

use super::lookup::Found;
use super::source::{By, Claim, Line, Source};
use super::text::as_str;

/// How long the lists of a net are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Size {
    /// Places.
    pub places: usize,
    /// Transitions.
    pub transitions: usize,
    /// Arcs of all transitions and invariants.
    pub arcs: usize,
    /// Outputs of all transitions.
    pub emits: usize,
    /// Bytes of the names that the lowering makes.
    pub text: usize,
    /// Ignored events.
    pub ignored: usize,
    /// Laws.
    pub laws: usize,
}

impl Size {
    pub(super) const ZERO: Self =
        Self { places: 0, transitions: 0, arcs: 0, emits: 0, text: 0, ignored: 0, laws: 0 };
}

impl Source<'_> {
    /// How long the lists will be.
    #[track_caller]
    pub const fn size(&self) -> Size {
        self.check();
        let mut size = Size { places: self.own_places() + self.data(), ..Size::ZERO };
        let mut at = self.places.len();
        while at < self.own_places() {
            size.text += self.declared(at).name.len() + complement_affix(self, at).len();
            at += 1;
        }
        let mut at = 0;
        while at < self.lines.len() {
            let line = &self.lines[at];
            let variants = self.variants(line);
            let (mut possible, mut labels) = (0, 0);
            let mut number = 0;
            while number < variants {
                let variant = self.variant(line, number);
                if variant.possible {
                    possible += 1;
                    size.emits += line.emits.len();
                    labels += self.label(line, number, variants > 1, &mut [0; 512], 0);
                    let mut touched = 0;
                    while touched < variant.len() {
                        let (_, take, read, give) = variant.arcs(touched);
                        size.arcs +=
                            (take > 0) as usize + (read > 0) as usize + (give > 0) as usize;
                        touched += 1;
                    }
                }
                number += 1;
            }
            if possible == 0 {
                self.at_line(line)
                    .with("it can never fire: its conditions contradict each other, or its changes")
                    .stop();
            }
            size.transitions += possible;
            size.text += if possible > 1 { labels } else { line.name.len() };
            at += 1;
        }
        let mut at = 0;
        while at < self.laws.len() {
            match self.laws[at] {
                Claim::Invariant(sum, _) => {
                    size.arcs += sum.len();
                    size.laws += 1;
                }
                Claim::LeftToChecker => {}
                _ => size.laws += 1,
            }
            at += 1;
        }
        let mut at = 0;
        while at < self.ignored.len() {
            let line = &self.ignored[at];
            let mut named = 0;
            while named < line.places.len() {
                let pairs = self.pairs(line.places[named]);
                let mut pair = 0;
                while pair < pairs && !line.guard.is_empty() {
                    size.arcs += self.ignoring(line, self.ignored_in(line, named, pair)).asked();
                    pair += 1;
                }
                size.ignored += pairs;
                named += 1;
            }
            at += 1;
        }
        size
    }

    /// Writes the name of a variant; its length.
    pub(super) const fn label<const N: usize>(
        &self,
        line: &Line<'_>,
        number: usize,
        several: bool,
        text: &mut [u8; N],
        start: usize,
    ) -> usize {
        let mut end = put(text, start, line.name);
        if several {
            let (member, mut old) = self.member(line, number);
            if let Some(member) = member {
                end = put(text, end, ".");
                end = put(text, end, member);
            }
            let mut at = 0;
            while at < line.changes.len() {
                let change = line.changes[at];
                if let (By::Become(_), Found::Data(place, _)) = (change.by, self.find(change.name))
                {
                    let radix = self.declared(place).bound as usize + 1;
                    end = put(text, end, ".");
                    end = put(text, end, change.name);
                    end = put(text, end, "_");
                    end = put_number(text, end, old % radix);
                    old /= radix;
                }
                at += 1;
            }
        }
        end - start
    }
}

/// Returns the affix that makes the name of a complement from that of its flag (before it) or
/// counter (after it).
pub(super) const fn complement_affix(source: &Source<'_>, at: usize) -> &'static str {
    if source.declared(at).bound == 1 { "not_" } else { "_left" }
}

/// Writes a text; where it ends.
pub(super) const fn put<const N: usize>(text: &mut [u8; N], start: usize, more: &str) -> usize {
    let more = more.as_bytes();
    let mut at = 0;
    while at < more.len() && start + at < N {
        text[start + at] = more[at];
        at += 1;
    }
    start + at
}

const fn put_number<const N: usize>(text: &mut [u8; N], start: usize, number: usize) -> usize {
    let start = if number >= 10 { put_number(text, start, number / 10) } else { start };
    put(text, start, as_str(&[b'0' + (number % 10) as u8]))
}
