//! The named entries of a file.

use crate::missions::definition::{Hardware, Zone};
use crate::robots::Robot;
use cotama_core::units::Millimetres;

/// A named entry of a file, as far as it could be read.
pub(super) struct Entry<T> {
    /// Empty when it could not be read.
    pub(super) id: String,
    pub(super) item: Option<T>,
}

impl<T> IntoIterator for Entry<T> {
    type Item = Self;
    type IntoIter = std::iter::Once<Self>;

    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self)
    }
}

impl<T> Entry<T> {
    /// Stands for entries that could not be read.
    pub(super) fn unreadable() -> Self {
        Self { id: String::new(), item: None }
    }
}

/// The names of entries.
pub(super) fn ids<T>(entries: &[Entry<T>]) -> impl Iterator<Item = &str> + Clone {
    entries.iter().map(|entry| entry.id.as_str())
}

/// The names that faults refer to, as far as they could be read.
pub(super) struct Names<'n> {
    pub(super) path_length: Option<Millimetres>,
    pub(super) zones: &'n [Entry<Zone>],
    pub(super) hardware: &'n [Entry<Hardware>],
    /// The robot from a file whose supervisors decide, if it is one.
    pub(super) robot: Option<&'n Robot>,
    /// The doors of the floor; `None` where the mission names no floor.
    pub(super) doors: Option<&'n [String]>,
}
