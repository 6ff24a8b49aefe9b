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

/// Whether a word of C has the kind of one of Rust's, one later: 0 says nothing.
const fn is(word: cotama_word, told: Told) -> bool {
    word as u32 == told.to_numbers().0 as u32 + 1
}

const _: () = {
    assert!(is(cotama_word::Begins, Told::Begins) && is(cotama_word::Over, Told::Over(0)));
    assert!(is(cotama_word::Stopped, Told::Stopped) && is(cotama_word::Reached, Told::Reached(0)));
    assert!(is(cotama_word::Report, Told::Report(0)) && is(cotama_word::Back, Told::Back(0)));
    assert!(is(cotama_word::Chooses, Told::Chooses(0)) && is(cotama_word::Done, Told::Done(0)));
    assert!(is(cotama_word::GivesUp, Told::GivesUp) && cotama_word::Nothing as u32 == 0);
};

impl From<Option<Told>> for cotama_told {
    fn from(told: Option<Told>) -> Self {
        let (word, number) = told.map_or((0, 0), |it| {
            let (kind, number) = it.to_numbers();
            (u32::from(kind) + 1, number)
        });
        Self { word, number: number as u32 }
    }
}

impl cotama_told {
    /// Reads what it stands for; `None` for nothing.
    pub(crate) fn read(self) -> Result<Option<Told>, cotama_error> {
        match (self.word.checked_sub(1), self.number) {
            (None, 0) => Ok(None),
            (None, _) => Err(cotama_error::BadNumber),
            (Some(kind), number) => {
                let kind = u8::try_from(kind).map_err(|_| cotama_error::BadNumber)?;
                let told = Told::from_numbers(kind, number as usize);
                told.map(Some).ok_or(cotama_error::BadNumber)
            }
        }
    }
}
