//! Following a path: behind for too long, no progress, no convergence, motion that was not told.

use crate::flag::Flag;
use crate::promise::FalseAlarms;
use crate::quantile::{chi_square_quantile, normal_quantile};
use crate::spell::{Spell, Tail};
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// A place beside a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPath {
    /// The length along the path of the nearest point, in metres.
    pub along_m: f64,
    /// The distance from the path, to the left of it, in metres.
    pub lateral_m: f64,
}

impl OnPath {
    fn is_finite(&self) -> bool {
        self.along_m.is_finite() && self.lateral_m.is_finite()
    }
}

fn seconds(from: Millis, to: Millis) -> f64 {
    to.0.saturating_sub(from.0) as f64 / 1_000.0
}

/// An observer of a robot that is back on its path for too long (Durand et al., TAROS 2010,
/// Section VI.A.2): behind the furthest place that it reached, as avoidance leads it back.
///
/// *Assumption.* Times that a sound robot is behind have a [`Tail`], in seconds. Lengths along the
/// path have a normal error of deviation σ: a robot counts as behind if it is so by more than
/// z σ √2, so that errors alone make no long times.
///
/// *Threshold.* The length of time that the tail exceeds as seldom as promised.
#[derive(Clone, Debug, PartialEq)]
pub struct Backward {
    margin: f64,
    spell: Spell,
    /// The furthest length, and when the newest place was taken.
    last: Option<(f64, Millis)>,
}

impl Backward {
    /// An observer of places with a deviation along the path in metres.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        tail: Tail,
        deviation: f64,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the deviation along the path in m", deviation, 0.0, 10.0)?;
        let z = normal_quantile(promise.per_decision(period));
        let margin = z * deviation * core::f64::consts::SQRT_2;
        Ok(Self { margin, spell: Spell::new(tail.limit(promise)), last: None })
    }

    /// Returns the time in seconds after which the flag is raised.
    pub const fn limit_s(&self) -> f64 {
        self.spell.limit()
    }

    /// Begins a path anew.
    pub fn restart(&mut self) {
        self.spell.ends();
        self.last = None;
    }

    /// Looks at the newest place on the path.
    pub fn observe(&mut self, place: Option<Sensed<OnPath>>) -> Flag {
        let Some(Sensed { taken, value }) = place.filter(|it| it.value.is_finite()) else {
            return Flag::Missing;
        };
        let (furthest, before) = self.last.unwrap_or((value.along_m, taken));
        if value.along_m < furthest - self.margin {
            self.spell.goes_on(seconds(before, taken));
        } else {
            self.spell.ends();
        }
        self.last = Some((furthest.max(value.along_m), before.max(taken)));
        Flag::raised_if(self.spell.is_long())
    }
}

/// An observer of progress along the path: raised if the robot gets no further for too long while
/// it is told to move.
///
/// *Assumption.* Times that a sound robot waits, as for people, have a [`Tail`], in seconds.
/// *Threshold.* The time that the tail exceeds as seldom as promised. Progress is a step of the
/// length along the path that is larger than the noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    step_m: f64,
    spell: Spell,
    last: Option<(f64, Millis)>,
}

impl Progress {
    /// An observer of steps of a length in metres.
    ///
    /// # Errors
    /// A step that is out of range.
    pub fn new(tail: Tail, step_m: f64, promise: FalseAlarms) -> Result<Self, SettingsError> {
        within("a step of progress in m", step_m, 1e-6, 10.0)?;
        Ok(Self { step_m, spell: Spell::new(tail.limit(promise)), last: None })
    }

    /// Begins a path anew.
    pub fn restart(&mut self) {
        self.spell.ends();
        self.last = None;
    }

    /// Looks at the newest place on the path; time in which the robot is told to stand counts not.
    pub fn observe(&mut self, place: Option<Sensed<OnPath>>, is_told_to_move: bool) -> Flag {
        let Some(Sensed { taken, value }) = place.filter(|it| it.value.is_finite()) else {
            return Flag::Missing;
        };
        let (mut mark, before) = self.last.unwrap_or((value.along_m, taken));
        if value.along_m >= mark + self.step_m {
            mark = value.along_m;
            self.spell.ends();
        } else if is_told_to_move {
            self.spell.goes_on(seconds(before, taken));
        }
        self.last = Some((mark, before.max(taken)));
        Flag::raised_if(self.spell.is_long())
    }
}

/// An observer of convergence to the path: the control law lets the distance from it fall, at least
/// as exp(-t / τ) (Durand et al., TAROS 2010, Section IV.B.3, uniform convergence).
///
/// *Assumption.* The distance of a sound robot after a window is at most ρ = exp(-T / τ) of that at
/// its begin; both are read with independent normal errors of deviation σ.
///
/// *Threshold.* A distance that is further out than ρ of the first, on the same side or through
/// the path on the other, by zσ√(1 + ρ²): half the chance of a decision for each side. A distance
/// that begins within the noise makes alarms rarer than that.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    window: u64,
    keeps: f64,
    margin: f64,
    began: Option<Sensed<f64>>,
    flag: Flag,
}

