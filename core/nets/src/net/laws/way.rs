//! The path to a class: what happened, and how long it was waited for.

use super::graph::{Graph, MARKINGS, NONE};
use super::moves::{TIME, id, shared};
use super::timed::left;
use super::zone::{CLOCKS, Zone};
use crate::net::data::{Net, PlaceId, TransitionId};
use crate::net::text::Text;
use crate::player::code::Code;

/// The most steps of a path: at most one wait for each move.
const STEPS: usize = 2 * MARKINGS;

/// A step of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A transition fires: its event is offered, or it fires by itself.
    Fires(TransitionId),
    /// Another net adds a token to a shared place.
    Raised(PlaceId),
    /// Another net takes a token from a shared place.
    Lowered(PlaceId),
    /// So many milliseconds pass. What is due in them fires by itself and is told as the next step.
    Passes(u64),
}

/// A path: the steps from the start on.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    steps: [Step; STEPS],
    count: usize,
}

impl Way {
    pub(super) const NONE: Self = Self { steps: [Step::Passes(0); STEPS], count: 0 };

    /// The steps.
    pub const fn steps(&self) -> &[Step] {
        self.steps.split_at(self.count).0
    }

    pub(super) const fn add(&mut self, step: Step) {
        if self.count < STEPS {
            self.steps[self.count] = step;
            self.count += 1;
        }
    }

    /// Adds the steps from one on to a text, as "a, b on Event, 5 ms pass".
    pub(super) const fn tell(&self, net: &Net<'_>, mut text: Text, from: usize, to: usize) -> Text {
        let total = to - from;
        let mut at = from;
        // A very long path is told by its beginning and its end.
        while at < to {
            if total > 24 && at - from == 12 {
                text = text.with("... (").number((total - 24) as u64).with(" more), ");
                at = to - 12;
            }
            text = said(net, text, self.steps[at]);
            at += 1;
            if at < to {
                text = text.with(", ");
            }
        }
        text
    }
}

/// Adds what a step is called to a text.
const fn said(net: &Net<'_>, text: Text, step: Step) -> Text {
    match step {
        Step::Fires(id) => {
            let transition = &net.transitions[id.0 as usize];
            match transition.on {
                Some(event) => {
                    text.with(transition.name).with(" on ").with(net.events[event.0 as usize].name)
                }
                None => text.with(transition.name),
            }
        }
        Step::Raised(place) => {
            text.with("(another net raises ").with(net.places[place.0 as usize].name).with(")")
        }
        Step::Lowered(place) => {
            text.with("(another net lowers ").with(net.places[place.0 as usize].name).with(")")
        }
        Step::Passes(time) => text.number(time).with(" ms pass"),
    }
}

/// Returns the step of a move by an entry or a change of a shared place.
pub(super) const fn step<const W: usize>(net: &Net<'_>, code: &Code<'_, W>, by: u16) -> Step {
    let (by, entries) = (by as usize, code.entries.len());
    if by < entries {
        return Step::Fires(id(code, by as u16));
    }
    match shared(net, entries, by) {
        (place, _, true) => Step::Raised(place),
        (place, _, false) => Step::Lowered(place),
    }
}

/// The classes on a path, the moves between them, and when each of them happens.
struct Path {
    classes: [u16; MARKINGS],
    /// By which each class was reached.
    by: [u16; MARKINGS],
    length: usize,
    at: [i64; MARKINGS],
    changed: bool,
}

impl Path {
    /// The instant `b` is at most this later than `a`.
    const fn at_most(&mut self, a: usize, b: usize, most: i64) {
        if self.at[a] < self.at[b] - most {
            self.at[a] = self.at[b] - most;
            self.changed = true;
        }
    }

    /// At this instant of `moment`, less so much, the clocks that began at these are in this zone.
    const fn within(&mut self, zone: &Zone, since: &[usize; CLOCKS], moment: usize, less: i64) {
        let mut a = 0;
        while a < zone.count {
            if zone.until[a] >= 0 {
                self.at_most(since[a], moment, zone.bounds[a + 1][0] + less);
                self.at_most(moment, since[a], zone.bounds[0][a + 1] - less);
                let mut b = 0;
                while b < zone.count {
                    if b != a && zone.until[b] >= 0 {
                        self.at_most(since[a], since[b], zone.bounds[a + 1][b + 1]);
                    }
                    b += 1;
                }
            }
            a += 1;
        }
    }
}

