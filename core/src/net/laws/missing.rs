//! All events that a net forgets, as lines of the `ignore` that would leave them on purpose.

use super::graph::Graph;
use crate::net::data::{Net, PlaceId, Role};
use crate::net::text::Text;
use crate::player::code::Code;

/// Pairs of an event and a place in which it would have to be ignored.
#[derive(Clone, Copy)]
pub(super) struct Missing {
    /// How many.
    pub(super) pairs: usize,
    /// A line for each event, as in `ignore`.
    pub(super) lines: Text,
    /// The place of the first pair.
    pub(super) place: Option<PlaceId>,
}

impl<const W: usize> Graph<W> {
    /// What a net that breaks `handles(all)` would have to ignore so that it keeps it: few pairs,
    /// and places in which the event is never used where there are such.
    pub(super) const fn missing(&self, net: &Net<'_>, code: &Code<'_, W>) -> Missing {
        let mut missing = Missing { pairs: 0, lines: Text::new(), place: None };
        let mut event = 0;
        while event < net.events.len() {
            let mut used = [0; W];
            let mut class = 0;
            while class < self.count {
                if self.answers(class, event) {
                    used = either(used, self.markings[class]);
                }
                class += 1;
            }
            let mut ignored = [0; W];
            let mut at = 0;
            while at < net.ignored.len() {
                if net.ignored[at].event.0 as usize == event {
                    ignored = either(ignored, field(code, net.ignored[at].place));
                }
                at += 1;
            }
            let (mut listed, mut nowhere) = (false, false);
            class = 0;
            while class < self.count {
                let marking = &self.markings[class];
                if self.rests(class) && !self.answers(class, event) && !meet(marking, &ignored) {
                    let name = net.events[event].name;
                    let place = first_marked(net, code, marking, &used);
                    if missing.pairs == 0 {
                        missing.place = place;
                    }
                    if let Some(place) = place {
                        let lines = missing.lines;
                        missing.lines = if listed {
                            lines.with(" & ")
                        } else {
                            lines.with("\n      ").with(name).with(" in ")
                        };
                        missing.lines = missing.lines.with(net.places[place.0 as usize].name);
                        missing.pairs += 1;
                        listed = true;
                        ignored = either(ignored, field(code, place));
                    } else {
                        missing.pairs += !nowhere as usize;
                        nowhere = true;
                    }
                }
                class += 1;
            }
            if listed {
                missing.lines = missing.lines.with(";");
            }
            if nowhere {
                let lines = missing.lines.with("\n      // no place is marked: a transition on ");
                missing.lines = lines.with(net.events[event].name);
            }
            event += 1;
        }
        missing
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
