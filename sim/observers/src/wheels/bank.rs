//! A filter for each model, which exchange their states.

use super::model::{Expected, MODES, Mode, Period, Side};
use super::{WheelSettings, Wheels};
use nalgebra::{Matrix2, Vector2};

/// The number of readings of a period, with a gyro.
pub(crate) const READINGS: usize = 5;
/// The least probability of a model: a filter that is ruled out comes back within few periods
/// (Maybeck and Hanlon, "Performance enhancement of a multiple model adaptive estimator", IEEE
/// Transactions on Aerospace and Electronic Systems 31(4), 1995).
const LEAST: f64 = 1e-12;
/// The greatest density of a normal number of deviation 1: 1 / √2π.
const BELL: f64 = 0.398_942_280_401_432_7;
/// The variance of a speed before the first reading, in (rad/s)².
const UNKNOWN: f64 = 1.0;

/// A Kalman filter of one model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Filter {
    state: Vector2<f64>,
    covariance: Matrix2<f64>,
}

impl Filter {
    pub(crate) fn new() -> Self {
        Self { state: Vector2::zeros(), covariance: Matrix2::identity() * UNKNOWN }
    }

    /// Goes on by a period; returns the logarithm of the likelihood of its readings, less a
    /// constant, and the innovations over their deviations.
    ///
    /// The readings have errors of their own each, so they are taken one after the other, and no
    /// matrix is inverted. A reading may be an outlier, in each model alike: its likelihood is
    /// (1 - q) N + q / spread, and the state follows it as far as it is trusted. Without that an
    /// outlier broke the promise: 7 alarms in 10,000 periods where 1 was promised, though two in a
    /// row were asked for.
    pub(crate) fn step(
        &mut self,
        mode: Mode,
        settings: &WheelSettings,
        period: &Period,
        wheels: &Wheels,
    ) -> (f64, [f64; READINGS]) {
        (self.state, self.covariance) = mode.predict(period, self.state, self.covariance);
        let (mut likelihood, mut all) = (1.0, [0.0; READINGS]);
        for (at, innovation) in all.iter_mut().enumerate() {
            let Some((read, expected)) = self.reading(at, mode, settings, period, wheels) else {
                continue;
            };
            let error = read - expected.value;
            let gain = self.covariance * expected.slope.transpose();
            let variance = (expected.slope * gain).x + expected.variance;
            let deviation = libm::sqrt(variance);
            let expects = libm::exp(-error * error / variance / 2.0) * BELL / deviation;
            let anything = settings.outliers / settings.spread;
            let all_in_all = (1.0 - settings.outliers) * expects + anything;
            let trust = (1.0 - settings.outliers) * expects / all_in_all;
            self.state += gain * (trust * error / variance);
            self.covariance -= gain * gain.transpose() * (trust / variance);
            likelihood *= all_in_all;
            *innovation = error / deviation;
        }
        (likelihood, all)
    }

    fn reading(
        &self,
        at: usize,
        mode: Mode,
        settings: &WheelSettings,
        period: &Period,
        wheels: &Wheels,
    ) -> Option<(f64, Expected)> {
        let side = if at.is_multiple_of(2) { Side::Left } else { Side::Right };
        Some(match at {
            0 | 1 => (wheels.encoder[at], mode.encoder(settings, side, &self.state)),
            2 | 3 => {
                let expected = mode.current(settings, side, &self.state, period.command);
                (wheels.current[at - 2], expected)
            }
            _ => (wheels.gyro?, mode.gyro(settings, &self.state)),
        })
    }
}

/// A bank of filters, one of each model: interacting multiple models (Blom and Bar-Shalom, IEEE
/// Transactions on Automatic Control 33(8), 1988). COTAMA names a bank of filters that do not
/// exchange their states (Roumeliotis, Sukhatme, Bekey, ICRA 1998; Magill, IEEE Transactions on
/// Automatic Control 10(4), 1965): that finds faults as soon, and sees 0.1 to 0.4 s later that a
/// weak motor or a blocked wheel is sound again.
///
/// In each period a sound robot breaks with a small chance, equally likely in each way, and a
/// broken one is sound again with another. Before a period each filter begins at the mean of the
/// states from which its model may have come; after it the probabilities follow by Bayes's rule.
#[derive(Clone, Debug, PartialEq)]
pub struct Bank {
    settings: WheelSettings,
    filters: [Filter; MODES.len()],
    probabilities: [f64; MODES.len()],
    breaks: f64,
    heals: f64,
}

