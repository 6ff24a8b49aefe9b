//! The criticality matrix of the page: severity against occurrence, with the failure modes of each
//! field.

use crate::answers::fmeca::FmecaRow;
use cotama_models::fmeca::{CriticalityClass, OccurrenceClass, SeverityClass};
use std::fmt::Write;

/// The section of the page.
pub(super) fn matrix(rows: &[FmecaRow<'_>], period_h: u32) -> String {
    let mut html = format!(
        "<section id=\"matrix\">\n<h2>Criticality matrix</h2>\n<p class=\"note\">Severity \
         (across) against occurrence: how many failures are expected in {period_h} hours of \
         operation.</p>\n<div class=\"scroll\"><table class=\"matrix\">\n<thead><tr><td>"
    );
    for severity in SeverityClass::ALL {
        let _ = write!(html, "<th scope=\"col\">{}", severity.name());
    }
    html.push_str("</tr></thead>\n<tbody>\n");
    for occurrence in OccurrenceClass::ALL.iter().rev() {
        let (name, from) = (occurrence.name(), from(*occurrence));
        let _ = write!(html, "<tr><th scope=\"row\">{name} <small>{from}</small>");
        for severity in SeverityClass::ALL {
            let class = CriticalityClass::of(*occurrence, *severity).name();
            let is_here = |it: &&FmecaRow<'_>| {
                it.criticality.occurrence_class == name
                    && it.criticality.severity_class == severity.name()
            };
            let here: Vec<_> = rows.iter().filter(is_here).map(|it| it.id).collect();
            let none = if here.is_empty() { " none" } else { "" };
            let _ = write!(
                html,
                "<td class=\"{class}{none}\" data-column=\"{}\"><span>{} <small>{class}</small>\
                 </span>",
                severity.name(),
                links(&here)
            );
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table></div>\n</section>\n");
    html
}

/// The bound of a class.
const fn from(occurrence: OccurrenceClass) -> &'static str {
    match occurrence {
        OccurrenceClass::Frequent => "0.2 and more",
        OccurrenceClass::Probable => "from 0.1",
        OccurrenceClass::Occasional => "from 0.01",
        OccurrenceClass::Remote => "from 0.001",
        OccurrenceClass::Improbable => "below 0.001",
    }
}

/// Links to rows of the table.
pub(super) fn links(ids: &[&str]) -> String {
    let link = |id: &&str| format!("<a href=\"#{}\">{id}</a>", anchor(id));
    ids.iter().map(link).collect::<Vec<_>>().join(" ")
}

/// Returns the anchor of a failure mode's row in the page; its parts have names of their own.
pub(super) fn anchor(id: &str) -> String {
    let taken = ["table", "matrix", "diagrams", "diagnosability", "abbreviations", "pick"];
    // No id has a colon.
    if taken.contains(&id) { format!("row:{id}") } else { id.to_owned() }
}
