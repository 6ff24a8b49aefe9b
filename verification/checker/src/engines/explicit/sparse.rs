//! Markings of nets that are too wide to be packed: each as what differs from the initial one.

use super::cache_padded::CachePadded;
use super::index::{Index, hash};
use super::look::Look;
use super::memory::Memory;
use super::view::View;
use super::{Limit, Limits};
use cotama_property::pt::{Lists, Pt, Special};

/// The parts of a net needed to fire.
#[derive(Debug)]
struct Arcs {
    initial: Vec<u32>,
    needs: Lists<u32>,
    effects: Lists<i64>,
    consumers: Lists<u32>,
    special: Option<Box<Special>>,
}

/// Markings with numbers in the order in which they are met; the initial one has number 0.
#[derive(Debug)]
pub(super) struct Sparse {
    arcs: Arcs,
    /// For each marking where it ends: the places that hold other numbers of tokens than at the
    /// start, in their order, in the upper half of a word, and the tokens in the lower half.
    ends: Vec<usize>,
    changes: Vec<u64>,
    index: Index,
    after: Vec<u64>,
}

/// A marking that is looked at, and what it enables: the next one costs what differs from it.
#[derive(Clone, Debug)]
pub(super) struct Cursor {
    at: u32,
    tokens: Vec<u32>,
    view: View,
    /// A bit for each transition that has what it needs, where more than that decides.
    ready: Vec<u64>,
    /// Places whose tokens may differ, and those that they had.
    before: Vec<(u32, u32)>,
}

const fn change(place: u32, tokens: u32) -> u64 {
    (place as u64) << 32 | tokens as u64
}

const fn parts(change: u64) -> (u32, u32) {
    ((change >> 32) as u32, change as u32)
}

