//! Random nets: the same answers before and after, and runs that lift.

use crate::reductions::net::{reduced, text};
use crate::reductions::space::{Seen, Space, bisimilar, is_dead, run, same_stutter_runs};
use cotama_checker::reductions::{Goal, Keep, Reduced, Rule};
use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::pt::Pt;
use std::collections::{BTreeMap, BTreeSet};

/// Markings beyond which a net is not passed through.
const MARKINGS: usize = 100;

struct Random(u64);

impl Random {
    fn below(&mut self, end: u32) -> u32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        ((mixed >> 32) % u64::from(end)) as u32
    }

    /// A small net, in which transitions and places are split, doubled and summed up, so that rules
    /// find what they are for; then sometimes another arc, so that they just miss it.
    fn net(&mut self) -> Pt {
        let mut net = Sketch::default();
        for _ in 0..=self.below(4) {
            net.initial.push([0, 1, 1, 2][self.below(4) as usize]);
        }
        let (heavy, conservative) = (self.below(3) == 0, self.below(4) > 0);
        for _ in 0..=self.below(4) {
            let takes = [0, 1, 1, 1, 1, 1, 2, 2][self.below(8) as usize];
            let gives = if conservative { takes } else { [0, 1, 1, 2][self.below(4) as usize] };
            let mut arcs = [BTreeMap::new(), BTreeMap::new()];
            for (side, count) in [takes, gives].into_iter().enumerate() {
                for _ in 0..count {
                    let weight = if heavy && self.below(3) == 0 { 2 } else { 1 };
                    arcs[side].insert(net.place(self), weight);
                }
            }
            net.arcs.push(arcs);
        }
        for _ in 0..self.below(5) {
            self.change(&mut net);
        }
        if self.below(3) == 0 {
            let (at, place) = (net.transition(self), net.place(self));
            match self.below(3) {
                0 => _ = net.arcs[at][0].insert(place, 1),
                1 => _ = net.arcs[at][1].insert(place, 1),
                _ => net.arcs[at].iter_mut().for_each(|it| _ = it.insert(place, 1)),
            }
        }
        net.pt()
    }

    fn change(&mut self, net: &mut Sketch) {
        let (at, place) = (net.transition(self), net.place(self));
        let new = net.initial.len() as u32;
        let tokens = u32::from(self.below(5) == 0);
        match self.below(9) {
            // One transition as two in a row, by a token or by two.
            0 => {
                net.initial.push(tokens);
                let weight = 1 + u32::from(self.below(3) == 0);
                let gives =
                    std::mem::replace(&mut net.arcs[at][1], BTreeMap::from([(new, weight)]));
                net.arcs.push([BTreeMap::from([(new, 1)]), gives]);
            }
            // A place that tokens come to by another one; or from which they come back as well.
            1 | 2 => {
                net.initial.push(tokens);
                for [_, gives] in &mut net.arcs {
                    if let Some(weight) = gives.remove(&place) {
                        gives.insert(new, weight);
                    }
                }
                net.arcs.push([BTreeMap::from([(new, 1)]), BTreeMap::from([(place, 1)])]);
                if self.below(3) == 0 {
                    net.arcs.push([BTreeMap::from([(place, 1)]), BTreeMap::from([(new, 1)])]);
                }
            }
            // A transition that has what it takes from one place brought by another.
            3 | 4 => {
                let [takes, _] = &mut net.arcs[at];
                if let Some((from, weight)) = takes.pop_first() {
                    net.initial.push(0);
                    takes.insert(new, 1);
                    net.arcs.push([BTreeMap::from([(from, weight)]), BTreeMap::from([(new, 1)])]);
                }
            }
            // A transition that fires alone or twice, at once.
            5 => {
                let times = 1 + self.below(2);
                let twice = net.arcs[at]
                    .clone()
                    .map(|side| side.into_iter().map(|it| (it.0, it.1 * times)).collect());
                net.arcs.push(twice);
            }
            // A sum of places.
            6 | 7 => {
                let terms = [(place, 1 + self.below(2)), (net.place(self), self.below(2))];
                let sum = |tokens: &dyn Fn(u32) -> u32| {
                    terms.iter().map(|it| tokens(it.0) * it.1).sum::<u32>()
                };
                let more = sum(&|it| net.initial[it as usize]) + self.below(2);
                for side in net.arcs.iter_mut().flatten() {
                    let weight = sum(&|it| side.get(&it).copied().unwrap_or(0));
                    side.extend((weight > 0).then_some((new, weight)));
                }
                net.initial.push(more.saturating_sub(u32::from(self.below(4) == 0)));
            }
            // Weights of a place times two.
            _ => {
                for side in net.arcs.iter_mut().flatten() {
                    side.entry(place).and_modify(|it| *it *= 2);
                }
                net.initial[place as usize] = 2 * net.initial[place as usize] + self.below(2);
            }
        }
    }
}

