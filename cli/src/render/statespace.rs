//! The screen of `cotama statespace`.

use super::numbers::grouped;
use super::style::{FAINT, HEADING, NOTICE, Style};
use super::{described, visible};
use crate::answers::check::StatespaceAnswer;

/// The most names of one kind that are shown.
const SHOWN: usize = 20;
/// The width of the terms.
const TERM: usize = 19;

/// How large a model is.
pub(crate) fn screen(answer: &StatespaceAnswer, width: usize) -> String {
    let how =
        if answer.timed { "  with its intervals of time: state classes are counted" } else { "" };
    let mut text = format!("{HEADING}{}{HEADING:#}{FAINT}{how}{FAINT:#}\n", visible(&answer.model));
    let mut line =
        |style: Style, term: &str, said: &str| text += &described(term, TERM, style, said, width);
    for note in &answer.notes {
        line(NOTICE, "note", note);
    }
    if let Some(limit) = &answer.limit {
        line(NOTICE, "not complete", limit);
        line(FAINT, "explored", &explored(answer));
    }
    if let Some(rounds) = &answer.rounds {
        let said = format!("{} states, {} edges", grouped(&rounds.states), grouped(&rounds.edges));
        line(FAINT, "rounds", &said);
    }
    let counts = if answer.timed {
        vec![
            ("state classes", &answer.classes),
            ("edges", &answer.edges),
            ("markings", &answer.markings),
        ]
    } else {
        vec![("states", &answer.states), ("arcs", &answer.arcs)]
    };
    let rest = [
        ("deadlocks", &answer.deadlocks),
        ("most in a place", &answer.max_place),
        ("most tokens", &answer.max_sum),
    ];
    for (term, count) in counts.into_iter().chain(rest) {
        if let Some(count) = count {
            line(FAINT, term, &grouped(count));
        }
    }
    let word = |known: Option<bool>| match known {
        Some(true) => "yes",
        Some(false) => "no",
        None => "not known",
    };
    line(FAINT, "bounded", word(answer.bounded));
    line(FAINT, "1-safe", word(answer.safe));
    if let Some(growth) = &answer.growth {
        line(
            FAINT,
            "tokens grow",
            &format!(
                "after {}, again and again {}",
                listed(&growth.first),
                listed(&growth.repeated)
            ),
        );
    }
    for (term, names) in
        [("never fire", &answer.dead_transitions), ("never marked", &answer.dead_places)]
    {
        if let Some(names) = names.as_ref().filter(|it| !it.is_empty()) {
            line(NOTICE, term, &listed(names));
        }
    }
    if let Some(bytes) = answer.bytes_per_state {
        line(FAINT, "memory", &format!("{bytes} bytes a state"));
    }
    text
}

fn explored(answer: &StatespaceAnswer) -> String {
    let what = if answer.timed { "state classes" } else { "states" };
    format!("{} {what}, {} arcs", grouped(&answer.explored.states), grouped(&answer.explored.arcs))
}

fn listed(names: &[String]) -> String {
    let mut shown: Vec<_> = names.iter().take(SHOWN).map(|it| visible(it)).collect();
    if names.len() > SHOWN {
        shown.push(format!("and {} more", names.len() - SHOWN));
    }
    if shown.is_empty() { "nothing".to_owned() } else { shown.join(", ") }
}
