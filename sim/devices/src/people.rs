//! People who walk over a floor.

use crate::routes::Routes;
use crate::scene::Disc;
use crate::settings::{SettingsError, within};
use core::ops::RangeInclusive;
use cotama_core::units::Millis;
use cotama_floor::{Path, Point};
use cotama_streams::{Stream, Streams};
use std::sync::Arc;

mod around;

use around::{Around, beside, is_hindered};

/// The time between two decisions of a person.
pub const STEP: Millis = Millis(100);
/// The most decisions of a person that are made at once: those of 29 hours. People of whom nobody
/// asked for longer go on from where they were.
const MAX_STEPS: u64 = 1 << 20;
/// A person who was hindered so often squeezes past the robot.
const TRIES: u8 = 3;
/// The most people.
pub const MAX_PEOPLE: usize = 1_000;

/// Habits of people; a range is what is drawn from, evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Habits {
    /// The radius of a person, in metres.
    pub radius_m: f64,
    /// Speeds of walks, in m/s.
    pub speed_m_s: RangeInclusive<f64>,
    /// Times for which a person stays in a place.
    pub stays: RangeInclusive<Millis>,
    /// The chance that a person stops once on a walk, somewhere, and stands in the way.
    pub stops: f64,
    /// Times for which a person stands in the way.
    pub stands: RangeInclusive<Millis>,
    /// Room that a person keeps from a robot, in metres.
    pub gap_m: f64,
    /// A person who has been hindered, or has stood close to a robot, for so long gives way.
    pub patience: Millis,
}

impl Default for Habits {
    /// People of 0.25 m radius who walk at 1.0 to 1.5 m/s: 1.34 m/s on average, deviation 0.26
    /// (Weidmann, Transporttechnik der Fussgänger, 1993, Section 2.3). The rest is assumed.
    fn default() -> Self {
        Self {
            radius_m: 0.25,
            speed_m_s: 1.0..=1.5,
            stays: Millis(5_000)..=Millis(60_000),
            stops: 0.2,
            stands: Millis(5_000)..=Millis(30_000),
            gap_m: 0.4,
            patience: Millis(3_000),
        }
    }
}

impl Habits {
    fn sound(&self) -> Result<(), SettingsError> {
        within("the radius of a person in m", self.radius_m, 0.01, 10.0)?;
        let (slow, fast) = (*self.speed_m_s.start(), *self.speed_m_s.end());
        within("the least speed in m/s", slow, 0.001, 100.0)?;
        within("the largest speed in m/s", fast, slow, 100.0)?;
        within("the chance to stop", self.stops, 0.0, 1.0)?;
        within("the gap in m", self.gap_m, 0.0, 100.0)
    }
}

/// People who walk between places, at speeds and for times that are drawn.
///
/// *The rule.* A person walks along the way to a place that is drawn, stays there for a time, and
/// walks on; now and then a person stops on the way and stands there. Nobody takes a step that ends
/// closer to a robot than the gap, unless it leads away from it. A person who was hindered for the
/// patience turns back; one who stood or stayed that long close to a robot goes on, or turns back
/// if that is where the robot is; and one who was hindered three times so squeezes past it, without
/// a look at walls. People walk through each other.
///
/// Decisions fall every [`STEP`], whenever the people are asked for; in between all move evenly.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Habits, People, Routes, Streams};
/// use cotama_floor::{Path, Point};
/// let hall = [[0.0, 0.0], [20.0, 0.0]].map(Point::from);
/// let routes = Routes::by(&hall, |from, to| Path::new(vec![from, to])).unwrap();
/// let habits = Habits { speed_m_s: 1.0..=1.0, stops: 0.0, ..Habits::default() };
/// let mut people = People::new(3, &habits, routes, &Streams::new(7), "people").unwrap();
/// let discs = people.advance(Millis(60_000), &[]);
/// assert!(discs.iter().all(|it| (0.0..=20.0).contains(&it.centre.x)));
/// ```
#[derive(Clone, Debug, Default)]
pub struct People {
    all: Vec<Person>,
    discs: Vec<Disc>,
    leaves: Vec<[Point; 2]>,
    /// The time of the last decision.
    decided: Option<Millis>,
}

