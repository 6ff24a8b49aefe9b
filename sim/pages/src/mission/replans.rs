//! Replans explained: why, what changed, what it gave.

use super::MAX_PLANS;
use super::events::{capital, power_error, short, summary};
use super::view::View;
use crate::format::{metres, milli, moment, speed};
use cotama_core::text::markup;
use cotama_sim::story::Point;
use cotama_sim::trace::{Event, Margins, Plan, PlanRow};
use std::collections::HashMap;
use std::fmt::Write;

/// One card for each plan after the first, and one for a plan that was needed and is not there.
pub(super) fn section(view: &View<'_>) -> String {
    let mut html = String::from("<section class=\"replans\"><h2>Replans</h2>\n");
    if view.plans.len() < 2 && view.abort.is_none() {
        html.push_str("<p>There were none: the first plan held to the end.</p>\n");
    }
    for number in 1..view.plans.len().min(MAX_PLANS) {
        card(&mut html, view, number);
    }
    if view.plans.len() > MAX_PLANS {
        let further = view.plans.len() - MAX_PLANS;
        let _ = writeln!(html, "<p class=\"note\">{further} further replans are in the trace.</p>");
    }
    if let Some(abort) = view.abort {
        let _ = writeln!(
            html,
            "<article class=\"card\"><h3><b class=\"pin ask\">?</b>Mission aborted \
             <span class=\"where\">at {}, {}</span></h3>\n<p>A plan was needed ({}), and there is \
             none: {}. The robot stopped.</p></article>",
            metres(abort.x_mm),
            moment(abort.t_us),
            markup(&abort.cause),
            markup(&abort.reason)
        );
    }
    html.push_str("</section>\n");
    html
}

fn card(html: &mut String, view: &View<'_>, number: usize) {
    let (plan, before) = (view.plans[number], view.plans[number - 1]);
    let since = |event: &&&Event| event.t_us >= before.t_us && began(event) <= plan.t_us;
    let mut events: Vec<&Event> = view.events.iter().filter(since).copied().collect();
    // The causes of the plan before are not counted again.
    if number > 1 {
        events.retain(|event| event.t_us > before.t_us && began(event) != before.t_us);
    }
    let _ = write!(
        html,
        "<article class=\"card\"><h3><b class=\"pin\">{number}</b>{} <span class=\"where\">at {}, \
         {}, in {}</span>\
         </h3>\n<div class=\"pair\"><div>\n<p>{}</p>\n<h4>What changed</h4>\n{}</div>\n",
        markup(&capital(&plan.cause)),
        metres(plan.x_mm),
        moment(plan.t_us),
        markup(&plan.first_activity),
        markup(&if view.points.is_empty() {
            why(view, plan, number, &events)
        } else {
            failed(view, plan)
        }),
        changes(before, plan)
    );
    margins(html, plan, view.points.is_empty());
    html.push_str("</div></article>\n");
}

/// When an event began, which is recorded when it is over.
const fn began(event: &Event) -> u64 {
    event.t_us.saturating_sub(event.lost_us)
}

/// Which failure a plan of a supervised run goes back to.
fn failed(view: &View<'_>, plan: &Plan) -> String {
    let led = |it: &&Point<'_>| it.chain().is_some_and(|it| it.planned_us == Some(plan.t_us));
    let point = view.points.iter().find(led);
    point.map_or_else(
        || format!("Cause: {}.", plan.cause),
        |it| format!("Point {}, {}.", it.number, it.title()),
    )
}

/// Why a plan was made, in sentences.
fn why(view: &View<'_>, plan: &Plan, number: usize, events: &[&Event]) -> String {
    let old = number - 1;
    let below = |margins: &Margins, cause: &str| {
        let duration = cause.starts_with("duration");
        let (value, unit) =
            if duration { (margins.duration_ms, "s") } else { (margins.energy_mj, "J") };
        format!("{}\u{a0}{unit}", milli(value.into(), 1))
    };
    let mut text = match (&plan.before, plan.cause.as_str()) {
        (Some(margins), cause @ ("energy margin below zero" | "duration margin below zero")) => {
            let axis = cause.split(' ').next().unwrap_or("");
            format!("With plan {old}, the {axis} margin had come to {}.", below(margins, cause))
        }
        (_, cause) if cause.ends_with(" lost") => {
            format!("Plan {old} relied on hardware that no longer works: {cause}.")
        }
        (_, "room for a better plan") => {
            format!("The margins had grown since plan {old}, enough to look for a better one.")
        }
        (_, cause) => format!("Cause: {cause}."),
    };
    match events.last() {
        Some(last) if last.t_us > plan.t_us => {
            let _ = write!(text, " At that time, at {}: {}.", metres(last.x_mm), short(last).2);
        }
        Some(last) if last.t_us == plan.t_us => {
            let _ = write!(text, " Directly before, at {}: {}.", metres(last.x_mm), short(last).2);
        }
        Some(last) => {
            let _ = write!(
                text,
                " The last event before, at {}: {}.",
                metres(last.x_mm),
                short(last).2
            );
        }
        None => {
            let _ = write!(text, " Nothing else had happened since plan {old}.");
        }
    }
    if events.len() > 1 {
        let _ = write!(text, " Since plan {old} in all: {}.", summary(events));
    }
    let from_mm = view.plans.get(old).map_or(0, |it| it.x_mm);
    let errors = view.power_errors();
    let passed =
        errors.iter().filter(|it| it.0.x_start.0 < plan.x_mm && from_mm < it.0.x_end.0).take(6);
    let passed: Vec<String> = passed.map(power_error).collect();
    if !passed.is_empty() {
        let _ = write!(text, " Real power against the model since then: {}.", passed.join(", "));
    }
    text
}

