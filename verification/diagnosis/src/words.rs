//! The conditions true of a marking, in words.

use super::run::enabled;
use cotama_core::text::marked;
use cotama_property::pt::Pt;
use cotama_property::{Atom, Condition, Formula, Linear};
use std::collections::BTreeSet;

/// A name in a sentence. Control characters are escaped, and what would end the name early is
/// replaced.
pub(super) fn name(names: &[String], at: u32) -> String {
    names.get(at as usize).map_or_else(|| format!("`number {at}`"), |it| ticked(it))
}

/// A text of the net or the property in a sentence.
pub(super) fn ticked(text: &str) -> String {
    format!("`{}`", printable(text).replace('`', "'"))
}

/// A text without control characters.
pub(super) fn printable(text: &str) -> String {
    marked(text).fold(String::with_capacity(text.len()), |mut out, (c, hidden)| {
        if hidden {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
        out
    })
}

/// `a`, `a and b`, `a, b and c`.
pub(super) fn list(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// The same, cut after some.
pub(super) fn short_list(items: &[String], most: usize) -> String {
    if items.len() <= most {
        return list(items);
    }
    format!("{} and {} more", items[..most].join(", "), items.len() - most)
}

/// `1 firing`, `2 firings`.
pub(super) fn counted(count: impl TryInto<u64>, noun: &str) -> String {
    let count = count.try_into().unwrap_or(u64::MAX);
    format!(
        "{} {noun}{}",
        if count == 0 { "no".to_owned() } else { count.to_string() },
        if count == 1 { "" } else { "s" }
    )
}

/// The parts of a true claim about one marking that make it true: all of an `and`, of an `or` the
/// first that holds.
pub(super) fn literals(pt: &Pt, claim: &Formula, marking: &[u32]) -> Vec<Formula> {
    let mut found = Vec::new();
    gather(pt, claim, marking, &mut found);
    found
}

fn gather(pt: &Pt, claim: &Formula, marking: &[u32], found: &mut Vec<Formula>) {
    match claim {
        Formula::And(all) => all.iter().for_each(|it| gather(pt, it, marking, found)),
        Formula::Or(all) => {
            if let Some(part) = all.iter().find(|it| holds(pt, it, marking)) {
                gather(pt, part, marking, found);
            }
        }
        literal => {
            if !found.contains(literal) {
                found.push(literal.clone());
            }
        }
    }
}

pub(super) fn holds(pt: &Pt, claim: &Formula, marking: &[u32]) -> bool {
    Condition::new(claim, pt).is_some_and(|it| it.holds(marking))
}

/// The kind of statement that a literal makes.
pub(super) enum Says<'f> {
    /// A place is marked.
    Marked(u32),
    /// A place is empty.
    Empty(u32),
    /// A sum of tokens is as large as is bad, or as small.
    Sum {
        places: Vec<u32>,
        large: bool,
    },
    /// Another comparison.
    Compares(&'f Linear),
    Enabled(Vec<u32>),
    Disabled(Vec<u32>),
    Dead,
    Alive,
    Other,
}

pub(super) fn says(literal: &Formula) -> Says<'_> {
    let ids = |it: &[cotama_core::net::TransitionId]| it.iter().map(|it| it.0).collect();
    match literal {
        Formula::Atom(Atom::AtMost(linear)) => match (linear.weights.as_slice(), linear.constant) {
            (&[(place, -1)], 1) => Says::Marked(place.0),
            (&[(place, 1..)], 0) => Says::Empty(place.0),
            ([(_, first), rest @ ..], _)
                if rest.iter().all(|it| it.1 == *first) && first.abs() == 1 =>
            {
                Says::Sum {
                    places: linear.weights.iter().map(|it| it.0.0).collect(),
                    large: *first < 0,
                }
            }
            _ => Says::Compares(linear),
        },
        Formula::Atom(Atom::Fireable(transitions)) => Says::Enabled(ids(transitions)),
        Formula::Atom(Atom::Deadlock) => Says::Dead,
        Formula::Not(inner) => match &**inner {
            Formula::Atom(Atom::Fireable(transitions)) => Says::Disabled(ids(transitions)),
            Formula::Atom(Atom::Deadlock) => Says::Alive,
            Formula::Atom(Atom::AtMost(linear)) => Says::Compares(linear),
            _ => Says::Other,
        },
        _ => Says::Other,
    }
}

/// The places that literals speak of.
pub(super) fn places(literals: &[Formula]) -> BTreeSet<u32> {
    let of = |literal: &Formula| match says(literal) {
        Says::Marked(place) | Says::Empty(place) => vec![place],
        Says::Sum { places, .. } => places,
        Says::Compares(linear) => linear.weights.iter().map(|it| it.0.0).collect(),
        _ => Vec::new(),
    };
    literals.iter().flat_map(of).collect()
}

pub(super) fn sum(places: &[u32], marking: &[u32]) -> u64 {
    places.iter().filter_map(|it| marking.get(*it as usize)).map(|it| u64::from(*it)).sum()
}

/// Returns the name of a sum.
pub(super) fn sum_name(pt: &Pt, places: &[u32]) -> String {
    places.iter().map(|it| name(&pt.places, *it)).collect::<Vec<_>>().join(" + ")
}

/// Returns the conditions true of a marking in words: "both `a` and `b` are marked".
pub(super) fn sentence(pt: &Pt, literals: &[Formula], marking: &[u32], past: bool) -> String {
    let [is, are, holds, hold] =
        if past { ["was", "were", "held", "held"] } else { ["is", "are", "holds", "hold"] };
    let (mut marked, mut empty, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for literal in literals {
        match says(literal) {
            Says::Marked(place) => marked.push(name(&pt.places, place)),
            Says::Empty(place) => empty.push(name(&pt.places, place)),
            Says::Sum { places, .. } => {
                let verb = if places.len() == 1 { holds } else { hold };
                let tokens = counted(sum(&places, marking), "token");
                parts.push(format!("{} {verb} {tokens}", sum_name(pt, &places)));
            }
            Says::Compares(linear) => {
                let tokens = linear.weights.iter().map(|&(place, _)| {
                    format!("{} {}", name(&pt.places, place.0), sum(&[place.0], marking))
                });
                let tokens: Vec<_> = tokens.collect();
                parts.push(format!(
                    "{} {holds} ({})",
                    ticked(&literal.display(pt).to_string()),
                    tokens.join(", ")
                ));
            }
            Says::Enabled(transitions) => {
                let names: Vec<_> = enabled(pt, marking)
                    .filter(|it| transitions.contains(it))
                    .map(|it| name(&pt.transitions, it))
                    .collect();
                let verb = if names.len() == 1 { is } else { are };
                parts.push(format!("{} {verb} enabled", short_list(&names, 4)));
            }
            Says::Disabled(transitions) => {
                let names: Vec<_> =
                    transitions.iter().map(|it| name(&pt.transitions, *it)).collect();
                parts.push(match names.as_slice() {
                    [one] => format!("{one} {is} not enabled"),
                    _ => format!("none of {} {is} enabled", short_list(&names, 4)),
                });
            }
            Says::Dead => {
                parts.push(if past { "nothing could fire" } else { "nothing can fire" }.to_owned());
            }
            Says::Alive => {
                parts.push(
                    if past { "something could fire" } else { "something can fire" }.to_owned(),
                );
            }
            Says::Other => {
                parts.push(format!("{} {holds}", ticked(&literal.display(pt).to_string())));
            }
        }
    }
    let group = |names: &[String], what: &str| match names {
        [] => None,
        [one] => Some(format!("{one} {is} {what}")),
        [_, _] => Some(format!("both {} {are} {what}", list(names))),
        _ => Some(format!("{} {are} {what}", short_list(names, 8))),
    };
    let groups = [group(&marked, "marked"), group(&empty, "empty")];
    parts.splice(0..0, groups.into_iter().flatten());
    // The two inequalities of an equation say the same.
    parts.dedup();
    if parts.is_empty() { "it is so".to_owned() } else { list(&parts) }
}

/// Returns the effect of a firing in words: "it marked `b`".
pub(super) fn effect(pt: &Pt, literals: &[Formula], before: &[u32], after: &[u32]) -> String {
    let (mut marked, mut emptied, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for literal in literals {
        match says(literal) {
            Says::Marked(place) => marked.push(name(&pt.places, place)),
            Says::Empty(place) => emptied.push(name(&pt.places, place)),
            Says::Sum { places, .. } => {
                let (from, to) = (sum(&places, before), sum(&places, after));
                let verb = if from < to { "raised" } else { "lowered" };
                parts.push(format!("{verb} {} from {from} to {to}", sum_name(pt, &places)));
            }
            Says::Enabled(transitions) => {
                let now: Vec<_> = enabled(pt, after)
                    .filter(|it| transitions.contains(it))
                    .map(|it| name(&pt.transitions, it))
                    .collect();
                parts.push(format!("enabled {}", short_list(&now, 4)));
            }
            Says::Disabled(transitions) => {
                let names: Vec<_> =
                    transitions.iter().map(|it| name(&pt.transitions, *it)).collect();
                parts.push(format!("disabled {}", short_list(&names, 4)));
            }
            Says::Dead => parts.push("left nothing that can fire".to_owned()),
            Says::Alive => parts.push("let something fire again".to_owned()),
            Says::Compares(_) | Says::Other => {
                parts.push(format!("made {} true", ticked(&literal.display(pt).to_string())));
            }
        }
    }
    let groups = [(marked, "marked"), (emptied, "emptied")];
    let groups = groups.iter().filter(|it| !it.0.is_empty());
    let groups: Vec<_> =
        groups.map(|(names, verb)| format!("{verb} {}", short_list(names, 8))).collect();
    parts.splice(0..0, groups);
    format!("it {}", list(&parts))
}

/// Returns words for the condition that holds at all times of the rest of a run, or never.
pub(super) fn always(pt: &Pt, claim: &Formula) -> String {
    let parts = match claim {
        Formula::And(parts) if !parts.is_empty() => parts.as_slice(),
        _ => std::slice::from_ref(claim),
    };
    let empty = |it: &Formula| match says(it) {
        Says::Empty(place) => Some(name(&pt.places, place)),
        _ => None,
    };
    if let Some(never) = parts.iter().map(empty).collect::<Option<Vec<_>>>() {
        return match never.as_slice() {
            [one] => format!("{one} is never marked"),
            _ => format!("none of {} is ever marked", short_list(&never, 8)),
        };
    }
    let transitions = |all: &[u32]| {
        let names: Vec<_> = all.iter().map(|it| name(&pt.transitions, *it)).collect();
        short_list(&names, 4)
    };
    match says(claim) {
        Says::Marked(place) => format!("{} is always marked", name(&pt.places, place)),
        Says::Disabled(all) if all.len() == 1 => format!("{} is never enabled", transitions(&all)),
        Says::Disabled(all) => format!("none of {} is ever enabled", transitions(&all)),
        Says::Enabled(all) if all.len() == 1 => format!("{} is always enabled", transitions(&all)),
        Says::Dead => "nothing can fire".to_owned(),
        Says::Alive => "something can always fire".to_owned(),
        _ => format!("{} always holds", ticked(&claim.display(pt).to_string())),
    }
}