impl Bank {
    /// A bank of a robot that is sound and stands, and that breaks and heals with these chances
    /// per period.
    pub(crate) fn new(settings: WheelSettings, breaks: f64, heals: f64) -> Self {
        let probabilities = core::array::from_fn(|it| if it == 0 { 1.0 } else { 0.0 });
        Self { settings, filters: [Filter::new(); MODES.len()], probabilities, breaks, heals }
    }

    /// Returns the probabilities of [`MODES`]; their sum is 1.
    pub const fn probabilities(&self) -> &[f64; MODES.len()] {
        &self.probabilities
    }

    /// Goes on by a period whose numbers are finite.
    pub(crate) fn step(&mut self, wheels: &Wheels) {
        self.exchange();
        self.weigh(wheels);
    }

    fn enters(&self) -> f64 {
        self.breaks / (MODES.len() - 1) as f64
    }

    /// Mixes the states. Faults come from the sound state or stay, so a filter of a fault mixes
    /// with the nominal one alone.
    fn exchange(&mut self) {
        let [nominal, ..] = self.filters;
        let [sound, ..] = self.probabilities;
        let enters = self.enters();
        let mut all = Mean::of(nominal, sound * (1.0 - self.breaks));
        for (filter, probability) in self.filters.iter().zip(&self.probabilities).skip(1) {
            all.add(filter, probability * self.heals);
        }
        for (filter, probability) in self.filters.iter_mut().zip(&self.probabilities).skip(1) {
            let mut two = Mean::of(*filter, probability * (1.0 - self.heals));
            two.add(&nominal, sound * enters);
            *filter = two.filter();
        }
        self.filters[0] = all.filter();
    }

    /// Runs the filters, and weighs the models by how likely they make the readings.
    pub(crate) fn weigh(&mut self, wheels: &Wheels) {
        let period = Period::of(&self.settings, wheels);
        let mut likely = [0.0_f64; MODES.len()];
        for ((filter, mode), likely) in self.filters.iter_mut().zip(MODES).zip(&mut likely) {
            *likely = filter.step(mode, &self.settings, &period, wheels).0;
        }
        let most = likely.iter().fold(1e-300_f64, |most, it| most.max(*it));
        let [sound, ..] = self.probabilities;
        let enters = self.enters();
        let mut sum = 0.0;
        for (at, (probability, likely)) in self.probabilities.iter_mut().zip(likely).enumerate() {
            let before = if at == 0 {
                sound * (1.0 - self.breaks) + (1.0 - sound) * self.heals
            } else {
                *probability * (1.0 - self.heals) + sound * enters
            };
            *probability = (before * likely / most).max(LEAST);
            sum += *probability;
        }
        self.probabilities.iter_mut().for_each(|it| *it /= sum);
        debug_assert!(self.is_valid(), "probabilities add up to 1");
    }

    fn is_valid(&self) -> bool {
        let sum: f64 = self.probabilities.iter().sum();
        (sum - 1.0).abs() < 1e-9 && self.filters.iter().all(|it| it.covariance.trace() > 0.0)
    }
}

/// A mean of states with weights, and the covariance of the mixture.
struct Mean {
    at: Vector2<f64>,
    weight: f64,
    sum: Vector2<f64>,
    squares: Matrix2<f64>,
}

impl Mean {
    fn of(filter: Filter, weight: f64) -> Self {
        let zero = (Vector2::zeros(), Matrix2::zeros());
        let mut mean = Self { at: filter.state, weight: 0.0, sum: zero.0, squares: zero.1 };
        mean.add(&filter, weight.max(1e-100));
        mean
    }

    /// Adds a state; differences to the first one keep the digits.
    fn add(&mut self, filter: &Filter, weight: f64) {
        let aside = filter.state - self.at;
        self.weight += weight;
        self.sum += aside * weight;
        self.squares += (filter.covariance + aside * aside.transpose()) * weight;
    }

    fn filter(&self) -> Filter {
        let aside = self.sum / self.weight;
        let covariance = self.squares / self.weight - aside * aside.transpose();
        Filter { state: self.at + aside, covariance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In an even turn all readings are known, those of either side by themselves.
    #[test]
    fn readings_without_noise_are_no_news_to_the_nominal_filter() {
        let settings = WheelSettings::pioneer();
        let commanded = [1.23, 2.87];
        let wheels = Wheels {
            dt: 0.1,
            commanded,
            encoder: commanded,
            current: commanded.map(|it| settings.friction(it)[0]),
            gyro: Some(settings.turn * (2.87 - 1.23)),
        };
        let (mut filter, mut last) = (Filter::new(), [1.0; READINGS]);
        for _ in 0..100 {
            let period = Period::of(&settings, &wheels);
            last = filter.step(Mode::Nominal, &settings, &period, &wheels).1;
        }
        assert!(last.iter().all(|it| it.abs() < 1e-6), "{last:?}");
    }
}
