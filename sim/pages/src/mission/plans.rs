//! All plans in one table: rows are plans, columns are activities, as in Tables 6 and 7 of Lambert
//! et al. 2024.

use super::events::capital;
use super::view::{View, families, family, tint};
use super::{MAX_CELLS, MAX_COLUMNS, MAX_PLANS};
use crate::format::{metres, trimmed};
use cotama_core::text::markup;
use cotama_models::missions::{Mission, Task, Tio};
use cotama_sim::trace::PlanRow;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write;

/// Returns the name of a task in words.
pub(super) fn task_name(task: Task) -> Cow<'static, str> {
    let name = match task {
        Task::Move => "move",
        Task::Turn => "turn",
        Task::Detect => "detect",
        Task::Localise => "localise",
        Task::Receive => "receive",
        Task::Deliver => "deliver",
        Task::Wait => "wait",
        Task::Own(it) => return Cow::Owned(it.name().to_ascii_lowercase()),
    };
    Cow::Borrowed(name)
}

/// The table and its legend.
pub(super) fn section(view: &View<'_>) -> String {
    let columns: Vec<&str> = match view.plans.first() {
        Some(plan) => plan.plan.iter().take(MAX_COLUMNS).map(|row| row.activity.as_str()).collect(),
        None => return String::new(),
    };
    let families = families(&view.plans);
    let most = MAX_PLANS.min(MAX_CELLS / columns.len().max(1)).max(1);
    // More columns than these are wider than a phone.
    let hint = if columns.len() > 5 {
        "<p class=\"note hint\">The table goes on to the right.</p>\n"
    } else {
        ""
    };
    let mut html = format!(
        "<section class=\"plans\"><h2>Plans</h2>\n<p class=\"note\">A row is a plan, a column an \
         activity. Each cell names the choice and its speed in m/s; a framed one differs from the \
         plan above. Activities that were done have no cell, so later plans begin further right.\
         </p>\n{hint}<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Plans\">\
         <table class=\"matrix\"><thead>\n<tr><th>Plan</th>",
    );
    for id in &columns {
        let _ = write!(html, "<th>{}</th>", markup(id));
    }
    html.push_str("</tr>\n");
    objectives(&mut html, view, columns.len());
    html.push_str("</thead><tbody>\n");
    let mut before: HashMap<&str, &PlanRow> = HashMap::new();
    for (number, plan) in view.plans.iter().enumerate().take(most) {
        let rows: HashMap<&str, &PlanRow> =
            plan.plan.iter().map(|row| (row.activity.as_str(), row)).collect();
        let _ = write!(
            html,
            "<tr><th title=\"{}\"><b class=\"pin\">{number}</b>{}</th>",
            markup(&plan.cause),
            metres(plan.x_mm)
        );
        for id in &columns {
            let Some(row) = rows.get(id) else {
                html.push_str("<td class=\"done\"></td>");
                continue;
            };
            let was = before
                .get(id)
                .filter(|was| was.choice != row.choice || was.speed_mm_s != row.speed_mm_s);
            let speed = if row.speed_mm_s == 0 { "–".into() } else { trimmed(row.speed_mm_s) };
            let (changed, title) = match was {
                Some(was) => (" changed", format!(" title=\"was {}\"", markup(&was.choice))),
                None => ("", String::new()),
            };
            let _ = write!(
                html,
                "<td class=\"{}{changed}\"{title}>{}<small>{speed}</small></td>",
                tint(&families, &row.choice),
                markup(&row.choice)
            );
        }
        html.push_str("</tr>\n");
        before = rows;
    }
    html.push_str("</tbody></table></div>\n");
    let hidden = view.plans.len().saturating_sub(most);
    if hidden > 0 || view.plans[0].plan.len() > columns.len() {
        let _ = writeln!(
            html,
            "<p class=\"note\">The table is cut: {hidden} further plans, {} further activities are \
             in the trace.</p>",
            view.plans[0].plan.len() - columns.len()
        );
    }
    legend(&mut html, view, &families);
    html.push_str("</section>\n");
    html
}

/// A row of objectives under that of activities, each over its activities.
fn objectives(html: &mut String, view: &View<'_>, columns: usize) {
    let Ok(mission) = &view.mission else { return };
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for activity in mission.scenario().activities.iter().take(columns) {
        match spans.last_mut() {
            Some((objective, span)) if *objective == activity.objective => *span += 1,
            _ => spans.push((activity.objective, 1)),
        }
    }
    html.push_str("<tr class=\"objectives\"><th></th>");
    for (objective, span) in spans {
        let id = mission.objectives.get(objective).map_or("", |it| it.id.as_str());
        let _ = write!(html, "<th colspan=\"{span}\">{}</th>", markup(id));
    }
    html.push_str("</tr>\n");
}

/// Returns the needs of an option: `sonar, 2 laser`.
pub(super) fn needs(tio: &Tio, mission: &Mission) -> String {
    let hardware = mission.hardware.iter().enumerate();
    let parts = hardware.filter_map(|(kind, hardware)| match tio.needs.of(kind) {
        0 => None,
        1 => Some(hardware.name.clone()),
        units => Some(format!("{units} {}", hardware.name)),
    });
    let parts: Vec<_> = parts.collect();
    if parts.is_empty() { "no hardware".into() } else { parts.join(", ") }
}

/// The options in use; those that lead with the colour of their family.
fn legend(html: &mut String, view: &View<'_>, families: &[&str]) {
    let Ok(mission) = &view.mission else { return };
    let mut used: Vec<&str> = families.to_vec();
    for row in view.plans.iter().take(MAX_PLANS).flat_map(|plan| &plan.plan) {
        for id in row.choice.split(' ') {
            if used.len() < 64 && !used.contains(&id) {
                used.push(id);
            }
        }
    }
    html.push_str("<ul class=\"legend\">");
    for id in used {
        let Some(tio) = mission.tios.iter().find(|tio| tio.id == id) else { continue };
        let class =
            if families.contains(&id) { tint(families, family(id)) } else { "plain".into() };
        let _ = write!(
            html,
            "<li><b class=\"{class}\">{}</b>{}: {}</li>",
            markup(id),
            capital(&task_name(tio.task)),
            markup(&needs(tio, mission))
        );
    }
    html.push_str("</ul>\n");
}
