//! The token game with time: one clock for each transition with an interval, as the documentation
//! of `Player` has it.

use crate::textbook::{Marking, enabled, fired, first, immediate, taken};
use cotama_core::net::{Ignored, Net, PlaceId, Transition, Within};

/// The outcome of an event: transitions are positions in the net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    Fired { transition: usize, settled: usize },
    OnPurpose,
    NotEnabled,
    TooEarly(usize),
    TooLate(usize),
}

/// A marking, and for how long each transition has been enabled.
#[derive(Clone, Debug)]
pub(crate) struct Timed<'n> {
    pub(crate) net: Net<'n>,
    pub(crate) marking: Marking,
    pub(crate) elapsed: Vec<u64>,
}

impl<'n> Timed<'n> {
    /// Every clock begins.
    pub(crate) fn new(net: &Net<'n>, marking: &Marking) -> Self {
        Self { net: *net, marking: marking.clone(), elapsed: vec![0; net.transitions.len()] }
    }

    fn fire(&mut self, at: usize) {
        let by = &self.net.transitions[at];
        let (between, after) = (taken(by, &self.marking), fired(by, &self.marking));
        for (other, elapsed) in self.elapsed.iter_mut().enumerate() {
            let it = &self.net.transitions[other];
            if other == at || !enabled(it, &between) || !enabled(it, &after) {
                *elapsed = 0;
            }
        }
        self.marking = after;
    }

    fn settle(&mut self) -> usize {
        let mut count = 0;
        while let Some((at, _)) = first(&self.net, |it| immediate(it) && enabled(it, &self.marking))
        {
            self.fire(at);
            count += 1;
        }
        count
    }

    fn within(&self, at: usize) -> Within {
        self.net.transitions[at].within.unwrap_or(Within { earliest: 0, latest: None })
    }

    /// The transition that is due first by itself, and how long that takes.
    pub(crate) fn due(&self) -> Option<(u64, usize)> {
        let able = self.net.transitions.iter().enumerate();
        let able = able
            .filter(|(_, it)| it.on.is_none() && it.within.is_some() && enabled(it, &self.marking));
        let wait = |at: usize| u64::from(self.within(at).earliest).saturating_sub(self.elapsed[at]);
        able.map(|(at, it)| (wait(at), core::cmp::Reverse(it.priority), at))
            .min()
            .map(|(wait, _, at)| (wait, at))
    }

    fn pass(&mut self, time: u64) {
        for (at, elapsed) in self.elapsed.iter_mut().enumerate() {
            let it = &self.net.transitions[at];
            if it.within.is_some() && enabled(it, &self.marking) {
                *elapsed += time;
            }
        }
    }

    /// Lets time pass; how many transitions fired.
    pub(crate) fn advance(&mut self, mut time: u64) -> usize {
        let mut count = 0;
        while let Some((wait, at)) = self.due().filter(|(wait, _)| *wait <= time) {
            self.pass(wait);
            time -= wait;
            self.fire(at);
            count += 1 + self.settle();
        }
        self.pass(time);
        count
    }

    /// Fires what is due now, then answers the event.
    pub(crate) fn offer(&mut self, event: usize) -> Answer {
        self.advance(0);
        let open = |at: usize| {
            let Within { earliest, latest } = self.within(at);
            (
                u64::from(earliest) <= self.elapsed[at],
                latest.is_none_or(|it| self.elapsed[at] <= u64::from(it)),
            )
        };
        let position = |it: &Transition<'_>| {
            self.net.transitions.iter().position(|other| core::ptr::eq(other, it)).unwrap()
        };
        let answers = |it: &Transition<'_>| is_on(it, event) && enabled(it, &self.marking);
        if let Some((transition, _)) =
            first(&self.net, |it| answers(it) && open(position(it)) == (true, true))
        {
            self.fire(transition);
            return Answer::Fired { transition, settled: self.settle() };
        }
        if let Some((transition, _)) = first(&self.net, answers) {
            return if open(transition).0 {
                Answer::TooLate(transition)
            } else {
                Answer::TooEarly(transition)
            };
        }
        let tokens = |place: PlaceId| self.marking[place.0 as usize];
        let meant = |it: &Ignored<'_>| it.event.0 as usize == event && it.holds(tokens);
        if self.net.ignored.iter().any(meant) { Answer::OnPurpose } else { Answer::NotEnabled }
    }
}

fn is_on(it: &Transition<'_>, event: usize) -> bool {
    it.on.is_some_and(|on| on.0 as usize == event)
}

/// The values of a clock at which something changes.
pub(crate) fn turning_points(net: &Net<'_>, transition: usize, marking: &Marking) -> Vec<u64> {
    let it = &net.transitions[transition];
    let Some(Within { earliest, latest }) = it.within.filter(|_| enabled(it, marking)) else {
        return vec![0];
    };
    let mut points = vec![0, earliest.saturating_sub(1), earliest];
    match latest {
        Some(latest) if it.on.is_some() => points.extend([latest, latest + 1]),
        Some(latest) => points.push(latest),
        None => {}
    }
    points.sort_unstable();
    points.dedup();
    points.into_iter().map(u64::from).collect()
}
