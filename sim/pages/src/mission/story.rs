//! The story of a run in three sentences, made from its trace: what happened, what was decided, how
//! it ended.

use super::view::View;
use crate::format::{count, grouped, joules, metres, moment, percent, seconds};
use cotama_core::text::markup;
use cotama_models::severity::Class;
use cotama_sim::run::Outcome;
use cotama_sim::story::Chain;
use cotama_sim::trace::{End, Event, Occurrence, Plan};
use std::fmt::Write;

/// The most things that a sentence lists.
const MOST: usize = 6;

/// The three sentences.
pub(super) fn section(view: &View<'_>) -> String {
    let supervised = !view.points.is_empty();
    let sentences = [
        ("What happened", if supervised { failed(view) } else { happened(view) }),
        ("What was decided", if supervised { reacted(view) } else { planned(view) }),
        ("How it ended", ended(view)),
    ];
    let mut html = String::from("<dl class=\"story\">");
    for (name, sentence) in sentences {
        let _ = write!(html, "<div><dt>{name}</dt><dd>{}</dd></div>", markup(&sentence));
    }
    html.push_str("</dl>\n");
    html
}

/// `a`, `a and b`, `a, b and c`; what is too many is counted.
fn list(mut items: Vec<String>) -> String {
    let more = items.len().saturating_sub(MOST);
    if more > 0 {
        items.truncate(MOST);
        items.push(format!("{more} more"));
    }
    let last = items.pop().unwrap_or_default();
    if items.is_empty() { last } else { format!("{} and {last}", items.join(", ")) }
}

/// A sentence of clauses, which may have commas themselves.
fn clauses(mut items: Vec<String>) -> String {
    let more = items.len().saturating_sub(MOST);
    if more > 0 {
        items.truncate(MOST);
        items.push(format!("and {more} more"));
    }
    super::events::capital(&items.join("; "))
}

/// The events of a run that no supervisor decides on.
fn happened(view: &View<'_>) -> String {
    let mut parts = Vec::new();
    let slow = |kind: fn(&Occurrence) -> bool, noun: &str| {
        let of_kind: Vec<&&Event> = view.events.iter().filter(|it| kind(&it.event)).collect();
        let lost = of_kind.iter().map(|it| it.lost_us).fold(0u64, u64::saturating_add);
        let number = of_kind.len() as u64;
        (number > 0).then(|| format!("{} took {}", count(number, noun), moment(lost)))
    };
    parts.extend(slow(|it| matches!(it, Occurrence::Obstacle { .. }), "obstacle"));
    parts.extend(slow(|it| matches!(it, Occurrence::Odometry { .. }), "odometry error"));
    for it in &view.events {
        let at = metres(it.x_mm);
        match &it.event {
            Occurrence::Fault { hardware, units_lost, .. } => {
                parts.push(format!("{units_lost} {hardware} failed at {at}"));
            }
            Occurrence::Repair { hardware, units_back, .. } => {
                parts.push(format!("{units_back} {hardware} came back at {at}"));
            }
            Occurrence::Detour { door, extra_mm } => {
                let extra = metres(*extra_mm);
                parts.push(format!("{door} was closed at {at}, which took {extra} more"));
            }
            Occurrence::Obstacle { .. } | Occurrence::Odometry { .. } => {}
        }
    }
    if parts.is_empty() {
        "Nothing hindered the robot on its way.".into()
    } else {
        format!("On the way, {}.", list(parts))
    }
}

/// Returns the failures of a supervised run, in words.
fn failed(view: &View<'_>) -> String {
    let points: Vec<_> = view.points.iter().filter(|it| it.chain().is_some()).collect();
    if points.is_empty() {
        return "Nothing failed on the way.".into();
    }
    let unseen =
        points.iter().filter_map(|it| it.chain()).filter(|it| it.diagnosis.is_none()).count();
    let failures: Vec<_> =
        points.iter().map(|it| format!("at {}, {}", metres(it.x_mm), it.title())).collect();
    let number = count(points.len() as u64, "failure");
    let noticed = match unseen {
        0 => String::new(),
        some => format!(" Nobody noticed {some} of them."),
    };
    format!("{number} on the way: {}.{noticed}", failures.join("; "))
}