impl Convergence {
    /// An observer of a window, a time constant of convergence, and a deviation in metres.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        window: Millis,
        constant: Millis,
        deviation: f64,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the window in ms", window.0 as f64, 1.0, 600_000.0)?;
        within("the time constant in ms", constant.0 as f64, 1.0, 600_000.0)?;
        within("the deviation aside of the path in m", deviation, 1e-6, 10.0)?;
        let keeps = libm::exp(-(window.0 as f64) / constant.0 as f64);
        let z = normal_quantile(promise.per_decision(window) / 2.0);
        let margin = z * deviation * libm::sqrt(1.0 + keeps * keeps);
        Ok(Self { window: window.0, keeps, margin, began: None, flag: Flag::Clear })
    }

    /// Begins a path anew.
    pub fn restart(&mut self) {
        (self.began, self.flag) = (None, Flag::Clear);
    }

    /// Looks at the newest place on the path.
    pub fn observe(&mut self, place: Option<Sensed<OnPath>>) -> Flag {
        let Some(Sensed { taken, value }) = place.filter(|it| it.value.is_finite()) else {
            return Flag::Missing;
        };
        let now = Sensed { taken, value: value.lateral_m };
        let began = *self.began.get_or_insert(now);
        if taken.0.saturating_sub(began.taken.0) >= self.window {
            let kept = self.keeps * began.value;
            let out = (now.value - kept.max(0.0)).max(kept.min(0.0) - now.value);
            self.flag = Flag::raised_if(out > self.margin);
            self.began = Some(now);
        }
        self.flag
    }
}

/// Speeds ahead (m/s) and to the left (rad/s), as told and as measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The speeds that were told.
    pub told: [f64; 2],
    /// The speeds that odometry measures.
    pub measured: [f64; 2],
}

/// An observer of motion against command.
///
/// *Assumption.* A sound robot changes its speeds to those that are told, as fast as its
/// accelerations allow; each measured speed has a normal error, independent from period to period.
///
/// *Threshold.* Mean errors over a window of n periods have deviations σ/√n; the sum of their
/// squares over these is a chi-square number of 2 degrees of freedom. One decision per window.
#[derive(Clone, Debug, PartialEq)]
pub struct Coherence {
    accelerations: [f64; 2],
    deviations: [f64; 2],
    periods: u32,
    most: f64,
    expected: Option<([f64; 2], Millis)>,
    sums: [f64; 2],
    count: u32,
    flag: Flag,
}

impl Coherence {
    /// An observer of so many periods, with accelerations (m/s², rad/s²) and deviations of the
    /// measured speeds (m/s, rad/s).
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        accelerations: [f64; 2],
        deviations: [f64; 2],
        [period, window]: [Millis; 2],
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("a period in ms", period.0 as f64, 1.0, 600_000.0)?;
        within("the window in ms", window.0 as f64, period.0 as f64, 600_000.0)?;
        for it in accelerations {
            within("an acceleration", it, 1e-6, 100.0)?;
        }
        for it in deviations {
            within("the deviation of a speed", it, 1e-6, 100.0)?;
        }
        Ok(Self {
            accelerations,
            deviations,
            periods: (window.0 / period.0) as u32,
            most: chi_square_quantile(2, promise.per_decision(window)),
            expected: None,
            sums: [0.0; 2],
            count: 0,
            flag: Flag::Clear,
        })
    }

    /// Looks at the speeds of a period; those that were seen before count once.
    pub fn observe(&mut self, motion: Option<Sensed<Motion>>) -> Flag {
        let is_finite = |it: &Sensed<Motion>| {
            it.value.told.iter().chain(&it.value.measured).all(|it| it.is_finite())
        };
        let Some(Sensed { taken, value }) = motion.filter(is_finite) else { return Flag::Missing };
        let (mut expected, before) = self.expected.unwrap_or((value.told, taken));
        if taken == before && self.expected.is_some() {
            return self.flag;
        }
        let dt = seconds(before, taken);
        let all = expected.iter_mut().zip(self.accelerations).zip(value.told);
        all.for_each(|((now, acceleration), told)| {
            *now += (told - *now).clamp(-acceleration * dt, acceleration * dt);
        });
        let errors = self.sums.iter_mut().zip(value.measured).zip(expected);
        errors.for_each(|((sum, measured), expected)| *sum += measured - expected);
        self.expected = Some((expected, taken));
        self.count += 1;
        if self.count >= self.periods {
            let squares = self.sums.iter().zip(self.deviations).map(|(sum, it)| sum / it);
            let squares: f64 = squares.map(|it| it * it).sum();
            self.flag = Flag::raised_if(squares / f64::from(self.count) > self.most);
            (self.sums, self.count) = ([0.0; 2], 0);
        }
        self.flag
    }
}

#[cfg(test)]
mod tests;