/// A person who walks a round: from place to place in their order, and from the last to the first.
#[derive(Clone, Debug)]
pub struct Walker {
    /// Names the random numbers of this person.
    pub name: String,
    /// Habits and ways.
    pub goes: Arc<Goes>,
    /// The time of the first walk.
    pub from: Millis,
}

/// The ways of people, and their habits.
#[derive(Clone, Debug)]
pub struct Goes {
    habits: Habits,
    routes: Routes,
    /// Whether each place is followed by the next one, and none is drawn.
    is_round: bool,
}

impl Goes {
    /// A round through all places.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn round(habits: Habits, routes: Routes) -> Result<Self, SettingsError> {
        habits.sound()?;
        Ok(Self { habits, routes, is_round: true })
    }

    /// Returns the place to go to from a place, as it is drawn or in the order of a round.
    fn next(&self, place: usize, chance: &mut Stream) -> Option<usize> {
        let count = self.routes.from(place).count() as u64;
        let drawn = chance.below(count) as usize;
        if !self.is_round {
            return self.routes.from(place).nth(drawn);
        }
        let next = if place + 1 < self.routes.places().len() { place + 1 } else { 0 };
        self.routes.way(place, next).map(|_| next)
    }
}

#[derive(Clone, Debug)]
struct Person {
    goes: Arc<Goes>,
    chance: Stream,
    doing: Doing,
    /// Since when a robot hinders, or is close.
    hindered: Option<Millis>,
    /// How often that took too long since no robot was close.
    tries: u8,
    /// The centre at the last decision, and that at the next one.
    from: Point,
    to: Point,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    /// In a place, until a time.
    Stays { place: usize, until: Millis },
    /// On a walk, until a time if it stands there.
    Walks { walk: Walk, stands: Option<Millis> },
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Walk {
    from: usize,
    to: usize,
    /// The length that is behind, in metres.
    along: f64,
    speed: f64,
    /// The length after which the person stops once.
    stop: Option<f64>,
}

impl People {
    /// So many people, each in a place that is drawn. The random numbers of each have a name of
    /// their own, so that one more person changes none of the others.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        count: usize,
        habits: &Habits,
        routes: Routes,
        streams: &Streams,
        name: &str,
    ) -> Result<Self, SettingsError> {
        within("the number of people", count as f64, 0.0, MAX_PEOPLE as f64)?;
        habits.sound()?;
        let goes = Arc::new(Goes { habits: habits.clone(), routes, is_round: false });
        let routes = &goes.routes;
        let person = |number: usize| {
            let mut chance = streams.stream(&format!("{name} {number}"));
            let place = chance.below(routes.places().len() as u64) as usize;
            let at = routes.places().get(place).copied().unwrap_or_default();
            let until = time(&mut chance, &habits.stays);
            let doing = Doing::Stays { place, until };
            Person { goes: goes.clone(), chance, doing, hindered: None, tries: 0, from: at, to: at }
        };
        let all: Vec<_> = (0..count).map(person).collect();
        let disc = |it: &Person| Disc { centre: it.from, radius: habits.radius_m };
        let discs = all.iter().map(disc).collect();
        Ok(Self { all, discs, leaves: Vec::new(), decided: None })
    }

    /// Adds a person who walks a round, and is in its first place.
    ///
    /// ```
    /// use cotama_core::units::Millis;
    /// use cotama_devices::{Goes, Habits, People, Routes, Streams, Walker};
    /// use cotama_floor::{Path, Point};
    /// let hall = [[0.0, 0.0], [20.0, 0.0]].map(Point::from);
    /// let routes = Routes::by(&hall, |from, to| Path::new(vec![from, to])).unwrap();
    /// let habits = Habits { speed_m_s: 1.0..=1.0, stops: 0.0, ..Habits::default() };
    /// let goes = Goes::round(habits, routes).unwrap().into();
    /// let mut people = People::default();
    /// let walker = Walker { name: "Anna".into(), goes, from: Millis(3_000) };
    /// people.join(&walker, &Streams::new(7));
    /// let mut at_mm = |ms| (people.advance(Millis(ms), &[])[0].centre.x * 1e3).round();
    /// assert_eq!([at_mm(3_000), at_mm(5_000)], [0.0, 2_000.0]);
    /// ```
    pub fn join(&mut self, walker: &Walker, streams: &Streams) {
        let Walker { name, goes, from } = walker;
        let at = goes.routes.places().first().copied().unwrap_or_default();
        let doing = Doing::Stays { place: 0, until: *from };
        let chance = streams.stream(&format!("person {name}"));
        let goes = goes.clone();
        self.discs.push(Disc { centre: at, radius: goes.habits.radius_m });
        self.all.push(Person { goes, chance, doing, hindered: None, tries: 0, from: at, to: at });
    }

