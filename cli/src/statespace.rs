//! `cotama statespace`: how large a model is.

use crate::answers::check::{ExploredRow, GrowthRow, RoundsRow, StatespaceAnswer};
use crate::args::StatespaceArgs;
use crate::budget::Budget;
use crate::check::{contest, limit_in_words};
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::progress::Progress;
use crate::render;
use crate::subject::{Subject, TooLarge, Unmade};
use crate::tree;
use cotama_core::net::TransitionId;
use cotama_verification::check::Model;
use cotama_verification::coverability::{self, Bounded};
use cotama_verification::explicit;
use cotama_verification::limits::{Limit, Limits};
use cotama_verification::pt::Pt;
use cotama_verification::tpn::{self, TimeNet};
use std::time::Instant;

/// Counts what is reachable.
pub(crate) fn statespace(args: &StatespaceArgs, screen: &Screen) -> Result<Exit, Failure> {
    if tree::is(&args.model) {
        return tree::statespace(args, screen);
    }
    tree::idle(args.tree.given(), &args.model)?;
    let mut subject = match Subject::load(&args.model, args.untimed, args.semantics) {
        Ok(subject) => subject,
        Err(Unmade::Failure(failure)) => return Err(failure),
        Err(Unmade::TooLarge(it)) => return said(args, &too_large(&args.model, *it), 1, screen),
    };
    let (budget, progress, begun) = (Budget::start(args.budget), Progress::new(), Instant::now());
    let found = match &subject.model {
        Model::Plain(pt) => markings(pt, &budget, &progress),
        Model::Timed { net, untimed } => classes(net, untimed, &budget),
    };
    let graph = |pt| explicit::Graph::new(pt, &budget.limits, &|it| progress.show(it)).ok();
    let rounds =
        subject.rounds.as_ref().and_then(|rounds| Some(rounds.size(&graph(subject.model.pt())?)));
    progress.clear();
    subject.notes.extend(without_priorities(subject.model.pt(), &budget));
    let answer = StatespaceAnswer {
        semantics: subject.semantics,
        rounds: rounds
            .map(|it| RoundsRow { states: it.states.to_string(), edges: it.edges.to_string() }),
        model: subject.name,
        notes: subject.notes,
        seconds: begun.elapsed().as_secs_f64(),
        ..found
    };
    said(args, &answer, budget.jobs, screen)
}

fn said(
    args: &StatespaceArgs,
    answer: &StatespaceAnswer,
    jobs: usize,
    screen: &Screen,
) -> Result<Exit, Failure> {
    if args.json.json {
        Screen::json(&answer)?;
    } else if args.mcc {
        Screen::raw(lines(answer, jobs).as_bytes())?;
    } else {
        screen.print(&render::statespace::screen(answer, screen.width()))?;
    }
    // Unboundedness of a net is an answer.
    let is_known = answer.limit.is_none() || answer.bounded == Some(false);
    Ok(if is_known { Exit::Success } else { Exit::Unknown })
}

/// Nothing is known of a system that is too large to be one net.
fn too_large(model: &str, it: TooLarge) -> StatespaceAnswer {
    let none = "0".to_owned();
    StatespaceAnswer {
        schema: "cotama/statespace/1",
        model: model.to_owned(),
        timed: false,
        semantics: it.semantics,
        notes: Vec::new(),
        states: None,
        arcs: None,
        max_place: None,
        max_sum: None,
        deadlocks: None,
        safe: None,
        bounded: None,
        dead_transitions: None,
        dead_places: None,
        markings: None,
        classes: None,
        edges: None,
        rounds: None,
        growth: None,
        explored: ExploredRow { states: none.clone(), arcs: none },
        limit: Some(it.why),
        engine: "none",
        seconds: 0.0,
        bytes_per_state: None,
    }
}

/// How large the net is for who does not know its priorities, if that is soon counted.
fn without_priorities(pt: &Pt, budget: &Budget) -> Option<String> {
    const FEW: u64 = 100_000;
    let limits = Limits { states: budget.limits.states.min(FEW), ..budget.limits };
    let space = explicit::statespace(&pt.without_priorities()?, &limits, budget.jobs, &|_| ());
    let many = match space.limit {
        None => format!("{} states and {} arcs", space.states, space.arcs),
        Some(_) => format!("{} states or more", space.states),
    };
    Some(format!("its priorities are kept; without them there are {many}"))
}

fn names(pt: &Pt, transitions: &[TransitionId]) -> Vec<String> {
    transitions.iter().filter_map(|it| pt.transitions.get(it.0 as usize)).cloned().collect()
}

fn unmarked(pt: &Pt, most: &[u64]) -> Vec<String> {
    pt.places.iter().zip(most).filter(|it| *it.1 == 0).map(|it| it.0.clone()).collect()
}