/// A net of which each transition takes and gives.
#[derive(Default)]
struct Sketch {
    initial: Vec<u32>,
    arcs: Vec<[BTreeMap<u32, u32>; 2]>,
}

impl Sketch {
    fn place(&self, random: &mut Random) -> u32 {
        random.below(self.initial.len() as u32)
    }

    fn transition(&self, random: &mut Random) -> usize {
        random.below(self.arcs.len() as u32) as usize
    }

    fn pt(&self) -> Pt {
        let mut net = OwnedNet::new("random", "");
        let place = |(at, &tokens): (usize, &u32)| OwnedPlace::new(&format!("p{at}"), tokens);
        let ids: Vec<_> =
            self.initial.iter().enumerate().map(place).map(|it| net.place(it).unwrap()).collect();
        for (at, [takes, gives]) in self.arcs.iter().enumerate() {
            let it = OwnedTransition::new(&format!("t{at}"));
            let it =
                takes.iter().fold(it, |it, (&place, &weight)| it.take(ids[place as usize], weight));
            let it =
                gives.iter().fold(it, |it, (&place, &weight)| it.give(ids[place as usize], weight));
            net.transition(it).unwrap();
        }
        Pt::from(&net.view().net())
    }
}

/// Returns the visible values in each marking of the original net, and in each of the reduced one.
fn seen(keep: &Keep, reduced: &Reduced, original: &Space, small: &Space) -> [Vec<Seen>; 2] {
    let tokens = |place: &PlaceId, marking: &[u32]| i64::from(marking[place.0 as usize]);
    let told = |place: &PlaceId, marking: &[u32]| {
        reduced.trail.place(*place).unwrap().of(marking).unwrap()
    };
    [
        original
            .markings
            .iter()
            .map(|it| keep.places.iter().map(|at| tokens(at, it)).collect())
            .collect(),
        small
            .markings
            .iter()
            .map(|it| keep.places.iter().map(|at| told(at, it)).collect())
            .collect(),
    ]
}

fn set(seen: &[Seen], at: impl Iterator<Item = usize>) -> BTreeSet<&Seen> {
    at.map(|it| &seen[it]).collect()
}

/// Compares a net with what these rules make of it; the message tells what differs. `None` when
/// there is nothing to compare.
fn compare(pt: &Pt, rules: &[Rule], keep: &Keep) -> Option<Result<bool, String>> {
    let reduced = reduced(pt, rules, keep);
    let small = Space::new(&reduced.net, MARKINGS);
    let original = Space::new(pt, MARKINGS);
    let [of_original, of_small] = seen(keep, &reduced, &original, &small);
    let wrong = |what: &str| {
        let places: Vec<_> = keep.places.iter().map(|it| &pt.places[it.0 as usize]).collect();
        let (before, after) = (text(pt), text(&reduced.net));
        Some(Err(format!(
            "{what}: {:?} of {places:?}\n{before}\n{after}\n{:?}",
            keep.goal, reduced.counts
        )))
    };
    let shrunk = reduced.counts.iter().any(|it| it.1 > 0);
    // Runs lift, whether or not there are more markings than were looked at.
    let some = (0..small.markings.len()).step_by(1 + small.markings.len() / 20);
    for at in some.chain(small.dead()) {
        let dead = is_dead(&reduced.net, &small.markings[at]);
        let Ok(lifted) = reduced.trail.lift(pt, &small.path(at)) else {
            return wrong("not lifted");
        };
        let Some(marking) = run(pt, &lifted) else { return wrong("not a run") };
        if dead
            && !is_dead(pt, &marking)
            && matches!(keep.goal, Goal::Deadlock | Goal::StutterInvariantLtl)
        {
            return wrong("not dead");
        }
        if keep
            .places
            .iter()
            .zip(&of_small[at])
            .any(|(it, &told)| i64::from(marking[it.0 as usize]) != told)
        {
            return wrong("other tokens");
        }
    }
    if original.complete && !small.complete {
        return wrong("larger");
    }
    if !small.complete {
        return None;
    }
    let all = |space: &Space| 0..space.markings.len();
    match keep.goal {
        Goal::Reachability | Goal::Bounds => {
            if !set(&of_original, all(&original)).is_subset(&set(&of_small, all(&small))) {
                return wrong("other markings");
            }
        }
        _ if !original.complete => return None,
        Goal::Deadlock => {
            if set(&of_original, original.dead()) != set(&of_small, small.dead()) {
                return wrong("other deadlocks");
            }
        }
        Goal::StutterInvariantLtl => {
            if !same_stutter_runs((&original, &of_original), (&small, &of_small)) {
                return wrong("other runs");
            }
        }
        Goal::Ctl => {
            if !bisimilar((&original, &of_original), (&small, &of_small)) {
                return wrong("not bisimilar");
            }
        }
    }
    Some(Ok(shrunk))
}

