//! The graph of a net with watches, from that of the net without: a marking is one of the net
//! without, and what the watches hold. What a net does is explored once, however many watches look
//! at it.

use super::bits::BitSet;
use super::cache_padded::CachePadded;
use super::goal::Goal;
use super::graph::Graph;
use super::look::Look;
use super::memory::Memory;
use super::store::{Asked, MarkingStore};
use super::view::View;
use super::watching::{Counts, Needs, Watching};
use super::{Limit, Limits, Progress, Unfinished};
use cotama_core::net::PlaceId;
use cotama_property::pt::{Lists, Pt};
use cotama_property::{Atom, Condition, Formula, Linear, Marking};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// Markings between two looks at the clock.
const TICK: usize = 1 << 12;

/// Marks a missing number.
const NONE: u32 = u32::MAX;

/// The markings of a net with watches.
#[derive(Debug)]
pub(super) struct Watched {
    base: Arc<Graph>,
    watching: Watching,
    needs: Needs,
    /// The counts that watches have in some marking.
    held: Vec<Counts>,
    /// For each marking that of the net without watches, and what they hold.
    pairs: Vec<(u32, u32)>,
}

/// A marking of which single places are asked.
struct At<'w> {
    base: &'w Graph,
    watching: &'w Watching,
    state: u32,
    held: &'w Counts,
}

impl Marking for At<'_> {
    #[inline]
    fn tokens(&self, place: PlaceId) -> u64 {
        self.watching.tokens(place, self.held, |it| self.base.held(self.state, it))
    }
}

impl Watched {
    /// The markings in which the goal holds: for all that the watches hold it is asked of the
    /// markings of the net without them. `None` when it cannot be asked so.
    fn of_watches(&self, goal: Goal<'_>, jobs: usize) -> Option<BitSet> {
        let formula = goal.formula()?;
        let (mut sets, mut numbers) = (Vec::new(), HashMap::new());
        let mut set_of = |held| {
            let told = self.watching.told(formula, held, &self.needs)?;
            let number = numbers.entry(told).or_insert_with_key(|told| {
                sets.push(self.satisfied(told, jobs));
                sets.len() - 1
            });
            Some(*number)
        };
        let of: Vec<usize> = self.held.iter().map(&mut set_of).collect::<Option<_>>()?;
        let mut found = BitSet::new(self.pairs.len(), false);
        for (&(state, held), number) in self.pairs.iter().zip(0..) {
            let holds = match &sets[of[held as usize]] {
                Holds::Everywhere(holds) => *holds,
                Holds::In(set) => set.has(state),
            };
            if holds {
                found.insert(number);
            }
        }
        Some(found)
    }

    fn satisfied(&self, told: &Formula, jobs: usize) -> Holds {
        match (told, Goal::new(told)) {
            (Formula::And(all), _) if all.is_empty() => Holds::Everywhere(true),
            (Formula::Or(all), _) if all.is_empty() => Holds::Everywhere(false),
            (_, Some(goal)) => Holds::In(self.base.satisfying(goal, jobs)),
            (_, None) => Holds::Everywhere(false),
        }
    }
}

impl MarkingStore for Watched {
    fn held(&self, state: u32, place: PlaceId) -> u64 {
        let (state, held) = self.pairs[state as usize];
        let held = &self.held[held as usize];
        At { base: &self.base, watching: &self.watching, state, held }.tokens(place)
    }

    fn marking(&self, state: u32) -> Vec<u32> {
        let (state, held) = self.pairs[state as usize];
        let base = self.base.marking(state);
        let of = |it: PlaceId| base.get(it.0 as usize).copied().unwrap_or(0).into();
        let held = &self.held[held as usize];
        let places = 0..self.watching.places.len() as u32;
        places.map(|it| self.watching.tokens(PlaceId(it), held, of) as u32).collect()
    }

    fn bytes(&self) -> u64 {
        size_of_val(&self.pairs[..]) as u64
    }

