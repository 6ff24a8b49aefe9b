//! The FMECA as a page of its own: table, diagrams, diagnosability. Nothing comes from the network;
//! a small script sorts and filters the rows, and without it all are there.

use super::glossary;
use super::matrix::{anchor, links, matrix};
use crate::answers::fmeca::{Diagnosability, FmecaAnswer, FmecaRow, StatusRow};
use crate::render::fmeca::{
    against, detected, heading, hours, left_out, seconds, sentence, shared, summary, worst,
};
use cotama_core::text::markup;
use cotama_models::fmeca::Analysis;
use cotama_models::robots::Robot;
use cotama_pages::causes;
use cotama_verification::drawing;
use std::fmt::{Display, Write};

/// Writes into a page, which cannot fail.
macro_rules! put {
    ($page:expr, $($text:tt)*) => {{
        let _ = writeln!($page, $($text)*);
    }};
}

/// The page.
pub(crate) fn write(
    analysis: &Analysis,
    robot: Option<&Robot>,
    answer: &FmecaAnswer<'_>,
) -> String {
    let (title, about) = (sentence(answer.title), "Failure modes, effects and criticality.");
    let mut page = format!(
        "<main>\n<h1>{}</h1>\n\
         <p>{about} {}.</p>\n<p>{}</p>\n\
         <nav><a href=\"#table\">Table</a> <a href=\"#matrix\">Criticality matrix</a> \
         <a href=\"#diagrams\">Cause-effect diagrams</a> \
         <a href=\"#diagnosability\">What cannot be told apart</a> \
         <a href=\"#abbreviations\">Abbreviations</a></nav>\n",
        markup(title.trim_end_matches('.')),
        markup(&summary(answer)),
        markup(&worst(&answer.rows)),
    );
    table(&mut page, answer);
    page.push_str(&matrix(&answer.rows, answer.period_h));
    diagrams(&mut page, analysis, answer);
    diagnosability(&mut page, &answer.diagnosability);
    let glossary = glossary::section(&page, robot);
    page.push_str(&glossary);
    put!(page, "</main>\n<script>\n{}</script>", include_str!("page.js"));
    let styles = [drawing::page::THEME, causes::STYLE, include_str!("page.css")];
    drawing::page::write(&heading(answer), &styles, &page)
}

