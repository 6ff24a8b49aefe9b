//! The greatest of the markings met.

use super::tokens::{Tokens, at_most, support};
use std::collections::{BTreeMap, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};

/// Numbers of markings none of which is at most another. The markings stand elsewhere.
#[derive(Debug)]
pub(super) struct Antichain {
    places: usize,
    /// Markings with ω in the same places.
    groups: Vec<Group>,
    /// By hash the last marking with it, of all that were ever added; and for each marking the one
    /// before it.
    last: HashMap<u64, u32>,
    before: Vec<u32>,
}

#[derive(Debug)]
struct Group {
    omegas: Vec<u32>,
    /// By the sum of the tokens in the other places: marked places (see [`support`]) and number.
    levels: BTreeMap<u128, Vec<(u64, u32)>>,
}

const NONE: u32 = u32::MAX;

impl Antichain {
    pub(super) fn new(places: usize) -> Self {
        Self { places, groups: Vec::new(), last: HashMap::new(), before: Vec::new() }
    }

    /// The numbers, sorted.
    pub(super) fn ids(&self) -> Vec<u32> {
        let levels = self.groups.iter().flat_map(|it| it.levels.values());
        let mut ids: Vec<u32> = levels.flatten().map(|it| it.1).collect();
        ids.sort_unstable();
        ids
    }

    /// Whether a marking is at most one that is here. `all` has the markings by number.
    pub(super) fn covers(&self, marking: &[Tokens], all: &[Tokens]) -> bool {
        // An earlier marking is covered by a stored one.
        let mut same = self.last.get(&hash(marking)).copied().unwrap_or(NONE);
        while same != NONE {
            if self.of(same, all) == marking {
                return true;
            }
            same = self.before[same as usize];
        }
        let (marked, omegas, sum) = (support(marking), omegas(marking), sum(marking));
        self.groups.iter().filter(|it| among(&omegas, &it.omegas)).any(|group| {
            let extra = group.omegas.iter().filter_map(|&it| marking[it as usize].finite());
            let least = sum - extra.map(u128::from).sum::<u128>()
                + u128::from(group.omegas.len() == omegas.len());
            group
                .levels
                .range(least..)
                .flat_map(|it| it.1)
                .any(|&(support, id)| marked & !support == 0 && at_most(marking, self.of(id, all)))
        })
    }

    /// Adds the marking of a number, which is not covered and the last one in `all`; those at most
    /// it go.
    pub(super) fn add(&mut self, id: u32, all: &[Tokens], mut gone: impl FnMut(u32)) {
        let marking = self.of(id, all);
        debug_assert!(!self.covers(marking, all), "only what is not covered is added");
        let (marked, omegas, sum, places) =
            (support(marking), omegas(marking), sum(marking), self.places);
        for group in self.groups.iter_mut().filter(|it| among(&it.omegas, &omegas)) {
            let most = if group.omegas.len() == omegas.len() { sum } else { u128::MAX };
            for (_, level) in group.levels.range_mut(..most) {
                level.retain(|&(support, it)| {
                    let other = &all[it as usize * places..][..places];
                    let goes = support & !marked == 0 && at_most(other, marking);
                    if goes {
                        gone(it);
                    }
                    !goes
                });
            }
            group.levels.retain(|_, level| !level.is_empty());
        }
        self.groups.retain(|it| !it.levels.is_empty());
        let at = self.groups.iter().position(|it| it.omegas == omegas).unwrap_or_else(|| {
            self.groups.push(Group { omegas, levels: BTreeMap::new() });
            self.groups.len() - 1
        });
        self.groups[at].levels.entry(sum).or_default().push((marked, id));
        self.before.resize(id as usize + 1, NONE);
        self.before[id as usize] = self.last.insert(hash(marking), id).unwrap_or(NONE);
    }

    fn of<'a>(&self, id: u32, all: &'a [Tokens]) -> &'a [Tokens] {
        &all[id as usize * self.places..][..self.places]
    }
}

fn hash(marking: &[Tokens]) -> u64 {
    let mut hasher = DefaultHasher::new();
    marking.hash(&mut hasher);
    hasher.finish()
}

fn omegas(marking: &[Tokens]) -> Vec<u32> {
    (0..).zip(marking).filter(|it| it.1.is_omega()).map(|it| it.0).collect()
}

fn sum(marking: &[Tokens]) -> u128 {
    marking.iter().filter_map(|it| it.finite()).map(u128::from).sum()
}

/// Whether sorted places are among others.
fn among(some: &[u32], others: &[u32]) -> bool {
    let mut others = others.iter();
    some.iter().all(|it| others.any(|other| other == it))
}
