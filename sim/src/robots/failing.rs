//! The failures of a robot under way: how they change its motion, and when observers see them.

use crate::body::{Drive, FIRMWARE_WATCHDOG, Motion};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::cotama::Persistence;
use cotama_models::robots::{self, Mode, Parts, Robot, Setting, Where};

/// A failure under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Failure {
    /// Its number in the robot's file.
    pub(super) number: usize,
    since: Millis,
    /// For how long observers have been able to see it.
    seen: Millis,
    /// Whether its flags are up.
    pub(super) found: bool,
    pub(super) over: bool,
}

/// The failures of a run, in the order of their happening; none is dropped.
#[derive(Clone, Debug, Default)]
pub(super) struct Failures {
    pub(super) all: Vec<Failure>,
    /// The period of the control loop.
    pub(super) period: Millis,
}

/// What is demanded of the motors in a period.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demand {
    pub(super) speed: MillimetresPerSecond,
    pub(super) most: MillimetresPerSecond,
    pub(super) halt: bool,
    pub(super) end: Millimetres,
    /// Whether the operator leads the robot.
    pub(super) led: bool,
}

impl Failures {
    fn open<'r>(&self, robot: &'r Robot) -> impl Iterator<Item = (Failure, &'r robots::Failure)> {
        let open = self.all.iter().filter(|it| !it.over).copied();
        open.filter_map(|it| Some((it, robot.failures.get(it.number)?)))
    }

    /// Something fails.
    pub(super) fn fail(&mut self, now: Millis, number: usize) {
        let (seen, found, over) = (Millis(0), false, false);
        self.all.push(Failure { number, since: now, seen, found, over });
    }

    /// Ends the failures that end by themselves by now, and those for which `ended` says so.
    pub(super) fn end(&mut self, robot: &Robot, now: Millis, ended: impl Fn(usize) -> bool) {
        for (at, it) in self.all.iter_mut().enumerate() {
            let row = robot.failures.get(it.number);
            let past = row.and_then(|it| it.ends).is_some_and(|time| now.0 >= it.since.0 + time.0);
            let returns = row.is_none_or(|it| it.motion != Motion::Mindless);
            it.over |= returns && (past || ended(at));
        }
    }

    /// The operator has helped.
    pub(super) fn is_helped(&mut self, robot: &Robot) {
        for it in &mut self.all {
            it.over |= robot.failures.get(it.number).is_some_and(|it| it.helped);
        }
    }

    /// A module was started anew: what does not stay is over, and the rest shows itself again.
    pub(super) fn restart(&mut self, robot: &Robot, module: usize) {
        for it in self.all.iter_mut().filter(|it| !it.over) {
            let Some(row) = robot.failures.get(it.number) else { continue };
            if row.restarts.is_some_and(|it| it.module == module) {
                it.over |= row.persistence != Persistence::Permanent;
                (it.seen, it.found) = (Millis(0), false);
            }
        }
    }

    /// A setting answers a failure of these rows: what it mends is over, and what it is only tried
    /// on shows itself again.
    pub(super) fn set(&mut self, of: &[usize], setting: &Setting) {
        for it in self.all.iter_mut().filter(|it| !it.over && of.contains(&it.number)) {
            it.over |= setting.mends;
            if setting.times.is_some() {
                (it.seen, it.found) = (Millis(0), false);
            }
        }
    }

    /// Whether observers see a failure of one of these rows now.
    pub(super) fn is_seen(&self, of: &[usize]) -> bool {
        self.all.iter().any(|it| it.found && !it.over && of.contains(&it.number))
    }

    /// Returns the parts that are broken, known or not.
    pub(super) fn broken(&self, robot: &Robot) -> Parts {
        self.open(robot).fold(Parts::NONE, |all, it| all.union(it.1.loses))
    }

    /// Returns the losses of which something is broken, known or not, a bit each.
    pub(super) fn broken_losses(&self, robot: &Robot) -> u32 {
        if self.all.iter().all(|it| it.over) {
            return 0;
        }
        let gone = !robot.available(self.broken(robot));
        let all = robot.losses.losses.iter().enumerate().filter(|it| it.1.modules & gone != 0);
        all.fold(0, |set, it| set | 1 << it.0)
    }

    /// Whether the computer is up.
    pub(super) fn thinks(&self, robot: &Robot) -> bool {
        !self.open(robot).any(|it| it.1.motion == Motion::Mindless)
    }

    /// Whether the computer has been down for so long that the micro-controller stops the motors.
    pub(super) fn is_abandoned(&self, robot: &Robot, now: Millis) -> bool {
        let long = |it: &Failure| now.0 >= it.since.0 + FIRMWARE_WATCHDOG.0;
        self.open(robot).any(|it| it.1.motion == Motion::Mindless && long(&it.0))
    }

    /// Moves for a period, as failures leave it of what is demanded.
    pub(super) fn go(&self, robot: &Robot, now: Millis, demand: &Demand, drive: &mut Drive) {
        let (mut towards, mut end) = (demand.speed, demand.end);
        for (it, row) in self.open(robot) {
            match row.motion {
                Motion::Free => {}
                Motion::Blocked if demand.led => {}
                Motion::Blocked => end = drive.x(),
                Motion::Slowed(parts) => {
                    towards = towards
                        .min(MillimetresPerSecond(demand.speed.0 * u64::from(parts) / 1_000));
                }
                Motion::Runaway if demand.halt => {}
                Motion::Runaway => towards = demand.most,
                Motion::Dead => {
                    drive.stand();
                    towards = MillimetresPerSecond(0);
                }
                Motion::Silent | Motion::Mindless => {
                    if now.0 >= it.since.0 + FIRMWARE_WATCHDOG.0 {
                        towards = MillimetresPerSecond(0);
                    }
                }
            }
        }
        drive.go(towards, end, self.period);
    }

    /// Observers look for a period; returns the failures that are seen from now on.
    pub(super) fn look(&mut self, robot: &Robot, place: Where) -> Vec<usize> {
        let (broken, period) = (self.broken(robot), self.period.0);
        let mut seen = Vec::new();
        for (at, it) in self.all.iter_mut().enumerate() {
            let Some(row) = robot.failures.get(it.number) else { continue };
            if it.over || it.found || !can_see(robot, row, broken, place) {
                continue;
            }
            it.seen.0 += period;
            if it.seen >= row.latency {
                it.found = true;
                seen.push(at);
            }
        }
        seen
    }

    /// In how many periods observers see nothing new while the robot stays where it is in its
    /// drive.
    pub(super) fn unseen_for(&self, robot: &Robot, place: Where) -> u64 {
        let broken = self.broken(robot);
        let open = self.open(robot).filter(|it| !it.0.found);
        let open = open.filter(|it| can_see(robot, it.1, broken, place));
        let left =
            open.map(|it| it.1.latency.0.saturating_sub(it.0.seen.0).div_ceil(self.period.0));
        left.min().map_or(u64::MAX, |it| it.saturating_sub(1))
    }

    /// Observers look for so many periods in which they see nothing new.
    pub(super) fn look_on(&mut self, robot: &Robot, place: Where, periods: u64) {
        let (broken, period) = (self.broken(robot), self.period.0);
        for it in self.all.iter_mut().filter(|it| !it.over && !it.found) {
            let row = robot.failures.get(it.number);
            if row.is_some_and(|it| can_see(robot, it, broken, place)) {
                it.seen.0 += period * periods;
            }
        }
    }

    /// The flags that are up, with those of failures that are over gone.
    pub(super) fn flags(&self, robot: &Robot) -> Vec<bool> {
        let mut up = vec![false; robot.flags().count()];
        for flag in self.open(robot).filter(|it| it.0.found).flat_map(|it| &it.1.flags) {
            up.get_mut(*flag).into_iter().for_each(|it| *it = true);
        }
        up
    }

    /// When the next failure changes by itself: it ends, or the micro-controller hears nothing.
    pub(super) fn changes(&self, robot: &Robot, now: Millis) -> Option<Millis> {
        let times = self.open(robot).flat_map(|(it, row)| {
            let silent = matches!(row.motion, Motion::Silent | Motion::Mindless);
            let ends = row.ends.map(|time| it.since.0 + time.0);
            let stops = it.since.0 + FIRMWARE_WATCHDOG.0;
            [ends, (silent && stops > now.0).then_some(stops)]
        });
        times.flatten().min().map(Millis)
    }
}

