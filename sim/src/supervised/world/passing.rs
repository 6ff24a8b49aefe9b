//! Periods in which nothing happens, passed over at once.
//!
//! After a period in which nothing happened, and as long as nothing is due, each further one is as
//! that one was: the robot goes on evenly, and what is counted grows evenly. A run with a trace
//! takes each period by itself; both come to the same, which is a test.

use super::objective::Objective;
use super::{CLOCKS, World, first_fired};
use crate::body::{Motion, PERIOD, PLANNING, effect};
use crate::run::LONGEST;
use crate::supervised::When;
use cotama_core::player::Program;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Body, Configuration, Modules, local};

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// Passes over the periods until something can happen.
    pub(in crate::supervised) fn pass_over(&mut self) {
        if !self.calm || self.withdrawn.is_some() {
            return;
        }
        let Some(periods) = self.idle_periods().filter(|it| *it > 0) else { return };
        let time = Millis(periods.saturating_mul(PERIOD.0));
        let before = self.robot.drive;
        self.robot.drive.glide(periods, PERIOD);
        let activity = self.activity_at(before.x());
        self.drive_well(activity, self.robot.x().0 - before.x().0);
        self.robot.draw(self.power(activity, false), time);
        self.grow_exposures(time);
        self.robot.look_on(time, &self.watch_of());
        self.run.rounds += periods;
        self.robot.took_quiet_rounds(periods);
        self.now.0 += time.0;
        let last = Millis(self.now.0 - PERIOD.0);
        self.decider.idle(last, Body { at_goal: false, stands: !self.robot.moves() });
    }

    /// Whether a robot whose mission is over stands, and nothing changes that before this time:
    /// until then every further period is as the last one.
    pub(in crate::supervised) fn rests(&self, until: Millis) -> bool {
        let due = |when: When| match when {
            When::At(at) => at,
            // The robot stands in front of the place, or the failure would have been due.
            When::Place(_) => Millis(u64::MAX),
            When::During(state, after) => {
                let reached = self.first.iter().find(|it| it.0 == state);
                Millis(reached.map_or(u64::MAX, |it| it.1.0.saturating_add(after.0)))
            }
            When::Fired(act, after) => {
                let since = first_fired(&self.run.fired, act);
                Millis(since.map_or(u64::MAX, |it| it.0.saturating_add(after.0)))
            }
        };
        let under_way = self.robot.failures.iter().zip(&self.until);
        let under_way =
            under_way.filter(|(it, _)| !it.over && effect(it.mode).motion != Motion::Mindless);
        let changing = under_way.flat_map(|(it, until)| {
            let later = it.changes().into_iter().flatten().filter(|at| *at >= self.now);
            until.map(due).into_iter().chain(later)
        });
        let unseen = self.robot.periods_unseen(&self.watch_of()) == u64::MAX;
        let calm = self.calm && self.decider.listens() && unseen;
        (calm || !self.robot.thinks())
            && !self.mission.recovery
            && !self.robot.moves()
            && self.waiting.iter().map(|it| due(it.when)).chain(changing).all(|it| it >= until)
    }

    /// How many periods nothing can happen in; none where something may at once.
    fn idle_periods(&self) -> Option<u64> {
        let objective = self.objective();
        let (now, robot) = (self.now, &self.robot.drive);
        let mut until = self.decider.idle_until()?.0.min(LONGEST.0 - PERIOD.0);
        until = until.min(self.watching.late_at().map_or(u64::MAX, |it| it.0));
        match objective {
            Objective::Drives(_) => {}
            Objective::Stands(it) => {
                let activity = self.planning.activity(it, robot.x().0);
                until = until.min(self.global_since.0 + self.planning.standing(activity).0);
            }
            _ => return None,
        }
        match self.decider.situation().local {
            local::State::Planning => until = until.min(self.decider.since().0 + PLANNING.0),
            local::State::HandOver | local::State::Teleprogrammed | local::State::Teleoperated => {
                until = until.min(self.operator.waits_until(now)?.0);
            }
            _ => {}
        }
        let mut most = u64::MAX;
        let mut due = |when: When| match when {
            When::At(at) => until = until.min(at.0),
            // The position at the start of a period counts, so one more is before the place.
            When::Place(x) => {
                let times = robot.times_before(x, PERIOD).map_or(0, |it| it.saturating_add(1));
                most = most.min(times);
            }
            When::During(state, after) => {
                if let Some((_, since)) = self.first.iter().find(|it| it.0 == state) {
                    until = until.min(since.0 + after.0);
                }
            }
            When::Fired(act, after) => {
                if let Some(since) = first_fired(&self.run.fired, act) {
                    until = until.min(since.0 + after.0);
                }
            }
        };
        self.waiting.iter().for_each(|it| due(it.when));
        for (it, until) in self.robot.failures.iter().zip(&self.until).filter(|it| !it.0.over) {
            until.iter().copied().for_each(&mut due);
            it.changes()
                .into_iter()
                .flatten()
                .filter(|at| *at >= now)
                .for_each(|at| due(When::At(at)));
        }
        if let Some(border) = self.next_border(robot.x()) {
            due(When::Place(border));
        }
        most = most.min(self.robot.periods_unseen(&self.watch_of()));
        if let Objective::Drives(it) = objective {
            let end = self.mission.objectives[it].x_end;
            most = most.min(robot.times_before(end, PERIOD).unwrap_or(0));
            most = most.min(self.periods_within_limits());
        }
        Some(most.min(until.saturating_sub(now.0).div_ceil(PERIOD.0)))
    }

    /// Returns the start of the objective's next activity.
    fn next_border(&self, x: Millimetres) -> Option<Millimetres> {
        let scenario = self.mission.scenario();
        let at = self.activity_at(x);
        let next = scenario.activities.get(at + 1)?;
        (next.objective == scenario.activities.get(at)?.objective).then_some(next.x_start)
    }

    fn activity_at(&self, x: Millimetres) -> usize {
        match self.objective() {
            Objective::Drives(it) | Objective::Stands(it) => self.planning.activity(it, x.0),
            _ => 0,
        }
    }

    /// In how many periods no margin falls below zero, whatever the way: what is left to do gets
    /// less, so the margins fall no faster than time and energy are used.
    fn periods_within_limits(&self) -> u64 {
        let at = self.progress();
        let (rest, limits) = (self.planning.rest(at), self.mission.scenario().limits);
        let left = |axis: usize| limits[axis].saturating_sub(at.used[axis] + rest[axis]);
        let configuration = self.decider.situation().configuration();
        let (_, power) = self.planning.pace(self.activity(), configuration);
        let energy = left(1).saturating_mul(1_000) / (power.0 * PERIOD.0).max(1);
        // One less, as energy is counted in whole mJ.
        (left(0) / PERIOD.0).min(energy).saturating_sub(1)
    }

    /// Lets the exposures to missing modules grow.
    fn grow_exposures(&mut self, time: Millis) {
        if !self.robot.moves() {
            return;
        }
        let configuration = self.decider.situation().configuration();
        let required = configuration.map_or(Modules::NONE, |it: Configuration| it.facts().required);
        if self.robot.broken().available().covers(required) {
            return;
        }
        self.exposed.0 += time.0;
        self.run.exposed = self.run.exposed.max(self.exposed);
        for (it, conduct) in self.robot.failures.iter().zip(&mut self.run.conduct) {
            if !it.over && !it.mode.health(it.part).available().covers(required) {
                conduct.exposed.0 += time.0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Planner;
    use crate::supervised::{Injection, Script};
    use cotama_models::cotama::{FailureMode, Module, delivery, global};
    use cotama_models::missions::{Mission, embedded};

    /// Whatever failed first, and with a motor that runs away after the end.
    #[test]
    fn a_robot_that_rests_would_not_have_moved() {
        let delivery = embedded::mission("delivery").unwrap();
        let mission = Mission::parse(delivery.name, delivery.text).unwrap();
        let mut rested = 0;
        for &mode in FailureMode::ALL {
            for (part, until, later) in [
                (Module::Smz, None, 900_000),
                (Module::Sch, Some(When::At(Millis(60_000))), 60_000),
                (Module::Sch, Some(When::During(local::State::Following, Millis(50_000))), 400_000),
            ] {
                let first = Injection::new(When::Place(Millimetres(5_000)), mode);
                let runaway = Injection::new(When::At(Millis(later)), FailureMode::Mot4);
                let injections = vec![Injection { part, until, ..first }, runaway];
                let script = Script { injections, ..Script::default() };
                let program = delivery::Program;
                let mut world =
                    World::start(&mission, global::NET, program, &script, Planner::of(&mission))
                        .unwrap();
                while !world.period() {
                    world.pass_over();
                }
                let mut each = world.clone();
                let until = Millis(world.now.0 + 60_000);
                while each.now < until {
                    each.period();
                    rested += usize::from(each.rests(until));
                }
                let moved = Millimetres(each.robot.x().0 - world.robot.x().0);
                let expected = (moved, each.run.moved_when_safe);
                assert_eq!(world.way_in(Millis(60_000)), expected, "{}", mode.name());
            }
        }
        assert!(rested > 10_000, "{rested}");
    }
}