/// The replans of a run, and where nothing could be planned.
fn planned(view: &View<'_>) -> String {
    let replan = |it: &&&Plan| {
        let cause = match it.cause.as_str() {
            "energy margin below zero" => "as the energy margin had come below zero".to_owned(),
            "duration margin below zero" => "as the duration margin had come below zero".to_owned(),
            "room for a better plan" => "as the margins had grown".to_owned(),
            cause if cause.ends_with(" lost") => {
                let what = &cause[..cause.len() - 5];
                format!("as {what} {} lost", if what.ends_with('s') { "were" } else { "was" })
            }
            cause => format!("because of {cause}"),
        };
        format!("at {}, {cause}", metres(it.x_mm))
    };
    let replans: Vec<String> =
        view.plans.iter().skip(1).collect::<Vec<_>>().iter().map(replan).collect();
    let mut text = match replans.len() {
        0 => "The first plan was kept to the end.".to_owned(),
        1 => format!("The robot planned again {}.", replans[0]),
        many => format!("The robot planned again {many} times: {}.", {
            let mut text = clauses(replans);
            text.replace_range(..1, "a");
            text
        }),
    };
    if let Some(it) = view.abort {
        let (at, reason) = (metres(it.x_mm), &it.reason);
        let _ = write!(text, " At {at} no plan was left: {reason}.");
    }
    text
}

/// Returns the decision of a supervisor on a failure, in words that a failure can follow.
fn decision(chain: &Chain<'_>) -> Option<&'static str> {
    let it = chain.decision?;
    Some(match it.decision {
        Class::Adapter => "the adapter took another set of modules",
        Class::Local => "the operator was asked",
        Class::Global => "the mission was ended safely",
        Class::Record => "nothing changed",
    })
}

/// The decisions of a supervised run, each with the failures that led to it.
fn reacted(view: &View<'_>) -> String {
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for chain in view.points.iter().filter_map(|it| it.chain()) {
        let decided = decision(chain);
        let set = chain.set.map(|_| "a setting was changed");
        let again = chain.planned_us.map(|_| "the rest was planned again");
        let asked = chain.asked_us.map(|_| "the operator was asked");
        let asked = asked.filter(|&asked| decided != Some(asked));
        for words in [decided, set, again, asked].into_iter().flatten() {
            let mode = chain.failure.mode.clone();
            match groups.iter_mut().find(|it| it.0 == words) {
                Some(group) => group.1.push(mode),
                None => groups.push((words, vec![mode])),
            }
        }
    }
    if groups.is_empty() {
        return "The supervisors had nothing to decide.".into();
    }
    let clause = |(words, modes): (&str, Vec<String>)| format!("{words} after {}", list(modes));
    format!("{}.", clauses(groups.into_iter().map(clause).collect()))
}

/// How it ended, with the margins.
fn ended(view: &View<'_>) -> String {
    let Some(end) = view.end else {
        let (x_mm, t_us) = view.last();
        return format!("The trace breaks off at {}, {}.", metres(x_mm), moment(t_us));
    };
    let all = match view.activities.len() as u64 {
        1 => "The only activity is".to_owned(),
        number => format!("All {} activities are", grouped(number.into())),
    };
    let (at, after) = (metres(end.x_mm), seconds(end.used.duration_ms));
    let reason = end.reason.as_ref().map_or(String::new(), |it| format!(" ({it})"));
    let how = match end.outcome {
        Outcome::Completed => format!("{all} done after {after} and {at}"),
        Outcome::Safe => format!("The robot stands safely at {at} after {after}{reason}"),
        Outcome::Failed => format!("The run failed at {at} after {after}{reason}"),
    };
    format!("{how}; {}.", margins(view, end))
}

/// Returns the margins of both limits, or what they lack.
fn margins(view: &View<'_>, end: &End) -> String {
    let (limits, left) = (view.trace.header.limits, end.margins);
    let time = seconds(left.duration_ms.unsigned_abs());
    let energy = joules(left.energy_mj.unsigned_abs());
    let share = |margin: i64, limit: u64| percent(margin.unsigned_abs(), limit);
    let (time_share, energy_share) =
        (share(left.duration_ms, limits.duration_ms), share(left.energy_mj, limits.energy_mj));
    match (left.duration_ms < 0, left.energy_mj < 0) {
        (false, false) => {
            format!(
                "{time} ({time_share} %) and {energy} ({energy_share} %) of the limits are left"
            )
        }
        (true, true) => format!("both limits are exceeded, by {time} and by {energy}"),
        (true, false) => {
            format!("the limit of time is exceeded by {time}, {energy} ({energy_share} %) are left")
        }
        (false, true) => {
            format!("the limit of energy is exceeded by {energy}, {time} ({time_share} %) are left")
        }
    }
}
