//! The ranges of numbers in mission files, and the names of tasks.

use super::fields::Fields;
use crate::missions::definition::Task;
use crate::missions::diagnostic::Spanned;
use std::ops::RangeInclusive;

/// The largest length or duration, in mm or ms.
pub(super) const MAX_QUANTITY: i64 = 1_000_000_000;
pub(super) const POSITIVE: RangeInclusive<i64> = 1..=MAX_QUANTITY;
pub(super) const AT_LEAST_ZERO: RangeInclusive<i64> = 0..=MAX_QUANTITY;
/// Up to 100 m/s, so that no power passes 64 bits.
pub(super) const SPEEDS: RangeInclusive<i64> = 1..=100_000;

/// The task of this name; reports it if there is none.
pub(super) fn task(fields: &Fields<'_>, name: &Spanned<String>) -> Option<Task> {
    fields.index_of(name, "task", Task::NAMES.iter().copied())?;
    Task::from_name(&name.value)
}
