//! A robot that COTAMA's decisional component drives through one task at a time.
//!
//! A task is a mission of the shipped supervisors: drive, receive, drive, deliver. Rounds lie on a
//! grid of [`PERIOD`], as on the robot, but only those are taken in which something can happen: a
//! level that was told all and has come to rest stays as it is until its surroundings change. So
//! forty robots take some thousand rounds and not some hundred thousand; a test takes them all, and
//! comes to the same.

use super::task::Stage;
use crate::supervised::{Ends, Motion, PERIOD, PLANNING, effect, observable, raises};
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, Configuration, DecisionalLevel, DeliveryDecider, FailureMode, Flags, Health, Module,
    Modules, NoPlans, Perceived, Word, local,
};

/// After so many rounds without any change a level is at rest: a report takes three.
const REST: u32 = 6;
/// The objectives of the mission.
const OBJECTIVES: u32 = 4;

/// A failure under way.
#[derive(Clone, Copy, Debug)]
struct Failure {
    mode: FailureMode,
    part: Modules,
    since: u64,
    /// For how long its observer has been able to see it, in ms.
    seen: u64,
    found: bool,
    over: bool,
    lowered: bool,
}

/// What a round came to.
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
    failures: Vec<Failure>,
    /// What is broken, and what works in spite of it.
    works: (Health, Modules),
    now: u64,
    /// A task is to be begun.
    wanted: bool,
    /// The length of both drives, in µm, and how far the one under way has come.
    legs_um: [u64; 2],
    x_um: u64,
    speed_mm_s: u64,
    quiet: u32,
    /// Every round is taken: for the test that the others change nothing.
    every_round: bool,
}

impl Driver {
    pub(super) fn new(every_round: bool) -> Self {
        Self {
            decider: fresh(Health::SOUND),
            failures: Vec::new(),
            works: (Health::SOUND, Health::SOUND.relied_on()),
            now: 0,
            wanted: false,
            legs_um: [0; 2],
            x_um: 0,
            speed_mm_s: 0,
            quiet: REST,
            every_round,
        }
    }

    /// A task begins: two drives of these lengths.
    pub(super) fn begin(&mut self, now: u64, legs_mm: [u64; 2]) {
        self.forget(now);
        (self.wanted, self.legs_um) = (true, legs_mm.map(|it| it * 1_000));
    }

    /// The task is over or was given up: the robot stands. What is broken stays known.
    pub(super) fn forget(&mut self, now: u64) {
        self.go(now);
        if !matches!(self.stage(), Stage::Stops | Stage::Safe) {
            self.decider = fresh(self.decider.health());
            for it in self.failures.iter_mut().filter(|it| !it.over) {
                (it.found, it.seen) = (false, 0);
            }
        }
        (self.wanted, self.speed_mm_s, self.x_um, self.quiet) = (false, 0, 0, 0);
    }

    /// Something fails.
    pub(super) fn fail(&mut self, now: u64, mode: FailureMode) {
        self.go(now);
        let part = Modules::of(&[Module::Smz]);
        let (seen, found, over, lowered) = (0, false, false, false);
        self.failures.push(Failure { mode, part, since: now, seen, found, over, lowered });
        self.quiet = 0;
        self.speed_mm_s = if self.thinks() { self.speed_mm_s } else { 0 };
    }

    /// Something outside has changed: the next rounds count.
    pub(super) fn stir(&mut self) {
        self.quiet = 0;
    }

    /// Whether its laptop is up.
    pub(super) fn thinks(&self) -> bool {
        !self.failures.iter().any(|it| !it.over && effect(it.mode).motion == Motion::Mindless)
    }

    /// Where the mission is.
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

    /// How far the drive under way has come by now, in mm.
    pub(super) fn driven_mm(&self, now: u64) -> u64 {
        self.x_at(now) / 1_000
    }

    /// What is left of the drive under way, in mm.
    pub(super) fn left_mm(&self, now: u64) -> u64 {
        self.leg().saturating_sub(self.x_at(now)).div_ceil(1_000)
    }

