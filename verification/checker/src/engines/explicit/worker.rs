//! The part of one thread in a level.

use super::block::Block;
use super::boxes::Boxes;
use super::cache_padded::CachePadded;
use super::diamonds::Diamonds;
use super::enabling::Seen;
use super::goal::Packed;
use super::plan::Plan;
use super::pool::PoolThread;
use super::space::{Firings, Space};
use super::table::{BATCH, TABLES, Table};
use super::view::{Bits, View};
use super::{Limit, Limits};
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock, RwLockWriteGuard};
use std::thread::Scope;
use std::time::Instant;

/// The counts of markings, made when their successors are computed.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    pub(super) arcs: u64,
    pub(super) dead: u64,
    pub(super) sum: u64,
    pub(super) seen: Seen,
    /// A bit for each transition that was enabled.
    pub(super) enabled: CachePadded<u64>,
}

/// The data shared by all threads.
pub(super) struct Shared<'s, const S: usize> {
    pub(super) space: &'s Space,
    firings: Firings<S>,
    diamonds: Diamonds,
    limits: &'s Limits,
    goal: Option<&'s Packed<'s>>,
    tables: Vec<Mutex<Table<S>>>,
    /// The boxes of each thread, which holds the lock while it fills them.
    boxes: Vec<RwLock<Boxes<S>>>,
    /// The level: for each thread the blocks that it found.
    pub(super) queues: Vec<Mutex<Vec<Block<S>>>>,
    spare: Mutex<Vec<Block<S>>>,
    pub(super) states: AtomicU64,
    pub(super) bytes: AtomicU64,
    pub(super) peak: AtomicU64,
    /// Zero, or the limit that was reached.
    pub(super) stop: AtomicU8,
}

/// A thread's own part, apart from that of another one in the caches of processors.
#[repr(align(128))]
pub(super) struct Worker<const S: usize> {
    /// Number of the worker.
    number: usize,
    pub(super) fresh: Vec<Block<S>>,
    pub(super) kept: Vec<Block<S>>,
    pub(super) goals: Vec<[u64; S]>,
    view: View,
    /// To look at goals.
    scratch: (View, Seen),
    pub(super) tally: Tally,
    /// All bits of all new markings.
    pub(super) union: [u64; S],
}

pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn write<T>(lock: &RwLock<T>) -> RwLockWriteGuard<'_, T> {
    lock.write().unwrap_or_else(PoisonError::into_inner)
}

impl<'s, const S: usize> Shared<'s, S> {
    pub(super) fn new(space: &'s Space, plan: Plan<'s>) -> Self {
        let jobs = plan.jobs.max(1);
        Self {
            space,
            firings: space.firings(),
            diamonds: Diamonds::new(plan.pt),
            limits: plan.limits,
            goal: plan.goal,
            tables: (0..TABLES).map(|_| Mutex::new(Table::new())).collect(),
            boxes: (0..jobs).map(|_| RwLock::new(Boxes::new(jobs))).collect(),
            queues: (0..jobs).map(|_| Mutex::default()).collect(),
            spare: Mutex::default(),
            states: AtomicU64::new(0),
            bytes: AtomicU64::new(0),
            peak: AtomicU64::new(0),
            stop: AtomicU8::new(0),
        }
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed) != 0
    }

    fn stop(&self, limit: Limit) {
        let _ = self.stop.compare_exchange(0, limit.code(), Relaxed, Relaxed);
    }

    /// Takes so many bytes; or stops the search when there are not as many.
    fn reserve(&self, bytes: usize) -> bool {
        let total = self.bytes.fetch_add(bytes as u64, Relaxed) + bytes as u64;
        let is_free = total <= self.limits.bytes;
        if is_free {
            self.peak.fetch_max(total, Relaxed);
        } else {
            self.release(bytes);
            self.stop(Limit::Bytes);
        }
        is_free
    }

    fn release(&self, bytes: usize) {
        self.bytes.fetch_sub(bytes as u64, Relaxed);
    }

    /// A block with a marking in it, if there is memory for it.
    fn block(&self, marking: &[u64; S], via: u32) -> Option<Block<S>> {
        let mut block = lock(&self.spare).pop().or_else(|| {
            let bytes = Block::<S>::ROOM * (size_of::<[u64; S]>() + size_of::<u32>());
            let block = self.reserve(bytes).then(Block::new)?;
            if block.is_none() {
                self.release(bytes);
                self.stop(Limit::Bytes);
            }
            block
        })?;
        block.push(marking, via);
        Some(block)
    }
}

