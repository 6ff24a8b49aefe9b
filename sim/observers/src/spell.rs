//! Spells in which a sound signal looks as a broken one does, and how long they last.

use crate::promise::FalseAlarms;
use cotama_core::units::Millis;
use cotama_devices::{SettingsError, within};

/// The tail of the lengths of such spells: how often they are long, and by how much.
///
/// *Assumption.* Spells longer than `beyond` begin at a constant rate, and last longer than that by
/// an exponential length: the tail that the excesses of most lengths tend to, or one that is too
/// heavy where lengths are bounded (Pickands, Annals of Statistics 3(1), 1975; Davison and Smith,
/// Journal of the Royal Statistical Society B 52(3), 1990, with shape 0).
///
/// *Threshold.* The rate of spells longer than w is begins · exp(-(w - beyond) / excess); the least
/// w at which that is at most the promised rate is [`limit`](Self::limit).
///
/// Lengths have any unit, metres of way or seconds, the same for a spell and its tail.
///
/// ```
/// use cotama_observers::{FalseAlarms, Tail};
/// // Six times an hour a robot is led back for more than 2 s, for 1.5 s more on average.
/// let tail = Tail::new(2.0, 6.0, 1.5).unwrap();
/// let limit = tail.limit(FalseAlarms::per_hour(0.01).unwrap());
/// assert_eq!(format!("{limit:.2}"), "11.60"); // 2 + 1.5 ln 600
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tail {
    beyond: f64,
    begins: f64,
    excess: f64,
}

impl Tail {
    /// A tail beyond a length, with the spells per hour that are longer and their mean excess.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(beyond: f64, begins_per_hour: f64, excess: f64) -> Result<Self, SettingsError> {
        within("the length beyond which a tail begins", beyond, 0.0, 1e6)?;
        within("the spells of a tail per hour", begins_per_hour, 0.0, 1e6)?;
        within("the mean excess of a tail", excess, 0.0, 1e6)?;
        Ok(Self { beyond, begins: begins_per_hour, excess })
    }

    /// Returns the length that a sound signal's spells exceed as seldom as promised.
    pub fn limit(&self, promise: FalseAlarms) -> f64 {
        let often = (self.begins / promise.rate()).max(1.0);
        self.beyond + self.excess * libm::log(often)
    }
}

/// The spells of a sound signal, as a run shows them.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_observers::{Survey, Tail};
/// let mut survey = Survey::beyond(2.0).unwrap();
/// [0.5, 2.5, 4.0, 1.9, 3.0].map(|it| survey.add(it));
/// survey.watch(Millis(1_800_000));
/// // One more than the three that are longer than 2 s, and twice as long as these.
/// assert_eq!(survey.tail(), Tail::new(2.0, 8.0, 1.375));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Survey {
    beyond: f64,
    longer: u32,
    excess: f64,
    hours: f64,
}

impl Survey {
    /// A survey of spells longer than a length above 0.
    ///
    /// # Errors
    /// A length that is out of range.
    pub fn beyond(length: f64) -> Result<Self, SettingsError> {
        within("the length beyond which a tail begins", length, 1e-6, 1e6)?;
        Ok(Self { beyond: length, longer: 0, excess: 0.0, hours: 0.0 })
    }

    /// Adds a spell that has ended.
    pub fn add(&mut self, length: f64) {
        if length > self.beyond {
            self.longer = self.longer.saturating_add(1);
            self.excess += length - self.beyond;
        }
    }

    /// Adds time in which the signal was watched.
    pub fn watch(&mut self, time: Millis) {
        self.hours += time.0 as f64 / 3_600_000.0;
    }

    /// Returns the tail: the mean excess is the likeliest one. A further spell of twice the length
    /// is added, so that a survey without long spells does not promise that there are none.
    ///
    /// # Errors
    /// A survey of no time.
    pub fn tail(&self) -> Result<Tail, SettingsError> {
        let longer = f64::from(self.longer) + 1.0;
        let excess = (self.excess + self.beyond) / longer;
        Tail::new(self.beyond, longer / self.hours, excess)
    }
}

/// A spell that goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spell {
    length: f64,
    limit: f64,
}

impl Spell {
    pub(crate) const fn new(limit: f64) -> Self {
        Self { length: 0.0, limit }
    }

    pub(crate) const fn limit(&self) -> f64 {
        self.limit
    }

    pub(crate) fn goes_on(&mut self, by: f64) {
        self.length += by.max(0.0);
    }

    pub(crate) fn ends(&mut self) -> f64 {
        core::mem::take(&mut self.length)
    }

    pub(crate) fn is_long(&self) -> bool {
        self.length > self.limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flag::Flag;
    use crate::measured::Measured;
    use cotama_devices::Streams;

    fn exponential(mean: f64, stream: &mut cotama_devices::Stream) -> f64 {
        -mean * libm::log(1.0 - stream.part())
    }

    /// A tail that is surveyed over 20 hours holds its promise over 20,000 others.
    #[test]
    fn surveyed_spells_alarm_as_often_as_promised() {
        let mut luck = Streams::new(4).stream("spells");
        let mut survey = Survey::beyond(1.0).unwrap();
        for _ in 0..20 * 60 {
            survey.add(exponential(2.0, &mut luck));
            survey.watch(Millis(60_000));
        }
        let limit = survey.tail().unwrap().limit(FalseAlarms::per_hour(0.06).unwrap());
        // The true tail of 60 spells per hour: 2 ln 1000 = 13.8 s.
        assert!((13.0..15.0).contains(&limit), "{limit}");
        let true_limit = Tail::new(1.0, 60.0 * libm::exp(-0.5), 2.0)
            .unwrap()
            .limit(FalseAlarms::per_hour(0.06).unwrap());
        let mut measured = Measured::of(1e-3 * (1.0 + 1e-9));
        for _ in 0..1_200_000 {
            let mut spell = Spell::new(true_limit);
            spell.goes_on(exponential(2.0, &mut luck));
            measured.decision(Flag::raised_if(spell.is_long()));
        }
        measured.is_as_computed("spells of a known tail", 1e-3);
    }

    #[test]
    fn a_survey_of_no_time_is_refused() {
        assert!(Survey::beyond(1.0).unwrap().tail().is_err());
    }

    #[test]
    fn a_promise_above_the_rate_of_spells_is_kept_at_the_beginning_of_the_tail() {
        let tail = Tail::new(2.0, 1.0, 5.0).unwrap();
        assert_eq!(tail.limit(FalseAlarms::per_hour(10.0).unwrap()), 2.0);
    }
}
