//! Margins held against runs: how often a rest passed its bound, and whether the promise holds.

use crate::answers::risk::{HeldAnswer, WatchedRow};
use cotama_campaign::statistics::{Promise, clopper_pearson};
use cotama_models::margins::{Calibration, Spent};

/// The axes, in their order.
const AXES: [&str; 2] = ["duration", "energy"];
/// How seldom a calibration that holds is said not to, at least.
const ERROR: f64 = 0.001;
/// How often an interval holds its share.
pub(crate) const CONFIDENCE: f64 = 0.95;

/// All promises of a calibration, and what runs made of them.
pub(crate) struct Watch<'c> {
    known: &'c Calibration,
    /// How seldom the alarm of one of the promises is wrong, at least.
    error: f64,
    watched: Vec<Watched>,
}

/// The promise of an activity on an axis.
struct Watched {
    first: usize,
    axis: usize,
    promise: Promise,
    broken_after: Option<u64>,
}

impl<'c> Watch<'c> {
    pub(crate) fn new(known: &'c Calibration) -> Self {
        let mut watched = Vec::new();
        for (first, it) in known.from.iter().enumerate() {
            let Some(rank) = it.rank else { continue };
            let promise = Promise::new(u64::from(rank), u64::from(it.runs));
            let bound = |axis: &usize| it.bounds[*axis].is_some();
            watched.extend([0, 1].into_iter().filter(bound).map(|axis| Watched {
                first,
                axis,
                promise,
                broken_after: None,
            }));
        }
        #[allow(clippy::cast_precision_loss)] // two for each activity
        let error = ERROR / watched.len().max(1) as f64;
        Self { known, error, watched }
    }

    /// Adds what the activities of a run took.
    pub(crate) fn add(&mut self, run: &[Spent]) {
        for it in &mut self.watched {
            let Some(missed) = self.known.missed(it.first, it.axis, run) else { continue };
            it.promise.add(missed);
            if it.broken_after.is_none() && it.promise.is_broken(self.error) {
                it.broken_after = Some(it.promise.seen());
            }
        }
    }

    /// Returns the promises, in the order of the activities.
    pub(crate) fn rows(&self) -> Vec<WatchedRow> {
        let row = |it: &Watched| WatchedRow {
            activity: self.known.from[it.first].activity.clone(),
            axis: AXES[it.axis],
            runs: it.promise.seen(),
            missed: it.promise.missed(),
            missed_share: clopper_pearson(it.promise.missed(), it.promise.seen(), CONFIDENCE)
                .into(),
            promised: it.promise.coverage(CONFIDENCE).into(),
            broken_after: it.broken_after,
        };
        self.watched.iter().map(row).collect()
    }

    /// Returns the promises as a part of an answer.
    pub(crate) fn held(&self) -> HeldAnswer {
        let watched = self.rows();
        HeldAnswer {
            coverage: f64::from(self.known.coverage) / 1e6,
            holds: watched.iter().all(|it| it.broken_after.is_none()),
            watched,
        }
    }
}
