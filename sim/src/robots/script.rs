//! The script of a run: faults, doors, and what the operator answers.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError};
use cotama_models::robots::{Answer, Incident, IncidentKind, Moment, RobotFile};
use std::collections::VecDeque;

/// The faults of a run, and the answers of the operator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Script {
    /// Failures, each once.
    pub injections: Vec<Injection>,
    /// The operator's answers to requests, in their order; where there is none he has his habits.
    pub answers: Vec<Answers>,
    /// Doors of the floor that open or close.
    pub doors: Vec<DoorChange>,
    /// Obstacles, and positions that were wrong, sorted by place.
    pub events: Vec<Event>,
    /// By how much the real power differs from the modelled one, by zone.
    pub power_errors: Vec<PowerError>,
}

/// A door that is to open or to close.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DoorChange {
    /// The moment of the change.
    pub when: Moment,
    /// Number of the door, in the order of the floor's file.
    pub door: usize,
    /// Whether it opens.
    pub is_open: bool,
}

/// A failure that is to happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Injection {
    /// The moment of the failure.
    pub when: Moment,
    /// Number of the failure.
    pub failure: usize,
    /// When it ends, if not by itself.
    pub until: Option<Moment>,
}

impl Injection {
    /// A failure, by its number, that ends by itself or never.
    pub const fn new(when: Moment, failure: usize) -> Self {
        Self { when, failure, until: None }
    }
}

/// The answers of the operator to a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answers {
    /// To the first request from there on.
    pub x: Millimetres,
    /// The answers, one after the other.
    pub answers: VecDeque<Answer>,
    /// After how long each.
    pub delay: Millis,
}

impl From<&[Incident]> for Script {
    /// The failures and answers of a script.
    fn from(incidents: &[Incident]) -> Self {
        let mut script = Self::default();
        for incident in incidents {
            let when = incident.when;
            match &incident.kind {
                IncidentKind::Failure { failure, until } => {
                    script.injections.push(Injection { when, failure: *failure, until: *until });
                }
                IncidentKind::Repair(failure) => {
                    let open = |it: &&mut Injection| it.failure == *failure && it.until.is_none();
                    if let Some(it) = script.injections.iter_mut().rfind(open) {
                        it.until = Some(when);
                    }
                }
                IncidentKind::Door { door, is_open } => {
                    let (door, is_open) = (*door, *is_open);
                    script.doors.push(DoorChange { when, door, is_open });
                }
                IncidentKind::Operator { answers, delay } => {
                    let Moment::Place(x) = when else { continue };
                    let answers = answers.iter().copied().collect();
                    script.answers.push(Answers { x, answers, delay: *delay });
                }
            }
        }
        script
    }
}

impl Script {
    /// The failures, events and answers of a script of a mission. A fault of hardware is the
    /// failure of the robot's file that takes a unit of it, and nothing else; one that no failure
    /// takes is [passed over](Self::passed_over). So are random events.
    pub fn of(faults: &Faults, mission: &Mission) -> Self {
        let (events, power_errors) = (faults.events.clone(), faults.power_errors.clone());
        let mut script = Self { events, power_errors, ..Self::from(&faults.of_robot[..]) };
        for it in &faults.events {
            if let EventKind::Fault { hardware, units } = it.kind {
                let taken: Vec<_> = script.injections.iter().map(|it| it.failure).collect();
                let (when, until) = (Moment::Place(it.x), None);
                let all = units_of(mission, hardware).into_iter().filter(|it| !taken.contains(it));
                let all = all.take(usize::from(units));
                let all = all.map(|failure| Injection { when, failure, until });
                script.injections.extend(all);
            }
        }
        script
    }

    /// Returns how many of the faults of a script no robot's file says.
    pub fn passed_over(faults: &Faults, mission: &Mission) -> usize {
        let lost = |it: &&Event| match it.kind {
            EventKind::Fault { hardware, .. } => units_of(mission, hardware).is_empty(),
            EventKind::Repair { .. } => true,
            EventKind::Obstacle { .. } | EventKind::Odometry { .. } => false,
        };
        faults.events.iter().filter(lost).count() + faults.random.len()
    }
}

/// The failures that take one unit of a kind of hardware of a mission, and nothing else.
fn units_of(mission: &Mission, hardware: usize) -> Vec<usize> {
    let Some(robot) = mission.robot().map(RobotFile::robot) else { return Vec::new() };
    let Some(kind) = mission.hardware.get(hardware) else { return Vec::new() };
    let is_unit = |it: &cotama_models::robots::Failure| {
        let of = it.loses.hardware.trailing_zeros() as usize;
        it.loses.hardware.is_power_of_two()
            && it.loses.modules == 0
            && robot.hardware.get(of).is_some_and(|it| it.kind == kind.name)
    };
    (0..robot.failures.len()).filter(|it| robot.failures.get(*it).is_some_and(is_unit)).collect()
}
