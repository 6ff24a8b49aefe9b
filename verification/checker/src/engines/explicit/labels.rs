//! Labels of formulas about one marking: inequality by inequality, of all markings at once. They
//! are stored for the next formula, which mostly speaks of the same places.

use super::bits::BitSet;
use super::goal::Goal;
use super::implied::Implied;
use super::layout::{Field, Layout};
use super::packed::{Packed, WORTH};
use super::store::Asked;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::{Atom, Formula, Linear};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// The most inequalities of a formula that is looked at so. In a longer one mostly the first few
/// decide about a marking, and the others need not be looked at.
const FEW: usize = 64;

type Sets = HashMap<Linear, Arc<BitSet>>;

/// Sets of inequalities, as many as memory allows.
#[derive(Debug, Default)]
pub(super) struct Labels {
    /// How many bytes they may take.
    most: u64,
    sets: Mutex<Sets>,
}

impl Labels {
    /// Returns the markings in which the goal holds; `None` where they are to be looked at one by
    /// one.
    pub(super) fn satisfying(
        &self,
        packed: &Packed,
        goal: Goal<'_>,
        asked: Asked<'_>,
    ) -> Option<BitSet> {
        let fires = |it: &Formula| matches!(it, Formula::Atom(Atom::Fireable(_)));
        let formula = goal.formula()?;
        if packed.needs.is_none() && formula.any(&fires) {
            return None;
        }
        let mut all = Vec::new();
        inequalities(formula, packed, &mut all);
        let fit = self.most / BitSet::bytes(asked.states).max(1);
        if all.len() > FEW || all.len() as u64 > fit {
            return None;
        }
        let sets = self.sets(all, packed, asked)?;
        Some(labelled(formula, packed, &sets, asked))
    }

    /// Returns the markings in which these hold; `None` when numbers could get too large.
    fn sets(&self, mut all: Vec<Linear>, packed: &Packed, asked: Asked<'_>) -> Option<Sets> {
        let mut stored = self.sets.lock().unwrap_or_else(PoisonError::into_inner);
        let mut sets = Sets::new();
        all.retain(|it| {
            sets.extend(stored.get(it).map(|set| (it.clone(), Arc::clone(set))));
            !sets.contains_key(it)
        });
        let layout = &packed.space.layout;
        let fast = all.iter().map(|it| Inequality::new(it, layout)).collect::<Option<Vec<_>>>()?;
        let Asked { states, jobs, .. } = asked;
        for (linear, words) in all.into_iter().zip(words_of(packed, &fast, states, jobs)) {
            let set = Arc::new(BitSet::from_words(words, states));
            if BitSet::bytes(states) * (stored.len() as u64 + 1) <= self.most {
                stored.insert(linear.clone(), Arc::clone(&set));
            }
            sets.insert(linear, set);
        }
        Some(sets)
    }

    /// Makes the labels of a graph of so many bytes, where so many more may be used.
    pub(super) fn new(graph: u64, free: u64) -> Self {
        Self { most: (graph / 2).min(free / 4), sets: Mutex::default() }
    }

    /// About how much memory they take, of so many states.
    pub(super) fn bytes(&self, states: usize) -> u64 {
        let count = self.sets.lock().unwrap_or_else(PoisonError::into_inner).len();
        BitSet::bytes(states) * count as u64
    }
}

/// Returns the markings in which a formula holds, from those in which its inequalities hold.
fn labelled(formula: &Formula, packed: &Packed, sets: &Sets, asked: Asked<'_>) -> BitSet {
    let states = asked.states;
    let joined = |parts: &mut dyn Iterator<Item = BitSet>, and: bool| {
        parts.fold(BitSet::new(states, and), |mut set, part| {
            if and {
                set.and(&part);
            } else {
                set.or(&part);
            }
            set
        })
    };
    let at_most = |it: &Linear| {
        sets.get(it).map_or_else(|| BitSet::new(states, false), |it| BitSet::clone(it))
    };
    let each = |it: &Formula| labelled(it, packed, sets, asked);
    match formula {
        Formula::Not(inner) => each(inner).complement(),
        Formula::And(parts) => joined(&mut parts.iter().map(each), true),
        Formula::Or(parts) => joined(&mut parts.iter().map(each), false),
        Formula::Atom(Atom::AtMost(linear)) => at_most(linear),
        Formula::Atom(Atom::Fireable(transitions)) => {
            let enabled =
                |it: &TransitionId| joined(&mut needed(packed, it.0).map(|it| at_most(&it)), true);
            joined(&mut transitions.iter().map(enabled), false)
        }
        Formula::Atom(Atom::Deadlock) => {
            let mut set = BitSet::new(states, false);
            let dead = |it: &u32| (asked.is_dead)(*it);
            (0..states as u32).filter(dead).for_each(|it| set.insert(it));
            set
        }
        // `Goal::new` lets no other formula pass.
        _ => BitSet::new(states, false),
    }
}

