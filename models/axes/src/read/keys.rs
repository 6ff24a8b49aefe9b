//! Keys of attributes, which are of the file's own: those that formulas read must be there, and one
//! that nothing reads may be a misspelt one.

use super::Reader;
use crate::fields::{near, there_are};
use crate::formula::{Formula, Inducer};
use crate::mission::Attributes;
use crate::tree::Fault;
use std::collections::BTreeSet;

/// Owners of attributes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keys {
    /// Options of tasks.
    Options,
    /// Kinds of hardware.
    Hardware,
    /// Zones of the path.
    Zones,
    /// The robot.
    Robot,
    /// The laptop.
    Laptop,
}

impl Keys {
    /// The owner of the key that an inducer reads, and the key.
    const fn read_by(inducer: &Inducer) -> Option<(Self, &String)> {
        match inducer {
            Inducer::Options(key) => Some((Self::Options, key)),
            Inducer::Hardware(key) | Inducer::Detector(key) => Some((Self::Hardware, key)),
            Inducer::ZoneMin(key) => Some((Self::Zones, key)),
            Inducer::Robot(key) => Some((Self::Robot, key)),
            Inducer::Laptop(key) => Some((Self::Laptop, key)),
            Inducer::Length | Inducer::Speed | Inducer::Duration | Inducer::MotionPower => None,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Options => "an option",
            Self::Hardware => "hardware",
            Self::Zones => "a zone",
            Self::Robot => "the robot",
            Self::Laptop => "the laptop",
        }
    }

    /// Keys that are read without a formula.
    const fn own(self) -> &'static [&'static str] {
        match self {
            Self::Options => &["stand_ms"],
            Self::Hardware => &["detect_ms"],
            Self::Zones | Self::Robot | Self::Laptop => &[],
        }
    }
}

impl Reader<'_, '_> {
    /// Says which inducers of a formula are of nothing that is there.
    pub(super) fn known(&self, at: usize, formula: &Formula) {
        for inducer in formula.inducers() {
            let Some((of, key)) = Keys::read_by(inducer) else { continue };
            let is_single = matches!(of, Keys::Robot | Keys::Laptop);
            let keys = self.keys(of);
            // An empty name stands for all that could not be read.
            let is_there = keys.contains("") || keys.contains(key.as_str());
            if is_there || !(self.is_strict || is_single) {
                continue;
            }
            let message = format!("unknown inducer `{inducer}`: no key `{key}` of {}", of.words());
            let near = near(key, keys.iter().copied()).map(|it| format!("did you mean `{it}`?"));
            let help = near.unwrap_or_else(|| there_are(keys.into_iter()));
            self.faults.add(Fault::new(at, message).help(help));
        }
    }

    fn keys(&self, of: Keys) -> BTreeSet<&str> {
        let mission = &self.mission;
        let all: Vec<&Attributes> = match of {
            Keys::Options => mission.options.iter().map(|it| &it.attributes).collect(),
            Keys::Hardware => mission.hardware.iter().map(|it| &it.attributes).collect(),
            Keys::Zones => mission.zones.iter().map(|it| &it.attributes).collect(),
            Keys::Robot => vec![&mission.robot],
            Keys::Laptop => vec![&mission.laptop],
        };
        all.into_iter().flat_map(|it| &it.0).map(|it| it.0.as_str()).collect()
    }

    /// Says which keys nothing reads, where their owner has not one with nearly that name that is
    /// read.
    pub(super) fn misspelt(&self) {
        let both = self.mission.indicators.iter().flat_map(|it| it.travel.iter().chain(&it.stand));
        let inducers: Vec<_> = both.flat_map(Formula::inducers).filter_map(Keys::read_by).collect();
        for (of, keys) in &self.seen {
            let read = inducers.iter().filter(|it| it.0 == *of).map(|it| it.1.as_str());
            let read: BTreeSet<&str> = read.chain(of.own().iter().copied()).collect();
            let has = |key: &str| keys.iter().any(|it| it.0 == key);
            for (key, at) in keys.iter().filter(|it| !read.contains(it.0)) {
                if let Some(near) = near(key, read.iter().copied().filter(|it| !has(it))) {
                    let message = format!("no formula reads `{key}` of {}", of.words());
                    let help = format!("did you mean `{near}`?");
                    self.faults.add(Fault::new(*at, message).help(help));
                }
            }
        }
    }
}
