//! Words for the supervisors, as numbers.

use crate::error::cotama_error;
use cotama_models::level::Told;

/// A word for the supervisors: what it is about.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_word {
    /// Nobody says anything.
    Nothing = 0,
    /// The mission begins; of a robot without one, a drive.
    Begins = 1,
    /// The task for which the robot stands in an objective, a `COTAMA_STEP_...`, is done.
    Over = 2,
    /// The robot stands, after the mission was ended.
    Stopped = 3,
    /// A sub-objective, a `COTAMA_SUB_OBJECTIVE_...`, is reached.
    Reached = 4,
    /// Failures of a report, a `COTAMA_REPORT_...`, were found.
    Report = 5,
    /// Parts that a loss, a `COTAMA_LOSS_...`, took work again.
    Back = 6,
    /// The operator chooses one of his sub-objectives.
    Chooses = 7,
    /// The operator is done with one of his sub-objectives.
    Done = 8,
    /// The operator gives up, or is silent for too long.
    GivesUp = 9,
}

/// Something that the supervisors are told.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_told {
    /// A `cotama_word`,
    pub word: u32,
    /// and the number of what it is about; 0 where it is about nothing that has one.
    pub number: u32,
}

impl From<Option<Told>> for cotama_told {
    fn from(told: Option<Told>) -> Self {
        use cotama_word::{
            Back, Begins, Chooses, Done, GivesUp, Nothing, Over, Reached, Report, Stopped,
        };
        let (word, number) = match told {
            None => (Nothing, 0),
            Some(Told::Begins) => (Begins, 0),
            Some(Told::Over(it)) => (Over, it),
            Some(Told::Stopped) => (Stopped, 0),
            Some(Told::Reached(it)) => (Reached, it),
            Some(Told::Report(it)) => (Report, it),
            Some(Told::Back(it)) => (Back, it),
            Some(Told::Chooses(it)) => (Chooses, it),
            Some(Told::Done(it)) => (Done, it),
            Some(Told::GivesUp) => (GivesUp, 0),
        };
        Self { word: word as u32, number: number as u32 }
    }
}

impl cotama_told {
    /// Reads what it stands for; `None` for nothing.
    pub(crate) fn read(self) -> Result<Option<Told>, cotama_error> {
        let it = self.number as usize;
        Ok(Some(match (self.word, self.number) {
            (0, 0) => return Ok(None),
            (1, 0) => Told::Begins,
            (2, _) => Told::Over(it),
            (3, 0) => Told::Stopped,
            (4, _) => Told::Reached(it),
            (5, _) => Told::Report(it),
            (6, _) => Told::Back(it),
            (7, _) => Told::Chooses(it),
            (8, _) => Told::Done(it),
            (9, 0) => Told::GivesUp,
            _ => return Err(cotama_error::BadNumber),
        }))
    }
}
