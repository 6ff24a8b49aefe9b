//! The reachable markings with the arcs between them.

use super::ahead::{Ahead, Following};
use super::bits::BitSet;
use super::goal::Goal;
use super::labels::Labels;
use super::layout::Width;
use super::look::Look;
use super::packed::Packed;
use super::packed_store::PackedStore;
use super::space::{Search, Space, TooNarrow, search};
use super::sparse_store::SparseStore;
use super::store::{Asked, MarkingStore};
use super::table::hash;
use super::{Limit, Limits, Progress, Unfinished, wide};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;
use std::sync::OnceLock;
use std::thread;

/// The reachable markings, numbered from 0, the initial one, in the order of a breadth first search
/// that fires transitions in their order; and for each marking those that follow it.
#[derive(Debug)]
pub struct Graph {
    pub(super) markings: Box<dyn MarkingStore>,
    /// For each marking where its successors begin.
    pub(super) starts: Vec<usize>,
    pub(super) successors: Vec<u32>,
    /// How many transitions the net has.
    pub(super) transitions: u32,
    /// A bit for each transition that some marking enables, once it is known.
    pub(super) fired: OnceLock<Vec<u64>>,
    /// Whether no transition leads to one marking from two: it has no reset arcs.
    pub(crate) is_injective: bool,
}

impl Graph {
    /// The graph of a net; on one thread, so that numbers are always the same. `progress` is called
    /// now and then.
    ///
    /// # Errors
    /// The limit that was reached, and how many markings there were before; [`Limit::States`] also
    /// when there are 4,294,967,295.
    ///
    /// ```
    /// use cotama_core::net::TransitionId;
    /// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
    /// use cotama_verification::explicit::{Graph, Limits};
    /// use cotama_verification::pt::Pt;
    ///
    /// let mut lamp = OwnedNet::new("lamp", "A lamp.");
    /// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
    /// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
    /// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
    /// lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
    /// let graph = Graph::new(&Pt::from(&lamp.view().net()), &Limits::default(), &|_| ()).unwrap();
    /// assert_eq!((graph.states(), graph.arcs()), (2, 2));
    /// assert_eq!((graph.marking(1), graph.successors(1)), (vec![0, 1], &[0][..]));
    /// assert_eq!(graph.transitions(1), [TransitionId(1)]);
    /// ```
    pub fn new(pt: &Pt, limits: &Limits, progress: &dyn Fn(Progress)) -> Result<Self, Unfinished> {
        Self::on(pt, limits, 1, progress)
    }

    /// The same graph, with the same numbers, made on so many threads: all but one of them look at
    /// markings, and one gives the numbers.
    ///
    /// # Errors
    /// As those of [`Graph::new`].
    ///
    /// ```
    /// use cotama_models::nets::families::kanban;
    /// use cotama_verification::explicit::{Graph, Limits};
    /// use cotama_verification::pt::Pt;
    /// let net = Pt::from(&kanban(2).unwrap().view().net());
    /// let limits = Limits::default();
    /// let [one, two] = [1, 2].map(|jobs| Graph::on(&net, &limits, jobs, &|_| ()).unwrap());
    /// assert!((0..4_600).all(|it| one.successors(it) == two.successors(it)));
    /// ```
    pub fn on(
        pt: &Pt,
        limits: &Limits,
        jobs: usize,
        progress: &dyn Fn(Progress),
    ) -> Result<Self, Unfinished> {
        let none = |limit| Unfinished { limit, states: 0 };
        let widths = Width::of(pt, limits).map_err(none)?;
        match search(pt, widths, &mut Construction { pt, limits, jobs, progress }) {
            Err(Limit::Words) => {
                let (markings, cursor, arcs) = wide::graph(pt, limits, progress)?;
                Ok(Self {
                    markings: Box::new(SparseStore::new(markings, cursor)),
                    starts: arcs.starts,
                    successors: arcs.successors,
                    transitions: pt.transitions.len() as u32,
                    fired: arcs.fired.into(),
                    is_injective: !pt.has_resets(),
                })
            }
            found => found.map_err(none)?,
        }
    }

