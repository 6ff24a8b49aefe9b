//! The decision of the contextual supervisor, as a function of the robot.

use super::{Mode, Robot, Where};
use crate::severity::Severity;

/// Place of the robot, and its losses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Situation {
    /// Place of the robot.
    pub at: Where,
    /// The losses that are known, a bit each; with or without that of the report.
    pub lost: u32,
}

/// The answer to a report; the order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Decision {
    /// No more than a record.
    Record,
    /// The adapter of the sub-objective takes another configuration.
    Adapt,
    /// The local supervisor stops the robot and asks the operator.
    Ask,
    /// The global supervisor ends the mission.
    Stop,
}

/// The decision on a report, by its number: by severity and by what is available, the worse of both
/// (Durand et al., TAROS 2010, Sections III.A, III.C and V.B; the two rules are
/// inferred).
///
/// * Fatal ends the mission, wherever the robot is.
/// * Hard asks the operator, or ends the mission where he cannot help.
/// * Weak and medium go on with what runs, or else with another configuration of the same
///   sub-objective, or else the operator is asked, or else the mission ends.
/// * Without a drive all but fatal is recorded. Who waits for the operator has asked him already;
///   when he cannot help any more, the mission ends.
///
/// A report or a place that the robot does not have is recorded only.
pub fn decide(robot: &Robot, report: usize, situation: Situation) -> Decision {
    let Some(report) = robot.losses.reports.get(report) else { return Decision::Record };
    let lost = situation.lost | report.loss.map_or(0, |it| 1 << it);
    let ask = || if robot.can_ask(lost) { Decision::Ask } else { Decision::Stop };
    match situation.at {
        Where::Rests if report.autonomous == Severity::Fatal => Decision::Stop,
        Where::Waits if report.operator == Severity::Fatal => Decision::Stop,
        Where::Waits if report.loss.is_some() && !robot.can_ask(lost) => Decision::Stop,
        Where::Rests | Where::Waits => Decision::Record,
        Where::Runs { sub_objective, configuration } => {
            let mode = robot.sub_objectives.get(sub_objective).map(|it| it.mode);
            match report.severity(mode.unwrap_or(Mode::Autonomous)) {
                Severity::Fatal => Decision::Stop,
                Severity::Hard => ask(),
                Severity::Weak | Severity::Medium => {
                    let runs = robot.running(lost) >> configuration & 1 == 1;
                    if report.loss.is_none() || runs {
                        Decision::Record
                    } else if robot.next(configuration, lost).is_some() {
                        Decision::Adapt
                    } else {
                        ask()
                    }
                }
            }
        }
    }
}

/// The decision on a report that asks the operator first: he is asked where something runs and he
/// can help, whatever the severity; else it is decided as any other ([`decide`]).
pub fn ask_first(robot: &Robot, report: usize, situation: Situation) -> Decision {
    let loss = robot.losses.reports.get(report).and_then(|it| it.loss);
    let lost = situation.lost | loss.map_or(0, |it| 1 << it);
    match situation.at {
        Where::Runs { .. } if robot.can_ask(lost) => Decision::Ask,
        _ => decide(robot, report, situation),
    }
}
