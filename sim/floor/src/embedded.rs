//! The floors that ship.

use crate::floor::Floor;
use cotama_models::missions::MissionErrors;

/// A file that ships.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Embedded {
    /// Name of the file.
    pub name: &'static str,
    /// The floor in a line.
    pub description: &'static str,
    /// Text of the file.
    pub text: &'static str,
}

impl Embedded {
    /// Reads the floor.
    ///
    /// # Errors
    /// None: a test reads it.
    pub fn floor(&self) -> Result<Floor, MissionErrors> {
        Floor::parse(self.name, self.text)
    }
}

/// The floor of this name, as missions and teams name it.
///
/// ```
/// use cotama_floor::embedded::{ALL, FLEET, named};
/// assert_eq!((named("fleet"), named("attic")), (Some(FLEET), None));
/// assert!(ALL.iter().all(|it| it.floor().is_ok()));
/// ```
pub fn named(name: &str) -> Option<Embedded> {
    ALL.into_iter().find(|it| it.name.strip_suffix(".toml") == Some(name))
}

/// All floors that ship.
pub const ALL: [Embedded; 4] = [OFFICE, CLINIC, SERVICE, FLEET];

/// An office floor of 30 m x 20 m: rooms, two corridors, glass, narrow doors, a docking station.
///
/// ```
/// let office = cotama_floor::embedded::OFFICE.floor().unwrap();
/// assert!(office.place("office B").is_some() && office.docks.len() == 1);
/// ```
pub const OFFICE: Embedded = Embedded {
    name: "office.toml",
    description: "An office floor: rooms, two corridors, glass, narrow doors, a dock",
    text: include_str!("../floors/office.toml"),
};

/// The floor of the drink service: a hall, a kitchen, a billiard room, a lounge far away.
pub const SERVICE: Embedded = Embedded {
    name: "service.toml",
    description: "The floor of the drink service: a hall, a kitchen, a billiard room, a lounge",
    text: include_str!("../floors/service.toml"),
};

/// The floor of the fleet: two corridors with forty-eight offices, and a secured wing.
pub const FLEET: Embedded = Embedded {
    name: "fleet.toml",
    description: "The floor of the fleet: two corridors with forty-eight offices",
    text: include_str!("../floors/fleet.toml"),
};

/// A floor of a clinic of 72 m x 47 m: a corridor around a court, wards, a lift lobby, bays with a
/// docking station, a rack and a packing station, and QR marks.
///
/// From the dock to the rack, on to the packing station and back are 60 m each for a robot of
/// 260 mm, as in the mission `shift`.
///
/// ```
/// use cotama_floor::{Ground, Needs, embedded};
/// use cotama_models::missions::Asked;
/// let clinic = embedded::CLINIC.floor().unwrap();
/// let to = ["rack", "packing station", "dock"].map(str::to_owned).to_vec();
/// let asked = Asked { from: "dock".into(), to, ..Asked::default() };
/// let text = embedded::CLINIC.text;
/// let way = Ground::Drawing(&clinic).way("clinic", text, asked, Needs::default());
/// let lengths: Vec<_> = way.legs.iter().map(|it| it.as_ref().unwrap().length.0).collect();
/// assert_eq!(lengths, [60_000; 3]);
/// ```
pub const CLINIC: Embedded = Embedded {
    name: "clinic.toml",
    description: "A clinic: a corridor around a court, wards, a lift lobby, a dock, QR marks",
    text: include_str!("../floors/clinic.toml"),
};
