//! Faults of the drive at work.

use crate::fault::{Defect, DriveFault, Side, Slip};
use crate::vehicle::Effect;
use cotama_core::units::Millis;
use cotama_devices::{MAX_FAULTS, Phase, SettingsError, Stream, Streams, within};
use cotama_floor::Point;

/// A fault, with random numbers of its own.
#[derive(Clone, Debug)]
pub(crate) struct Active {
    fault: DriveFault,
    chance: Stream,
    phase: Phase,
}

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
            phase: Phase::of(fault),
        };
        Ok(faults.iter().enumerate().map(active).collect())
    }

    /// Adds what the fault does in a step to what others do, and to the number of dead cells.
    pub(crate) fn act(&mut self, now: Millis, at: Point, effect: &mut Effect, dead: &mut u8) {
        if !self.phase.is_there(&self.fault, &mut self.chance, now) {
            return;
        }
        match self.fault.effect() {
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
            Defect::Worn(side, share) => *side.of(&mut effect.grips) *= 1.0 - share,
            Defect::DeadCell => *dead = dead.saturating_add(1),
        }
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
