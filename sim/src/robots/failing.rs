//! The failures of a robot under way: how they change its motion, and when observers see them.

use super::drawn::{Drawing, Drawn};
use crate::body::{FIRMWARE_WATCHDOG, Motion, Moves};
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_models::level::{Hidden, Tables};
use cotama_models::robots::{self, Harmed, Mode, Parts, Robot, Setting, Where, members};
use cotama_models::severity::Persistence;

/// A failure under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure {
    /// Number in the robot's file.
    pub(crate) number: usize,
    since: Millis,
    /// For how long observers have been able to see it, and for how long it was to be seen.
    seen: Millis,
    shown: Millis,
    /// The detection, where that is drawn from measured ones.
    drawn: Option<Drawn>,
    /// Whether its flags are up.
    pub(crate) found: bool,
    pub(crate) over: bool,
}

/// The failures of a run, in the order of their happening; none is dropped.
#[derive(Clone, Debug, Default)]
pub(crate) struct Failures {
    pub(crate) all: Vec<Failure>,
    /// The period of the control loop.
    pub(crate) period: Millis,
    /// The losses of parts, for the parts that were asked of last.
    pub(crate) losses: Option<(Parts, u32)>,
    /// The modules that can be used, likewise.
    pub(crate) works: Option<(Parts, u64)>,
    /// The longest time that one was to be seen, beyond its latency, and was not.
    pub(crate) unseen: Millis,
    /// The flags that are up by signals of the robot; `None` where all flags are told.
    pub(crate) signals: Option<u64>,
    /// Measured detections, of which each failure that is told draws its own.
    pub(crate) drawing: Option<Drawing>,
}

impl Failure {
    /// Returns the time in which observers see it; `None` where they never do. A measured delay
    /// counts from the period of the failure, in which observers look for the first time.
    fn latency(&self, row: &robots::Failure, period: u64) -> Option<Millis> {
        match self.drawn {
            None => Some(row.latency),
            Some(drawn) => drawn.after.map(|it| Millis(it.0.saturating_add(period))),
        }
    }
}

/// The time for which a failure that is over by itself may still show itself.
const SHOWS_AFTER: Millis = Millis(1_000);

/// The demand on the motors in a period.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Demand {
    pub(crate) speed: MillimetresPerSecond,
    pub(crate) most: MillimetresPerSecond,
    pub(crate) halt: bool,
    pub(crate) end: Millimetres,
    /// Whether the operator leads the robot.
    pub(crate) led: bool,
}

