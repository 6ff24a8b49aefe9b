//! Reasons why a robot cannot drive over a floor.

use std::fmt;

/// The longest drive: two hours.
pub const MAX_S: u64 = 7_200;
/// The most people.
pub const MAX_PEOPLE: usize = 200;

/// Reasons why a robot cannot drive there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoDrive {
    /// The floor is too large for a map of 0.1 m, or for localisation.
    Large,
    /// Less than two places, or more than there may be, or none that leads to another.
    Places,
    /// More people than [`MAX_PEOPLE`], or longer than [`MAX_S`].
    Options,
}

impl fmt::Display for NoDrive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Large => f.write_str("the floor is too large for a robot's map"),
            Self::Places => f.write_str("no two places of the floor have a way between them"),
            Self::Options => write!(f, "at most {MAX_PEOPLE} people, and {MAX_S} s"),
        }
    }
}

impl std::error::Error for NoDrive {}
