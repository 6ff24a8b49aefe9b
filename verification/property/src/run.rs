//! Runs of a net without end, as evidence.

use crate::pt::Pt;
use cotama_core::net::TransitionId;
use std::collections::HashMap;
use std::fmt;

/// A maximal run from the initial marking.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Run {
    /// Transitions fired at first.
    pub stem: Vec<TransitionId>,
    /// The rest of the run, behind the stem.
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
    /// in the loop of itself. The former needs firings to be `injective`: reset arcs let one
    /// transition lead to a marking from several.
    pub fn lasso(
        mut stem: Vec<TransitionId>,
        mut cycle: Vec<TransitionId>,
        injective: bool,
    ) -> Self {
        let repeats = |period: &usize| {
            cycle.len().is_multiple_of(*period)
                && cycle.iter().zip(&cycle[*period..]).all(|(a, b)| a == b)
        };
        let period = (1..cycle.len()).find(repeats).unwrap_or(cycle.len());
        cycle.truncate(period);
        while stem.pop_if(|last| injective && Some(last) == cycle.last_mut()).is_some() {
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
                return Self::lasso(self.stem, cycle, !pt.has_resets());
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

impl Run {
    /// A run to a marking; what comes after it makes no difference.
    pub fn to(stem: Vec<TransitionId>) -> Self {
        Self { stem, rest: Rest::Any }
    }

    /// Returns the cycle, fired again and again at the end: empty after a deadlock; `None` where
    /// the rest of the run makes no difference.
    pub fn cycle(&self) -> Option<&[TransitionId]> {
        match &self.rest {
            Rest::Any => None,
            Rest::Stays => Some(&[]),
            Rest::Cycle(cycle) => Some(cycle),
        }
    }

    /// How many firings it has, those of the cycle counted once.
    pub fn len(&self) -> usize {
        self.stem.len() + self.cycle().map_or(0, <[_]>::len)
    }

    /// Whether nothing fires in it.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Iterates over the firings, those of the cycle once.
    pub fn firings(&self) -> impl Iterator<Item = TransitionId> {
        self.stem.iter().chain(self.cycle().unwrap_or_default()).copied()
    }

    /// Returns the position at which the cycle begins, if there is one with firings.
    pub fn cycle_start(&self) -> Option<usize> {
        self.cycle().filter(|it| !it.is_empty()).map(|_| self.stem.len())
    }

    /// Shows each marking, with how many firings are before it; where the cycle ends, its first one
    /// again.
    ///
    /// # Errors
    /// When it is no run of the net.
    pub fn walk(&self, pt: &Pt, mut visit: impl FnMut(usize, &[u32])) -> Result<(), NotARun> {
        let mut marking = pt.initial.clone();
        let mut first_of_cycle = None;
        for (at, TransitionId(transition)) in self.firings().enumerate() {
            if at == self.stem.len() {
                first_of_cycle = Some(marking.clone());
            }
            visit(at, &marking);
            let firing = at + 1;
            let name =
                pt.transitions.get(transition as usize).ok_or(NotARun::NoTransition { firing })?;
            if !pt.enabled(&marking, transition) {
                return Err(NotARun::Disabled { firing, transition: name.clone() });
            }
            marking = pt.fire(&marking, transition).ok_or(NotARun::Overflow { firing })?;
        }
        if first_of_cycle.is_some_and(|first| first != marking) {
            return Err(NotARun::Open);
        }
        let enabled = |it: &u32| pt.enabled(&marking, *it);
        if self.cycle().is_some_and(<[_]>::is_empty)
            && let Some(transition) = (0..pt.transitions.len() as u32).find(enabled)
        {
            return Err(NotARun::GoesOn {
                transition: pt.transitions[transition as usize].clone(),
            });
        }
        visit(self.len(), &marking);
        Ok(())
    }

    /// The marking after so many firings of a run; the initial one of what is none.
    pub fn marking(&self, pt: &Pt, after: usize) -> Vec<u32> {
        let mut found = pt.initial.clone();
        let stop = |at: usize, marking: &[u32]| {
            if at == after {
                found.copy_from_slice(marking);
            }
        };
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.walk(pt, stop);
        found
    }
}

/// Why this is no run of the net. Firings are counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotARun {
    /// The net has no such transition.
    NoTransition {
        /// Number of the firing, from 1.
        firing: usize,
    },
    /// The transition is not enabled there.
    Disabled {
        /// Number of the firing, from 1.
        firing: usize,
        /// Name of the transition.
        transition: String,
    },
    /// A place would hold more than 4,294,967,295 tokens.
    Overflow {
        /// Number of the firing, from 1.
        firing: usize,
    },
    /// The cycle does not lead back to the marking in which it begins.
    Open,
    /// The run is said to end in a deadlock, and a transition can fire there.
    GoesOn {
        /// Name of a transition that can.
        transition: String,
    },
    /// The sequence is a run, but has too many firings for a net of this size to be explained.
    TooLong {
        /// Number of firings.
        firings: usize,
    },
    /// There are not as many dates as firings, or they are those of other transitions.
    Dates,
    /// The net has other places or transitions than the one that is read by engines.
    Net,
}

impl fmt::Display for NotARun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTransition { firing } => {
                write!(f, "firing {firing} is of a transition that the net does not have")
            }
            Self::Disabled { firing, transition } => {
                write!(f, "firing {firing}: `{transition}` is not enabled there")
            }
            Self::Overflow { firing } => {
                write!(f, "firing {firing}: a place would hold too many tokens")
            }
            Self::Open => {
                f.write_str("the cycle does not lead back to the marking in which it begins")
            }
            Self::GoesOn { transition } => {
                write!(f, "the run does not end in a deadlock: `{transition}` can fire there")
            }
            Self::TooLong { firings } => {
                write!(f, "its {firings} firings are too many to be explained")
            }
            Self::Dates => f.write_str(
                "the dates are not those of the firings: give one for each, in their order",
            ),
            Self::Net => {
                f.write_str("the net has other places or transitions than the one that was checked")
            }
        }
    }
}

impl std::error::Error for NotARun {}
