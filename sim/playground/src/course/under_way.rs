//! Faults under way: what they do to motion and parts, and when their flags are up.

use super::PERIOD;
use super::world::{Row, World};
use alloc::vec::Vec;
use cotama_core::units::Millis;
use cotama_models::level::Failure;

/// After so long without a command the micro-controller stops the motors.
const WATCHDOG: u64 = 2_000;

const BLOCKED: u8 = 1;
const SLOWED: u8 = 2;
const RUNAWAY: u8 = 3;
const DEAD: u8 = 4;
const SILENT: u8 = 5;
const MINDLESS: u8 = 6;

/// A fault that has begun.
struct UnderWay<'c> {
    /// Position in the plan.
    fault: usize,
    row: &'c Row,
    flags: u64,
    number: usize,
    since: Millis,
    /// For how long observers could see it.
    seen: u64,
    found: bool,
    over: bool,
}

/// The faults that have begun, in the order of their beginnings.
pub(super) struct Failures<'c> {
    world: &'c World,
    rows: &'c [Failure],
    all: Vec<UnderWay<'c>>,
}

/// The demand on the motors beside a speed.
pub(super) struct Demand {
    pub(super) fastest: u64,
    pub(super) halted: bool,
    pub(super) led: bool,
}

impl<'c> Failures<'c> {
    pub(super) fn new(world: &'c World, rows: &'c [Failure]) -> Self {
        Self { world, rows, all: Vec::new() }
    }

    fn open(&self) -> impl Iterator<Item = &UnderWay<'c>> {
        self.all.iter().filter(|it| !it.over)
    }

    pub(super) fn begin(&mut self, fault: usize, number: usize, since: Millis) {
        let Some(row) = self.world.rows.get(number) else { return };
        let flags = self.rows.get(number).map_or(0, |it| it.flags);
        let (seen, found, over) = (0, false, false);
        self.all.push(UnderWay { fault, row, flags, number, since, seen, found, over });
    }

    /// Ends a fault of the plan; a computer that is down stays so.
    pub(super) fn end(&mut self, fault: usize) {
        let ended = self.all.iter_mut().filter(|it| it.fault == fault);
        ended.for_each(|it| it.over |= it.row.motion != MINDLESS);
    }

    /// Ends what is over by itself.
    pub(super) fn pass(&mut self, now: Millis) {
        for it in &mut self.all {
            let past = it.row.ends.is_some_and(|ends| now.0 >= it.since.0 + ends.0);
            it.over |= past && it.row.motion != MINDLESS;
        }
    }

    /// Returns each fault that has begun, and whether it is over.
    pub(super) fn overs(&self) -> impl Iterator<Item = (usize, bool)> {
        self.all.iter().map(|it| (it.fault, it.over))
    }

    pub(super) fn is_helped(&mut self) {
        self.all.iter_mut().for_each(|it| it.over |= it.row.helped);
    }

    /// A module was started anew: what that mends is over, the rest shows itself again.
    pub(super) fn restart(&mut self, module: usize) {
        for it in self.all.iter_mut().filter(|it| !it.over) {
            if let Some((_, mends)) = it.row.restarts.filter(|it| usize::from(it.0) == module) {
                it.over |= mends;
                (it.seen, it.found) = (0, false);
            }
        }
    }

    /// A setting answers faults of these rows.
    pub(super) fn set(&mut self, of: impl Fn(usize) -> bool, mends: bool) {
        for it in self.all.iter_mut().filter(|it| !it.over && of(it.number)) {
            it.over |= mends;
            if it.row.is_tried {
                (it.seen, it.found) = (0, false);
            }
        }
    }

    /// True if the computer is up.
    pub(super) fn thinks(&self) -> bool {
        self.open().all(|it| it.row.motion != MINDLESS)
    }

    /// True if it has been down until the micro-controller stopped the motors.
    pub(super) fn is_abandoned(&self, now: Millis) -> bool {
        let long = |it: &UnderWay<'_>| now.0 >= it.since.0 + WATCHDOG;
        self.open().any(|it| it.row.motion == MINDLESS && long(it))
    }

    /// Returns the speed that is left of what is demanded; none where the robot stands at once.
    pub(super) fn go(&self, speed: u64, demand: &Demand, now: Millis) -> Option<u64> {
        let (mut towards, mut stands) = (speed, false);
        for it in self.open() {
            match it.row.motion {
                BLOCKED => stands |= !demand.led,
                SLOWED => towards = towards.min(speed * u64::from(it.row.share) / 1_000),
                RUNAWAY if !demand.halted => towards = demand.fastest,
                DEAD => stands = true,
                SILENT | MINDLESS if now.0 >= it.since.0 + WATCHDOG => towards = 0,
                _ => {}
            }
        }
        (!stands).then_some(towards)
    }

    fn lost(&self) -> (u64, u64) {
        self.open().fold((0, 0), |all, it| (all.0 | it.row.hardware, all.1 | it.row.modules))
    }

    /// Returns the modules that work, a bit each.
    pub(super) fn works(&self) -> u64 {
        let (hardware, modules) = self.lost();
        let known = self.world.modules.len();
        let beyond = if known < 64 { u64::MAX << known } else { 0 };
        self.world.available(hardware, modules) | beyond
    }

    /// True if the operator is reached, and answers.
    pub(super) fn link(&self) -> bool {
        let works = self.works();
        self.world.operator.is_some_and(|needs| needs & !works == 0)
            && !self.open().any(|it| it.row.unanswered)
    }

    /// Returns the flags that are up, a bit each.
    pub(super) fn up(&self) -> u64 {
        self.open().filter(|it| it.found).fold(0, |set, it| set | it.flags)
    }

    /// Observers look for a period; returns the faults that they see from now on.
    pub(super) fn look(&mut self, moves: bool, waits: bool) -> Vec<usize> {
        if self.all.iter().all(|it| it.over || it.found) {
            return Vec::new();
        }
        let ((hardware, _), works) = (self.lost(), self.works());
        let watched = self.world.observers.iter();
        let watched = watched.filter(|it| it.modules & !works == 0 && it.hardware & hardware == 0);
        let watched = watched.fold(0, |set, it| set | it.flags);
        let mut found = Vec::new();
        for it in self.all.iter_mut().filter(|it| !it.over && !it.found) {
            let in_motion = matches!(it.row.motion, BLOCKED | SLOWED);
            let shows = it.row.is_seen && (moves || !in_motion) && (waits || !it.row.unanswered);
            if shows && it.flags & watched != 0 {
                it.seen += PERIOD;
                it.found = it.seen >= it.row.latency.0;
                found.extend(it.found.then_some(it.fault));
            }
        }
        found
    }
}
