//! What happened, in the order of time.

use super::MAX_ROWS;
use super::format::{metres, moment, seconds, trimmed};
use super::svg::{escape, fixed};
use super::view::View;
use crate::run::Outcome;
use crate::trace::{Event, Occurrence, Record};
use std::fmt::Write;

/// The shape of a kind of event, about 12 wide; shapes differ so that colour is not needed.
pub(super) fn glyph(kind: &str, x: f64, y: f64) -> String {
    let at = |dx: f64, dy: f64| format!("{} {}", fixed(x + dx), fixed(y + dy));
    match kind {
        "obstacle" => format!("M{}L{}L{}Z", at(0.0, -5.0), at(5.5, 4.5), at(-5.5, 4.5)),
        "fault" => {
            format!("M{}L{}M{}L{}", at(-4.5, -4.5), at(4.5, 4.5), at(-4.5, 4.5), at(4.5, -4.5))
        }
        "repair" => {
            format!("M{}L{}M{}L{}", at(-5.0, 0.0), at(5.0, 0.0), at(0.0, -5.0), at(0.0, 5.0))
        }
        _ => format!("M{}L{}L{}L{}Z", at(0.0, -5.5), at(5.5, 0.0), at(0.0, 5.5), at(-5.5, 0.0)),
    }
}

/// The kind of an event, its label in a drawing, and the same in words.
pub(super) fn short(event: &Event) -> (&'static str, String, String) {
    let lost = moment(event.lost_us);
    match &event.event {
        Occurrence::Obstacle { .. } => ("obstacle", lost.clone(), format!("obstacle, {lost} lost")),
        Occurrence::Fault { hardware, units_lost, units_left } => {
            let words = format!("fault of {hardware}: {units_lost} lost, {units_left} left");
            ("fault", format!("{hardware} \u{2212}{units_lost}"), words)
        }
        Occurrence::Repair { hardware, units_back, units_left } => {
            let words = format!("repair of {hardware}: {units_back} back, {units_left} work");
            ("repair", format!("{hardware} +{units_back}"), words)
        }
        Occurrence::Odometry { extra_mm } => {
            let extra = trimmed(*extra_mm);
            (
                "odometry",
                format!("+{extra} m"),
                format!("odometry wrong: {extra} m of extra path, {lost} lost"),
            )
        }
    }
}

/// The first letter made large.
pub(super) fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

/// A row of the list: what it is, its mark, its words, and the time it took.
struct Row {
    mark: String,
    words: String,
    lost: String,
    origin: String,
}