impl Failures {
    fn open<'r>(&self, robot: &'r Robot) -> impl Iterator<Item = (Failure, &'r robots::Failure)> {
        let open = self.all.iter().filter(|it| !it.over).copied();
        open.filter_map(|it| Some((it, robot.failures.get(it.number)?)))
    }

    /// Something fails.
    pub(crate) fn fail(&mut self, robot: &Robot, now: Millis, number: usize) {
        let (seen, shown, found, over) = (Millis(0), Millis(0), false, false);
        let drawn = self.drawing.as_ref().and_then(|it| it.draw(robot, number, now));
        self.all.push(Failure { number, since: now, seen, shown, drawn, found, over });
    }

    /// Returns the rows that a failure is told as where a measured detection was drawn for it.
    fn taken(&self, it: &Failure) -> Option<&[usize]> {
        Some(self.drawing.as_ref()?.taken(it.number, it.drawn?))
    }

    /// Returns the flags that a failure raises when it is told, a bit each: its own, or those of
    /// the rows for which it is taken.
    fn told_flags(&self, tables: &Tables<'_>, it: &Failure) -> u64 {
        let flags = |row: usize| tables.failures.get(row).map_or(0, |it| it.flags);
        self.taken(it)
            .map_or_else(|| flags(it.number), |it| it.iter().fold(0, |set, row| set | flags(*row)))
    }

    /// Ends the failures that end by themselves by now, and those for which `ended` says so.
    pub(crate) fn end(&mut self, robot: &Robot, now: Millis, ended: impl Fn(usize) -> bool) {
        for (at, it) in self.all.iter_mut().enumerate() {
            let row = robot.failures.get(it.number);
            let past = row.and_then(|it| it.ends).is_some_and(|time| now.0 >= it.since.0 + time.0);
            let returns = row.is_none_or(|it| it.motion != Motion::Mindless);
            it.over |= returns && (past || ended(at));
        }
    }

    /// The operator has helped.
    pub(crate) fn is_helped(&mut self, robot: &Robot) {
        for it in &mut self.all {
            it.over |= robot.failures.get(it.number).is_some_and(|it| it.helped);
        }
    }

    /// A module was started anew: what does not stay is over, and the rest shows itself again.
    pub(crate) fn restart(&mut self, robot: &Robot, module: usize) {
        for it in self.all.iter_mut().filter(|it| !it.over) {
            let Some(row) = robot.failures.get(it.number) else { continue };
            if let Some(restarts) = row.restarts.filter(|it| it.module == module) {
                it.over |= restarts.mends || row.persistence != Persistence::Permanent;
                (it.seen, it.shown, it.found) = (Millis(0), Millis(0), false);
            }
        }
    }

    /// A setting answers a failure of these rows: what it mends is over, and what it is only tried
    /// on shows itself again.
    pub(crate) fn set(&mut self, of: &[usize], setting: &Setting) {
        for it in self.all.iter_mut().filter(|it| !it.over && of.contains(&it.number)) {
            it.over |= setting.mends;
            if setting.times.is_some() {
                (it.seen, it.shown, it.found) = (Millis(0), Millis(0), false);
            }
        }
    }

    /// Lets failures under way show themselves again, but for rows that are told.
    pub(crate) fn show_again(&mut self, is_told: impl Fn(usize) -> bool) {
        for it in self.all.iter_mut().filter(|it| !it.over && !is_told(it.number)) {
            (it.seen, it.shown, it.found) = (Millis(0), Millis(0), false);
        }
    }

    /// Lets failures under way show themselves again whose flags were masked, a bit each.
    pub(crate) fn unmask(&mut self, tables: &Tables<'_>, flags: u64) {
        let shows = |row: usize| tables.failures.get(row).is_some_and(|it| it.flags & flags != 0);
        if flags != 0 {
            self.show_again(|row| !shows(row));
        }
    }

    /// Whether a failure shows itself by what it does to a device alone: nothing is told of it.
    fn is_sensed(&self, row: &robots::Failure) -> bool {
        self.signals.is_some() && row.harm.is_some()
    }

    /// The harm that failures under way do.
    pub(crate) fn harms(&self, robot: &Robot) -> impl Iterator<Item = Harmed> {
        self.open(robot).filter_map(|it| it.1.harm)
    }

    /// Signals of the robot raise and lower flags; returns those that are raised, and the failures
    /// under way which they show: all that they speak of, or else the last one that harms a device
    /// and was not found, as what it is taken for.
    pub(crate) fn sense(&mut self, robot: &Robot, up: u64, now: Millis) -> (u64, Vec<usize>) {
        let new = up & !self.signals.replace(up).unwrap_or(0);
        let (mut seen, mut last) = (Vec::new(), None);
        for (at, it) in self.all.iter().enumerate().filter(|it| !it.1.found) {
            let row = robot.failures.get(it.number).filter(|it| it.harm.is_some());
            let Some(row) = row else { continue };
            let ends = row.ends.map_or(it.since, |ends| Millis(it.since.0 + ends.0));
            if it.over && now.0 > ends.0 + SHOWS_AFTER.0 {
                continue;
            }
            let own = row.flags.iter().chain(&row.sometimes);
            let own = own.fold(0_u64, |set, it| set | 1 << (it % 64));
            last = Some(at);
            seen.extend((own & new != 0).then_some(at));
        }
        if seen.is_empty() && new != 0 {
            seen.extend(last);
        }
        (new, seen)
    }

    /// Failures are found: their flags are explained.
    pub(crate) fn find(&mut self, seen: &[usize]) {
        for it in seen {
            if let Some(it) = self.all.get_mut(*it) {
                it.found = true;
            }
        }
    }

    /// Returns the flags that are raised from now on, by signals and by failures that are told, and
    /// the rows that they are taken for, but for what masks hide. A failure with a measured
    /// detection is taken for what it was then.
    pub(crate) fn diagnosed(
        &self,
        robot: &Robot,
        tables: &Tables<'_>,
        (new, seen): (u64, &[usize]),
        hidden: Hidden,
    ) -> (Vec<usize>, Vec<usize>) {
        let is_told =
            |it: &&Failure| !robot.failures.get(it.number).is_some_and(|it| self.is_sensed(it));
        let rows = seen.iter().filter_map(|it| self.all.get(*it)).filter(is_told);
        let (drawn, assumed): (Vec<_>, Vec<_>) = rows.partition(|it| it.drawn.is_some());
        let raised = assumed.into_iter().fold(new, |set, it| set | self.told_flags(tables, it));
        let open = self.all.iter().filter(|it| it.found && !it.over).filter(is_told);
        let up = open.fold(self.signals.unwrap_or(0), |set, it| set | self.told_flags(tables, it));
        let taken = hidden.diagnose(tables.failures, up, raised);
        let mut taken: Vec<_> = taken.worst_first(tables.failures).collect();
        let is_hidden = |row: usize| {
            tables.failures.get(row).is_none_or(|it| hidden.reports >> (it.report % 64) & 1 == 1)
        };
        for row in drawn.iter().filter_map(|it| self.taken(it)).flatten() {
            if !is_hidden(*row) && !taken.contains(row) {
                taken.push(*row);
            }
        }
        let raised = drawn.into_iter().fold(raised, |set, it| set | self.told_flags(tables, it));
        (members(raised).collect(), taken)
    }

    /// Returns the reports of failures that observers see now, a bit each.
    pub(crate) fn shown(&self, tables: &Tables<'_>) -> u64 {
        let report = |row: usize| tables.failures.get(row).map_or(0, |it| 1 << it.report);
        let seen = self.all.iter().filter(|it| it.found && !it.over);
        let told = seen.fold(0, |set, it| match self.taken(it) {
            Some(rows) => rows.iter().fold(set, |set, row| set | report(*row)),
            None => set | report(it.number),
        });
        // Of signals, all that their flags speak of: nobody knows which of it there is.
        let up = self.signals.unwrap_or(0);
        let spoken_of = tables.failures.iter().filter(|it| it.flags & up != 0);
        spoken_of.fold(told, |set, it| set | 1 << it.report)
    }

    /// Whether the operator answers nothing.
    pub(super) fn is_unanswered(&self, robot: &Robot) -> bool {
        self.open(robot).any(|it| it.1.unanswered)
    }

    /// Returns the parts that are broken, known or not.
    pub(crate) fn broken(&self, robot: &Robot) -> Parts {
        self.open(robot).fold(Parts::NONE, |all, it| all.union(it.1.loses))
    }

    /// Returns the modules that can be used with what is broken, known or not.
    pub(crate) fn works(&mut self, robot: &Robot) -> u64 {
        let broken = self.broken(robot);
        match self.works {
            Some((of, works)) if of == broken => works,
            _ => {
                let works = robot.available(broken);
                self.works = Some((broken, works));
                works
            }
        }
    }

    /// Returns the losses of which something is broken, known or not, a bit each.
    pub(crate) fn broken_losses(&mut self, robot: &Robot, tables: &Tables<'_>) -> u32 {
        if self.signals.is_some() {
            return u32::MAX; // no signal says that what was lost works again
        }
        if self.all.iter().all(|it| it.over) {
            return 0;
        }
        let broken = self.broken(robot);
        match self.losses {
            Some((of, losses)) if of == broken => losses,
            _ => {
                let losses = tables.broken(robot.available(broken));
                self.losses = Some((broken, losses));
                losses
            }
        }
    }

    /// Whether the computer is up.
    pub(crate) fn thinks(&self, robot: &Robot) -> bool {
        !self.open(robot).any(|it| it.1.motion == Motion::Mindless)
    }

    /// Whether the computer has been down for so long that the micro-controller stops the motors.
    pub(crate) fn is_abandoned(&self, robot: &Robot, now: Millis) -> bool {
        let long = |it: &Failure| now.0 >= it.since.0 + FIRMWARE_WATCHDOG.0;
        self.open(robot).any(|it| it.1.motion == Motion::Mindless && long(&it.0))
    }

    /// Moves for a period, as failures leave it of what is demanded.
    pub(crate) fn go(&self, robot: &Robot, now: Millis, demand: &Demand, drive: &mut impl Moves) {
        let (mut towards, mut is_blocked) = (demand.speed, false);
        for (it, row) in self.open(robot).filter(|it| !self.is_sensed(it.1)) {
            match row.motion {
                Motion::Free => {}
                Motion::Blocked if demand.led => {}
                Motion::Blocked => is_blocked = true,
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
        if is_blocked {
            drive.stand();
            towards = MillimetresPerSecond(0);
        }
        drive.go(towards, demand.end, self.period);
    }

    /// Observers look for a period; returns the failures that are seen from now on.
    pub(crate) fn look(&mut self, robot: &Robot, place: Where) -> Vec<usize> {
        if self.all.iter().all(|it| it.over || it.found) {
            return Vec::new();
        }
        let (watched, period) = (self.watched(robot), self.period.0);
        let mut seen = Vec::new();
        for (at, (it, is_watched)) in self.all.iter_mut().zip(watched).enumerate() {
            let Some(row) = robot.failures.get(it.number) else { continue };
            let is_sensed = self.signals.is_some() && row.harm.is_some();
            if it.over || it.found || is_sensed || !is_shown(robot, it, row, place) {
                continue;
            }
            it.shown.0 += period;
            if is_watched {
                it.seen.0 += period;
                it.found = it.latency(row, period).is_some_and(|latency| it.seen >= latency);
                seen.extend(it.found.then_some(at));
            }
            if !it.found {
                let late = it.shown.0.saturating_sub(row.latency.0);
                self.unseen = self.unseen.max(Millis(late));
            }
        }
        seen
    }

    /// In how many periods observers see nothing new while the robot stays where it is in its
    /// drive.
    pub(crate) fn unseen_for(&self, robot: &Robot, place: Where) -> u64 {
        let open = self.all.iter().zip(self.watched(robot)).filter(|it| !it.0.over && !it.0.found);
        let left = open.filter(|it| it.1).filter_map(|(it, _)| {
            let row = robot.failures.get(it.number)?;
            let latency = it.latency(row, self.period.0)?;
            let is_shown = is_shown(robot, it, row, place);
            is_shown.then(|| latency.0.saturating_sub(it.seen.0).div_ceil(self.period.0))
        });
        left.min().map_or(u64::MAX, |it| it.saturating_sub(1))
    }

    /// Returns for each failure whether an observer works that raises a flag of it, or of a row for
    /// which it is taken.
    fn watched(&self, robot: &Robot) -> Vec<bool> {
        let broken = self.broken(robot);
        let is_watched =
            |row: usize| robot.failures.get(row).is_some_and(|it| is_watched(robot, it, broken));
        let all = self.all.iter().map(|it| match self.taken(it) {
            Some(rows) => rows.iter().any(|it| is_watched(*it)),
            None => is_watched(it.number),
        });
        all.collect()
    }

    /// Observers look for so many periods in which they see nothing new.
    pub(crate) fn look_on(&mut self, robot: &Robot, place: Where, periods: u64) {
        let (watched, period) = (self.watched(robot), self.period.0);
        let open = self.all.iter_mut().zip(watched).filter(|it| !it.0.over && !it.0.found);
        for (it, is_watched) in open {
            let Some(row) = robot.failures.get(it.number) else { continue };
            if is_shown(robot, it, row, place) {
                it.shown.0 += period * periods;
                it.seen.0 += if is_watched { period * periods } else { 0 };
                let late = it.shown.0.saturating_sub(row.latency.0);
                self.unseen = self.unseen.max(Millis(late));
            }
        }
    }

    /// When the next failure changes by itself: it ends, or the micro-controller hears nothing.
    pub(crate) fn changes(&self, robot: &Robot, now: Millis) -> Option<Millis> {
        let times = self.open(robot).flat_map(|(it, row)| {
            let silent = matches!(row.motion, Motion::Silent | Motion::Mindless);
            let ends = row.ends.map(|time| it.since.0 + time.0);
            let stops = it.since.0 + FIRMWARE_WATCHDOG.0;
            [ends, (silent && stops > now.0).then_some(stops)]
        });
        times.flatten().min().map(Millis)
    }
}

/// Whether flags show a failure now: what shows in motion alone does where the robot is to move,
/// and a silent operator where he is waited for.
fn is_shown(robot: &Robot, it: &Failure, row: &robots::Failure, place: Where) -> bool {
    let is_shown_by_motion = matches!(row.motion, Motion::Blocked | Motion::Slowed(_));
    let waits = place == Where::Waits || mode(robot, place) == Some(Mode::Operator);
    if row.unanswered && !waits {
        return false;
    }
    let is_seen = row.unseen.is_none() && !row.flags.is_empty();
    let is_measured = it.drawn.is_some_and(|it| it.after.is_some());
    (is_seen || is_measured) && (!is_shown_by_motion || moves(robot, place))
}

/// Whether an observer that raises a flag of a failure works.
fn is_watched(robot: &Robot, row: &robots::Failure, broken: Parts) -> bool {
    let available = robot.available(broken);
    let works = |observer: usize| {
        robot.observers.get(observer).is_some_and(|it| {
            it.needs.modules & !available == 0 && it.needs.hardware & broken.hardware == 0
        })
    };
    robot.flags().enumerate().any(|(flag, of)| row.flags.contains(&flag) && works(of.0))
}

/// Whether the robot is to move where it is in its drive.
pub(crate) fn moves(robot: &Robot, place: Where) -> bool {
    let Where::Runs { configuration, .. } = place else { return false };
    robot.configurations.get(configuration).is_some_and(|it| it.speed.0 > 0)
}

/// The mode of the sub-objective that runs; `None` where none does.
pub(crate) fn mode(robot: &Robot, place: Where) -> Option<Mode> {
    let Where::Runs { sub_objective, .. } = place else { return None };
    robot.sub_objectives.get(sub_objective).map(|it| it.mode)
}
