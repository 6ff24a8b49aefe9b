//! Data that are late, jobs that miss their deadlines, values outside of their interval.

use crate::flag::Flag;
use crate::promise::{FalseAlarms, Run, in_a_row};
use crate::quantile::normal_quantile;
use cotama_core::units::Millis;
use cotama_devices::{Rate, SettingsError, within};

/// The most jitter, in ms.
const JITTER: f64 = 600_000.0;

/// An observer of the age of data: of a data port, or of a heartbeat.
///
/// *Assumption.* Data are taken each period T and arrive a latency L and at most a jitter J later;
/// each is lost with the chance q, independently.
///
/// *Threshold.* With k - 1 lost in a row the newest datum is at most L + J + kT old when the next
/// one arrives. An age above this means k lost ones, which begin with the chance (1 - q)qᵏ per
/// period; k is the least for which the promise holds ([`in_a_row`]).
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Rate;
/// use cotama_observers::{Age, FalseAlarms, Flag};
/// let rate = Rate { period: Millis(100), latency: Millis(20) };
/// let promise = FalseAlarms::per_hour(0.036).unwrap(); // 10⁻⁶ per period
/// let mut age = Age::new(rate, Millis(10), 0.05, promise).unwrap();
/// assert_eq!(age.most(), Millis(530)); // 5 lost in a row
/// assert_eq!(age.observe(Millis(1_530), Some(Millis(1_000))), Flag::Clear);
/// assert_eq!(age.observe(Millis(1_531), Some(Millis(1_000))), Flag::Raised);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Age {
    most: u64,
    /// The time when it was asked first: a datum that never came is as old as this.
    began: Option<Millis>,
}

impl Age {
    /// An observer of data that come at a rate, with a jitter and a chance of loss.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        rate: Rate,
        jitter: Millis,
        loss: f64,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("a period in ms", rate.period.0 as f64, 1.0, JITTER)?;
        within("a latency in ms", rate.latency.0 as f64, 0.0, JITTER)?;
        within("a jitter in ms", jitter.0 as f64, 0.0, JITTER)?;
        within("the chance of loss", loss, 0.0, 0.99)?;
        let lost = in_a_row(loss, promise.per_decision(rate.period));
        let most = rate.latency.0 + jitter.0 + rate.period.0 * u64::from(lost);
        Ok(Self { most, began: None })
    }

    /// Returns the age above which the flag is raised.
    pub const fn most(&self) -> Millis {
        Millis(self.most)
    }

    /// Looks at the time when the newest datum was taken. A datum of the future is raised too: its
    /// clock is wrong.
    pub fn observe(&mut self, now: Millis, taken: Option<Millis>) -> Flag {
        let began = *self.began.get_or_insert(now);
        let taken = taken.unwrap_or(began);
        Flag::raised_if(taken > now || now.0 - taken.0 > self.most)
    }
}

/// The end of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Job {
    /// Ended before its deadline.
    Kept,
    /// Ended later, or not at all.
    Missed,
}

/// An observer of deadlines: raised once too many jobs in a row have missed theirs, as a transient
/// violation is tolerated (Durand et al., TAROS 2010, Section VI.A.1).
///
/// *Assumption.* A sound module misses with the chance q, independently. *Threshold.* k in a row,
/// the least with (1 - q)qᵏ at most the promise per period. Once in a row, the flag falls with the
/// first deadline that is kept.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_observers::{Deadlines, FalseAlarms, Flag, Job};
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let mut late = Deadlines::new(Millis(100), 0.02, promise).unwrap();
/// let flags = [Job::Missed; 3].map(|it| late.observe(Some(it)));
/// assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised]);
/// assert_eq!(late.observe(Some(Job::Kept)), Flag::Clear);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deadlines {
    run: Run,
}

impl Deadlines {
    /// An observer of jobs of a period, each missed with a chance.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(period: Millis, missed: f64, promise: FalseAlarms) -> Result<Self, SettingsError> {
        within("a period in ms", period.0 as f64, 1.0, JITTER)?;
        within("the chance that a deadline is missed", missed, 0.0, 0.99)?;
        Ok(Self { run: Run::new(missed, promise.per_decision(period)) })
    }

    /// Returns how many in a row raise the flag.
    pub const fn most(&self) -> u32 {
        self.run.most()
    }

    /// Looks at the job of a period; `None` if none was due, which changes nothing.
    pub fn observe(&mut self, job: Option<Job>) -> Flag {
        job.iter().for_each(|it| self.run.add(*it == Job::Missed));
        Flag::raised_if(self.run.is_long())
    }
}

