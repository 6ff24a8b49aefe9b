//! Ranges that jump from reading to reading, and ranges that never change.

use crate::flag::Flag;
use crate::promise::{FalseAlarms, Run};
use crate::spell::{Spell, Tail};
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// The sensors that jump in a reading before it counts, and how far they jump, in metres.
const SEVERAL: usize = 3;
const FAR_M: f64 = 0.5;

/// The sensors that are looked at.
const MOST: usize = 16;

/// Readings in which several ranges jump, up or down: of at most 16 sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Jumps {
    before: [f64; MOST],
}

impl Default for Jumps {
    fn default() -> Self {
        Self { before: [f64::NAN; MOST] }
    }
}

impl Jumps {
    /// Whether several ranges of a reading are far from those of the one before.
    ///
    /// ```
    /// use cotama_core::units::Millis;
    /// use cotama_devices::{Sensed, SettingsError, within};
    /// let of = |all: [f64; 4]| all.map(|value| Some(Sensed { taken: Millis(0), value }));
    /// let mut jumps = cotama_observers::Jumps::default();
    /// assert!(!jumps.look(&of([1.0, 2.0, 3.0, 4.0])));
    /// assert!(!jumps.look(&of([1.0, 3.0, 4.0, 4.0]))); // two: a corner
    /// assert!(jumps.look(&of([2.0, 2.0, 3.0, 4.0])));
    /// ```
    pub fn look(&mut self, ranges: &[Option<Sensed<f64>>]) -> bool {
        let mut jump = 0;
        for (before, now) in self.before.iter_mut().zip(ranges) {
            let now = now.map_or(f64::NAN, |it| it.value);
            jump += usize::from((now - *before).abs() > FAR_M);
            *before = now;
        }
        jump >= SEVERAL
    }
}

/// An observer of outliers: of cross talk, of echoes from smooth walls.
///
/// *Assumption.* Times in which several ranges of a sound ring jump from reading to reading, as in
/// a door, have a [`Tail`], in seconds. *Threshold.* The time that the tail exceeds as seldom as
/// promised.
#[derive(Clone, Debug, PartialEq)]
pub struct Outliers {
    jumps: Jumps,
    spell: Spell,
    last: Option<Millis>,
}

impl Outliers {
    /// An observer whose sound spells have a tail.
    pub fn new(tail: Tail, promise: FalseAlarms) -> Self {
        Self { jumps: Jumps::default(), spell: Spell::new(tail.limit(promise)), last: None }
    }

    /// Looks at the newest ranges; those that were seen before count once.
    pub fn observe(&mut self, ranges: &[Option<Sensed<f64>>]) -> Flag {
        let Some(taken) = ranges.iter().flatten().map(|it| it.taken).max() else {
            return Flag::Missing;
        };
        let before = self.last.replace(taken).unwrap_or(taken);
        if taken > before {
            if self.jumps.look(ranges) {
                self.spell.goes_on((taken.0 - before.0) as f64 / 1_000.0);
            } else {
                self.spell.ends();
            }
        }
        Flag::raised_if(self.spell.is_long())
    }
}

/// The difference below which two readings are the same, in metres.
const SAME_M: f64 = 0.000_1;

/// An observer of sensors that read the same range again and again, as those that are stuck do.
///
/// *Assumption.* Each reading has a normal error of deviation σ of its own, so that two of a thing
/// that stands differ by a normal one of σ√2: they are the same within d, a tenth of a millimetre,
/// with at most the chance d / (σ √π). *Threshold.* So many in a row as the promise asks for. A
/// least or largest range is not one that is stuck.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, Flag, Frozen};
/// let promise = FalseAlarms::per_hour(0.36).unwrap(); // 10⁻⁵ per period
/// let mut frozen = Frozen::new(0.02, Millis(100), promise).unwrap();
/// let flags = (0..6).map(|period| {
///     frozen.observe(&[Some(Sensed { taken: Millis(period * 100), value: 0.3 })])
/// });
/// assert_eq!(flags.collect::<Vec<_>>()[1..4], [Flag::Clear, Flag::Raised, Flag::Raised]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Frozen {
    /// The newest reading of each sensor, and how many were the same.
    sensors: [(Option<Sensed<f64>>, Run); MOST],
}

/// Ranges that are read: at the least one a thing is too near, at the largest one there is none.
const READS_M: core::ops::Range<f64> = 0.12..4.9;

impl Frozen {
    /// An observer of ranges with an error of a deviation in metres.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        deviation: f64,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the deviation of a range in m", deviation, 0.005, 1.0)?;
        within("a period in ms", period.0 as f64, 1.0, 60_000.0)?;
        let same = SAME_M / (deviation * libm::sqrt(core::f64::consts::PI));
        let run = Run::new(same, promise.per_decision(period));
        Ok(Self { sensors: core::array::from_fn(|_| (None, run.clone())) })
    }

    /// Looks at the newest ranges; those that were seen before count once.
    pub fn observe(&mut self, ranges: &[Option<Sensed<f64>>]) -> Flag {
        for ((before, run), now) in self.sensors.iter_mut().zip(ranges) {
            let Some(now) = now.filter(|it| before.is_none_or(|of| it.taken > of.taken)) else {
                continue;
            };
            let is_same = before.is_some_and(|it| (it.value - now.value).abs() < SAME_M);
            run.add(is_same && READS_M.contains(&now.value));
            *before = Some(now);
        }
        Flag::raised_if(self.sensors.iter().any(|it| it.1.is_long()))
    }
}
