//! A robot that COTAMA's decisional component drives through one task at a time.
//!
//! A task is a mission of the shipped supervisors: drive, receive, drive, deliver. The robot is
//! that
//! of a [mission](crate::body): it accelerates, draws energy, computes and fails alike. Rounds lie
//! on a grid of [`PERIOD`], but only those are taken in which something can happen: a level that
//! was told all and has come to rest stays as it is until its surroundings change. So forty robots
//! take some thousand rounds and not some hundred thousand; a test takes them all, and comes to the
//! same.

use crate::body::{Chassis, DELIVERY, Demand, Failure, PERIOD, PLANNING, Robot, Watch};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::cotama::{
    Body, Configuration, DecisionalLevel, DeliveryDecider, FailureMode, Health, Module, NoPlans,
    Word, local,
};
use cotama_models::team::scenario::Stage;

/// After so many rounds without any change a level is at rest: a report takes three.
const REST: u32 = 6;
/// The objectives of the mission.
const OBJECTIVES: u32 = 4;
/// A robot whose role is over stands within so many periods, or runs away.
const MOST_COASTED: u64 = 600;

/// The outcome of a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Driven {
    /// The failure that was found.
    pub(super) found: Option<FailureMode>,
    /// The configuration, if it is another one.
    pub(super) configuration: Option<Configuration>,
}

/// The robot under its decisional component.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    decider: DeliveryDecider,
    robot: Robot,
    chassis: &'static Chassis,
    /// The robot has gone on until then: a multiple of the period.
    now: u64,
    /// A task is to be begun.
    wanted: bool,
    /// The length of both drives.
    legs: [Millimetres; 2],
    /// The robot goes on evenly, and its modules compute in time.
    steady: bool,
    quiet: u32,
    /// Every round is taken: for the test that the others change nothing.
    every_round: bool,
}

impl Driver {
    pub(super) fn new(every_round: bool) -> Self {
        Self {
            decider: fresh(Health::SOUND),
            robot: Robot::new(),
            chassis: &DELIVERY,
            now: 0,
            wanted: false,
            legs: [Millimetres(0); 2],
            steady: true,
            quiet: REST,
            every_round,
        }
    }

    /// A task begins: two drives of these lengths.
    pub(super) fn begin(&mut self, now: u64, legs_mm: [u64; 2]) {
        self.forget(now);
        (self.wanted, self.legs) = (true, legs_mm.map(Millimetres));
    }

    /// The task is over or was given up: the robot stands where it [comes to
    /// stand](Self::stand_mm). What is broken stays known.
    pub(super) fn forget(&mut self, now: u64) {
        self.go(now);
        self.drop_role();
        self.robot.drive.restart();
        self.robot.drive.stand();
        (self.wanted, self.quiet) = (false, 0);
    }

    fn drop_role(&mut self) {
        if !matches!(self.stage(), Stage::Stops | Stage::Safe) {
            self.decider = fresh(self.decider.health());
            self.robot.are_new_again();
        }
    }

    /// How far the drive under way will have come, in mm, when the robot stands whose role is over
    /// now: it brakes, and without a laptop the micro-controller stops it later.
    pub(super) fn stand_mm(&self, now: u64) -> u64 {
        let (mut ahead, leg) = (self.clone(), self.leg());
        ahead.go(now);
        if ahead.thinks() {
            ahead.drop_role();
        }
        for _ in 0..MOST_COASTED {
            if !ahead.robot.moves() || ahead.robot.x() >= leg {
                break;
            }
            ahead.go(ahead.now + PERIOD.0);
        }
        ahead.robot.x().min(leg).0
    }

    /// Something fails.
    pub(super) fn fail(&mut self, now: u64, mode: FailureMode) {
        self.go(now);
        self.robot.fail(Millis(now), mode, Module::Smz);
        (self.quiet, self.steady) = (0, false);
    }

    /// Something outside has changed: the next rounds count.
    pub(super) fn stir(&mut self) {
        self.quiet = 0;
    }

    /// Whether its laptop is up.
    pub(super) fn thinks(&self) -> bool {
        self.robot.thinks()
    }

    /// Energy used so far, in mJ.
    pub(super) fn energy_mj(&self, now: u64) -> u64 {
        self.at(now).energy_uj / 1_000
    }

    /// Returns the stage of the mission.
    pub(super) fn stage(&self) -> Stage {
        match self.decider.global().0 {
            0 if self.wanted => Stage::ToTake,
            0 => Stage::Rests,
            1 => Stage::ToTake,
            2 => Stage::Takes,
            3 => Stage::ToGive,
            4 => Stage::Gives,
            5 => Stage::Done,
            6 => Stage::Stops,
            _ => Stage::Safe,
        }
    }

