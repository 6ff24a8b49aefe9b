//! The robot with its failures: how they change its motion, and its modules at work.

use super::drive::Drive;
use super::effect::{Ends, FIRMWARE_WATCHDOG, Motion, effect, observable};
use super::laptop::{Disturbances, Laptop, Seen, jobs};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::cotama::{
    Configuration, FailureMode, Health, Module, Modules, Situation, load, local,
};

/// In the third round after something was told, everybody has had his turn.
const ANSWERED: u32 = 3;

/// A failure under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure {
    pub(crate) mode: FailureMode,
    pub(crate) part: Modules,
    pub(crate) since: Millis,
    /// For how long its observer has been able to see it.
    pub(crate) seen: Millis,
    /// For how long an observer at work should have been.
    pub(crate) shown: Millis,
    /// Whether the decisional level was told of it.
    pub(crate) found: bool,
    pub(crate) over: bool,
    /// Whether its flags have gone back.
    pub(crate) lowered: bool,
}

impl Failure {
    /// Returns its effect on motion; without the scheduler nothing is commanded.
    pub(crate) fn motion(&self) -> Motion {
        let scheduler = self.mode == FailureMode::Sw1 && self.part.has(Module::Sch);
        if scheduler && !self.over { Motion::Mindless } else { effect(self.mode).motion }
    }

    /// When it changes by itself: it ends, or the micro-controller hears nothing for too long.
    pub(crate) fn changes(&self) -> [Option<Millis>; 2] {
        let ends = match effect(self.mode).ends {
            Ends::After(time) => Some(Millis(self.since.0 + time.0)),
            Ends::Never | Ends::Helped => None,
        };
        let silent = matches!(effect(self.mode).motion, Motion::Silent);
        [ends, silent.then_some(Millis(self.since.0 + FIRMWARE_WATCHDOG.0))]
    }
}

/// The demand of the decisional level on the motors in a period.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Demand {
    /// Speed commanded; zero where nothing may move.
    pub(crate) speed: MillimetresPerSecond,
    /// The same before adapted settings take of it: a slowed robot goes at a part of this.
    pub(crate) free: MillimetresPerSecond,
    /// Largest speed of the robot: that of a motor that runs away.
    pub(crate) most: MillimetresPerSecond,
    /// Whether motor power is cut for good.
    pub(crate) halt: bool,
    /// The end of the drive.
    pub(crate) end: Millimetres,
    pub(crate) situation: Situation,
}

/// A robot: its motion, its energy, its failures, its laptop.
#[derive(Clone, Debug)]
pub(crate) struct Robot {
    pub(crate) drive: Drive,
    /// In the order of their happening; none is dropped.
    pub(crate) failures: Vec<Failure>,
    /// The longest time that an observer at work left a failure unseen beyond its latency.
    pub(crate) unseen: Millis,
    /// Energy used, in µJ.
    pub(crate) energy_uj: u64,
    pub(super) laptop: Laptop,
    /// Rounds since a report was told.
    pub(super) quiet: u32,
    /// The broken parts, and the modules that work in spite of it.
    pub(super) works: (Health, Modules),
    /// The oldest pose of localisation that it moved by.
    pub(crate) oldest_pose: Millis,
}

impl Robot {
    pub(crate) fn new() -> Self {
        Self {
            drive: Drive::default(),
            failures: Vec::new(),
            unseen: Millis(0),
            energy_uj: 0,
            laptop: Laptop::new(),
            quiet: 0,
            works: (Health::SOUND, Modules::ALL),
            oldest_pose: Millis(0),
        }
    }

    pub(crate) const fn x(&self) -> Millimetres {
        self.drive.x()
    }

    pub(crate) const fn moves(&self) -> bool {
        self.drive.speed().0 > 0
    }

    /// Something fails.
    pub(crate) fn fail(&mut self, now: Millis, mode: FailureMode, part: Module) {
        self.failures.push(Failure {
            mode,
            part: Modules::of(&[part]),
            since: now,
            seen: Millis(0),
            shown: Millis(0),
            found: false,
            over: false,
            lowered: false,
        });
    }

    /// Ends the failures that end by themselves by now, and those (by their number) for which
    /// `ended` says so.
    pub(crate) fn end_failures(&mut self, now: Millis, ended: impl Fn(usize) -> bool) {
        for (number, it) in self.failures.iter_mut().enumerate() {
            let past = |time: Millis| now.0 >= it.since.0 + time.0;
            let by_itself = matches!(effect(it.mode).ends, Ends::After(time) if past(time));
            // A laptop that comes back has no mission any more.
            let returns = effect(it.mode).motion != Motion::Mindless;
            it.over |= returns && (by_itself || ended(number));
        }
    }

