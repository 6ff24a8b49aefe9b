//! The words for a violation: the text of a compile error.

use super::states::{Culprit, STATES, Step, Violation};
use crate::net::data::{EventId, Role};
use crate::net::text::Text;
use crate::player::code::Code;
use crate::system::data::{Of, System};

impl<const W: usize> Violation<W> {
    /// Says it in the words of a compile error; of the system that was judged, packed.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(
        &self,
        system: &System<'_>,
        code: &Code<'_, W>,
        to: &mut impl core::fmt::Write,
    ) -> core::fmt::Result {
        to.write_str(self.text(system, code).as_str())
    }

    /// Returns the violation in words.
    pub(super) const fn text(&self, system: &System<'_>, code: &Code<'_, W>) -> Text {
        let text = Text::new().with("system ").name(system.name).with(": law `handles(all)` ");
        match self.culprit {
            Culprit::Unanswered(event) => {
                let text = text.with("does not hold: event `");
                let text =
                    named(system, text, event).with("` is neither used nor ignored on purpose\n  ");
                let text = marked(system, code, self.way(system, text), event, &self.marking);
                text.with("\n  add a transition on it to ")
                    .name(system.components[event.component as usize].name)
                    .with(", or ignore it in a place that is marked there")
            }
            Culprit::Forever => self.way(
                system,
                text.with("cannot be explored: transitions without event fire for ever\n  "),
            ),
            Culprit::Intervals => left(text.with("is asked of a system with intervals")),
            Culprit::TooLarge => left(
                text.with("is asked of a system with more than ")
                    .number(STATES as u64)
                    .with(" states"),
            ),
        }
    }

    /// Adds the path.
    const fn way(&self, system: &System<'_>, text: Text) -> Text {
        let total = self.steps().len();
        if total == 0 {
            return text.with("while it settles at the start");
        }
        let mut text = text.with("after: ");
        let mut at = 0;
        while at < total {
            // A very long path is told by its beginning and its end.
            if total > 24 && at == 12 {
                text = text.with("... (").number((total - 24) as u64).with(" more), ");
                at = total - 12;
            }
            text = match self.steps()[at] {
                Step::Offered(event) => named(system, text, event),
                Step::Round => text.with("a round"),
            };
            at += 1;
            if at < total {
                text = text.with(", ");
            }
        }
        text
    }
}

const fn left(text: Text) -> Text {
    text.with(", which is not explored while compiling: say `left_to_checker;` in its laws, ")
        .with("and check it with the model checker")
}

const fn named(system: &System<'_>, text: Text, event: Of<EventId>) -> Text {
    let component = &system.components[event.component as usize];
    text.with(component.name).with(".").with(component.net.events[event.id.0 as usize].name)
}

/// Adds the marked places of the net of an event.
const fn marked<const W: usize>(
    system: &System<'_>,
    code: &Code<'_, W>,
    text: Text,
    event: Of<EventId>,
    marking: &[u64; W],
) -> Text {
    let component = &system.components[event.component as usize];
    let first = code.places[event.component as usize] as usize;
    let mut text = text.with("\n  marked in ").name(component.name).with(": ");
    let mut none = true;
    let mut at = 0;
    while at < component.net.places.len() {
        let place = &component.net.places[at];
        let tokens = code.fields[first + at].of(marking);
        if tokens > 0 && !matches!(place.role, Role::Complement(_)) {
            text = if none { text } else { text.with(", ") };
            text = if tokens == 1 { text } else { text.number(tokens as u64).with(" ") };
            text = text.name(place.name);
            none = false;
        }
        at += 1;
    }
    if none { text.with("nothing") } else { text }
}