    /// How far the drive under way had come at the end of the last period, in mm.
    pub(super) fn driven_mm(&self, now: u64) -> u64 {
        self.at(now).x().min(self.leg()).0
    }

    /// Returns the rest of the drive under way, in mm.
    pub(super) fn left_mm(&self, now: u64) -> u64 {
        self.leg().0.saturating_sub(self.driven_mm(now))
    }

    /// The robot at the end of the last period.
    fn at(&self, now: u64) -> Robot {
        let mut there = self.clone();
        there.go(now);
        there.robot
    }

    /// How fast it could drive with what works, in mm/s; none where it cannot.
    pub(super) fn pace(&self) -> Option<u64> {
        use Configuration as C;
        let drives = [C::FollowingOptimal, C::FollowingDvz, C::FollowingOdometric];
        let drives = drives.into_iter().chain([C::FollowingDegraded]);
        let works = self.decider.relied_on();
        let able = self.stage() != Stage::Safe && self.stage() != Stage::Stops;
        let mut able = drives.filter(|it| able && it.runs_on(works));
        able.next().map(|it| it.facts().speed.0)
    }

    fn leg(&self) -> Millimetres {
        self.legs[usize::from(self.decider.global().0 >= 3)]
    }

    /// Whether the present objective is a drive.
    fn is_driving(&self) -> bool {
        matches!(self.decider.global().0, 1 | 3)
    }

    /// The demand of the decisional level until the next round.
    fn demand(&self) -> Demand {
        let requests = self.decider.requests();
        let free = requests.configuration.map_or(MillimetresPerSecond(0), |it| it.facts().speed);
        let adjusted = requests.speed.0 * u64::from(requests.adjusted.speed) / 1_000;
        let (x, braking) = (self.robot.x().0, self.robot.drive.braking_distance().0);
        Demand {
            speed: MillimetresPerSecond(if requests.drive { adjusted } else { 0 }),
            free,
            most: self.chassis.speed_max,
            halt: requests.halt,
            end: if self.is_driving() { self.leg() } else { Millimetres(x + braking + 1) },
            situation: self.decider.situation(),
        }
    }

    /// The robot goes on, period by period, until now.
    fn go(&mut self, now: u64) {
        while self.now + PERIOD.0 <= now {
            let (before, demand) = (self.robot.drive, self.demand());
            self.robot.end_failures(Millis(self.now), |_| false);
            let (towards, end) = self.robot.answer(Millis(self.now), &demand);
            self.robot.drive.go(towards, end, PERIOD);
            self.now += PERIOD.0;
            let configuration = demand.situation.configuration();
            let power = self.chassis.power(configuration, self.robot.drive.speed());
            self.robot.draw(power, PERIOD);
            if !self.robot.drive.is_steady_since(&before, PERIOD) {
                self.steady = false;
                continue;
            }
            let left = (now - self.now) / PERIOD.0;
            let even = self.robot.drive.times_before(end, PERIOD).unwrap_or(0);
            let even = if self.robot.moves() { even } else { u64::MAX };
            let times = left.min(even).min(self.periods_unchanged());
            self.robot.drive.glide(times, PERIOD);
            self.robot.draw(power, Millis(times * PERIOD.0));
            self.now += times * PERIOD.0;
        }
    }

    /// In how many periods no failure changes by itself.
    fn periods_unchanged(&self) -> u64 {
        let changes = self.robot.failures.iter().filter(|it| !it.over).flat_map(Failure::changes);
        let later = changes.flatten().filter(|it| it.0 > self.now);
        later.map(|it| (it.0 - self.now).div_ceil(PERIOD.0)).min().map_or(u64::MAX, |it| it - 1)
    }

