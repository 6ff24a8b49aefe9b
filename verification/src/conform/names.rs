//! The names in a model, and whether it has all that is recorded.

use super::departure::Refused;
use super::read::{Recording, What};
use crate::play::Numbered;
use cotama_core::net::{EventId, TransitionId};
use std::collections::{BTreeMap, HashMap};

/// An output by its number among [`Names::outputs`].
pub(super) type OutputNumber = u32;

/// An output of a net.
struct Output {
    number: OutputNumber,
    /// Whether another net hears it.
    heard: bool,
}

/// The names in a model.
pub(super) struct Names {
    events: HashMap<String, EventId>,
    /// By name; a name that none has is looked up among lines.
    transitions: HashMap<String, Vec<TransitionId>>,
    lines: HashMap<String, Vec<TransitionId>>,
    outputs: BTreeMap<String, Output>,
    /// Outputs of each transition.
    says: Vec<Vec<OutputNumber>>,
}

impl Names {
    pub(super) fn of(numbered: &Numbered, shared_names: &[(TransitionId, String)]) -> Self {
        let whole = numbered.whole();
        let mut it = Self {
            events: HashMap::new(),
            transitions: HashMap::new(),
            lines: HashMap::new(),
            outputs: BTreeMap::new(),
            says: Vec::new(),
        };
        // The first of several events of one name, which a file can have, is meant.
        let events = whole.events.iter().take(numbered.told_events());
        for (event, id) in events.zip((0..).map(EventId)) {
            it.events.entry(event.name.clone()).or_insert(id);
        }
        let named = whole.transitions.iter().zip(numbered.line_names());
        for ((transition, line), id) in named.zip((0..).map(TransitionId)) {
            it.transitions.entry(transition.name.clone()).or_default().push(id);
            if let Some(line) = line {
                it.lines.entry(line.to_owned()).or_default().push(id);
            }
            let said = numbered.says(id).into_iter().map(|(name, heard)| {
                let number = it.outputs.len() as OutputNumber;
                it.outputs.entry(name).or_insert(Output { number, heard }).number
            });
            let said = said.collect();
            it.says.push(said);
        }
        for (id, name) in shared_names.iter().filter(|_| !numbered.is_system()) {
            it.transitions.entry(name.clone()).or_default().push(*id);
        }
        for output in &whole.outputs {
            let number = it.outputs.len() as OutputNumber;
            it.outputs.entry(output.name.clone()).or_insert(Output { number, heard: false });
        }
        it
    }

    pub(super) fn event(&self, name: &str) -> EventId {
        self.events.get(name).copied().unwrap_or(EventId(u32::MAX))
    }

    /// The transitions that can be meant by a name: those that are called so, or else those of the
    /// line that is called so.
    pub(super) fn transitions(&self, name: &str) -> &[TransitionId] {
        self.transitions.get(name).or_else(|| self.lines.get(name)).map_or(&[], Vec::as_slice)
    }

    pub(super) fn output(&self, name: &str) -> Option<OutputNumber> {
        self.outputs.get(name).map(|it| it.number)
    }

    /// Whether some transition says an output.
    pub(super) fn is_said(&self, output: Option<OutputNumber>) -> bool {
        output.is_some_and(|it| self.says.iter().any(|said| said.contains(&it)))
    }

    /// The name of an output.
    pub(super) fn said(&self, number: OutputNumber) -> &str {
        self.outputs.iter().find(|it| it.1.number == number).map_or("?", |it| it.0)
    }

    /// Returns the recorded outputs of each transition: none where no output is recorded, and what
    /// other nets hear only where one such output is.
    pub(super) fn recorded_outputs(&self, recording: &Recording) -> Vec<Vec<OutputNumber>> {
        let (mut any, mut any_heard) = (false, false);
        for line in &recording.lines {
            if let What::Output(name) = &line.what {
                any = true;
                any_heard |= self.outputs.get(name).is_some_and(|it| it.heard);
            }
        }
        let heard: Vec<_> =
            self.outputs.values().filter(|it| it.heard).map(|it| it.number).collect();
        let kept = |it: &&OutputNumber| any && (any_heard || !heard.contains(it));
        self.says.iter().map(|said| said.iter().filter(kept).copied().collect()).collect()
    }

    /// Whether the model has all that is recorded.
    pub(super) fn all_known(&self, recording: &Recording) -> Result<(), Refused> {
        for line in &recording.lines {
            let (kind, name, is_known) = match &line.what {
                What::Event { name, .. } => ("event", name, self.events.contains_key(name)),
                What::Fired(name) => ("transition", name, !self.transitions(name).is_empty()),
                What::Output(name) => ("output", name, self.outputs.contains_key(name)),
                What::Round | What::End => continue,
            };
            if !is_known {
                return Err(Refused::Name {
                    at: Some((line.number, line.column)),
                    kind,
                    name: name.clone(),
                    known: self.known(kind),
                });
            }
        }
        Ok(())
    }

    /// All names of a kind, in the order of the model.
    fn known(&self, kind: &str) -> Vec<String> {
        let mut known: Vec<_> = match kind {
            "event" => self.events.iter().map(|it| (it.1.0, it.0)).collect(),
            "output" => self.outputs.iter().map(|it| (it.1.number, it.0)).collect(),
            _ => {
                let first = |it: &[TransitionId]| it.first().map_or(u32::MAX, |id| id.0);
                self.transitions.iter().map(|it| (first(it.1), it.0)).collect()
            }
        };
        known.sort_unstable();
        known.into_iter().map(|it| it.1.clone()).collect()
    }
}