/// A row's choice, with its speed if that changes too.
fn said(row: &PlanRow, with_speed: bool) -> String {
    if with_speed {
        format!("{} at {}", row.choice, speed(row.speed_mm_s))
    } else {
        row.choice.clone()
    }
}

/// Activities whose choice changed; neighbours with the same change together.
fn changes(before: &Plan, after: &Plan) -> String {
    let old: HashMap<&str, &PlanRow> =
        before.plan.iter().map(|row| (row.activity.as_str(), row)).collect();
    let mut groups: Vec<(Vec<&str>, String, String)> = Vec::new();
    let mut open = false;
    for row in &after.plan {
        let Some(was) = old.get(row.activity.as_str()) else { continue };
        let with_speed = was.speed_mm_s != row.speed_mm_s;
        if was.choice == row.choice && !with_speed {
            open = false;
            continue;
        }
        let (from, to) = (said(was, with_speed), said(row, with_speed));
        match groups.last_mut() {
            Some((ids, last_from, last_to)) if open && *last_from == from && *last_to == to => {
                ids.push(&row.activity);
            }
            _ => groups.push((vec![&row.activity], from, to)),
        }
        open = true;
    }
    if groups.is_empty() {
        return "<p>No choice: the same plan, from here.</p>".into();
    }
    let total = after.plan.len();
    let changed: usize = groups.iter().map(|group| group.0.len()).sum();
    let mut html = String::from("<ul class=\"changes\">");
    for (ids, from, to) in groups.iter().take(60) {
        let ids = match ids[..] {
            [only] => only.to_owned(),
            [first, .., last] => format!("{first}–{last}"),
            [] => String::new(),
        };
        let _ = write!(
            html,
            "<li><span class=\"id\">{}</span><s>{}</s><span aria-label=\"becomes\">→</span><b>{}\
             </b></li>",
            markup(&ids),
            markup(from),
            markup(to)
        );
    }
    if total == 1 {
        html.push_str("</ul>\n<p class=\"note\">The only remaining activity.</p>");
    } else {
        let _ = write!(
            html,
            "</ul>\n<p class=\"note\">{changed} of the {total} remaining activities.</p>"
        );
    }
    html
}

/// The margins before and after, and at the safe ends.
fn margins(html: &mut String, plan: &Plan, with_ends: bool) {
    html.push_str(
        "<table class=\"margins\"><thead><tr><th></th><th class=\"n\">Duration</th>\
         <th class=\"n\">Energy</th></tr></thead><tbody>\n",
    );
    let cell = |value: i64, unit: &str| {
        let class = if value < 0 { "n bad" } else { "n" };
        format!("<td class=\"{class}\">{}\u{a0}{unit}</td>", milli(value.into(), 1))
    };
    let mut row = |name: &str, class: &str, margins: Option<&Margins>| {
        let cells = margins.map_or(
            "<td class=\"n muted\" colspan=\"2\">no way with this hardware</td>".into(),
            |it| format!("{}{}", cell(it.duration_ms, "s"), cell(it.energy_mj, "J")),
        );
        let _ = writeln!(html, "<tr class=\"{class}\"><th>{name}</th>{cells}</tr>");
    };
    if let Some(before) = &plan.before {
        row("Margin before", "", Some(before));
    }
    row("Margin after", "strong", Some(&plan.after));
    if with_ends {
        row("At worst, on to the end", "", plan.return_margin.end.as_ref());
        row("At worst, back to the start", "", plan.return_margin.start.as_ref());
    }
    html.push_str("</tbody></table>\n");
}
