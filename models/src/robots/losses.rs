//! Reports of failures, and the losses that make a difference.

use super::supervisors::word;
use super::{
    Failure, MAX_LOSSES, MAX_REPORTS, Mask, Mode, Parts, Restarts, Robot, Setting, Try, members,
};
use crate::severity::Severity;

/// A loss that stays: the parts that are gone with a failure, as far as some configuration or the
/// link to the operator needs them. Failures that take the same are one loss.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Name of the loss: that of the part lost.
    pub name: String,
    /// The modules that cannot be used any more.
    pub modules: u64,
    /// Whether it can come back: a failure that takes it does not stay.
    pub returns: bool,
}

/// Report of a failure to the decisional level. Failures that take the same and are as severe
/// are one report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Name of the report: the short name of its first failure.
    pub name: String,
    /// Its failures, by number.
    pub failures: Vec<usize>,
    /// The loss that comes with it.
    pub loss: Option<usize>,
    /// How severe it is where the robot drives itself.
    pub autonomous: Severity,
    /// How severe it is where the operator does.
    pub operator: Severity,
    /// How often a module is started anew before it is told.
    pub restarts: Option<Restarts>,
    /// The setting that answers it.
    pub sets: Option<Setting>,
    /// How often the operator is asked first.
    pub asks: Option<u8>,
    /// The flags that are masked once it is told.
    pub masks: Option<Mask>,
    /// The reactions that are tried before it is told, in their order.
    pub tries: Vec<Try>,
}

/// All reports and losses of a robot, and what is left after each set of losses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Losses {
    /// The losses; a set of them has a bit each.
    pub losses: Vec<Loss>,
    /// The reports.
    pub reports: Vec<Report>,
    /// The rest after each set of losses.
    left: Vec<Left>,
}

/// Limit that is exceeded.
#[derive(Clone, Copy, Debug)]
pub(super) enum TooMany {
    /// More than [`MAX_LOSSES`] losses.
    Losses,
    /// More than [`MAX_REPORTS`] reports.
    Reports,
}

/// Rest after some losses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Left {
    /// The configurations that can run, a bit each.
    pub(super) running: u32,
    /// Whether the operator is reached.
    pub(super) reaches_operator: bool,
}

impl Report {
    /// Whether it is told as soon as it is known, and nothing is tried before.
    pub const fn is_told_at_once(&self) -> bool {
        self.tries.is_empty()
    }

    /// How severe it is in a mode.
    pub const fn severity(&self, mode: Mode) -> Severity {
        match mode {
            Mode::Autonomous => self.autonomous,
            Mode::Operator => self.operator,
        }
    }
}

impl Losses {
    /// The reports and losses of a robot.
    ///
    /// # Errors
    /// The position of the failure with one loss or one report too many, and which it is.
    pub(super) fn of(robot: &Robot) -> Result<Self, (usize, TooMany)> {
        let relevant = relevant(robot);
        let mut losses: Vec<Loss> = Vec::new();
        let mut reports: Vec<Report> = Vec::new();
        // What nothing shows is told by nobody.
        for (at, it) in robot.failures.iter().enumerate().filter(|it| it.1.unseen.is_none()) {
            let gone = gone(robot, it.loses);
            let loss = (gone & relevant != 0).then(|| {
                let known = losses.iter().position(|loss| (loss.modules ^ gone) & relevant == 0);
                known.unwrap_or_else(|| {
                    let name = name(robot, it, &losses);
                    losses.push(Loss { name, modules: gone, returns: false });
                    losses.len() - 1
                })
            });
            if let Some(loss) = loss.and_then(|it| losses.get_mut(it)) {
                loss.returns |= it.can_be_over();
            }
            if losses.len() > MAX_LOSSES {
                return Err((at, TooMany::Losses));
            }
            let same = |report: &&mut Report| {
                (report.loss, report.autonomous, report.operator, &report.sets)
                    == (loss, it.autonomous, it.operator, &it.sets)
                    && [report.restarts, it.restarts] == [None; 2]
                    && [report.asks, it.asks] == [None; 2]
                    && report.masks.is_none()
                    && it.masks.is_none()
            };
            match reports.iter_mut().find(same) {
                Some(report) => report.failures.push(at),
                None => reports.push(Report {
                    name: it.id.clone(),
                    failures: vec![at],
                    loss,
                    autonomous: it.autonomous,
                    operator: it.operator,
                    restarts: it.restarts,
                    sets: it.sets.clone(),
                    asks: it.asks,
                    masks: it.masks.clone(),
                    tries: it.tries.clone(),
                }),
            }
            if reports.len() > MAX_REPORTS {
                return Err((at, TooMany::Reports));
            }
        }
        let left = (0..1_u32 << losses.len()).map(|lost| left(robot, &losses, lost)).collect();
        Ok(Self { losses, reports, left })
    }