    fn each(&self, states: &mut dyn Iterator<Item = u32>, look: &mut dyn FnMut(&Look<'_>)) {
        let Needs { own, looks } = &self.needs;
        let words = (*own as usize + looks.len()).div_ceil(64);
        let mut view = View { enabled: CachePadded::new(0, words), ..View::default() };
        for state in states {
            let tokens = self.marking(state);
            view.enabled.fill(0);
            let (base, held) = self.pairs[state as usize];
            if self.held[held as usize].looks.is_none() {
                let of_net = self.base.enabled(std::iter::once(base));
                view.enabled.iter_mut().zip(of_net).for_each(|(it, own)| *it = own);
            } else {
                for (it, transition) in (0..looks.len() as u32).zip(*own as usize..) {
                    let enough = |need: &(u32, u32)| tokens[need.0 as usize] >= need.1;
                    let is_enabled = looks.of(it).iter().all(enough);
                    view.enabled[transition / 64] |= u64::from(is_enabled) << (transition % 64);
                }
            }
            view.sum = tokens.iter().map(|&it| u64::from(it)).sum();
            look(&Look::plain(&tokens, &view));
        }
    }

    fn satisfying(&self, goal: Goal<'_>, asked: Asked<'_>) -> BitSet {
        self.of_watches(goal, asked.jobs).unwrap_or_else(|| self.each_satisfying(goal, asked))
    }
}

/// The markings in which a formula about the net without watches holds.
enum Holds {
    Everywhere(bool),
    In(BitSet),
}

impl Graph {
    /// The graph of a net with watches from that of the net without, with the same numbers as if
    /// it were [made](Self::new) of the net alone; `None` when it is no such net.
    ///
    /// # Errors
    /// The limit that was reached, and how many markings there were before.
    pub(crate) fn watched(
        base: &Arc<Self>,
        (pt, watching): (&Pt, &Watching),
        limits: &Limits,
        progress: &dyn Fn(Progress),
    ) -> Option<Result<Self, Unfinished>> {
        let transitions = pt.transitions.len() as u32;
        if watching.places.len() != pt.places.len() || base.transitions > transitions {
            return None;
        }
        let mut search = Search::new(base, watching, limits)?;
        let ended = search.explore(limits, progress);
        let states = (search.pairs.len() as u64).min(limits.states);
        let Search { held, pairs, starts, successors, .. } = search;
        let needs = (base.transitions..transitions).map(|it| pt.needs.of(it).iter().copied());
        let needs = Needs { own: base.transitions, looks: Lists::new(needs) };
        let (base, watching) = (Arc::clone(base), watching.clone());
        Some(ended.map_err(|limit| Unfinished { limit, states }).map(|()| {
            let markings = Box::new(Watched { base, watching, needs, held, pairs });
            let (fired, is_injective) = (OnceLock::new(), true);
            Self { markings, starts, successors, transitions, fired, is_injective }
        }))
    }
}

/// Pairs of a marking and what watches hold, as they are met.
struct Search<'s> {
    base: &'s Graph,
    watching: &'s Watching,
    /// For each place that lets watches look the markings in which it is marked, and the first
    /// watch.
    turns: Vec<(BitSet, usize)>,
    /// For each watch its steps.
    steps: Vec<Vec<(u32, Condition<'s>, u32)>>,
    held: Vec<Counts>,
    numbers: HashMap<Counts, u32>,
    /// For each of `held` what follows, [`NONE`] where it was not asked: when one of `turns` comes,
    /// and when the count of the watch that is to look becomes so much.
    entered: Vec<Vec<u32>>,
    counted: Vec<Vec<u32>>,
    pairs: Vec<(u32, u32)>,
    /// For each marking of the net its pair that was met last, and for each pair the one before.
    last: Vec<u32>,
    before: Vec<u32>,
    starts: Vec<usize>,
    successors: Vec<u32>,
    memory: Memory,
}

impl<'s> Search<'s> {
    /// Starts the construction; `None` when a watch looks at more than tokens.
    fn new(base: &'s Graph, watching: &'s Watching, limits: &Limits) -> Option<Self> {
        let mut turns = Vec::new();
        let mut steps = Vec::new();
        for (at, watch) in watching.watches.iter().enumerate() {
            let step = |(from, when, to): &(u32, Formula, u32)| {
                Some((*from, Condition::of_tokens(when)?, *to))
            };
            steps.push(watch.steps.iter().map(step).collect::<Option<_>>()?);
            if watching.next(watch.then, None) == Some(at) {
                let marked = Formula::Atom(Atom::AtMost(Linear::marked(watch.then)));
                turns.push((base.satisfying(Goal::new(&marked)?, 1), at));
            }
        }
        Some(Self {
            base,
            watching,
            turns,
            steps,
            held: Vec::new(),
            numbers: HashMap::new(),
            entered: Vec::new(),
            counted: Vec::new(),
            pairs: Vec::new(),
            last: Vec::new(),
            before: Vec::new(),
            starts: Vec::new(),
            successors: Vec::new(),
            // The graph of the net without watches stays.
            memory: Memory::new(limits.bytes.saturating_sub(base.bytes())),
        })
    }

