//! The way of a mission over a floor: answers to the names that the mission says.

use crate::floor::{Floor, Version};
use crate::geometry::Point;
use crate::grid::Grid;
use crate::path::Path;
use crate::route::{Needs, Planner};
use crate::surface::Surface;
use cotama_models::missions::{Asked, Leg, NoLeg, Refusal, Way};
use places::{known, leg, no_path, place};
use std::ops::Range;

pub(crate) mod places;
mod walks;

pub use walks::PERSON_RADIUS_M;

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
    /// let none = way.legs[1].as_ref().unwrap_err().refusal("open").unwrap();
    /// assert_eq!(none.message, "unknown place `attic`");
    /// assert_eq!(way.zones, [Ok(vec![8_304..10_462])]);
    /// ```
    pub fn way(self, source: &str, text: &str, asked: Asked, needs: Needs) -> Way {
        let answer = match self {
            Self::Drawing(floor) => of_drawing(floor, &asked, needs),
            Self::Map(grid) => of_map(grid, &asked, needs),
        };
        let Answer { start, doors, paths, zones, people } = answer;
        // A map is held as its cells: its own text names an image, which is another file.
        let text = match self {
            Self::Drawing(_) => text.into(),
            Self::Map(grid) => grid.to_text().into(),
        };
        let legs = paths.into_iter().map(|it| it.map(|it| leg(&it))).collect();
        Way { source: source.to_owned(), text, asked, start, doors, legs, zones, people }
    }
}

impl Floor {
    /// Returns the floor with these doors open, and those closed.
    ///
    /// ```
    /// use cotama_floor::embedded::OFFICE;
    /// let office = OFFICE.floor().unwrap();
    /// let names = |name: &str| vec![name.to_owned()];
    /// let open = office.with_doors(&names("door D"), &[]).unwrap();
    /// assert_eq!(open.doors.iter().filter(|it| !it.is_open).count(), 0);
    /// let none = office.with_doors(&[], &names("dor D")).unwrap_err();
    /// assert!(none.message.starts_with("unknown door `dor D`; did you mean"));
    /// ```
    ///
    /// # Errors
    /// When it has no door of such a name.
    pub fn with_doors(&self, open: &[String], close: &[String]) -> Result<Self, Refusal> {
        let mut floor = self.clone();
        let all = open.iter().map(|it| (it, true));
        for (name, is_open) in all.chain(close.iter().map(|it| (it, false))) {
            let Some(door) = floor.doors.iter_mut().find(|it| it.name == *name) else {
                return Err(known("door", name, floor.doors.iter().map(|it| it.name.as_str())));
            };
            door.is_open = is_open;
        }
        Ok(floor)
    }
}

/// The answer to the names, with paths in metres.
struct Answer {
    start: Result<(), Refusal>,
    doors: Result<Vec<String>, Refusal>,
    paths: Vec<Result<Path, NoLeg>>,
    zones: Vec<Result<Vec<Range<u64>>, Refusal>>,
    people: Vec<Vec<Result<Leg, NoLeg>>>,
}

fn of_drawing(floor: &Floor, asked: &Asked, needs: Needs) -> Answer {
    let (floor, doors) = match floor.with_doors(&asked.open, &asked.close) {
        Ok(it) => {
            let names = it.doors.iter().map(|it| it.name.clone()).collect();
            (it, Ok(names))
        }
        Err(why) => (floor.clone(), Err(why)),
    };
    let paths = match floor.surface(Version::Charted, &[]) {
        Ok(surface) => paths(&surface, Some(&floor), asked, needs),
        Err(why) => none(asked, &why.to_string()),
    };
    let zone = |name: &String| match floor.zones.iter().find(|it| it.name == *name) {
        Some(zone) => Ok(spans(&zone.corners(), &paths)),
        None => Err(known("zone", name, floor.zones.iter().map(|it| it.name.as_str()))),
    };
    let zones = asked.zones.iter().map(zone).collect();
    let people = if asked.people.is_empty() {
        Vec::new()
    } else {
        match floor.surface(Version::Real, &[]) {
            Ok(surface) => walks::all(&surface, Some(&floor), asked, needs.radius_m),
            Err(why) => walks::none(asked, &why.to_string()),
        }
    };
    let start = place(Some(&floor), &asked.from).map(|_| ());
    Answer { start, doors, paths, zones, people }
}

fn of_map(grid: &Grid, asked: &Asked, needs: Needs) -> Answer {
    let doors = if asked.open.is_empty() && asked.close.is_empty() {
        Ok(Vec::new())
    } else {
        Err(Refusal::new("a map has no doors").help("leave them out"))
    };
    let zone = |_| Err(Refusal::new("a map has no zones").help("give `x_start_mm` and `x_end_mm`"));
    let zones = asked.zones.iter().map(zone).collect();
    let paths = paths(grid, None, asked, needs);
    let people = walks::all(grid, None, asked, needs.radius_m);
    Answer { start: place(None, &asked.from).map(|_| ()), doors, paths, zones, people }
}

/// No path to any place, for one reason.
fn none(asked: &Asked, why: &str) -> Vec<Result<Path, NoLeg>> {
    vec![Err(NoLeg::Floor(Refusal::new(why))); asked.to.len()]
}

/// The paths between the places, each from the one before; after one that fails the next begin at
/// its goal.
fn paths(
    surface: &dyn Surface,
    floor: Option<&Floor>,
    asked: &Asked,
    needs: Needs,
) -> Vec<Result<Path, NoLeg>> {
    let planner = match Planner::new(surface, needs) {
        Ok(it) => it,
        Err(why) => return none(asked, &why.to_string()),
    };
    let from = std::iter::once(&asked.from).chain(&asked.to);
    let path = |(from, to): (&String, &String)| {
        let goal = place(floor, to).map_err(NoLeg::Goal)?;
        let start = place(floor, from).map_err(|_| NoLeg::Start)?;
        let refused = |why| no_path(why, floor, [from, to], needs.radius_m, "robot");
        planner.route(start, goal).map_err(refused)
    };
    from.zip(&asked.to).map(path).collect()
}

/// The parts of all paths, one after the other, inside a polygon: in mm.
fn spans(corners: &[Point], paths: &[Result<Path, NoLeg>]) -> Vec<Range<u64>> {
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