fn markings(pt: &Pt, budget: &Budget, progress: &Progress) -> StatespaceAnswer {
    let space = explicit::statespace(pt, &budget.limits, budget.jobs, &|it| progress.show(it));
    let mut bounded = space.bounded;
    let mut growth = space
        .growth
        .as_ref()
        .map(|it| GrowthRow { first: names(pt, &it.first), repeated: names(pt, &it.repeated) });
    if bounded.is_none() {
        match coverability::bounded(pt, &budget.limits) {
            Bounded::Yes => bounded = Some(true),
            Bounded::No(found) => {
                bounded = Some(false);
                let firings =
                    |it: &coverability::Sequence| it.firings.as_deref().map(|it| names(pt, it));
                growth = firings(&found.stem)
                    .zip(firings(&found.pump))
                    .map(|(first, repeated)| GrowthRow { first, repeated });
            }
            Bounded::Unknown(_) => {}
        }
    }
    let all = space.limit.is_none();
    let count = |number: u64| all.then(|| number.to_string());
    StatespaceAnswer {
        schema: "cotama/statespace/1",
        model: String::new(),
        timed: false,
        semantics: None,
        notes: Vec::new(),
        states: count(space.states),
        arcs: count(space.arcs),
        max_place: count(space.max_place),
        max_sum: count(space.max_sum),
        deadlocks: count(space.dead_markings),
        safe: space.safe(),
        bounded,
        dead_transitions: all.then(|| names(pt, &space.dead_transitions)),
        dead_places: all.then(|| unmarked(pt, &space.bounds)),
        markings: count(space.states),
        classes: None,
        edges: None,
        rounds: None,
        growth,
        explored: ExploredRow { states: space.states.to_string(), arcs: space.arcs.to_string() },
        limit: space.limit.map(limit_in_words),
        engine: "explicit",
        seconds: 0.0,
        bytes_per_state: Some((space.bytes_per_state() * 100.0).round() / 100.0),
    }
}

fn classes(net: &TimeNet, untimed: &Pt, budget: &Budget) -> StatespaceAnswer {
    let graph = tpn::classes(net, &budget.limits);
    let all = graph.stopped().is_none();
    let count = |number: usize| all.then(|| number.to_string());
    let (mut most, mut sum) = (vec![0_u64; untimed.places.len()], 0);
    let mut fires = vec![false; untimed.transitions.len()];
    for class in 0..graph.classes() as u32 {
        let tokens = || graph.marking(class).iter().map(|&it| u64::from(it));
        most.iter_mut().zip(tokens()).for_each(|(most, it)| *most = it.max(*most));
        sum = tokens().sum::<u64>().max(sum);
        for (transition, _) in graph.successors(class) {
            fires[transition.0 as usize] = true;
        }
    }
    let place = most.iter().copied().max().unwrap_or(0);
    let dead = fires.iter().zip(0..).filter(|it| !it.0).map(|it| TransitionId(it.1));
    let dead = names(untimed, &dead.collect::<Vec<_>>());
    StatespaceAnswer {
        schema: "cotama/statespace/1",
        model: String::new(),
        timed: true,
        semantics: None,
        notes: Vec::new(),
        states: count(graph.classes()),
        arcs: count(graph.edges()),
        max_place: all.then(|| place.to_string()),
        max_sum: all.then(|| sum.to_string()),
        deadlocks: count(graph.dead_markings()),
        safe: (all || place > 1).then_some(place <= 1),
        bounded: graph.bounded(),
        dead_transitions: all.then_some(dead),
        dead_places: all.then(|| unmarked(untimed, &most)),
        markings: count(graph.markings()),
        classes: count(graph.classes()),
        edges: count(graph.edges()),
        rounds: None,
        growth: None,
        explored: ExploredRow {
            states: graph.classes().to_string(),
            arcs: graph.edges().to_string(),
        },
        limit: graph.stopped().map(|it| limit_of_classes(it).to_owned()),
        engine: "classes",
        seconds: 0.0,
        bytes_per_state: None,
    }
}

fn limit_of_classes(limit: Limit) -> &'static str {
    match limit {
        Limit::Unbounded => "the net is unbounded",
        Limit::States => "the limit of classes was reached",
        Limit::Bytes => "the limit of memory was reached",
        Limit::Time => "it was interrupted",
        Limit::Tokens | Limit::Words | Limit::Work => "a number of tokens or a time is too large",
    }
}

/// The contest's lines.
fn lines(answer: &StatespaceAnswer, jobs: usize) -> String {
    let techniques = contest::techniques(&[answer.engine], jobs).join(" ");
    let line = |what: &str, number: &Option<String>| match (number, answer.bounded) {
        (Some(number), _) => format!("STATE_SPACE {what} {number} TECHNIQUES {techniques}\n"),
        (None, Some(false)) => format!("STATE_SPACE {what} +inf TECHNIQUES {techniques}\n"),
        (None, _) => String::new(),
    };
    let said = [
        line("STATES", &answer.markings),
        line("TRANSITIONS", &answer.arcs),
        line("MAX_TOKEN_PER_MARKING", &answer.max_sum),
        line("MAX_TOKEN_IN_PLACE", &answer.max_place),
    ];
    let said = said.concat();
    if said.is_empty() { "CANNOT_COMPUTE\n".to_owned() } else { said }
}
