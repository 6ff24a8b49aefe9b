//! Plans that hold something back for what remains.
//!
//! A plan is sought within what is left over the ratio of the [`Hold`], and its margin is what is
//! left less its bound. Where no plan holds the reserve of an axis, the plan with the most reserve
//! there is taken, and until the next plan that axis is watched as in the paper: a reserve that
//! cannot be held is no reason to end a mission.

use super::{Planning, Progress};
use crate::run::NoPlan;
use crate::solver::Proposal;
use cotama_core::hardware::Equipment;
use cotama_core::hold::{Hold, ONE};
use cotama_models::missions::tables::Rest;

impl Planning<'_> {
    /// Returns the reserve here.
    pub(super) fn hold(&self, at: &Progress) -> Hold<2> {
        self.hold_but(at, self.given_up)
    }

    /// Returns the reserve here, but for axes that are given up: within an activity the ratio goes
    /// from that of its start to that of the next one as its way, or its time, is done.
    fn hold_but(&self, at: &Progress, given_up: [bool; 2]) -> Hold<2> {
        let Some(here) = self.of.holds.get(at.first).copied().map(Hold::ratios) else {
            return Hold::NOTHING;
        };
        let next = self.of.holds.get(at.first + 1).copied().map_or(here, Hold::ratios);
        let (done, whole) = self.share(at);
        Hold::new(std::array::from_fn(|axis| {
            if given_up[axis] {
                return ONE;
            }
            let (from, to) = (i128::from(here[axis]), i128::from(next[axis]));
            let way = (to - from) * i128::from(done) / i128::from(whole.max(1));
            u32::try_from(from + way).unwrap_or(ONE)
        }))
    }

    /// How much of the current activity is done, and of how much: mm, or ms.
    pub(super) fn share(&self, at: &Progress) -> (u64, u64) {
        let [left, whole] = self.left_of(at);
        (whole.saturating_sub(left), whole)
    }

    /// Returns how much of the current activity is left, and of how much: mm, or ms. A detour may
    /// leave more than the whole.
    pub(super) fn left_of(&self, at: &Progress) -> [u64; 2] {
        let Some(activity) = self.of.activities.get(at.first) else { return [0; 2] };
        match at.rest {
            None => [1; 2],
            Some(Rest::Travel(left)) => [left.0, activity.length().0],
            Some(Rest::Time(left)) => [left.0, self.chosen(at.first).duration.0],
        }
    }

    /// Asks for a plan that holds back what is to be held back, as far as there is one; says on
    /// which axes there is none.
    pub(super) fn held_back(
        &mut self,
        at: &Progress,
        available: Equipment,
    ) -> Result<(Proposal, [bool; 2]), NoPlan> {
        let (left, mut given_up) = (self.watch(at).left(), [false; 2]);
        let mut limits = self.hold_but(at, given_up).within(&left);
        loop {
            match self.propose(at, limits, available) {
                Ok(proposal) => return Ok((proposal, given_up)),
                // The least that the axis needs leaves the most of it.
                Err(NoPlan::Limit { axis, short }) if axis < 2 && !given_up[axis] => {
                    given_up[axis] = true;
                    limits[axis] = limits[axis].saturating_add(short).min(left[axis]);
                }
                Err(NoPlan::Limit { .. } | NoPlan::Infeasible) if limits != left => {
                    (given_up, limits) = ([true; 2], left);
                }
                Err(none) => return Err(none),
            }
        }
    }
}
