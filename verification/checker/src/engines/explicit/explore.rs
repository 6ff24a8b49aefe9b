//! Breadth first through all reachable markings, level by level, on any number of threads.
//!
//! Threads take blocks of a level, and sort the markings that follow into boxes, one for each
//! table; a full box is added to its table at once, the others at the end of the level, by
//! whichever thread has time. Which thread finds a marking first, and so the order within a level,
//! is left to chance, but not which markings a level has, nor what is counted.

use super::block::Block;
use super::plan::Plan;
use super::space::{Space, TooNarrow};
use super::worker::{Shared, Tally, Worker, lock};
use super::{Limit, Progress};
use std::sync::atomic::Ordering::Relaxed;
use std::thread::{self, Scope};

/// Threads are worth their start for so many blocks each.
const BLOCKS_OF_A_THREAD: usize = 4;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Exhausted,
    Found,
    Limit(Limit),
}

/// A search that ended.
pub(super) struct Explored<const S: usize> {
    pub(super) end: End,
    /// Markings of complete levels.
    pub(super) states: u64,
    /// Levels that were met: the last one is not complete, or empty, unless it has a goal.
    pub(super) depth: u64,
    pub(super) tally: Tally,
    /// The markings of each level, with a goal only.
    pub(super) levels: Vec<Vec<Block<S>>>,
    /// The goals in the last level.
    pub(super) goals: Vec<[u64; S]>,
    /// Bytes at the end, and most bytes at any time.
    pub(super) bytes: u64,
    pub(super) peak: u64,
}

pub(super) fn explore<const S: usize>(
    space: &Space,
    plan: Plan<'_>,
) -> Result<Explored<S>, TooNarrow> {
    let shared = Shared::<S>::new(space, plan);
    thread::scope(|scope| levels(scope, &shared, plan))
}

/// Goes from level to level.
fn levels<'s, const S: usize>(
    scope: &'s Scope<'s, '_>,
    shared: &'s Shared<'s, S>,
    plan: Plan<'_>,
) -> Result<Explored<S>, TooNarrow> {
    let mut workers: Vec<Option<Worker<S>>> = (0..plan.jobs.max(1)).map(|_| None).collect();
    let mut levels = Vec::new();
    let (mut states, mut depth) = (0, 0);
    let mut pool = Vec::new();
    Worker::of(&mut workers[0], shared, 0).start(shared);
    loop {
        let (mut union, mut goals, mut kept) = ([0; S], Vec::new(), Vec::new());
        let mut fresh = Vec::with_capacity(workers.len());
        // Plain loops: this is compiled for each width of a marking.
        for worker in &mut workers {
            let Some(worker) = worker else {
                fresh.push(Vec::new());
                continue;
            };
            union.iter_mut().zip(worker.union).for_each(|(all, it)| *all |= it);
            goals.append(&mut worker.goals);
            kept.append(&mut worker.kept);
            fresh.push(std::mem::take(&mut worker.fresh));
        }
        let limit = shared.space.check(&union)?.or(Limit::of(shared.stop.load(Relaxed)));
        let blocks: usize = fresh.iter().map(Vec::len).sum();
        if let Some(before) = levels.last_mut() {
            *before = kept;
        }
        let end = match limit {
            // How much of a level fits depends on chance; whether all of it fits does not.
            Some(limit @ (Limit::States | Limit::Tokens)) => Some(End::Limit(limit)),
            _ if !goals.is_empty() => Some(End::Found),
            Some(limit) => Some(End::Limit(limit)),
            None => (blocks == 0).then_some(End::Exhausted),
        };
        if limit.is_none() && blocks > 0 {
            states = shared.states.load(Relaxed);
        }
        if let Some(end) = end {
            // The levels before the last one are complete, and so is what is counted of them.
            let mut tally = Tally::new(shared.space);
            for worker in workers.iter().flatten() {
                tally.add(&worker.tally);
            }
            let (bytes, peak) = (shared.bytes.load(Relaxed), shared.peak.load(Relaxed));
            return Ok(Explored { end, states, depth, tally, levels, goals, bytes, peak });
        }
        let waiting = fresh.iter().flatten().map(|it| it.via.len() as u64).sum();
        (plan.progress)(Progress { states, depth, waiting });
        let threads = (blocks / BLOCKS_OF_A_THREAD).clamp(1, workers.len());
        for (queue, fresh) in shared.queues.iter().zip(fresh) {
            *lock(queue) = fresh;
        }
        if plan.goal.is_some() {
            levels.push(Vec::new());
        }
        // Without another thread this one does all.
        while pool.len() + 1 < threads
            && let Some(thread) = Worker::spawn(scope, shared, pool.len() + 1)
        {
            pool.push(thread);
        }
        let called = &pool[..pool.len().min(threads - 1)];
        for (thread, worker) in called.iter().zip(&mut workers[1..]) {
            thread.send(worker.take());
        }
        Worker::of(&mut workers[0], shared, 0).level(shared, &|| {
            let states = shared.states.load(Relaxed);
            (plan.progress)(Progress { states, depth, waiting });
        });
        for (thread, worker) in called.iter().zip(&mut workers[1..]) {
            *worker = thread.wait().flatten();
        }
        depth += 1;
    }
}