impl Tally {
    pub(super) fn new(space: &Space) -> Self {
        let enabled = CachePadded::new(0, space.enabling.view().enabled.len());
        Self { arcs: 0, dead: 0, sum: 0, seen: space.enabling.unseen(), enabled }
    }

    /// Adds another one.
    pub(super) fn add(&mut self, other: &Self) {
        self.arcs += other.arcs;
        self.dead += other.dead;
        self.sum = self.sum.max(other.sum);
        self.seen.merge(&other.seen);
        self.enabled.iter_mut().zip(&*other.enabled).for_each(|(a, b)| *a |= b);
    }
}

impl<const S: usize> Worker<S> {
    /// Returns the worker of a thread. The thread itself makes it, so that its memory shares no
    /// cache line with that of others.
    pub(super) fn of<'w>(
        place: &'w mut Option<Self>,
        shared: &Shared<'_, S>,
        number: usize,
    ) -> &'w mut Self {
        place.get_or_insert_with(|| Self::new(shared, number))
    }

    /// A thread for the worker of this number.
    pub(super) fn spawn<'s>(
        scope: &'s Scope<'s, '_>,
        shared: &'s Shared<'s, S>,
        number: usize,
    ) -> Option<PoolThread<Option<Self>, Option<Self>>> {
        PoolThread::start(scope, move |mut place: Option<Self>| {
            Self::of(&mut place, shared, number).level(shared, &|| ());
            place
        })
    }

    fn new(shared: &Shared<'_, S>, number: usize) -> Self {
        let enabling = &shared.space.enabling;
        Self {
            number,
            fresh: Vec::new(),
            kept: Vec::new(),
            goals: Vec::new(),
            view: enabling.view(),
            scratch: (enabling.view(), enabling.unseen()),
            tally: Tally::new(shared.space),
            union: [0; S],
        }
    }

    /// Adds the initial marking.
    pub(super) fn start(&mut self, shared: &Shared<'_, S>) {
        let mut boxes = write(&shared.boxes[self.number]);
        boxes.put(&shared.space.initial(), Diamonds::NONE);
        self.first(shared).for_each(|owner| self.empty_all(shared, &boxes, owner));
    }

    /// Takes blocks of the level as long as there are any, and then boxes.
    pub(super) fn level(&mut self, shared: &Shared<'_, S>, tick: &dyn Fn()) {
        self.fill(shared, tick);
        // The thread takes its own share of the tables first, so that it mostly meets and expands
        // its own markings; its own boxes first, because the others may not be filled yet.
        for owner in self.first(shared) {
            for it in self.first(shared) {
                // One lock at a time: who holds one and waits for another may wait for ever.
                let boxes = shared.boxes[it].read().unwrap_or_else(PoisonError::into_inner);
                self.empty_all(shared, &boxes, owner);
            }
        }
    }

    /// The numbers of all threads, its own first.
    fn first(&self, shared: &Shared<'_, S>) -> impl Iterator<Item = usize> + use<S> {
        (self.number..shared.boxes.len()).chain(0..self.number)
    }

    /// Empties boxes of a thread's share of the tables as long as there are any.
    fn empty_all(&mut self, shared: &Shared<'_, S>, boxes: &Boxes<S>, owner: usize) {
        while let Some(table) = boxes.next(owner) {
            self.empty(shared, boxes, table);
        }
    }

    /// Fills its boxes with what follows the blocks that it takes.
    fn fill(&mut self, shared: &Shared<'_, S>, tick: &dyn Fn()) {
        // Before the first block is taken: who finds no more blocks waits for this lock.
        let mut boxes = write(&shared.boxes[self.number]);
        boxes.clear_all();
        loop {
            let Some(mut block) = self.first(shared).find_map(|it| lock(&shared.queues[it]).pop())
            else {
                break;
            };
            if shared.limits.deadline.is_some_and(|it| Instant::now() >= it) {
                // Also when the level is only counted to its end.
                shared.stop.store(Limit::Time.code(), Relaxed);
            }
            // Other limits let the level be counted to its end, so that the counts are those of
            // complete levels.
            if shared.stop.load(Relaxed) != Limit::Time.code() {
                self.expand(shared, &mut boxes, &block);
            }
            tick();
            if shared.goal.is_some() {
                let before = block.bytes();
                block.markings.shrink_to_fit();
                block.via = Vec::new();
                shared.release(before - block.bytes());
                self.kept.push(block);
            } else {
                block.markings.clear();
                block.via.clear();
                lock(&shared.spare).push(block);
            }
        }
    }

    /// Computes what follows the markings of a block.
    fn expand(&mut self, shared: &Shared<'_, S>, boxes: &mut Boxes<S>, block: &Block<S>) {
        let (mut arcs, mut dead, mut most) = (0, 0, 0);
        let firings = &shared.firings;
        let mut view = std::mem::take(&mut self.view);
        let mut ever = std::mem::take(&mut self.tally.enabled);
        for (marking, &via) in block.markings.iter().zip(&block.via) {
            shared.space.enabling.look(marking, &mut view, &mut self.tally.seen);
            most = most.max(view.sum);
            let before = arcs;
            let left_out = shared.diamonds.of(via);
            for (at, ((&enabled, ever), left_out)) in
                view.enabled.iter().zip(&mut *ever).zip(left_out).enumerate()
            {
                *ever |= enabled;
                arcs += u64::from(enabled.count_ones());
                for bit in Bits(enabled & !left_out) {
                    let transition = 64 * at as u32 + bit;
                    let after = firings.after(marking, transition);
                    if let Some(full) = boxes.put(&after, transition) {
                        self.empty(shared, boxes, full);
                        boxes.clear(full);
                    }
                }
            }
            dead += u64::from(arcs == before);
        }
        self.view = view;
        self.tally.enabled = ever;
        self.tally.arcs += arcs;
        self.tally.dead += dead;
        self.tally.sum = self.tally.sum.max(most);
    }

    /// Adds what is in a box to its table.
    #[inline(never)]
    fn empty(&mut self, shared: &Shared<'_, S>, boxes: &Boxes<S>, table: usize) {
        if shared.is_stopped() {
            return;
        }
        let (markings, via) = boxes.content(table);
        let mut table = lock(&shared.tables[table]);
        let Self { fresh, goals, scratch: (view, seen), union, .. } = self;
        let mut new = 0;
        for (batch, via) in markings.chunks(BATCH).zip(via.chunks(BATCH)) {
            if let Some(slots) = table.grown(batch.len()) {
                let before = table.slots();
                if !shared.reserve(Table::<S>::bytes(slots)) {
                    break;
                }
                if !table.grow(slots) {
                    shared.release(Table::<S>::bytes(slots));
                    shared.stop(Limit::Bytes);
                    break;
                }
                shared.release(Table::<S>::bytes(before));
            }
            table.insert(batch, |at| {
                let marking = &batch[at];
                new += 1;
                for (all, word) in union.iter_mut().zip(marking) {
                    *all |= word;
                }
                if shared.goal.is_some_and(|it| it.holds(shared.space, marking, view, seen)) {
                    goals.push(*marking);
                }
                match fresh.last_mut() {
                    Some(block) if block.via.len() < Block::<S>::ROOM => {
                        block.push(marking, via[at]);
                    }
                    _ => fresh.extend(shared.block(marking, via[at])),
                }
            });
        }
        drop(table);
        if shared.states.fetch_add(new, Relaxed) + new > shared.limits.states {
            shared.stop(Limit::States);
        }
    }
}
