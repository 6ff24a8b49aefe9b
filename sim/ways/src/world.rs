//! All trials of an experiment, each made when it is first asked for.

use crate::maps::{MAPS, Map};
use crate::picture::Track;
use crate::policy::Condition;
use crate::ring::{CORRIDOR_M, Ring, Way};
use crate::trial::{ObjectSpeed, Trial, trial};
use cotama_devices::Disc;
use cotama_floor::{Point, Pose};
use cotama_streams::Streams;
use std::collections::BTreeMap;

/// A series of 40 maps, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Series {
    /// One of the runs by which the model is learned.
    Training(u64),
    /// One of the runs that are counted.
    Run(u64),
}

/// A trial's place: all but the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The run.
    pub series: Series,
    /// The condition.
    pub condition: Condition,
    /// The map, from 0.
    pub map: usize,
    /// The trial on the map, from 0.
    pub trial: usize,
}

/// The trials of a seed at a speed of discs. A trial is fixed by its place and its way, so all
/// policies meet the same discs: they are compared by pairs.
#[derive(Clone, Debug)]
pub struct World {
    streams: Streams,
    speed: ObjectSpeed,
    rings: Vec<Ring>,
    made: BTreeMap<(Place, Way), Trial>,
}

impl World {
    /// A world of this seed.
    pub fn new(seed: u64, speed: ObjectSpeed) -> Self {
        let ring = |it: &Map| Ring::new(it, CORRIDOR_M);
        let rings = MAPS.iter().filter_map(ring).collect();
        Self { streams: Streams::new(seed), speed, rings, made: BTreeMap::new() }
    }

    /// The speed of discs.
    pub const fn speed(&self) -> ObjectSpeed {
        self.speed
    }

    /// The ring of a map.
    pub fn ring(&self, map: usize) -> &Ring {
        &self.rings[map]
    }

    /// Random numbers of a place.
    pub fn streams(&self, place: Place) -> Streams {
        let Place { series, condition, map, trial } = place;
        let series = match series {
            Series::Training(it) => format!("training {it}"),
            Series::Run(it) => format!("run {it}"),
        };
        let name = format!("{series} {} map {map} trial {trial}", condition.name());
        Streams::new(self.streams.stream(&name).bits())
    }

    /// The trial of a place on a way.
    pub fn trial(&mut self, place: Place, way: Way) -> Trial {
        if let Some(made) = self.made.get(&(place, way)) {
            return *made;
        }
        let streams = self.streams(place);
        let made = trial(&self.rings[place.map], way, self.speed, &streams, |_, _| {});
        self.made.insert((place, way), made);
        made
    }

    /// The track of the trial of a place on a way, made again for its picture.
    pub fn track(&self, place: Place, way: Way) -> Track {
        let mut places = Vec::new();
        let see = |pose: &Pose, _: &[Disc]| places.push(Point::from(pose.translation.vector));
        let streams = self.streams(place);
        let made = trial(&self.rings[place.map], way, self.speed, &streams, see);
        Track { places, is_success: made.is_success() }
    }

    /// How many trials were made.
    pub fn made(&self) -> usize {
        self.made.len()
    }
}