    /// Returns the rest after these losses.
    pub(super) fn after(&self, lost: u32) -> Left {
        debug_assert!((lost as usize) < self.left.len(), "losses of this robot");
        self.left.get(lost as usize).copied().unwrap_or_default()
    }

    /// Returns the report, by its number, as which a report is told to the contextual supervisor:
    /// the first one with which it shares loss and severities, and so every decision.
    pub fn told_as(&self, report: usize) -> usize {
        let key = |it: &Report| (it.loss, it.autonomous, it.operator);
        let own = self.reports.get(report).map(key);
        self.reports.iter().position(|it| Some(key(it)) == own).unwrap_or(report)
    }

    /// Returns the losses that can come back, a bit each.
    pub(super) fn returning(&self) -> u32 {
        let all = self.losses.iter().enumerate().filter(|it| it.1.returns);
        all.fold(0, |set, it| set | 1 << it.0)
    }

    /// Returns the set of all losses, a bit each.
    pub fn all(&self) -> u32 {
        (1 << self.losses.len()) - 1
    }
}

/// Returns the modules that cannot be used without these parts.
fn gone(robot: &Robot, loses: Parts) -> u64 {
    robot.available(Parts::NONE) & !robot.available(loses)
}

/// Returns the modules on which some configuration or the link to the operator depends, also since
/// an observer needs them without whom what he watches counts as lost.
fn relevant(robot: &Robot) -> u64 {
    let required = robot.configurations.iter().fold(0, |all, it| all | it.required);
    let watching = robot.observers.iter().filter(|it| it.closes);
    let watching = watching.fold(0, |all, it| all | it.needs.modules);
    let mut relevant = required | robot.operator.unwrap_or(0) | watching;
    loop {
        let needed = members(relevant).filter_map(|it| robot.modules.get(it));
        let all = needed.fold(relevant, |all, it| all | it.needs.modules | it.one_of);
        if all == relevant {
            return relevant;
        }
        relevant = all;
    }
}

/// Names a loss by the first part that a failure takes; a name that is taken, by the failure too.
fn name(robot: &Robot, failure: &Failure, losses: &[Loss]) -> String {
    let hardware = members(failure.loses.hardware).next().and_then(|it| robot.hardware.get(it));
    let module = members(failure.loses.modules).next().and_then(|it| robot.modules.get(it));
    let name = hardware.map(|it| &it.name).or(module.map(|it| &it.name));
    let name = name.unwrap_or(&failure.id);
    let is_taken = losses.iter().any(|it| word(&it.name) == word(name));
    if is_taken { format!("{name}_{}", failure.id) } else { name.clone() }
}

fn left(robot: &Robot, losses: &[Loss], lost: u32) -> Left {
    let lost = losses.iter().enumerate().filter(|it| lost >> it.0 & 1 == 1);
    let modules = lost.fold(0, |all, it| all | it.1.modules);
    let available = robot.usable(Parts { hardware: 0, modules });
    let runs = robot.configurations.iter().enumerate();
    let runs = runs.filter(|it| it.1.required & !available == 0);
    Left {
        running: runs.fold(0, |all, it| all | 1 << it.0),
        reaches_operator: robot.operator.is_some_and(|link| link & !available == 0),
    }
}
