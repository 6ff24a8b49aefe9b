//! A run as one page: what was planned, what happened, what changed and why.
//!
//! The table of plans follows Tables 6 and 7 of Lambert et al., J. Intell. Robot. Syst. 110, 2024.

use crate::format;
use crate::frame;
use cotama_core::text::markup;
use cotama_sim::trace::{Header, Trace};
use std::fmt::Write;
use view::View;

mod activities;
mod charts;
mod decisions;
mod events;
mod floor;
mod glossary;
mod headline;
mod lanes;
mod path_axis;
mod plans;
mod replans;
mod series;
mod sight;
mod story;
mod strip;
mod timeline;
mod view;

/// The most replans that are drawn.
const MAX_PINS: usize = 200;
/// The most plans that are explained and listed.
const MAX_PLANS: usize = 100;
/// The most zones and the most events that are drawn.
const MAX_MARKS: usize = 400;
/// The most points of a story that are drawn and listed.
const MAX_POINTS: usize = 60;
/// The most rows of a list.
const MAX_ROWS: usize = 500;
/// The most columns of the table of plans.
const MAX_COLUMNS: usize = 400;
/// The most cells of the table of plans.
const MAX_CELLS: usize = 20_000;
/// The most candidates that are listed with their costs.
const MAX_CANDIDATES: usize = 2_000;

/// Writes the report of a run as an HTML page.
///
/// Whatever the trace says is written as text. Parts that would make the page unwieldy are cut, and
/// the page says so. A mission that cannot be read leaves out what only it tells.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_pages::mission;
/// use cotama_sim::{options::Options, trace::Trace};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (trace, _) = Trace::record(&mission, &Options::default()).unwrap();
/// let page = mission::html(&trace);
/// assert!(page.contains("All 17 activities are done, within both limits, after 3 replans."));
/// ```
pub fn html(trace: &Trace) -> String {
    html_beside(trace, None)
}

/// The same beside the trace that was written to this file, which the page names as a word of a
/// command.
pub fn html_beside(trace: &Trace, written: Option<&str>) -> String {
    let view = View::new(trace);
    let mut page = headline::section(&view);
    page.push_str(&floor::section(&view));
    if view.points.is_empty() {
        page.push_str(&strip::section(&view));
        page.push_str(&charts::section(&view));
    } else {
        page.push_str(&timeline::section(&view));
        page.push_str(&decisions::section(&view));
    }
    page.push_str(&replans::section(&view));
    page.push_str(&plans::section(&view));
    page.push_str(&activities::section(&view));
    page.push_str(&events::section(&view));
    let glossary = glossary::section(&view, &page);
    page.push_str(&glossary);
    footer(&mut page, &trace.header, written);
    frame::page(&format!("{}: mission report", headline::name(&view)), &[], &page)
}

/// Returns the run on its floor, with a slider that moves the robot, as markup, and the style of
/// that; `None` for a run that has no floor. The run is in `RUN` there, for other scripts.
pub fn on_floor(trace: &Trace) -> Option<[String; 2]> {
    let view = View::new(trace);
    let drawn = floor::section(&view);
    (!drawn.is_empty()).then(|| [drawn, frame::FLOOR.to_owned()])
}

fn footer(page: &mut String, header: &Header, written: Option<&str>) {
    let options = &header.options;
    let upward = options.upward.map_or("never".into(), |it| {
        format!(
            "when a margin grew by {} or {}, with {} and {} left unspent",
            format::seconds(it.growth.duration_ms),
            format::joules(it.growth.energy_mj),
            format::seconds(it.reserve.duration_ms),
            format::joules(it.reserve.energy_mj)
        )
    });
    let rows = [
        ("Program", format!("cotama {}", header.version)),
        ("Trace", header.schema.clone()),
        ("Mission", format!("{}, whole in the trace", header.mission_source)),
        ("Seed", options.seed.to_string()),
        ("Faults", headline::faults(header)),
        ("Monitor period", format::seconds(options.monitor_period_ms)),
        ("Planner", options.allocator.words()),
        ("Better plans", upward),
    ];
    page.push_str("<footer><h2>How it was run</h2>\n<dl>\n");
    for (name, value) in rows {
        let _ = writeln!(page, "<div><dt>{name}</dt><dd>{}</dd></div>", markup(&value));
    }
    let again = match written {
        Some(file) => format!(
            "The same run again, compared record by record: <code>cotama replay {}</code>",
            markup(file)
        ),
        None => "No trace of this run was written. With <code>--trace run.jsonl</code> the same \
                 command writes one, which <code>cotama replay run.jsonl</code> runs again and \
                 compares record by record."
            .to_owned(),
    };
    let _ = write!(page, "</dl>\n<p>{again}</p>\n</footer>\n");
}
