//! Looking at markings on other threads, ahead of the one that gives numbers to what follows. It
//! takes what they found in the order of the markings, so numbers do not depend on threads.

use super::enabling::Seen;
use super::pool::PoolThread;
use super::space::{Firings, Space};
use super::view::View;
use std::collections::VecDeque;
use std::thread::Scope;

/// Markings that are worth to be sent to another thread, and the most that are sent at once.
const FEW: usize = 256;
const MANY: usize = 1_024;

/// The successors of some markings, in their order.
#[derive(Debug)]
pub(super) struct Following<const S: usize> {
    pub(super) markings: Vec<[u64; S]>,
    /// For each of them where its successors end.
    pub(super) ends: Vec<usize>,
    /// A bit for each transition that one of them enables.
    pub(super) fired: Vec<u64>,
}

/// Looks at markings.
#[derive(Debug)]
pub(super) struct Looker<'s, const S: usize> {
    space: &'s Space,
    firings: Firings<S>,
    view: View,
    seen: Seen,
}

impl<'s, const S: usize> Looker<'s, S> {
    pub(super) fn new(space: &'s Space) -> Self {
        let (view, seen) = (space.enabling.view(), space.enabling.unseen());
        Self { space, firings: space.firings(), view, seen }
    }

    pub(super) fn look(&mut self, some: &[[u64; S]]) -> Following<S> {
        let Self { space, firings, view, seen } = self;
        let mut found = Following {
            markings: Vec::with_capacity(2 * some.len()),
            ends: Vec::with_capacity(some.len()),
            fired: vec![0; view.enabled.len()],
        };
        for marking in some {
            space.enabling.look(marking, view, seen);
            found.fired.iter_mut().zip(&*view.enabled).for_each(|(all, it)| *all |= it);
            found.markings.extend(view.transitions().map(|it| firings.after(marking, it)));
            found.ends.push(found.markings.len());
        }
        found
    }
}

/// This thread and others that look at markings.
#[derive(Debug)]
pub(super) struct Ahead<'s, const S: usize> {
    own: Looker<'s, S>,
    threads: Vec<PoolThread<Vec<[u64; S]>, Following<S>>>,
    /// The threads that look at the next markings, in the order of markings.
    next: VecDeque<usize>,
    /// How many markings were handed out.
    sent: usize,
}

impl<'s, const S: usize> Ahead<'s, S> {
    /// With so many threads in all, or as many as there can be.
    pub(super) fn new<'e>(space: &'s Space, jobs: usize, scope: &'e Scope<'e, 's>) -> Self {
        let mut threads = Vec::new();
        while threads.len() + 1 < jobs {
            let mut looker = Looker::new(space);
            let look = move |some: Vec<[u64; S]>| looker.look(&some);
            let Some(thread) = PoolThread::start(scope, look) else { break };
            threads.push(thread);
        }
        Self { own: Looker::new(space), threads, next: VecDeque::new(), sent: 0 }
    }

    /// Returns the successors of the next markings of a list that grows: those after all that were
    /// returned before. `None` when none is left.
    pub(super) fn follow(&mut self, markings: &[[u64; S]]) -> Option<Following<S>> {
        let mut turn = self.next.back().map_or(0, |it| it + 1);
        while self.next.len() < 2 * self.threads.len() && markings.len() - self.sent >= FEW {
            turn %= self.threads.len();
            let some = self.some(markings, MANY).to_vec();
            self.threads[turn].send(some);
            self.next.push_back(turn);
            turn += 1;
        }
        if let Some(thread) = self.next.pop_front() {
            return self.threads[thread].wait();
        }
        let some = self.some(markings, FEW);
        (!some.is_empty()).then(|| self.own.look(some))
    }

    /// The next markings that were not handed out, so many at most.
    fn some<'m>(&mut self, markings: &'m [[u64; S]], most: usize) -> &'m [[u64; S]] {
        let from = self.sent;
        self.sent = markings.len().min(from + most);
        &markings[from..self.sent]
    }
}
