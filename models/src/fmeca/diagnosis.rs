//! Which failure modes look alike, and which probes would tell them apart.
//!
//! A failure mode is a candidate when it explains the raised flags exactly: all that it always
//! raises are there, and all that are there it raises always or sometimes. So a signature is an
//! interval of sets, and modes whose intervals meet in pairs share some flags all at once.

use super::analysis::{Analysis, MAX_PROBES};
use super::groups::{Groups, MAX_GROUPED, largest};
use super::set::Set;
use std::collections::{BTreeMap, BTreeSet};

/// The most pairs that are told; the rest are counted.
pub const MAX_PAIRS: usize = 10_000;

/// A status of the robot: the flags, failure modes and probes that are possible when an analysis is
/// looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    /// As `sound`.
    pub name: String,
    /// Flags that can be raised.
    pub flags: Set,
    /// Failure modes that can happen.
    pub modes: Set,
    /// Probes that would work.
    pub probes: Set,
}

/// The diagnosability in a status; numbers are places in the lists of the analysis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnosability {
    /// Failure modes that can happen and always raise a flag.
    pub detectable: Vec<usize>,
    /// Failure modes that can happen and that nothing is sure to see.
    pub undetectable: Vec<usize>,
    /// Failure modes that cannot happen.
    pub impossible: Vec<usize>,
    /// Every two that some flags leave open, at most [`MAX_PAIRS`] of them.
    pub pairs: Vec<Pair>,
    /// How many further pairs there are.
    pub pairs_left_out: usize,
    /// The largest sets of failure modes that some flags leave open.
    pub groups: Groups,
    /// The fewest probes that tell all pairs apart that any probe can, the first in their order
    /// among equals.
    pub least_probes: Vec<usize>,
    /// Whether probes could tell all pairs apart.
    pub separable: bool,
}

/// Two failure modes that look alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The two, the earlier one first.
    pub modes: [usize; 2],
    /// Each one of these probes would tell the two apart.
    pub probes: Vec<usize>,
}

impl Analysis {
    /// The status in which all can happen, be raised and be added. Those of a robot after a loss
    /// are [`Status::after`].
    pub fn sound(&self) -> Status {
        Status {
            name: "sound".to_owned(),
            flags: Set::all(self.flags.len()),
            modes: Set::all(self.modes.len()),
            probes: Set::all(self.probes.len()),
        }
    }

    /// The fewest and the most flags that a failure mode raises in a status.
    fn bounds(&self, mode: usize, status: &Status) -> (Set, Set) {
        let mode = &self.modes[mode];
        let least = mode.flags.common(&status.flags);
        let most = least.union(&mode.sometimes.common(&status.flags));
        (least, most)
    }

    /// The flags that leave it open which of several failure modes it is: all of the first set are
    /// raised, and some of the second, which holds the first. `None` when any flags rule one of
    /// them out, or when one of them is no place of a row.
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// let robot = Analysis::shipped("p3dx-delivery").unwrap();
    /// let at = |id| robot.modes().iter().position(|it| it.id == id).unwrap();
    /// let (least, most) = robot.shared(&[at("ODO2"), at("LOC1")], &robot.sound()).unwrap();
    /// assert_eq!(robot.names(&least), ["pose growth"]);
    /// assert_eq!(robot.names(&most), ["pose growth", "backward"]);
    /// ```
    pub fn shared(&self, modes: &[usize], status: &Status) -> Option<(Set, Set)> {
        if modes.iter().any(|&it| it >= self.modes.len()) {
            return None;
        }
        let none = Set::none(self.flags.len());
        let (fewest, widest) =
            modes.iter().fold((none, status.flags.clone()), |(fewest, widest), &mode| {
                let (least, most) = self.bounds(mode, status);
                (fewest.union(&least), widest.common(&most))
            });
        widest.covers(&fewest).then_some((fewest, widest))
    }