impl Sparse {
    /// The initial marking, and a look at it.
    ///
    /// # Errors
    /// There is no memory for it.
    pub(super) fn new(pt: &Pt, memory: &mut Memory) -> Result<(Self, Cursor), Limit> {
        let arcs = pt.needs.size() * 2 + pt.effects.size() + 8 * pt.places.len();
        memory.take((arcs + pt.transitions.len() / 8) as u64)?;
        let arcs = Arcs {
            initial: pt.initial.clone(),
            needs: pt.needs.clone(),
            effects: pt.effects.clone(),
            consumers: pt.consumers.clone(),
            special: pt.special.clone(),
        };
        let mut enabled = CachePadded::new(0_u64, pt.transitions.len().div_ceil(64));
        for transition in 0..pt.transitions.len() as u32 {
            let mut needs = pt.needs.of(transition).iter();
            if needs.all(|&(place, tokens)| pt.initial[place as usize] >= tokens) {
                enabled[transition as usize / 64] |= 1 << (transition % 64);
            }
        }
        let sum = pt.initial.iter().map(|&it| u64::from(it)).sum();
        let view = View { enabled, computed: CachePadded::default(), sum };
        let ready = pt.special.iter().flat_map(|_| view.enabled.to_vec()).collect();
        let tokens = pt.initial.clone();
        let mut cursor = Cursor { at: 0, tokens, view, ready, before: Vec::new() };
        let index = Index::default();
        let mut sparse = Self { arcs, ends: Vec::new(), changes: Vec::new(), index, after: vec![] };
        sparse.number(memory, u64::MAX)?;
        sparse.update(&mut cursor);
        Ok((sparse, cursor))
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Bytes of all markings.
    pub(super) fn bytes(&self) -> u64 {
        (size_of_val(&self.ends[..]) + size_of_val(&self.changes[..])) as u64
    }

    /// The places that differ from the start, and their tokens.
    pub(super) fn changes(&self, marking: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        changes(&self.ends, &self.changes, marking).iter().map(|&it| parts(it))
    }

    /// The tokens of each place.
    pub(super) fn marking(&self, marking: u32) -> Vec<u32> {
        let mut tokens = self.arcs.initial.clone();
        self.changes(marking).for_each(|(place, it)| tokens[place as usize] = it);
        tokens
    }

    /// The tokens of a place.
    pub(super) fn tokens(&self, marking: u32, place: u32) -> u32 {
        let all = changes(&self.ends, &self.changes, marking);
        match all.binary_search_by_key(&place, |&it| parts(it).0) {
            Ok(at) => parts(all[at]).1,
            Err(_) => self.arcs.initial[place as usize],
        }
    }

    /// Moves to a marking and looks at it.
    pub(super) fn look<'c>(&self, cursor: &'c mut Cursor, marking: u32) -> Look<'c> {
        if cursor.at != marking {
            cursor.before.clear();
            for (place, tokens) in self.changes(cursor.at) {
                cursor.before.push((place, tokens));
                cursor.tokens[place as usize] = self.arcs.initial[place as usize];
            }
            for (place, tokens) in self.changes(marking) {
                // A place that is listed already keeps what it held before.
                let now = &mut cursor.tokens[place as usize];
                cursor.before.push((place, *now));
                *now = tokens;
            }
            // Only the first entry of a place counts: it is from before, the second one from the
            // start.
            cursor.before.sort_by_key(|it| it.0);
            cursor.before.dedup_by_key(|it| it.0);
            cursor.at = marking;
            self.update(cursor);
        }
        Look::plain(&cursor.tokens, &cursor.view)
    }

    /// Enables and disables what consumes of places that hold more or less than before.
    fn update(&self, cursor: &mut Cursor) {
        let Cursor { tokens, view, before, ready, .. } = cursor;
        let is_plain = self.arcs.special.is_none();
        for (place, was) in before.drain(..) {
            let is = tokens[place as usize];
            view.sum = view.sum.wrapping_sub(u64::from(was)).wrapping_add(u64::from(is));
            for &(transition, need) in self.arcs.consumers.of(place) {
                if (was >= need) == (is >= need) {
                    continue;
                }
                let enough = |&(place, need): &(u32, u32)| tokens[place as usize] >= need;
                let enabled = self.arcs.needs.of(transition).iter().all(enough);
                let (word, bit) = (transition as usize / 64, 1 << (transition % 64));
                let ready = if is_plain { &mut view.enabled[word] } else { &mut ready[word] };
                *ready = *ready & !bit | if enabled { bit } else { 0 };
            }
        }
        if let Some(special) = &self.arcs.special {
            view.enabled.copy_from_slice(ready);
            special.restrict(&mut view.enabled, &|place| tokens[place as usize].into());
        }
    }

    /// The number of the marking after a transition that is enabled; a new one gets the next.
    ///
    /// # Errors
    /// The limit that it passes.
    pub(super) fn fire(
        &mut self,
        marking: u32,
        transition: u32,
        limits: &Limits,
        memory: &mut Memory,
    ) -> Result<u32, Limit> {
        self.add(marking, transition)?;
        self.number(memory, limits.states)
    }

    /// The marking after a transition that is enabled, if it was met before.
    pub(super) fn known(&mut self, marking: u32, transition: u32) -> Option<u32> {
        self.add(marking, transition).ok()?;
        self.find().ok()
    }

    /// Adds the marking after a transition to `after`.
    fn add(&mut self, marking: u32, transition: u32) -> Result<(), Limit> {
        let from = changes(&self.ends, &self.changes, marking);
        let effects = self.arcs.effects.of(transition);
        let resets = self.arcs.special.as_ref().map_or(&[][..], |it| it.resets(transition));
        self.after.clear();
        let (mut i, mut j) = (0, 0);
        while i < from.len() || j < effects.len() {
            let next = |it: Option<u32>| it.unwrap_or(u32::MAX);
            let one = next(from.get(i).map(|&it| parts(it).0));
            let two = next(effects.get(j).map(|it| it.0));
            let place = one.min(two);
            let initial = self.arcs.initial[place as usize];
            let mut tokens = initial;
            if one == place {
                tokens = parts(from[i]).1;
                i += 1;
            }
            if two == place {
                if resets.iter().all(|it| it.0 != place) {
                    let after = i64::from(tokens) + effects[j].1;
                    tokens = u32::try_from(after).map_err(|_| Limit::Tokens)?;
                }
                j += 1;
            }
            if tokens != initial {
                self.after.push(change(place, tokens));
            }
        }
        for &(place, left) in resets {
            let at = self.after.binary_search_by_key(&place, |it| parts(*it).0);
            match (at, left != self.arcs.initial[place as usize]) {
                (Ok(at), true) => self.after[at] = change(place, left),
                (Ok(at), false) => drop(self.after.remove(at)),
                (Err(at), true) => self.after.insert(at, change(place, left)),
                (Err(_), false) => {}
            }
        }
        Ok(())
    }

    fn find(&self) -> Result<u32, usize> {
        let (ends, all, after) = (&self.ends, &self.changes, &self.after);
        self.index.find(hash(after), |it| changes(ends, all, it) == after)
    }

    /// The number of the marking in `after`.
    fn number(&mut self, memory: &mut Memory, states: u64) -> Result<u32, Limit> {
        let slot = match self.find() {
            Ok(number) => return Ok(number),
            Err(slot) => slot,
        };
        debug_assert!(self.after.is_sorted_by_key(|it| parts(*it).0), "sorted by place");
        let number = self.ends.len();
        if number as u64 >= states.min(u64::from(u32::MAX)) {
            return Err(Limit::States);
        }
        memory.room(&mut self.changes, self.after.len())?;
        memory.room(&mut self.ends, 1)?;
        self.changes.extend_from_slice(&self.after);
        self.ends.push(self.changes.len());
        let (ends, all) = (&self.ends, &self.changes);
        self.index.insert(slot, number as u32, memory, |it| hash(changes(ends, all, it)))?;
        Ok(number as u32)
    }
}

fn changes<'c>(ends: &[usize], all: &'c [u64], marking: u32) -> &'c [u64] {
    let at = marking as usize;
    let start = at.checked_sub(1).map_or(0, |before| ends[before]);
    &all[start..ends[at]]
}