/// An order of the rows: its name as an attribute, in words, and the number to sort by.
type Order = (&'static str, &'static str, fn(usize, &FmecaRow<'_>) -> u64);

/// The orders to choose from. The script sorts by any that stands here.
const ORDERS: [Order; 6] = [
    ("place", "as the functions follow", |at, _| at as u64),
    ("rpn", "the highest RPN first", |_, row| 1000 - u64::from(row.criticality.rpn)),
    ("critical", "the most critical class first", |_, row| {
        class(row) * 1000 + 1000 - u64::from(row.criticality.rpn)
    }),
    ("severity", "the most severe first", |_, row| severity(row)),
    ("interval", "the most frequent first", |_, row| row.mtbf_mh),
    ("latency", "the slowest to be seen first", |_, row| {
        (u32::MAX - row.detection_latency_ms).into()
    }),
];

/// The worse of both severities: 0 is fatal, 3 is weak.
fn severity(row: &FmecaRow<'_>) -> u64 {
    let both = [Some(row.severity_autonomous), row.severity_operator];
    let rank = |it| SEVERITIES.iter().position(|severity| *severity == it);
    both.into_iter().flatten().filter_map(rank).min().unwrap_or(SEVERITIES.len()) as u64
}

/// The class of criticality: 0 is intolerable, 3 is negligible.
fn class(row: &FmecaRow<'_>) -> u64 {
    let found = CLASSES.iter().position(|it| *it == row.criticality.class);
    found.unwrap_or(CLASSES.len()) as u64
}

const SEVERITIES: [&str; 4] = ["fatal", "hard", "medium", "weak"];
const CLASSES: [&str; 4] = ["intolerable", "undesirable", "tolerable", "negligible"];

/// The form that the script acts on; it stays hidden without.
fn pick(page: &mut String, example: &str) {
    put!(
        page,
        "<form id=\"pick\" hidden><label>Filter <input name=\"words\" type=\"search\" \
         placeholder=\"as: {example}\"></label>"
    );
    for (label, name, words) in
        [("Severity", "severity", SEVERITIES), ("Criticality", "class", CLASSES)]
    {
        let _ = write!(page, "<label>{label} <select name=\"{name}\">");
        for (least, name) in words.iter().rev().enumerate() {
            let words = if least == 0 { "any" } else { name };
            let more = if least == 0 || least == 3 { "" } else { " or worse" };
            let _ = write!(page, "<option value=\"{}\">{words}{more}</option>", least + 1);
        }
        page.push_str("</select></label>\n");
    }
    page.push_str("<label>Order <select name=\"order\">");
    for (name, words, _) in ORDERS {
        let _ = write!(page, "<option value=\"{name}\">{words}</option>");
    }
    page.push_str("</select></label>\n<output></output></form>\n");
}

/// A column behind the id: its name, its class, and what stands in it. On a narrow screen a row is
/// a card, and each cell says its column.
type Column = (&'static str, &'static str, fn(&FmecaRow<'_>) -> String);

/// The columns; what no row says has none.
fn columns(answer: &FmecaAnswer<'_>) -> Vec<Column> {
    let both = answer.rows.iter().any(|it| it.severity_operator.is_some());
    let lost = answer.rows.iter().any(|it| !it.loss.is_empty());
    let mut columns: Vec<Column> = vec![
        ("What fails", "wide", |row| {
            let stays = row.persistence.map_or_else(String::new, |it| format!("; {it}"));
            with(
                format!("{}: {}", markup(row.component), markup(row.failure)),
                format!("{}{stays}", markup(row.function)),
            )
        }),
        ("Cause and effect", "wide", |row| with(markup(row.cause), markup(row.effect))),
        (if both { "Robot drives" } else { "Severity" }, "", |row| pill(row.severity_autonomous)),
    ];
    if both {
        columns.push(("Operator drives", "", |row| {
            row.severity_operator.map_or_else(String::new, pill)
        }));
    }
    columns.push(("Seen by", "wide", seen));
    if lost {
        columns.push(("Lost", "", |row| markup(row.loss)));
    }
    columns.push(("Reaction", "wide", |row| with(markup(row.reaction), markup(&row.event))));
    columns.push(("MTBF", "n", |row| {
        let stated = if row.rate_label == "assumed" { "" } else { row.rate_label };
        with(hours(row.mtbf_mh), stated.to_owned())
    }));
    columns.push(("RPN", "n", |row| {
        let it = row.criticality;
        let ranks = format!("{} · {} · {}", it.severity, it.occurrence, it.detection);
        let measured = it.measured.map_or_else(String::new, |by| {
            format!("; by runs {}, with D {}", by.rpn, by.detection)
        });
        with(format!("<b>{}</b>", it.rpn), ranks + &measured)
    }));
    columns.push(("AP", "", |row| {
        let it = row.criticality;
        let measured =
            it.measured.map_or_else(String::new, |by| format!("by runs {}", by.action_priority));
        with(format!("<b>{}</b>", it.action_priority), measured)
    }));
    columns.push(("Criticality", "", |row| {
        let it = row.criticality;
        with(pill(it.class), format!("{}, {}", it.severity_class, it.occurrence_class))
    }));
    columns
}

fn with(text: impl Display, small: impl Display) -> String {
    format!("{text} <small>{small}</small>")
}

fn pill(name: &str) -> String {
    format!("<b class=\"pill {name}\">{name}</b>")
}

fn seen(row: &FmecaRow<'_>) -> String {
    match row.undetectable_reason {
        Some(reason) => format!("<b>undetectable</b>: {}", markup(reason)),
        None if row.flags_always.is_empty() => match row.flags_sometimes.as_slice() {
            [] => "<b>not detected</b>, and no reason is stated".to_owned(),
            flags => format!("<b>not always</b>: {}", markup(&flags.join(", "))),
        },
        None => {
            let flags = row.flags_always.join(", ");
            let by = if row.observer.is_empty() { &flags } else { row.observer };
            let how = if row.detection.is_empty() { &flags } else { row.detection };
            let within = format!("within {}: {}", seconds(row.detection_latency_ms), markup(how));
            with(markup(by), within)
        }
    }
}

fn table(page: &mut String, answer: &FmecaAnswer<'_>) {
    let columns = columns(answer);
    let both = if columns.iter().any(|it| it.0 == "Operator drives") {
        "Severity while the robot drives itself, and while the operator drives. "
    } else {
        ""
    };
    put!(
        page,
        "<section id=\"table\">\n<h2>Failure modes</h2>\n<p class=\"note\">{both}Rates are \
         assumed unless they are marked as stated. The RPN is the product of three ranks from 1 \
         to 10, which stand below it: severity (S, the worse where there are two), occurrence (O) \
         and detection (D). The Action Priority (AP) is high, medium or low by a table of \
         these three ranks.</p>"
    );
    pick(page, "a component or a cause");
    page.push_str("<div class=\"scroll\"><table>\n<thead><tr><th>Id");
    let attribute = |class: &str| {
        if class.is_empty() { class.to_owned() } else { format!(" class=\"{class}\"") }
    };
    for (column, class, _) in &columns {
        let _ = write!(page, "<th{}>{column}", attribute(class));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for (at, row) in answer.rows.iter().enumerate() {
        let mut keys = format!(" data-class=\"{}\"", class(row));
        for (name, _, key) in ORDERS {
            // Writing to a string cannot fail.
            let _ = write!(keys, " data-{name}=\"{}\"", key(at, row));
        }
        let (anchor, id) = (anchor(row.id), row.id);
        let _ = write!(page, "<tr id=\"{anchor}\"{keys}><th scope=\"row\">{id}");
        for (column, class, cell) in &columns {
            let (class, cell) = (attribute(class), cell(row));
            let _ = write!(page, "<td{class} data-column=\"{column}\"><span>{cell}</span>");
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table></div>\n</section>\n");
}

fn diagrams(page: &mut String, analysis: &Analysis, answer: &FmecaAnswer<'_>) {
    page.push_str(
        "<section id=\"diagrams\">\n<h2>Cause-effect diagrams</h2>\n<p class=\"note\">One a \
         function: which component takes it away, how, and why.</p>\n",
    );
    put!(page, "<figure>{}</figure>", causes::legend(analysis));
    for diagram in &answer.diagrams {
        put!(page, "<figure>{}</figure>", causes::element(analysis, diagram.function));
    }
    page.push_str("</section>\n");
}

fn diagnosability(page: &mut String, it: &Diagnosability<'_>) {
    put!(
        page,
        "<section id=\"diagnosability\">\n<h2>What cannot be told apart</h2>\n\
         <p class=\"note\">A failure mode is a candidate when it explains the raised flags \
         exactly. Where some flags leave several candidates, all are
         taken to be there. A probe is an observation that \
         could be added.</p>"
    );
    for row in &it.statuses {
        status(page, row, it.statuses.len() > 1, it.probes.is_empty());
    }
    probes(page, it);
    page.push_str("</section>\n");
}

fn probes(page: &mut String, it: &Diagnosability<'_>) {
    if it.probes.is_empty() {
        return;
    }
    put!(
        page,
        "<h3>Probes</h3>\n<div class=\"scroll\"><table>\n<thead><tr><th>Probe<th>Who \
         would observe what<th>Shows</tr></thead>\n<tbody>"
    );
    for probe in &it.probes {
        put!(
            page,
            "<tr><th scope=\"row\">{}<td>{}<td>{}</tr>",
            markup(probe.name),
            markup(probe.doc),
            links(&probe.shows)
        );
    }
    page.push_str("</tbody>\n</table></div>\n");
}

fn status(page: &mut String, row: &StatusRow<'_>, several: bool, no_probes: bool) {
    let mut said = String::new();
    if several {
        put!(page, "<h3>Status: {}</h3>", row.status);
        said = match row.modules_unavailable.as_slice() {
            [] => "All modules are available. ".to_owned(),
            modules => format!("Unavailable: {}. ", modules.join(" ")),
        };
    }
    let impossible = match row.impossible.as_slice() {
        [] => String::new(),
        modes => format!(" Cannot happen then: {}.", links(modes)),
    };
    put!(page, "<p>{said}{}.{impossible}</p>", detected(row));
    if !row.pairs.is_empty() {
        let head = if no_probes { "" } else { "<th>Separated by" };
        put!(
            page,
            "<div class=\"scroll\"><table>\n<thead><tr><th>Alike<th>Shared flags{head}</tr>\
             </thead>\n<tbody>"
        );
        for pair in &row.pairs {
            let probes = match pair.probes.as_slice() {
                _ if no_probes => String::new(),
                [] => "<td>no probe".to_owned(),
                probes => format!("<td>{}", markup(&probes.join(", or "))),
            };
            put!(
                page,
                "<tr><th scope=\"row\">{}<td>{}{probes}</tr>",
                links(&pair.shared.modes),
                markup(&shared(&pair.shared.flags, &pair.shared.flags_optional)),
            );
        }
        page.push_str("</tbody>\n</table></div>\n");
    }
    if let Some(more) = left_out(row) {
        put!(page, "<p>{}.</p>", more);
    }
    if !no_probes {
        put!(page, "<p>Least set: {}.</p>", markup(&against(row)));
    }
    page.push_str("<dl>\n");
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

/// A text in which names stand between backquotes.
fn code(text: &str) -> String {
    let mut out = String::new();
    for (at, part) in text.split('`').enumerate() {
        let part = markup(part);
        if at % 2 == 1 {
            let _ = write!(out, "<code>{part}</code>");
        } else {
            out += &part;
        }
    }
    out
}
