//! Faults of the drive at work.

use crate::fault::{Defect, DriveFault, Side, Slip, within};
use crate::vehicle::Effect;
use cotama_core::units::Millis;
use cotama_devices::{MAX_FAULTS, SettingsError, Stream, Streams};
use cotama_floor::Point;

/// A fault, with random numbers of its own.
#[derive(Clone, Debug)]
pub(crate) struct Active {
    fault: DriveFault,
    chance: Stream,
    /// Whether it is there, if it comes and goes, and until when.
    is_there: bool,
    until: Millis,
}

/// The most times that a fault comes and goes between two steps.
const MAX_CHANGES: usize = 64;

impl Active {
    /// Returns faults at work; random numbers are named after places in the list.
    ///
    /// # Errors
    /// More than [`MAX_FAULTS`].
    pub(crate) fn all(faults: &[DriveFault], seed: u64) -> Result<Vec<Self>, SettingsError> {
        within("the number of faults", faults.len() as f64, 0.0, MAX_FAULTS as f64)?;
        let streams = Streams::new(seed);
        let active = |(at, fault): (usize, &DriveFault)| Self {
            fault: *fault,
            chance: streams.stream(&format!("drive fault {at}")),
            is_there: false,
            until: Millis::ZERO,
        };
        Ok(faults.iter().enumerate().map(active).collect())
    }

    /// Adds what the fault does in a step to what others do, and to the number of dead cells.
    pub(crate) fn act(&mut self, now: Millis, at: Point, effect: &mut Effect, dead: &mut u8) {
        if !self.is_there(now) {
            return;
        }
        match self.fault.defect() {
            Defect::Jam(side) => *side.of(&mut effect.turns) = 0.0,
            Defect::EncoderDead(side) => *side.of(&mut effect.reads) = 0.0,
            Defect::EncoderLossy(side, share) => *side.of(&mut effect.reads) *= 1.0 - share,
            Defect::Weak(side, share) => *side.of(&mut effect.turns) *= share,
            Defect::Slip(Slip { least, most, patch }) => {
                // Drawn outside of the patch too: where it lies shifts no other numbers.
                let drawn = [0, 1].map(|_| least + (most - least) * self.chance.part());
                let slips = patch.is_none_or(|it| (it.centre - at).norm() <= it.radius);
                if slips {
                    effect.grips.iter_mut().zip(drawn).for_each(|(grip, it)| *grip *= 1.0 - it);
                }
            }
            Defect::DeadCell => *dead = dead.saturating_add(1),
        }
    }

    /// Whether the fault is there, after it came and went as often as the time tells.
    fn is_there(&mut self, now: Millis) -> bool {
        if !self.fault.is_due(now) {
            return false;
        }
        let Some(pattern) = self.fault.pattern() else { return true };
        for _ in 0..MAX_CHANGES {
            if now < self.until {
                break;
            }
            // The first time it comes, when it is due.
            let begins = if self.until == Millis::ZERO { now } else { self.until };
            self.is_there = !self.is_there;
            let mean = if self.is_there { pattern.there } else { pattern.away };
            let drawn = -libm::log(1.0 - self.chance.part()) * mean.0 as f64;
            self.until = Millis(begins.0.saturating_add(whole(drawn) + 1)); // so that time goes on
        }
        self.is_there
    }
}

impl Side {
    fn of(self, both: &mut [f64; 2]) -> &mut f64 {
        let [left, right] = both;
        match self {
            Self::Left => left,
            Self::Right => right,
        }
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // of a mean of MAX_TIME
fn whole(it: f64) -> u64 {
    it as u64
}
