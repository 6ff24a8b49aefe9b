//! Synchronous steps of a net alone, where all transitions see the marking at the start of the
//! step; and which markings any order of firing can reach.

use super::{Game, Told};
use cotama_core::net::EventId;
use cotama_core::player::Stepped;
use cotama_core::system::{Of, System};

impl<'s> Game<'s> {
    /// One step: time passes and nothing fires meanwhile; then everything is taken, then
    /// everything is given.
    pub fn step(&mut self, now: u64, events: &[EventId]) -> Stepped {
        self.now = now.max(self.now);
        let events: Vec<Of<EventId>> = events.iter().map(|&it| it.into()).collect();
        let (book, mut left) = (self.book.clone(), self.clone());
        let mut firing = Vec::new();
        for &line in &book.order {
            let it = &book.lines[line];
            let wanted = it.on.is_none_or(|event| events.contains(&event));
            if wanted && left.has_tokens(line) && self.in_time(line) {
                it.take.iter().for_each(|&(cell, weight)| left.state.tokens[cell] -= weight);
                firing.push(line);
            }
        }
        let ignored = |used: &dyn Fn(Of<EventId>) -> bool| {
            let bits = events.iter().take(64).enumerate().filter(|(_, event)| !used(**event));
            bits.fold(0, |bits, (position, _)| bits | 1 << position)
        };
        if !self.all_fits(&left, &firing) {
            return Stepped { fired: 0, ignored: ignored(&|_| false), full: true };
        }
        left.stop_clocks();
        for &line in &firing {
            left.state.since[line] = None;
        }
        for &line in &firing {
            let it = &book.lines[line];
            it.give.iter().for_each(|&(cell, weight)| left.state.tokens[cell] += weight);
            left.told.push(Told::Fired(it.id, it.on, self.now, 0));
        }
        left.start_clocks();
        *self = left;
        let used = |event| firing.iter().any(|&it| book.lines[it].on == Some(event));
        Stepped { fired: firing.len() as u32, ignored: ignored(&used), full: false }
    }

    /// Whether every cell has room for what all of these give, once all has been taken.
    fn all_fits(&self, left: &Self, firing: &[usize]) -> bool {
        (0..self.book.cells.len()).all(|cell| {
            let gives = firing.iter().flat_map(|&it| &self.book.lines[it].give);
            let given = gives.filter(|it| it.0 == cell).map(|it| u64::from(it.1));
            let bound = self.book.cells[cell].1;
            u64::from(left.state.tokens[cell]) + given.sum::<u64>() <= u64::from(bound)
        })
    }

    /// Fires a transition whatever the bounds and the time; `false` when it lacks tokens.
    pub fn force(&mut self, line: usize) -> bool {
        let (enabled, book) = (self.has_tokens(line), self.book.clone());
        if enabled {
            self.change(&book.lines[line].take, &book.lines[line].give, Some(line));
        }
        enabled
    }

    /// Whether no order in which the transitions of a net alone can fire, whatever the time and
    /// the priorities, exceeds a bound; `false` as well when it has more than so many markings.
    pub fn is_bounded(system: &System<'s>, markings: usize) -> bool {
        let mut game = Self::start(system, 0);
        game.endless = false;
        let mut known = vec![game.book.initial.clone()];
        let mut next = 0;
        while let Some(tokens) = known.get(next).cloned() {
            for line in 0..game.book.lines.len() {
                game.state.tokens.clone_from(&tokens);
                if !game.has_tokens(line) {
                    continue;
                }
                if !game.has_room(line) || known.len() > markings {
                    return false;
                }
                game.force(line);
                if !known.contains(&game.state.tokens) {
                    known.push(game.state.tokens.clone());
                }
            }
            next += 1;
        }
        true
    }
}
