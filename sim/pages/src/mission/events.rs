//! The events, in the order of time.

use super::MAX_ROWS;
use super::view::View;
use crate::format::{metres, moment, seconds, trimmed};
use crate::svg::fixed;
use cotama_core::text::markup;
use cotama_models::missions::Zone;
use cotama_sim::run::Outcome;
use cotama_sim::trace::{Event, Occurrence, Record};
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
        Occurrence::Detour { door, extra_mm } => {
            let extra = trimmed(*extra_mm);
            let words = format!("{door} is closed: {extra} m of extra path");
            ("odometry", format!("+{extra} m"), words)
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

/// A row of the list: its mark, its words, and the time it took.
struct Row {
    mark: String,
    words: String,
    lost: String,
}

/// Says how far the real power of a zone is from that of the model: `H2 −7.5 %`.
pub(super) fn power_error((zone, permille): &(&Zone, i32)) -> String {
    let sign = if *permille < 0 { '\u{2212}' } else { '+' };
    let (whole, tenth) = (permille.unsigned_abs() / 10, permille.unsigned_abs() % 10);
    format!("{} {sign}{whole}.{tenth} %", zone.id)
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
            let lost = moment(it.lost_us);
            let words = capital(words.trim_end_matches(&format!(", {lost} lost")));
            let words = match &it.random {
                Some(name) => format!("{words} (drawn: {name})"),
                None => words,
            };
            let lost = if it.lost_us == 0 { none() } else { lost };
            Some(Row { mark: mark(kind), words, lost })
        }
        Record::Plan(it) => {
            let number = *plans;
            *plans += 1;
            let mark = format!("<b class=\"pin\">{number}</b>");
            let words = format!("Plan {number}: {}", it.cause);
            Some(Row { mark, words, lost: none() })
        }
        Record::Failure(it) => {
            let words = format!("Failure {}: {}", it.failure, it.mode);
            Some(Row { mark: mark("fault"), words, lost: none() })
        }
        Record::Diagnosis(it) => {
            let words = format!("Found: {}; {}", it.flags.join(", "), it.candidates.join(" or "));
            Some(Row { mark: none(), words, lost: none() })
        }
        Record::Decision(it) => {
            let what = it.event.as_deref().unwrap_or(it.decision.name());
            let words = match &it.transition {
                Some(rule) => format!("Decided: {what}, by the rule {rule}"),
                None => format!("Decided: {what}, which is recorded only"),
            };
            Some(Row { mark: none(), words, lost: none() })
        }
        Record::Told(it) if !it.event.starts_with("faults.") => {
            let words = format!("Told: {}, in round {}", it.event, it.round);
            Some(Row { mark: none(), words, lost: none() })
        }
        Record::Configuration(it) => {
            let runs = it.configuration.as_deref().unwrap_or("nothing");
            let words = format!("Runs: {runs}, mode {}", it.mode.name());
            Some(Row { mark: none(), words, lost: none() })
        }
        Record::Status(it) => {
            let all = |it: &[String]| if it.is_empty() { "nothing".into() } else { it.join(", ") };
            let words = format!("Lost: {}; without it: {}", all(&it.lost), all(&it.without));
            Some(Row { mark: none(), words, lost: none() })
        }
        Record::Request(it) => {
            let words = format!("Operator asked: {}; {}", it.cause, it.reason);
            Some(Row { mark: "<b class=\"bad\">?</b>".into(), words, lost: none() })
        }
        Record::Abort(it) => {
            let words = format!("No plan is left: {}; {}", it.cause, it.reason);
            Some(Row { mark: "<b class=\"bad\">?</b>".into(), words, lost: none() })
        }
        Record::End(it) => {
            let mark = if it.outcome == Outcome::Completed {
                "<b>■</b>"
            } else {
                "<b class=\"bad\">■</b>"
            };
            let reason = it.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
            let words = format!("End of the run, {}{reason}", it.outcome.name());
            Some(Row { mark: mark.into(), words, lost: none() })
        }
        _ => None,
    }
}

/// The list of events, with the plans between them, and with the zones where the real power is
/// another than that of the model.
pub(super) fn section(view: &View<'_>) -> String {
    let takes_time = view.events.iter().any(|it| it.lost_us > 0);
    let lost = if takes_time { "<th class=\"n\">Time lost</th>" } else { "" };
    let mut html = format!(
        "<section class=\"events\"><h2>Events</h2>\n<div class=\"scroll\"><table><thead><tr>\
         <th aria-label=\"mark\"></th><th class=\"n\">Time</th><th class=\"n\">Place</th>\
         <th>What</th>{lost}</tr></thead>\n<tbody>\n",
    );
    let mut add = |row: &Row, t_us: u64, x_mm: u64| {
        let lost =
            if takes_time { format!("<td class=\"n\">{}</td>", row.lost) } else { String::new() };
        let _ = writeln!(
            html,
            "<tr><td class=\"c\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td>\
             {lost}</tr>",
            row.mark,
            moment(t_us),
            metres(x_mm),
            markup(&row.words)
        );
    };
    let (mut plans, mut shown, mut left_out) = (0, 0, 0);
    let errors = view.power_errors();
    let mut errors = errors.iter().take(MAX_ROWS).peekable();
    for record in &view.trace.records {
        while let Some(error) = errors.next_if(|it| it.0.x_start.0 <= record.x_mm()) {
            let words = format!(
                "Real power against the model: {} (power_error_permille)",
                power_error(error)
            );
            let row = Row { mark: String::new(), words, lost: String::new() };
            add(&row, record.t_us(), record.x_mm());
        }
        let Some(row) = row(record, &mut plans) else { continue };
        if shown >= MAX_ROWS && !matches!(record, Record::End(_)) {
            left_out += 1;
            continue;
        }
        shown += 1;
        add(&row, record.t_us(), record.x_mm());
    }
    html.push_str("</tbody></table></div>\n");
    if left_out > 0 {
        let _ = writeln!(html, "<p class=\"note\">{left_out} further rows are in the trace.</p>");
    }
    html.push_str("</section>\n");
    html
}

/// Returns a summary of the events between two plans: `4 obstacles (10.8 s lost)`, and so on; empty
/// if there are none.
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
        parts.push(format!("{}{lost}", crate::format::count(number, noun)));
    }
    parts.join(", ")
}

/// The time lost by all events, in words.
pub(super) fn lost(view: &View<'_>) -> String {
    seconds(view.events.iter().map(|event| event.lost_us).fold(0u64, u64::saturating_add) / 1000)
}
