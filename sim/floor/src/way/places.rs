//! Places of a floor by their names, and ways between them in the words of missions.

use crate::floor::{Floor, metres};
use crate::geometry::Point;
use crate::path::Path;
use crate::route::RouteError;
use cotama_core::units::Millimetres;
use cotama_models::missions::{Leg, NoLeg, Refusal};
use cotama_models::reading::{quoted, unknown};

/// Says why there is no way.
pub(crate) fn no_path(
    why: RouteError,
    floor: Option<&Floor>,
    [from, to]: [&str; 2],
    radius_m: f64,
    who: &str,
) -> NoLeg {
    let mm = |it: f64| (it * 1_000.0).round();
    let no_room = |at: &str, room: f64| {
        // Less than the radius is free, also when it is rounded.
        let (radius, room, at) = (mm(radius_m), (room * 1_000.0).floor(), quoted(at));
        let message =
            format!("a {who} of {radius} mm radius has no room at {at}: {room} mm are free");
        NoLeg::Path { message, closed: Vec::new() }
    };
    match why {
        RouteError::Start(room) => no_room(from, room),
        RouteError::Goal(room) => no_room(to, room),
        RouteError::None(_) => {
            let closed = floor.into_iter().flat_map(|it| &it.doors).filter(|it| !it.is_open);
            let closed = closed.map(|it| it.name.clone()).collect();
            let [from, to] = [from, to].map(quoted);
            let message = format!("nothing leads from {from} to {to} for this {who}");
            NoLeg::Path { message, closed }
        }
        RouteError::Needs(_) | RouteError::Field(_) => NoLeg::Floor(Refusal::new(why.to_string())),
    }
}

/// The place of this name, or at `X,Y` in mm.
pub(crate) fn place(floor: Option<&Floor>, name: &str) -> Result<Point, Refusal> {
    if let Some(it) = floor.and_then(|it| it.place(name)) {
        return Ok(metres(it.at));
    }
    let numbers = name.split_once(',').map(|(x, y)| (x.trim().parse::<i32>(), y.trim().parse()));
    if let Some((Ok(x), Ok(y))) = numbers {
        return Ok(metres([x, y]));
    }
    let Some(floor) = floor else {
        let it = Refusal::new(format!("{} is no place of a map", quoted(name)));
        return Err(it.help("write X,Y in mm, as 1500,-2000"));
    };
    Err(known("place", name, floor.places.iter().chain(&floor.docks).map(|it| it.name.as_str())))
}

pub(super) fn known<'n>(
    what: &str,
    name: &str,
    all: impl Iterator<Item = &'n str> + Clone,
) -> Refusal {
    let (message, help) = unknown(what, name, all);
    Refusal::new(message).help(help)
}

/// Returns a way in mm.
pub(crate) fn leg(path: &Path) -> Leg {
    let mm = |it: f64| (it * 1_000.0).round() as i32;
    let points = path.points().iter().map(|it| [mm(it.x), mm(it.y)]).collect();
    Leg { points, length: Millimetres(path.length_mm()) }
}
