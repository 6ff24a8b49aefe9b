//! The roots of the decisional level: the supervisors with names, diagnosis, decision and what
//! follows from losses.
//!
//! Flags, losses and situations come as their caller can make them at worst, also those that no run
//! has.

use cotama_core::net::PlaceId;
use cotama_core::net::TransitionId;
use cotama_core::player::{Outcome, Round};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::Round as Decided;
use cotama_models::cotama::{
    Adjusted, Adjustment, Adjustments, Body, Cause, Configuration, Configurations, Decision,
    DecisionalLevel, DeliveryDecider, Diagnosis, FailureMode, FailureModes, Finding, Flags, Health,
    Loss, Losses, Mode, Modules, NoPlanLeft, Perceived, Plans, Report, Requests, Resources,
    Severity, Situation, StatusVector, Told, Why, Word, available, by_rules, decide, delivery,
    diagnose, judge, lost_after, undetectable,
};

#[unsafe(no_mangle)]
fn root_level_tell(
    level: &mut DecisionalLevel,
    now: Millis,
    told: Told,
    cause: Cause,
    seen: &mut Option<(Of<TransitionId>, Cause)>,
) -> Outcome<Of<TransitionId>> {
    let mut see = |it: &delivery::Firing<'_, Cause>| *seen = Some((it.id, it.carries));
    level.tell(now, told, cause, &mut see)
}

#[unsafe(no_mangle)]
fn root_level_round(
    level: &mut DecisionalLevel,
    now: Millis,
    seen: &mut Option<(Of<TransitionId>, Cause)>,
) -> Round {
    let mut see = |it: &delivery::Firing<'_, Cause>| *seen = Some((it.id, it.carries));
    level.round(now, &mut see)
}

#[unsafe(no_mangle)]
fn root_level_situation(level: &DecisionalLevel, lost: Losses) -> (Situation, PlaceId, bool, bool) {
    (level.situation(lost), level.global(), level.permit().is_some(), level.halted())
}

#[unsafe(no_mangle)]
fn root_level_named(level: &DecisionalLevel, at: Of<TransitionId>) -> Option<(&str, &str)> {
    level.named(at)
}

#[unsafe(no_mangle)]
fn root_diagnose(raised: Flags, status: Modules) -> Diagnosis {
    diagnose(raised, status)
}

#[unsafe(no_mangle)]
fn root_diagnosis_health(diagnosis: Diagnosis, part: Modules) -> Health {
    diagnosis.health(part)
}

#[unsafe(no_mangle)]
fn root_diagnosis_judged(
    diagnosis: Diagnosis,
    raised: Flags,
    mode: Mode,
) -> (Option<Report>, Severity, Option<Adjustment>) {
    let (report, severity) = diagnosis.judged(raised, mode);
    (report, severity, diagnosis.adjustment())
}

#[unsafe(no_mangle)]
fn root_adjustments(all: Adjustments, mode: Mode) -> Adjusted {
    all.effect(mode)
}

#[unsafe(no_mangle)]
fn root_relied_on(health: Health) -> Modules {
    health.relied_on()
}

#[unsafe(no_mangle)]
fn root_told_lost(loss: Loss, known: Health) -> Told {
    Told::lost(loss, known)
}

#[unsafe(no_mangle)]
fn root_undetectable(status: Modules) -> FailureModes {
    undetectable(status)
}

#[unsafe(no_mangle)]
fn root_failure_health(mode: FailureMode, part: Modules) -> Health {
    mode.health(part)
}

#[unsafe(no_mangle)]
fn root_decide(report: Report, situation: Situation) -> (Decision, Losses) {
    (decide(report, situation), lost_after(report, situation))
}

#[unsafe(no_mangle)]
fn root_judge(report: Report, severity: Severity, situation: Situation) -> [Decision; 2] {
    [judge(report, severity, situation), by_rules(report, situation)]
}

#[unsafe(no_mangle)]
fn root_available(faulty: Modules, lost: Resources) -> Modules {
    available(faulty, lost)
}

#[unsafe(no_mangle)]
fn root_health_status(health: Health) -> StatusVector {
    health.status_vector()
}

#[unsafe(no_mangle)]
fn root_losses_lacking(left: Modules) -> Losses {
    Losses::lacking(left)
}

#[unsafe(no_mangle)]
fn root_losses_of_health(health: Health) -> (Losses, Modules) {
    let lost = Losses::from(health);
    (lost, lost.available())
}

#[unsafe(no_mangle)]
fn root_configurations(
    left: Modules,
    situation: Situation,
) -> (Configurations, Option<Configuration>) {
    (Configuration::running_on(left), situation.configuration())
}

/// A mission whose plan answers as it likes.
struct AnyPlans<'p>(&'p mut [Option<Configuration>; 2], Option<usize>, bool);

impl Plans for AnyPlans<'_> {
    fn is_over(&self) -> bool {
        self.2
    }

    fn plan(&mut self, _: Why, _: Modules) -> Result<bool, NoPlanLeft> {
        self.0.swap(0, 1);
        if self.0[0].is_some() { Ok(self.2) } else { Err(NoPlanLeft) }
    }

    fn configuration(&self) -> Option<Configuration> {
        self.0[1]
    }

    fn short(&self) -> Option<usize> {
        self.1
    }
}

#[unsafe(no_mangle)]
fn root_decider_new(objectives: u32, planned: Option<Configuration>) -> DeliveryDecider {
    DeliveryDecider::start(delivery::Program, objectives, planned).with_returns()
}

#[unsafe(no_mangle)]
fn root_decider_resume(level: DecisionalLevel, objectives: u32, known: Health) -> DeliveryDecider {
    DeliveryDecider::resume(level, objectives, known)
}

#[unsafe(no_mangle)]
fn root_decider_perceive(
    decider: &mut DeliveryDecider,
    now: Millis,
    seen: Perceived,
    configurations: &mut [Option<Configuration>; 2],
    short: Option<usize>,
    over: bool,
) -> Option<Finding> {
    decider.perceive(now, seen, &mut AnyPlans(configurations, short, over))
}

#[unsafe(no_mangle)]
fn root_decider_round(
    decider: &mut DeliveryDecider,
    now: Millis,
    said: Option<Word>,
    body: Body,
    seen: &mut Option<(Of<TransitionId>, Cause)>,
) -> (Decided, Requests) {
    let mut see = |it: &delivery::Firing<'_, Cause>| *seen = Some((it.id, it.carries));
    (decider.round(now, said, body, &mut see), decider.requests())
}
