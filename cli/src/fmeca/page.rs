//! The FMECA as a page of its own: table, diagrams, diagnosability. No script, nothing from the
//! network.

use super::sheet;
use crate::answers::fmeca::{Diagnosability, FmecaAnswer, FmecaRow, StatusRow};
use crate::render::fmeca::{against, event, hours, seconds, shared, summary};
use cotama_verification::export::svg::escape;
use std::fmt::Write;

/// The page.
pub(crate) fn write(answer: &FmecaAnswer) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>FMECA of the delivery robot\
         </title>\n\
         <style>\n{}{}</style>\n</head>\n<body>\n<main>\n<h1>What can fail, and what is done</h1>\n\
         <p>Failure modes, effects and criticality of the delivery robot (COTAMA on a Pioneer \
         3-DX). {}.</p>\n\
         <nav><a href=\"#table\">Table</a> <a href=\"#diagrams\">Cause-effect diagrams</a> \
         <a href=\"#diagnosability\">What cannot be told apart</a></nav>\n",
        include_str!("page.css"),
        sheet::STYLE,
        escape(&summary(&answer.counts)),
    );
    table(&mut page, &answer.rows);
    diagrams(&mut page, answer);
    diagnosability(&mut page, &answer.diagnosability);
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

/// Writes into a page, which cannot fail.
macro_rules! put {
    ($page:expr, $($text:tt)*) => {{
        let _ = writeln!($page, $($text)*);
    }};
}

fn table(page: &mut String, rows: &[FmecaRow]) {
    page.push_str(
        "<section id=\"table\">\n<h2>Failure modes</h2>\n<p class=\"note\">Severity while the \
         robot drives itself, and while the operator drives. Rates are assumed unless they are \
         marked as stated.</p>\n<div class=\"scroll\"><table>\n\
         <thead><tr><th>Id<th>What fails<th>Cause and effect<th>Robot drives<th>Operator drives\
         <th>Seen by<th>Modules lost\
         <th>Reaction<th class=\"n\">MTBF</tr></thead>\n<tbody>\n",
    );
    for row in rows {
        let seen = match row.undetectable_reason {
            Some(reason) => format!("<b>undetectable</b>: {}", escape(reason)),
            None => format!(
                "{} <small>within {}: {}</small>",
                escape(row.observer),
                seconds(row.detection_latency_ms),
                escape(row.detection)
            ),
        };
        let severity = |name: &str| format!("<b class=\"pill {name}\">{name}</b>");
        let stated = if row.rate_label == "assumed" { "" } else { row.rate_label };
        put!(
            page,
            "<tr id=\"{id}\"><th scope=\"row\">{id}<td>{}: {} <small>{}; {}</small><td>{} <small>{}\
             </small>\
             <td>{}<td>{}<td>{seen}<td>{}<td>{} <small>{}</small><td class=\"n\">{} <small>{stated}\
             </small></tr>",
            escape(row.component),
            escape(row.failure),
            escape(row.function),
            row.persistence,
            escape(row.cause),
            escape(row.effect),
            severity(row.severity_autonomous),
            severity(row.severity_operator),
            escape(row.loss),
            escape(row.reaction),
            event(row),
            hours(row.mtbf_mh),
            id = row.id,
        );
    }
    page.push_str("</tbody>\n</table></div>\n</section>\n");
}

fn diagrams(page: &mut String, answer: &FmecaAnswer) {
    page.push_str(
        "<section id=\"diagrams\">\n<h2>Cause-effect diagrams</h2>\n<p class=\"note\">One a \
         function: which component takes it away, how, and why.</p>\n",
    );
    put!(page, "<figure>{}</figure>", sheet::legend_element());
    for diagram in &answer.diagrams {
        put!(page, "<figure>{}</figure>", sheet::element(diagram.function));
    }
    page.push_str("</section>\n");
}

fn diagnosability(page: &mut String, it: &Diagnosability) {
    page.push_str(
        "<section id=\"diagnosability\">\n<h2>What cannot be told apart</h2>\n<p class=\"note\">A \
         failure mode is a candidate when it explains the raised flags exactly. Where some flags \
         leave several candidates, the robot asks. A probe is an observation that could be added.\
         </p>\n",
    );
    for row in &it.statuses {
        status(page, row);
    }
    page.push_str(
        "<h3>Probes</h3>\n<div class=\"scroll\"><table>\n<thead><tr><th>Probe<th>Who \
        would observe what<th>Shows<th>Needs</tr></thead>\n<tbody>\n",
    );
    for probe in &it.probes {
        let needs =
            if probe.needs.is_empty() { "itself".to_owned() } else { probe.needs.join(" ") };
        put!(
            page,
            "<tr><th scope=\"row\">{}<td>{}<td>{}<td>{needs}</tr>",
            probe.name,
            escape(probe.doc),
            links(&probe.shows)
        );
    }
    page.push_str(
        "</tbody>\n</table></div>\n<h3>The ambiguous case: point 3 of the published run</h3>\n",
    );
    for paragraph in &it.ambiguous_case.text {
        put!(page, "<p>{}</p>", code(paragraph));
    }
    page.push_str("</section>\n");
}

fn status(page: &mut String, row: &StatusRow) {
    put!(page, "<h3>Status: {}</h3>", row.status);
    let without = match row.modules_unavailable.as_slice() {
        [] => "All modules are available.".to_owned(),
        modules => format!("Unavailable: {}.", modules.join(" ")),
    };
    let impossible = match row.impossible.as_slice() {
        [] => String::new(),
        modes => format!(" Cannot happen then: {}.", links(modes)),
    };
    put!(
        page,
        "<p>{without} {} failure modes are detected, {} are not.{impossible}</p>",
        row.detectable,
        row.undetectable.len()
    );
    page.push_str(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Alike<th>Shared flags\
        <th>Separated by</tr></thead>\n<tbody>\n",
    );
    for pair in &row.pairs {
        let probes =
            if pair.probes.is_empty() { "no probe".to_owned() } else { pair.probes.join(", or ") };
        put!(
            page,
            "<tr><th scope=\"row\">{}<td>{}<td>{probes}</tr>",
            links(&pair.shared.modes),
            shared(&pair.shared.flags, &pair.shared.flags_optional)
        );
    }
    put!(page, "</tbody>\n</table></div>\n<p>Least set: {}.</p>\n<dl>", against(row));
    for unseen in &row.undetectable {
        put!(
            page,
            "<div><dt>{} is not seen</dt><dd>{}</dd></div>",
            links(&[unseen.id]),
            code(&unseen.reason)
        );
    }
    page.push_str("</dl>\n");
}

fn links(ids: &[&str]) -> String {
    ids.iter().map(|id| format!("<a href=\"#{id}\">{id}</a>")).collect::<Vec<_>>().join(" ")
}

/// A text in which names stand between backquotes.
fn code(text: &str) -> String {
    let mut out = String::new();
    for (at, part) in text.split('`').enumerate() {
        let part = escape(part);
        if at % 2 == 1 {
            let _ = write!(out, "<code>{part}</code>");
        } else {
            out += &part;
        }
    }
    out
}