    /// The operator has led the robot past what was in its way, or given another path.
    pub(crate) fn is_helped(&mut self) {
        for it in &mut self.failures {
            it.over |= effect(it.mode).ends == Ends::Helped;
        }
    }

    /// Whether the laptop is up, and its scheduler.
    pub(crate) fn thinks(&self) -> bool {
        !self.failures.iter().any(|it| it.motion() == Motion::Mindless)
    }

    /// Whether the laptop has been down for so long that the micro-controller stops the motors.
    pub(crate) fn is_abandoned(&self, now: Millis) -> bool {
        let long_since = |it: &Failure| {
            it.motion() == Motion::Mindless && now.0 >= it.since.0 + FIRMWARE_WATCHDOG.0
        };
        self.failures.iter().any(long_since)
    }

    /// Returns the broken parts, known or not.
    pub(crate) fn broken(&self) -> Health {
        let broken = self.failures.iter().filter(|it| !it.over).map(|it| it.mode.health(it.part));
        broken.fold(Health::SOUND, Health::union)
    }

    /// The speed towards which the motors go and the place where they stop, as failures leave them
    /// of what is demanded.
    pub(crate) fn answer(
        &mut self,
        now: Millis,
        demand: &Demand,
    ) -> (MillimetresPerSecond, Millimetres) {
        let mut towards = demand.speed;
        let mut blocked = false;
        for failure in self.failures.iter().filter(|it| !it.over) {
            match failure.motion() {
                Motion::Blocked => blocked |= observable(failure.mode, demand.situation, true),
                // A slowed robot is asked for more, or already for less.
                Motion::Slowed(parts) => {
                    let slowed = demand.free.0 * u64::from(parts) / 1000;
                    towards = towards.min(MillimetresPerSecond(slowed));
                }
                Motion::Runaway if !demand.halt => towards = demand.most,
                Motion::Silent | Motion::Mindless
                    if now.0 >= failure.since.0 + FIRMWARE_WATCHDOG.0 =>
                {
                    towards = MillimetresPerSecond(0);
                }
                Motion::Free | Motion::Runaway | Motion::Silent | Motion::Mindless => {}
                Motion::Dead => {
                    self.drive.stand();
                    towards = MillimetresPerSecond(0);
                }
            }
        }
        let led = demand.situation.local == local::State::Teleoperated;
        let end = if blocked && !led { self.x() } else { demand.end };
        (towards, end)
    }

    /// Draws a power for a time.
    pub(crate) fn draw(&mut self, power: Milliwatts, time: Millis) {
        self.energy_uj = self.energy_uj.saturating_add(power.0.saturating_mul(time.0));
    }

    /// The modules that were asked for compute for a period, disturbed by failures; and whether
    /// each further period is as this one.
    pub(crate) fn compute(
        &mut self,
        now: Millis,
        situation: Situation,
        available: Modules,
    ) -> (Seen, bool) {
        let runs = situation.configuration().unwrap_or(Configuration::Security);
        let wanted = runs.scheduled().common(available);
        self.laptop.run(wanted, load::PARTICLES[usize::from(situation.level.min(2))]);
        let mut disturbed = Disturbances::default();
        for it in self.failures.iter().filter(|it| !it.over) {
            match it.mode {
                FailureMode::Rt1 => disturbed.programs += 1,
                FailureMode::Rt2 => disturbed.hiccup |= it.since == now,
                FailureMode::Rt3 => disturbed.slow = disturbed.slow.union(jobs(it.part)),
                FailureMode::Sw1 => disturbed.crashed = disturbed.crashed.union(jobs(it.part)),
                _ => {}
            }
        }
        let seen = self.laptop.work(disturbed);
        let used = runs.facts().required.has(Module::Mcl) && self.moves();
        if let (true, Some(age)) = (used, self.laptop.age(Module::Mcl)) {
            self.oldest_pose = self.oldest_pose.max(age);
        }
        (seen, self.laptop.is_steady(disturbed) && !disturbed.hiccup)
    }

    /// A round was taken; `listens` says that no report waits. Told in one round, decided in the
    /// next, answered in the one after: then modules in fault go on.
    pub(crate) fn took_a_round(&mut self, listens: bool) {
        self.quiet = if listens { self.quiet.saturating_add(1) } else { 0 };
        if self.quiet >= ANSWERED {
            self.laptop.answered();
        }
    }

    /// So many rounds were taken in which nothing happened.
    pub(crate) fn took_quiet_rounds(&mut self, rounds: u64) {
        self.quiet = self.quiet.saturating_add(u32::try_from(rounds).unwrap_or(u32::MAX));
    }
}
