//! The roots of what is known of failure modes: what shows them, what confuses them, and which
//! further probes would tell them apart.

use cotama_models::cotama::{
    Adjusted, Adjustment, Class, Description, FailureMode, FailureModes, Flag, Flags, Health,
    Label, Mode, Modules, Persistence, Probe, Probes, Rule, Severity, Situation, ambiguity_groups,
    are_confusable, confusable_pairs, is_detectable, shared_flags, unwatched,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_failure_rule(mode: FailureMode) -> (&'static Rule, Option<Adjustment>) {
    (mode.rule(), mode.adjustment())
}

#[unsafe(no_mangle)]
fn root_failure_described(mode: FailureMode) -> &'static Description {
    mode.description()
}

#[unsafe(no_mangle)]
fn root_failure_severity(mode: FailureMode, at: Mode) -> Severity {
    mode.severity(at)
}

#[unsafe(no_mangle)]
fn root_failure_effective(mode: FailureMode, part: Modules, situation: Situation) -> Class {
    mode.effective(part, situation)
}

#[unsafe(no_mangle)]
fn root_adjustment_effect(adjustment: Adjustment, mode: Mode) -> Adjusted {
    adjustment.effect(mode)
}

#[unsafe(no_mangle)]
fn root_names(persistence: Persistence, label: Label) -> [&'static str; 2] {
    [persistence.name(), label.name()]
}

#[unsafe(no_mangle)]
fn root_flag_seen(flag: Flag, available: Modules) -> (Modules, Modules, bool, Flags) {
    (flag.observers(), flag.observed(), flag.is_seen_by(available), Flags::seen_by(available))
}

#[unsafe(no_mangle)]
fn root_failure_detectable(mode: FailureMode, status: Modules) -> bool {
    is_detectable(mode, status)
}

#[unsafe(no_mangle)]
fn root_unwatched(status: Modules) -> Health {
    unwatched(status)
}

#[unsafe(no_mangle)]
fn root_confusable(a: FailureMode, b: FailureMode, status: Modules) -> bool {
    are_confusable(a, b, status)
}

#[unsafe(no_mangle)]
fn root_confusable_pairs(status: Modules) -> Option<(FailureMode, FailureMode)> {
    confusable_pairs(status).last()
}

#[unsafe(no_mangle)]
fn root_ambiguity_groups(status: Modules) -> Option<FailureModes> {
    ambiguity_groups(status).last()
}

#[unsafe(no_mangle)]
fn root_shared_flags(modes: FailureModes, status: Modules) -> Option<(Flags, Flags)> {
    shared_flags(modes, status)
}

#[unsafe(no_mangle)]
fn root_probe(probe: Probe, a: FailureMode, b: FailureMode) -> (FailureModes, Modules, bool) {
    (probe.shows(), probe.needs(), probe.separates(a, b))
}

#[unsafe(no_mangle)]
fn root_probes_that_separate(a: FailureMode, b: FailureMode, status: Modules) -> Probes {
    Probes::that_separate(a, b, status)
}

#[unsafe(no_mangle)]
fn root_probes_least(status: Modules) -> Option<Probes> {
    Probes::least(status)
}

#[unsafe(no_mangle)]
fn root_probes_least_that_help(status: Modules) -> Probes {
    Probes::least_that_help(status)
}
