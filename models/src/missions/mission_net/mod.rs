//! The global supervisor of a mission, made from its objectives.
//!
//! For two drives with an object received between them and delivered at the end, it is
//! [`global`](crate::cotama::global) up to the names of places and transitions. [`check`] looks at
//! every marking before the robot moves.
//!
//! ```
//! use cotama_models::missions::mission_net::{check, global_supervisor};
//! use cotama_models::missions::{Mission, embedded};
//!
//! let delivery = embedded::mission("delivery").unwrap();
//! let mission = Mission::parse(delivery.name, delivery.text).unwrap();
//! let mut net = global_supervisor(&mission.objectives).unwrap();
//! assert_eq!(check(&net.view().net(), &mission.objectives).unwrap().markings, 8);
//!
//! // Delivered, and again from the start.
//! net.transitions[4].give[0].place = net.transitions[0].take[0].place;
//! let faults = check(&net.view().net(), &mission.objectives).unwrap_err();
//! assert_eq!(faults[0].to_string(), "`Deliver` could block: from there `Done` is out of reach");
//! ```

mod checked;

pub use checked::{Explored, Fault, check};

use crate::missions::definition::{Does, Objective};
use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, NetError, OutputId, PlaceId};

/// The place before the objectives: no mission yet.
pub const WAIT: &str = "Wait";
/// The place behind them: the mission is accomplished.
pub const DONE: &str = "Done";
/// The place of stopping for good.
pub const SECURITY: &str = "Security";
/// The place of having stopped for good, alarm given.
pub const SAFE: &str = "Safe";
/// The names that no objective may have.
pub const RESERVED: [&str; 4] = [WAIT, DONE, SECURITY, SAFE];

/// The most objectives of one supervisor: their places and the others fit the words of a marking
/// that is checked.
pub const MAX_OBJECTIVES: usize = 250;

/// Why there is no supervisor of these objectives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MissionNetError {
    /// There is no objective.
    Empty,
    /// There are more than [`MAX_OBJECTIVES`].
    TooMany {
        /// Number of objectives.
        objectives: usize,
    },
    /// The kind of an objective is missing: the mission is not supervised.
    NotSupervised {
        /// Position of the objective.
        objective: usize,
    },
    /// An objective has the name of another one, or one of [`RESERVED`].
    Name {
        /// Position of the objective.
        objective: usize,
    },
    /// Ids cannot count the parts of the net.
    TooLong,
}

impl std::fmt::Display for MissionNetError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Empty => f.write_str("there is no objective to supervise"),
            Self::TooMany { objectives } => {
                write!(f, "{objectives} objectives; one supervisor has at most {MAX_OBJECTIVES}")
            }
            Self::NotSupervised { objective } => {
                write!(
                    f,
                    "objective {objective} does not say what it does: its mission is not supervised"
                )
            }
            Self::Name { objective } => {
                write!(f, "the name of objective {objective} is taken in its supervisor")
            }
            Self::TooLong => f.write_str("the supervisor has more parts than ids can count"),
        }
    }
}

impl std::error::Error for MissionNetError {}

impl From<NetError> for MissionNetError {
    fn from(_: NetError) -> Self {
        Self::TooLong // adding to a net fails for no other reason
    }
}

/// The events of a global supervisor, in the order of [`global`](crate::cotama::global), and that
/// of waiting.
const EVENTS: [(&str, &str); 7] = [
    ("global_event", "The objective cannot be managed, or goes on without a vital part."),
    ("drive_done", "The drive has reached its goal."),
    ("mission_received", "The operator gives a mission."),
    ("object_received", "The object is on board."),
    ("object_delivered", "The object has been handed over."),
    ("stopped", "The robot stands."),
    ("wait_over", "The time to wait is over."),
];

/// The outputs, in the order of [`global`](crate::cotama::global).
const OUTPUTS: [&str; 5] = ["start_drive", "gs_abort", "halt", "alarm", "wifi_warning"];

const GLOBAL_EVENT: EventId = EventId(0);
const MISSION_RECEIVED: EventId = EventId(2);
const STOPPED: EventId = EventId(5);
const START_DRIVE: OutputId = OutputId(0);
/// Outputs emitted on entering security: the drive is aborted, and motion is over.
const HALT: [OutputId; 2] = [OutputId(1), OutputId(2)];
/// Outputs emitted once the robot stands.
const WARN: [OutputId; 2] = [OutputId(3), OutputId(4)];

/// The event with which an objective ends.
const fn ends_with(does: Does) -> EventId {
    match does {
        Does::Drive => EventId(1),
        Does::Receive => EventId(3),
        Does::Deliver => EventId(4),
        Does::Wait | Does::Own(_) => crate::cotama::WAIT_OVER,
    }
}

