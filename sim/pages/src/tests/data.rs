//! All that a page says, in golden files: its text, row by row. Of one page of a mission and of one
//! of a team also what is drawn, with its places.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-pages --lib` writes them anew.

use super::{delivery_under, failures, html, patrol_under, recorded};
use crate::team;
use cotama_core::units::Millis;
use cotama_models::missions::embedded;
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::story::Rung;
use cotama_sim::trace::Record;
use std::path::Path;

/// The value of an attribute of a tag.
fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    let rest = tag.split_once(&format!(" {name}=\""))?.1;
    rest.split_once('"').map(|it| it.0)
}

/// A drawn element: its kind, its class, and the numbers that place it.
fn drawn(tag: &str) -> Option<String> {
    let kind = tag.split(' ').next()?;
    let places: &[&str] = match kind {
        "rect" => &["x", "y", "width", "height"],
        "circle" => &["cx", "cy", "r"],
        "path" => &["d"],
        "text" => &["x", "y"],
        _ => return None,
    };
    let places: Vec<&str> = places.iter().filter_map(|it| attribute(tag, it)).collect();
    Some(format!("{kind} {}: {}", attribute(tag, "class").unwrap_or(""), places.join(" ")))
}

/// Returns the text of a page: a line for each paragraph, row or drawn thing. Drawings for narrow
/// screens repeat those for wide ones, and the glossary has tests of its own; both are left out,
/// and the activities, unless they are wanted.
fn said(page: &str, activities: bool) -> String {
    const LINES: [&str; 20] = [
        "p",
        "h1",
        "h2",
        "h3",
        "h4",
        "li",
        "tr",
        "div",
        "summary",
        "section",
        "dt",
        "dd",
        "svg",
        "title",
        "text",
        "table",
        "article",
        "figcaption",
        "rect",
        "circle",
    ];
    let mut rest = page.split_once("<body>").unwrap().1;
    let (mut lines, mut line) = (Vec::new(), String::new());
    while let Some((text, after)) = rest.split_once('<') {
        line += text;
        let (tag, after) = after.split_once('>').unwrap();
        rest = after;
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        if matches!(tag, "script" | "style") {
            rest = rest.split_once(&format!("</{tag}>")).unwrap().1;
        }
        // The floor is drawn by its own crate.
        let hidden =
            [("svg", "narrow"), ("svg", "glyph"), ("svg", "floor"), ("section", "glossary")];
        let activities = (!activities).then_some(("section", "activities"));
        if let Some((hidden, _)) = hidden
            .into_iter()
            .chain(activities)
            .find(|it| tag.starts_with(it.0) && attribute(tag, "class") == Some(it.1))
        {
            rest = rest.split_once(&format!("</{hidden}>")).unwrap().1;
        }
        if LINES.contains(&name) {
            lines.push(std::mem::take(&mut line));
        }
        if matches!(tag, "/td" | "/th" | "/span") {
            line += " | ";
        }
        match drawn(tag) {
            Some(it) if name == "text" => line = it + " ",
            Some(it) => lines.push(it),
            None => line += attribute(tag, "style").unwrap_or(""),
        }
        line += attribute(tag, "title").unwrap_or("");
    }
    let clean = |it: String| {
        let it = it.replace(['\u{a0}', '\u{202f}', '\n'], " ");
        it.trim().trim_end_matches(" |").trim().to_owned()
    };
    let lines = lines.into_iter().map(clean).filter(|it| !it.is_empty() && it != "|");
    let text = lines.map(|it| it + "\n").collect::<String>();
    text.replace(&format!("cotama {}", env!("CARGO_PKG_VERSION")), "cotama VERSION")
}

/// Pages of which a golden file has the places of what is drawn, too.
const WITH_PLACES: [&str; 2] = ["delivery_ended.txt", "service.txt"];

fn golden(name: &str, page: &str) {
    let said = said(page, false);
    let is_place = |it: &&str| {
        let kind = it.split(' ').next().unwrap_or_default();
        ["rect", "circle", "path", "text"].contains(&kind) && it.contains(": ")
    };
    let kept = said.lines().filter(|it| WITH_PLACES.contains(&name) || !is_place(it));
    let text: String = kept.flat_map(|it| [it, "\n"]).collect();
    cotama_golden::compare(Path::new("tests/golden").join(name), &text);
}