/// The inequalities of a formula, each once, with what its transitions need.
fn inequalities(formula: &Formula, packed: &Packed, all: &mut Vec<Linear>) {
    let mut add = |linear: Linear| {
        // No more are asked for than that there are too many.
        if all.len() <= FEW && !all.contains(&linear) {
            all.push(linear);
        }
    };
    match formula {
        Formula::Atom(Atom::AtMost(linear)) => add(linear.clone()),
        Formula::Atom(Atom::Fireable(transitions)) => {
            transitions.iter().flat_map(|it| needed(packed, it.0)).for_each(add);
        }
        Formula::Not(inner) => inequalities(inner, packed, all),
        Formula::And(parts) | Formula::Or(parts) => {
            parts.iter().for_each(|it| inequalities(it, packed, all));
        }
        _ => {}
    }
}

/// Returns the needs of a transition as inequalities.
fn needed(packed: &Packed, transition: u32) -> impl Iterator<Item = Linear> {
    let needs = packed.needs.as_ref().map_or(&[][..], |it| it.of(transition));
    needs.iter().map(|&(place, tokens)| {
        let weights = vec![(PlaceId(place), -1)];
        Linear { constant: tokens.into(), weights }
    })
}

/// For each inequality a bit for each marking, looked at by so many threads.
fn words_of(packed: &Packed, all: &[Inequality], states: usize, jobs: usize) -> Vec<Vec<u64>> {
    let some = |markings: &[u64]| {
        let blocks = markings.len().div_ceil(64 * packed.words);
        let mut words = vec![Vec::with_capacity(blocks); all.len()];
        for block in markings.chunks(64 * packed.words) {
            for (words, it) in words.iter_mut().zip(all) {
                let markings = block.chunks_exact(packed.words).enumerate();
                let bits = markings.map(|(bit, marking)| u64::from(it.holds(marking)) << bit);
                words.push(bits.fold(0, |word, bit| word | bit));
            }
        }
        words
    };
    if all.is_empty() {
        return Vec::new();
    }
    let jobs = jobs.clamp(1, states.div_ceil(WORTH));
    let part = states.div_ceil(64).div_ceil(jobs).max(1) * 64 * packed.words;
    let mut parts = packed.markings.chunks(part);
    let first = parts.next().unwrap_or_default();
    thread::scope(|scope| {
        let others: Vec<_> = parts.map(|it| scope.spawn(move || some(it))).collect();
        let mut words = some(first);
        for other in others {
            // A thread that panicked ends the program as it would have without threads.
            let other = other.join().unwrap_or_else(|it| std::panic::resume_unwind(it));
            words.iter_mut().zip(other).for_each(|(words, other)| words.extend(other));
        }
        words
    })
}

/// `constant + sum of parts <= 0`, over the words of a marking.
struct Inequality {
    constant: i64,
    parts: Vec<Part>,
}

/// So many times something in a word.
struct Part {
    word: usize,
    weight: i64,
    tokens: Tokens,
}

enum Tokens {
    /// The field of a place.
    Field { shift: u32, mask: u64 },
    /// The bits of places with one bit each.
    Bits(u64),
}

impl Inequality {
    /// Compiles an inequality; `None` when numbers could get too large.
    fn new(linear: &Linear, layout: &Layout) -> Option<Self> {
        let mut constant = linear.constant;
        let mut weights: BTreeMap<u32, i64> = BTreeMap::new();
        let mut add = |place: u32, by: i64| {
            let sum = weights.entry(place).or_default();
            *sum = sum.checked_add(by)?;
            Some(())
        };
        for &(PlaceId(place), weight) in &linear.weights {
            match layout.implied.binary_search_by_key(&place, |it| it.place) {
                Err(_) => add(place, weight)?,
                Ok(at) => {
                    let Implied { constant: more, terms, .. } = &layout.implied[at];
                    constant = constant.checked_add(weight.checked_mul(*more)?)?;
                    for &(place, by) in terms {
                        add(place, weight.checked_mul(by)?)?;
                    }
                }
            }
        }
        let (mut parts, mut bits) = (Vec::new(), BTreeMap::new());
        let mut most = i128::from(constant).abs();
        for (place, weight) in weights.into_iter().filter(|it| it.1 != 0) {
            // Places that are not there hold nothing.
            let Some(&Field { word, shift, width }) = layout.fields.get(place as usize) else {
                continue;
            };
            let mask = u64::MAX.checked_shr(u64::BITS - width)?;
            most += i128::from(weight).abs() * i128::from(mask);
            if width == 1 {
                *bits.entry((word, weight)).or_insert(0) |= 1_u64 << shift;
            } else {
                parts.push(Part { word, weight, tokens: Tokens::Field { shift, mask } });
            }
        }
        for ((word, weight), mask) in bits {
            let tokens = match mask.count_ones() {
                1 => Tokens::Field { shift: mask.trailing_zeros(), mask: 1 },
                _ => Tokens::Bits(mask),
            };
            parts.push(Part { word, weight, tokens });
        }
        (most < i64::MAX.into()).then_some(Self { constant, parts })
    }

    #[inline]
    fn holds(&self, marking: &[u64]) -> bool {
        let sum = self.parts.iter().fold(self.constant, |sum, it| {
            let tokens = match it.tokens {
                Tokens::Field { shift, mask } => (marking[it.word] >> shift) & mask,
                Tokens::Bits(mask) => (marking[it.word] & mask).count_ones().into(),
            };
            sum + it.weight * tokens.cast_signed()
        });
        sum <= 0
    }
}
