//! Faults of readings, as data: one language for all devices.

use crate::sensed::MAX_TIME;
use crate::settings::{SettingsError, within};
use cotama_core::units::Millis;
use cotama_streams::Stream;

/// The effect of a fault on a stream of readings, in the unit of the readings.
///
/// The kinds are those that the literature on sensor faults has (Isermann, Fault-Diagnosis Systems,
/// 2006, Section 5.1; Balaban et al., "Modeling, detection, and disambiguation of sensor faults",
/// IEEE Sensors 9(12), 2009, Section III).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Reads always this: a sonar that hears nothing reads its range.
    Stuck(f64),
    /// Repeats the last reading before the fault; of none, the first one after.
    Frozen,
    /// Reads so much more.
    Bias(f64),
    /// Reads more and more: so much a second since the fault began, until it is `most`, up or down.
    Drift {
        /// The change in a second.
        per_s: f64,
        /// The largest change.
        most: f64,
    },
    /// Adds noise of this deviation.
    Noise(f64),
    /// Loses a reading with this chance; of a scan, all of it.
    DropOut(f64),
    /// Reads as it was so long ago, which the time stamp does not tell.
    Delay(Millis),
    /// Reads nothing below `least` and above `most`.
    Saturation {
        /// The least reading.
        least: f64,
        /// The largest reading.
        most: f64,
    },
}

impl Mode {
    /// A link that fades: its level falls by so many dB in a time, and stays there.
    ///
    /// ```
    /// use cotama_core::units::Millis;
    /// use cotama_devices::Mode;
    /// assert_eq!(Mode::fading(30.0, Millis(10_000)), Mode::Drift { per_s: -3.0, most: 30.0 });
    /// ```
    pub fn fading(by_db: f64, during: Millis) -> Self {
        Self::Drift { per_s: -by_db * 1_000.0 / during.0.max(1) as f64, most: by_db }
    }
}

/// A thing that a fault does, as data.
pub trait Effect: Copy {
    /// Looks whether its numbers make sense.
    ///
    /// # Errors
    /// Numbers that are out of range.
    fn check(self) -> Result<(), SettingsError>;
}

impl Effect for Mode {
    fn check(self) -> Result<(), SettingsError> {
        const MOST: f64 = 1e12;
        match self {
            Self::Stuck(value) => within("the stuck value", value, -MOST, MOST),
            Self::Frozen => Ok(()),
            Self::Bias(by) => within("the bias", by, -MOST, MOST),
            Self::Drift { per_s, most } => {
                within("the drift in a second", per_s, -MOST, MOST)?;
                within("the largest drift", most, 0.0, f64::INFINITY)
            }
            Self::Noise(deviation) => within("the deviation of noise", deviation, 0.0, MOST),
            Self::DropOut(chance) => within("the chance of a drop-out", chance, 0.0, 1.0),
            Self::Delay(by) => within("the delay in ms", by.0 as f64, 0.0, MAX_TIME.0 as f64),
            Self::Saturation { least, most } => {
                within("the least reading", least, -f64::INFINITY, f64::INFINITY)?;
                within("the largest reading", most, least, f64::INFINITY)
            }
        }
    }
}

/// Mean times for which an intermittent fault is there and away. Each time is drawn from the
/// exponential distribution, as of a contact that has no memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Intermittent {
    /// The mean time for which it is there.
    pub there: Millis,
    /// The mean time for which it is away.
    pub away: Millis,
}

/// A fault: its effect, on a stream of readings where nothing else is said; when, and whether it
/// comes and goes.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::{Fault, Mode};
/// let deaf = Fault::new(Mode::Stuck(5.0)).unwrap().from(Millis(20_000)).until(Millis(60_000));
/// let loose = deaf.intermittent(Millis(300), Millis(2_000)).unwrap();
/// assert!(loose.is_due(Millis(20_000)) && !loose.is_due(Millis(60_000)));
/// let refused = Fault::new(Mode::DropOut(1.5)).unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "the chance of a drop-out is 1.5; give a number from 0 to 1",
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault<E = Mode> {
    effect: E,
    from: Millis,
    until: Option<Millis>,
    intermittent: Option<Intermittent>,
}

impl<E: Effect> Fault<E> {
    /// A fault from the beginning on, for good.
    ///
    /// # Errors
    /// Numbers of the effect that are out of range.
    pub fn new(effect: E) -> Result<Self, SettingsError> {
        effect.check()?;
        Ok(Self { effect, from: Millis::ZERO, until: None, intermittent: None })
    }

    /// Returns the fault, beginning at a time.
    #[must_use]
    pub fn from(self, from: Millis) -> Self {
        Self { from, ..self }
    }

    /// Returns the fault, gone at a time.
    #[must_use]
    pub fn until(self, until: Millis) -> Self {
        Self { until: Some(until), ..self }
    }

    /// Returns the fault, coming and going while it lasts.
    ///
    /// # Errors
    /// Times that are not from 1 ms to [`MAX_TIME`].
    pub fn intermittent(self, there: Millis, away: Millis) -> Result<Self, SettingsError> {
        let most = MAX_TIME.0 as f64;
        within("the mean time with the fault in ms", there.0 as f64, 1.0, most)?;
        within("the mean time without the fault in ms", away.0 as f64, 1.0, most)?;
        Ok(Self { intermittent: Some(Intermittent { there, away }), ..self })
    }

    /// Returns the effect.
    pub fn effect(&self) -> E {
        self.effect
    }

    /// Returns the time when it begins.
    pub fn begins(&self) -> Millis {
        self.from
    }

    /// Whether and how it comes and goes.
    pub fn pattern(&self) -> Option<Intermittent> {
        self.intermittent
    }

    /// Whether it has begun, and has not ended, at a time.
    pub fn is_due(&self, now: Millis) -> bool {
        self.from <= now && self.until.is_none_or(|until| now < until)
    }
}

/// The times at which an intermittent fault comes and goes.
#[derive(Clone, Copy, Debug)]
pub struct Phase {
    is_there: bool,
    until: Millis,
}

/// The most times that a fault comes and goes between two questions.
const MAX_CHANGES: usize = 1 << 16;

impl Phase {
    /// A fault that comes for the first time when it begins.
    pub fn of<E: Effect>(fault: &Fault<E>) -> Self {
        Self { is_there: false, until: fault.begins() }
    }

    /// Whether the fault is there, after it came and went as often as the time tells. Times are
    /// asked in their order.
    pub fn is_there<E: Effect>(
        &mut self,
        fault: &Fault<E>,
        chance: &mut Stream,
        now: Millis,
    ) -> bool {
        if !fault.is_due(now) {
            return false;
        }
        let Some(Intermittent { there, away }) = fault.pattern() else { return true };
        // Who asks once in a long time gets no more changes than this, and goes on from there.
        for _ in 0..MAX_CHANGES {
            if now < self.until {
                break;
            }
            let is_there = !self.is_there;
            let mean = if is_there { there } else { away };
            // Rounded up to 1 ms, so that time goes on.
            let drawn = -libm::log(1.0 - chance.part()) * mean.0 as f64;
            let until = Millis(self.until.0.saturating_add(drawn as u64 + 1));
            *self = Self { is_there, until };
        }
        self.until = self.until.max(now);
        self.is_there
    }
}