#[test]
fn the_report_of_the_patrol_has_its_golden_text() {
    let options = Options { monitor_period: Some(Millis(30_000)), ..Options::default() };
    let text = embedded::mission("patrol").unwrap().text;
    let page = html(&recorded(text, &options));
    golden("patrol.txt", &page);
    let said = said(&page, true);
    assert_eq!(said.matches("Candidate | Speed | Power | Duration | Energy | Quality").count(), 17);
    for line in [
        "A3 | O1 move + localise | 34.0 – 37.0 m | 0.33 m/s | 4 of 21 | M5 L2",
        "M2 L2 | 0.33 m/s | 13.01 W | 9.1 s | 118.3 J | 300",
        "M5 L2 chosen | 0.33 m/s | 17.41 W | 9.1 s | 158.3 J | 360",
        "8 dropped: zone valve1-approach requires the option L2",
        "M1 L1, M1 L3, M2 L1, M2 L3, M5 L1, M5 L3, M6 L1, M6 L3",
        "A4 | O2 turn + localise | at 37.0 m | standing | 3 | T1 L2",
        "T1 L1 | – | 7.50 W | 8.0 s | 60.0 J | 0",
        "A8 | O5 move + localise | 41.0 – 63.5 m | 0.41 m/s | 21 | M5 L2",
        "No constraint excludes a candidate.",
    ] {
        assert!(said.lines().any(|it| it == line), "{line}");
    }
}

/// All kinds of events, an upward margin, and a limit that is passed.
#[test]
fn the_report_of_a_patrol_that_fails_has_its_golden_text() {
    let body = "power_error_permille = { \"H1-out\" = -100, H2 = -100 }
        event = [{ x_mm = 20000, kind = \"fault\", hardware = \"laser\", units_lost = 2 },
        { x_mm = 30000, kind = \"odometry\", extra_mm = 2500 },
        { x_mm = 60000, kind = \"repair\", hardware = \"laser\", units_back = 1 },
        { x_mm = 187000, kind = \"obstacle\", delay_ms = 94000 }]";
    golden("patrol_failed.txt", &html(&patrol_under(body)));
}

#[test]
fn the_report_of_the_delivery_has_its_golden_text() {
    golden("delivery.txt", &html(&delivery_under(FaultChoice::Script)));
    golden("delivery_ended.txt", &html(&delivery_under(failures(&["BAT2"]))));
    // The laptop hangs, and nobody is left to find that.
    let hung = said(&html(&delivery_under(failures(&["SW3"]))), false);
    assert!(hung.contains("\n1, 0 found\n") && hung.contains("Nobody noticed 1 of them."));
}

/// Traces may be of other programs: the same choice at another speed is a change.
#[test]
fn a_change_of_speed_alone_is_a_change() {
    let mut trace = super::patrol();
    let plans = trace.records.iter_mut().filter_map(|it| match it {
        Record::Plan(it) => Some(it),
        _ => None,
    });
    plans.skip(1).for_each(|it| it.plan[0].speed_mm_s += 90);
    let said = said(&html(&trace), false);
    assert!(said.contains("A8 | M5 L2 at 0.41 m/s→ | M5 L2 at 0.5 m/s"), "{said}");
}

/// A person in the way: a setting slows the robot down, and nothing else.
#[test]
fn a_person_in_the_way_is_told_as_a_setting() {
    let trace = delivery_under(failures(&["HUM1"]));
    let points = cotama_sim::story::points(&trace.records);
    let point = points.iter().find(|it| it.chain().is_some()).unwrap();
    assert!(point.chain().unwrap().decision.is_none());
    assert_eq!(point.rungs(), [Rung::Parameter]);
    let said = said(&html(&trace), false);
    for line in [
        "1 failure on the way: at 5.0 m, HUM1: people, person steps in the way.",
        "A setting was changed after HUM1.",
        "Parameter |  | 50 % of the speed",
    ] {
        assert!(said.lines().any(|it| it == line), "{line}\n{said}");
    }
}

#[test]
fn the_report_of_a_team_has_its_golden_text() {
    let options = ServiceOptions { disturbances: true, ..ServiceOptions::default() };
    let trace = cotama_sim::fleet::trace::Trace::of(&service(&options));
    golden("service.txt", &team::html(&trace));
    let options = FleetOptions { robots: 6, tasks: 8, failures: 2, ..FleetOptions::default() };
    let trace = cotama_sim::fleet::trace::Trace::of(&fleet(&options));
    golden("fleet.txt", &team::html(&trace));
}
