//! A net while it is reduced.

use super::record::Record;
use super::supply::Supply;
use super::trail::{Tokens, Trail};
use super::{Goal, Keep, Limits};
use cotama_core::net::PlaceId;
use cotama_property::pt::{Bounds, Lists, Pt};
use std::collections::BTreeSet;

/// Numbers by place or by transition, sorted.
pub(super) type Row = Vec<(u32, i64)>;

/// A transition: what it needs and how it changes places, both sorted by place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Move {
    pub(super) needs: Vec<(u32, u32)>,
    pub(super) effects: Row,
    /// Number of the step in the record that the transition stands for.
    pub(super) step: u32,
}

impl Move {
    pub(super) fn need(&self, place: u32) -> u32 {
        self.needs.binary_search_by_key(&place, |it| it.0).map_or(0, |at| self.needs[at].1)
    }

    pub(super) fn effect(&self, place: u32) -> i64 {
        self.effects.binary_search_by_key(&place, |it| it.0).map_or(0, |at| self.effects[at].1)
    }

    /// Returns the tokens needed to fire so many times, at least once, in a row.
    pub(super) fn needs_of_times(&self, times: u32) -> Option<Vec<(u32, u32)>> {
        let need = |&(place, need): &(u32, u32)| {
            let lost =
                self.effect(place).min(0).unsigned_abs().checked_mul(u64::from(times) - 1)?;
            Some((place, u32::try_from(lost.checked_add(need.into())?).ok()?))
        };
        self.needs.iter().map(need).collect()
    }

    /// So many times in a row; the step is that of one.
    pub(super) fn times(&self, times: u32) -> Option<Self> {
        let effect = |&(place, by): &(u32, i64)| Some((place, by.checked_mul(times.into())?));
        let effects = self.effects.iter().map(effect).collect::<Option<_>>()?;
        Some(Self { needs: self.needs_of_times(times)?, effects, step: self.step })
    }

    /// This one, right after it the other one; `None` when numbers grow too large.
    pub(super) fn then(&self, next: &Self, step: u32) -> Option<Self> {
        let mut needs = Vec::new();
        for place in merged(&self.needs, &next.needs) {
            let missing = i64::from(next.need(place)).checked_sub(self.effect(place))?;
            let need = i64::from(self.need(place)).max(missing);
            if need > 0 {
                needs.push((place, u32::try_from(need).ok()?));
            }
        }
        let mut effects = Vec::new();
        for place in merged(&self.effects, &next.effects) {
            let by = self.effect(place).checked_add(next.effect(place))?;
            if by != 0 {
                effects.push((place, by));
            }
        }
        Some(Self { needs, effects, step })
    }

    pub(super) fn arcs(&self) -> usize {
        self.needs.len() + self.effects.len()
    }
}

fn merged<A, B>(a: &[(u32, A)], b: &[(u32, B)]) -> Vec<u32> {
    let mut all: Vec<u32> = a.iter().map(|it| it.0).chain(b.iter().map(|it| it.0)).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Arcs between two looks at the clock.
const TICK: u64 = 1 << 16;

/// Ids of places are those of the original net, of transitions they grow as some are replaced.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) initial: Vec<u32>,
    pub(super) present: Vec<bool>,
    pub(super) visible: Vec<bool>,
    pub(super) moves: Vec<Option<Move>>,
    /// For each place the transitions that need or change it.
    pub(super) users: Vec<BTreeSet<u32>>,
    /// Number of arcs of all transitions.
    pub(super) arcs: usize,
    pub(super) most_arcs: usize,
    pub(super) goal: Goal,
    /// How much more may be looked at.
    work: u64,
    /// How much was left when the clock was looked at.
    looked: u64,
    limits: Limits,
    pub(super) record: Record,
}

impl Draft {
    pub(super) fn new(pt: &Pt, keep: &Keep, limits: &Limits, work: u64) -> Self {
        let moves: Vec<_> = (0..pt.transitions.len() as u32)
            .map(|it| {
                let (needs, effects) = (pt.needs.of(it).to_vec(), pt.effects.of(it).to_vec());
                Some(Move { needs, effects, step: it })
            })
            .collect();
        let arcs = moves.iter().flatten().map(Move::arcs).sum();
        let of = |place: u32| {
            let changers = pt.changers.of(place).iter().map(|it| it.0);
            pt.consumers.of(place).iter().map(|it| it.0).chain(changers).collect()
        };
        Self {
            initial: pt.initial.clone(),
            present: vec![true; pt.places.len()],
            visible: keep.visible(pt),
            users: (0..pt.places.len() as u32).map(of).collect(),
            arcs,
            most_arcs: 2 * arcs + 100,
            goal: keep.goal,
            work,
            looked: work,
            limits: *limits,
            record: Record::new(moves.len()),
            moves,
        }
    }

    /// The places that are left.
    pub(super) fn places(&self) -> Vec<u32> {
        (0..self.present.len() as u32).filter(|&it| self.present[it as usize]).collect()
    }

    /// The transitions that are left.
    pub(super) fn transitions(&self) -> impl Iterator<Item = (u32, &Move)> {
        self.moves.iter().enumerate().filter_map(|(at, it)| Some((at as u32, it.as_ref()?)))
    }