/// Whether an observer of a failure can see it now: one that raises one of its flags works, and
/// what shows in motion alone is looked for where the robot is to move.
fn can_see(robot: &Robot, row: &robots::Failure, broken: Parts, place: Where) -> bool {
    if row.flags.is_empty() || row.unseen.is_some() {
        return false;
    }
    let is_shown_by_motion = matches!(row.motion, Motion::Blocked | Motion::Slowed(_));
    if is_shown_by_motion && !moves(robot, place) {
        return false;
    }
    let available = robot.available(broken);
    let works = |observer: usize| {
        robot.observers.get(observer).is_some_and(|it| {
            it.needs.modules & !available == 0 && it.needs.hardware & broken.hardware == 0
        })
    };
    robot.flags().enumerate().any(|(flag, of)| row.flags.contains(&flag) && works(of.0))
}

/// Whether the robot is to move where it is in its drive.
pub(super) fn moves(robot: &Robot, place: Where) -> bool {
    let Where::Runs { configuration, .. } = place else { return false };
    robot.configurations.get(configuration).is_some_and(|it| it.speed.0 > 0)
}

/// The mode of the sub-objective that runs; `None` where none does.
pub(super) fn mode(robot: &Robot, place: Where) -> Option<Mode> {
    let Where::Runs { sub_objective, .. } = place else { return None };
    robot.sub_objectives.get(sub_objective).map(|it| it.mode)
}