    fn explore(&mut self, limits: &Limits, progress: &dyn Fn(Progress)) -> Result<(), Limit> {
        let (base, counts) = (self.base, vec![0; self.watching.watches.len()]);
        self.memory.extend(&mut self.last, base.states(), NONE)?;
        let first = self.hold(Counts { looks: None, counts });
        self.number(0, first)?;
        let (mut at, mut depth, mut level) = (0, 0, 1);
        while at < self.pairs.len() {
            if at.is_multiple_of(TICK) {
                let states = self.pairs.len() as u64;
                progress(Progress { states, depth, waiting: states - at as u64 });
                if limits.is_over() {
                    return Err(Limit::Time);
                }
            }
            self.memory.room(&mut self.starts, 1)?;
            self.starts.push(self.successors.len());
            let (state, held) = self.pairs[at];
            match self.held[held as usize].looks {
                Some(watch) => {
                    let next = self.looked(state, held, watch);
                    self.arc(state, next)?;
                }
                None => {
                    for &to in base.successors(state) {
                        let next = self.arrived(state, to, held);
                        self.arc(to, next)?;
                    }
                }
            }
            if self.pairs.len() as u64 > limits.states.min(NONE.into()) {
                return Err(Limit::States);
            }
            at += 1;
            if at == level {
                (level, depth) = (self.pairs.len(), depth + 1);
            }
        }
        self.starts.push(self.successors.len());
        Ok(())
    }

    /// Returns the counts after a firing of the net: the first watch whose place becomes marked is
    /// to look.
    fn arrived(&mut self, from: u32, to: u32, held: u32) -> u32 {
        let turn = self.turns.iter().position(|it| it.0.has(to) && !it.0.has(from));
        let Some(turn) = turn else { return held };
        let known = self.entered[held as usize][turn];
        if known != NONE {
            return known;
        }
        let looks = Some(self.turns[turn].1);
        let next = self.hold(Counts { looks, ..self.held[held as usize].clone() });
        self.entered[held as usize][turn] = next;
        next
    }

    /// Returns the counts after one of the watches has looked.
    fn looked(&mut self, state: u32, number: u32, watch: usize) -> u32 {
        let (base, watching) = (self.base, self.watching);
        let held = &self.held[number as usize];
        let count = held.counts[watch];
        let at = At { base, watching, state, held };
        let mut steps = self.steps[watch].iter().filter(|it| it.0 == count);
        let count = steps.find(|it| it.1.holds(&at)).map_or(count, |it| it.2);
        let known = self.counted[number as usize].get(count as usize).copied();
        if let Some(known) = known.filter(|it| *it != NONE) {
            return known;
        }
        let looks = watching.next(watching.watches[watch].then, Some(watch));
        let mut next = Counts { looks, ..held.clone() };
        next.counts[watch] = count;
        let next = self.hold(next);
        let counted = &mut self.counted[number as usize];
        counted.resize(counted.len().max(count as usize + 1), NONE);
        counted[count as usize] = next;
        next
    }

    /// The number of what watches hold.
    fn hold(&mut self, held: Counts) -> u32 {
        *self.numbers.entry(held).or_insert_with_key(|held| {
            self.held.push(held.clone());
            self.entered.push(vec![NONE; self.turns.len()]);
            self.counted.push(Vec::new());
            self.held.len() as u32 - 1
        })
    }

    fn arc(&mut self, state: u32, held: u32) -> Result<(), Limit> {
        let to = self.number(state, held)?;
        self.memory.room(&mut self.successors, 1)?;
        self.successors.push(to);
        Ok(())
    }

    /// The number of a pair; a new one gets the next number.
    fn number(&mut self, state: u32, held: u32) -> Result<u32, Limit> {
        let last = self.last[state as usize];
        let mut at = last;
        while at != NONE {
            if self.pairs[at as usize].1 == held {
                return Ok(at);
            }
            at = self.before[at as usize];
        }
        let number = self.pairs.len() as u32;
        self.memory.room(&mut self.pairs, 1)?;
        self.memory.room(&mut self.before, 1)?;
        self.pairs.push((state, held));
        self.before.push(last);
        self.last[state as usize] = number;
        Ok(number)
    }
}
