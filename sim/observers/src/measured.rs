//! Rates of false alarms, measured beside those that were promised.

use crate::flag::Flag;
use cotama_devices::Stream;

/// A normal number (Box and Muller, Annals of Mathematical Statistics 29(2), 1958): its tails are
/// those that thresholds are made of, unlike those of [`Stream::error`].
pub(crate) fn normal(stream: &mut Stream) -> f64 {
    let radius = libm::sqrt(-2.0 * libm::log(1.0 - stream.part()));
    radius * libm::cos(core::f64::consts::TAU * stream.part())
}

/// Alarms among decisions.
#[derive(Debug)]
pub(crate) struct Measured {
    promised: f64,
    alarms: u64,
    decisions: u64,
    is_raised: bool,
}

impl Measured {
    pub(crate) fn of(promised: f64) -> Self {
        Self { promised, alarms: 0, decisions: 0, is_raised: false }
    }

    /// Counts a decision of its own.
    pub(crate) fn decision(&mut self, flag: Flag) {
        self.decisions += 1;
        self.alarms += u64::from(flag == Flag::Raised);
    }

    /// Counts an alarm when a flag rises, not while it stays.
    pub(crate) fn period(&mut self, flag: Flag) {
        let is_raised = flag == Flag::Raised;
        self.decisions += 1;
        self.alarms += u64::from(is_raised && !self.is_raised);
        self.is_raised = is_raised;
    }

    pub(crate) fn tell(&self, name: &str) -> [f64; 2] {
        let [low, high] = interval(self.alarms, self.decisions);
        let (alarms, n) = (self.alarms, self.decisions);
        let share = alarms as f64 / n as f64;
        let promised = self.promised;
        println!(
            "{name}: promised {promised:.2e}, {alarms} of {n} = {share:.2e} [{low:.2e}, {high:.2e}]"
        );
        [low, high]
    }

    /// The promised chance lies in the interval of the measured one.
    #[track_caller]
    pub(crate) fn is_as_promised(&self, name: &str) {
        self.is_as_computed(name, self.promised);
    }

    /// The chance that was computed lies in the interval, and is at most the promised one.
    #[track_caller]
    pub(crate) fn is_as_computed(&self, name: &str, computed: f64) {
        let [low, high] = self.tell(name);
        assert!(computed <= self.promised, "{name}: {computed} is more than promised");
        assert!((low..=high).contains(&computed), "{name}: {computed} not in [{low}, {high}]");
    }

    /// The measured chance is below the promised one for sure.
    #[track_caller]
    pub(crate) fn is_at_most_promised(&self, name: &str) {
        let [_, high] = self.tell(name);
        assert!(high <= self.promised, "{name}: {high} is more than {}", self.promised);
    }
}

/// Returns the interval of Clopper and Pearson (Biometrika 26(4), 1934) in which the chance lies
/// with 99 %: the chances at which so many, or so few, come with 0.5 %.
pub(crate) fn interval(hits: u64, all: u64) -> [f64; 2] {
    let at_most = |hits: u64, chance: f64| -> f64 {
        let (n, ln, ln_not) = (all as f64, libm::log(chance), libm::log1p(-chance));
        let term = |k: u64| {
            let k = k as f64;
            let ways = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
            libm::exp(ways + k * ln + (n - k) * ln_not)
        };
        (0..=hits).map(term).sum()
    };
    let solve = |is_low: &dyn Fn(f64) -> bool| {
        let (mut low, mut high) = (1e-15, 1.0 - 1e-15);
        for _ in 0..50 {
            let middle = libm::sqrt(low * high);
            if is_low(middle) { low = middle } else { high = middle }
        }
        high
    };
    let low = if hits == 0 { 0.0 } else { solve(&|it| 1.0 - at_most(hits - 1, it) < 0.005) };
    [low, solve(&|it| at_most(hits, it) > 0.005)]
}

#[test]
fn the_interval_of_no_hits_has_a_closed_form() {
    let [low, high] = interval(0, 100);
    assert_eq!((low, format!("{high:.6}")), (0.0, format!("{:.6}", 1.0 - libm::pow(0.005, 0.01))));
    // Hits and misses change places.
    let [low, high] = interval(30, 100);
    let [low_of_misses, high_of_misses] = interval(70, 100);
    assert!((low + high_of_misses - 1.0).abs() < 1e-9 && (high + low_of_misses - 1.0).abs() < 1e-9);
}
