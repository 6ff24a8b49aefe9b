//! A robot that COTAMA's decisional component drives through one task at a time.
//!
//! A task is a mission of the supervisors that the robot's file makes: drive, receive, drive,
//! deliver. The robot fails, is observed and is set as in a [mission](crate::robots). Rounds lie on
//! a grid of the robot's period, but only those are taken in which something can happen: a level
//! that was told all and has come to rest stays as it is until its surroundings change. So forty
//! robots take some thousand rounds and not some hundred thousand; a test takes them all, and comes
//! to the same.

mod moving;
mod says;
mod supervisors;
#[cfg(test)]
mod tests;

use crate::robots::failing::moves;
use crate::robots::operator::PATIENCE;
use cotama_core::net::TransitionId;
use cotama_core::player::{Firing, Names, Observer};
use cotama_core::system::Of;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::level::{Act, Cause, Hidden};
use cotama_models::robots::{Global, Robot, RobotFile, Told, Where, members};
use cotama_models::team::scenario::{self, Row, Stage};
use moving::{Moving, Orders};
use std::collections::VecDeque;
use supervisors::{Kind, Supervisors, kind_of};

/// A robot whose role is over stands within so many periods, or runs away.
const MOST_COASTED: u64 = 600;

/// The outcome of a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Driven {
    /// The failure that was found.
    pub(super) found: Option<Row>,
    /// The name of the configuration, if it is another one.
    pub(super) configuration: Option<&'static str>,
}

/// The robot under its decisional component.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    kind: &'static Kind,
    level: Supervisors,
    moving: Moving,
    /// The places of the level after the last round, and since when the robot is there.
    global: Global,
    place: Where,
    place_since: u64,
    /// Reports and returns that the level was not told yet.
    untold: VecDeque<Told>,
    /// The reports of losses that it was told, each once.
    told: Vec<usize>,
    /// A task is to be begun.
    wanted: bool,
    /// The length of both drives.
    legs: [Millimetres; 2],
    /// For how long people stand in the way of both drives, in ms; 0 once they have.
    holds_ms: [u64; 2],
    /// Nothing happened in the last round, or before it.
    calm: bool,
    /// Every round is taken: for the test that the others change nothing.
    every_round: bool,
}

impl Driver {
    /// A robot of this file, without a task.
    pub(super) fn new(file: &RobotFile, every_round: bool) -> Self {
        let kind = kind_of(file);
        Self {
            kind,
            level: kind.at_rest(&[]),
            moving: Moving::new(kind),
            global: Global::Waits,
            place: Where::Rests,
            place_since: 0,
            untold: VecDeque::new(),
            told: Vec::new(),
            wanted: false,
            legs: [Millimetres(0); 2],
            holds_ms: [0; 2],
            calm: true,
            every_round,
        }
    }

