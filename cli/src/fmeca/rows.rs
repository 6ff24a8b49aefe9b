//! The typed rows of the FMECA as an answer.

use super::diagnosability;
use super::names::{flags, modes, modules};
use crate::answers::fmeca::{CountsRow, DiagramRow, FmecaAnswer, FmecaRow, RibRow};
use cotama_models::cotama::{FailureMode, Modules, Report, Resource, functions, ribs};

/// All that is known.
pub(crate) fn answer() -> FmecaAnswer {
    let diagrams: Vec<_> = functions().map(diagram).collect();
    FmecaAnswer {
        schema: "cotama/fmeca/1",
        counts: counts(),
        rows: FailureMode::ALL.iter().map(|&mode| row(mode)).collect(),
        diagrams,
        diagnosability: diagnosability::of_all(),
    }
}

/// The counts. That every row is detected and answered, or declared invisible with a reason, is
/// asserted where the rows are defined, while compiling.
fn counts() -> CountsRow {
    let all = || FailureMode::ALL.iter();
    let detected = || all().filter(|it| !it.rule().signature.always.is_empty());
    let reported = detected().filter(|it| it.rule().report.is_some()).count();
    CountsRow {
        rows: all().count(),
        functions: functions().count(),
        detected: detected().count(),
        reported,
        recorded: detected().count() - reported,
        undetectable: all().filter(|it| it.description().silent.is_some()).count(),
    }
}

fn row(mode: FailureMode) -> FmecaRow {
    let (rule, text) = (mode.rule(), mode.description());
    // Of a fault of one module, whichever it is, no module is sure to be gone.
    let gone = Modules::ALL.without(mode.health(Modules::NONE).available());
    FmecaRow {
        id: mode.name(),
        function: text.function,
        component: text.component,
        failure: text.failure,
        cause: text.cause,
        effect: text.effect,
        severity_autonomous: rule.autonomous.name(),
        severity_operator: rule.operator.name(),
        class: rule.class.name(),
        persistence: rule.persistence.name(),
        loss: text.modules,
        modules_faulty: modules(rule.faulty),
        any_one_module: rule.one_module,
        resources_lost: rule.lost.iter().map(Resource::name).collect(),
        modules_unavailable: modules(gone),
        observer: text.observer,
        detection: text.detection,
        detection_latency_ms: rule.latency_ms,
        flags_always: flags(rule.signature.always),
        flags_sometimes: flags(rule.signature.sometimes),
        only_with_modules: modules(rule.signature.present),
        only_without_modules: modules(rule.signature.absent),
        undetectable_reason: text.silent,
        report: rule.report.map(Report::name),
        reaction: text.reaction,
        mtbf_mh: text.mtbf_mh,
        rate_label: text.rate_label.name(),
        rate_source: text.rate,
        injection: text.injection,
    }
}

fn diagram(function: &'static str) -> DiagramRow {
    let ribs =
        ribs(function).map(|rib| RibRow { component: rib.component, modes: modes(rib.modes) });
    DiagramRow { function, ribs: ribs.collect() }
}
