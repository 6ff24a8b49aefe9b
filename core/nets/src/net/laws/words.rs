//! The words for a violation: the text of a compile error.

use super::graph::{Graph, Limit, MARKINGS};
use super::judge::{Culprit, Violation};
use super::moves::FIRINGS;
use super::zone::CLOCKS;
use crate::net::data::{Law, Net, PlaceId, Role, TransitionId};
use crate::net::text::Text;
use crate::player::code::Code;

impl<const W: usize> Violation<'_, W> {
    /// Says it in the words of a compile error; of the net that was judged, packed.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        to: &mut impl core::fmt::Write,
    ) -> core::fmt::Result {
        to.write_str(self.text(net, code).as_str())
    }

    /// Returns the violation in words.
    pub(crate) const fn text(&self, net: &Net<'_>, code: &Code<'_, W>) -> Text {
        match self.culprit {
            Culprit::TooLarge(limit) => self.too_large_text(net, limit),
            Culprit::Bound { place, tokens, transition, grows } => {
                self.bound(net, place, tokens, transition, grows)
            }
            Culprit::Forever { repeats } => self.forever(net, repeats),
            Culprit::Sum(total) => {
                self.place(net, code, self.fails(net).with("the sum is ").number(total))
            }
            Culprit::Both => self.place(net, code, self.fails(net).with("both are marked")),
            Culprit::Never { markings } => self.never(net, code, markings),
            Culprit::Stuck { closed } => self.stuck_text(net, code, closed),
            Culprit::Unanswered { event, closed } => {
                self.unanswered_text(net, code, net.events[event.0 as usize].name, closed)
            }
            Culprit::Together { first, second } => self.together_text(net, code, first, second),
        }
    }

    /// Begins the text.
    const fn of(net: &Net<'_>) -> Text {
        Text::new().with("net ").name(net.name)
    }

    /// Says which law does not hold.
    const fn fails(&self, net: &Net<'_>) -> Text {
        let text = Self::of(net).with(": law `");
        let text = match self.law {
            Some(law) => law_text(net, text, law),
            None => text.with("settles"),
        };
        text.with("` does not hold: ")
    }

    const fn too_large_text(&self, net: &Net<'_>, limit: Limit) -> Text {
        let text = match self.law {
            Some(law) => law_text(net, Self::of(net).with(": law `"), law)
                .with("` depends on the clocks so much that the net has more than "),
            None => Self::of(net).with(" has more than "),
        };
        let text = match limit {
            Limit::Parts => text.number(FIRINGS as u64).with(" transitions and places"),
            Limit::Classes => {
                let text = text.number(MARKINGS as u64).with(" markings");
                if is_timed(net) { text.with(", told apart by their clocks") } else { text }
            }
            Limit::Moves => text.number(FIRINGS as u64).with(" firings between its markings"),
            Limit::Clocks => text
                .number(CLOCKS as u64)
                .with(" transitions with an interval that are enabled together"),
            Limit::Numbers => text.with("a few thousand differences of clocks"),
        };
        text.with(", too many to explore while compiling: say `left_to_checker;` in its laws, ")
            .with("and check it with the model checker")
    }

    const fn bound(
        &self,
        net: &Net<'_>,
        place: PlaceId,
        tokens: u64,
        transition: TransitionId,
        grows: bool,
    ) -> Text {
        let place = &net.places[place.0 as usize];
        let text = Self::of(net)
            .with(": place ")
            .name(place.name)
            .with(" gets ")
            .number(tokens)
            .with(" tokens, and is declared for ")
            .number(place.bound as u64)
            .with("\n  after: ");
        let last = self.way.steps().len() - 1;
        let text = self.way.tell(net, text, 0, last);
        let text = if last > 0 { text.with(", then ") } else { text };
        let text = self.way.tell(net, text, last, last + 1);
        let text = if grows {
            text.with("\n  this can be repeated without end, so no bound is large enough: let ")
        } else {
            text.with("\n  declare a larger bound, as `")
                .with(place.name)
                .with(": ")
                .digits(place.initial as u64)
                .with(" of ")
                .digits(tokens)
                .with("`, or let ")
        };
        text.name(net.transitions[transition.0 as usize].name)
            .with(" wait for room, by taking a token from a place that stands for it")
    }

    const fn forever(&self, net: &Net<'_>, repeats: usize) -> Text {
        let steps = self.way.steps().len();
        let (mut timed, mut at) = (false, steps - repeats);
        while at < steps {
            if let super::Step::Fires(id) = self.way.steps()[at] {
                timed = timed || net.transitions[id.0 as usize].within.is_some();
            }
            at += 1;
        }
        let text = Self::of(net).with(": law `settles` does not hold: transitions without event ");
        let text = text.with(if timed {
            "fire for ever without time passing"
        } else {
            "and interval fire for ever"
        });
        let text = self.after(net, text.with("\n  "), steps - repeats).with("\n  for ever: ");
        let text = self.way.tell(net, text, steps - repeats, steps);
        text.with(if timed {
            "\n  give one of them an event or let its interval begin later"
        } else {
            "\n  give one of them an event or an interval"
        })
    }

    const fn never(&self, net: &Net<'_>, code: &Code<'_, W>, markings: usize) -> Text {
        let Some(Law::Reachable(place) | Law::AlwaysCan(place)) = self.law else {
            return self.fails(net);
        };
        let name = net.places[place.0 as usize].name;
        let text = self.fails(net).with("no firing sequence puts a token into ").name(name);
        match self.law {
            Some(Law::AlwaysCan(_)) => self.place(net, code, text),
            _ => text.with(" (markings explored: ").number(markings as u64).with(")"),
        }
    }

    const fn stuck_text(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        closed: Option<TransitionId>,
    ) -> Text {
        let text = self.fails(net);
        let text = match closed {
            Some(id) => text
                .with("no transition fires any more, the interval of ")
                .name(net.transitions[id.0 as usize].name)
                .with(" is over"),
            None => text.with("no transition is enabled"),
        };
        let text = self.place(net, code, text);
        match (self.law, self.first_marked(net, code)) {
            (Some(Law::DeadlockFree { end: None }), Some(place)) => text
                .with("\n  if it is meant to end there, say `deadlock_free_except(")
                .with(place)
                .with(")`"),
            _ => text,
        }
    }

    const fn unanswered_text(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        event: &str,
        closed: Option<TransitionId>,
    ) -> Text {
        let text = self
            .fails(net)
            .with("event ")
            .name(event)
            .with(" is neither used nor ignored on purpose");
        let text = match closed {
            Some(id) => text
                .with(", and the interval of ")
                .name(net.transitions[id.0 as usize].name)
                .with(" is not open"),
            None => text,
        };
        let text = self.place(net, code, text);
        // Explored once more: this is only done to stop the compilation.
        let missing = Graph::of(net, code).missing(net, code);
        if missing.pairs > 1 {
            let text = text
                .with("\n  one of ")
                .number(missing.pairs as u64)
                .with(" missing pairs of event and place: add transitions, or paste ");
            let lines = missing.lines.as_str();
            return if net.ignored.is_empty() {
                text.with("this:\n  ignore {").with(lines).with("\n  }")
            } else {
                text.with("into its `ignore`:").with(lines)
            };
        }
        let text = text.with("\n  add a transition on it");
        match missing.first {
            Some(pair) => {
                let text = text.with(", or `ignore { ").with(event).with(" in ");
                pair.add(net, text).with("; }`")
            }
            None => text,
        }
    }

    const fn together_text(
        &self,
        net: &Net<'_>,
        code: &Code<'_, W>,
        first: TransitionId,
        second: TransitionId,
    ) -> Text {
        let transition = &net.transitions[first.0 as usize];
        let (a, b) = if first.0 < second.0 { (first, second) } else { (second, first) };
        let text = self
            .fails(net)
            .name(net.transitions[a.0 as usize].name)
            .with(" and ")
            .name(net.transitions[b.0 as usize].name);
        let text = match (transition.on, transition.within) {
            (Some(event), _) => {
                text.with(" are enabled together, both on ").name(net.events[event.0 as usize].name)
            }
            (None, Some(_)) => text.with(" are due at the same instant"),
            (None, None) => text.with(" are enabled together, both without event and interval"),
        };
        self.place(net, code, text)
            .with("\n  tell them apart by their guards or the places they need")
    }

    /// Adds where it is so: the path there, and what is marked.
    const fn place(&self, net: &Net<'_>, code: &Code<'_, W>, text: Text) -> Text {
        let text = self.after(net, text.with("\n  "), self.way.steps().len());
        marked(net, code, text.with("\n  "), &self.marking)
    }

    /// Adds the first so many steps of the path.
    const fn after(&self, net: &Net<'_>, text: Text, steps: usize) -> Text {
        if steps == 0 {
            return text.with("at the start");
        }
        self.way.tell(net, text.with("after: "), 0, steps)
    }

    /// The first marked place that `net!` has a name for.
    const fn first_marked<'n>(&self, net: &Net<'n>, code: &Code<'_, W>) -> Option<&'n str> {
        let mut at = 0;
        while at < net.places.len() {
            let named = !matches!(net.places[at].role, Role::Complement(_));
            if named && code.fields[at].of(&self.marking) > 0 {
                return Some(net.places[at].name);
            }
            at += 1;
        }
        None
    }
}