    /// How many markings there are.
    pub fn states(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many arcs there are: pairs of a marking and a transition that is enabled in it.
    pub fn arcs(&self) -> usize {
        self.successors.len()
    }

    /// About how much memory it takes.
    pub fn bytes(&self) -> u64 {
        self.markings.bytes()
            + (size_of_val(&self.starts[..]) + size_of_val(&self.successors[..])) as u64
    }

    /// The markings that follow a marking, one for each transition that is enabled in it, in their
    /// order.
    ///
    /// # Panics
    /// When there is no such marking.
    #[inline]
    pub fn successors(&self, state: u32) -> &[u32] {
        &self.successors[self.starts[state as usize]..self.starts[state as usize + 1]]
    }

    /// The transitions that are enabled in a marking, in their order, which is that of
    /// [`Graph::successors`].
    ///
    /// # Panics
    /// When there is no such marking.
    pub fn transitions(&self, state: u32) -> Vec<TransitionId> {
        let mut all = Vec::new();
        let mut each = |look: &Look<'_>| all.extend(look.transitions().map(TransitionId));
        self.markings.each(&mut std::iter::once(state), &mut each);
        all
    }

    /// The tokens of each place.
    ///
    /// # Panics
    /// When there is no such marking.
    pub fn marking(&self, state: u32) -> Vec<u32> {
        self.markings.marking(state)
    }

    /// The tokens of a place in a marking, of which nothing else is asked.
    #[inline]
    pub(super) fn held(&self, state: u32, place: PlaceId) -> u64 {
        self.markings.held(state, place)
    }

    /// The tokens of a place in each marking.
    ///
    /// # Panics
    /// When there is no such place.
    pub fn tokens(&self, place: PlaceId) -> impl Iterator<Item = u32> {
        self.markings.tokens(place, self.states() as u32)
    }

    /// The markings in which the goal holds, looked at by so many threads.
    pub fn satisfying(&self, goal: Goal<'_>, jobs: usize) -> BitSet {
        let is_dead = |it: u32| self.successors(it).is_empty();
        self.markings.satisfying(goal, Asked { states: self.states(), jobs, is_dead: &is_dead })
    }

    /// The first marking in which the goal holds, which is one with a shortest path to it.
    pub fn first(&self, goal: Goal<'_>) -> Option<u32> {
        self.satisfying(goal, 1).ones().next()
    }

    /// A shortest path from the initial marking to another one.
    ///
    /// # Panics
    /// When there is no such marking.
    pub fn path(&self, to: u32) -> Vec<TransitionId> {
        // The marking that a marking was first met from: later markings are not met from earlier
        // ones than their own.
        let mut before = vec![0; to as usize + 1];
        let mut met = 0;
        for from in 0..=to {
            for &state in self.successors(from).iter().filter(|it| **it <= to) {
                if state > met {
                    met = state;
                    before[state as usize] = from;
                }
            }
            if met == to {
                break;
            }
        }
        let mut path = Vec::new();
        let mut state = to;
        while state != 0 {
            let from = before[state as usize];
            let at = self.successors(from).iter().position(|it| *it == state);
            path.extend(at.map(|at| self.transitions(from)[at]));
            state = from;
        }
        path.reverse();
        path
    }

    /// Transitions that some marking enables, or that none does.
    pub(super) fn fired(&self, ever: bool) -> impl Iterator<Item = u32> {
        let fired = self.fired.get_or_init(|| self.enabled(0..self.states() as u32));
        (0..self.transitions)
            .filter(move |it| (fired[*it as usize / 64] >> (it % 64) & 1 == 1) == ever)
    }

    /// Transitions that some of these markings enable: a bit for each, 64 to a word.
    pub(super) fn enabled(&self, mut states: impl Iterator<Item = u32>) -> Vec<u64> {
        let mut all = vec![0; (self.transitions as usize).div_ceil(64)];
        self.markings.each(&mut states, &mut |look| {
            all.iter_mut().zip(&*look.view.enabled).for_each(|(all, it)| *all |= it);
        });
        all
    }
}

/// The materials from which the graph is made.
struct Construction<'c> {
    pt: &'c Pt,
    limits: &'c Limits,
    jobs: usize,
    progress: &'c dyn Fn(Progress),
}

impl Search for Construction<'_> {
    type Found = Result<Graph, Unfinished>;

    fn search<const S: usize>(&mut self, space: Space) -> Result<Self::Found, TooNarrow> {
        let mut parts = Parts::<S>::new(&space, self.limits);
        let ended = thread::scope(|scope| {
            parts.explore(&space, Ahead::new(&space, self.jobs, scope), self.progress)
        });
        let states = (parts.markings.len() as u64).min(self.limits.states);
        if let Some(limit) = space.check(&parts.union)? {
            return Ok(Err(Unfinished { limit, states }));
        }
        let Parts { markings, starts, successors, fired, bytes, .. } = parts;
        let transitions = self.pt.transitions.len() as u32;
        Ok(ended.map_err(|limit| Unfinished { limit, states }).map(|()| {
            debug_assert_eq!(starts.len(), markings.len() + 1);
            debug_assert_eq!(starts.last(), Some(&successors.len()));
            debug_assert!(successors.iter().all(|it| (*it as usize) < markings.len()));
            let needs = self.pt.is_plain().then(|| self.pt.needs.clone());
            let packed = Packed { space, words: S, markings: markings.into_flattened(), needs };
            let labels = Labels::new(bytes, self.limits.bytes.saturating_sub(bytes));
            Graph {
                markings: Box::new(PackedStore { packed, labels }),
                starts,
                successors,
                transitions,
                fired: fired.into(),
                is_injective: !self.pt.has_resets(),
            }
        }))
    }
}

/// The graph as it grows.
struct Parts<'p, const S: usize> {
    limits: &'p Limits,
    /// Bytes of all lists.
    bytes: u64,
    markings: Vec<[u64; S]>,
    starts: Vec<usize>,
    successors: Vec<u32>,
    fired: Vec<u64>,
    /// Numbers of markings, [`EMPTY`] where there is none, each where its hash leads to or after
    /// that with none empty between.
    index: Vec<u32>,
    /// All bits of all markings.
    union: [u64; S],
}

