//! All events that a net forgets, as lines of the `ignore` that would leave them on purpose.

use super::graph::Graph;
use crate::net::data::{Net, PlaceId, Role};
use crate::net::text::Text;
use crate::player::code::Code;

/// Pairs of an event and a place in which it would have to be ignored.
#[derive(Clone, Copy)]
pub(super) struct Missing {
    /// Number of pairs.
    pub(super) pairs: usize,
    /// A line for each event, as in `ignore`, and one for each guard.
    pub(super) lines: Text,
    /// The first pair, without its event.
    pub(super) first: Option<Pair>,
}

/// A place, and the absence that is asked for as well: the complement of a flag or counter.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    place: PlaceId,
    guard: Option<PlaceId>,
}

impl Pair {
    /// Adds it as it is written in `ignore`.
    pub(super) const fn add(self, net: &Net<'_>, text: Text) -> Text {
        let text = text.with(net.places[self.place.0 as usize].name);
        let Some(guard) = self.guard else { return text };
        let Role::Complement(of) = net.places[guard.0 as usize].role else { return text };
        let of = net.places[of.0 as usize];
        if of.bound == 1 {
            text.with(" [!").with(of.name).with("]")
        } else {
            text.with(" [").with(of.name).with(" < ").digits(of.bound as u64).with("]")
        }
    }
}

/// The most pairs with a guard that are listed of an event; further ones are without.
const GUARDED: usize = 32;

impl<const W: usize> Graph<W> {
    /// Returns the smallest `ignore` list found that makes `handles(all)` hold. Prefers places, or
    /// places and guards, in which the event is never used.
    pub(super) const fn missing(&self, net: &Net<'_>, code: &Code<'_, W>) -> Missing {
        let mut missing = Missing { pairs: 0, lines: Text::new(), first: None };
        let mut event = 0;
        while event < net.events.len() {
            self.missing_of(net, code, event, &mut missing);
            event += 1;
        }
        missing
    }

    /// Adds what is missing of an event.
    const fn missing_of(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        event: usize,
        missing: &mut Missing,
    ) {
        let name = net.events[event].name;
        let mut used = [0; W];
        let mut class = 0;
        while class < self.count {
            if self.answers(class, event) {
                used = either(used, self.markings[class]);
            }
            class += 1;
        }
        // The entries listed already: places, then pairs of a place and a complement.
        let (mut ignored, mut guarded, mut guards) = ([0; W], [([0; W], [0; W]); GUARDED], 0);
        let (mut listed, mut nowhere) = (false, false);
        // Pairs without a guard share a line, and those with one follow.
        class = 0;
        while class < 2 * self.count {
            let guards_too = class >= self.count;
            let at = class % self.count;
            let marking = &self.markings[at];
            class += 1;
            if listed && guards_too && at == 0 {
                missing.lines = missing.lines.with(";");
            }
            if !self.rests(at)
                || self.answers(at, event)
                || self.ignores(net, code, event, at)
                || meet(marking, &ignored)
                || meet_both(marking, guarded.split_at(guards).0)
            {
                continue;
            }
            let Some(place) = first_marked(net, code, marking, &used) else {
                missing.pairs += !nowhere as usize;
                nowhere = true;
                continue;
            };
            let guard = if guards < GUARDED && meet(&used, &field(code, place)) {
                absent(net, code, marking, &used)
            } else {
                None
            };
            let pair = Pair { place, guard };
            let lines = missing.lines;
            missing.lines = match guard {
                Some(_) if !guards_too => continue,
                None if listed && !guards_too => pair.add(net, lines.with(" & ")),
                _ => pair.add(net, lines.with("\n      ").with(name).with(" in ")),
            };
            if guards_too {
                missing.lines = missing.lines.with(";");
            }
            listed |= !guards_too;
            if missing.pairs == 0 {
                missing.first = Some(pair);
            }
            missing.pairs += 1;
            if let Some(guard) = guard {
                guarded[guards] = (field(code, place), field(code, guard));
                guards += 1;
            } else {
                ignored = either(ignored, field(code, place));
            }
        }
        if nowhere {
            let lines = missing.lines.with("\n      // no place is marked: a transition on ");
            missing.lines = lines.with(name);
        }
    }

    /// Whether a transition fires on an event in a class.
    const fn answers(&self, class: usize, event: usize) -> bool {
        let mut at = self.starts[class] as usize;
        while at < self.starts[class + 1] as usize {
            if self.firings[at].kind as usize == event {
                return true;
            }
            at += 1;
        }
        false
    }
}

/// The first marked place that `net!` has a name for and that is not among others; if all are, the
/// first one.
const fn first_marked<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    marking: &[u64; W],
    others: &[u64; W],
) -> Option<PlaceId> {
    let mut first = None;
    let mut at = net.places.len();
    let mut alone = false;
    while at > 0 {
        at -= 1;
        let place = PlaceId(at as u32);
        if !matches!(net.places[at].role, Role::Complement(_)) && code.fields[at].of(marking) > 0 {
            let other = meet(others, &field(code, place));
            if !other || !alone {
                first = Some(place);
                alone = !other;
            }
        }
    }
    first
}

/// The first complement that is marked and not among others.
const fn absent<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    marking: &[u64; W],
    others: &[u64; W],
) -> Option<PlaceId> {
    let mut at = 0;
    while at < net.places.len() {
        let place = PlaceId(at as u32);
        if matches!(net.places[at].role, Role::Complement(_))
            && code.fields[at].of(marking) > 0
            && !meet(others, &field(code, place))
        {
            return Some(place);
        }
        at += 1;
    }
    None
}

/// The bits of a place.
const fn field<const W: usize>(code: &Code<'_, W>, place: PlaceId) -> [u64; W] {
    let field = &code.fields[place.0 as usize];
    let mut bits = [0; W];
    bits[field.word as usize] = ((1 << field.width) - 1) << field.shift;
    bits
}

/// The bits of both.
const fn either<const W: usize>(mut a: [u64; W], b: [u64; W]) -> [u64; W] {
    let mut word = 0;
    while word < W {
        a[word] |= b[word];
        word += 1;
    }
    a
}

/// Whether two have a bit in common.
const fn meet<const W: usize>(a: &[u64; W], b: &[u64; W]) -> bool {
    let mut word = 0;
    while word < W {
        if a[word] & b[word] != 0 {
            return true;
        }
        word += 1;
    }
    false
}

/// Whether one has bits in common with both of some pair.
const fn meet_both<const W: usize>(a: &[u64; W], pairs: &[([u64; W], [u64; W])]) -> bool {
    let mut at = 0;
    while at < pairs.len() {
        if meet(a, &pairs[at].0) && meet(a, &pairs[at].1) {
            return true;
        }
        at += 1;
    }
    false
}
