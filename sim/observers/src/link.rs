//! The level of a radio link: its mean, its trend, and the time until it is lost.

use crate::flag::Flag;
use crate::promise::FalseAlarms;
use crate::quantile::normal_quantile;
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// The most levels of a window.
pub const MAX_LEVELS: usize = 32;

/// An observer of the level of a link.
///
/// *Assumption.* Levels have independent normal errors of deviation σ about a straight line of
/// time.
///
/// *Threshold.* A link is poor once the mean of n levels is below the least one by zσ/√n, and good
/// again once it is above by as much: a link at the least level is called poor with the chance of
/// a decision. A link *goes* if the line is below the least level at the end of a time ahead by z
/// deviations of that forecast, σ √(1/n + (t - t̄)² / Σ(tᵢ - t̄)²) (Montgomery, Peck, Vining,
/// Introduction to Linear Regression Analysis, 5th ed., Section 2.4.2, with σ known).
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{FalseAlarms, Flag, LinkLevel};
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let times = [Millis(500), Millis(20_000)]; // a level each 0.5 s; looks 20 s ahead
/// let mut link = LinkLevel::new(-80.0, 2.0, 20, times, promise).unwrap();
/// for it in 0..20_u64 {
///     let level = Sensed { taken: Millis(it * 500), value: -50.0 - it as f64 };
///     link.observe(Some(level));
/// }
/// // It falls by 2 dB a second, from -69 dBm on.
/// assert_eq!((link.poor(), link.goes()), (Flag::Clear, Flag::Raised));
/// assert_eq!(link.time_to_loss_s(), Some(5.5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LinkLevel {
    least: f64,
    margin: f64,
    /// The deviation of a level, times the quantile.
    aside: f64,
    ahead_s: f64,
    levels: [Sensed<f64>; MAX_LEVELS],
    window: usize,
    /// The levels that have come; the newest stands at this number, less one, modulo the window.
    count: usize,
    is_poor: bool,
}

impl LinkLevel {
    /// An observer of a least level in dBm, with a deviation in dB, of a number of levels, with the
    /// period of levels and the time that is looked ahead.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        least: f64,
        deviation: f64,
        levels: usize,
        [period, ahead]: [Millis; 2],
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the least level in dBm", least, -200.0, 100.0)?;
        within("the deviation of a level in dB", deviation, 1e-3, 100.0)?;
        within("the levels of a window", levels as f64, 3.0, MAX_LEVELS as f64)?;
        within("a period in ms", period.0 as f64, 1.0, 600_000.0)?;
        within("the time ahead in ms", ahead.0 as f64, 0.0, 600_000.0)?;
        let aside = deviation * normal_quantile(promise.per_decision(period));
        Ok(Self {
            least,
            margin: aside / libm::sqrt(levels as f64),
            aside,
            ahead_s: ahead.0 as f64 / 1_000.0,
            levels: [Sensed { taken: Millis(0), value: 0.0 }; MAX_LEVELS],
            window: levels,
            count: 0,
            is_poor: false,
        })
    }

    fn newest(&self) -> Option<&Sensed<f64>> {
        self.levels.get((self.count.checked_sub(1)?) % self.window)
    }

    /// Looks at the newest level, and says whether the link is poor. A level that was seen before
    /// counts once.
    pub fn observe(&mut self, level: Option<Sensed<f64>>) -> Flag {
        let Some(level) = level.filter(|it| it.value.is_finite()) else { return Flag::Missing };
        if self.newest().is_none_or(|it| level.taken > it.taken) {
            if let Some(room) = self.levels.get_mut(self.count % self.window) {
                *room = level;
            }
            self.count += 1;
            if let Some(Line { mean, .. }) = self.line() {
                self.is_poor = if self.is_poor {
                    mean <= self.least + self.margin
                } else {
                    mean < self.least - self.margin
                };
            }
        }
        self.poor()
    }

    /// Whether the link is poor.
    pub const fn poor(&self) -> Flag {
        Flag::raised_if(self.is_poor)
    }

    /// Whether the link will be below its least level at the end of the time ahead.
    pub fn goes(&self) -> Flag {
        let Some(line) = self.line() else { return Flag::Missing };
        let far = line.since_mean + self.ahead_s;
        let deviation = libm::sqrt(1.0 / self.window as f64 + far * far / line.squares);
        Flag::raised_if(line.mean + line.slope * far < self.least - self.aside * deviation)
    }

    /// Returns the time in seconds until the line meets the least level: 0 if it is below, `None`
    /// if it does not fall or too few levels have come.
    pub fn time_to_loss_s(&self) -> Option<f64> {
        let line = self.line()?;
        let above = line.mean + line.slope * line.since_mean - self.least;
        if above <= 0.0 {
            return Some(0.0);
        }
        (line.slope < 0.0).then(|| -above / line.slope)
    }

    /// Returns the line of least squares through a whole window.
    fn line(&self) -> Option<Line> {
        if self.count < self.window {
            return None;
        }
        let newest = self.newest()?.taken;
        let n = self.window as f64;
        let before = |it: &Sensed<f64>| newest.0.saturating_sub(it.taken.0) as f64 / 1_000.0;
        let levels = || self.levels.iter().take(self.window);
        let since_mean = levels().map(before).sum::<f64>() / n;
        let mean = levels().map(|it| it.value).sum::<f64>() / n;
        let (mut squares, mut products) = (0.0, 0.0);
        for it in levels() {
            let time = since_mean - before(it);
            squares += time * time;
            products += time * (it.value - mean);
        }
        Some(Line { mean, slope: products / squares, since_mean, squares })
    }
}

