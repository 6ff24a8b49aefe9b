//! The way of a mission over a floor: answers to the names that the mission says.

use crate::floor::{Floor, Version, metres};
use crate::geometry::Point;
use crate::grid::Grid;
use crate::path::Path;
use crate::route::{Needs, Planner, RouteError};
use crate::surface::Surface;
use cotama_core::units::Millimetres;
use cotama_models::missions::{Asked, Leg, Way};
use cotama_models::reading::{quoted, unknown};
use std::ops::Range;

/// A floor that missions go over.
#[derive(Clone, Copy, Debug)]
pub enum Ground<'f> {
    /// A drawing, with places, doors and zones that have names.
    Drawing(&'f Floor),
    /// A map; places are `X,Y` in mm.
    Map(&'f Grid),
}

impl Ground<'_> {
    /// Plans the way between the places that a mission asks for, one leg after the other. What
    /// cannot be answered says why: nothing else fails.
    ///
    /// ```
    /// use cotama_floor::{Ground, Needs, embedded};
    /// use cotama_models::missions::Asked;
    /// let office = embedded::OFFICE.floor().unwrap();
    /// let to = vec!["office B".to_owned(), "attic".to_owned()];
    /// let zones = vec!["corridor".to_owned()];
    /// let asked = Asked { from: "dock".into(), to, zones, ..Asked::default() };
    /// let text = embedded::OFFICE.text;
    /// let way = Ground::Drawing(&office).way("office", text, asked, Needs::default());
    /// assert_eq!(way.legs[0].as_ref().unwrap().length.0, 14_507);
    /// assert!(way.legs[1].as_ref().unwrap_err().starts_with("unknown place `attic`"));
    /// assert_eq!(way.zones, [Ok(vec![8_304..10_462])]);
    /// ```
    pub fn way(self, source: &str, text: &str, asked: Asked, needs: Needs) -> Way {
        let (drawing, doors) = match self {
            Self::Drawing(floor) => match with_doors(floor, &asked) {
                Ok(it) => (Some(it), Ok(())),
                Err(why) => (Some(floor.clone()), Err(why)),
            },
            Self::Map(_) if asked.open.is_empty() && asked.close.is_empty() => (None, Ok(())),
            Self::Map(_) => (None, Err("a map has no doors\n  help: leave them out".to_owned())),
        };
        let start = place(drawing.as_ref(), &asked.from);
        let paths = match &drawing {
            Some(floor) => match floor.surface(Version::Charted, &[]) {
                Ok(surface) => paths(&surface, Some(floor), &asked, needs),
                Err(why) => vec![Err(why.to_string()); asked.to.len()],
            },
            None => match self {
                Self::Map(grid) => paths(grid, None, &asked, needs),
                Self::Drawing(_) => vec![Err(String::new()); asked.to.len()],
            },
        };
        let zone = |name: &String| match &drawing {
            Some(floor) => match floor.zones.iter().find(|it| it.name == *name) {
                Some(zone) => Ok(spans(&zone.corners(), &paths)),
                None => Err(known("zone", name, floor.zones.iter().map(|it| it.name.as_str()))),
            },
            None => Err("a map has no zones\n  help: give `x_start_mm` and `x_end_mm`".to_owned()),
        };
        Way {
            source: source.to_owned(),
            text: text.into(),
            start: start.map(|_| ()),
            doors,
            zones: asked.zones.iter().map(zone).collect(),
            legs: paths.iter().map(|it| it.as_ref().map(leg).map_err(Clone::clone)).collect(),
            asked,
        }
    }
}

/// The paths between the places, each from the one before; after one that fails the next begin at
/// its goal.
fn paths(
    surface: &dyn Surface,
    floor: Option<&Floor>,
    asked: &Asked,
    needs: Needs,
) -> Vec<Result<Path, String>> {
    let planner = match Planner::new(surface, needs) {
        Ok(it) => it,
        Err(why) => return vec![Err(why.to_string()); asked.to.len()],
    };
    let from = std::iter::once(&asked.from).chain(&asked.to);
    let path = |(from, to): (&String, &String)| {
        let goal = place(floor, to)?;
        // An unknown start is said where it stands.
        let start = place(floor, from).map_err(|_| String::new())?;
        planner.route(start, goal).map_err(|why| said(why, floor, [from, to], needs))
    };
    from.zip(&asked.to).map(path).collect()
}

