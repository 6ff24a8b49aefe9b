//! Conditions that a sound robot shows too, for short spells.

use crate::flag::Flag;
use crate::promise::FalseAlarms;
use crate::spell::{Spell, Survey, Tail};
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError};

/// An observer of a condition that lasts: a scan that sees nothing, or that is not as expected.
///
/// *Assumption.* The spells of a sound robot, in seconds, have a [`Tail`], as surveyed
/// ([`LastingSurvey`]). *Threshold.* A spell is raised that is longer than u + m ln(b / λ).
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, Flag, Lasting, Tail};
/// let tail = Tail::new(0.5, 10.0, 0.2).unwrap();
/// let mut blind = Lasting::new(tail, FalseAlarms::per_hour(0.01).unwrap());
/// let is_blind = |step: u64| Some(Sensed { taken: Millis(step * 100), value: true });
/// let flags: Vec<_> = (0..21).map(|it| blind.observe(is_blind(it))).collect();
/// assert_eq!(flags[18..], [Flag::Clear, Flag::Raised, Flag::Raised]); // 0.5 s + 0.2 s ln 1000
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Lasting {
    spell: Spell,
    last: Option<Millis>,
}

impl Lasting {
    /// An observer of a condition whose spells have a tail.
    pub fn new(tail: Tail, promise: FalseAlarms) -> Self {
        Self { spell: Spell::new(tail.limit(promise)), last: None }
    }

    /// Looks at the newest reading; one that was seen before counts once. A spell ends where
    /// nothing is known.
    pub fn observe(&mut self, it: Option<Sensed<bool>>) -> Flag {
        let Some(Sensed { taken, value }) = it else {
            self.last = None;
            self.spell.ends();
            return Flag::Missing;
        };
        let last = self.last.replace(taken).unwrap_or(taken);
        if value {
            self.spell.goes_on(taken.0.saturating_sub(last.0) as f64 / 1_000.0);
        } else {
            self.spell.ends();
        }
        Flag::raised_if(self.spell.is_long())
    }
}

/// A survey of the spells of a condition.
#[derive(Clone, Debug, PartialEq)]
pub struct LastingSurvey {
    survey: Survey,
    spell: Spell,
    last: Option<Millis>,
}

impl LastingSurvey {
    /// A survey of spells longer than a time in seconds.
    ///
    /// # Errors
    /// A time that is out of range.
    pub fn beyond(seconds: f64) -> Result<Self, SettingsError> {
        let spell = Spell::new(f64::INFINITY);
        Ok(Self { survey: Survey::beyond(seconds)?, spell, last: None })
    }

    /// Looks at a reading of a sound robot; one that was seen before counts once.
    pub fn look(&mut self, Sensed { taken, value }: Sensed<bool>) {
        let time = taken.0.saturating_sub(self.last.replace(taken).unwrap_or(taken).0);
        self.survey.watch(Millis(time));
        if value {
            self.spell.goes_on(time as f64 / 1_000.0);
        } else {
            self.survey.add(self.spell.ends());
        }
    }

    /// Returns the tail of the spells.
    ///
    /// # Errors
    /// A survey of no time.
    pub fn tail(&self) -> Result<Tail, SettingsError> {
        self.survey.tail()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_survey_notes_each_spell_when_it_ends() {
        let mut survey = LastingSurvey::beyond(0.2).unwrap();
        // Two spells of 0.6 s and one of 0.1 s in an hour.
        let lasts = |at: u64| (100..=105).contains(&at) || (300..=305).contains(&at) || at == 700;
        for at in 0..=36_000 {
            survey.look(Sensed { taken: Millis(at * 100), value: lasts(at) });
        }
        let limit = survey.tail().unwrap().limit(FalseAlarms::per_hour(0.01).unwrap());
        // Two that are 0.4 s longer than 0.2 s, and one that is 0.2 s longer: a third of a second
        // on average, three times an hour.
        assert_eq!(format!("{limit:.6}"), format!("{:.6}", 0.2 + libm::log(300.0) / 3.0));
    }
}
