//! Sonars that read their largest range for too long a way.

use crate::flag::Flag;
use crate::promise::FalseAlarms;
use crate::spell::{Spell, Survey};
use cotama_core::units::Millis;
use cotama_devices::{MAX_SONARS, Sensed, SettingsError, within};

/// The way and the readings of one sonar.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Far {
    spell: Spell,
    /// The newest reading that was looked at, and the way until then.
    last: Option<(Millis, f64)>,
}

impl Far {
    const fn new(limit: f64) -> Self {
        Self { spell: Spell::new(limit), last: None }
    }

    /// Takes a reading, unless it was taken before; returns the length of a spell that it ends.
    fn read(&mut self, reading: Sensed<f64>, range_m: f64, way_m: f64) -> Option<f64> {
        let is_old = self.last.is_some_and(|it| reading.taken <= it.0);
        if is_old || reading.value.is_nan() {
            return None;
        }
        let before = self.last.replace((reading.taken, way_m)).map_or(way_m, |it| it.1);
        if reading.value >= range_m {
            self.spell.goes_on(way_m - before);
            return None;
        }
        Some(self.spell.ends())
    }
}

/// A survey of sound sonars: for how long a way each reads its largest range in some surroundings.
///
/// The way of a spell begins at the first such reading; it is the way that the wheels have gone,
/// ahead or back: what a sonar sees while the robot turns on the spot counts for nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct SonarSurvey {
    range_m: f64,
    sonars: [(Far, Survey); MAX_SONARS],
}

impl SonarSurvey {
    /// A survey of spells longer than a way, of sonars that read no further than a range.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(range_m: f64, beyond_m: f64) -> Result<Self, SettingsError> {
        within("the range in m", range_m, 0.01, 100.0)?;
        let one = (Far::new(f64::INFINITY), Survey::beyond(beyond_m)?);
        Ok(Self { range_m, sonars: [one; MAX_SONARS] })
    }

    /// Looks at the newest readings of the sonars, and at the way gone until now in metres. A time
    /// without motion is not part of a survey.
    pub fn look(&mut self, readings: &[Option<Sensed<f64>>], way_m: f64, moved_for: Millis) {
        for ((far, survey), reading) in self.sonars.iter_mut().zip(readings) {
            survey.watch(moved_for);
            let ended = reading.and_then(|it| far.read(it, self.range_m, way_m));
            ended.into_iter().for_each(|it| survey.add(it));
        }
    }
}

/// An observer of sonars that read their largest range for long while the robot moves: the
/// micro-controller gives that value if a sonar hears nothing, and if it is broken (Durand et al.,
/// TAROS 2010, Section VI.A.3).
///
/// *Assumption.* A sound sonar's spells at the largest range have the [`Tail`](crate::Tail) of a
/// survey in these surroundings; each sonar of the ring has its own, as those to the side see walls
/// and those ahead see along corridors.
///
/// *Threshold.* The way that a sonar's spells exceed at an equal share of the promised rate per
/// hour of motion: u + m ln(n b / λ), with n sonars, b spells per hour beyond u, m their excess.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, FarSonars, Flag, SonarSurvey};
/// let mut survey = SonarSurvey::new(5.0, 0.5).unwrap();
/// survey.look(&[None, None], 0.0, Millis(3_600_000)); // an hour in which none was far
/// let promise = FalseAlarms::per_hour(0.1).unwrap();
/// let mut far = FarSonars::new(&survey, 2, promise).unwrap();
/// // The second sonar reads 5 m all the way.
/// let mut flag = Flag::Clear;
/// for step in 0..30_u64 {
///     let read = |value| Some(Sensed { taken: Millis(step * 320), value });
///     flag = far.observe(&[read(1.2), read(5.0)], step as f64 * 0.1);
/// }
/// assert_eq!((flag, far.far()), (Flag::Raised, 0b10));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FarSonars {
    range_m: f64,
    sonars: [Far; MAX_SONARS],
}

impl FarSonars {
    /// An observer of the first sonars of a survey.
    ///
    /// # Errors
    /// A survey of no time, or more sonars than there may be.
    pub fn new(
        survey: &SonarSurvey,
        sonars: usize,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the number of sonars", sonars as f64, 1.0, MAX_SONARS as f64)?;
        let share = promise.shared_by(sonars as u32);
        let mut all = [Far::new(f64::INFINITY); MAX_SONARS];
        for (far, (_, survey)) in all.iter_mut().zip(&survey.sonars).take(sonars) {
            *far = Far::new(survey.tail()?.limit(share));
        }
        Ok(Self { range_m: survey.range_m, sonars: all })
    }

    /// Returns the way in metres after which a sonar counts as broken.
    pub fn limit_m(&self, sonar: usize) -> Option<f64> {
        self.sonars.get(sonar).map(|it| it.spell.limit())
    }

    /// Looks at the newest readings of the sonars, and at the way gone until now in metres. A
    /// reading that was looked at before neither lengthens a spell nor ends it.
    pub fn observe(&mut self, readings: &[Option<Sensed<f64>>], way_m: f64) -> Flag {
        if readings.iter().all(Option::is_none) || !way_m.is_finite() {
            return Flag::Missing;
        }
        for (far, reading) in self.sonars.iter_mut().zip(readings) {
            reading.iter().for_each(|it| {
                far.read(*it, self.range_m, way_m);
            });
        }
        Flag::raised_if(self.far() != 0)
    }

    /// Returns the sonars that count as broken, as bits.
    pub fn far(&self) -> u64 {
        let all = self.sonars.iter().enumerate().filter(|it| it.1.spell.is_long());
        all.fold(0, |bits, it| bits | 1 << it.0)
    }
}

#[cfg(test)]
mod tests;