impl<const W: usize> Graph<W> {
    /// The path on which a class was first reached, with the shortest waits.
    pub(super) const fn way(&self, net: &Net<'_>, code: &Code<'_, W>, to: usize) -> Way {
        let zero = [0; MARKINGS];
        let mut path =
            Path { classes: zero, by: zero, length: 0, at: [0; MARKINGS], changed: true };
        let mut class = to as u16;
        while self.parents[class as usize].0 != NONE {
            path.length += 1;
            class = self.parents[class as usize].0;
        }
        let (mut at, mut class) = (path.length, to as u16);
        loop {
            path.classes[at] = class;
            (class, path.by[at]) = self.parents[class as usize];
            if at == 0 {
                break;
            }
            at -= 1;
        }
        // Every instant is as early as what is known of the clocks allows.
        while path.changed && !code.clocks.is_empty() {
            path.changed = false;
            self.tighten(code, &mut path);
        }
        let (mut way, mut wait, mut at) = (Way::NONE, 0, 1);
        while at <= path.length {
            wait += path.at[at] - path.at[at - 1];
            if path.by[at] != TIME {
                if wait > 0 {
                    way.add(Step::Passes(wait.cast_unsigned()));
                    wait = 0;
                }
                way.add(step(net, code, path.by[at]));
            }
            at += 1;
        }
        if wait > 0 {
            way.add(Step::Passes(wait.cast_unsigned()));
        }
        way
    }

    /// Delays instants on a path as far as their differences demand.
    const fn tighten(&self, code: &Code<'_, W>, path: &mut Path) {
        let mut since = [0; CLOCKS];
        let mut zone = self.zone(path.classes[0] as usize);
        let mut at = 1;
        while at <= path.length {
            let (from, to) = (path.classes[at - 1] as usize, path.classes[at] as usize);
            let next = self.zone(to);
            let by = path.by[at];
            let passes = (by == TIME) as i64;
            path.at_most(at, at - 1, 0);
            if !self.rests(from) {
                path.at_most(at - 1, at, 0);
            }
            path.within(&zone, &since, at, passes);
            // Since when the clocks of the next class run.
            let mut new = [at; CLOCKS];
            let (mut clock, mut old) = (0, 0);
            while clock < next.count {
                while old < zone.count && zone.clocks[old] < next.clocks[clock] {
                    old += 1;
                }
                if old < zone.count && zone.clocks[old] == next.clocks[clock] {
                    let id = zone.clocks[old];
                    if by == TIME {
                        new[clock] = since[old];
                        if zone.until[old] != next.until[clock] {
                            path.at_most(since[old], at, zone.until[old] + 1);
                            path.at_most(at, since[old], -zone.until[old] - 1);
                        }
                    } else if self.keeps(code, from, to, by, id) {
                        new[clock] = since[old];
                    }
                }
                clock += 1;
            }
            (since, zone) = (new, next);
            at += 1;
        }
        path.within(&zone, &since, path.length, 0);
    }

    /// Whether a clock runs on over this move.
    const fn keeps(&self, code: &Code<'_, W>, from: usize, to: usize, by: u16, clock: u16) -> bool {
        let left = left(code, &self.markings[from], &self.markings[to], by);
        let own = (by as usize) < code.entries.len() && code.entries[by as usize].clock == clock;
        !own && code.holds(&left, &code.clocks[clock as usize].need)
    }

    /// Whether a marking that is covered by this one, and has less in one place, led to it; then
    /// the same way can be gone again and again.
    pub(super) const fn grows(&self, last: usize, marking: &[u64; W], code: &Code<'_, W>) -> bool {
        let mut at = last;
        loop {
            let (mut place, mut equal) = (0, true);
            while place < code.fields.len() {
                let (now, then) =
                    (held(code, marking, place), held(code, &self.markings[at], place));
                if now < then {
                    break;
                }
                equal = equal && now == then;
                place += 1;
            }
            if place == code.fields.len() && !equal {
                return true;
            }
            if self.parents[at].0 == NONE {
                return false;
            }
            at = self.parents[at].0 as usize;
        }
    }
}

/// Returns the tokens in a field, beyond its bound if need be: its guard bit counts.
pub(super) const fn held<const W: usize>(
    code: &Code<'_, W>,
    marking: &[u64; W],
    place: usize,
) -> u64 {
    let field = code.fields[place];
    (marking[field.word as usize] >> field.shift) & ((2 << field.width) - 1)
}
