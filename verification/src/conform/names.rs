//! The names in a model, and whether it has all that is recorded.

use super::departure::Refused;
use super::read::{Recording, What};
use crate::play::Numbered;
use cotama_core::net::{EventId, TransitionId};
use std::collections::HashMap;

/// The names in a model.
pub(super) struct Names<'s> {
    events: HashMap<&'s str, EventId>,
    transitions: HashMap<&'s str, TransitionId>,
}

impl<'s> Names<'s> {
    pub(super) fn of(numbered: &'s Numbered) -> Self {
        let whole = numbered.whole();
        let events = whole.events.iter().take(numbered.told_events());
        // Of several of one name, which a file can have, the first is meant.
        let mut it = Self { events: HashMap::new(), transitions: HashMap::new() };
        for (event, id) in events.zip((0..).map(EventId)) {
            it.events.entry(&event.name).or_insert(id);
        }
        for (transition, id) in whole.transitions.iter().zip((0..).map(TransitionId)) {
            it.transitions.entry(&transition.name).or_insert(id);
        }
        it
    }

    pub(super) fn event(&self, name: &str) -> EventId {
        self.events.get(name).copied().unwrap_or(EventId(u32::MAX))
    }

    pub(super) fn transition(&self, name: &str) -> TransitionId {
        self.transitions.get(name).copied().unwrap_or(TransitionId(0))
    }

    /// Whether the model has all that is recorded.
    pub(super) fn all_known(&self, recording: &Recording) -> Result<(), Refused> {
        for line in &recording.lines {
            let (kind, name, is_known) = match &line.what {
                What::Event { name, .. } => ("event", name, self.events.contains_key(&**name)),
                What::Fired(name) => ("transition", name, self.transitions.contains_key(&**name)),
                What::Round | What::End => continue,
            };
            if !is_known {
                let mut known: Vec<_> = match kind {
                    "event" => self.events.iter().map(|it| (it.1.0, *it.0)).collect(),
                    _ => self.transitions.iter().map(|it| (it.1.0, *it.0)).collect(),
                };
                known.sort_unstable();
                return Err(Refused::Name {
                    at: Some((line.number, line.column)),
                    kind,
                    name: name.clone(),
                    known: known.into_iter().map(|it| it.1.to_owned()).collect(),
                });
            }
        }
        Ok(())
    }
}
