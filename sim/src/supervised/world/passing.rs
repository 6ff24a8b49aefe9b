//! Periods in which nothing happens, passed over at once.
//!
//! After a period in which nothing happened, and as long as nothing is due, each further one is as
//! that one was: the robot goes on evenly, and what is counted grows evenly. A run with a trace
//! takes each period by itself; both come to the same, which is a test.

use super::objective::Objective;
use super::{CLOCKS, Failure, PERIOD, World};
use crate::run::LONGEST;
use crate::supervised::effect::{Ends, FIRMWARE_WATCHDOG, Motion, effect};
use crate::supervised::{PLANNING, When};
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
        let before = self.robot;
        self.robot.glide(periods, PERIOD);
        let activity = self.activity_at(before.x());
        let (_, power) = self.planning.pace(activity, self.decider.situation().configuration());
        self.drive_well(activity, self.robot.x().0 - before.x().0);
        self.energy_uj += power.0 * time.0;
        self.grow_exposures(time);
        let (moving, situation) = (self.robot.speed().0 > 0, self.decider.situation());
        for number in 0..self.failures.len() {
            let it = self.failures[number];
            let is_open = !it.over && self.run.conduct[number].detected.is_none();
            if is_open && self.is_shown(&it, situation, moving) {
                self.show(number, time);
            }
            if is_open && self.is_observable(it.mode, situation, moving) {
                self.failures[number].seen.0 += time.0;
            }
        }
        self.run.rounds += periods;
        self.quiet = self.quiet.saturating_add(u32::try_from(periods).unwrap_or(u32::MAX));
        self.now.0 += time.0;
        let last = Millis(self.now.0 - PERIOD.0);
        self.decider.idle(last, Body { at_goal: false, stands: !moving });
    }

    /// Whether a robot whose mission is over stands, and nothing can change that: every further
    /// period is as the last one.
    pub(in crate::supervised) fn rests(&self) -> bool {
        let changes = |it: &Failure| {
            let later = changes(it).into_iter().flatten().any(|at| at >= self.now);
            !it.over && (it.until.is_some() || later)
        };
        self.calm
            && !self.mission.recovery
            && self.robot.speed().0 == 0
            && self.waiting.is_empty()
            && self.decider.listens()
            && !self.failures.iter().any(changes)
            && self.periods_unseen() == u64::MAX
    }

    /// How many periods nothing can happen in; none where something may at once.
    fn idle_periods(&self) -> Option<u64> {
        let objective = self.objective();
        let (now, robot) = (self.now, &self.robot);
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
            // Where the robot is when a period begins counts, so one more is before the place.
            When::Place(x) => {
                let times = robot.times_before(x, PERIOD).map_or(0, |it| it.saturating_add(1));
                most = most.min(times);
            }
            When::During(state, after) => {
                if let Some((_, since)) = self.first.iter().find(|it| it.0 == state) {
                    until = until.min(since.0 + after.0);
                }
            }
        };
        self.waiting.iter().for_each(|it| due(it.when));
        for it in self.failures.iter().filter(|it| !it.over) {
            it.until.into_iter().for_each(&mut due);
            changes(it)
                .into_iter()
                .flatten()
                .filter(|at| *at >= now)
                .for_each(|at| due(When::At(at)));
        }
        if let Some(border) = self.next_border(robot.x()) {
            due(When::Place(border));
        }
        most = most.min(self.periods_unseen());
        if let Objective::Drives(it) = objective {
            let end = self.mission.objectives[it].x_end;
            most = most.min(robot.times_before(end, PERIOD).unwrap_or(0));
            most = most.min(self.periods_within_limits());
        }
        Some(most.min(until.saturating_sub(now.0).div_ceil(PERIOD.0)))
    }

    /// Where the next activity of the objective begins.
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

    /// In how many periods no observer sees a failure that it does not see yet.
    fn periods_unseen(&self) -> u64 {
        let (moving, situation) = (self.robot.speed().0 > 0, self.decider.situation());
        let unseen = self.failures.iter().zip(&self.run.conduct).filter(|(it, conduct)| {
            !it.over && conduct.detected.is_none() && self.is_observable(it.mode, situation, moving)
        });
        let periods = unseen.filter_map(|(it, _)| {
            let left = self.latency_ms(it.mode).checked_sub(it.seen.0)?;
            // What was seen for long enough and raises nothing changes nothing.
            (left > 0).then(|| left.div_ceil(PERIOD.0) - 1)
        });
        periods.min().unwrap_or(u64::MAX)
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

    /// What is missed goes on to be missed.
    fn grow_exposures(&mut self, time: Millis) {
        if self.robot.speed().0 == 0 {
            return;
        }
        let configuration = self.decider.situation().configuration();
        let required = configuration.map_or(Modules::NONE, |it: Configuration| it.facts().required);
        if self.broken().available().covers(required) {
            return;
        }
        self.exposed.0 += time.0;
        self.run.exposed = self.run.exposed.max(self.exposed);
        for (it, conduct) in self.failures.iter().zip(&mut self.run.conduct) {
            if !it.over && !it.mode.health(it.part).available().covers(required) {
                conduct.exposed.0 += time.0;
            }
        }
    }
}

/// When a failure changes by itself: it ends, or the micro-controller hears nothing for too long.
fn changes(it: &Failure) -> [Option<Millis>; 2] {
    let ends = match effect(it.mode).ends {
        Ends::After(time) => Some(Millis(it.since.0 + time.0)),
        Ends::Never | Ends::Helped => None,
    };
    let silent = matches!(effect(it.mode).motion, Motion::Silent);
    [ends, silent.then_some(Millis(it.since.0 + FIRMWARE_WATCHDOG.0))]
}
