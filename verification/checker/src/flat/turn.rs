//! How a system acts: the rules of [`Player`](cotama_core::player::Player), over markings that are
//! known in part.

use super::FlatError;
use super::branch::Branch;
use super::moves::{Move, Moves, Said};
use cotama_core::net::{EventId, OutputId, PlaceId};
use cotama_core::player::SETTLE;
use cotama_core::system::Of;
use std::collections::BTreeSet;
use std::ops::Range;

/// A mailbox is full, or a net does not settle.
#[derive(Debug)]
pub(super) enum Stop {
    Full,
    Error(FlatError),
}

/// The outcome of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    Fired,
    Ignored,
    /// Nothing has happened: a mailbox on the way is full.
    Refused,
}

/// Names of transitions that may be able to fire at once by themselves, though nets have settled.
pub(super) type Disturbed = BTreeSet<String>;

/// Whether what has changed so far decides whether a transition can fire by itself.
fn concerns(branch: &Branch<'_>, it: &Move) -> bool {
    branch.change.iter().any(|(place, &change)| change != 0 && it.depends.contains(place))
}

/// A system that acts.
#[derive(Debug)]
pub(super) struct Play<'p, 'k> {
    moves: &'p Moves,
    pub(super) branch: &'p mut Branch<'k>,
    /// The names of all effects, in order.
    pub(super) name: Vec<String>,
    pub(super) doc: String,
    pub(super) emits: Vec<OutputId>,
    settled: u32,
}

impl<'p, 'k> Play<'p, 'k> {
    pub(super) fn new(moves: &'p Moves, branch: &'p mut Branch<'k>) -> Self {
        Self { moves, branch, name: Vec::new(), doc: String::new(), emits: Vec::new(), settled: 0 }
    }

    /// Delivers an event with all that follows from it.
    pub(super) fn deliver(&mut self, event: Of<EventId>) -> Result<Answer, FlatError> {
        self.whole(|play| {
            play.clear(event);
            let moves = play.moves;
            if let Some(it) =
                play.enabled(&moves.on[usize::from(event.component)][event.id.0 as usize])
            {
                play.doc.clone_from(&it.doc);
                return play.fire(event.component, it).map(|()| Answer::Fired);
            }
            play.ignore(event);
            Ok(Answer::Ignored)
        })
    }

    /// Lets a net settle.
    pub(super) fn settle(&mut self, component: u16) -> Result<(), FlatError> {
        self.settle_where(component..component + 1, |_, _| true)
    }

    /// Lets all nets settle.
    pub(super) fn settle_all(&mut self) -> Result<(), FlatError> {
        self.settle_where(0..self.moves.urgent.len() as u16, |_, _| true)
    }

    /// Lets all nets settle, where all had settled when the step began but for these disturbed
    /// transitions. What no change of the step concerns is as it was.
    pub(super) fn rest(&mut self, disturbed: &Disturbed) -> Result<(), FlatError> {
        let components = 0..self.moves.urgent.len() as u16;
        self.settle_where(components, |branch, it| {
            disturbed.contains(&it.name) || concerns(branch, it)
        })
    }

    /// Lets such transitions fire by themselves until none is enabled that is not waiting for room
    /// in a mailbox.
    fn settle_where(
        &mut self,
        components: Range<u16>,
        may: impl Fn(&Branch<'_>, &Move) -> bool,
    ) -> Result<(), FlatError> {
        let moves = self.moves;
        let urgent: Vec<_> = moves.all_urgent(components).collect();
        let (mut at, mut fired) = (0, 0);
        while let Some(&(component, it)) = urgent.get(at) {
            at += 1;
            if may(self.branch, it)
                && self.enabled(std::slice::from_ref(it)).is_some()
                && self.whole(|play| play.fire(component, it).map(|()| Answer::Fired))?
                    == Answer::Fired
            {
                (at, fired) = (0, fired + 1);
            }
            if fired >= SETTLE {
                return Err(self.endless(component));
            }
        }
        Ok(())
    }

    /// The transitions that fire at once by themselves, that this step concerns, and of which it
    /// does not know that they are not enabled.
    pub(super) fn disturbs(&self) -> Disturbed {
        let is_known = |&(place, tokens, is): &(PlaceId, i64, bool)| {
            let (low, high) = self.branch.range(place);
            if is { high < tokens } else { low >= tokens }
        };
        let all = self.moves.urgent.iter().flatten();
        all.filter(|it| concerns(self.branch, it) && !it.tests.iter().any(is_known))
            .map(|it| it.name.clone())
            .collect()
    }

    fn endless(&self, component: u16) -> FlatError {
        FlatError::Endless { net: self.moves.components[usize::from(component)].clone() }
    }

    /// Does all of it or nothing.
    fn whole(
        &mut self,
        act: impl Fn(&mut Self) -> Result<Answer, Stop>,
    ) -> Result<Answer, FlatError> {
        let before = (self.branch.change.clone(), self.name.clone(), self.emits.clone());
        self.settled = 0;
        match act(self) {
            Ok(answer) => Ok(answer),
            Err(Stop::Error(error)) => Err(error),
            Err(Stop::Full) => {
                (self.branch.change, self.name, self.emits) = before;
                Ok(Answer::Refused)
            }
        }
    }

    fn enabled(&mut self, row: &'p [Move]) -> Option<&'p Move> {
        let branch = &mut *self.branch;
        row.iter().find(|it| {
            it.tests.iter().all(|&(place, tokens, is)| branch.holds(place, tokens) == is)
        })
    }

    fn ignore(&mut self, event: Of<EventId>) {
        let name = &self.moves.names[usize::from(event.component)][event.id.0 as usize];
        self.name.push(format!("{name} ignored"));
    }

    fn fire(&mut self, component: u16, it: &'p Move) -> Result<(), Stop> {
        self.name.push(it.name.clone());
        it.changes.iter().for_each(|(&place, &change)| self.branch.add(place, change));
        for &said in &it.says {
            match said {
                Said::Aloud(output) => self.emits.push(output),
                Said::Mail(waiting, capacity) => {
                    if self.branch.holds(waiting, capacity) {
                        return Err(Stop::Full);
                    }
                    self.branch.add(waiting, 1);
                }
                Said::Now(event) => {
                    self.clear(event);
                    let moves = self.moves;
                    let row = &moves.on[usize::from(event.component)][event.id.0 as usize];
                    match self.enabled(row) {
                        Some(it) => self.fire(event.component, it)?,
                        None => self.ignore(event),
                    }
                }
            }
        }
        // All that the net said has arrived: it settles.
        let moves = self.moves;
        let Some(it) = self.enabled(&moves.urgent[usize::from(component)]) else { return Ok(()) };
        if self.settled >= SETTLE {
            return Err(Stop::Error(self.endless(component)));
        }
        self.settled += 1;
        self.fire(component, it)
    }

    /// Empties the mailboxes that an event empties.
    fn clear(&mut self, event: Of<EventId>) {
        let moves = self.moves;
        for &(on, waiting) in &moves.clears {
            while on == event && self.branch.holds(waiting, 1) {
                self.branch.add(waiting, -1);
            }
        }
    }
}