    const fn robot(&self) -> &'static Robot {
        self.kind.robot
    }

    /// Returns the period of rounds, in ms.
    pub(super) fn period(&self) -> u64 {
        self.kind.period()
    }

    /// A task begins: two drives of these lengths, each after people have stood in its way for so
    /// long, in ms.
    pub(super) fn begin(&mut self, now: u64, legs_mm: [u64; 2], holds_ms: [u64; 2]) {
        self.forget(now);
        (self.wanted, self.legs) = (true, legs_mm.map(Millimetres));
        self.holds_ms = holds_ms;
    }

    /// The task is over or was given up: the robot stands where it [comes to
    /// stand](Self::stand_mm). What is broken stays known.
    pub(super) fn forget(&mut self, now: u64) {
        self.go(now);
        if !self.is_stopped() {
            self.drop_role();
        }
        self.moving.drive.restart();
        self.moving.drive.stand();
        (self.wanted, self.calm) = (false, false);
        (self.holds_ms, self.moving.held_until) = ([0; 2], 0);
    }

    /// Whether its supervisors have stopped it for good.
    fn is_stopped(&self) -> bool {
        matches!(self.global, Global::Secures | Global::Safe)
    }

    /// The supervisors start anew, with the losses that they knew; all else that is under way is to
    /// be found again.
    fn drop_role(&mut self) {
        let (lost, reports) = (self.level.lost(), &self.robot().losses.reports);
        let is_known = |report: usize| {
            let loss = reports.get(report).and_then(|it| it.loss);
            loss.is_some_and(|it| lost >> it & 1 == 1)
        };
        self.told.retain(|it| is_known(*it));
        self.level = self.kind.at_rest(&self.told);
        let tables = &self.kind.tables;
        let report = |row: usize| tables.failures.get(row).map(|it| usize::from(it.report));
        let is_told = |row: usize| report(row).is_some_and(is_known);
        self.moving.failures.show_again(is_told);
        let failures = &self.moving.failures;
        self.moving.seen.retain(|it| failures.all.get(*it).is_some_and(|it| it.found));
        (self.global, self.place) = (self.level.global(), self.level.place());
        self.place_since = self.moving.now;
    }

    /// How far the drive under way will have come, in mm, when the robot stands whose role is over
    /// now: it brakes, and without a laptop the micro-controller stops it later.
    pub(super) fn stand_mm(&self, now: u64) -> u64 {
        let (mut ahead, leg) = (self.at(now), self.leg());
        let orders =
            if ahead.thinks() && !self.is_stopped() { Orders::NONE } else { self.orders() };
        for _ in 0..MOST_COASTED {
            if ahead.drive.speed().0 == 0 || ahead.drive.x() >= leg {
                break;
            }
            ahead.go(ahead.now + self.period(), &orders);
        }
        ahead.drive.x().min(leg).0
    }

    /// Something fails.
    pub(super) fn fail(&mut self, now: u64, row: Row) {
        self.go(now);
        self.moving.failures.fail(self.kind.robot, Millis(now), row.number());
        self.calm = false;
    }

    /// Something outside has changed: the next rounds count.
    pub(super) fn stir(&mut self) {
        self.calm = false;
    }

    /// Whether its laptop is up.
    pub(super) fn thinks(&self) -> bool {
        self.moving.thinks()
    }

    /// The battery is empty: nothing of the robot works any more.
    pub(super) fn runs_empty(&mut self, now: u64) {
        self.go(now);
        self.moving.drive.stand();
        self.moving.empty = true;
        self.calm = false;
    }

    /// Energy used so far, in mJ.
    pub(super) fn energy_mj(&self, now: u64) -> u64 {
        self.at(now).energy_uj / 1_000
    }

    /// Returns the stage of the mission.
    pub(super) fn stage(&self) -> Stage {
        match self.global {
            Global::Waits if self.wanted => Stage::ToTake,
            Global::Waits => Stage::Rests,
            Global::Does(0) => Stage::ToTake,
            Global::Does(1) => Stage::Takes,
            Global::Does(2) => Stage::ToGive,
            Global::Does(_) => Stage::Gives,
            Global::Done => Stage::Done,
            Global::Secures => Stage::Stops,
            Global::Safe => Stage::Safe,
        }
    }

    /// How far the drive under way had come at the end of the last period, in mm.
    pub(super) fn driven_mm(&self, now: u64) -> u64 {
        self.at(now).drive.x().min(self.leg()).0
    }

    /// Returns the rest of the drive under way, in mm.
    pub(super) fn left_mm(&self, now: u64) -> u64 {
        self.leg().0.saturating_sub(self.driven_mm(now))
    }

    /// The robot at the end of the last period.
    fn at(&self, now: u64) -> Moving {
        let mut there = self.moving.clone();
        there.go(now, &self.orders());
        there
    }

    /// How fast it could drive with what is not known to be lost, in mm/s; none where it cannot.
    pub(super) fn pace(&self) -> Option<u64> {
        if self.is_stopped() { None } else { scenario::pace(self.robot(), self.level.lost()) }
    }

    fn leg(&self) -> Millimetres {
        self.legs[usize::from(matches!(self.global, Global::Does(2..) | Global::Done))]
    }

    /// Whether the present objective is a drive.
    const fn is_driving(&self) -> bool {
        matches!(self.global, Global::Does(0 | 2))
    }

    /// Returns the orders of the supervisors until the next round.
    fn orders(&self) -> Orders {
        Orders {
            permits: self.level.permits(),
            halted: self.level.is_halted(),
            place: self.place,
            leg: self.is_driving().then(|| self.leg()),
        }
    }

    /// The robot goes on, period by period, until now.
    fn go(&mut self, now: u64) {
        let (orders, energy_uj) = (self.orders(), self.moving.energy_uj);
        self.moving.go(now, &orders);
        debug_assert!(self.moving.energy_uj >= energy_uj, "energy is used, and not won");
        debug_assert!(self.moving.now <= now, "periods that are over are simulated");
        debug_assert!(now - self.moving.now < self.period(), "no period is left out");
    }

    /// A round. `done` says that what is taken or given at this place is taken or given.
    pub(super) fn round(&mut self, now: u64, done: bool) -> Driven {
        self.moving.even = true;
        self.go(now);
        let mut driven = Driven { found: None, configuration: None };
        if !self.thinks() {
            return driven;
        }
        self.calm = self.moving.even;
        driven.found = self.observe();
        self.return_what_works(now);
        let mut seen = Seen::default();
        self.level.round(Millis(now), &mut seen);
        self.follow();
        if let Some(told) = self.untold.pop_front().or_else(|| self.says(now, done)) {
            self.calm = false;
            let accepted = self.level.tell(Millis(now), told, Cause(0), &mut seen);
            if let (true, Told::Back(loss)) = (accepted, told) {
                self.moving.adapted.is_back(loss);
            }
            if let Told::Report(it) = told
                && !self.told.contains(&it)
            {
                self.told.push(it);
            }
        }
        self.follow();
        self.react(now, &seen);
        driven.configuration = self.arrive(now);
        driven
    }

    /// Queues the reports of what observers have seen; returns the first failure seen.
    fn observe(&mut self) -> Option<Row> {
        let seen = std::mem::take(&mut self.moving.seen);
        let first = self.moving.failures.all.get(*seen.first()?)?.number;
        self.calm = false;
        let (_, taken) = self.moving.failures.diagnosed(
            self.kind.robot,
            &self.kind.tables,
            (0, &seen),
            Hidden::default(),
        );
        let reports = taken.into_iter().filter_map(|it| self.kind.tables.failures.get(it));
        let reports = reports.map(|it| usize::from(it.report));
        for told in reports.map(Told::Report) {
            if !self.untold.contains(&told) {
                self.untold.push_back(told);
            }
        }
        Some(Row::new(first))
    }

    /// Lost parts that have worked again for long enough are to be told.
    fn return_what_works(&mut self, now: u64) {
        let back = self.moving.adapted.back(&self.kind.tables, self.level.lost(), Millis(now));
        for told in members(u64::from(back)).map(Told::Back) {
            if !self.untold.contains(&told) {
                self.untold.push_back(told);
            }
        }
    }

    /// Follows the global supervisor to its objective: each drive is counted from its start.
    fn follow(&mut self) {
        let global = self.level.global();
        if global == self.global {
            return;
        }
        (self.global, self.calm) = (global, false);
        if self.is_driving() {
            self.moving.drive.restart();
        }
    }

    /// Makes the settings, and starts the modules anew, that the observation module wants.
    fn react(&mut self, now: u64, seen: &Seen) {
        self.calm &= seen.fired.is_empty();
        let kind = self.kind;
        for id in seen.fired.iter().filter(|it| Some(usize::from(it.component)) == kind.observation)
        {
            for act in kind.tables.acts(*id) {
                match act {
                    Act::Restart(module) => {
                        self.moving.failures.restart(kind.robot, usize::from(module));
                    }
                    Act::Set(report) => self.set(now, usize::from(report)),
                    // Nobody answers in a team, and its robot masks nothing.
                    Act::Ask(_) | Act::Hide(_) => {}
                }
            }
        }
    }

    /// Makes the setting of a report.
    fn set(&mut self, now: u64, report: usize) {
        let of = self.robot().losses.reports.get(report);
        if let Some((of, setting)) = of.and_then(|it| Some((it, it.sets.as_ref()?))) {
            self.moving.failures.set(&of.failures, setting);
        }
        self.moving.adapted.set(report, Millis(now));
    }

    /// Notes where the supervisors have come to; returns the configuration if it is another one.
    fn arrive(&mut self, now: u64) -> Option<&'static str> {
        let place = self.level.place();
        if place == self.place {
            return None;
        }
        self.calm = false;
        let before = std::mem::replace(&mut self.place, place);
        if before.is_left_for(place) {
            self.place_since = now;
        }
        self.meets_people(now);
        let Where::Runs { configuration, .. } = place else { return None };
        self.robot().configurations.get(configuration).map(|it| it.name.as_str())
    }

    /// A drive that may begin is held for as long as people stand in its way.
    fn meets_people(&mut self, now: u64) {
        if self.is_driving() && moves(self.robot(), self.place) {
            let leg = usize::from(self.global != Global::Does(0));
            let held = std::mem::take(&mut self.holds_ms[leg]);
            self.moving.held_until = self.moving.held_until.max(now.saturating_add(held));
        }
    }

    /// When the next round counts; none while nothing happens by itself.
    pub(super) fn next_round(&self) -> Option<u64> {
        if !self.thinks() {
            return None;
        }
        let (orders, moving, period) = (self.orders(), &self.moving, self.period());
        let soon = moving.now + period;
        let busy = !self.untold.is_empty()
            || !moving.seen.is_empty()
            || self.level.player().round_is_due()
            || self.global == Global::Secures;
        if self.every_round || busy || !self.calm || !moving.is_steady(&orders) {
            return Some(soon);
        }
        let in_period = |it: u64| moving.now.saturating_add(it.saturating_add(1) * period);
        let sees = Some(moving.unseen_for(&orders)).filter(|it| *it < u64::MAX).map(in_period);
        let returns = moving.adapted.returns_at();
        let changes = moving.changes().chain(returns).map(|it| it.0);
        let arrives = (moving.drive.speed().0 > 0).then(|| {
            let end = moving.demand(&orders).end;
            in_period(moving.drive.times_before(end, Millis(period)).unwrap_or(0))
        });
        let next = changes.chain(sees).chain(arrives).chain(self.waits_until()).min()?;
        Some(next.max(soon).next_multiple_of(period))
    }

    /// Until when it stands in its drive by itself.
    fn waits_until(&self) -> Option<u64> {
        match self.place {
            Where::Waits => Some(self.place_since + PATIENCE.0 + 1),
            Where::Runs { configuration, .. } if !moves(self.robot(), self.place) => {
                let takes = self.robot().configurations.get(configuration).map(|it| it.takes.0);
                takes.map(|it| self.place_since + it)
            }
            Where::Runs { .. } | Where::Rests => None,
        }
    }
}

/// The transitions that fired.
#[derive(Debug, Default)]
struct Seen {
    fired: Vec<Of<TransitionId>>,
}

impl<P: Names> Observer<P, Cause> for Seen {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.fired.push(firing.id);
    }
}