    /// The transitions that need or change a place.
    pub(super) fn users(&self, place: u32) -> impl Iterator<Item = (u32, &Move)> {
        self.users[place as usize]
            .iter()
            .filter_map(|&at| Some((at, self.moves[at as usize].as_ref()?)))
    }

    /// How transitions change a place.
    pub(super) fn row(&self, place: u32) -> Row {
        self.users(place).map(|(at, it)| (at, it.effect(place))).filter(|it| it.1 != 0).collect()
    }

    pub(super) fn is_visible(&self, transition: &Move) -> bool {
        transition.effects.iter().any(|it| self.visible[it.0 as usize])
    }

    /// Counts work; `false` when there was enough of it.
    pub(super) fn spend(&mut self, work: usize) -> bool {
        self.work = self.work.saturating_sub(work as u64);
        if self.looked - self.work > TICK {
            self.looked = self.work;
            if self.limits.is_over() {
                (self.work, self.looked) = (0, 0);
            }
        }
        self.work > 0
    }

    pub(super) fn add(&mut self, transition: Move) {
        let at = self.moves.len() as u32;
        self.moves.push(None);
        self.put(at, transition);
    }

    /// Puts a transition at the position of one that was removed.
    pub(super) fn put(&mut self, at: u32, transition: Move) {
        debug_assert!(self.moves[at as usize].is_none(), "its position is free");
        debug_assert!(transition.needs.is_sorted_by_key(|it| it.0));
        debug_assert!(transition.effects.is_sorted_by_key(|it| it.0));
        debug_assert!(transition.needs.iter().all(|it| self.present[it.0 as usize]));
        for place in merged(&transition.needs, &transition.effects) {
            self.users[place as usize].insert(at);
        }
        self.arcs += transition.arcs();
        self.moves[at as usize] = Some(transition);
    }

    pub(super) fn remove(&mut self, transition: u32) -> Option<Move> {
        let removed = self.moves[transition as usize].take()?;
        for place in merged(&removed.needs, &removed.effects) {
            self.users[place as usize].remove(&transition);
        }
        self.arcs -= removed.arcs();
        Some(removed)
    }

    /// Takes a place away: nothing needs or changes it any more.
    pub(super) fn drop_place(&mut self, place: u32) {
        debug_assert!(self.present[place as usize], "a place is dropped once");
        for at in std::mem::take(&mut self.users[place as usize]) {
            let Some(it) = &mut self.moves[at as usize] else { continue };
            self.arcs -= it.arcs();
            it.needs.retain(|it| it.0 != place);
            it.effects.retain(|it| it.0 != place);
            self.arcs += it.arcs();
        }
        self.present[place as usize] = false;
    }

    /// Returns the remaining net, of which no place is filled yet.
    pub(super) fn supply(&self) -> Supply {
        Supply::new(
            self.initial.clone(),
            Lists::new(self.transitions().map(|(_, it)| it.needs.iter().copied())),
            Lists::new(self.transitions().map(|(_, it)| it.effects.iter().copied())),
        )
    }

    fn roots(&self) -> Vec<u32> {
        self.transitions().map(|(_, it)| it.step).collect()
    }

    /// Begins a new layer, above one that is supplied.
    pub(super) fn supplied(&mut self, supply: Supply, names: &mut Vec<String>) {
        let roots = self.roots();
        *names = self.record.names(&roots, names);
        self.record.supplied(roots, supply);
        for (at, it) in self.moves.iter_mut().flatten().enumerate() {
            it.step = at as u32;
        }
    }

    /// The reduced net and the way back.
    pub(super) fn finished(self, pt: &Pt, below: &[String]) -> (Pt, Trail) {
        debug_assert_eq!(self.arcs, self.transitions().map(|it| it.1.arcs()).sum::<usize>());
        let places = self.places();
        let roots = self.roots();
        let mut values = vec![None; self.present.len()];
        let mut id = vec![0; self.present.len()];
        for (at, &place) in places.iter().enumerate() {
            id[place as usize] = at as u32;
            values[place as usize] =
                Some(Tokens { constant: 0, weights: vec![(PlaceId(at as u32), 1)] });
        }
        let lowered =
            |row: &[(u32, i64)]| row.iter().map(|it| (id[it.0 as usize], it.1)).collect::<Vec<_>>();
        let needs = self
            .transitions()
            .map(|(_, it)| it.needs.iter().map(|it| (id[it.0 as usize], it.1)).collect::<Vec<_>>());
        let (needs, effects) =
            (Lists::new(needs), Lists::new(self.transitions().map(|(_, it)| lowered(&it.effects))));
        let given = |(_, it): (u32, &Move)| {
            let gives =
                it.effects.iter().filter(|&&(place, by)| by + i64::from(it.need(place)) > 0);
            let reads = it.needs.iter().filter(|&&(place, _)| it.effect(place) == 0);
            it.needs.len() + gives.count() + reads.count()
        };
        let net = Pt {
            name: pt.name.clone(),
            places: places.iter().map(|&it| pt.places[it as usize].clone()).collect(),
            transitions: self.record.names(&roots, below),
            initial: places.iter().map(|&it| self.initial[it as usize]).collect(),
            consumers: needs.reversed(places.len()),
            changers: effects.reversed(places.len()),
            arcs: self.transitions().map(given).sum(),
            special: None,
            bounds: Bounds::default(),
            needs,
            effects,
        };
        (net, self.record.trail(roots, values))
    }
}
