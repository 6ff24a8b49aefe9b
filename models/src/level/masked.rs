//! Flags that are masked: what they show is known, so they are not diagnosed for a while, or any
//! more.

use super::diagnosis::{Rows, diagnose};
use super::sets::bits;
use super::tables::{Failure, MAX_MASKS, Tables};
use cotama_core::units::Millis;

/// The time of a mask that lasts to the end.
const FOR_GOOD: Millis = Millis(u64::MAX);

/// The masks that were made, and those that the operator has not ordered yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Masked {
    /// The masks that were made, a bit each, and when each is over.
    made: u64,
    until: [Millis; MAX_MASKS],
    /// The masks that wait for his order, a bit each.
    wait: u64,
}

impl Default for Masked {
    fn default() -> Self {
        Self { made: 0, until: [Millis(0); MAX_MASKS], wait: 0 }
    }
}

/// The part of what observers say that masks hide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hidden {
    /// The flags that are masked, a bit each.
    pub flags: u64,
    /// The reports that have masked them, a bit each: their failures are known.
    pub reports: u64,
    /// The losses that came with them, a bit each: nobody could see whether they are over.
    pub losses: u32,
}

impl Hidden {
    /// Returns the failures that flags are taken for ([`diagnose`]), with masked flags down and
    /// without the failures that have masked them.
    ///
    /// ```
    /// use cotama_models::level::{Failure, Hidden};
    /// use cotama_models::severity::{Persistence, Severity};
    /// let row = |flags, report| Failure {
    ///     flags,
    ///     sometimes: 0,
    ///     report,
    ///     worst: Severity::Hard,
    ///     persistence: Persistence::Permanent,
    /// };
    /// let rows = [row(0b011, 0), row(0b110, 1)];
    /// // The switch of the first row hangs: its flag says nothing any more.
    /// let hidden = Hidden { flags: 0b001, reports: 0b1, losses: 0 };
    /// let found = |raised| hidden.diagnose(&rows, raised, raised).worst_first(&rows).collect();
    /// let none: Vec<usize> = found(0b001);
    /// assert_eq!((none, found(0b110)), (vec![], vec![1]));
    /// ```
    pub fn diagnose(self, failures: &[Failure], up: u64, raised: u64) -> Rows {
        let mut found = diagnose(failures, up & !self.flags, raised & !self.flags);
        for (row, it) in failures.iter().enumerate() {
            if self.reports >> (it.report % 64) & 1 == 1 {
                found.remove(row);
            }
        }
        found
    }
}

impl Masked {
    /// The report of a mask is told: it is made, or waits for the operator's order.
    pub(super) fn tell(&mut self, tables: &Tables<'_>, mask: usize, now: Millis) {
        let waits = tables.masks.get(mask).is_some_and(|it| it.on_order);
        if waits { self.wait |= 1 << mask } else { self.make(tables, mask, now) }
    }

    /// The operator chooses to go on: masks that waited for it are made, but for those whose loss
    /// has come back before; `lost` are those that are known, a bit each.
    pub(super) fn order(&mut self, tables: &Tables<'_>, lost: u32, now: Millis) {
        let wait = core::mem::take(&mut self.wait);
        let is_known = |it: &usize| {
            let loss = tables.masks.get(*it).and_then(|it| it.loss);
            loss.is_none_or(|it| lost >> (it % 32) & 1 == 1)
        };
        bits(wait).filter(is_known).for_each(|it| self.make(tables, it, now));
    }

    fn make(&mut self, tables: &Tables<'_>, mask: usize, now: Millis) {
        let (Some(it), Some(until)) = (tables.masks.get(mask), self.until.get_mut(mask)) else {
            debug_assert!(false, "a mask of this robot");
            return;
        };
        self.made |= 1 << mask;
        *until = it.lasts.map_or(FOR_GOOD, |it| Millis(now.0.saturating_add(it.0)));
    }

    /// Returns what masks hide at a time.
    pub(super) fn hidden(&self, tables: &Tables<'_>, now: Millis) -> Hidden {
        let holds = |it: &usize| self.until.get(*it).is_some_and(|it| now < *it);
        let all = bits(self.made).filter(holds).filter_map(|it| tables.masks.get(it));
        all.fold(Hidden::default(), |all, it| Hidden {
            flags: all.flags | it.flags,
            reports: all.reports | 1 << (it.report % 64),
            losses: all.losses | it.loss.map_or(0, |it| 1 << (it % 32)),
        })
    }

    /// Returns when the next mask is over; `None` where none ends.
    pub(super) fn ends_at(&self, now: Millis) -> Option<Millis> {
        let ends = bits(self.made).filter_map(|it| self.until.get(it).copied());
        ends.filter(|it| *it > now && *it < FOR_GOOD).min()
    }
}
