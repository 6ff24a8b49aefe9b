//! Configurations that a robot comes to run, whatever fails and whatever the operator does.

use super::{Decision, Mode, Robot, Situation, Where, ask_first, decide, members};
use std::collections::BTreeSet;

/// Returns the configurations that run in some situation, a bit each: passes through all places of
/// the robot and all sets of losses that a run can come to, reactions taken at once.
pub(super) fn configurations(robot: &Robot) -> u32 {
    let start = Situation { at: Where::Rests, lost: 0 };
    let mut found = BTreeSet::from([key(start)]);
    let mut waiting = vec![start];
    let mut reached = 0;
    while let Some(it) = waiting.pop() {
        if let Where::Runs { configuration, .. } = it.at {
            reached |= 1 << configuration;
        }
        let reports = robot.losses.reports.iter().enumerate();
        let failed = reports.flat_map(|(report, of)| {
            let asks = of.asks.map(|_| ask_first(robot, report, it));
            let decided = [Some(decide(robot, report, it)), asks];
            decided.into_iter().flatten().filter_map(move |to| after(robot, report, it, to))
        });
        let next = failed.chain(moves(robot, it)).filter(|it| found.insert(key(*it)));
        waiting.extend(next.collect::<Vec<_>>());
    }
    reached
}

/// A situation as a number that no other has.
fn key(it: Situation) -> (usize, u32) {
    let at = match it.at {
        Where::Rests => 0,
        Where::Waits => 1,
        Where::Runs { configuration, .. } => 2 + configuration,
    };
    (at, it.lost)
}

/// The situation after the decision on a report; `None` where the mission ends.
fn after(robot: &Robot, report: usize, it: Situation, decided: Decision) -> Option<Situation> {
    let loss = robot.losses.reports.get(report).and_then(|it| it.loss);
    let lost = it.lost | loss.map_or(0, |it| 1 << it);
    let at = match (decided, it.at) {
        (Decision::Stop, _) => return None,
        (Decision::Ask, _) => Where::Waits,
        (Decision::Adapt, Where::Runs { sub_objective, configuration }) => {
            let configuration = robot.next(configuration, lost)?;
            Where::Runs { sub_objective, configuration }
        }
        (Decision::Record | Decision::Adapt, at) => at,
    };
    Some(Situation { at, lost })
}

/// The situations that progress and the operator lead to.
fn moves(robot: &Robot, it: Situation) -> Vec<Situation> {
    let lost = it.lost;
    let here = |at| Situation { at, lost };
    let of = |mode| {
        let all = robot.sub_objectives.iter().enumerate();
        all.filter(move |it| it.1.mode == mode).map(|it| it.0)
    };
    let runs = |sub_objective| {
        let best = robot.best(sub_objective, lost);
        best.map(|configuration| here(Where::Runs { sub_objective, configuration }))
    };
    let enter = |sub_objective: Option<usize>| {
        let waits = || robot.can_ask(lost).then(|| here(Where::Waits));
        sub_objective.and_then(|it| runs(it).or_else(waits))
    };
    let chosen = || {
        let reached = robot.reaches_operator(lost);
        of(Mode::Operator).filter(move |_| reached).filter_map(runs)
    };
    let first = of(Mode::Autonomous).next();
    let returns = members(u64::from(lost & robot.losses.returning()));
    let returns = returns.map(|loss| Situation { lost: lost & !(1 << loss), ..it });
    let goes: Vec<_> = match it.at {
        Where::Rests => enter(first).into_iter().collect(),
        Where::Waits => chosen().collect(),
        Where::Runs { sub_objective, .. } => match robot.sub_objectives.get(sub_objective) {
            Some(is) if is.mode == Mode::Operator => {
                let done = if is.moves { Some(here(Where::Rests)) } else { enter(first) };
                chosen().chain(done).collect()
            }
            _ => {
                let next = of(Mode::Autonomous).find(|it| *it > sub_objective);
                let done = match next {
                    Some(next) => enter(Some(next)),
                    None => Some(here(Where::Rests)),
                };
                done.into_iter().collect()
            }
        },
    };
    goes.into_iter().chain(returns).collect()
}
