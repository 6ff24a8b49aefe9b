//! An analysis as an answer.

use super::diagnosability;
use super::names::modules;
use crate::answers::fmeca::{CountsRow, CriticalityRow, DiagramRow, FmecaAnswer, FmecaRow, RibRow};
use cotama_models::cotama::{FailureMode, Modules, Persistence, Report, Resource, Severity};
use cotama_models::fmeca::{Analysis, Mode};

/// All that is known; of the robot, its typed rows say more.
pub(crate) fn answer(analysis: &Analysis, is_robot: bool) -> FmecaAnswer<'_> {
    let typed = |it: &Mode| if is_robot { FailureMode::named(&it.id) } else { None };
    let rows: Vec<_> = analysis.modes().iter().map(|it| row(analysis, it, typed(it))).collect();
    FmecaAnswer {
        schema: "cotama/fmeca/1",
        title: analysis.title(),
        period_h: analysis.period_h(),
        is_robot,
        counts: counts(analysis, &rows),
        rows,
        diagrams: analysis.functions().into_iter().map(|it| diagram(analysis, it)).collect(),
        diagnosability: if is_robot {
            diagnosability::of_the_robot(analysis)
        } else {
            diagnosability::of_a_file(analysis)
        },
    }
}

/// The counts. That every row of the robot is detected and answered, or declared invisible with a
/// reason, is asserted where they are defined, while compiling.
fn counts(analysis: &Analysis, rows: &[FmecaRow<'_>]) -> CountsRow {
    let detected = || rows.iter().filter(|it| !it.flags_always.is_empty());
    let undetectable = rows.iter().filter(|it| it.undetectable_reason.is_some()).count();
    CountsRow {
        rows: rows.len(),
        functions: analysis.functions().len(),
        detected: detected().count(),
        reported: detected().filter(|it| it.report.is_some()).count(),
        recorded: detected().filter(|it| it.report.is_none() && !it.reaction.is_empty()).count(),
        undetectable,
        unexplained: rows.len() - detected().count() - undetectable,
    }
}

fn row<'a>(analysis: &'a Analysis, it: &'a Mode, typed: Option<FailureMode>) -> FmecaRow<'a> {
    let rule = typed.map(FailureMode::rule);
    // A fault of one module, whichever it is, takes no module for sure.
    let gone = typed.map(|it| Modules::ALL.without(it.health(Modules::NONE).available()));
    let lost = rule.into_iter().flat_map(|it| it.lost.iter());
    let named = |set: Option<Modules>| set.map_or_else(Vec::new, modules);
    FmecaRow {
        id: &it.id,
        function: &it.function,
        component: &it.component,
        failure: &it.failure,
        cause: &it.cause,
        effect: &it.effect,
        severity_autonomous: it.severity.name(),
        severity_operator: it.severity_operator.map(Severity::name),
        class: &it.event,
        persistence: it.persistence.map(Persistence::name),
        loss: &it.lost,
        modules_faulty: named(rule.map(|it| it.faulty)),
        any_one_module: rule.is_some_and(|it| it.one_module),
        resources_lost: lost.map(Resource::name).collect(),
        modules_unavailable: named(gone),
        observer: &it.observer,
        detection: &it.detection,
        detection_latency_ms: it.latency_ms,
        flags_always: analysis.names(&it.flags),
        flags_sometimes: analysis.names(&it.sometimes),
        only_with_modules: named(rule.map(|it| it.signature.present)),
        only_without_modules: named(rule.map(|it| it.signature.absent)),
        undetectable_reason: it.silent.as_deref(),
        report: rule.and_then(|it| it.report).map(Report::name),
        reaction: &it.reaction,
        mtbf_mh: it.mtbf_mh,
        rate_label: it.rate_label.name(),
        rate_source: &it.rate_source,
        injection: &it.injection,
        criticality: criticality(analysis, it),
        event: event(it, typed),
    }
}

/// Returns the outcome of a failure mode while the robot drives itself; in a file, as it says.
fn event(it: &Mode, typed: Option<FailureMode>) -> String {
    match typed.map(|it| it.rule().report) {
        None => it.event.clone(),
        Some(Some(report)) => format!("report {}, {} event", report.name(), it.event),
        Some(None) if it.silent.is_some() => "no event".to_owned(),
        Some(None) => "recorded".to_owned(),
    }
}

fn criticality(analysis: &Analysis, mode: &Mode) -> CriticalityRow {
    let it = analysis.criticality(mode);
    CriticalityRow {
        severity: it.severity,
        occurrence: it.occurrence,
        detection: it.detection,
        rpn: it.rpn(),
        severity_class: it.severity_class.name(),
        occurrence_class: it.occurrence_class.name(),
        class: it.class().name(),
        number_e9: it.number_e9,
    }
}

fn diagram<'a>(analysis: &'a Analysis, function: &'a str) -> DiagramRow<'a> {
    let ribs = analysis.ribs(function).into_iter().map(|rib| RibRow {
        component: rib.component,
        modes: rib.modes.iter().map(|it| it.id.as_str()).collect(),
    });
    DiagramRow { function, ribs: ribs.collect() }
}
