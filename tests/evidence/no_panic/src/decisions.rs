//! The roots of what decisions rest on: situations, losses, severities and reports.
//!
//! A situation comes as its caller can make it at worst, also inconsistent.

use cotama_models::cotama::{
    Class, Configuration, Decision, Health, Loss, Losses, Mode, Modules, Report, Return, Severity,
    Situation, by_availability, by_severity, is_settled, severity,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_class(class: Class, other: Class, decision: Decision) -> (&'static str, Class, Class) {
    (class.name(), class.worse(other), decision.class())
}

#[unsafe(no_mangle)]
fn root_report_loss(report: Report) -> Option<Loss> {
    report.loss()
}

#[unsafe(no_mangle)]
fn root_severity(report: Report, situation: Situation) -> (Severity, Class) {
    (severity(report, situation), by_severity(report, situation))
}

#[unsafe(no_mangle)]
fn root_severity_read(severity: Severity) -> (&'static str, Class) {
    (severity.name(), severity.class())
}

#[unsafe(no_mangle)]
fn root_by_availability(situation: Situation, available: Modules, operator: bool) -> Class {
    by_availability(situation, available, operator)
}

#[unsafe(no_mangle)]
fn root_is_settled(report: Report, situation: Situation) -> bool {
    is_settled(report, situation)
}

#[unsafe(no_mangle)]
fn root_situation_read(situation: Situation) -> (bool, Mode) {
    (situation.is_consistent(), situation.mode())
}

#[unsafe(no_mangle)]
fn root_losses_read(lost: Losses, planned: Configuration) -> (Losses, Configuration, Health) {
    (lost.beside(planned), lost.following(), lost.health())
}

#[unsafe(no_mangle)]
fn root_return_read(it: Return, available: Modules) -> (Loss, bool) {
    (it.loss(), it.works(available))
}