    /// Moves those who overlap a robot beside it: for a robot that is put among people.
    ///
    /// ```
    /// use cotama_devices::{Disc, Habits, People, Routes, Streams};
    /// use cotama_floor::{Path, Point};
    /// let hall = [[0.0, 0.0], [20.0, 0.0]].map(Point::from);
    /// let routes = Routes::by(&hall, |from, to| Path::new(vec![from, to])).unwrap();
    /// let mut people =
    ///     People::new(9, &Habits::default(), routes, &Streams::new(7), "people").unwrap();
    /// let robot = Disc { centre: Point::new(0.1, 0.0), radius: 0.3 };
    /// people.make_room(&robot);
    /// assert!(people.now().iter().all(|it| it.gap(&robot) > 0.0));
    /// ```
    pub fn make_room(&mut self, robot: &Disc) {
        for (disc, person) in self.discs.iter_mut().zip(&mut self.all) {
            person.to = beside(robot, person.to, disc.radius);
            (person.from, disc.centre) = (person.to, person.to);
        }
    }

    /// Puts leaves of doors where the ways were planned without them, in place of those before: who
    /// comes to one turns back.
    pub fn set_leaves(&mut self, leaves: Vec<[Point; 2]>) {
        self.leaves = leaves;
    }

    /// Returns the people where they were at the last time that was asked for.
    pub fn now(&self) -> &[Disc] {
        &self.discs
    }

    /// Returns the people at a time that is not before the last one, among robots that have stood
    /// where they are since.
    pub fn advance(&mut self, now: Millis, robots: &[Disc]) -> &[Disc] {
        let last = now.0 / STEP.0;
        let first = self.decided.map_or(0, |it| it.0 / STEP.0 + 1);
        for step in first.max(last.saturating_sub(MAX_STEPS))..=last {
            let now = Millis(step * STEP.0);
            for person in &mut self.all {
                let goes = person.goes.clone();
                person.decide(now, &goes, Around { robots, leaves: &self.leaves });
            }
            self.decided = Some(now);
        }
        let since = now.0.saturating_sub(self.decided.map_or(0, |it| it.0));
        let part = (since as f64 / STEP.0 as f64).min(1.0);
        for (disc, person) in self.discs.iter_mut().zip(&self.all) {
            disc.centre = person.from + (person.to - person.from) * part;
        }
        &self.discs
    }
}

impl Person {
    /// Decides at a time where to be a step later.
    fn decide(&mut self, now: Millis, goes: &Goes, around: Around<'_>) {
        let (Goes { habits, routes, .. }, robots) = (goes, around.robots);
        self.from = self.to;
        let here = Disc { centre: self.from, radius: habits.radius_m };
        let is_close = robots.iter().any(|it| it.gap(&here) < habits.gap_m);
        if let Doing::Walks { walk, stands: None } = self.doing {
            self.walk_on(walk, now, goes, around);
            return;
        }
        let is_patient = self.is_patient(is_close, now, habits);
        match self.doing {
            Doing::Stays { place, until } if until <= now || !is_patient => {
                self.set_off(place, now, goes, around);
            }
            Doing::Walks { mut walk, stands: Some(until) } if until <= now || !is_patient => {
                self.hindered = None;
                let next = routes.way(walk.from, walk.to).map(|way| walk.next(way).1);
                if !is_patient && next.is_some_and(|to| is_hindered(here, to, habits, robots)) {
                    walk.turn_back(routes);
                }
                self.walk_on(walk, now, goes, around);
            }
            _ => {}
        }
    }

    /// Whether the person has not been hindered for too long; counts from now if it begins.
    fn is_patient(&mut self, is_hindered: bool, now: Millis, habits: &Habits) -> bool {
        let since = is_hindered.then(|| self.hindered.unwrap_or(now));
        self.hindered = since;
        since.is_none_or(|it| now.0.saturating_sub(it.0) < habits.patience.0)
    }