/// Says why there is no way.
fn said(why: RouteError, floor: Option<&Floor>, [from, to]: [&str; 2], needs: Needs) -> String {
    let mm = |it: f64| (it * 1_000.0).round();
    let no_room = |at: &str, room: f64| {
        let (radius, at) = (mm(needs.radius_m), quoted(at));
        format!("a robot of {radius} mm radius has no room at {at}: {} mm are free", mm(room))
    };
    match why {
        RouteError::Start(room) => no_room(from, room),
        RouteError::Goal(room) => no_room(to, room),
        RouteError::None(_) => {
            let closed = floor.into_iter().flat_map(|it| &it.doors).filter(|it| !it.is_open);
            let closed: Vec<_> = closed.map(|it| it.name.as_str()).collect();
            let message = format!("nothing leads from {} to {}", quoted(from), quoted(to));
            match &closed[..] {
                [] => message,
                all => {
                    format!("{message}\n  help: closed are {}: `open` opens one", all.join(", "))
                }
            }
        }
        other => other.to_string(),
    }
}

/// A drawing with doors opened and closed as it is asked for.
fn with_doors(floor: &Floor, asked: &Asked) -> Result<Floor, String> {
    let mut floor = floor.clone();
    let all = asked.open.iter().map(|it| (it, true));
    for (name, is_open) in all.chain(asked.close.iter().map(|it| (it, false))) {
        let Some(door) = floor.doors.iter_mut().find(|it| it.name == *name) else {
            return Err(known("door", name, floor.doors.iter().map(|it| it.name.as_str())));
        };
        door.is_open = is_open;
    }
    Ok(floor)
}

/// The place of this name, or at `X,Y` in mm.
fn place(floor: Option<&Floor>, name: &str) -> Result<Point, String> {
    if let Some(it) = floor.and_then(|it| it.place(name)) {
        return Ok(metres(it.at));
    }
    let numbers = name.split_once(',').map(|(x, y)| (x.trim().parse::<i32>(), y.trim().parse()));
    if let Some((Ok(x), Ok(y))) = numbers {
        return Ok(metres([x, y]));
    }
    let Some(floor) = floor else {
        let name = quoted(name);
        return Err(format!("{name} is no place of a map\n  help: write X,Y in mm, as 1500,-2000"));
    };
    Err(known("place", name, floor.places.iter().chain(&floor.docks).map(|it| it.name.as_str())))
}

fn known<'n>(what: &str, name: &str, all: impl Iterator<Item = &'n str> + Clone) -> String {
    let (message, help) = unknown(what, name, all);
    format!("{message}\n  help: {help}")
}

fn leg(path: &Path) -> Leg {
    let mm = |it: f64| (it * 1_000.0).round() as i32;
    let points = path.points().iter().map(|it| [mm(it.x), mm(it.y)]).collect();
    Leg { points, length: Millimetres(path.length_mm()) }
}

/// The parts of all paths, one after the other, inside a polygon: in mm.
fn spans(corners: &[Point], paths: &[Result<Path, String>]) -> Vec<Range<u64>> {
    let mut spans: Vec<Range<u64>> = Vec::new();
    let mut before = 0;
    for path in paths.iter().flatten() {
        let length = path.length_mm();
        for span in path.spans(corners) {
            let at = |it: f64| before + ((it * 1_000.0).round() as u64).min(length);
            let span = at(span.start)..at(span.end);
            match spans.last_mut() {
                Some(last) if last.end == span.start => last.end = span.end,
                _ if span.is_empty() => {}
                _ => spans.push(span),
            }
        }
        before += length;
    }
    spans
}
