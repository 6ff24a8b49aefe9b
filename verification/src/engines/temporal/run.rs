//! Runs as evidence.

use crate::pt::Pt;
use cotama_core::net::TransitionId;
use std::collections::HashMap;

/// A maximal run from the initial marking.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Run {
    /// Transitions fired at first.
    pub stem: Vec<TransitionId>,
    /// What comes after them.
    pub rest: Rest,
}

/// How a run goes on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Rest {
    /// In any way: what comes after the stem makes no difference.
    Any,
    /// The stem leads to a deadlock, whose marking lasts.
    Stays,
    /// These, at least one, again and again; they lead back to the marking in which they begin.
    Cycle(Vec<TransitionId>),
}

impl Run {
    /// The run of a stem and a loop, without repetition in the stem of what comes in the loop, and
    /// in the loop of itself.
    pub(super) fn lasso(mut stem: Vec<TransitionId>, mut cycle: Vec<TransitionId>) -> Self {
        let repeats = |period: &usize| {
            cycle.len().is_multiple_of(*period)
                && cycle.iter().zip(&cycle[*period..]).all(|(a, b)| a == b)
        };
        let period = (1..cycle.len()).find(repeats).unwrap_or(cycle.len());
        cycle.truncate(period);
        while stem.pop_if(|last| Some(last) == cycle.last_mut()).is_some() {
            cycle.rotate_right(1);
        }
        Self { stem, rest: Rest::Cycle(cycle) }
    }
}

/// The most firings that are tried to find how a run can go on, and the most tokens and transitions
/// that are looked at for it.
const TRIED: usize = 4_096;
const LOOKED: usize = 1 << 22;

impl Run {
    /// The same run with a loop or a deadlock at its end where that is found with little effort, by
    /// firing the first transition that is enabled.
    #[must_use]
    pub fn closed(mut self, pt: &Pt) -> Self {
        if self.rest != Rest::Any {
            return self;
        }
        let fired = |marking: Vec<u32>, it: &TransitionId| pt.fire(&marking, it.0);
        let Some(mut marking) = self.stem.iter().try_fold(pt.initial.clone(), fired) else {
            return self;
        };
        let (mut met, mut fired) = (HashMap::new(), Vec::new());
        let tried = TRIED.min(LOOKED / (pt.places.len() + pt.transitions.len() + 1));
        while fired.len() < tried {
            if let Some(back) = met.insert(marking.clone(), fired.len()) {
                let cycle = fired.split_off(back);
                self.stem.extend(fired);
                return Self::lasso(self.stem, cycle);
            }
            let Some(transition) =
                (0..pt.transitions.len() as u32).find(|it| pt.enabled(&marking, *it))
            else {
                self.stem.extend(fired);
                return Self { rest: Rest::Stays, ..self };
            };
            let Some(after) = pt.fire(&marking, transition) else { break };
            fired.push(TransitionId(transition));
            marking = after;
        }
        self
    }
}
