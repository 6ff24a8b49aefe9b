//! A mission by dice: what observers see, what is said, and what the drive does, a period at a
//! time.

#[path = "../../../../fuzz/split_mix.rs"]
mod split_mix;

use crate::reach::all_told;
use cotama_models::level::{Drive, Global, Perceived, Told};
use cotama_printed::{Careful, Decider, TABLES};

/// Dice: the same numbers on every machine.
#[derive(Clone, Copy, Debug)]
pub struct Walk(u64);

/// The news of a period.
#[derive(Clone, Copy, Debug)]
pub struct Period {
    /// The news of observers and of the scheduler.
    pub seen: Perceived,
    /// The word of the operator or of the mission.
    pub said: Option<Told>,
    /// State of the drive.
    pub drive: Drive,
}

impl Walk {
    /// Dice that begin here.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Draws a number below this one.
    fn below(&mut self, most: usize) -> usize {
        split_mix::split_mix(&mut self.0) as usize % most
    }

    fn one_in(&mut self, most: usize) -> bool {
        self.below(most) == 0
    }

    /// Draws the news of a period: in one of 12 a failure shows all of its flags, in one of 4 some
    /// go back, in one of 32 a module does not work.
    pub fn next(&mut self, decider: &Decider<Careful>) -> Period {
        let mut seen = Perceived { works: u64::MAX, ..Perceived::default() };
        if self.one_in(12) {
            seen.raised = TABLES.failures[self.below(TABLES.failures.len())].flags;
        }
        if self.one_in(4) {
            seen.lowered = decider.up() & split_mix::split_mix(&mut self.0);
        }
        if self.one_in(32) {
            seen.works = !(1 << self.below(64));
        }
        let said = match decider.level().global() {
            Global::Waits => Some(Told::Begins),
            Global::Does(it) if self.one_in(4) => Some(Told::Over(it)),
            _ if self.one_in(2) => all_told().nth(self.below(all_told().count())),
            _ => None,
        };
        let drive = Drive { at_goal: self.one_in(4), stands: self.one_in(2) };
        Period { seen, said, drive }
    }
}
