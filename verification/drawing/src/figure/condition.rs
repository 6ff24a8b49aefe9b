//! Conditions and actions of a transition on data, in words of the data instead of tokens.

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

/// `count := 3`.
pub(super) fn set_words(place: &Place<'_>, to: i64) -> String {
    match (place.bound, to) {
        (1, 0) => format!("{} := false", place.name),
        (1, _) => format!("{} := true", place.name),
        _ => format!("{} := {to}", place.name),
    }
}

/// Transitions of one line that differ in data only.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Case {
    pub(super) transitions: Vec<u32>,
    pub(super) ranges: Ranges,
    pub(super) changes: Changes,
    /// Tokens by place that it holds afterwards, whatever it held.
    pub(super) set: Changes,
}

/// Joins the cases of an assignment: `[count = 0]`, `[count = 1] / count -= 1`, ... of one line are
/// `/ count := 0`.
pub(super) fn assigned(net: &Net<'_>, mut cases: Vec<Case>) -> Vec<Case> {
    let counters: BTreeSet<usize> = cases.iter().flat_map(|it| it.ranges.keys().copied()).collect();
    for place in counters {
        let Some(bound) = net.places.get(place).map(|it| i64::from(it.bound)) else { continue };
        let mut others: Vec<Vec<Case>> = Vec::new();
        for case in cases {
            let rest = |it: &Case| {
                let mut it = Case { transitions: Vec::new(), ..it.clone() };
                it.ranges.remove(&place);
                it.changes.remove(&place);
                it
            };
            match others.iter_mut().find(|it| rest(&it[0]) == rest(&case)) {
                Some(like) => like.push(case),
                None => others.push(vec![case]),
            }
        }
        cases = others.into_iter().flat_map(|it| as_one(it, place, bound)).collect();
    }
    cases
}

/// Returns cases that differ in a place alone as one that sets it, where they are that.
fn as_one(cases: Vec<Case>, place: usize, bound: i64) -> Vec<Case> {
    let exact = |it: &Case| {
        let range = it.ranges.get(&place)?;
        (range.least == range.most.unwrap_or(bound)).then_some(range.least)
    };
    let mut values: Vec<i64> = cases.iter().filter_map(exact).collect();
    let left = |it: &Case| Some(exact(it)? + it.changes.get(&place).copied().unwrap_or(0));
    let target = cases.first().and_then(left);
    values.sort_unstable();
    let follow = values.windows(2).all(|it| it[1] == it[0] + 1);
    let is_one = values.len() > 1 && values.len() == cases.len() && follow;
    let (Some(to), true) = (target, is_one && cases.iter().all(|it| left(it) == target)) else {
        return cases;
    };
    let transitions = cases.iter().flat_map(|it| it.transitions.iter().copied()).collect();
    let mut one = Case { transitions, ..cases[0].clone() };
    let (least, most) = (values[0], values[values.len() - 1]);
    one.ranges.remove(&place);
    if least > 0 || most < bound {
        one.ranges.insert(place, Range { least, most: (most < bound).then_some(most) });
    }
    one.changes.remove(&place);
    one.set.insert(place, to);
    vec![one]
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
    if one.set != other.set {
        return None;
    }
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
    (rest == other_rest).then(|| Case {
        transitions,
        ranges,
        changes: changes.clone(),
        set: one.set.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::{Case, Changes, Range, Ranges, as_one};

    /// Cases that ask for exactly these tokens of place 7 and change them so.
    fn cases(of: &[(i64, i64)]) -> Vec<Case> {
        let case = |(number, &(value, change)): (usize, &(i64, i64))| Case {
            transitions: vec![number as u32],
            ranges: Ranges::from([(7, Range { least: value, most: Some(value) })]),
            changes: Changes::from_iter((change != 0).then_some((7, change))),
            set: Changes::new(),
        };
        of.iter().enumerate().map(case).collect()
    }

    #[test]
    fn one_case_for_each_old_value_is_an_assignment() {
        for (of, bound, ranges) in [
            (&[(0, 0), (1, -1), (2, -2), (3, -3)][..], 3, Ranges::new()),
            (&[(0, 2), (1, 1), (2, 0)], 2, Ranges::new()),
            (&[(0, 0), (1, -1)], 3, Ranges::from([(7, Range { least: 0, most: Some(1) })])),
            (&[(2, -1), (3, -2)], 3, Ranges::from([(7, Range { least: 2, most: None })])),
            (&[(3, 1), (2, 2)], 9, Ranges::from([(7, Range { least: 2, most: Some(3) })])),
        ] {
            let all = as_one(cases(of), 7, bound);
            assert_eq!((all.len(), all[0].transitions.len()), (1, of.len()), "{of:?}");
            assert_eq!((&all[0].ranges, all[0].changes.len()), (&ranges, 0), "{of:?}");
            assert_eq!(all[0].set, Changes::from([(7, of[0].0 + of[0].1)]), "{of:?}");
        }
    }

    #[test]
    fn cases_that_lead_to_other_values_or_leave_some_out_stay_apart() {
        for of in [&[(0, 1), (1, 1)][..], &[(0, 0), (2, -2)], &[(1, -1)], &[(0, 0), (0, 0)]] {
            assert_eq!(as_one(cases(of), 7, 3).len(), of.len(), "{of:?}");
        }
    }
}