    fn x_at(&self, now: u64) -> u64 {
        let way = self.speed_mm_s.saturating_mul(now.saturating_sub(self.now));
        self.x_um.saturating_add(way).min(self.leg().max(self.x_um))
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

    fn leg(&self) -> u64 {
        self.legs_um[usize::from(self.decider.global().0 >= 3)]
    }

    /// The robot goes on until now.
    fn go(&mut self, now: u64) {
        self.x_um = self.x_at(now);
        self.now = now;
    }

    /// A round. `done` says that what is taken or given at this place is taken or given.
    pub(super) fn round(&mut self, now: u64, done: bool) -> Driven {
        self.go(now);
        let mut driven = Driven { found: None, configuration: None };
        if !self.thinks() {
            self.speed_mm_s = 0;
            return driven;
        }
        let before = (self.decider.situation(), self.decider.global(), self.decider.requests());
        driven.found = self.observe(now);
        let said = if self.decider.listens() { self.says(now, done) } else { None };
        let body = Body { at_goal: self.x_um >= self.leg(), stands: self.speed_mm_s == 0 };
        let round = self.decider.round(Millis(now), said, body, &mut ());
        let after = (self.decider.situation(), self.decider.global(), self.decider.requests());
        if after.1 != before.1 && matches!(after.1.0, 1 | 3) {
            self.x_um = 0;
        }
        let quiet = round.told.is_none() && self.decider.listens() && before == after;
        self.quiet = if quiet { self.quiet + 1 } else { 0 };
        if after.2.configuration != before.2.configuration {
            driven.configuration = after.2.configuration;
        }
        self.speed_mm_s = self.speed();
        driven
    }

    /// When the next round counts; none while nothing happens by itself.
    pub(super) fn next_round(&self) -> Option<u64> {
        if !self.thinks() {
            return None;
        }
        let soon = (self.now + 1).next_multiple_of(PERIOD.0);
        let requests = self.decider.requests();
        // Patience ends by itself, and so does what adapters have changed.
        let timed = requests.ask || requests.adjusted.speed < 1_000;
        let waits = self.failures.iter().any(|it| self.waits(it));
        if self.quiet < REST || self.every_round || timed || waits {
            return Some(soon);
        }
        let ends = |it: &Failure| match effect(it.mode).ends {
            Ends::After(time) if !it.over => Some(it.since + time.0),
            _ => None,
        };
        let ends = self.failures.iter().filter_map(ends);
        let local = self.decider.situation().local;
        let planned =
            (local == local::State::Planning).then(|| self.decider.since().0 + PLANNING.0);
        let arrives = (self.speed_mm_s > 0)
            .then(|| self.now + (self.leg() - self.x_um).div_ceil(self.speed_mm_s));
        let next = ends.chain(planned).chain(arrives).min()?;
        Some(next.max(soon).next_multiple_of(PERIOD.0))
    }

    /// Whether a failure is about to be found.
    fn waits(&self, failure: &Failure) -> bool {
        let moving = self.speed_mm_s > 0;
        let seen = observable(failure.mode, self.decider.situation(), moving);
        !failure.over && !failure.found && seen && !raises(failure.mode, Modules::ALL).is_empty()
    }

    /// Observers raise and lower their flags.
    fn observe(&mut self, now: u64) -> Option<FailureMode> {
        let (moving, situation) = (self.speed_mm_s > 0, self.decider.situation());
        let (mut raised, mut lowered, mut held) = (Flags::NONE, Flags::NONE, Flags::NONE);
        let (mut found, mut part, mut broken) = (None, Modules::NONE, Health::SOUND);
        for it in &mut self.failures {
            let flags = it.mode.rule().signature.always;
            if let Ends::After(time) = effect(it.mode).ends {
                it.over |= now >= it.since + time.0;
            }
            if it.over {
                if it.found && !it.lowered {
                    (it.lowered, lowered) = (true, lowered.union(flags));
                }
                continue;
            }
            broken = broken.union(it.mode.health(it.part));
            if it.found {
                held = held.union(flags);
            } else if observable(it.mode, situation, moving) {
                it.seen += PERIOD.0;
                if it.seen >= u64::from(it.mode.rule().latency_ms) {
                    (it.found, found, part) = (true, Some(it.mode), it.part);
                    raised = raised.union(raises(it.mode, self.decider.observing()));
                }
            }
        }
        if self.works.0 != broken {
            self.works = (broken, broken.relied_on());
        }
        let (lowered, works) = (lowered.without(held), self.works.1);
        let perceived = Perceived { raised, lowered, part, works };
        let _ = self.decider.perceive(Millis(now), perceived, &mut NoPlans);
        found
    }

    /// What the mission and the planner of paths have to say.
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

    /// How fast it goes: as its decisional component allows, and as failures let it.
    fn speed(&self) -> u64 {
        let requests = self.decider.requests();
        if !requests.drive || self.x_um >= self.leg() {
            return 0;
        }
        let mut speed = requests.speed.0 * u64::from(requests.adjusted.speed) / 1_000;
        for it in self.failures.iter().filter(|it| !it.over) {
            speed = match effect(it.mode).motion {
                Motion::Free | Motion::Runaway => speed,
                Motion::Slowed(parts) => speed.min(requests.speed.0 * u64::from(parts) / 1_000),
                Motion::Blocked | Motion::Dead | Motion::Silent | Motion::Mindless => 0,
            };
        }
        speed
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
            slowed.extend((driver.speed_mm_s == 210).then_some(now));
        }
        let ends = (slowed.first().copied(), slowed.last().copied());
        assert_eq!(ends, (Some(22_100), Some(40_800)));
        assert_eq!(slowed.len() as u64, (40_800 - 22_100) / 100 + 1);
    }
}
