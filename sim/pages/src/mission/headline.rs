//! The head of the page: how it ended, and the figures that matter.

use super::view::View;
use crate::format::{clock, count, grouped, joules, metres, milli, percent, seconds, watt_hours};
use crate::svg::fixed;
use cotama_core::text::markup;
use cotama_sim::run::Outcome;
use cotama_sim::trace::{Header, Margins, RunFaults, Used};
use std::fmt::Write;

/// The name of the mission, or of its source.
pub(super) fn name<'v>(view: &'v View<'_>) -> &'v str {
    view.mission.as_ref().map_or(&view.trace.header.mission_source, |mission| &mission.name)
}

/// The faults of a run, in words.
pub(super) fn faults(header: &Header) -> String {
    match &header.options.faults {
        RunFaults::Script => "mission script".into(),
        RunFaults::None => "none".into(),
        RunFaults::File { source, .. } => format!("file {source}"),
    }
}

/// The class, the word and the shape of an outcome; shapes differ as words do.
fn outcome(outcome: Option<Outcome>) -> (&'static str, &'static str, &'static str) {
    match outcome {
        Some(Outcome::Completed) => ("completed", "Completed", "M8 16.5L13.5 22L24 10.5"),
        Some(Outcome::Safe) => ("safe", "Stopped safely", "M12 10V22M20 10V22"),
        Some(Outcome::Failed) => ("failed", "Failed", "M10 10L22 22M22 10L10 22"),
        None => ("failed", "Unfinished", "M16 8V18M16 22V24"),
    }
}

fn sentence(view: &View<'_>) -> String {
    let Some(end) = view.end else {
        return "The trace breaks off before the end of the run.".into();
    };
    let reason = end.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
    match end.outcome {
        Outcome::Completed => {
            let number = view.activities.len() as u64;
            let all = if number == 1 {
                "The only activity is".into()
            } else {
                format!("All {} activities are", grouped(number.into()))
            };
            let replans = match end.replans {
                0 => "without a replan".into(),
                some => format!("after {}", count(some, "replan")),
            };
            format!("{all} done, within both limits, {replans}.")
        }
        Outcome::Safe if !view.points.is_empty() => {
            format!("The robot stands at {}{reason}.", metres(end.x_mm))
        }
        Outcome::Safe => {
            format!(
                "The mission was aborted at {}, where the robot stands{reason}.",
                metres(end.x_mm)
            )
        }
        Outcome::Failed => format!("The run ended at {}{reason}.", metres(end.x_mm)),
    }
}

/// One of the two gauges.
fn gauge(
    html: &mut String,
    title: &str,
    [used, also]: [&str; 2],
    limit: &str,
    margin: i64,
    unit: &str,
    share: [u64; 2],
) {
    let [part, whole] = share;
    let width =
        fixed(if whole == 0 { 100.0 } else { (part as f64 / whole as f64 * 100.0).min(100.0) });
    let left = percent(margin.unsigned_abs(), whole);
    let (class, words) = if margin < 0 { (" over", "over the limit") } else { ("", "left") };
    let margin = milli(margin.unsigned_abs().into(), 1);
    let _ = writeln!(
        html,
        "<div class=\"gauge{class}\"><h2>{title}</h2><p class=\"big\">{used} <small>of {limit}\
         </small></p>\
         <div class=\"track\"><div style=\"width:{width}%\"></div></div>\
         <p><b>{margin} {unit}</b> {words} ({left} %) <span class=\"muted\">· {also}</span></p>\
         </div>"
    );
}

/// How much happened.
fn happened(view: &View<'_>) -> (&'static str, String) {
    if view.points.is_empty() {
        return (
            "Events",
            format!("{}, {} lost", grouped(view.events.len() as u128), super::events::lost(view)),
        );
    }
    let failures = view.points.iter().filter_map(|it| it.chain());
    let found = failures.clone().filter(|it| it.diagnosis.is_some()).count();
    ("Failures", format!("{}, {} found", grouped(failures.count() as u128), grouped(found as u128)))
}

/// The head of the page.
pub(super) fn section(view: &View<'_>) -> String {
    let header = &view.trace.header;
    let (class, word, shape) = outcome(view.end.map(|end| end.outcome));
    let mut html = format!(
        "<header><p class=\"kicker\">Report of a simulated mission</p>\n<h1>{}</h1>\n\
         <div class=\"outcome {class}\">\
         <svg viewBox=\"0 0 32 32\" aria-hidden=\"true\"><circle cx=\"16\" cy=\"16\" r=\"15\"/>\
         <path d=\"{shape}\"/>\
         </svg><p><strong>{word}</strong><span>{}</span></p></div>\n",
        markup(name(view)),
        markup(&sentence(view))
    );
    html.push_str(&super::story::section(view));
    let used = view.end.map_or_else(
        || view.samples.last().map_or(Used::default(), |sample| sample.used),
        |end| end.used,
    );
    let margin = |limit: u64, used: u64| {
        i64::try_from(i128::from(limit) - i128::from(used)).unwrap_or(i64::MIN)
    };
    let limits = header.limits;
    let left = view.end.map_or(
        Margins {
            duration_ms: margin(limits.duration_ms, used.duration_ms),
            energy_mj: margin(limits.energy_mj, used.energy_mj),
        },
        |end| end.margins,
    );
    html.push_str("<div class=\"gauges\">\n");
    let (duration, energy) = (used.duration_ms, used.energy_mj);
    gauge(
        &mut html,
        "Duration",
        [&seconds(duration), &clock(duration)],
        &seconds(limits.duration_ms),
        left.duration_ms,
        "s",
        [duration, limits.duration_ms],
    );
    gauge(
        &mut html,
        "Energy",
        [&joules(energy), &watt_hours(energy)],
        &joules(limits.energy_mj),
        left.energy_mj,
        "J",
        [energy, limits.energy_mj],
    );
    html.push_str("</div>\n<dl class=\"facts\">\n");
    let plans = view.plans.len().saturating_sub(1) as u64;
    let requests = view.requests.len() as u64;
    let travelled = view.last().0;
    let facts = [
        (
            "Distance",
            format!("{} of {}", milli(travelled.into(), 1), metres(header.path_length_mm)),
        ),
        ("Replans", grouped(view.end.map_or(plans, |end| end.replans).into())),
        (
            "Operator requests",
            grouped(view.end.map_or(requests, |end| end.operator_requests).into()),
        ),
        happened(view),
        ("Faults", faults(header)),
        ("Seed", header.options.seed.to_string()),
    ];
    for (name, value) in facts {
        let _ = writeln!(html, "<div><dt>{name}</dt><dd>{}</dd></div>", markup(&value));
    }
    html.push_str("</dl>\n</header>\n");
    html
}