    fn watch(&self) -> Watch<'static> {
        let (situation, observing) = (self.decider.situation(), self.decider.observing());
        Watch { situation, observing, planted: &[] }
    }

    /// A round. `done` says that what is taken or given at this place is taken or given.
    pub(super) fn round(&mut self, now: u64, done: bool) -> Driven {
        let (before, last) = (self.robot.drive.speed(), self.now);
        self.steady = true;
        self.go(now);
        self.robot.end_failures(Millis(now), |_| false);
        let changes = self.robot.failures.iter().flat_map(Failure::changes).flatten();
        let changed = { changes }.any(|it| last < it.0 && it.0 <= now);
        self.steady &= self.robot.drive.speed() == before && !changed;
        if now > last + PERIOD.0 {
            let body = Body { at_goal: false, stands: !self.robot.moves() };
            self.decider.idle(Millis(now - PERIOD.0), body);
        }
        let mut driven = Driven { found: None, configuration: None };
        if !self.thinks() {
            return driven;
        }
        let before = (self.decider.situation(), self.decider.global(), self.decider.requests());
        let available = self.decider.available();
        let (scheduler, computes) = self.robot.compute(Millis(now), before.0, available);
        self.steady &= computes;
        let observed = self.robot.observe(scheduler, &self.watch());
        let finding = self.decider.perceive(Millis(now), observed.perceived, &mut NoPlans);
        if finding.is_some() {
            self.robot.are_found(&observed.seen);
            driven.found = observed.seen.first().map(|it| self.robot.failures[*it].mode);
        }
        let said = if self.decider.listens() { self.says(now, done) } else { None };
        let at_goal = self.robot.x() >= self.leg();
        let body = Body { at_goal, stands: !self.robot.moves() };
        let round = self.decider.round(Millis(now), said, body, &mut ());
        self.robot.took_a_round(self.decider.listens());
        let after = (self.decider.situation(), self.decider.global(), self.decider.requests());
        if after.1 != before.1 && self.is_driving() {
            self.robot.drive.restart();
        }
        let quiet =
            round.told.is_none() && finding.is_none() && self.decider.listens() && before == after;
        self.quiet = if quiet { self.quiet + 1 } else { 0 };
        if after.2.configuration != before.2.configuration {
            driven.configuration = after.2.configuration;
        }
        driven
    }

    /// When the next round counts; none while nothing happens by itself.
    pub(super) fn next_round(&self) -> Option<u64> {
        if !self.thinks() {
            return None;
        }
        let soon = (self.now + 1).next_multiple_of(PERIOD.0);
        let sees = self.robot.periods_unseen(&self.watch()) < u64::MAX;
        let ended = matches!(self.stage(), Stage::Done | Stage::Stops | Stage::Safe);
        // Patience ends by itself, and so does what adapters have changed.
        let idle = if ended { Some(Millis(u64::MAX)) } else { self.decider.idle_until() };
        let Some(idle) = idle.filter(|_| self.quiet >= REST && !self.every_round) else {
            return Some(soon);
        };
        if sees || !self.steady {
            return Some(soon);
        }
        let under_way = self.robot.failures.iter().filter(|it| !it.over);
        let changes = under_way.flat_map(Failure::changes).flatten().map(|it| it.0);
        let changes = changes.filter(|it| *it > self.now);
        let local = self.decider.situation().local;
        let planned =
            (local == local::State::Planning).then(|| self.decider.since().0 + PLANNING.0);
        let arrives = self.robot.moves().then(|| {
            let times = self.robot.drive.times_before(self.leg(), PERIOD).unwrap_or(0);
            self.now + times.saturating_add(1) * PERIOD.0
        });
        let patience = (idle.0 < u64::MAX).then_some(idle.0);
        let next = changes.chain(planned).chain(arrives).chain(patience).min()?;
        Some(next.max(soon).next_multiple_of(PERIOD.0))
    }

    /// Returns the word of the mission and the planner of paths.
    fn says(&mut self, now: u64, done: bool) -> Option<Word> {
        match self.decider.global().0 {
            0 if self.wanted => Some(Word::MissionReceived),
            2 if done => Some(Word::ObjectReceived),
            4 if done => Some(Word::ObjectDelivered),
            1 | 3 => {
                let planning = self.decider.situation().local == local::State::Planning;
                let waited = now.saturating_sub(self.decider.since().0);
                (planning && waited >= PLANNING.0).then_some(Word::PathReady)
            }
            _ => None,
        }
    }
}

