//! Faults of a run: the script of a mission file's `[run]`, or of a `panorama-faults/1` file.

use crate::robots;
use cotama_core::units::{Millimetres, Millis};

mod recorded;

pub use recorded::{Adapts, Ending, Expected, FIDELITIES, FaultsFile, OUTCOMES, PlannedBy};

/// The format that a file of faults must name.
pub const FORMAT: &str = "panorama-faults/1";

/// How a mission is run by a simulator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Margins are checked every such period.
    pub monitor_period: Millis,
    /// The seed of its random numbers, where none is given.
    pub seed: u64,
    /// The file of margins that are held back for what remains, where one is named.
    pub margins: Option<String>,
    /// The faults.
    pub faults: Faults,
}

impl Default for Run {
    fn default() -> Self {
        Self { monitor_period: Millis(1000), seed: 0, margins: None, faults: Faults::default() }
    }
}

/// The faults and events of a run.
///
/// ```
/// use cotama_core::units::Millimetres;
/// use cotama_models::missions::faults::{EventKind, Faults};
/// use cotama_models::missions::{Mission, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let text = "format = 'panorama-faults/1'
/// event = [{ x_mm = 60_000, kind = 'fault', hardware = 'laser', units_lost = 1 }]";
/// let faults = Faults::parse("faults.toml", text, &mission).unwrap();
/// assert_eq!(faults.events[0].x, Millimetres(60_000));
/// assert_eq!(faults.events[0].kind, EventKind::Fault { hardware: 1, units: 1 });
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// By how much the real power differs from the modelled one, by zone.
    pub power_errors: Vec<PowerError>,
    /// The events at given places, sorted by place.
    pub events: Vec<Event>,
    /// The random events, which occur anywhere.
    pub random: Vec<RandomEvent>,
    /// The incidents that the supervisors of a mission's robot have to deal with, sorted by moment;
    /// in files these are events of the kinds `failure`, `repair` and `operator`. A plan knows
    /// nothing of them.
    pub of_robot: Vec<robots::Incident>,
}

/// By how much the real power differs from the modelled one inside a zone, whatever the robot does
/// there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PowerError {
    /// The index of the zone.
    pub zone: usize,
    /// The difference, in parts per thousand of the modelled power.
    pub permille: i32,
}

/// Something that happens once, at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Position along the path.
    pub x: Millimetres,
    /// The kind of the event.
    pub kind: EventKind,
}

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// Something stands in the way: the robot waits at the power of rest, with the hardware of the
    /// current alternative on.
    Obstacle {
        /// The time lost.
        delay: Millis,
    },
    /// Hardware fails.
    Fault {
        /// The index of the hardware.
        hardware: usize,
        /// How many units are lost.
        units: u8,
    },
    /// Hardware works again.
    Repair {
        /// The index of the hardware.
        hardware: usize,
        /// How many units are back.
        units: u8,
    },
    /// The position was wrong: so much more path to drive before going on at the same place, known
    /// from then on.
    Odometry {
        /// The additional path.
        extra: Millimetres,
    },
}

/// Something that happens at random places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomEvent {
    /// Name of the event, which also names its stream of random numbers.
    pub name: String,
    /// The number expected on 1000 m of path.
    pub per_km: u16,
    /// The kind of the event: an obstacle or a wrong odometry.
    pub kind: EventKind,
}
