//! The making of a recording: which firings and outputs of a model it holds, and its rounds.

use super::names::{Names, OutputNumber};
use super::read::{Recording, What};
use crate::play::Numbered;
use cotama_core::net::TransitionId;
use cotama_core::units::Millis;

/// Whether the firings of a transition are recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    Always,
    Perhaps,
    Never,
}

/// How a recording was made, and what follows from it for a model.
pub(super) struct Rules<'s> {
    pub(super) numbered: &'s Numbered,
    pub(super) names: &'s Names,
    /// By the number of a transition.
    seen: Vec<Seen>,
    /// Recorded outputs of each transition.
    pub(super) says: Vec<Vec<OutputNumber>>,
    /// The transitions that are chosen, and cannot be put off for ever.
    pub(super) forced: Vec<TransitionId>,
    /// Chosen transitions that can fire unrecorded.
    pub(super) hidden: Vec<TransitionId>,
    pub(super) tolerance: u64,
    pub(super) round_every: Option<Millis>,
    /// Whether a round takes place as soon as something waits.
    pub(super) rounds_when_due: bool,
}

impl<'s> Rules<'s> {
    pub(super) fn new(
        numbered: &'s Numbered,
        names: &'s Names,
        seen: Vec<Seen>,
        recording: &Recording,
        tolerance: Millis,
    ) -> Self {
        let transitions = &numbered.whole().transitions;
        let chosen = || (0..).map(TransitionId).zip(transitions);
        let chosen = || chosen().filter(|it| numbered.choice(it.0).is_some());
        let forced = chosen().filter(|it| it.1.within.is_some_and(|it| it.latest.is_some()));
        let hidden = chosen().filter(|it| seen[it.0.0 as usize] != Seen::Always);
        let silent = |id: TransitionId| {
            recording.silent.iter().any(|it| numbered.is_system() && it == numbered.net_name(id))
        };
        let mut says = names.recorded_outputs(recording);
        for (said, id) in says.iter_mut().zip((0..).map(TransitionId)) {
            if silent(id) {
                said.clear();
            }
        }
        let says_round =
            recording.says_rounds || recording.lines.iter().any(|it| it.what == What::Round);
        Self {
            numbered,
            names,
            forced: forced.map(|it| it.0).collect(),
            hidden: hidden.map(|it| it.0).collect(),
            says,
            seen,
            tolerance: tolerance.0,
            round_every: recording.round_every,
            rounds_when_due: recording.round_every.is_none() && !says_round,
        }
    }

    pub(super) fn seen(&self, TransitionId(id): TransitionId) -> Seen {
        self.seen.get(id as usize).copied().unwrap_or(Seen::Always)
    }

    pub(super) fn says(&self, TransitionId(id): TransitionId) -> &[OutputNumber] {
        self.says.get(id as usize).map_or(&[], Vec::as_slice)
    }
}
