//! Amounts that each activity of a run was planned to take, and took.

use super::{Planning, Progress};
use cotama_models::margins::Spent;

/// The activities that a run came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Spending {
    done: Vec<Spent>,
    /// The activity under way, with the amounts used before it in place of those used.
    now: Option<Spent>,
}

impl Planning<'_> {
    /// Notes how far a run has come: activities before are done.
    pub(crate) fn reach(&mut self, at: &Progress) {
        while self.spending.now.is_none_or(|it| it.activity < at.first) {
            let next = match self.spending.now.take() {
                Some(it) => {
                    let used =
                        std::array::from_fn(|axis| at.used[axis].saturating_sub(it.used[axis]));
                    self.spending.done.push(Spent { used, done: true, ..it });
                    it.activity + 1
                }
                None => self.spending.done.last().map_or(0, |it| it.activity + 1),
            };
            if next >= self.choice.len() {
                return;
            }
            let planned = self.planned(next, self.choice[next]);
            self.spending.now = Some(Spent { activity: next, planned, used: at.used, done: false });
        }
    }

    /// Another plan comes into force: each counts for its part of the activity under way.
    pub(super) fn replan(&mut self, at: &Progress, choice: &[u16]) {
        let (done, whole) = self.share(at);
        let Some((now, id)) = self.spending.now.zip(choice.first()) else { return };
        if now.activity != at.first {
            return;
        }
        let anew = self.planned(at.first, *id);
        let planned = std::array::from_fn(|axis| {
            let part = |of: u64, share: u64| u128::from(of) * u128::from(share);
            let sum = part(now.planned[axis], done) + part(anew[axis], whole.saturating_sub(done));
            u64::try_from(sum / u128::from(whole.max(1))).unwrap_or(u64::MAX)
        });
        self.spending.now = Some(Spent { planned, ..now });
    }

    /// Returns what each activity took that a run came to, at its end.
    pub(crate) fn spent(&mut self, at: &Progress) -> Vec<Spent> {
        self.reach(at);
        let mut all = std::mem::take(&mut self.spending.done);
        if let Some(it) = self.spending.now.take() {
            let used = std::array::from_fn(|axis| at.used[axis].saturating_sub(it.used[axis]));
            all.push(Spent { used, ..it });
        }
        all
    }

    fn planned(&self, activity: usize, id: u16) -> [u64; 2] {
        let whole = self.whole(activity, usize::from(id));
        whole.map_or([0; 2], |it| it.cost.map(u64::from))
    }
}
