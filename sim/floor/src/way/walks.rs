//! The ways of people between the places that a mission names.

use super::places::{leg, no_path, place};
use crate::floor::Floor;
use crate::geometry::Point;
use crate::route::{Needs, Planner, RouteError};
use crate::surface::Surface;
use cotama_core::units::Millimetres;
use cotama_models::missions::{Asked, Leg, NoLeg, Refusal};
use cotama_models::reading::quoted;

/// The radius of a person who walks on a way of a mission, in metres: half the breadth of a man's
/// shoulders with clothes (assumed).
pub const PERSON_RADIUS_M: f64 = 0.25;
/// Side of the cells in which ways of people are planned, in metres.
const CELL_M: f64 = 0.1;

type Walks = Vec<Vec<Result<Leg, NoLeg>>>;

/// No way for anybody, for one reason.
pub(super) fn none(asked: &Asked, why: &str) -> Walks {
    let none = |it: &Vec<String>| vec![Err(NoLeg::Floor(Refusal::new(why))); it.len()];
    asked.people.iter().map(none).collect()
}

/// Plans the way of each person to each place from the one before, and to the first from the last;
/// nobody begins where a robot of a radius starts.
pub(super) fn all(
    surface: &dyn Surface,
    floor: Option<&Floor>,
    asked: &Asked,
    robot_radius_m: f64,
) -> Walks {
    if asked.people.is_empty() {
        return Vec::new();
    }
    let needs = Needs { radius_m: PERSON_RADIUS_M, cell_m: CELL_M, ..Needs::default() };
    let planner = match Planner::new(surface, needs) {
        Ok(it) => it,
        Err(why) => return none(asked, &why.to_string()),
    };
    let start = place(floor, &asked.from).ok();
    let room_m = PERSON_RADIUS_M + robot_radius_m;
    let of = |places: &Vec<String>| {
        let before = places.last().into_iter().chain(places);
        let way = |(number, (from, to)): (usize, (&String, &String))| {
            let goal = place(floor, to).map_err(NoLeg::Goal)?;
            inside(surface, to, goal)?;
            if number == 0 {
                apart(to, goal, start, room_m)?;
            }
            if places.len() == 1 {
                return stands(surface, to, goal);
            }
            let from_at = place(floor, from).map_err(|_| NoLeg::Start)?;
            inside(surface, from, from_at).map_err(|_| NoLeg::Start)?;
            let refused = |why| match why {
                RouteError::Start(_) => NoLeg::Start, // said of the way that leads there
                // Said of the way there.
                RouteError::None(_) if number == 0 && places.len() == 2 => NoLeg::Start,
                why => no_path(why, floor, [from, to], PERSON_RADIUS_M, "person"),
            };
            planner.route(from_at, goal).map(|it| leg(&it)).map_err(refused)
        };
        let mut ways: Vec<_> = before.zip(places).enumerate().map(way).collect();
        if let [first @ Ok(_), second] = &mut ways[..] {
            *first = second.clone().map(back).map_err(|_| NoLeg::Start);
        }
        ways
    };
    asked.people.iter().map(of).collect()
}

/// The same way back.
fn back(mut leg: Leg) -> Leg {
    leg.points.reverse();
    leg
}

/// Refuses a place beside the floor.
fn inside(surface: &dyn Surface, name: &str, at: Point) -> Result<(), NoLeg> {
    let bounds = surface.bounds();
    let is_inside = at >= bounds.least && at <= bounds.most;
    if is_inside {
        return Ok(());
    }
    let it = Refusal::new(format!("the place {} is not on the floor", quoted(name)));
    let mm = |it: f64| (it * 1_000.0).round();
    let [left, low, right, high] =
        [bounds.least.x, bounds.least.y, bounds.most.x, bounds.most.y].map(mm);
    let help = format!("it reaches from {left},{low} to {right},{high}");
    Err(NoLeg::Goal(it.help(help)))
}

/// Refuses a first place where the robot starts.
fn apart(name: &str, at: Point, start: Option<Point>, room_m: f64) -> Result<(), NoLeg> {
    let Some(distance) = start.map(|it| (it - at).norm()).filter(|it| *it < room_m) else {
        return Ok(());
    };
    let mm = |it: f64| (it * 1_000.0).floor();
    let message = format!(
        "a person at {} stands where the robot starts: {} mm away, and both need {} mm",
        quoted(name),
        mm(distance),
        (room_m * 1_000.0).ceil()
    );
    Err(NoLeg::Goal(Refusal::new(message).help("let this person begin at another place")))
}

/// Returns the way of who stands in one place.
fn stands(surface: &dyn Surface, name: &str, at: Point) -> Result<Leg, NoLeg> {
    let room = surface.clearance(at, PERSON_RADIUS_M);
    if room < PERSON_RADIUS_M {
        let why = RouteError::Goal(room);
        return Err(no_path(why, None, [name, name], PERSON_RADIUS_M, "person"));
    }
    let mm = |it: f64| (it * 1_000.0).round() as i32;
    Ok(Leg { points: vec![[mm(at.x), mm(at.y)]], length: Millimetres(0) })
}
