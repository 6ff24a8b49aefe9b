//! The floor that ships.

use crate::floor::Floor;
use cotama_models::missions::MissionErrors;

/// A file that ships.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Embedded {
    /// Name of the floor.
    pub name: &'static str,
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

/// An office floor of 30 m x 20 m: rooms, two corridors, glass, narrow doors, a docking station.
///
/// ```
/// let office = cotama_floor::embedded::OFFICE.floor().unwrap();
/// assert!(office.place("office B").is_some() && office.docks.len() == 1);
/// ```
pub const OFFICE: Embedded =
    Embedded { name: "office.toml", text: include_str!("../floors/office.toml") };
