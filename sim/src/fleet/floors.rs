//! The floors on which teams stand.

use cotama_floor::{Ground, Needs, embedded};
use cotama_models::robots::RobotFile;
use cotama_models::team::scenario::{Asked, Floor, Ways, usual};

/// Returns what the widest of the robots of a team needs of a floor.
pub fn needs<'r>(robots: impl IntoIterator<Item = &'r RobotFile>) -> Needs {
    let radius = |it: &RobotFile| u32::try_from(it.robot().body.as_ref()?.radius.0).ok();
    let widest = robots.into_iter().filter_map(radius).max();
    let usual = Needs::default();
    Needs { radius_m: widest.map_or(usual.radius_m, |it| f64::from(it) / 1_000.0), ..usual }
}

/// Plans the ways of a team of usual robots over a floor that ships; `None` where none has this
/// name.
///
/// ```
/// use cotama_models::team::scenario::Asked;
/// use cotama_sim::fleet::floors;
/// let places = ["hall", "lounge"].map(String::from).to_vec();
/// let asked = Asked { floor: "service".into(), places, ..Asked::default() };
/// let ways = floors::ways(asked).unwrap();
/// assert_eq!(ways.legs[0].as_ref().unwrap().length.0, 40_001);
/// ```
pub fn ways(asked: Asked) -> Option<Ways> {
    let file = embedded::named(&asked.floor)?;
    let floor = file.floor().ok()?;
    Some(Ground::Drawing(&floor).ways(file.name, file.text, asked, needs([&usual()])))
}

/// Draws the places and ways of a team on a floor that ships; lengths stay.
pub(super) fn drawn(floor: Floor, on: &str) -> Floor {
    match ways(floor.asked_on(on)) {
        Some(ways) => floor.drawn_on(ways),
        None => floor,
    }
}
