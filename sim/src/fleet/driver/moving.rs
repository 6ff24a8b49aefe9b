//! A robot of a team between two rounds: what it was told to do does not change meanwhile.

use super::supervisors::Kind;
use crate::body::Drive;
use crate::robots::failing::{Demand, Failures, mode};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::level::{Adapted, Mode, Where};

/// Orders of the supervisors until the next round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orders {
    /// Whether the robot may move.
    pub(super) permits: bool,
    /// Whether motion has ended for good.
    pub(super) halted: bool,
    pub(super) place: Where,
    /// The end of the drive; none where it is not on one.
    pub(super) leg: Option<Millimetres>,
}

impl Orders {
    /// Orders for a robot without a task.
    pub(super) const NONE: Self =
        Self { permits: false, halted: false, place: Where::Rests, leg: None };

    const fn configuration(&self) -> Option<usize> {
        match self.place {
            Where::Runs { configuration, .. } => Some(configuration),
            Where::Rests | Where::Waits => None,
        }
    }
}

/// The motion of a robot, its failures and its energy.
#[derive(Clone, Debug)]
pub(super) struct Moving {
    kind: &'static Kind,
    pub(super) drive: Drive,
    pub(super) failures: Failures,
    pub(super) adapted: Adapted,
    pub(super) energy_uj: u64,
    /// The robot has gone on until then: a multiple of the period.
    pub(super) now: u64,
    /// The failures that observers have seen since the last round.
    pub(super) seen: Vec<usize>,
    /// Whether it has gone on evenly since that was last said.
    pub(super) even: bool,
    /// People stand in its way until then.
    pub(super) held_until: u64,
    /// The battery is empty.
    pub(super) empty: bool,
}

impl Moving {
    pub(super) fn new(kind: &'static Kind) -> Self {
        Self {
            kind,
            drive: Drive::new(kind.body.acceleration.max(1)),
            failures: Failures { period: Millis(kind.period()), ..Failures::default() },
            adapted: Adapted::default(),
            energy_uj: 0,
            now: 0,
            seen: Vec::new(),
            even: true,
            held_until: 0,
            empty: false,
        }
    }

    pub(super) fn thinks(&self) -> bool {
        !self.empty && self.failures.thinks(self.kind.robot)
    }

    /// Returns what is demanded of the motors.
    pub(super) fn demand(&self, orders: &Orders) -> Demand {
        let (kind, mode) = (self.kind, mode(self.kind.robot, orders.place));
        let runs = orders.configuration().and_then(|it| kind.robot.configurations.get(it));
        let left = u64::from(self.adapted.speed(&kind.tables, Millis(self.now), mode));
        let speed = runs
            .filter(|_| orders.permits && self.now >= self.held_until)
            .map_or(0, |it| it.speed.0 * left / 1_000);
        let braked = || Millimetres(self.drive.x().0 + self.drive.braking_distance().0 + 1);
        Demand {
            speed: MillimetresPerSecond(speed),
            most: kind.body.speed_max,
            halt: orders.halted,
            end: orders.leg.unwrap_or_else(braked),
            led: mode == Some(Mode::Operator),
        }
    }

    /// The robot goes on, period by period, until now; observers look.
    pub(super) fn go(&mut self, now: u64, orders: &Orders) {
        let kind = self.kind;
        let period = kind.period();
        if self.empty {
            self.now += now.saturating_sub(self.now) / period * period;
        }
        while self.now + period <= now {
            let (before, start) = (self.drive, Millis(self.now));
            self.failures.end(kind.robot, start, |_| false);
            self.see(start);
            let demand = self.demand(orders);
            self.failures.go(kind.robot, start, &demand, &mut self.drive);
            self.now += period;
            self.draw(orders, 1);
            let thinks = self.thinks();
            if thinks && !self.failures.all.is_empty() {
                self.seen.extend(self.failures.look(kind.robot, orders.place));
            }
            if !self.drive.is_steady_since(&before, Millis(period)) {
                self.even = false;
                continue;
            }
            let left = (now - self.now) / period;
            let times = left.min(self.alike(orders, demand.end));
            if times == 0 {
                continue;
            }
            self.drive.glide(times, Millis(period));
            debug_assert!(orders.leg.is_none_or(|it| self.drive.x() <= it), "a drive ends");
            if thinks {
                self.failures.look_on(kind.robot, orders.place, times);
            }
            self.draw(orders, times);
            self.now += times * period;
            self.see(Millis(self.now - period));
        }
    }

    /// Observers look whether settings are still needed, and whether what is lost works again.
    fn see(&mut self, now: Millis) {
        let kind = self.kind;
        let broken = self.failures.broken_losses(kind.robot, &kind.tables);
        self.adapted.see(self.failures.shown(&kind.tables), broken, now);
    }

    /// In how many periods from now on it goes on as in the last one, which was even.
    fn alike(&self, orders: &Orders, end: Millimetres) -> u64 {
        let kind = self.kind;
        let period = kind.period();
        // A change at the start of a period changes that period.
        let until = |it: Millis| it.0.saturating_sub(self.now).div_ceil(period);
        let even = match self.drive.speed().0 {
            0 => u64::MAX,
            _ => self.drive.times_before(end, Millis(period)).unwrap_or(0),
        };
        let even = if self.thinks() { even.min(self.unseen_for(orders)) } else { even };
        self.changes().fold(even, |even, it| even.min(until(it)))
    }

    /// When failures and settings change by themselves next, from now on.
    pub(super) fn changes(&self) -> impl Iterator<Item = Millis> {
        let just_before = Millis(self.now.saturating_sub(1));
        let failures = self.failures.changes(self.kind.robot, just_before);
        let shown = self.failures.shown(&self.kind.tables);
        let settings = self.adapted.ends_at(&self.kind.tables, shown, just_before);
        let goes_on = (self.held_until > just_before.0).then_some(Millis(self.held_until));
        failures.into_iter().chain(settings).chain(goes_on)
    }

    /// In how many periods observers see nothing new.
    pub(super) fn unseen_for(&self, orders: &Orders) -> u64 {
        self.failures.unseen_for(self.kind.robot, orders.place)
    }

    /// Whether it would go on at its speed for a period.
    pub(super) fn is_steady(&self, orders: &Orders) -> bool {
        let mut next = self.drive;
        let now = Millis(self.now);
        self.failures.go(self.kind.robot, now, &self.demand(orders), &mut next);
        next.speed() == self.drive.speed()
    }

    /// Draws its power for some periods.
    fn draw(&mut self, orders: &Orders, periods: u64) {
        let motion = self.kind.body.motion_power.at(self.drive.speed()).0;
        let power = motion.saturating_add(self.kind.power(orders.configuration()).0);
        let time = self.kind.period().saturating_mul(periods);
        self.energy_uj = self.energy_uj.saturating_add(power.saturating_mul(time));
    }
}