    /// Leaves a place for another that is drawn; stays on where no way begins.
    fn set_off(&mut self, place: usize, now: Millis, goes: &Goes, around: Around<'_>) {
        let Goes { habits, routes, .. } = goes;
        self.hindered = None;
        let to = goes.next(place, &mut self.chance);
        let speeds = &habits.speed_m_s;
        let speed = speeds.start() + self.chance.part() * (speeds.end() - speeds.start());
        let (stops, after) = (self.chance.part() < habits.stops, self.chance.part());
        let Some((to, way)) = to.and_then(|to| Some((to, routes.way(place, to)?))) else {
            let until = time(&mut self.chance, &habits.stays);
            self.doing = Doing::Stays { place, until: Millis(now.0.saturating_add(until.0)) };
            return;
        };
        let stop = stops.then(|| after * way.length());
        let walk = Walk { from: place, to, along: 0.0, speed, stop };
        self.walk_on(walk, now, goes, around);
    }

    /// Takes a step of a walk, or waits for the robot that is in the way, or turns back.
    fn walk_on(&mut self, mut walk: Walk, now: Millis, goes: &Goes, around: Around<'_>) {
        let (Goes { habits, routes, .. }, robots) = (goes, around.robots);
        let Some(way) = routes.way(walk.from, walk.to) else { return };
        let here = Disc { centre: self.from, radius: habits.radius_m };
        let (along, to) = walk.next(way);
        if around.bars(here, to) {
            self.doing = if walk.along > 0.0 {
                walk.turn_back(routes);
                Doing::Walks { walk, stands: None }
            } else {
                let until = after_step(now, time(&mut self.chance, &habits.stays));
                Doing::Stays { place: walk.from, until }
            };
            return;
        }
        let hinders = is_hindered(here, to, habits, robots);
        if !self.is_patient(hinders, now, habits) {
            self.hindered = None;
            self.tries = self.tries.saturating_add(1);
            if self.tries < TRIES && walk.along <= 0.0 {
                // Back where the walk began, another one is drawn.
                self.doing = Doing::Stays { place: walk.from, until: now };
                return;
            }
            if self.tries < TRIES {
                walk.turn_back(routes);
            }
        }
        let squeezes = self.tries >= TRIES;
        if !hinders && robots.iter().all(|it| it.gap(&here) >= habits.gap_m) {
            self.tries = 0;
        }
        self.doing = Doing::Walks { walk, stands: None };
        if hinders && !squeezes {
            return;
        }
        self.to = robots.iter().fold(to, |to, robot| beside(robot, to, habits.radius_m));
        walk.along = along;
        if along >= way.length() {
            let until = after_step(now, time(&mut self.chance, &habits.stays));
            self.doing = Doing::Stays { place: walk.to, until };
        } else if walk.stop.is_some_and(|it| it <= along) {
            walk.stop = None;
            let until = after_step(now, time(&mut self.chance, &habits.stands));
            self.doing = Doing::Walks { walk, stands: Some(until) };
        } else {
            self.doing = Doing::Walks { walk, stands: None };
        }
    }
}

impl Walk {
    /// Returns the length after the next step, and the point there.
    fn next(&self, way: &Path) -> (f64, Point) {
        let along = (self.along + self.speed * STEP.0 as f64 / 1_000.0).min(way.length());
        (along, way.pose(along).translation.vector.into())
    }

    /// Turns back to where the walk began; the person stops no more.
    fn turn_back(&mut self, routes: &Routes) {
        let length = routes.way(self.to, self.from).map_or(0.0, Path::length);
        let along = (length - self.along).max(0.0);
        *self = Self { from: self.to, to: self.from, along, speed: self.speed, stop: None };
    }
}

/// Returns the end of a time that begins with the end of a step.
fn after_step(now: Millis, time: Millis) -> Millis {
    Millis(now.0.saturating_add(STEP.0).saturating_add(time.0))
}

/// Draws a time.
fn time(chance: &mut Stream, times: &RangeInclusive<Millis>) -> Millis {
    let (least, most) = (times.start().0, times.end().0);
    Millis(least.saturating_add(chance.below(most.saturating_sub(least).saturating_add(1))))
}