fn row(record: &Record, plans: &mut u64) -> Option<Row> {
    let mark = |kind: &str| {
        format!(
            "<svg class=\"glyph\" viewBox=\"0 0 14 14\" aria-hidden=\"true\">\
             <path class=\"mark {kind}\" d=\"{}\"/></svg>",
            glyph(kind, 7.0, 7.0)
        )
    };
    let none = String::new;
    match record {
        Record::Event(it) => {
            let (kind, _, words) = short(it);
            let origin = it.random.as_ref().map_or(String::new(), |name| format!("random: {name}"));
            let lost = moment(it.lost_us);
            let words = words.trim_end_matches(&format!(", {lost} lost"));
            Some(Row { mark: mark(kind), words: capital(words), lost, origin })
        }
        Record::Plan(it) => {
            let number = *plans;
            *plans += 1;
            let mark = format!("<b class=\"pin\">{number}</b>");
            let words = format!("Plan {number}: {}", it.cause);
            Some(Row { mark, words, lost: none(), origin: none() })
        }
        Record::Failure(it) => {
            let words = format!("Failure {}: {}", it.failure, it.mode);
            Some(Row { mark: mark("fault"), words, lost: none(), origin: none() })
        }
        Record::Diagnosis(it) => {
            let words = format!("Found: {}; {}", it.flags.join(", "), it.candidates.join(" or "));
            Some(Row { mark: none(), words, lost: none(), origin: none() })
        }
        Record::Decision(it) => {
            let by = it.transition.as_deref().unwrap_or("record");
            let words = format!("Decided: {}", it.event.as_deref().unwrap_or(&it.decision));
            Some(Row { mark: none(), words, lost: none(), origin: by.into() })
        }
        Record::Told(it) if !it.event.starts_with("faults.") => {
            let words = format!("Told: {}", it.event);
            Some(Row { mark: none(), words, lost: none(), origin: format!("round {}", it.round) })
        }
        Record::Configuration(it) => {
            let words = it.configuration.as_deref().unwrap_or("nothing");
            Some(Row {
                mark: none(),
                words: format!("Runs: {words}"),
                lost: none(),
                origin: it.mode.clone(),
            })
        }
        Record::Request(it) => {
            let words = format!("Operator asked: {}; {}", it.cause, it.reason);
            Some(Row { mark: "<b class=\"bad\">?</b>".into(), words, lost: none(), origin: none() })
        }
        Record::Abort(it) => {
            let words = format!("No plan is left: {}; {}", it.cause, it.reason);
            Some(Row { mark: "<b class=\"bad\">?</b>".into(), words, lost: none(), origin: none() })
        }
        Record::End(it) => {
            let mark = if it.outcome == Outcome::Completed {
                "<b>■</b>"
            } else {
                "<b class=\"bad\">■</b>"
            };
            let reason = it.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
            let words = format!("End of the run, {}{reason}", it.outcome.name());
            Some(Row { mark: mark.into(), words, lost: none(), origin: none() })
        }
        _ => None,
    }
}

/// The list of events, with the plans between them.
pub(super) fn section(view: &View<'_>) -> String {
    let mut html = String::from(
        "<section class=\"events\"><h2>Events</h2>\n<div class=\"scroll\"><table><thead><tr><th>\
         </th>\
         <th class=\"n\">Time</th><th class=\"n\">Place</th><th>What</th><th class=\"n\">Time lost\
         </th>\
         <th></th></tr></thead>\n<tbody>\n",
    );
    let mut plans = 0;
    let mut shown = 0;
    let mut left_out = 0;
    for record in &view.trace.records {
        let Some(row) = row(record, &mut plans) else { continue };
        if shown >= MAX_ROWS && !matches!(record, Record::End(_)) {
            left_out += 1;
            continue;
        }
        shown += 1;
        let _ = writeln!(
            html,
            "<tr><td class=\"c\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td>\
             <td class=\"n\">{}</td><td class=\"muted\">{}</td></tr>",
            row.mark,
            moment(record.t_us()),
            metres(record.x_mm()),
            escape(&row.words),
            row.lost,
            escape(&row.origin)
        );
    }
    html.push_str("</tbody></table></div>\n");
    if left_out > 0 {
        let _ = writeln!(html, "<p class=\"note\">{left_out} further rows are in the trace.</p>");
    }
    html.push_str("</section>\n");
    html
}

/// What happened between two plans: `4 obstacles (10.8 s lost)`, and so on; empty if nothing.
pub(super) fn summary(events: &[&Event]) -> String {
    let kinds = [
        ("obstacle", "obstacle"),
        ("fault", "fault"),
        ("repair", "repair"),
        ("odometry", "odometry error"),
    ];
    let mut parts = Vec::new();
    for (kind, noun) in kinds {
        let of_kind = events.iter().filter(|event| short(event).0 == kind);
        let number = of_kind.clone().count() as u64;
        if number == 0 {
            continue;
        }
        let lost = of_kind.map(|event| event.lost_us).fold(0u64, u64::saturating_add);
        let lost = if lost > 0 { format!(" ({} lost)", moment(lost)) } else { String::new() };
        parts.push(format!("{}{lost}", super::format::count(number, noun)));
    }
    parts.join(", ")
}

/// The time lost by all events, in words.
pub(super) fn lost(view: &View<'_>) -> String {
    seconds(view.events.iter().map(|event| event.lost_us).fold(0u64, u64::saturating_add) / 1000)
}
