//! The floor that a mission goes over, its path, and the wheels of its robot.

use crate::corridors;
use crate::drivetrain::{Drivetrain, SPARE};
use crate::people;
use crate::track::{Near, Rest, Track};
use cotama_core::units::Millimetres;
use cotama_devices::{Habits, People, Routes, SettingsError, Streams, Walker};
use cotama_floor::{Floor, Held, Needs, Planner, Point, Pose, Surface, metres};
use cotama_models::missions::faults::EventKind;
use cotama_models::missions::{Leg, Mission, Way};
use std::fmt;

/// All that the robots of a mission share, made once for any number of runs.
#[derive(Clone, Debug)]
pub struct Course {
    way: Way,
    /// The floor as it is, and as the robot's map has it.
    real: Held,
    charted: Held,
    drivetrain: Drivetrain,
    track: Track,
    back: Track,
    /// Length of the path beyond that of the mission, in metres.
    spare: f64,
    /// The people whom a seed draws, and those who walk as the mission says.
    drawn: Option<(usize, Routes)>,
    walkers: Vec<Walker>,
}

/// The room around a robot from which it cuts corners, in metres.
const TIGHT: f64 = 0.15;
/// The most places of a floor between which people walk: the first of its file.
const PEOPLE_PLACES: usize = 12;

/// Why a mission does not go over a floor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoCourse {
    /// The mission names no robot with a body.
    Body,
    /// The path is so long that no floor holds it.
    Long,
    /// The floor cannot be driven on.
    Floor(String),
    /// The robot has no room where it starts.
    Start,
    /// The floor has no places for people, or they are too many.
    People(String),
}

impl fmt::Display for NoCourse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body => f.write_str("the mission names no robot with a body"),
            Self::Long => f.write_str("the path is too long for the corridors of one floor"),
            Self::Floor(why) => write!(f, "the floor cannot be driven on: {why}"),
            Self::People(why) => write!(f, "people cannot walk on this floor: {why}"),
            Self::Start => f.write_str("the robot has no room at the start of its path"),
        }
    }
}

impl std::error::Error for NoCourse {}

/// Leads a way around things that are not on the map of the robot, as avoidance that knows them
/// would. A leg is as long for the mission as it was: lengths along it are in proportion.
fn around(way: Way, surface: &dyn Surface, drivetrain: &Drivetrain) -> Way {
    let radius_m = drivetrain.footprint.radius() + SPARE;
    let needs = Needs { radius_m, ..Needs::default() }.beyond(way.asked.clearance);
    let mut planner = None;
    let mut led = |leg: Leg| {
        if is_free(&leg.points, surface, drivetrain) {
            return leg;
        }
        let planner = planner.get_or_insert_with(|| Planner::new(surface, needs).ok());
        let ends = leg.points.first().zip(leg.points.last());
        let route = planner
            .as_ref()
            .zip(ends)
            .and_then(|(planner, (from, to))| planner.route(metres(*from), metres(*to)).ok());
        let Some(route) = route else { return leg };
        let points = route.points().iter().map(in_mm).collect();
        Leg { points, ..leg }
    };
    let legs = way.legs.into_iter().map(|it| it.map(&mut led)).collect();
    Way { legs, ..way }
}

#[allow(clippy::cast_possible_truncation)] // points of a floor
pub(crate) fn in_mm(it: &Point) -> [i32; 2] {
    [(it.x * 1_000.0).round() as i32, (it.y * 1_000.0).round() as i32]
}

/// Whether a robot can follow straight pieces without touching anything.
pub(crate) fn is_free(points: &[[i32; 2]], surface: &dyn Surface, drivetrain: &Drivetrain) -> bool {
    points.iter().zip(points.iter().skip(1)).all(|(from, to)| {
        let (from, to) = (metres(*from), metres(*to));
        let way = to - from;
        let steps = (way.norm() / 0.02).ceil().max(1.0);
        let mut part = 0.0;
        while part <= steps {
            let at = from + way * (part / steps);
            if !surface.is_free(&drivetrain.footprint, &Pose::new(at.coords, 0.0)) {
                return false;
            }
            part += 1.0;
        }
        true
    })
}

/// Returns the way that wrong positions add, of the mission's own faults.
fn wrong(mission: &Mission) -> Millimetres {
    let extra = mission.run.faults.events.iter().map(|it| match it.kind {
        EventKind::Odometry { extra } => extra.0,
        _ => 0,
    });
    Millimetres(extra.fold(0, u64::saturating_add))
}

/// Whether a robot has little room at a point.
fn is_tight(surface: &dyn Surface, drivetrain: &Drivetrain, at: Point) -> bool {
    let room = drivetrain.footprint.radius() + TIGHT;
    surface.clearance(at, room) < room
}