/// A line through levels: the mean at the mean time, and how long ago that is.
struct Line {
    mean: f64,
    slope: f64,
    since_mean: f64,
    squares: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::{Measured, normal};
    use cotama_devices::Streams;

    const TIMES: [Millis; 2] = [Millis(500), Millis(10_000)];

    fn promise() -> FalseAlarms {
        FalseAlarms::per_hour(72.0).unwrap() // 0.00995 per level
    }

    fn level(number: u64, value: f64) -> Option<Sensed<f64>> {
        Some(Sensed { taken: Millis(number * 500), value })
    }

    #[test]
    fn a_link_at_its_least_level_is_poor_as_often_as_promised() {
        let mut noise = Streams::new(5).stream("link");
        let chance = promise().per_decision(Millis(500));
        let [mut poor, mut goes] = [chance; 2].map(Measured::of);
        for _ in 0..100_000 {
            // Windows of their own, as those that slide depend on each other.
            let mut link = LinkLevel::new(-80.0, 2.0, 8, TIMES, promise()).unwrap();
            let mut line = LinkLevel::new(-80.0, 2.0, 8, TIMES, promise()).unwrap();
            for it in 0..8 {
                let error = 2.0 * normal(&mut noise);
                link.observe(level(it, -80.0 + error));
                // A line that is at the least level 10 s after the last.
                line.observe(level(it, -80.0 + 0.5 * (27.0 - it as f64) + error));
            }
            poor.decision(link.poor());
            goes.decision(line.goes());
        }
        poor.is_as_promised("link poor");
        goes.is_as_promised("link goes");
    }

    #[test]
    fn a_level_between_both_thresholds_changes_nothing() {
        let mut link = LinkLevel::new(-80.0, 2.0, 4, TIMES, promise()).unwrap();
        // The margin is 2.33 · 2 / √4 = 2.33 dB.
        let levels = [-79.0, -81.0, -83.0, -81.0, -78.0, -77.0];
        let flags: Vec<_> = (0..24)
            .map(|it| link.observe(level(it, levels[it as usize / 4])))
            .skip(3)
            .step_by(4)
            .collect();
        let [clear, raised] = [Flag::Clear, Flag::Raised];
        assert_eq!(flags, [clear, clear, raised, raised, raised, clear]);
    }

    #[test]
    fn a_level_that_was_seen_counts_once() {
        let mut link = LinkLevel::new(-80.0, 2.0, 4, TIMES, promise()).unwrap();
        for _ in 0..10 {
            assert_eq!(link.observe(level(1, -120.0)), Flag::Clear);
        }
        assert_eq!((link.goes(), link.time_to_loss_s()), (Flag::Missing, None));
        assert_eq!(link.observe(None), Flag::Missing);
    }

    #[test]
    fn a_link_that_falls_is_lost_when_its_line_meets_the_level() {
        let mut link = LinkLevel::new(-80.0, 2.0, 4, TIMES, promise()).unwrap();
        (0..4).for_each(|it| _ = link.observe(level(it, -70.0 - it as f64)));
        assert_eq!(link.time_to_loss_s(), Some(3.5)); // 7 dB above, by 2 dB a second
    }

    #[test]
    fn a_link_that_rises_is_never_lost() {
        let mut link = LinkLevel::new(-80.0, 2.0, 4, TIMES, promise()).unwrap();
        (0..4).for_each(|it| _ = link.observe(level(it, -70.0 + it as f64)));
        assert_eq!((link.goes(), link.time_to_loss_s()), (Flag::Clear, None));
        (4..8).for_each(|it| _ = link.observe(level(it, -90.0 + it as f64)));
        assert_eq!(link.time_to_loss_s(), Some(0.0));
    }
}
