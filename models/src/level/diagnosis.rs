//! From flags to failures.

use super::tables::{Failure, MAX_FAILURES};
use crate::severity::Severity;

/// A set of failures, by number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rows([u64; MAX_FAILURES / 64]);

impl Rows {
    /// Whether none is in it.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|it| *it == 0)
    }

    /// Returns how many are in it.
    pub fn count(&self) -> u32 {
        self.0.iter().fold(0, |all, it| all.saturating_add(it.count_ones()))
    }

    /// Whether a failure is in it.
    pub fn has(&self, row: usize) -> bool {
        self.0.get(row / 64).is_some_and(|it| it >> (row % 64) & 1 == 1)
    }

    fn add(&mut self, row: usize) {
        debug_assert!(row < MAX_FAILURES, "failures of a robot");
        if let Some(word) = self.0.get_mut(row / 64) {
            *word |= 1 << (row % 64);
        }
    }

    /// Takes a failure out.
    pub(super) fn remove(&mut self, row: usize) {
        if let Some(word) = self.0.get_mut(row / 64) {
            *word &= !(1 << (row % 64));
        }
    }

    /// Iterates over the failures, the worst first, among equals by number.
    pub fn worst_first<'f>(
        &self,
        failures: &'f [Failure],
    ) -> impl Iterator<Item = usize> + use<'f> {
        let rows = *self;
        Severity::ALL.into_iter().rev().flat_map(move |severity| {
            let is = move |row: &usize| failures.get(*row).is_some_and(|it| it.worst == severity);
            (0..failures.len()).filter(move |row| rows.has(*row) && is(row))
        })
    }
}

/// Returns the failures that flags are taken for: one is a unique diagnosis; several are told apart
/// by nothing, and all of them are taken to be there (Durand et al., TAROS 2010, Section III.B;
/// that all are taken is assumed, as it is the safe side). `up` are the flags that are raised, a
/// bit each, and `raised` those of them that are new.
///
/// A failure is a candidate when all flags that always show it are up and one of them is new; one
/// whose flags another candidate shows as well, with more, is left out. Where none is a candidate,
/// all failures are that a new flag shows, always or at times.
///
/// ```
/// use cotama_models::level::{Failure, diagnose};
/// use cotama_models::severity::{Persistence, Severity};
/// let row = |flags, sometimes| Failure {
///     flags,
///     sometimes,
///     report: 0,
///     worst: Severity::Weak,
///     persistence: Persistence::Permanent,
/// };
/// let rows = [row(0b001, 0), row(0b011, 0), row(0b100, 0b1000)];
/// let found = |up, raised| diagnose(&rows, up, raised).worst_first(&rows).collect::<Vec<_>>();
/// assert_eq!(found(0b001, 0b001), [0]);
/// assert_eq!(found(0b011, 0b010), [1]); // with more than the first row shows
/// assert_eq!(found(0b010, 0b010), [1]); // not whole, but nothing else shows it
/// assert_eq!(found(0b1000, 0b1000), [2]); // as at times
/// ```
pub fn diagnose(failures: &[Failure], up: u64, raised: u64) -> Rows {
    let is_new = |it: &Failure| (it.flags | it.sometimes) & raised != 0;
    let is_whole = |it: &Failure| it.flags & raised != 0 && it.flags & !up == 0;
    let says_less =
        |one: &Failure, other: &Failure| one.flags != other.flags && one.flags & !other.flags == 0;
    let mut found = Rows::default();
    let any_is_whole = failures.iter().any(is_whole);
    for (at, it) in failures.iter().enumerate() {
        let said = || failures.iter().any(|other| is_whole(other) && says_less(it, other));
        if if any_is_whole { is_whole(it) && !said() } else { is_new(it) } {
            found.add(at);
        }
    }
    found
}