const GOALS: [Goal; 5] =
    [Goal::Reachability, Goal::Deadlock, Goal::StutterInvariantLtl, Goal::Ctl, Goal::Bounds];

fn keep(random: &mut Random, pt: &Pt, goal: Goal) -> Keep {
    let places: BTreeSet<u32> =
        (0..random.below(3)).map(|_| random.below(pt.places.len() as u32)).collect();
    Keep { places: places.into_iter().map(PlaceId).collect(), ..Keep::new(goal) }
}

#[test]
fn four_thousand_random_nets_answer_the_same_when_reduced() {
    random_nets_answer_the_same_when_reduced(2020, 4_000);
}

#[test]
#[ignore = "seconds: CI runs it"]
fn twenty_thousand_random_nets_answer_the_same_when_reduced() {
    random_nets_answer_the_same_when_reduced(2021, 20_000);
}

fn random_nets_answer_the_same_when_reduced(seed: u64, nets: usize) {
    let mut random = Random(seed);
    let (mut compared, mut shrunk, mut counts) = (BTreeMap::new(), 0, BTreeMap::new());
    for at in 0..nets {
        let pt = random.net();
        // Reachability and deadlocks of each net, and one of the others.
        for goal in [Goal::Reachability, Goal::Deadlock, GOALS[2 + at % 3]] {
            let keep = keep(&mut random, &pt, goal);
            // All rules, or about half of them, so that each meets nets that another would have
            // changed first.
            let mut rules = Rule::ALL.to_vec();
            rules.retain(|_| at % 2 == 0 || random.below(2) == 0);
            for (rule, count) in reduced(&pt, &rules, &keep).counts {
                *counts.entry(rule).or_insert(0) += count;
            }
            match compare(&pt, &rules, &keep) {
                Some(Ok(smaller)) => {
                    *compared.entry(format!("{goal:?}")).or_insert(0) += 1;
                    shrunk += usize::from(smaller);
                }
                Some(Err(message)) => panic!("{message}"),
                None => {}
            }
        }
    }
    eprintln!("compared: {compared:?}, reduced: {shrunk}, {counts:?}");
    assert!(compared.values().all(|&it| it > nets / 7), "{compared:?}");
    assert!(Rule::ALL.iter().all(|it| counts[it] > nets / 200), "{counts:?}");
}

#[test]
fn each_rule_alone_keeps_the_answer_of_random_nets() {
    for rule in Rule::ALL {
        let (mut random, mut used) = (Random(rule as u64), 0);
        for _ in 0..1_500 {
            let pt = random.net();
            for goal in GOALS.into_iter().filter(|&it| rule.keeps(it)) {
                let keep = keep(&mut random, &pt, goal);
                match compare(&pt, &[rule], &keep) {
                    Some(Ok(smaller)) => used += usize::from(smaller),
                    Some(Err(message)) => panic!("{}: {message}", rule.name()),
                    None => {}
                }
            }
        }
        assert!(used > 20, "{}: {used}", rule.name());
    }
}
