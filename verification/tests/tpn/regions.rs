//! A second meaning of a time net with open bounds: clock regions. Of a clock counts how many whole
//! units it shows, and where its rest comes among the rests of the others (Alur and Dill 1994).

use crate::tpn::discrete::{enabled, fire};
use cotama_verification::tpn::{Interval, TimeNet};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Whole units, and the rank of the rest, 0 for no rest. A clock without end that has passed its
/// lower bound is `Beyond`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Clock {
    At(u64, usize),
    Beyond,
}

type Region = (Vec<u32>, Vec<Option<Clock>>);

fn may_fire(clock: Clock, interval: Interval) -> bool {
    match clock {
        Clock::Beyond => true,
        Clock::At(whole, rest) => {
            whole > interval.lower
                || whole == interval.lower && (rest > 0 || !interval.lower_strict)
        }
    }
}

fn may_be(clock: Clock, interval: Interval) -> bool {
    match (clock, interval.upper) {
        (Clock::Beyond, _) | (_, None) => true,
        (Clock::At(whole, rest), Some(upper)) => {
            whole < upper || whole == upper && rest == 0 && !interval.upper_strict
        }
    }
}

/// The ranks of the rests without gaps; no rest stays rank 0.
fn without_gaps(clocks: &mut [Option<Clock>]) {
    let ranks: BTreeSet<usize> = clocks.iter().filter_map(|it| rest(*it)).chain([0]).collect();
    for clock in clocks.iter_mut().flatten() {
        if let Clock::At(_, rest) = clock {
            *rest = ranks.range(..*rest).count();
        }
    }
}

fn rest(clock: Option<Clock>) -> Option<usize> {
    match clock {
        Some(Clock::At(_, rest)) => Some(rest),
        _ => None,
    }
}

/// The region that comes next when time passes, unless something is due. A clock more than there
/// are transitions measures, and stops nothing.
fn later(net: &TimeNet, clocks: &[Option<Clock>]) -> Option<Vec<Option<Clock>>> {
    let whole = clocks.iter().any(|&it| rest(it) == Some(0));
    let largest = clocks.iter().filter_map(|&it| rest(it)).max();
    let next = |clock: Clock, interval: Interval| match clock {
        Clock::At(units, 0) if interval.upper.is_none() && units == interval.lower => Clock::Beyond,
        Clock::At(units, rest) if whole => Clock::At(units, rest + 1),
        Clock::At(units, rest) if Some(rest) == largest => Clock::At(units + 1, 0),
        same => same,
    };
    let intervals =
        || net.transitions().iter().map(|it| it.interval).chain([Interval::closed(0, u64::MAX)]);
    let mut clocks: Vec<_> = clocks
        .iter()
        .zip(intervals())
        .map(|(it, interval)| it.map(|it| next(it, interval)))
        .collect();
    without_gaps(&mut clocks);
    clocks
        .iter()
        .zip(intervals())
        .all(|(it, interval)| it.is_none_or(|it| may_be(it, interval)))
        .then_some(clocks)
}

/// Returns the next regions, each with the transition that leads there.
fn successors(net: &TimeNet, (marking, clocks): &Region) -> Vec<(Option<usize>, Region)> {
    let mut next: Vec<_> =
        later(net, clocks).map(|clocks| (None, (marking.clone(), clocks))).into_iter().collect();
    for (fired, transition) in net.transitions().iter().enumerate() {
        if !clocks[fired].is_some_and(|clock| may_fire(clock, transition.interval)) {
            continue;
        }
        let (after, new) = fire(net, marking, fired);
        let clock = |at: usize| match new.get(at) {
            Some(None) => None,
            Some(Some(true)) => Some(Clock::At(0, 0)),
            Some(Some(false)) | None => clocks[at],
        };
        let mut kept: Vec<_> = (0..clocks.len()).map(clock).collect();
        without_gaps(&mut kept);
        next.push((Some(fired), (after, kept)));
    }
    next
}

/// All regions that are reached.
pub(crate) struct Regions<'n> {
    net: &'n TimeNet,
    list: Vec<Region>,
    edges: Vec<Vec<(Option<usize>, usize)>>,
}

/// The states of a net just after a firing.
pub(crate) struct Instants {
    /// Tokens, and what fired last.
    pub(crate) states: Vec<(Vec<u32>, Option<usize>)>,
    pub(crate) next: Vec<Vec<usize>>,
}