const fn is_timed(net: &Net<'_>) -> bool {
    let mut at = 0;
    while at < net.transitions.len() {
        if net.transitions[at].within.is_some() {
            return true;
        }
        at += 1;
    }
    false
}

/// Adds a law as `net!` writes it.
const fn law_text(net: &Net<'_>, text: Text, law: Law<'_>) -> Text {
    match law {
        Law::Invariant { sum, equals } => {
            let mut text = text.with("invariant(");
            let mut at = 0;
            while at < sum.len() {
                text = if at > 0 { text.with(" & ") } else { text };
                text = text.with(net.places[sum[at].place.0 as usize].name);
                text = if sum[at].weight > 1 {
                    text.with(" * ").number(sum[at].weight as u64)
                } else {
                    text
                };
                at += 1;
            }
            text.with(" = ").number(equals as u64).with(")")
        }
        Law::NeverBoth(a, b) => text
            .with("never_both(")
            .with(net.places[a.0 as usize].name)
            .with(", ")
            .with(net.places[b.0 as usize].name)
            .with(")"),
        Law::Reachable(place) => {
            text.with("reachable(").with(net.places[place.0 as usize].name).with(")")
        }
        Law::AlwaysCan(place) => {
            text.with("always_can(").with(net.places[place.0 as usize].name).with(")")
        }
        Law::HandlesAll => text.with("handles(all)"),
        Law::Settles => text.with("settles"),
        Law::DeadlockFree { end: None } => text.with("deadlock_free"),
        Law::DeadlockFree { end: Some(end) } => {
            text.with("deadlock_free_except(").with(net.places[end.0 as usize].name).with(")")
        }
        Law::Deterministic => text.with("deterministic"),
    }
}

/// Adds the marked places to a text, as "marked: `a`, 2 `b`; false or 0: `c`".
const fn marked<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    text: Text,
    marking: &[u64; W],
) -> Text {
    let mut text = text.with("marked: ");
    let mut first = true;
    let mut at = 0;
    while at < net.places.len() {
        let tokens = code.fields[at].of(marking);
        if tokens > 0 && !matches!(net.places[at].role, Role::Complement(_)) {
            text = if first { text } else { text.with(", ") };
            text = if tokens == 1 { text } else { text.number(tokens as u64).with(" ") };
            text = text.name(net.places[at].name);
            first = false;
        }
        at += 1;
    }
    let mut text = if first { text.with("nothing") } else { text };
    let mut first = true;
    let mut at = 0;
    while at < net.places.len() {
        if code.fields[at].of(marking) == 0
            && matches!(net.places[at].role, Role::Data | Role::Shared)
        {
            text = text.with(if first { "; false or 0: " } else { ", " }).name(net.places[at].name);
            first = false;
        }
        at += 1;
    }
    text
}
