//! Synchronous steps: all transitions see the marking at the start of the step.

use super::{Fired, Game};
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::LARGEST;
use cotama_core::player::Stepped;

impl Game<'_> {
    /// One step: time passes and nothing fires meanwhile; then everything is taken, then
    /// everything is given.
    pub fn step(&mut self, now: u64, events: &[EventId]) -> Stepped {
        self.now = now.max(self.now);
        let mut left = self.clone();
        let mut firing = Vec::new();
        for &transition in &self.order {
            let it = &self.net.transitions[transition.0 as usize];
            let wanted = it.on.is_none_or(|event| events.contains(&event));
            if wanted && left.has_tokens(transition) && self.in_time(transition) {
                left.take(it.take);
                firing.push(transition);
            }
        }
        let used = |event: &EventId| firing.iter().any(|it| self.on(*it) == Some(*event));
        let ignored = events.iter().take(64).enumerate().filter(|(_, event)| !used(event));
        let ignored = ignored.fold(0, |bits, (position, _)| bits | 1 << position);
        if !self.all_fits(&left, &firing) {
            let all = events
                .iter()
                .take(64)
                .enumerate()
                .fold(0, |bits, (position, _)| bits | 1 << position);
            return Stepped { fired: 0, ignored: all, full: true };
        }
        left.stop_clocks();
        for &transition in &firing {
            left.since[transition.0 as usize] = None;
        }
        for &transition in &firing {
            left.give(self.net.transitions[transition.0 as usize].give);
            left.fired.push(Fired { transition, event: self.on(transition), at: self.now });
        }
        left.start_clocks();
        *self = left;
        Stepped { fired: firing.len() as u32, ignored, full: false }
    }

    /// Fires a transition whatever the bounds and the time, as the laws see it; `false` when it
    /// lacks tokens.
    pub fn force(&mut self, transition: TransitionId) -> bool {
        let enabled = self.has_tokens(transition);
        if enabled {
            self.fire(transition, self.on(transition));
        }
        enabled
    }

    /// Whether every place has room for what all of these give, once all has been taken.
    fn all_fits(&self, left: &Self, firing: &[TransitionId]) -> bool {
        (0..self.tokens.len()).all(|place| {
            let gives = firing.iter().flat_map(|it| self.net.transitions[it.0 as usize].give);
            let given =
                gives.filter(|arc| arc.place.0 as usize == place).map(|arc| u64::from(arc.weight));
            let bound = self.net.places[place].bound.min(LARGEST);
            u64::from(left.tokens[place]) + given.sum::<u64>() <= u64::from(bound)
        })
    }

    fn on(&self, transition: TransitionId) -> Option<EventId> {
        self.net.transitions[transition.0 as usize].on
    }
}
