//! Every state that the supervisors reach in rounds, in memory without heap.

use cotama_core::units::Millis;
use cotama_models::cotama::{Cause, DecisionalLevel, Told, faults, global, local, operator};

/// Everything that the level can be told.
pub const TOLD: [Told; 26] = [
    Told::Mission(global::Event::mission_received),
    Told::Mission(global::Event::object_received),
    Told::Mission(global::Event::object_delivered),
    Told::Mission(global::Event::stopped),
    Told::Drive(local::Event::path_ready),
    Told::Drive(local::Event::goal_reached),
    Told::Failure(faults::Event::lose_vital),
    Told::Failure(faults::Event::lose_wifi),
    Told::Failure(faults::Event::lose_camera),
    Told::Failure(faults::Event::lose_watch),
    Told::Failure(faults::Event::lose_sonar),
    Told::Failure(faults::Event::lose_avoidance),
    Told::Failure(faults::Event::lose_smz),
    Told::Failure(faults::Event::lose_mcl),
    Told::Failure(faults::Event::drift),
    Told::Failure(faults::Event::bump),
    Told::Failure(faults::Event::no_path),
    Told::Failure(faults::Event::fail_hard),
    Told::Failure(faults::Event::fail_slightly),
    Told::Failure(faults::Event::overload),
    Told::Operator(operator::Event::teleprogram),
    Told::Operator(operator::Event::teleoperate),
    Told::Operator(operator::Event::waypoints),
    Told::Operator(operator::Event::new_path),
    Told::Operator(operator::Event::arrived),
    Told::Operator(operator::Event::gives_up),
];

/// States, each once, found by a hash of their markings.
pub struct Reached<'m> {
    states: &'m mut [DecisionalLevel],
    /// One more than the number of a state; zero where there is none. Open addressing.
    index: &'m mut [u32],
    count: usize,
}

impl<'m> Reached<'m> {
    /// With memory for so many states, and for at least twice as many numbers.
    pub fn new(states: &'m mut [DecisionalLevel], index: &'m mut [u32]) -> Self {
        index.fill(0);
        Self { states, index, count: 0 }
    }

    /// How many states there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The state of this number.
    pub fn state(&self, number: usize) -> Option<DecisionalLevel> {
        self.states.get(..self.count)?.get(number).copied()
    }

    /// Adds a state, unless it is there; false when there is no memory for it.
    pub fn add(&mut self, state: &DecisionalLevel) -> bool {
        let words = state.player().marking();
        let hash = words.iter().fold(0, |hash: u64, word| {
            (hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
        });
        let start = hash as usize % self.index.len();
        let places = (start..self.index.len()).chain(0..start);
        for place in places {
            match self.index[place].checked_sub(1) {
                Some(number) if self.states[number as usize].player().marking() == words => {
                    return true;
                }
                Some(_) => {}
                None if self.count < self.states.len() => {
                    self.states[self.count] = *state;
                    self.count += 1;
                    self.index[place] = self.count as u32;
                    return true;
                }
                None => return false,
            }
        }
        false
    }

    /// Goes on from every state, as long as there is memory: a round, then nothing or one event
    /// from outside. `round` and `tell` are who does it.
    pub fn explore(
        &mut self,
        mut round: impl FnMut(&mut DecisionalLevel),
        mut tell: impl FnMut(&mut DecisionalLevel, Told),
    ) -> bool {
        let mut complete = self.add(&DecisionalLevel::default());
        let mut at = 0;
        while let Some(mut after) = self.state(at) {
            at += 1;
            round(&mut after);
            complete &= self.add(&after);
            for told in TOLD {
                let mut next = after;
                tell(&mut next, told);
                complete &= self.add(&next);
            }
        }
        complete
    }
}

/// A round.
pub fn round(level: &mut DecisionalLevel) {
    let _ = level.round(Millis(0), &mut ());
}

/// An event.
pub fn tell(level: &mut DecisionalLevel, told: Told) {
    let _ = level.tell(Millis(0), told, Cause(0), &mut ());
}
