//! An activity with one combination of options: all that formulas read.

use crate::fields::LARGEST;
use crate::formula::{Formula, Inducer};
use crate::mission::{DetectBy, Mission};
use crate::tree::Wrong;

/// The value of `zone_min` of a key that no zone here has.
const NO_LIMIT: i64 = 1_000_000_000;

/// Everything that formulas read but the speed.
#[derive(Debug)]
pub(crate) struct World<'m> {
    pub(crate) mission: &'m Mission,
    pub(crate) zones: &'m [usize],
    pub(crate) options: &'m [usize],
    /// Units of each kind of hardware that are on: of each the largest need of an option.
    pub(crate) needs: Vec<i64>,
    /// The detector that counts, by index.
    pub(crate) detector: Option<usize>,
    pub(crate) length_mm: i64,
    pub(crate) travels: bool,
    stand_ms: i64,
}

/// A speed and what follows from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) speed_mm_s: i64,
    pub(crate) duration_ms: i64,
    power_mw: i64,
}

impl<'m> World<'m> {
    pub(crate) fn new(
        mission: &'m Mission,
        zones: &'m [usize],
        options: &'m [usize],
        length_mm: i64,
        travels: bool,
    ) -> Self {
        let chosen = || options.iter().filter_map(|&it| mission.options.get(it));
        let most = |kind: usize| chosen().filter_map(|it| it.needs.get(kind)).max().copied();
        let needs = (0..mission.hardware.len()).map(|it| most(it).unwrap_or(0)).collect();
        let lead = chosen().find(|it| it.leads());
        let stand_ms = lead.and_then(|it| it.attributes.get("stand_ms")).unwrap_or(0);
        let mut world =
            Self { mission, zones, options, needs, detector: None, length_mm, travels, stand_ms };
        let counts = |&it: &usize| mission.detect_by == DetectBy::Zone || world.leads_with(it);
        let seeing = (0..mission.hardware.len()).filter(|&it| world.sees(it)).filter(counts);
        let period = |&it: &usize| mission.hardware.get(it)?.attributes.get("detect_ms");
        world.detector = if travels { seeing.min_by_key(period) } else { None };
        world
    }

    /// Whether the leading option needs this kind of hardware.
    pub(crate) fn leads_with(&self, kind: usize) -> bool {
        let options = self.options.iter().filter_map(|&it| self.mission.options.get(it));
        let mut leads = options.filter(|it| it.leads());
        leads.next().is_some_and(|it| it.needs.get(kind).is_some_and(|&it| it > 0))
    }

    /// Whether this kind of hardware detects obstacles, a unit of it is there, and none of the
    /// zones here blinds it.
    pub(crate) fn sees(&self, kind: usize) -> bool {
        let there = self.mission.hardware.get(kind).filter(|it| it.units > 0);
        let detects = there.map(|it| it.attributes.get("detect_ms"));
        let mut zones = self.zones.iter().filter_map(|&it| self.mission.zones.get(it));
        detects.flatten().is_some() && !zones.any(|it| it.blind.contains(&kind))
    }

    /// Returns the highest speed that zones and options allow, whatever formulas say.
    pub(crate) fn most_mm_s(&self) -> i64 {
        let zones = self.zones.iter().filter_map(|&it| self.mission.zones.get(it)?.most_mm_s);
        let chosen = self.options.iter().filter_map(|&it| self.mission.options.get(it)?.most_mm_s);
        zones.chain(chosen).min().unwrap_or(i64::MAX)
    }

    /// Returns what follows from a speed; a robot that stands does so for as long as its option
    /// says.
    pub(crate) fn at(&self, speed_mm_s: i64) -> Motion {
        if !self.travels || speed_mm_s <= 0 {
            return Motion { speed_mm_s: 0, duration_ms: self.stand_ms, power_mw: 0 };
        }
        let [c0, c1, c2] = self.mission.motion_power.map(i128::from);
        let v = i128::from(speed_mm_s);
        let near = |a: i128, b: i128| (2 * a + b).div_euclid(2 * b) as i64;
        Motion {
            speed_mm_s,
            duration_ms: near(i128::from(self.length_mm) * 1000, v),
            power_mw: near(c0 * 1_000_000 + c1 * v * 1000 + c2 * v * v, 1_000_000),
        }
    }

    /// Returns the value of an inducer on which the speed does not act.
    pub(crate) fn fixed(&self, inducer: &Inducer) -> Option<i64> {
        let chosen = || self.options.iter().filter_map(|&it| self.mission.options.get(it));
        let sum = |mut all: Box<dyn Iterator<Item = i64> + '_>| {
            all.try_fold(0, i64::checked_add).unwrap_or(i64::MAX)
        };
        Some(match inducer {
            Inducer::Length => self.length_mm,
            Inducer::Speed | Inducer::Duration | Inducer::MotionPower if self.travels => {
                return None;
            }
            Inducer::Speed | Inducer::MotionPower => 0,
            Inducer::Duration => self.stand_ms,
            Inducer::Robot(key) => self.mission.robot.get(key).unwrap_or(0),
            Inducer::Laptop(key) => self.mission.laptop.get(key).unwrap_or(0),
            Inducer::Options(key) => {
                sum(Box::new(chosen().filter_map(|it| it.attributes.get(key))))
            }
            Inducer::Hardware(key) => {
                let on = self.mission.hardware.iter().zip(&self.needs);
                let times = |(it, n): (&crate::mission::Hardware, &i64)| {
                    it.attributes.get(key).map(|it| it.saturating_mul(*n))
                };
                sum(Box::new(on.filter_map(times)))
            }
            Inducer::ZoneMin(key) => {
                let zones = self.zones.iter().filter_map(|&it| self.mission.zones.get(it));
                zones.filter_map(|it| it.attributes.get(key)).min().unwrap_or(NO_LIMIT)
            }
            Inducer::Detector(key) => {
                let detector = self.detector.and_then(|it| self.mission.hardware.get(it));
                detector.and_then(|it| it.attributes.get(key)).unwrap_or(0)
            }
        })
    }

    /// Returns the value of an inducer at a speed.
    pub(crate) fn read(&self, inducer: &Inducer, motion: Motion) -> i64 {
        match inducer {
            Inducer::Speed => motion.speed_mm_s,
            Inducer::Duration => motion.duration_ms,
            Inducer::MotionPower => motion.power_mw,
            _ => self.fixed(inducer).unwrap_or(0),
        }
    }

    /// Returns a formula with all inducers put in on which the speed does not act.
    pub(crate) fn given(&self, formula: &Formula, whose: &str) -> Result<Formula, Wrong> {
        formula.given(&|it| self.fixed(it)).map_err(|it| formula.wrong(&it, whose))
    }

    /// Returns the value of a formula at a speed.
    pub(crate) fn value(
        &self,
        formula: &Formula,
        motion: Motion,
        whose: &str,
    ) -> Result<i64, Wrong> {
        let value = formula.value(&|it| self.read(it, motion));
        let value = value.map_err(|it| formula.wrong(&it, whose))?;
        if value.unsigned_abs() <= LARGEST.unsigned_abs() {
            return Ok(value);
        }
        Err(formula.beyond(whose, LARGEST))
    }
}
