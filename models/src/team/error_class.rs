//! The classes of errors by their consequence for the team.

use super::bid::Pledge;

/// How often the same error may be answered if nothing else is said. The thesis says "too often"
/// and gives no number.
pub const MOST_REPEATS: u32 = 3;

/// The consequence of an error for the team (3.14).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ErrorClass {
    /// The robot goes on: it repeats the action, or goes back in its plan.
    Recoverable,
    /// The robot gives the task back, and it is announced again.
    SemiRecoverable,
    /// The task is reported to whoever gave it to the team.
    NonRecoverable,
}

impl ErrorClass {
    /// All classes.
    pub const ALL: [Self; 3] = [Self::Recoverable, Self::SemiRecoverable, Self::NonRecoverable];

    /// In a word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Recoverable => "recoverable",
            Self::SemiRecoverable => "semi-recoverable",
            Self::NonRecoverable => "non-recoverable",
        }
    }
}

/// The class of an error (3.14).
///
/// `estimate` is what the task is now thought to cost in all, what was spent included; none where
/// the robot cannot do it any more. `others` says whether some coalition, of one robot or several,
/// is capable of the task. `repeats` counts how often the same error was there before, and from
/// `most_repeats` on nothing is tried again.
///
/// ```
/// use cotama_models::team::{ErrorClass, Pledge, classify};
/// let pledge = Pledge { most: 90 };
/// assert_eq!(classify(Some(80), pledge, true, 0, 3), ErrorClass::Recoverable);
/// assert_eq!(classify(Some(95), pledge, true, 0, 3), ErrorClass::SemiRecoverable);
/// assert_eq!(classify(None, pledge, true, 0, 3), ErrorClass::SemiRecoverable);
/// assert_eq!(classify(None, pledge, false, 0, 3), ErrorClass::NonRecoverable);
/// assert_eq!(classify(Some(80), pledge, true, 3, 3), ErrorClass::NonRecoverable);
/// ```
pub fn classify(
    estimate: Option<u64>,
    pledge: Pledge,
    others: bool,
    repeats: u32,
    most_repeats: u32,
) -> ErrorClass {
    if repeats >= most_repeats {
        ErrorClass::NonRecoverable
    } else if estimate.is_some_and(|it| pledge.is_kept(it)) {
        ErrorClass::Recoverable
    } else if others {
        ErrorClass::SemiRecoverable
    } else {
        ErrorClass::NonRecoverable
    }
}
