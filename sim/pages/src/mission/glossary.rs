//! The abbreviations on a page, with their meanings.

use super::plans::{needs, task_name};
use super::strip::demands;
use super::view::View;
use crate::format::{metres, speed};
use cotama_core::text::markup;
use cotama_models::missions::Mission;
use cotama_models::robots::RobotFile;
use std::collections::HashSet;
use std::fmt::Write;

/// The supervisors' nets that every robot has, as reactions name them.
const NETS: [(&str, &str); 4] = [
    ("gs", "the global supervisor: which objective"),
    ("ls", "the local supervisor: how the drive goes on, with or without the operator"),
    ("gom", "the global observation module: what failed"),
    ("cs", "the contextual supervisor: who must react"),
];

/// The words of the text of a page: tags and entities are none.
fn words(page: &str) -> HashSet<&str> {
    let texts = page.split('<').filter_map(|it| it.split_once('>')).map(|it| it.1);
    let word = |it: char| it.is_alphanumeric() || matches!(it, '.' | '-' | '_');
    texts
        .flat_map(|text| text.split(move |it| !word(it)))
        .map(|it| it.trim_matches(['.', '-']))
        .collect()
}

/// The glossary of a page: the abbreviations in its text, in the order of their kinds.
pub(super) fn section(view: &View<'_>, page: &str) -> String {
    let words = words(page);
    let mut html = String::new();
    let mut add = |name: &str, meaning: &str| {
        let _ = writeln!(
            html,
            "<div><dt>{}</dt><dd>{}</dd></div>",
            markup(name),
            markup(meaning.trim_end_matches('.'))
        );
    };
    let mut one = |name: &str, meaning: &dyn Fn() -> String| {
        // The choices are pairs of words, as `M5 L2`.
        if words.contains(name) || (name.contains(' ') && page.contains(name)) {
            add(name, &meaning());
        }
    };
    if view.points.is_empty() {
        if let Ok(mission) = &view.mission {
            own(mission, view, &mut one);
        }
    } else {
        supervised(view, &mut one);
    }
    ranges(view, &words, &mut add);
    if html.is_empty() {
        return html;
    }
    format!(
        "<section class=\"glossary\"><h2>Abbreviations on this page</h2>\n<dl>\n{html}</dl>\n\
         </section>\n"
    )
}

type Add<'a> = dyn FnMut(&str, &dyn Fn() -> String) + 'a;

/// The options of a mission of its own, and its zones.
fn own(mission: &Mission, view: &View<'_>, add: &mut Add<'_>) {
    for tio in &mission.tios {
        let task = task_name(tio.task);
        add(&tio.id, &|| format!("an option of the task “{task}”: needs {}", needs(tio, mission)));
    }
    let rows = view.plans.iter().flat_map(|plan| &plan.plan);
    if let Some(row) = rows.clone().find(|it| it.choice.contains(' ')) {
        add(&row.choice, &|| "a choice: one option for each task of an activity".into());
    }
    for zone in &mission.zones {
        let (from, to) = (metres(zone.x_start.0), metres(zone.x_end.0));
        add(&zone.id, &|| format!("a zone, {from} to {to}: {}", demands(zone, mission)));
    }
}

/// Adds the terms of supervisors: failures, configurations, modules, nets and their transitions.
fn supervised(view: &View<'_>, add: &mut Add<'_>) {
    let robot = view.mission.as_ref().ok().and_then(|it| it.robot()).map(RobotFile::robot);
    for it in robot.iter().flat_map(|it| &it.failures) {
        add(&it.id, &|| match it.item.as_str() {
            "" => format!("a failure: {}", it.mode),
            item => format!("a failure: {item}, {}", it.mode),
        });
    }
    for it in robot.iter().flat_map(|it| &it.configurations) {
        let of = robot.and_then(|robot| robot.sub_objectives.get(it.sub_objective));
        let of = of.map_or("", |it| it.name.as_str());
        let top = it.speed.0;
        let most = if top == 0 { String::new() } else { format!(", at most {}", speed(top)) };
        add(&it.name, &|| format!("a set of modules for {of}{most}"));
    }
    for it in robot.iter().flat_map(|it| &it.modules) {
        add(&it.name, &|| match it.title.as_str() {
            "" => "a module".to_owned(),
            title => format!("a module: {title}"),
        });
    }
    for (name, meaning) in NETS {
        add(name, &|| meaning.into());
    }
    let mut said = HashSet::new();
    for chain in view.points.iter().filter_map(|it| it.chain()) {
        for it in &chain.reaction {
            if said.insert(it.line()) {
                add(it.line(), &|| format!("a transition of “{}”: leads to {}", it.net, it.place));
            }
        }
        let decided = chain.decision.and_then(|it| it.transition.as_deref());
        if let Some(name) = decided.filter(|it| said.insert(it)) {
            add(name, &|| "a transition of the contextual supervisor".into());
        }
    }
}

/// Activities and objectives, which are numbered: the first and the last of them.
fn ranges(view: &View<'_>, words: &HashSet<&str>, add: &mut dyn FnMut(&str, &str)) {
    let mut range = |names: Vec<&str>, meaning: &str| {
        let used: Vec<&str> = names.into_iter().filter(|it| words.contains(it)).collect();
        match used[..] {
            [] => {}
            [only] => add(only, meaning),
            [first, .., last] => add(&format!("{first} to {last}"), meaning),
        }
    };
    range(
        view.activities.iter().map(|it| it.id.as_str()).collect(),
        "activities: pieces of the path, and what is done where the robot stands",
    );
    if let Ok(mission) = &view.mission {
        let names = mission.objectives.iter().map(|it| it.id.as_str());
        range(names.collect(), "objectives of the mission, in the order of the path");
    }
}
