//! Reactions that change no configuration: settings while they hold, and losses that come back.

use super::failing::Failures;
use cotama_core::units::Millis;
use cotama_models::cotama::Persistence;
use cotama_models::robots::{Mode, Robot, members};

/// How long a part that was lost has to work before it is used again (assumed).
pub(crate) const SOUND_FOR: Millis = Millis(5_000);

/// The settings that were made, and since when lost parts work again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Adapted {
    /// Each report whose setting was made, and when it was last seen.
    settings: Vec<(usize, Millis)>,
    /// Each loss that is over though it is known, and when it was last seen not to be.
    sound: Vec<(usize, Millis)>,
}

impl Adapted {
    /// A setting answers a report.
    pub(crate) fn answer(
        &mut self,
        robot: &Robot,
        failures: &mut Failures,
        report: usize,
        now: Millis,
    ) {
        let Some(of) = robot.losses.reports.get(report) else { return };
        if let Some(setting) = &of.sets {
            failures.set(&of.failures, setting);
        }
        self.set(report, now);
    }

    /// The setting of a report is made.
    fn set(&mut self, report: usize, now: Millis) {
        match self.settings.iter_mut().find(|it| it.0 == report) {
            Some(it) => it.1 = now,
            None => self.settings.push((report, now)),
        }
    }

    /// Notes which failures show themselves now.
    pub(crate) fn see(&mut self, robot: &Robot, failures: &Failures, now: Millis) {
        for (report, seen) in &mut self.settings {
            let of = robot.losses.reports.get(*report);
            if of.is_some_and(|it| failures.is_seen(&it.failures)) {
                *seen = now;
            }
        }
        let broken = failures.broken_losses(robot);
        for (loss, seen) in &mut self.sound {
            if broken >> *loss & 1 == 1 {
                *seen = now;
            }
        }
    }

    /// Returns how much the settings leave of the speed in a mode, in thousandths: the least.
    pub(crate) fn speed(&self, robot: &Robot, now: Millis, mode: Option<Mode>) -> u16 {
        let holds = |it: &&(usize, Millis)| now.0 < Self::end(robot, it).0;
        let all = self.settings.iter().filter(holds);
        let all = all.filter_map(|it| robot.losses.reports.get(it.0)?.sets.as_ref());
        let all = all.filter(|it| it.mode.is_none() || it.mode == mode);
        all.map(|it| it.speed).min().unwrap_or(1_000)
    }

    /// Returns how much the settings that answer permanent failures leave of the speed of a robot
    /// that drives itself, in thousandths: the least.
    pub(crate) fn lasting_speed(&self, robot: &Robot) -> u16 {
        let stays = |it: &usize| {
            let row = robot.failures.get(*it);
            row.is_some_and(|it| it.persistence == Persistence::Permanent)
        };
        let reports = self.settings.iter().filter_map(|it| robot.losses.reports.get(it.0));
        let lasting = reports.filter(|it| it.failures.iter().any(stays));
        let all = lasting.filter_map(|it| it.sets.as_ref()).filter(|it| !it.mends);
        let all = all.filter(|it| it.mode != Some(Mode::Operator));
        all.map(|it| it.speed).min().unwrap_or(1_000)
    }

    /// Returns the end of a setting whose failure is not seen again.
    fn end(robot: &Robot, (report, seen): &(usize, Millis)) -> Millis {
        let of = robot.losses.reports.get(*report).and_then(|it| it.sets.as_ref());
        Millis(seen.0.saturating_add(of.map_or(0, |it| it.holds.0)))
    }

    /// Returns the end of the next setting, with all failures as they are.
    pub(crate) fn ends_at(
        &self,
        robot: &Robot,
        failures: &Failures,
        now: Millis,
    ) -> Option<Millis> {
        let lasts = |it: &&(usize, Millis)| {
            let of = robot.losses.reports.get(it.0);
            of.is_some_and(|it| failures.is_seen(&it.failures))
        };
        let ends = self.settings.iter().filter(|it| !lasts(it)).map(|it| Self::end(robot, it));
        ends.filter(|it| *it > now).min()
    }

    /// Returns the losses of those known that are over for long enough.
    pub(crate) fn back(
        &mut self,
        robot: &Robot,
        failures: &Failures,
        known: u32,
        now: Millis,
    ) -> Vec<usize> {
        let broken = failures.broken_losses(robot);
        let returns = |it: &usize| robot.losses.losses.get(*it).is_some_and(|it| it.returns);
        self.sound.retain(|it| known >> it.0 & 1 == 1);
        let over = known & !broken;
        for loss in members(u64::from(known)).filter(returns) {
            if !self.sound.iter().any(|it| it.0 == loss) {
                self.sound.push((loss, now));
            }
        }
        let long = |it: &&(usize, Millis)| {
            over >> it.0 & 1 == 1 && now.0 >= it.1.0.saturating_add(SOUND_FOR.0)
        };
        self.sound.iter().filter(long).map(|it| it.0).collect()
    }

    /// Returns the time at which the next loss has been over for long enough.
    pub(crate) fn returns_at(&self, robot: &Robot, failures: &Failures) -> Option<Millis> {
        let broken = failures.broken_losses(robot);
        let over = self.sound.iter().filter(|it| broken >> it.0 & 1 == 0);
        over.map(|it| Millis(it.1.0.saturating_add(SOUND_FOR.0))).min()
    }
}