/// No number of a marking.
const EMPTY: u32 = u32::MAX;

impl<'p, const S: usize> Parts<'p, S> {
    fn new(space: &Space, limits: &'p Limits) -> Self {
        Self {
            limits,
            bytes: 0,
            markings: Vec::new(),
            starts: vec![0],
            successors: Vec::new(),
            fired: vec![0; space.enabling.view().enabled.len()],
            index: Vec::new(),
            union: [0; S],
        }
    }

    /// Adds all markings, or as many as there are before a limit or a guess that is too small.
    fn explore(
        &mut self,
        space: &Space,
        mut ahead: Ahead<'_, S>,
        progress: &dyn Fn(Progress),
    ) -> Result<(), Limit> {
        self.connect(&[space.initial()])?;
        self.successors.clear();
        let (mut depth, mut level) = (0, 1);
        while let Some(Following { markings, ends, fired }) = ahead.follow(&self.markings) {
            if self.limits.is_over() {
                return Err(Limit::Time);
            }
            self.fired.iter_mut().zip(fired).for_each(|(all, it)| *all |= it);
            self.bytes += make_room(&mut self.starts, ends.len(), self.limits.bytes - self.bytes)?;
            let before = self.successors.len();
            self.starts.extend(ends.iter().map(|end| before + end));
            self.connect(&markings)?;
            let (states, done) = (self.markings.len(), self.starts.len() - 1);
            progress(Progress { states: states as u64, depth, waiting: (states - done) as u64 });
            if done >= level {
                (level, depth) = (states, depth + 1);
            }
            if space.is_too_narrow(&self.union) {
                break;
            }
        }
        Ok(())
    }

    /// Adds the numbers of these markings to the successors; new ones get the next number.
    fn connect(&mut self, markings: &[[u64; S]]) -> Result<(), Limit> {
        let free = self.limits.bytes - self.bytes;
        self.bytes += make_room(&mut self.markings, markings.len(), free)?;
        let free = self.limits.bytes - self.bytes;
        self.bytes += make_room(&mut self.successors, markings.len(), free)?;
        self.spread(markings.len())?;
        let first = self.successors.len();
        // Most markings have a number already, and it lies where their hash leads.
        self.successors.extend(markings.iter().map(|it| self.index[home(it, self.index.len())]));
        for (at, marking) in markings.iter().enumerate() {
            let guess = self.successors[first + at];
            if self.markings.get(guess as usize) != Some(marking) {
                self.successors[first + at] = self.number(marking);
            }
        }
        let most = self.limits.states.min(u64::from(EMPTY));
        if self.markings.len() as u64 > most { Err(Limit::States) } else { Ok(()) }
    }

    /// The number of a marking, for which there is room.
    fn number(&mut self, marking: &[u64; S]) -> u32 {
        let mut slot = home(marking, self.index.len());
        loop {
            let number = self.index[slot];
            if number == EMPTY {
                break;
            }
            if self.markings[number as usize] == *marking {
                return number;
            }
            slot = if slot + 1 == self.index.len() { 0 } else { slot + 1 };
        }
        let number = self.markings.len() as u32;
        self.index[slot] = number;
        self.markings.push(*marking);
        for (all, word) in self.union.iter_mut().zip(marking) {
            *all |= word;
        }
        number
    }

    /// Makes the index larger if so many more markings are too many for it.
    fn spread(&mut self, more: usize) -> Result<(), Limit> {
        let (count, before) = (self.markings.len() + more, self.index.len());
        if 5 * count <= 4 * before {
            return Ok(());
        }
        self.index = Vec::new();
        self.bytes -= (before * size_of::<u32>()) as u64;
        let slots = (count * 7 / 4).max(before * 7 / 5);
        self.bytes += make_room(&mut self.index, slots, self.limits.bytes - self.bytes)?;
        self.index.resize(slots, EMPTY);
        for (number, marking) in self.markings.iter().enumerate() {
            let mut slot = home(marking, slots);
            while self.index[slot] != EMPTY {
                slot = if slot + 1 == slots { 0 } else { slot + 1 };
            }
            self.index[slot] = number as u32;
        }
        Ok(())
    }
}

/// Returns the first slot of a marking in an index of so many slots.
#[inline]
fn home<const S: usize>(marking: &[u64; S], slots: usize) -> usize {
    ((u128::from(hash(marking)) * slots as u128) >> 64) as usize
}

/// Makes room for so many more items in a list, half as many again as it has if it must grow;
/// returns the bytes taken.
fn make_room<T>(list: &mut Vec<T>, more: usize, free: u64) -> Result<u64, Limit> {
    let (before, needed) = (list.capacity(), list.len() + more);
    if needed <= before {
        return Ok(0);
    }
    let room = needed.max(before + before / 2);
    if (room * size_of::<T>()) as u64 > free {
        return Err(Limit::Bytes);
    }
    list.try_reserve_exact(room - list.len()).map_err(|_| Limit::Bytes)?;
    Ok(((list.capacity() - before) * size_of::<T>()) as u64)
}
