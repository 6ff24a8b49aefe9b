//! The FMECA as a page of its own: table, diagrams, diagnosability. Nothing comes from the network;
//! a small script sorts and filters the rows, and without it all are there.

use super::{glossary, sheet};
use crate::answers::fmeca::{Diagnosability, FmecaAnswer, FmecaRow, StatusRow};
use crate::render::fmeca::{against, event, hours, seconds, shared, summary};
use cotama_verification::export::svg::escape;
use std::fmt::Write;

/// Writes into a page, which cannot fail.
macro_rules! put {
    ($page:expr, $($text:tt)*) => {{
        let _ = writeln!($page, $($text)*);
    }};
}

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
         <a href=\"#diagnosability\">What cannot be told apart</a> \
         <a href=\"#abbreviations\">Abbreviations</a></nav>\n",
        include_str!("page.css"),
        sheet::STYLE,
        escape(&summary(&answer.counts)),
    );
    table(&mut page, &answer.rows);
    diagrams(&mut page, answer);
    diagnosability(&mut page, &answer.diagnosability);
    let body = page.find("<body>").unwrap_or_default();
    let glossary = glossary::section(&page[body..]);
    page.push_str(&glossary);
    put!(page, "</main>\n<script>\n{}</script>\n</body>\n</html>", include_str!("page.js"));
    page
}

/// An order of the rows: its name as an attribute, in words, and the number to sort by.
type Order = (&'static str, &'static str, fn(usize, &FmecaRow) -> u64);

/// The orders to choose from. The script sorts by any that stands here.
const ORDERS: [Order; 4] = [
    ("place", "as the functions follow", |at, _| at as u64),
    ("severity", "the most severe first", |_, row| severity(row)),
    ("interval", "the most frequent first", |_, row| row.mtbf_mh.into()),
    ("latency", "the slowest to be seen first", |_, row| {
        (u32::MAX - row.detection_latency_ms).into()
    }),
];

/// The worse of both severities: 0 is fatal, 3 is weak.
fn severity(row: &FmecaRow) -> u64 {
    let both = [row.severity_autonomous, row.severity_operator];
    let rank = |it| SEVERITIES.iter().position(|severity| *severity == it);
    both.into_iter().filter_map(rank).min().unwrap_or(SEVERITIES.len()) as u64
}

const SEVERITIES: [&str; 4] = ["fatal", "hard", "medium", "weak"];

/// The form that the script acts on; it stays hidden without.
fn pick(page: &mut String) {
    page.push_str(
        "<form id=\"pick\" hidden><label>Filter <input name=\"words\" type=\"search\" \
         placeholder=\"as: sonar, global event\"></label>\n<label>Severity \
         <select name=\"severity\">",
    );
    for (least, name) in SEVERITIES.iter().rev().enumerate() {
        let words = if *name == "weak" { "any" } else { name };
        let more = if least == 0 || *name == "fatal" { "" } else { " or worse" };
        let _ = write!(page, "<option value=\"{}\">{words}{more}</option>", least + 1);
    }
    page.push_str("</select></label>\n<label>Order <select name=\"order\">");
    for (name, words, _) in ORDERS {
        let _ = write!(page, "<option value=\"{name}\">{words}</option>");
    }
    page.push_str("</select></label>\n<output></output></form>\n");
}

/// The columns behind the id. On a narrow screen a row is a card, and each cell says its column.
const COLUMNS: [&str; 8] = [
    "What fails",
    "Cause and effect",
    "Robot drives",
    "Operator drives",
    "Seen by",
    "Modules lost",
    "Reaction",
    "MTBF",
];

fn table(page: &mut String, rows: &[FmecaRow]) {
    page.push_str(
        "<section id=\"table\">\n<h2>Failure modes</h2>\n<p class=\"note\">Severity while the \
         robot drives itself, and while the operator drives. Rates are assumed unless they are \
         marked as stated.</p>\n",
    );
    pick(page);
    page.push_str("<div class=\"scroll\"><table>\n<thead><tr><th>Id");
    for column in COLUMNS {
        let class = if column == "MTBF" { " class=\"n\"" } else { "" };
        let _ = write!(page, "<th{class}>{column}");
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for (at, row) in rows.iter().enumerate() {
        let mut keys = String::new();
        for (name, _, key) in ORDERS {
            // Writing to a string cannot fail.
            let _ = write!(keys, " data-{name}=\"{}\"", key(at, row));
        }
        let _ = write!(page, "<tr id=\"{id}\"{keys}><th scope=\"row\">{id}", id = row.id);
        for (column, cell) in COLUMNS.iter().zip(cells(row)) {
            let class = if *column == "MTBF" { " class=\"n\"" } else { "" };
            let _ = write!(page, "<td{class} data-column=\"{column}\"><span>{cell}</span>");
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table></div>\n</section>\n");
}

/// The cells of a row, in the order of [`COLUMNS`].
fn cells(row: &FmecaRow) -> [String; 8] {
    let seen = match row.undetectable_reason {
        Some(reason) => format!("<b>undetectable</b>: {}", escape(reason)),
        None => format!(
            "{} <small>within {}: {}</small>",
            escape(row.observer),
            seconds(row.detection_latency_ms),
            escape(row.detection)
        ),
    };
    let pill = |name: &str| format!("<b class=\"pill {name}\">{name}</b>");
    let with = |text: String, small: String| format!("{text} <small>{small}</small>");
    let stated = if row.rate_label == "assumed" { "" } else { row.rate_label };
    [
        with(
            format!("{}: {}", escape(row.component), escape(row.failure)),
            format!("{}; {}", escape(row.function), row.persistence),
        ),
        with(escape(row.cause), escape(row.effect)),
        pill(row.severity_autonomous),
        pill(row.severity_operator),
        seen,
        escape(row.loss),
        with(escape(row.reaction), event(row)),
        with(hours(row.mtbf_mh), stated.to_owned()),
    ]
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
