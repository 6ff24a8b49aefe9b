//! An analysis as an answer.

use super::diagnosability;
use crate::answers::fmeca::{
    CountsRow, CriticalityRow, DiagramRow, FmecaAnswer, FmecaRow, MeasuredRow, RibRow,
};
use cotama_models::fmeca::{Analysis, Mode};
use cotama_models::robots::{Parts, Robot};
use cotama_models::severity::{Persistence, Severity};

/// Returns the analysis as an answer; a robot says more than a file of rows.
pub(crate) fn answer<'a>(analysis: &'a Analysis, robot: Option<&'a Robot>) -> FmecaAnswer<'a> {
    let rows: Vec<_> = analysis.modes().iter().map(|it| row(analysis, it, robot)).collect();
    FmecaAnswer {
        schema: "cotama/fmeca/1",
        title: analysis.title(),
        period_h: analysis.period_h(),
        counts: counts(analysis, &rows),
        rows,
        diagrams: analysis.functions().into_iter().map(|it| diagram(analysis, it)).collect(),
        diagnosability: diagnosability::of(analysis, robot),
    }
}

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

fn row<'a>(analysis: &'a Analysis, it: &'a Mode, robot: Option<&'a Robot>) -> FmecaRow<'a> {
    let failure = robot.and_then(|robot| {
        let number = robot.failure(&it.id)?;
        Some((robot, number, robot.failures.get(number)?))
    });
    let lost = |of: fn(Parts) -> Parts| {
        failure.map_or_else(Vec::new, |(robot, _, it)| robot.names_of(of(it.loses)))
    };
    let report = failure.filter(|it| it.2.unseen.is_none()).and_then(|(robot, number, _)| {
        let all = &robot.losses.reports;
        all.iter().find(|it| it.failures.contains(&number)).map(|it| it.name.as_str())
    });
    let gone = failure.map_or_else(Vec::new, |(robot, _, it)| {
        let gone = robot.available(Parts::NONE) & !robot.available(it.loses);
        robot.names_of(Parts { hardware: 0, modules: gone })
    });
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
        modules_faulty: lost(|it| Parts { hardware: 0, ..it }),
        resources_lost: lost(|it| Parts { modules: 0, ..it }),
        modules_unavailable: gone,
        observer: &it.observer,
        detection: &it.detection,
        detection_latency_ms: it.latency_ms,
        flags_always: analysis.names(&it.flags),
        flags_sometimes: analysis.names(&it.sometimes),
        undetectable_reason: it.silent.as_deref(),
        report,
        reaction: &it.reaction,
        reaction_rounds: failure.and_then(|(robot, number, _)| robot.reacts_in(number)),
        reaction_ms: failure.and_then(|(robot, number, _)| Some(robot.reacts_within(number)?.0)),
        mtbf_mh: it.mtbf_mh,
        rate_label: it.rate_label.name(),
        rate_source: &it.rate_source,
        injection: &it.injection,
        criticality: criticality(analysis, it),
        event: robot.map_or_else(|| it.event.clone(), |_| event(it, report)),
    }
}

/// Returns the outcome of a failure mode while the robot drives itself.
fn event(it: &Mode, report: Option<&str>) -> String {
    let told = |report| format!("report {report}, {} event", it.event);
    report.map_or_else(|| "no event".to_owned(), told)
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
        action_priority: it.priority().name(),
        measured: it.measured.map(|detection| MeasuredRow {
            detection,
            rpn: it.rpn_by(detection),
            action_priority: it.priority_by(detection).name(),
        }),
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
