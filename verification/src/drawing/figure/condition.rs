//! What a transition asks of data and does with it, in words of the data instead of tokens.

use cotama_core::net::{Arc, Net, Place, Role, Transition};
use std::collections::{BTreeMap, BTreeSet};

/// Which places are drawn as the absence of tokens in another place.
#[derive(Debug)]
pub(super) struct Mirrors {
    /// By place: the place whose lack of tokens it counts.
    of: Vec<Option<usize>>,
}

impl Mirrors {
    /// A complement mirrors its place when every transition moves the two in opposite directions.
    pub(super) fn of(net: &Net<'_>) -> Self {
        let mut taken = BTreeSet::new();
        let of = net.places.iter().enumerate().map(|(at, place)| {
            let Role::Complement(of) = place.role else { return None };
            let of = of.0 as usize;
            let whole = net.places.get(of)?;
            let fits = of != at
                && !matches!(whole.role, Role::Complement(_))
                && whole.bound != Place::UNBOUNDED
                && whole.bound == place.bound
                && u64::from(whole.initial) + u64::from(place.initial) == u64::from(whole.bound)
                && net.transitions.iter().all(|it| change(it, at) == -change(it, of));
            (fits && taken.insert(of)).then_some(of)
        });
        Self { of: of.collect() }
    }

    /// Whether the place need not be drawn.
    pub(super) fn hides(&self, place: usize) -> bool {
        self.of.get(place).is_some_and(Option::is_some)
    }

    /// The range that these arcs ask of each place, mirrored places in terms of the other.
    pub(super) fn ranges<'a>(&self, net: &Net<'_>, arcs: impl Iterator<Item = &'a Arc>) -> Ranges {
        let mut ranges = Ranges::new();
        for arc in arcs {
            let place = arc.place.0 as usize;
            let weight = i64::from(arc.weight);
            let Some(mirrored) = self.of.get(place) else { continue };
            let range = ranges.entry(mirrored.unwrap_or(place)).or_default();
            match mirrored {
                Some(of) => {
                    let most = i64::from(net.places[*of].bound) - weight;
                    range.most = Some(range.most.map_or(most, |other| other.min(most)));
                }
                None => range.least = range.least.max(weight),
            }
        }
        ranges
    }
}

/// By place, the tokens that are asked for.
pub(super) type Ranges = BTreeMap<usize, Range>;

/// By place, the tokens that are added.
pub(super) type Changes = BTreeMap<usize, i64>;

/// How many tokens a place must hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Range {
    least: i64,
    most: Option<i64>,
}

impl Range {
    fn is(self, flag: bool) -> bool {
        if flag {
            self.least == 1 && self.most.is_none()
        } else {
            self.least == 0 && self.most == Some(0)
        }
    }

    /// `sonar`, `!sonar`, `count ≥ 2`, `1 ≤ count ≤ 3`.
    pub(super) fn words(self, place: &Place<'_>) -> String {
        let name = place.name;
        match (self.least, self.most) {
            (1, None) if place.bound == 1 => name.to_owned(),
            (0, Some(0)) if place.bound == 1 => format!("!{name}"),
            (least, None) => format!("{name} ≥ {least}"),
            (0, Some(most)) => format!("{name} ≤ {most}"),
            (least, Some(most)) if least == most => format!("{name} = {least}"),
            (least, Some(most)) => format!("{least} ≤ {name} ≤ {most}"),
        }
    }
}

/// How many tokens a transition adds to a place.
pub(super) fn change(transition: &Transition<'_>, place: usize) -> i64 {
    let sum = |arcs: &[Arc]| -> i64 {
        arcs.iter()
            .filter(|arc| arc.place.0 as usize == place)
            .map(|arc| i64::from(arc.weight))
            .sum()
    };
    sum(transition.give) - sum(transition.take)
}

/// `sonar := true`, `count += 2`.
pub(super) fn change_words(place: &Place<'_>, change: i64) -> String {
    let name = place.name;
    match change {
        1 if place.bound == 1 => format!("{name} := true"),
        -1 if place.bound == 1 => format!("{name} := false"),
        more if more > 0 => format!("{name} += {more}"),
        less => format!("{name} -= {}", less.unsigned_abs()),
    }
}

/// Transitions of one line that differ in data only.
#[derive(Debug, Clone)]
pub(super) struct Case {
    pub(super) transitions: Vec<u32>,
    pub(super) ranges: Ranges,
    pub(super) changes: Changes,
}

/// Joins cases that together ask nothing of a flag: `[x]` and `[!x] / x := true` are `/ x := true`.
pub(super) fn join(mut cases: Vec<Case>) -> Vec<Case> {
    'again: loop {
        for first in 0..cases.len() {
            for second in first + 1..cases.len() {
                if let Some(joined) = joined(&cases[first], &cases[second]) {
                    cases[first] = joined;
                    cases.remove(second);
                    continue 'again;
                }
            }
        }
        return cases;
    }
}

fn joined(one: &Case, other: &Case) -> Option<Case> {
    let transitions = [one.transitions.as_slice(), &other.transitions].concat();
    if one.ranges == other.ranges && one.changes == other.changes {
        return Some(Case { transitions, ..one.clone() });
    }
    let mut differing =
        one.ranges.iter().filter(|&(place, range)| other.ranges.get(place) != Some(range));
    let (&flag, range) = differing.next().filter(|_| one.ranges.len() == other.ranges.len())?;
    let against = *other.ranges.get(&flag)?;
    let opposed = (range.is(true) && against.is(false)) || (range.is(false) && against.is(true));
    if differing.next().is_some() || !opposed {
        return None;
    }
    let without = |case: &Case| {
        let mut changes = case.changes.clone();
        let change = changes.remove(&flag);
        (changes, change)
    };
    let ((rest, change), (other_rest, other_change)) = (without(one), without(other));
    let mut ranges = one.ranges.clone();
    ranges.remove(&flag);
    // At most one of the two changes the flag: to what it is in the other.
    let changes = match (change, other_change) {
        (_, None) => &one.changes,
        (None, Some(_)) => &other.changes,
        (Some(_), Some(_)) => return None,
    };
    (rest == other_rest).then(|| Case { transitions, ranges, changes: changes.clone() })
}