    /// Returns the failure modes that can be detected and told from each other in a status.
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// let robot = Analysis::shipped("p3dx-delivery").unwrap();
    /// let told = robot.diagnose(&robot.sound());
    /// let groups: Vec<_> = told.groups.list.into_iter().map(|it| robot.ids(it)).collect();
    /// assert_eq!(groups[0], ["ODO2", "LOC1", "LOC2"]);
    /// ```
    pub fn diagnose(&self, status: &Status) -> Diagnosability {
        let possible = |&it: &usize| status.modes.has(it);
        let (possible, impossible): (Vec<_>, Vec<_>) = (0..self.modes.len()).partition(possible);
        let is_seen = |&it: &usize| !self.bounds(it, status).0.is_empty();
        let (detectable, undetectable): (Vec<_>, Vec<_>) = possible.into_iter().partition(is_seen);
        // Modes with the same signature are alike, and like the same others: one stands for all.
        let mut kinds: BTreeMap<(Set, Set), Vec<usize>> = BTreeMap::new();
        for &mode in &detectable {
            kinds.entry(self.bounds(mode, status)).or_default().push(mode);
        }
        let mut kinds: Vec<_> = kinds.into_iter().collect();
        kinds.sort_by_key(|(_, modes)| modes[0]);
        let near: Vec<Set> = kinds
            .iter()
            .enumerate()
            .map(|(at, ((least, most), _))| {
                let alike = |((other_least, other_most), _): &((Set, Set), Vec<usize>)| {
                    most.covers(other_least) && other_most.covers(least)
                };
                let others = kinds.iter().enumerate().filter(|(it, kind)| *it != at && alike(kind));
                Set::of(kinds.len(), others.map(|it| it.0))
            })
            .collect();
        let mut told = Diagnosability {
            groups: groups(&kinds, &near),
            detectable,
            undetectable,
            impossible,
            pairs: Vec::new(),
            pairs_left_out: 0,
            least_probes: Vec::new(),
            separable: true,
        };
        self.pairs(&mut told, &kinds, &near, status);
        told
    }

    /// The pairs, and the least probes against all of them.
    fn pairs(
        &self,
        told: &mut Diagnosability,
        kinds: &[((Set, Set), Vec<usize>)],
        near: &[Set],
        status: &Status,
    ) {
        let mut kind_of = vec![0; self.modes.len()];
        for (at, (_, modes)) in kinds.iter().enumerate() {
            modes.iter().for_each(|&mode| kind_of[mode] = at);
        }
        // Bit by bit, the probes of the status that would show a mode.
        let shown: Vec<u16> = (0..self.modes.len())
            .map(|mode| {
                let probes = status.probes.iter().filter_map(|at| Some((at, self.probes.get(at)?)));
                let shows = probes.filter(|(_, probe)| probe.shows.has(mode));
                shows.fold(0, |bits, (at, _)| bits | 1 << at)
            })
            .collect();
        let mut wanted = BTreeSet::new();
        for (at, &one) in told.detectable.iter().enumerate() {
            for &other in &told.detectable[at + 1..] {
                let (kind, other_kind) = (kind_of[one], kind_of[other]);
                if kind != other_kind && !near[kind].has(other_kind) {
                    continue;
                }
                let probes = shown[one] ^ shown[other];
                if probes == 0 {
                    told.separable = false;
                } else {
                    wanted.insert(probes);
                }
                if told.pairs.len() < MAX_PAIRS {
                    told.pairs.push(Pair { modes: [one, other], probes: bits(probes) });
                } else {
                    told.pairs_left_out += 1;
                }
            }
        }
        told.least_probes = bits(least(&wanted, self.probes.len()));
    }
}

/// The largest groups of failure modes, from those of their kinds.
fn groups(kinds: &[((Set, Set), Vec<usize>)], near: &[Set]) -> Groups {
    let mut groups = largest(near);
    let alone = (0..kinds.len()).filter(|&it| near[it].is_empty());
    groups.list.extend(alone.map(|it| vec![it]));
    for group in &mut groups.list {
        *group = group.iter().flat_map(|&kind| kinds[kind].1.iter().copied()).collect();
        group.sort_unstable();
    }
    groups.list.retain(|it| it.len() > 1);
    groups.list.sort_unstable();
    let mut members = 0;
    let all = groups.list.len();
    groups.list.retain(|group| {
        members += group.len();
        members <= MAX_GROUPED
    });
    groups.complete &= groups.list.len() == all;
    groups
}

/// The fewest of so many bits of which each of the sets has one, the smallest number among equals.
/// Exact: every subset is looked at.
fn least(wanted: &BTreeSet<u16>, bits: usize) -> u16 {
    // For each set of bits, whether one of the wanted lies in it.
    let mut holds = vec![false; 1 << bits.min(MAX_PROBES)];
    wanted.iter().for_each(|&it| holds[usize::from(it)] = true);
    for bit in (0..bits.min(MAX_PROBES)).map(|it| 1 << it) {
        for set in (0..holds.len()).filter(|set| set & bit != 0) {
            holds[set] |= holds[set ^ bit];
        }
    }
    // A set has one bit of each where none of them lies in what is left out.
    let all = holds.len() - 1;
    let fewest = (0..=all).filter(|&set| !holds[all & !set]);
    fewest.min_by_key(|set| (set.count_ones(), *set)).unwrap_or(all) as u16
}

fn bits(set: u16) -> Vec<usize> {
    (0..16).filter(|bit| set & (1 << bit) != 0).collect()
}