/// The supervisors before a mission, with what is known to be broken.
fn fresh(known: Health) -> DeliveryDecider {
    DeliveryDecider::resume(DecisionalLevel::default(), OBJECTIVES, known)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When the stages of a task begin, with a failure at 20 s; and how it ends.
    fn course(mode: Option<FailureMode>, every_round: bool) -> Vec<(u64, Stage)> {
        let mut driver = Driver::new(every_round);
        driver.begin(0, [6_000, 9_000]);
        let (mut stages, mut now, mut since) = (vec![(0, driver.stage())], 0, 0);
        let mut failure = mode;
        while now < 400_000 {
            if now >= 20_000
                && let Some(mode) = failure.take()
            {
                driver.fail(now, mode);
            }
            let takes = matches!(driver.stage(), Stage::Takes | Stage::Gives);
            driver.round(now, takes && now >= since + 5_000);
            if driver.stage() != stages[stages.len() - 1].1 {
                (stages, since) = ([stages, vec![(now, driver.stage())]].concat(), now);
            }
            if matches!(driver.stage(), Stage::Done | Stage::Safe) {
                break;
            }
            let hands = matches!(driver.stage(), Stage::Takes | Stage::Gives);
            let hands = hands.then_some((since + 5_000).max(now + PERIOD.0));
            let fails = failure.map(|_| 20_000.max(now + PERIOD.0));
            let Some(next) = driver.next_round().into_iter().chain(hands).chain(fails).min() else {
                break;
            };
            now = next;
        }
        stages
    }

    #[test]
    fn rounds_that_are_left_out_change_nothing() {
        for mode in FailureMode::ALL.iter().map(|it| Some(*it)).chain([None]) {
            assert_eq!(course(mode, false), course(mode, true), "{mode:?}");
        }
    }

    #[test]
    fn a_task_takes_its_drives_its_planning_and_its_hands() {
        let stages = course(None, true);
        use Stage::{Done, Gives, Takes, ToGive, ToTake};
        assert_eq!(
            stages.iter().map(|it| it.1).collect::<Vec<_>>(),
            [ToTake, Takes, ToGive, Gives, Done]
        );
        // 2 s of planning, 20 s and 30 s of driving, 5 s each of taking and giving, some rounds.
        assert!((64_000..66_000).contains(&stages[4].0), "{stages:?}");
    }

    #[test]
    fn an_emergency_stop_ends_the_mission_and_lost_sonars_slow_it() {
        let last = |mode| *course(Some(mode), true).last().unwrap();
        assert_eq!(last(FailureMode::Est1).1, Stage::Safe);
        let (slow, stage) = last(FailureMode::Son1);
        assert!(stage == Stage::Done && slow > 80_000, "{slow}");
    }

    /// The link to the robot drops packets for ten seconds, twice and overlapping: it goes at seven
    /// tenths until five seconds after the last of them.
    #[test]
    fn a_flag_stays_up_while_another_failure_holds_it() {
        let mut driver = Driver::new(true);
        driver.begin(0, [60_000, 60_000]);
        let mut slowed = Vec::new();
        for now in (0..60_000).step_by(100) {
            if now == 20_000 || now == 26_000 {
                driver.fail(now, FailureMode::P3d2);
            }
            driver.round(now, false);
            let slow = now > 20_000 && driver.robot.drive.speed().0 < 300;
            slowed.extend(slow.then_some(now));
        }
        let ends = (slowed.first().copied(), slowed.last().copied());
        // In steps of 30 mm/s, down and up again.
        assert_eq!(ends, (Some(22_200), Some(41_100)));
        assert_eq!(slowed.len() as u64, (41_100 - 22_200) / 100 + 1);
    }

    /// Drives for 20 s at 300 mm/s, then loses its laptop or its role.
    fn stands_after(mode: Option<FailureMode>) -> u64 {
        let mut driver = Driver::new(true);
        driver.begin(0, [60_000, 60_000]);
        for now in (0..=20_000).step_by(100) {
            driver.round(now, false);
        }
        let before = driver.driven_mm(20_000);
        mode.into_iter().for_each(|it| driver.fail(20_000, it));
        driver.stand_mm(20_000) - before
    }

    #[test]
    fn a_robot_brakes_at_the_end_of_its_role_and_coasts_without_its_laptop() {
        assert_eq!(stands_after(None), 150);
        // Two seconds until the micro-controller stops the motors.
        assert_eq!(stands_after(Some(FailureMode::Pwr1)), 600 + 150);
        assert_eq!(stands_after(Some(FailureMode::Bat2)), 0);
    }

    #[test]
    fn a_motor_that_runs_away_is_cut_off_and_moved_meanwhile() {
        let mut driver = Driver::new(true);
        (0..=20_000).step_by(100).for_each(|now| {
            if now == 10_000 {
                driver.fail(now, FailureMode::Mot4);
            }
            driver.round(now, false);
        });
        assert_eq!(driver.stage(), Stage::Safe);
        let (x, speed) = (driver.robot.x(), driver.robot.drive.speed().0);
        assert!(x > Millimetres(0) && speed == 0, "{x:?} {speed}");
    }
}
