//! The sampling of runs, and thus the interval that holds.

use crate::statistics::{Interval, anytime, clopper_pearson};

/// The sampling by which the runs of a campaign came about.
///
/// ```
/// use cotama_campaign::sampling::Sampling;
/// let high = |it: Sampling| it.interval(0, 100, 0.95).map(|it| it.high);
/// assert!(high(Sampling::Fixed) < high(Sampling::Stopped));
/// assert_eq!((high(Sampling::Every), high(Sampling::Chosen)), (None, None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Plans drawn independently, as many as were asked for before.
    Fixed,
    /// Plans drawn independently, until a test was decided: how many there are depends on what they
    /// came to.
    Stopped,
    /// Every plan that there is: a share of them is no estimate, but what it is.
    Every,
    /// Plans that were chosen: a share of them estimates nothing.
    Chosen,
}

impl Sampling {
    /// The interval for the probability after `hits` of `runs`, that of Clopper and Pearson or one
    /// that holds [whenever](anytime) runs end; none where nothing was sampled.
    pub fn interval(self, hits: u64, runs: u64, confidence: f64) -> Option<Interval> {
        match self {
            Self::Fixed => Some(clopper_pearson(hits, runs, confidence)),
            Self::Stopped => Some(anytime(hits, runs, confidence)),
            Self::Every | Self::Chosen => None,
        }
    }

    /// Whether plans were drawn independently, so that their number says how sure a share is.
    pub const fn estimates(self) -> bool {
        matches!(self, Self::Fixed | Self::Stopped)
    }
}
