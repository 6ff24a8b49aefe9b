//! The decision that wheels or motors are not sound, and which fault they have.

use super::bank::Bank;
use super::model::{MODES, Mode};
use super::{WheelSettings, Wheels};
use crate::flag::Flag;
use crate::newest::Newest;
use crate::promise::{FalseAlarms, Run};
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// Chances of which the threshold of a [`WheelObserver`] is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelRates {
    /// The false alarms that are allowed.
    pub false_alarms: FalseAlarms,
    /// The time between two readings.
    pub period: Millis,
    /// Faults of wheels and motors per hour, as the analysis of failures has them.
    pub faults_per_hour: f64,
    /// Chance that the fault that is told is another one.
    pub wrong: f64,
}

impl WheelRates {
    /// Rates of a robot with readings at 10 Hz: a false alarm in 27 hours. Assumed: a fault in 100
    /// hours, a wrong fault in 20.
    ///
    /// # Errors
    /// False alarms that are out of range.
    pub fn rare(false_alarms_per_hour: f64) -> Result<Self, SettingsError> {
        Ok(Self {
            false_alarms: FalseAlarms::per_hour(false_alarms_per_hour)?,
            period: Millis(100),
            faults_per_hour: 0.01,
            wrong: 0.05,
        })
    }
}

/// A fault of wheels or motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagnosis {
    /// The most likely fault.
    pub mode: Mode,
    /// Probability of it, if any fault is there.
    pub share: f64,
}

/// Chance that a broken robot is sound again after a period: a slip ends after 5 s on average.
const HEALS: f64 = 0.02;

/// An observer of wheels and motors by a bank of Kalman filters ([`Bank`]).
///
/// *Assumption.* The robot is as one of the models says, with normal errors; it breaks with the
/// chance ρ per period.
///
/// *Threshold.* Of a sound robot the sum of likelihood ratios that begin at each period past,
/// R = (1 - p₀) / (ρ p₀) with p₀ the probability of the nominal model, grows by 1 per period on
/// average: R - n is a martingale. So an alarm at R ≥ A comes after A periods or more on average
/// (Pollak, "Optimal detection of a change in distribution", Annals of Statistics 13(1), 1985).
/// With A = 1/p periods between alarms the level of 1 - p₀ is ρA / (1 + ρA). R passes A by far, as
/// the models are far apart, and faults that heal lower it: alarms are some 60 times rarer.
///
/// *Time.* An outlier lasts one period, which the level must outlast: k in a row, the least with
/// (1 - q)qᵏ ≤ p. *Which fault.* Its share of the faults' probability must be at least 1 less the
/// chance of a wrong one, by Bayes's rule.
///
/// *Measured* on simulated motors whose friction, lag and currents are up to a tenth other than the
/// models have them, with a false alarm promised in 28 hours; 100 runs a side, faults of random
/// size: how often the fault is told by its name within 5 s, and the median time to the flag. A
/// turn has wheels at 1.23 and 2.87 rad/s. Beside it, times of cumulated sums on the innovations of
/// the nominal filter (Page, Biometrika 41, 1954) at the same promise, which name no fault.
///
/// | fault | 0.1 m/s | 0.2 m/s | 0.3 m/s | turn | sums |
/// | --- | --- | --- | --- | --- | --- |
/// | encoder dead | 200, 0.3 s | 200, 0.3 s | 200, 0.3 s | 200, 0.3 s | 0.1 s |
/// | encoder lossy | 177, 0.4 s | 200, 0.3 s | 200, 0.3 s | 197, 0.3 s | 0.2 to 0.6 s |
/// | motor weak | 199, 0.3 s | 200, 0.2 s | 200, 0.2 s | 200, 0.3 s | 0.2 to 0.4 s |
/// | wheel blocked | 200, 0.2 s | 200, 0.2 s | 200, 0.2 s | 200, 0.2 s | 0.1 s |
/// | slip (100 runs) | 100, 0.3 s | 100, 0.3 s | 100, 0.3 s | 100, 0.3 s | 0.1 to 0.2 s |
///
/// In 400 runs of each mode, 26 of 800 lossy encoders were told by no name, and one weak motor by
/// that of a lossy encoder; all others by their own. Those that were missed lose 5 to 7 % at wheel
/// speeds near 1 rad/s. Sums find nearly all of these too, within 0.6 s.
///
/// | a sound robot, 300,000 periods, 10⁻⁴ promised | models | sums |
/// | --- | --- | --- |
/// | as assumed | 0 | 29 |
/// | as assumed, 10⁻² promised | 49 | 2,936 |
/// | an outlier of an encoder in 1,000 periods | 0 | 258 |
/// | friction 20 % higher | 0 | 12,943 |
/// | lag 20 % longer, shorter | 1, 0 | 256, 56 |
/// | turn 2 % larger | 0 | 494 |
///
/// So models name the fault and bear what sums do not; sums are one or two periods sooner.
///
/// Nothing is decided while the robot is told to stand and stands: all models read the same then.
/// Without a gyro, slip reads as the nominal model and is not found.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{Flag, Mode, Side, WheelObserver, WheelRates, WheelSettings, Wheels};
/// let rates = WheelRates::rare(0.036).unwrap();
/// let mut observer = WheelObserver::new(WheelSettings::pioneer(), rates).unwrap();
/// // At 0.2 m/s the left encoder reads 0, while its motor draws what it should.
/// let sound = Wheels {
///     dt: 0.1,
///     commanded: [2.05; 2],
///     encoder: [2.05; 2],
///     current: [0.16; 2],
///     gyro: Some(0.0),
/// };
/// let read = |it: u64, value| Some(Sensed { taken: Millis(it * 100), value });
/// for it in 0..20 {
///     assert_eq!(observer.observe(read(it, sound)), Flag::Clear);
/// }
/// let dead = Wheels { encoder: [0.0, 2.05], ..sound };
/// let flags: Vec<_> = (20..23).map(|it| observer.observe(read(it, dead))).collect();
/// assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised]);
/// assert_eq!(observer.diagnosis().unwrap().mode, Mode::EncoderDead(Side::Left));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WheelObserver {
    bank: Bank,
    /// The least speed at which models differ, in rad/s.
    stands: f64,
    /// The level of the probability of any fault, as odds.
    odds: f64,
    newest: Newest,
    run: Run,
    wrong: f64,
}

