//! The two rules behind the decision table: how severe a report is, and what is still available.

use super::report::{Decision, Report, adaptation, lost_after};
use super::situation::{Loss, Losses, Situation};
use crate::cotama::modules::{Configuration, Mode};
use crate::cotama::modules::{Module, Modules};
use crate::severity::{Class, Severity};

/// How severe a report is where the robot is: the FMECA by autonomy mode, its operator column
/// wherever the operator decides.
///
/// A collision is hard when the robot drives itself and no avoidance runs (stated); in planning
/// none runs. A unique diagnosis that localisation is lost is medium, since odometry is there in
/// its place (inferred; the FMECA's hard is for the filter whose fault is not known to be its own).
///
/// ```
/// use cotama_models::cotama::{Report, Severity, Situation, severity};
/// use cotama_models::cotama::{local, path_following, teleoperation};
/// let following = Situation {
///     local: local::State::Following,
///     following: path_following::State::Optimal,
///     ..Situation::AT_REST
/// };
/// let driven = Situation {
///     local: local::State::Teleoperated,
///     teleoperation: teleoperation::State::Full,
///     ..Situation::AT_REST
/// };
/// // The robot does not see with its camera; the operator does.
/// assert_eq!(severity(Report::Camera, following), Severity::Weak);
/// assert_eq!(severity(Report::Camera, driven), Severity::Hard);
/// ```
pub const fn severity(report: Report, situation: Situation) -> Severity {
    let autonomous = matches!(situation.mode(), Mode::Autonomous | Mode::Rest);
    let avoids = match situation.configuration() {
        Some(running) => {
            let required = running.facts().required;
            required.has(Module::Smz) || required.has(Module::Dvz)
        }
        None => false,
    };
    match report {
        Report::Vital => Severity::Fatal,
        Report::Wifi if !autonomous => Severity::Fatal,
        Report::Hard | Report::Refusal => Severity::Hard,
        Report::Ambiguous | Report::Planner if autonomous => Severity::Hard,
        Report::Collision if autonomous && !avoids => Severity::Hard,
        Report::Camera if !autonomous => Severity::Hard,
        Report::Sonar | Report::Collision => Severity::Medium,
        Report::Avoidance if !autonomous => Severity::Medium,
        Report::Slow | Report::Mcl | Report::Smz if autonomous => Severity::Medium,
        _ => Severity::Weak,
    }
}

/// The class by severity alone.
pub const fn by_severity(report: Report, situation: Situation) -> Class {
    severity(report, situation).class()
}

/// The class by what is available (inferred). The running configuration is: nothing to do. Else
/// another of its sub-objective and mode: the adapter switches. Else one of another mode, and the
/// operator can be reached: the local supervisor asks. Else the mission ends. The hand-over, where
/// nothing runs, waits for one of another mode.
pub const fn by_availability(situation: Situation, available: Modules, operator: bool) -> Class {
    let other_mode = operator && has_other_mode(situation.mode(), available);
    match (situation.mode(), situation.configuration()) {
        (Mode::HandOver, _) if !other_mode => Class::Global,
        (_, None) => Class::Record,
        (_, Some(running)) if running.runs_on(available) => Class::Record,
        (_, Some(running)) if has_substitute(running, available) => Class::Adapter,
        _ if other_mode => Class::Local,
        _ => Class::Global,
    }
}

/// Whether another configuration of the same sub-objective runs.
const fn has_substitute(running: Configuration, available: Modules) -> bool {
    let mut at = 0;
    while at < Configuration::ALL.len() {
        let it = Configuration::ALL[at];
        if it.facts().sub_objective as u8 == running.facts().sub_objective as u8
            && it.runs_on(available)
        {
            return true;
        }
        at += 1;
    }
    false
}

/// Whether a configuration of another autonomy mode runs.
const fn has_other_mode(mode: Mode, available: Modules) -> bool {
    let mut at = 0;
    while at < Configuration::ALL.len() {
        let it = Configuration::ALL[at];
        let other = it.facts().mode as u8 != mode as u8 && !matches!(it.facts().mode, Mode::Rest);
        if other && it.runs_on(available) {
            return true;
        }
        at += 1;
    }
    false
}

/// The decision by the two rules, for a report of a given severity: the worse class wins
/// (inferred), and what it becomes.
///
/// * Without a drive only a global event has a receiver; everything else is recorded.
/// * A question that the operator cannot answer, because the link is lost or because he just
///   refused, is a global event.
/// * An adapter event for which the running adapter has no transition is recorded only.
pub const fn judge(report: Report, severity: Severity, situation: Situation) -> Decision {
    let mut health = lost_after(report, situation).health();
    if matches!(report, Report::Planner) {
        health.faulty = health.faulty.with(Module::Ppl);
    }
    let left = health.available();
    let operator = left.has(Module::Lan) && !matches!(report, Report::Refusal);
    let class = severity.class().worse(by_availability(situation, left, operator));
    match class {
        Class::Global => Decision::Global,
        _ if matches!(situation.mode(), Mode::Rest) => Decision::Record,
        Class::Local if operator => Decision::Local,
        Class::Local => Decision::Global,
        Class::Adapter => match adaptation(report, situation) {
            Some(adapted) => adapted,
            None => Decision::Record,
        },
        Class::Record => Decision::Record,
    }
}

/// The decision by the two rules. [`decide`](crate::cotama::decide) is the same but for seven
/// cells:
///
/// | report | place | rules | table | why the table says less |
/// |---|---|---|---|---|
/// | planner | following | local | record | no planner runs there; such a report never comes |
/// | refusal | planning, following | global | record | nobody was asked; it never comes |
/// | camera | hand-over, teleprogrammed | local | record | the operator is asked already (`l7`) |
/// | hard | hand-over, teleprogrammed | local | record | the operator is asked already |
///
/// and but for situations in which an earlier loss is not answered yet ([`is_settled`]): there the
/// rules answer both, and the table each loss by its own report. The transition `l7` of
/// [`local`](crate::cotama::local) keeps teleoperation shut without a camera.
///
/// ```
/// use cotama_models::cotama::{Decision, Report, Situation, by_rules, local, path_following};
/// let following = Situation {
///     local: local::State::Following,
///     following: path_following::State::Optimal,
///     ..Situation::AT_REST
/// };
/// assert_eq!(by_rules(Report::Mcl, following), Decision::AdaptMcl);
/// assert_eq!(by_rules(Report::Vital, following), Decision::Global);
/// assert_eq!(by_rules(Report::Mcl, Situation::AT_REST), Decision::Record);
/// ```
pub const fn by_rules(report: Report, situation: Situation) -> Decision {
    judge(report, severity(report, situation), situation)
}

/// Whether the running configuration has what it needs, the loss of this report aside: every
/// earlier loss is answered.
pub const fn is_settled(report: Report, situation: Situation) -> bool {
    let before = match report.loss() {
        Some(loss) => situation.lost.without(Losses::of(&[loss])),
        None => situation.lost,
    };
    let operator = !before.has(Loss::Wifi);
    matches!(by_availability(situation, before.available(), operator), Class::Record)
}