/// Returns the kind of each objective, in their order.
fn kinds(objectives: &[Objective]) -> Result<Vec<Does>, MissionNetError> {
    let kind = |(objective, it): (usize, &Objective)| {
        it.does.as_ref().map(|does| does.value).ok_or(MissionNetError::NotSupervised { objective })
    };
    objectives.iter().enumerate().map(kind).collect()
}

/// The global supervisor of these objectives (Durand et al., TAROS 2010, Section V.C.1): one place
/// each, one after the other, and from wherever the mission is to security on a global event.
///
/// The events and outputs are those of [`global`](crate::cotama::global); a mission in which the
/// robot waits has `wait_over` as well.
///
/// # Errors
/// [`MissionNetError`]: objectives of a plain mission, none or too many of them, a name twice.
///
/// ```
/// use cotama_models::missions::mission_net::{MissionNetError, global_supervisor};
/// use cotama_models::missions::{Mission, embedded};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let net = global_supervisor(&mission.objectives).unwrap();
/// assert_eq!((net.places.len(), net.transitions.len()), (8, 12));
/// assert_eq!(global_supervisor(&[]), Err(MissionNetError::Empty));
/// ```
pub fn global_supervisor(objectives: &[Objective]) -> Result<OwnedNet, MissionNetError> {
    if objectives.is_empty() {
        return Err(MissionNetError::Empty);
    }
    if objectives.len() > MAX_OBJECTIVES {
        return Err(MissionNetError::TooMany { objectives: objectives.len() });
    }
    let kinds = kinds(objectives)?;
    let mut names = std::collections::BTreeSet::from(RESERVED);
    if let Some(objective) = objectives.iter().position(|it| !names.insert(&it.id)) {
        return Err(MissionNetError::Name { objective });
    }

    let mut net =
        OwnedNet::new("global", "Global supervisor of a mission: which objective, or security.");
    let waits = kinds.contains(&Does::Wait);
    for (name, doc) in EVENTS.iter().filter(|(name, _)| waits || *name != "wait_over") {
        net.event(name, doc)?;
    }
    for name in OUTPUTS {
        net.output(name, "")?;
    }
    let mut place = |name: &str, doc: &str| {
        net.place(OwnedPlace::new(name, u32::from(name == WAIT)).at_most(1).doc(doc))
    };
    let mut mission = vec![place(WAIT, "No mission yet.")?];
    for (objective, does) in objectives.iter().zip(&kinds) {
        mission.push(place(&objective.id, &format!("The objective that does `{}`.", does.name()))?);
    }
    mission.push(place(DONE, "The mission is accomplished.")?);
    let security = place(SECURITY, "Stopping for good.")?;
    let safe = place(SAFE, "Stopped for good, alarm given.")?;

    let ends = [MISSION_RECEIVED].into_iter().chain(kinds.iter().copied().map(ends_with));
    let starts = kinds.iter().map(|&does| does == Does::Drive).chain([false]);
    for (number, ((way, event), drives)) in mission.windows(2).zip(ends).zip(starts).enumerate() {
        let mut step = go(&format!("g{}", number + 1), event, way[0], way[1]);
        step.emits.extend(drives.then_some(START_DRIVE));
        net.transition(step)?;
    }
    for &from in &mission {
        let name = format!("abort{}", from.0 + 1);
        let emits = HALT.to_vec();
        net.transition(OwnedTransition { emits, ..go(&name, GLOBAL_EVENT, from, security) })?;
    }
    net.transition(OwnedTransition {
        emits: WARN.to_vec(),
        ..go("secured", STOPPED, security, safe)
    })?;

    net.ignored = [security, safe].map(|place| OwnedIgnored::new(GLOBAL_EVENT, place)).to_vec();
    let everywhere = mission.iter().chain([&security, &safe]);
    let sum = everywhere.map(|&place| Arc { place, weight: 1 }).collect();
    net.laws.push(OwnedLaw::Invariant { sum, equals: 1 });
    net.laws.push(OwnedLaw::AlwaysCan(safe));
    net.laws.extend(mission.iter().skip(1).map(|&place| OwnedLaw::Reachable(place)));
    net.laws.push(OwnedLaw::DeadlockFree { end: Some(safe) });
    net.laws.push(OwnedLaw::Deterministic);
    Ok(net)
}

fn go(name: &str, on: EventId, from: PlaceId, to: PlaceId) -> OwnedTransition {
    OwnedTransition::new(name).on(on).take(from, 1).give(to, 1)
}