/// All regions; `None` when there are more than `most` or a place gets more than `tokens`.
pub(crate) fn regions(net: &TimeNet, most: usize, tokens: u32) -> Option<Regions<'_>> {
    let initial: Vec<u32> = net.places().iter().map(|it| it.initial).collect();
    let clocks = net
        .transitions()
        .iter()
        .map(|it| enabled(it, &initial).then_some(Clock::At(0, 0)))
        .collect();
    let mut all = Regions { net, list: vec![(initial, clocks)], edges: Vec::new() };
    let mut numbers = HashMap::from([(all.list[0].clone(), 0)]);
    while all.edges.len() < all.list.len() {
        let mut out = Vec::new();
        for (fired, next) in successors(net, &all.list[all.edges.len()]) {
            if next.0.iter().any(|&it| it > tokens) || all.list.len() > most {
                return None;
            }
            let number = *numbers.entry(next).or_insert_with_key(|next| {
                all.list.push(next.clone());
                all.list.len() - 1
            });
            out.push((fired, number));
        }
        all.edges.push(out);
    }
    Some(all)
}

impl Regions<'_> {
    /// The regions just after a firing, the first one that of the start, each with what fired last:
    /// their tokens, and where firings lead after any time.
    pub(crate) fn instants(&self) -> Instants {
        let mut list = vec![(0, None)];
        let mut numbers = HashMap::from([(list[0], 0)]);
        let mut next: Vec<Vec<usize>> = Vec::new();
        while next.len() < list.len() {
            let (mut open, mut met) = (vec![list[next.len()].0], HashSet::new());
            let mut to = BTreeSet::new();
            while let Some(region) = open.pop().filter(|it| met.insert(*it)) {
                for &(fired, target) in &self.edges[region] {
                    if fired.is_none() {
                        open.push(target);
                        continue;
                    }
                    to.insert(*numbers.entry((target, fired)).or_insert_with_key(|it| {
                        list.push(*it);
                        list.len() - 1
                    }));
                }
            }
            next.push(to.into_iter().collect());
        }
        let tokens = |it: &(usize, Option<usize>)| (self.list[it.0].0.clone(), it.1);
        Instants { states: list.iter().map(tokens).collect(), next }
    }

    /// The different markings.
    pub(crate) fn markings(&self) -> BTreeSet<Vec<u32>> {
        self.list.iter().map(|it| it.0.clone()).collect()
    }

    /// Returns the markings that enable nothing.
    pub(crate) fn dead(&self) -> BTreeSet<Vec<u32>> {
        self.list
            .iter()
            .filter(|it| it.1.iter().all(Option::is_none))
            .map(|it| it.0.clone())
            .collect()
    }

    /// The greatest lower and the least upper bound of the time from a firing until a place is
    /// marked, as the command line shows it; `None` when it takes longer than `longest`.
    pub(crate) fn bound(&self, from: usize, to: usize, longest: u64) -> Option<String> {
        let marked = |region: &Region| region.0[to] > 0;
        let entries: BTreeSet<usize> = self
            .edges
            .iter()
            .flatten()
            .filter(|it| it.0 == Some(from))
            .map(|&(_, target)| target)
            .collect();
        if entries.is_empty() {
            return Some("never fires".to_owned());
        }
        // Without measuring: of regions on the way, those from which every way ends in a marked
        // one.
        let (mut way, mut open) = (BTreeSet::new(), entries.iter().copied().collect::<Vec<_>>());
        let mut reached = false;
        while let Some(region) = open.pop() {
            if marked(&self.list[region]) {
                reached = true;
            } else if way.insert(region) {
                open.extend(self.edges[region].iter().map(|it| it.1));
            }
        }
        let mut endless = way;
        loop {
            let before = endless.len();
            let goes_on =
                |region: &usize| self.edges[*region].iter().any(|it| endless.contains(&it.1));
            endless = endless.iter().copied().filter(goes_on).collect();
            if endless.len() == before {
                break;
            }
        }
        if !reached {
            return Some("inf..inf".to_owned());
        }
        // With one more clock, that starts at the firing.
        let measuring = |&entry: &usize| {
            let (marking, mut clocks) = self.list[entry].clone();
            clocks.push(Some(Clock::At(0, 0)));
            (marking, clocks)
        };
        let mut open: Vec<Region> = entries.iter().map(measuring).collect();
        let mut met: HashSet<Region> = open.iter().cloned().collect();
        let (mut min, mut max, mut cut) = (u64::MAX, 0, false);
        while let Some(region) = open.pop() {
            let Some(Some(Clock::At(time, rest))) = region.1.last().copied() else {
                unreachable!()
            };
            if marked(&region) {
                min = min.min(time);
                max = max.max(time + u64::from(rest > 0));
            } else if time > longest {
                cut = true;
            } else {
                let next = successors(self.net, &region).into_iter().map(|it| it.1);
                open.extend(next.filter(|it| met.insert(it.clone())));
            }
        }
        let max = if endless.is_empty() { max.to_string() } else { "inf".to_owned() };
        (min < u64::MAX && (!cut || max == "inf")).then(|| format!("{min}..{max}"))
    }
}
