//! Activities and their candidates: what was possible, what constraints excluded, what was chosen.

use super::view::{Step, View};
use super::{MAX_CANDIDATES, MAX_ROWS};
use crate::format::{joules, metres, milli, seconds, speed};
use cotama_core::text::markup;
use cotama_models::missions::{Mission, PlannedActivity};
use std::collections::HashMap;
use std::fmt::Write;

/// One row for each activity, which opens to its candidates.
pub(super) fn section(view: &View<'_>) -> String {
    let mission = match &view.mission {
        Ok(mission) => mission,
        Err(problem) => {
            return format!(
                "<section class=\"activities\"><h2>Activities</h2><p class=\"bad\">The mission in \
                 the trace's header cannot be read, so candidates are not known: {}</p>\
                 </section>\n",
                markup(problem)
            );
        }
    };
    let chosen = chosen(view);
    let mut html =
        String::from("<section class=\"activities\"><h2>Activities and candidates</h2>\n");
    let combinations = mission
        .scenario()
        .combinations()
        .map_or("more than 3.4 × 10³⁸".into(), crate::format::grouped);
    let _ = write!(
        html,
        "<p class=\"note\">Candidates are the products of the options of an activity’s tasks; \
         constraints of zones exclude some. What is left allows {combinations} plans. Open a row \
         to see its candidates.</p>\n\
         <div class=\"row head\" aria-hidden=\"true\"><span>Activity</span><span>Objective</span>\
         <span>From – to</span>\
         <span>Speed limit</span><span>Candidates</span><span>Chosen</span></div>\n",
    );
    let mut budget = MAX_CANDIDATES;
    for (step, activity) in
        view.activities.iter().zip(&mission.scenario().activities).take(MAX_ROWS)
    {
        let choices = chosen.get(step.id.as_str()).map_or(&[][..], Vec::as_slice);
        row(&mut html, mission, step, activity, choices, &mut budget);
    }
    let hidden = view.activities.len().saturating_sub(MAX_ROWS);
    if hidden > 0 {
        let _ =
            writeln!(html, "<p class=\"note\">{hidden} further activities are in the mission.</p>");
    }
    html.push_str("</section>\n");
    html
}

/// The choices of each activity, plan after plan, without repetition.
fn chosen<'t>(view: &View<'t>) -> HashMap<&'t str, Vec<&'t str>> {
    let mut chosen: HashMap<&str, Vec<&str>> = HashMap::new();
    for row in view.plans.iter().flat_map(|plan| &plan.plan) {
        let choices = chosen.entry(&row.activity).or_default();
        if choices.last() != Some(&row.choice.as_str()) {
            choices.push(&row.choice);
        }
    }
    chosen
}

fn row(
    html: &mut String,
    mission: &Mission,
    step: &Step,
    activity: &PlannedActivity,
    choices: &[&str],
    budget: &mut usize,
) {
    let objective = mission.objectives.get(activity.objective);
    let tasks = objective.map_or(Vec::new(), |it| {
        it.tasks.iter().map(|task| super::plans::task_name(*task)).collect()
    });
    let range = if step.travels() {
        format!("{} – {}", milli(step.x_start_mm.into(), 1), metres(step.x_end_mm))
    } else {
        format!("at {}", metres(step.x_start_mm))
    };
    let limit = if step.travels() { speed(activity.speed_max.0) } else { "standing".into() };
    let (kept, all) = (activity.alternatives.len(), activity.unconstrained());
    let candidates = if kept == all { kept.to_string() } else { format!("{kept} of {all}") };
    let last = choices.last().copied().unwrap_or("–");
    let earlier: String = choices
        .iter()
        .rev()
        .skip(1)
        .take(6)
        .rev()
        .fold(String::new(), |text, choice| format!("{text}<s>{}</s> → ", markup(choice)));
    let unstarted = if step.started { "" } else { " <em>not started</em>" };
    let _ = write!(
        html,
        "<details><summary class=\"row\"><span class=\"id\">{}</span><span>{} <small>{}</small>\
         </span>\
         <span class=\"n\">{range}</span><span class=\"n\">{limit}</span>\
         <span class=\"n\">{candidates}</span>\
         <span>{earlier}<b>{}</b>{unstarted}</span></summary>\n<div class=\"inside\">\n",
        markup(&step.id),
        markup(objective.map_or("", |it| it.id.as_str())),
        tasks.join(" + "),
        markup(last)
    );
    if *budget > kept {
        *budget -= kept;
        table(html, activity, last);
    } else {
        let _ = writeln!(html, "<p>Kept: {}</p>", markup(&activity.labels.join(", ")));
    }
    dropped(html, activity);
    html.push_str("</div></details>\n");
}

/// Writes the alternatives left after constraints, with costs of the whole activity.
fn table(html: &mut String, activity: &PlannedActivity, chosen: &str) {
    html.push_str(
        "<div class=\"scroll\"><table class=\"candidates\"><thead><tr><th>Candidate</th>\
         <th class=\"n\">Speed</th>\
         <th class=\"n\">Power</th><th class=\"n\">Duration</th><th class=\"n\">Energy</th>\
         <th class=\"n\">Quality</th>\
         </tr></thead><tbody>\n",
    );
    let whole = activity.table();
    for (alternative, label) in activity.alternatives.iter().zip(&activity.labels) {
        let rest = whole.whole(alternative);
        let [duration, energy] = alternative.cost(rest).unwrap_or([0; 2]);
        let quality = alternative.quality_of(rest).unwrap_or(0);
        let mark =
            if label == chosen { (" class=\"chosen\"", " <em>chosen</em>") } else { ("", "") };
        let speed = if whole.travels() { speed(alternative.speed.0) } else { "–".into() };
        let _ = writeln!(
            html,
            "<tr{}><td>{}{}</td><td class=\"n\">{speed}</td><td class=\"n\">{} W</td>\
             <td class=\"n\">{}</td>\
             <td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            mark.0,
            markup(label),
            mark.1,
            milli(alternative.power.0.into(), 2),
            seconds(duration.into()),
            joules(energy.into()),
            crate::format::grouped(quality.into())
        );
    }
    html.push_str("</tbody></table></div>\n");
}

/// Writes the alternatives that constraints excluded, by reason.
fn dropped(html: &mut String, activity: &PlannedActivity) {
    if activity.dropped.is_empty() {
        html.push_str("<p class=\"note\">No constraint excludes a candidate.</p>\n");
        return;
    }
    let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
    for it in &activity.dropped {
        match reasons.iter_mut().find(|(reason, _)| *reason == it.reason) {
            Some((_, labels)) => labels.push(&it.label),
            None => reasons.push((&it.reason, vec![&it.label])),
        }
    }
    html.push_str("<dl class=\"dropped\">\n");
    for (reason, labels) in reasons {
        let _ = writeln!(
            html,
            "<dt>{} dropped: {}</dt><dd>{}</dd>",
            labels.len(),
            markup(&reason.replace('`', "")),
            markup(&labels.join(", "))
        );
    }
    html.push_str("</dl>\n");
}