impl Course {
    /// Returns the course of a mission. One that names no floor goes along
    /// [corridors](corridors::along) as long as its path, and as all that wrong positions of its
    /// own faults add. So many people walk between the places of the floor, or as many as the
    /// mission says, beside those whom it names.
    ///
    /// # Errors
    /// A [`NoCourse`] where no robot could drive.
    pub fn of(mission: &Mission, people: usize) -> Result<Self, NoCourse> {
        let body = mission.robot().and_then(|it| it.robot().body.as_ref()).ok_or(NoCourse::Body)?;
        let drivetrain = Drivetrain::of(body);
        let spare = if mission.way.is_none() { wrong(mission) } else { Millimetres(0) };
        let length = Millimetres(mission.path_length.0.saturating_add(spare.0));
        let way = mission.way.clone().or_else(|| corridors::along(length)).ok_or(NoCourse::Long)?;
        let spare = spare.0 as f64 / 1_000.0;
        let why = |it: String| NoCourse::Floor(it);
        let [real, charted] = Held::of(&way).map_err(why)?;
        let surface = real.surface();
        let way = around(way, surface, &drivetrain);
        let track = Track::of(&way, &drivetrain, |at| is_tight(surface, &drivetrain, at))
            .ok_or_else(|| why("the path has no length".into()))?;
        if !surface.is_free(&drivetrain.footprint, &track.start()) {
            return Err(NoCourse::Start);
        }
        let back = track.back(&drivetrain);
        let of = &mission.people;
        let walkers = of.walkers.iter().map(people::walker).collect::<Result<_, _>>();
        let walkers = walkers.map_err(|it| NoCourse::People(it.to_string()))?;
        let course =
            Self { way, real, charted, drivetrain, track, back, spare, drawn: None, walkers };
        let people = if people == 0 { of.drawn } else { people };
        if people == 0 { Ok(course) } else { course.among(people) }
    }

    /// The same with people who walk between the places of the floor.
    fn among(self, count: usize) -> Result<Self, NoCourse> {
        let why = |it: &dyn fmt::Display| NoCourse::People(it.to_string());
        let radius_m = Habits::default().radius_m;
        let needs = Needs { radius_m, cell_m: 0.1, ..Needs::default() };
        let planner = Planner::new(self.real.surface(), needs).map_err(|it| why(&it))?;
        let places = self.places();
        if places.len() < 2 {
            return Err(why(&"it has less than two places"));
        }
        let places = places.get(..places.len().min(PEOPLE_PLACES)).unwrap_or_default();
        let routes = Routes::plan(&planner, places).map_err(|it| why(&it))?;
        let course = Self { drawn: Some((count, routes)), ..self };
        course.people(0).map_err(|it| why(&it))?;
        Ok(course)
    }

    /// Returns the places of the floor; of a map, those of the mission.
    fn places(&self) -> Vec<Point> {
        if let Ok(floor) = Floor::parse(&self.way.source, &self.way.text) {
            return floor.places.iter().map(|it| metres(it.at)).collect();
        }
        let legs = self.way.legs.iter().flatten();
        let ends = legs.flat_map(|it| [it.points.first(), it.points.last()]).flatten();
        let mut places: Vec<Point> = Vec::new();
        for it in ends.map(|it| metres(*it)) {
            if !places.contains(&it) {
                places.push(it);
            }
        }
        places
    }

    /// Returns the people of a run with this seed, where they are at its start.
    pub(crate) fn people(&self, seed: u64) -> Result<Option<People>, SettingsError> {
        let streams = Streams::new(seed);
        let mut people = match &self.drawn {
            None if self.walkers.is_empty() => return Ok(None),
            None => People::default(),
            Some((count, routes)) => {
                People::new(*count, &Habits::default(), routes.clone(), &streams, "people")?
            }
        };
        self.walkers.iter().for_each(|it| people.join(it, &streams));
        Ok(Some(people))
    }

    /// Returns the floor and the way over it.
    pub const fn way(&self) -> &Way {
        &self.way
    }

    /// Returns the floor as it is.
    pub fn surface(&self) -> &dyn Surface {
        self.real.surface()
    }

    /// Returns the floor as the robot's map has it.
    pub fn charted(&self) -> &dyn Surface {
        self.charted.surface()
    }

    /// Returns the wheels.
    pub const fn drivetrain(&self) -> &Drivetrain {
        &self.drivetrain
    }

    /// Returns the path.
    pub const fn track(&self) -> &Track {
        &self.track
    }

    /// Returns how much longer the path is than the mission, in metres.
    pub(crate) const fn spare(&self) -> f64 {
        self.spare
    }

    /// Lets the floor be another one.
    pub(crate) fn stand_on(&mut self, real: Held) {
        self.real = real;
    }

    /// Leads the path from a place on over these parts; returns that place.
    pub(crate) fn lead(&mut self, from: Near, rests: &[Rest]) -> Near {
        let (track, near) = self.track.onto(from, rests, &self.drivetrain);
        (self.back, self.track) = (track.back(&self.drivetrain), track);
        near
    }

    /// Whether the robot has little room at a point.
    pub(crate) fn is_tight(&self, at: Point) -> bool {
        is_tight(self.surface(), &self.drivetrain, at)
    }

    /// Returns the path that leads back.
    pub(crate) const fn back(&self) -> &Track {
        &self.back
    }
}
