//! A random walk: which transitions are enabled, kept up to date from step to step.

use super::path::{Asked, Judged};
use crate::streams::Stream;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::pt::Pt;
use std::fmt;

/// What came of many runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// How many runs there were.
    pub runs: u64,
    /// How many transitions fired in all of them.
    pub steps: u64,
    /// One a question, in their order.
    pub tallies: Vec<Tally>,
}

/// What came of one question.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many runs were as the property says, within their steps.
    pub holding: u64,
    /// Of how many runs that was not decided when their steps were used up.
    pub open: u64,
    /// The shortest run that is surely as the property says; of several the first.
    pub shortest_holding: Option<Witness>,
    /// The shortest run that surely is not.
    pub shortest_broken: Option<Witness>,
}

/// A run, and how many steps of it decide a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Witness {
    /// Its steps.
    pub steps: u64,
    /// Its number, from 0.
    pub run: u64,
}

/// A place would hold more tokens than can be counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overflow {
    /// The number of the run.
    pub run: u64,
    /// What fires.
    pub transition: TransitionId,
    /// The place.
    pub place: PlaceId,
}

impl fmt::Display for Overflow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "in run {} a place comes to more than {} tokens", self.run, u32::MAX)
    }
}

impl std::error::Error for Overflow {}

impl Drawn {
    pub(super) fn none(questions: usize) -> Self {
        Self { runs: 0, steps: 0, tallies: vec![Tally::default(); questions] }
    }

    /// Adds what came of other runs.
    pub(super) fn add(&mut self, other: &Self) {
        let shorter = |a: Option<Witness>, b: Option<Witness>| a.into_iter().chain(b).min();
        self.runs += other.runs;
        self.steps += other.steps;
        for (it, more) in self.tallies.iter_mut().zip(&other.tallies) {
            it.holding += more.holding;
            it.open += more.open;
            it.shortest_holding = shorter(it.shortest_holding, more.shortest_holding);
            it.shortest_broken = shorter(it.shortest_broken, more.shortest_broken);
        }
    }
}

impl Tally {
    fn add(&mut self, asked: &Asked<'_>, judged: Judged, seen: Witness) {
        let shorter = |it: Option<Witness>| Some(it.map_or(seen, |it| it.min(seen)));
        match judged {
            Judged::Holds => {
                self.holding += 1;
                self.shortest_holding = shorter(self.shortest_holding);
            }
            Judged::Broken => self.shortest_broken = shorter(self.shortest_broken),
            Judged::Open => {
                self.open += 1;
                self.holding += u64::from(asked.holds_so_far());
            }
        }
    }
}

/// One run to be drawn.
pub(super) struct Run {
    pub(super) number: u64,
    pub(super) most: u64,
    pub(super) stream: Stream,
}

/// A marking and what is enabled in it.
pub(super) struct Walk<'n> {
    net: &'n Pt,
    now: State,
    start: State,
}

#[derive(Clone)]
struct State {
    marking: Vec<u32>,
    /// Of each transition how many places lack what it needs of them.
    lacking: Vec<u32>,
    /// The enabled transitions, in the order in which they came to be so.
    enabled: Vec<u32>,
    /// Of each enabled transition its place among them.
    at: Vec<u32>,
}

impl<'n> Walk<'n> {
    pub(super) fn new(net: &'n Pt) -> Self {
        let count = net.transitions.len();
        let mut start = State {
            marking: net.initial.clone(),
            lacking: vec![0; count],
            enabled: Vec::with_capacity(count),
            at: vec![0; count],
        };
        for transition in 0..count as u32 {
            let lacks = |it: &&(u32, u32)| net.initial[it.0 as usize] < it.1;
            let lacking = net.needs.of(transition).iter().filter(lacks).count() as u32;
            start.lacking[transition as usize] = lacking;
            if lacking == 0 {
                start.enable(transition);
            }
        }
        Self { net, now: start.clone(), start }
    }

    /// Draws a run from the start and counts what it shows; how many transitions fired.
    pub(super) fn run(
        &mut self,
        asked: &[Asked<'_>],
        run: Run,
        judged: &mut [Judged],
        tallies: &mut [Tally],
    ) -> Result<u64, Overflow> {
        self.now.copy(&self.start);
        judged.fill(Judged::Open);
        let Run { number, most, mut stream } = run;
        let (mut steps, mut open) = (0, asked.len());
        loop {
            let is_dead = self.now.enabled.is_empty();
            for ((asked, judged), tally) in asked.iter().zip(&mut *judged).zip(&mut *tallies) {
                if *judged == Judged::Open {
                    *judged = asked.sees(&self.now.marking, is_dead);
                    if *judged != Judged::Open {
                        tally.add(asked, *judged, Witness { steps, run: number });
                        open -= 1;
                    }
                }
            }
            if open == 0 || steps == most {
                break;
            }
            let Some(next) = self.choose(&mut stream) else { break };
            self.fire(next).map_err(|place| {
                let (transition, place) = (TransitionId(next), PlaceId(place));
                Overflow { run: number, transition, place }
            })?;
            steps += 1;
        }
        for ((asked, judged), tally) in asked.iter().zip(&*judged).zip(&mut *tallies) {
            if *judged == Judged::Open {
                tally.add(asked, Judged::Open, Witness { steps, run: number });
            }
        }
        Ok(steps)
    }

    /// One of the enabled transitions, all equally likely; none in a deadlock.
    #[inline]
    pub(super) fn choose(&self, stream: &mut Stream) -> Option<u32> {
        let number = stream.below(self.now.enabled.len() as u64);
        self.now.enabled.get(number as usize).copied()
    }

    /// Fires an enabled transition, or says which place would overflow.
    #[inline]
    pub(super) fn fire(&mut self, transition: u32) -> Result<(), u32> {
        for &(place, change) in self.net.effects.of(transition) {
            let before = self.now.marking[place as usize];
            let after = u32::try_from(i64::from(before) + change).map_err(|_| place)?;
            self.now.marking[place as usize] = after;
            for &(consumer, need) in self.net.consumers.of(place) {
                match (before >= need, after >= need) {
                    (true, false) => self.now.lack(consumer),
                    (false, true) => self.now.supply(consumer),
                    _ => {}
                }
            }
        }
        Ok(())
    }
}

impl State {
    fn copy(&mut self, other: &Self) {
        self.marking.copy_from_slice(&other.marking);
        self.lacking.copy_from_slice(&other.lacking);
        self.at.copy_from_slice(&other.at);
        self.enabled.clear();
        self.enabled.extend_from_slice(&other.enabled);
    }

    fn enable(&mut self, transition: u32) {
        self.at[transition as usize] = self.enabled.len() as u32;
        self.enabled.push(transition);
    }

    /// One place more lacks what a transition needs.
    #[inline]
    fn lack(&mut self, transition: u32) {
        let lacking = &mut self.lacking[transition as usize];
        *lacking += 1;
        if *lacking == 1 {
            let at = self.at[transition as usize];
            self.enabled.swap_remove(at as usize);
            if let Some(&moved) = self.enabled.get(at as usize) {
                self.at[moved as usize] = at;
            }
        }
    }

    /// One place fewer does.
    #[inline]
    fn supply(&mut self, transition: u32) {
        let lacking = &mut self.lacking[transition as usize];
        *lacking -= 1;
        if *lacking == 0 {
            self.enable(transition);
        }
    }
}