impl WheelObserver {
    /// An observer of wheels, with a level from rates.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(settings: WheelSettings, rates: WheelRates) -> Result<Self, SettingsError> {
        settings.check()?;
        within("a period in ms", rates.period.0 as f64, 1.0, 1_000.0)?;
        within("the faults per hour", rates.faults_per_hour, 1e-9, 360.0)?;
        within("the chance of a wrong fault", rates.wrong, 1e-6, 0.5)?;
        let chance = rates.false_alarms.per_decision(rates.period);
        let breaks = rates.faults_per_hour * rates.period.0 as f64 / 3_600_000.0;
        Ok(Self {
            bank: Bank::new(settings, breaks, HEALS),
            stands: settings.dry_from,
            odds: breaks / chance,
            newest: Newest::default(),
            run: Run::new(settings.outliers, chance),
            wrong: rates.wrong,
        })
    }

    /// Returns the level of the probability of any fault, and for how many periods in a row.
    pub fn level(&self) -> (f64, u32) {
        (self.odds / (1.0 + self.odds), self.run.most())
    }

    /// Returns the filters.
    pub const fn bank(&self) -> &Bank {
        &self.bank
    }

    /// Looks at the newest period; one that was seen before counts once. Numbers that are not
    /// finite, or a period that is not from 1 ms to 1 s, count as missing.
    pub fn observe(&mut self, wheels: Option<Sensed<Wheels>>) -> Flag {
        match wheels {
            Some(it) if it.value.is_finite() => {
                if self.newest.is_new(it.taken) {
                    self.judge(&it.value);
                }
                Flag::raised_if(self.run.is_long())
            }
            _ => Flag::Missing,
        }
    }

    /// Judges a period whose numbers are finite.
    pub(crate) fn judge(&mut self, wheels: &Wheels) -> Flag {
        let all = wheels.commanded.iter().chain(&wheels.encoder);
        let stands = all.chain(wheels.gyro.as_ref()).all(|it| it.abs() < self.stands);
        if !stands {
            self.bank.step(wheels);
            let [sound, ..] = *self.bank.probabilities();
            self.run.add(1.0 - sound >= self.odds * sound);
        }
        Flag::raised_if(self.run.is_long())
    }

    /// Returns the fault, once the flag is raised and one is likely enough.
    pub fn diagnosis(&self) -> Option<Diagnosis> {
        let [sound, faults @ ..] = self.bank.probabilities();
        let most = faults.iter().zip(MODES.into_iter().skip(1));
        let (probability, mode) = most.max_by(|a, b| a.0.total_cmp(b.0))?;
        let share = probability / (1.0 - sound).max(*probability);
        let is_sure = self.run.is_long() && share >= 1.0 - self.wrong;
        is_sure.then_some(Diagnosis { mode, share })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wheels::Side;

    const STANDS: Wheels = Wheels {
        dt: 0.1,
        commanded: [0.0; 2],
        encoder: [0.0; 2],
        current: [0.0; 2],
        gyro: Some(0.0),
    };
    const DRIVES: Wheels =
        Wheels { commanded: [2.05; 2], encoder: [2.05; 2], current: [0.1615; 2], ..STANDS };

    fn observer() -> WheelObserver {
        WheelObserver::new(WheelSettings::pioneer(), WheelRates::rare(0.036).unwrap()).unwrap()
    }

    fn after(observer: &mut WheelObserver, wheels: Wheels, periods: usize) -> Flag {
        (0..periods).map(|_| observer.judge(&wheels)).last().unwrap()
    }

    #[test]
    fn the_level_follows_from_the_rates() {
        // Of a fault in 100 h and a false alarm in 27.8 h: 0.278 to 1.
        let (level, periods) = observer().level();
        assert_eq!((format!("{level:.4}"), periods), ("0.2174".to_owned(), 2));
    }

    #[test]
    fn a_level_is_one_of_odds_not_of_a_probability() {
        let rates = WheelRates { faults_per_hour: 1.0, ..WheelRates::rare(0.036).unwrap() };
        let mut observer = WheelObserver::new(WheelSettings::pioneer(), rates).unwrap();
        assert_eq!(format!("{:.4}", observer.level().0), "0.9653"); // odds of 27.8
        after(&mut observer, DRIVES, 20);
        let dead = Wheels { encoder: [0.0, 2.05], ..DRIVES };
        assert_eq!(after(&mut observer, dead, 5), Flag::Raised);
    }

    #[test]
    fn a_robot_that_stands_tells_nothing() {
        let mut observer = observer();
        let before = observer.clone();
        assert_eq!(after(&mut observer, STANDS, 10_000), Flag::Clear);
        assert_eq!(observer, before);
        // A wheel that turns though it is told to stand is looked at.
        let runs_away = Wheels { encoder: [3.0, 0.0], gyro: Some(-0.9), ..STANDS };
        after(&mut observer, runs_away, 3);
        assert_ne!(observer, before);
    }

    #[test]
    fn numbers_that_are_none_are_missing_and_change_nothing() {
        let mut observer = observer();
        after(&mut observer, DRIVES, 10);
        let before = observer.clone();
        let bad = [
            Wheels { dt: 0.0, ..DRIVES },
            Wheels { dt: f64::NAN, ..DRIVES },
            Wheels { encoder: [f64::INFINITY, 0.0], ..DRIVES },
            Wheels { gyro: Some(f64::NAN), ..DRIVES },
        ];
        let read = |value| Some(Sensed { taken: Millis(5_000), value });
        assert!(bad.iter().all(|it| observer.observe(read(*it)) == Flag::Missing));
        assert_eq!(observer.observe(None), Flag::Missing);
        assert_eq!(observer, before);
    }

    #[test]
    fn a_period_that_was_seen_counts_once() {
        let mut observer = observer();
        after(&mut observer, DRIVES, 20);
        let dead = Wheels { encoder: [0.0, 2.05], ..DRIVES };
        for _ in 0..10 {
            let flag = observer.observe(Some(Sensed { taken: Millis(5_000), value: dead }));
            assert_eq!(flag, Flag::Clear);
        }
    }

    #[test]
    fn a_slip_is_found_by_its_gyro_alone() {
        let slips = Wheels { gyro: Some(0.4), ..DRIVES };
        let mut with = observer();
        after(&mut with, DRIVES, 20);
        assert_eq!(after(&mut with, slips, 5), Flag::Raised);
        assert_eq!(with.diagnosis().map(|it| it.mode), Some(Mode::Slip));
        let mut without = observer();
        after(&mut without, Wheels { gyro: None, ..DRIVES }, 20);
        assert_eq!(after(&mut without, Wheels { gyro: None, ..slips }, 50), Flag::Clear);
    }

    #[test]
    fn probabilities_stay_those_of_a_choice_whatever_is_read() {
        let mut observer = observer();
        for at in 0..1_000 {
            let far = if at % 3 == 0 { 9e5 } else { -9e5 };
            let odd = Wheels { encoder: [far, 0.0], current: [-far, far], ..DRIVES };
            observer.judge(&odd);
            let sum: f64 = observer.bank().probabilities().iter().sum();
            assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        }
    }

    #[test]
    fn a_fault_that_ends_lets_the_flag_fall() {
        let mut observer = observer();
        after(&mut observer, DRIVES, 20);
        assert_eq!(
            after(&mut observer, Wheels { encoder: [2.05, 0.0], ..DRIVES }, 5),
            Flag::Raised
        );
        assert_eq!(observer.diagnosis().map(|it| it.mode), Some(Mode::EncoderDead(Side::Right)));
        assert_eq!(after(&mut observer, DRIVES, 5), Flag::Clear);
        assert_eq!(observer.diagnosis(), None);
    }
}
