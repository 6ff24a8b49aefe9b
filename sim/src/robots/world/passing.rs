//! Passing over periods in which nothing happens: the robot moves, and nobody has to look.

use super::World;
use crate::robots::failing::{mode, moves};
use crate::run::LONGEST;
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::robots::{Global, Mode, Moment, Where};

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Passes over periods in which nothing happens, up to the next second, in which margins are
    /// looked at.
    pub(super) fn pass_over(&mut self) {
        let busy = !self.calm || !self.decider.listens() || self.level().player().round_is_due();
        let held = self.hindered.waits() || self.drive.owed() > Millimetres(0);
        if busy
            || held
            || self.looks_at_margins()
            || !self.failures.thinks(self.robot)
            || !self.goes_undisturbed()
        {
            return;
        }
        let until =
            |it: Millis| (it.0.saturating_sub(self.now.0) / self.body.period.0).saturating_sub(1);
        let mut most = until(Millis((self.now.0 / 1_000 + 1) * 1_000));
        most = most.min(until(LONGEST)).min(self.failures.unseen_for(self.robot, self.place));
        most = self.watching.late_at().map_or(most, |it| most.min(until(it)));
        let returns = self.decider.adapted().returns_at();
        let shown = self.failures.shown(self.tables());
        let adapts = self.decider.adapted().ends_at(self.tables(), shown, self.now);
        most = returns.into_iter().chain(adapts).fold(most, |most, it| most.min(until(it)));
        let unmasks = self.decider.unmasks_at(self.now);
        most = unmasks.map_or(most, |it| most.min(until(it)));
        let changes = self.failures.changes(self.robot, self.now);
        most = changes.map_or(most, |it| most.min(until(it)));
        let ends = self.failures.all.iter().zip(&self.until).filter(|it| !it.0.over);
        let ends = ends.filter_map(|it| *it.1);
        for it in self.waiting.iter().map(|it| it.when).chain(ends) {
            most = most.min(self.periods_before(it));
        }
        let activities = &self.mission.scenario().activities;
        let borders = activities.iter().flat_map(|it| [it.x_start, it.x_end]);
        for border in borders.chain(self.hindered.next()).filter(|it| *it > self.drive.x()) {
            most = most.min(self.periods_before_place(border));
        }
        let waits = match self.global {
            Global::Does(_) if self.objective_stands() => {
                let activity = self.planning.activity(self.objective, self.drive.x().0);
                until(Millis(self.objective_since.0 + self.planning.standing(activity).0))
            }
            Global::Does(_) => match (self.place, mode(self.robot, self.place)) {
                (Where::Runs { .. }, Some(Mode::Autonomous)) if moves(self.robot, self.place) => {
                    u64::MAX
                }
                (Where::Runs { configuration, .. }, Some(Mode::Autonomous)) => {
                    let of = self.robot.configurations.get(configuration);
                    until(Millis(self.place_since.0 + of.map_or(0, |it| it.takes.0)))
                }
                _ => until(self.operator.waits_until()),
            },
            Global::Waits | Global::Done | Global::Secures | Global::Safe => 0,
        };
        most = most.min(waits);
        if most == 0 {
            return;
        }
        let passed = if self.drive.line().is_some() { self.glide(most) } else { self.drive(most) };
        self.failures.look_on(self.robot, self.place, passed);
        self.run.rounds += passed;
        let last = Millis(self.now.0.saturating_sub(self.body.period.0));
        self.see(last);
    }

    /// Goes on evenly along a line for so many periods.
    fn glide(&mut self, periods: u64) -> u64 {
        let power = self.power(self.drive.speed().0 > 0);
        let power = self.hindered.real(self.mission, self.drive.x(), power);
        if let Some(line) = self.drive.line_mut() {
            line.glide(periods, self.body.period);
        }
        let energy = power.0.saturating_mul(self.body.period.0).saturating_mul(periods);
        self.energy_uj = self.energy_uj.saturating_add(energy);
        self.exposed_on(periods);
        self.now.0 += self.body.period.0 * periods;
        periods
    }

    /// Drives in the plane for so many periods, or until it touches something; returns how many.
    fn drive(&mut self, periods: u64) -> u64 {
        for passed in 1..=periods {
            self.travel();
            self.now.0 += self.body.period.0;
            if self.run.touched.is_some() {
                return passed;
            }
        }
        periods
    }

    /// Whether the robot would go on at its speed on a line for a period; in the plane, whether
    /// nothing but itself moves.
    fn goes_undisturbed(&self) -> bool {
        let Some(mut next) = self.drive.line().copied() else {
            return self.drive.is_alone() && self.doors.is_empty();
        };
        let speed = next.speed();
        self.failures.go(self.robot, self.now, &self.demand(), &mut next);
        next.speed() == speed
    }

    /// Returns in how many periods the robot is still before a place for certain. In the plane it
    /// may cut a corner of its path: so it counts as four times as fast as its body can be.
    fn periods_before_place(&self, place: Millimetres) -> u64 {
        if let Some(line) = self.drive.line() {
            return line.times_before(place, self.body.period).unwrap_or(0);
        }
        let most = 4 * self.body.speed_max.0 * self.body.period.0 / 1_000 + 1;
        place.0.saturating_sub(self.drive.x().0 + 1) / most
    }

    /// The exposures of the last period go on for so many.
    pub(super) fn exposed_on(&mut self, periods: u64) {
        for _ in 0..if self.failures.all.is_empty() { 0 } else { periods } {
            self.measure(self.drive.x(), self.permitted);
        }
    }

    /// In how many periods a moment has not come yet, with everything as it is.
    pub(super) fn periods_before(&self, when: Moment) -> u64 {
        let until =
            |it: u64| (it.saturating_sub(self.now.0) / self.body.period.0).saturating_sub(1);
        let since = |place: Option<usize>, after: Millis| {
            let first = self.first.iter().find(|it| it.0 == place);
            first.map_or(u64::MAX, |it| until(it.1.0 + after.0))
        };
        if self.is_due(when) {
            return 0;
        }
        match when {
            Moment::Place(x) => self.periods_before_place(x),
            Moment::At(at) => until(at.0),
            Moment::During(place, after) => since(Some(place), after),
            Moment::Waiting(after) => since(None, after),
        }
    }
}
