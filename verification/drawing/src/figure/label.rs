//! The label of a transition.

use cotama_core::net::{Net, Transition};
use std::fmt;

/// The label of a transition: `event [guard] / actions  timing`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Label<'n> {
    /// The transitions that it stands for.
    pub(crate) transitions: Vec<u32>,
    /// The places in which the transitions differ: `from a or b`.
    pub(crate) places: Vec<String>,
    /// The event that it needs.
    pub(crate) event: Option<&'n str>,
    /// The conditions, all of which must hold.
    pub(crate) guard: Vec<String>,
    /// The outputs emitted and the changes of data.
    pub(crate) actions: Vec<String>,
    /// The interval and the priority, as far as they are set.
    pub(crate) timing: Vec<String>,
}

impl<'n> Label<'n> {
    /// All but guard and changes of data.
    pub(super) fn of(net: &Net<'n>, transition: &Transition<'n>) -> Self {
        let interval = transition.within.map(|within| match within.latest {
            None => format!("{}.. ms", within.earliest),
            Some(latest) if latest == within.earliest => format!("{latest} ms"),
            Some(latest) => format!("{}..{latest} ms", within.earliest),
        });
        let priority =
            (transition.priority != 0).then(|| format!("priority {}", transition.priority));
        let output = |id: &cotama_core::net::OutputId| {
            net.outputs.get(id.0 as usize).map(|it| it.name.to_owned())
        };
        Self {
            transitions: Vec::new(),
            places: Vec::new(),
            event: transition
                .on
                .and_then(|event| net.events.get(event.0 as usize))
                .map(|it| it.name),
            guard: Vec::new(),
            actions: transition.emits.iter().filter_map(output).collect(),
            timing: interval.into_iter().chain(priority).collect(),
        }
    }

    /// Whether it says the same, of whichever transitions.
    pub(super) fn says_the_same(&self, other: &Self) -> bool {
        let Self { transitions: _, places, event, guard, actions, timing } = self;
        (places, event, guard, actions, timing)
            == (&other.places, &other.event, &other.guard, &other.actions, &other.timing)
    }

    /// `from a or b`, `event`, `[guard]`, `/ actions`, those that are there; and the timing.
    fn parts(&self) -> (Vec<String>, String) {
        let guard = (!self.guard.is_empty()).then(|| format!("[{}]", self.guard.join(" & ")));
        let actions = (!self.actions.is_empty()).then(|| format!("/ {}", self.actions.join(", ")));
        let places = self.places.iter().cloned();
        let event = self.event.map(str::to_owned);
        let text = places.chain(event).chain(guard).chain(actions).collect();
        (text, self.timing.join(", "))
    }
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (text, timing) = self.parts();
        f.write_str(&text.join(" "))?;
        f.write_str(if text.is_empty() || timing.is_empty() { "" } else { "  " })?;
        f.write_str(&timing)
    }
}
