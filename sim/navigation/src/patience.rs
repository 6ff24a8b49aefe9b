//! A bound on how long a robot goes on without coming nearer.

/// A caller's bound on avoidance: neither avoidance says that it gives up, and in a dead end a
/// robot may turn or circle for ever. This one ends it after so many periods without a gain.
///
/// ```
/// use cotama_navigation::Patience;
/// let mut patience = Patience::new(0.1, 2);
/// let left = [5.0, 4.95, 4.85, 4.80, 4.80, 1.0];
/// assert_eq!(left.map(|it| patience.lasts(it)), [true, true, true, true, false, false]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patience {
    gain_m: f64,
    periods: u32,
    least_m: f64,
    since: u32,
}

impl Patience {
    /// A bound: the way that is left falls by a gain in metres within so many periods.
    pub const fn new(gain_m: f64, periods: u32) -> Self {
        Self { gain_m, periods, least_m: f64::INFINITY, since: 0 }
    }

    /// Whether it still lasts, with so much way left in this period. Once it is over it stays so.
    pub fn lasts(&mut self, left_m: f64) -> bool {
        if self.since >= self.periods {
            return false;
        }
        if left_m <= self.least_m - self.gain_m {
            (self.least_m, self.since) = (left_m, 0);
        } else {
            self.since += 1;
        }
        self.since < self.periods
    }
}