/// An observer of a value that has a valid interval (Durand et al., TAROS 2010, Section IV.B.3).
///
/// *Assumption.* Readings have a normal error of deviation σ around a value within the interval.
/// *Threshold.* Each end is moved outwards by zσ; z is exceeded with the chance that the promise
/// leaves to a period, which is met with equality if the value lies at one of the ends. A reading
/// that is no number is raised at once.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_observers::{FalseAlarms, Flag, Interval};
/// let promise = FalseAlarms::per_hour(36.0).unwrap(); // 10⁻³ per period
/// let volts = Interval::new([11.0, 14.0], 0.1, Millis(100), promise).unwrap();
/// assert_eq!(volts.observe(Some(14.3)), Flag::Clear);
/// assert_eq!(volts.observe(Some(14.4)), Flag::Raised);
/// assert_eq!(volts.observe(Some(f64::NAN)), Flag::Raised);
/// assert_eq!(volts.observe(None), Flag::Missing);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    least: f64,
    most: f64,
}

impl Interval {
    /// An observer of a value from the first to the second end, read with a deviation.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        [least, most]: [f64; 2],
        deviation: f64,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the least value", least, -1e12, 1e12)?;
        within("the most value", most, least, 1e12)?;
        within("the deviation of a value", deviation, 0.0, 1e12)?;
        let aside = normal_quantile(promise.per_decision(period)) * deviation;
        Ok(Self { least: least - aside, most: most + aside })
    }

    /// Looks at a reading.
    pub fn observe(&self, value: Option<f64>) -> Flag {
        value.map_or(Flag::Missing, |it| Flag::raised_if(!(self.least..=self.most).contains(&it)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::{Measured, normal};
    use cotama_devices::Streams;

    const RATE: Rate = Rate { period: Millis(100), latency: Millis(20) };

    /// 360 per hour at 10 Hz: a hundredth per period.
    fn often() -> FalseAlarms {
        FalseAlarms::per_hour(360.0).unwrap()
    }

    #[test]
    fn ages_alarm_as_often_as_lost_data_begin_runs() {
        let mut lost = Streams::new(1).stream("loss");
        let mut age = Age::new(RATE, Millis(10), 0.3, often()).unwrap();
        let (mut measured, mut newest) = (Measured::of(0.01), None);
        for period in 1..=200_000_u64 {
            let taken = period * 100;
            if lost.part() >= 0.3 {
                newest = Some(Millis(taken));
            }
            // Asked before the next arrives, when the age is largest.
            let flag = age.observe(Millis(taken + 129), newest);
            measured.period(flag);
        }
        // k = 4: 0.7 · 0.3⁴ = 0.00567.
        measured.is_as_computed("age", 0.7 * 0.0081);
    }

    #[test]
    fn deadlines_alarm_as_often_as_sound_modules_miss() {
        let mut luck = Streams::new(2).stream("late");
        let mut late = Deadlines::new(Millis(100), 0.2, often()).unwrap();
        let mut measured = Measured::of(0.01);
        for _ in 0..200_000 {
            let job = if luck.part() < 0.2 { Job::Missed } else { Job::Kept };
            measured.period(late.observe(Some(job)));
        }
        assert_eq!(late.most(), 3);
        measured.is_as_computed("deadlines", 0.8 * 0.008);
    }

    #[test]
    fn intervals_alarm_as_often_as_promised_at_both_ends() {
        for end in [-1.0, 2.0] {
            let mut noise = Streams::new(3).stream("noise");
            let interval = Interval::new([-1.0, 2.0], 0.5, Millis(100), often()).unwrap();
            let mut measured = Measured::of(often().per_decision(Millis(100)));
            for _ in 0..200_000 {
                measured.decision(interval.observe(Some(end + 0.5 * normal(&mut noise))));
            }
            measured.is_as_promised("interval");
        }
    }

    #[test]
    fn a_datum_that_never_comes_is_raised_after_its_age() {
        let mut age = Age::new(RATE, Millis(0), 0.0, often()).unwrap();
        let flags = [500, 620, 621].map(|now| age.observe(Millis(now), None));
        assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised]);
    }

    #[test]
    fn a_datum_of_the_future_is_raised() {
        let mut age = Age::new(RATE, Millis(0), 0.0, often()).unwrap();
        assert_eq!(age.observe(Millis(100), Some(Millis(101))), Flag::Raised);
    }

    #[test]
    fn a_module_that_is_not_due_keeps_its_count() {
        let mut late = Deadlines::new(Millis(100), 0.2, often()).unwrap();
        let told = [Some(Job::Missed), Some(Job::Missed), None, Some(Job::Missed), None];
        let flags = told.map(|it| late.observe(it) == Flag::Raised);
        assert_eq!(flags, [false, false, false, true, true]);
    }
}
