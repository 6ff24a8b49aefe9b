//! Reactions that change no configuration: settings while they hold, and losses that come back.

use super::sets::{bits, losses_of, set_of};
use super::tables::{MAX_LOSSES, MAX_REPORTS, Setting, Tables};
use super::told::Mode;
use crate::severity::Persistence;
use cotama_core::units::Millis;

/// The time for which a lost part has to work before it is used again (assumed).
pub const SOUND_FOR: Millis = Millis(5_000);

/// The settings that were made, and since when lost parts work again.
#[derive(Clone, Copy, Debug)]
pub struct Adapted {
    /// The reports whose settings were made, a bit each.
    made: u64,
    /// The last sight of failures of a report after its setting was made.
    seen: [Millis; MAX_REPORTS],
    /// The losses that are known and can come back, a bit each.
    known: u32,
    /// The last sight of a loss.
    there: [Millis; MAX_LOSSES],
    /// The losses that are there, as far as can be seen.
    broken: u32,
    /// The losses whose return was told, but which still count as known.
    told: u32,
}

impl Default for Adapted {
    fn default() -> Self {
        let none = Millis(0);
        let (seen, there) = ([none; MAX_REPORTS], [none; MAX_LOSSES]);
        Self { made: 0, seen, known: 0, there, broken: 0, told: 0 }
    }
}

impl Adapted {
    /// The setting of a report is made.
    pub fn set(&mut self, report: usize, now: Millis) {
        if let Some(seen) = self.seen.get_mut(report) {
            self.made |= 1 << report;
            *seen = now;
        }
    }

    /// Notes which reports show themselves now, and which losses are there, a bit each.
    pub fn see(&mut self, shown: u64, broken: u32, now: Millis) {
        for it in bits(shown & self.made) {
            self.seen.get_mut(it).into_iter().for_each(|it| *it = now);
        }
        for it in bits(u64::from(broken & self.known)) {
            self.there.get_mut(it).into_iter().for_each(|it| *it = now);
        }
        self.broken = broken;
    }

    /// Returns how much the settings leave of the speed in a mode, in thousandths: the least.
    pub fn speed(&self, tables: &Tables<'_>, now: Millis, mode: Option<Mode>) -> u16 {
        let holding = self.holding(tables, now);
        let all = bits(holding).filter_map(|it| tables.reports.get(it)?.sets);
        let all = all.filter(|it| it.mode.is_none() || it.mode == mode);
        all.map(|it| it.speed).min().unwrap_or(1_000)
    }

    /// Returns the reports, a bit each, whose settings hold.
    pub fn holding(&self, tables: &Tables<'_>, now: Millis) -> u64 {
        let holds = |it: &usize| now < self.end(tables, *it);
        set_of(bits(self.made).filter(holds))
    }

    /// Returns how much the settings that answer permanent failures leave of the speed of a robot
    /// that drives itself, in thousandths: the least.
    pub fn lasting_speed(&self, tables: &Tables<'_>) -> u16 {
        let stays = |report: &usize| {
            let mut rows = tables.failures.iter().filter(|it| usize::from(it.report) == *report);
            rows.any(|it| it.persistence == Persistence::Permanent)
        };
        let lasts = |it: &Setting| !it.mends && it.mode != Some(Mode::Operator);
        let all = bits(self.made).filter(stays).filter_map(|it| tables.reports.get(it)?.sets);
        all.filter(lasts).map(|it| it.speed).min().unwrap_or(1_000)
    }

    /// Returns the end of a setting whose failures are not seen again.
    fn end(&self, tables: &Tables<'_>, report: usize) -> Millis {
        let holds = tables.reports.get(report).and_then(|it| it.sets).map_or(0, |it| it.holds.0);
        let seen = self.seen.get(report).map_or(0, |it| it.0);
        Millis(seen.saturating_add(holds))
    }

    /// Returns the end of the next setting, with all failures as they are; `shown` as they show
    /// themselves.
    pub fn ends_at(&self, tables: &Tables<'_>, shown: u64, now: Millis) -> Option<Millis> {
        let ends = bits(self.made & !shown).map(|it| self.end(tables, it));
        ends.filter(|it| *it > now).min()
    }

    /// Returns the losses, a bit each, of those known that have been over for long enough, and that
    /// nobody was told of yet.
    pub fn back(&mut self, tables: &Tables<'_>, known: u32, now: Millis) -> u32 {
        let returns = |it: &usize| tables.losses.get(*it).is_some_and(|it| it.back.is_some());
        let known = known & losses_of((0..MAX_LOSSES).filter(returns));
        for it in bits(u64::from(known & !self.known)) {
            self.there.get_mut(it).into_iter().for_each(|it| *it = now);
        }
        self.known = known;
        self.told &= known;
        let over = self.over(known & !self.told);
        let long = over.filter(|it| now.0 >= it.1.0.saturating_add(SOUND_FOR.0));
        losses_of(long.map(|it| it.0))
    }

    /// The supervisors were told that a loss is over.
    pub fn is_back(&mut self, loss: usize) {
        self.told |= 1 << loss.min(MAX_LOSSES);
    }

    /// Iterates over the losses of a set that are not there any more, with when they last were.
    fn over(&self, of: u32) -> impl Iterator<Item = (usize, Millis)> {
        let there = self.there;
        bits(u64::from(of & !self.broken)).filter_map(move |it| Some((it, *there.get(it)?)))
    }

    /// Returns the time at which the next loss has been over for long enough.
    pub fn returns_at(&self) -> Option<Millis> {
        let over = self.over(self.known & !self.told);
        over.map(|it| Millis(it.1.0.saturating_add(SOUND_FOR.0))).min()
    }
}
