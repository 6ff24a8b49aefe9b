//! The actions of the supervisors in a run, from its trace.

use crate::answers::supervised::{Configured, Failure, Fired, Point, Supervised, Told};
use cotama_sim::story::{self, Chain, What, points};
use cotama_sim::trace::{Record, Trace};

/// The answer for a trace; none if its run was not supervised.
pub(super) fn supervised(trace: &Trace) -> Option<Supervised> {
    let story = points(&trace.records);
    if story.is_empty() {
        return None;
    }
    let mut answer = Supervised {
        failures: failures(&story),
        points: story.iter().map(point).collect(),
        fired: Vec::new(),
        configurations: Vec::new(),
        told: Vec::new(),
    };
    for record in &trace.records {
        match record {
            Record::Fired(it) => answer.fired.push(Fired {
                t_ms: it.t_us / 1000,
                net: it.net.clone(),
                transition: it.transition.clone(),
                place: it.place.clone(),
                cause: it.cause,
            }),
            Record::Configuration(it) => answer.configurations.push(Configured {
                t_ms: it.t_us / 1000,
                configuration: it.configuration.clone(),
                mode: it.mode.name(),
            }),
            Record::Told(it) => answer.told.push(Told { round: it.round, event: it.event.clone() }),
            _ => {}
        }
    }
    Some(answer)
}

fn point(it: &story::Point<'_>) -> Point {
    Point {
        number: it.number,
        t_ms: it.t_us / 1000,
        x_mm: it.x_mm,
        text: it.title(),
        found: it.found(),
        decided: it.decided(),
        done: it.done(),
        ladder: it.rungs().into_iter().map(story::Rung::name).collect(),
    }
}

/// In the order of their numbers.
fn failures(story: &[story::Point<'_>]) -> Vec<Failure> {
    let mut chains: Vec<&Chain<'_>> = story
        .iter()
        .filter_map(|it| match &it.what {
            What::Failure(chain) => Some(&**chain),
            _ => None,
        })
        .collect();
    chains.sort_by_key(|it| it.failure.failure);
    chains.into_iter().map(failure).collect()
}

fn failure(chain: &Chain<'_>) -> Failure {
    let (diagnosis, decision) = (chain.diagnosis, chain.decision);
    let kind = |candidates: usize| match candidates {
        0 => "unexplained",
        1 => "unique",
        _ => "ambiguous",
    };
    Failure {
        mode: chain.failure.mode.clone(),
        t_ms: chain.failure.t_us / 1000,
        x_mm: chain.failure.x_mm,
        during: chain.failure.during.clone(),
        detected_ms: diagnosis.map(|it| it.t_us / 1000),
        flags: diagnosis.map_or_else(Vec::new, |it| it.flags.clone()),
        diagnosis: diagnosis.map(|it| kind(it.candidates.len())),
        candidates: diagnosis.map_or_else(Vec::new, |it| it.candidates.clone()),
        report: diagnosis.and_then(|it| it.report.clone()),
        severity: diagnosis.map(|it| it.severity.name()),
        by_severity: diagnosis.map(|it| it.by_severity.name()),
        by_availability: diagnosis.map(|it| it.by_availability.name()),
        decided_ms: decision.map(|it| it.t_us / 1000),
        decision: decision.map(|it| it.decision.name()),
        event: decision.and_then(|it| it.event.clone()),
        transition: decision.and_then(|it| it.transition.clone()),
        answered_ms: chain.reaction.first().map(|it| it.t_us / 1000),
        exposed_ms: chain.exposed_ms,
    }
}
