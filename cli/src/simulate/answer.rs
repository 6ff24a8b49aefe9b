//! The record of a session, with names.

use super::ms;
use crate::answers::model::{
    DeadlineRow, EnabledRow, RefusalReason, RefusalRow, SimulateAnswer, StepRow, TokensRow,
};
use cotama_core::net::{EventId, Net, OutputId, PlaceId, TransitionId};
use cotama_verification::play::{Reason, Record, Refusal, Session};

/// Returns the records from `from` on, and the events possible now.
pub(super) fn answer(
    session: &Session<'_, '_>,
    by_name: bool,
    complete: bool,
    from: usize,
) -> SimulateAnswer {
    let named = Named(session.net());
    let records = session.records().get(from..).unwrap_or_default();
    let steps: Vec<StepRow> = records.iter().map(|it| named.step(it)).collect();
    let mut enabled = vec![];
    let mut unused = vec![];
    for event in (0..named.0.events.len() as u32).map(EventId) {
        match session.prospect(event) {
            Ok(it) => {
                let transition = named.transition(it);
                enabled.push(EnabledRow { event: named.event(event), transition });
            }
            Err(refusal) => unused.push(named.refusal(&refusal)),
        }
    }
    let shown = session.numbered().shown_places();
    let marked = named.0.places.iter().zip(session.marking()).take(shown);
    SimulateAnswer {
        schema: "cotama/simulate/1",
        model: named.0.name.to_owned(),
        rounds: session.rounds(),
        by_name,
        complete,
        ignored: steps.iter().map(|step| step.ignored.len() as u64).sum(),
        time_ms: ms(session.now()),
        fired: steps.iter().flat_map(|step| step.fired.iter().cloned()).collect(),
        steps,
        marking: marked.map(|(place, &tokens)| (place.name.to_owned(), tokens)).collect(),
        enabled,
        unused,
        deadline: session
            .deadline()
            .map(|(at, it)| DeadlineRow { time_ms: ms(at), transition: named.transition(it) }),
    }
}

/// Names of a net.
struct Named<'n>(&'n Net<'n>);

impl Named<'_> {
    fn event(&self, EventId(id): EventId) -> String {
        self.0.events.get(id as usize).map_or_else(String::new, |it| it.name.to_owned())
    }

    fn transition(&self, TransitionId(id): TransitionId) -> String {
        self.0.transitions.get(id as usize).map_or_else(String::new, |it| it.name.to_owned())
    }

    fn refusal(&self, it: &Refusal) -> RefusalRow {
        let reason = match it.reason {
            Reason::OnPurpose => RefusalReason::OnPurpose,
            Reason::NotEnabled => RefusalReason::NotEnabled,
            Reason::TooEarly => RefusalReason::TooEarly,
            Reason::TooLate => RefusalReason::TooLate,
            Reason::Full => RefusalReason::Full,
        };
        RefusalRow { event: self.event(it.event), reason, text: it.text.clone() }
    }

    fn step(&self, it: &Record) -> StepRow {
        let output = |OutputId(id): &OutputId| self.0.outputs.get(*id as usize);
        let changed = |&(PlaceId(id), tokens): &(PlaceId, u32)| {
            let place = self.0.places.get(id as usize)?.name.to_owned();
            Some(TokensRow { place, tokens })
        };
        StepRow {
            time_ms: ms(it.at),
            events: it.events.iter().map(|&event| self.event(event)).collect(),
            round: it.round,
            fired: it.fired.iter().map(|&id| self.transition(id)).collect(),
            ignored: it.unused.iter().map(|it| self.refusal(it)).collect(),
            emitted: it.emitted.iter().filter_map(output).map(|it| it.name.to_owned()).collect(),
            changed: it.changed.iter().filter_map(changed).collect(),
        }
    }
}
