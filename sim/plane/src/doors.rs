//! The doors of a floor in a run: as they stand, and as the robot knows them.

use crate::course::Course;
use crate::track::{Near, Rest, Track};
use cotama_devices::Disc;
use cotama_floor::{Floor, Held, Needs, Planner, Point, Version};
use cotama_models::missions::Leg;

/// The way ahead along its path on which a robot sees a leaf, in metres.
const SIGHT: f64 = 4.0;
/// The room that a leaf leaves beside a robot that brakes, in metres.
const ROOM: f64 = 0.1;
/// Steps in which a path is held against a leaf, in metres.
const STEP: f64 = 0.05;
/// The room that a new path needs less than one of the mission, in metres: its points are whole mm.
const ROUNDED: f64 = 0.005;

/// The doors of a floor in a run.
#[derive(Clone, Debug)]
pub(crate) struct Doors {
    real: Floor,
    known: Floor,
    /// Whether each is open as the mission has it.
    planned: Vec<bool>,
    /// Doors that wait until the robot is out of their way, and whether they open.
    waiting: Vec<(usize, bool)>,
}

impl Doors {
    /// The doors as the mission has them; `None` of a map.
    pub(crate) fn of(course: &Course) -> Option<Self> {
        let way = course.way();
        let floor = Floor::parse(&way.source, &way.text).ok()?;
        let floor = floor.with_doors(&way.asked.open, &way.asked.close).ok()?;
        let planned = floor.doors.iter().map(|it| it.is_open).collect();
        Some(Self { known: floor.clone(), real: floor, planned, waiting: Vec::new() })
    }

    /// Lets a door open or close as soon as its leaf does not come too near to the robot.
    pub(crate) fn ask(&mut self, door: usize, is_open: bool) {
        self.waiting.retain(|it| it.0 != door);
        self.waiting.push((door, is_open));
    }

    /// Opens and closes doors that leave room to a robot, which is as large as it needs to brake,
    /// and to people; returns the floor if something changes.
    pub(crate) fn change(&mut self, robot: &Disc, people: &[Disc]) -> Option<Held> {
        let is_far = |leaf: Option<[Point; 2]>| {
            leaf.is_none_or(|leaf| {
                let room = |it: &Disc| distance(leaf, it.centre) - it.radius;
                room(robot) > ROOM && people.iter().all(|it| room(it) > 0.0)
            })
        };
        let (mut changed, doors) = (false, &mut self.real.doors);
        self.waiting.retain(|(door, is_open)| {
            let Some(it) = doors.get_mut(*door).filter(|it| is_far(it.leaf(*is_open))) else {
                return true;
            };
            changed |= it.is_open != *is_open;
            it.is_open = *is_open;
            false
        });
        changed.then(|| drawn(&self.real, Version::Real)).flatten()
    }

    /// Returns the leaves of doors that stand otherwise than the mission has them.
    pub(crate) fn moved(&self) -> Vec<[Point; 2]> {
        let moved = self.real.doors.iter().zip(&self.planned).filter(|it| it.0.is_open != *it.1);
        moved.filter_map(|it| it.0.leaf(it.0.is_open)).collect()
    }

    /// Returns the door that the robot sees to stand otherwise than it knows, in the way of a disc
    /// of a radius.
    pub(crate) fn met(&self, track: &Track, near: Near, radius: f64) -> Option<usize> {
        let is_in_way = |it: &usize| {
            let doors = [&self.real, &self.known].map(|floor| floor.doors.get(*it));
            let [Some(real), Some(known)] = doors else { return false };
            let leaf = real.leaf(real.is_open).filter(|_| real.is_open != known.is_open);
            leaf.is_some_and(|leaf| crosses(track, near, near.along + SIGHT, leaf, radius))
        };
        (0..self.real.doors.len()).find(is_in_way)
    }

    /// Knows from now on how a door stands.
    pub(crate) fn learn(&mut self, door: usize) {
        if let (Some(known), Some(real)) =
            (self.known.doors.get_mut(door), self.real.doors.get(door))
        {
            known.is_open = real.is_open;
        }
    }

    /// Plans the rest of the path past a leaf that is known: what each leg is from a place of the
    /// track on, whose ends lie at these lengths along it. `None` if nothing leads to the goal of
    /// the first.
    pub(crate) fn around(
        &self,
        door: usize,
        course: &Course,
        near: Near,
        ends: &[f64],
    ) -> Option<Vec<Rest>> {
        let door = self.known.doors.get(door)?;
        let leaf = door.leaf(door.is_open);
        let radius_m = course.drivetrain().footprint.radius() + crate::drivetrain::SPARE - ROUNDED;
        let clearance = course.way().asked.clearance;
        let needs = Needs { radius_m, ..Needs::default() }.beyond(clearance);
        let charted = drawn(&self.known, Version::Charted)?;
        let real = drawn(&self.known, Version::Real)?;
        let planners = [&charted, &real].map(|it| Planner::new(it.surface(), needs).ok());
        let [Some(charted), Some(as_it_is)] = planners else { return None };
        let track = course.track();
        let (mut from, mut rests) = (near, Vec::new());
        for end in ends {
            let kept = track.part(from, *end);
            let goal = kept.corners.last().map(|it| it.0)?;
            let start = track.pose(from.piece, from.along).translation.vector.into();
            let is_blocked =
                leaf.is_some_and(|it| crosses(track, from, *end, it, radius_m - ROUNDED));
            from = track.at(*end);
            if !is_blocked {
                rests.push(kept);
                continue;
            }
            let planned = charted.route(start, goal).ok();
            // Led around what is on no map, as the path of the mission is.
            let is_free = |it: &cotama_floor::Path| {
                let points: Vec<_> = it.points().iter().map(crate::course::in_mm).collect();
                crate::course::is_free(&points, real.surface(), course.drivetrain())
            };
            let planned = planned.filter(is_free).or_else(|| as_it_is.route(start, goal).ok());
            match planned {
                Some(path) => rests.push(Rest::of(path.points(), |at| course.is_tight(at))),
                None if rests.is_empty() => return None,
                // The robot comes there later, and sees.
                None => rests.push(kept),
            }
        }
        Some(rests)
    }
}

/// Returns the floor as it is drawn.
fn drawn(floor: &Floor, version: Version) -> Option<Held> {
    Some(Held::Drawing(Box::new(floor.surface(version, &[]).ok()?)))
}

/// Whether a disc that follows a track up to a length touches a leaf.
fn crosses(track: &Track, from: Near, to: f64, leaf: [Point; 2], radius: f64) -> bool {
    let (mut along, mut piece, to) = (from.along, from.piece, to.min(track.length()));
    loop {
        let there = track.pose(piece, along).translation.vector;
        if distance(leaf, there.into()) < radius {
            return true;
        }
        if along >= to {
            return false;
        }
        along = (along + STEP).min(to);
        while track.end(piece).0 < along && piece + 2 < track.corners().len() {
            piece += 1;
        }
    }
}

/// Returns the distance of a point from a leaf.
fn distance([from, to]: [Point; 2], at: Point) -> f64 {
    let way = to - from;
    let part = ((at - from).dot(&way) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (from + way * part - at).norm()
}

/// The lengths along a track at which legs of a mission end, from one that is under way on.
pub(crate) fn ends(legs: &[Leg], x: f64) -> Vec<f64> {
    let mut end = 0.0;
    let ends = legs.iter().map(|it| {
        end += it.length.0 as f64 / 1_000.0;
        end
    });
    ends.filter(|it| *it > x).collect()
}
