//! A run of a net, step by step.

use crate::pt::Pt;
use crate::temporal::{Rest, Run};
use cotama_core::net::TransitionId;
use std::fmt;

/// Why this is no run of the net. Firings are counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotARun {
    /// The net has no such transition.
    NoTransition {
        /// Which firing.
        firing: usize,
    },
    /// The transition is not enabled there.
    Disabled {
        /// Which firing.
        firing: usize,
        /// Its name.
        transition: String,
    },
    /// A place would hold more than 4,294,967,295 tokens.
    Overflow {
        /// Which firing.
        firing: usize,
    },
    /// The cycle does not lead back to the marking in which it begins.
    Open,
    /// It is said to end in a deadlock, and something can fire there.
    GoesOn {
        /// What can.
        transition: String,
    },
    /// It is one, and has too many firings for a net of this size to be explained.
    TooLong {
        /// How many.
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

impl Run {
    /// A run to a marking; what comes after it makes no difference.
    pub fn to(stem: Vec<TransitionId>) -> Self {
        Self { stem, rest: Rest::Any }
    }

    /// What fires again and again at its end: nothing after a deadlock; `None` where what comes
    /// after the stem makes no difference.
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

    /// Its firings, those of the cycle once.
    pub fn firings(&self) -> impl Iterator<Item = TransitionId> {
        self.stem.iter().chain(self.cycle().unwrap_or_default()).copied()
    }

    /// Where the cycle begins, if there is one in which something fires.
    pub(super) fn cycle_start(&self) -> Option<usize> {
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
            for &(place, change) in pt.effects.of(transition) {
                let tokens = &mut marking[place as usize];
                let after = u32::try_from(i64::from(*tokens) + change);
                *tokens = after.map_err(|_| NotARun::Overflow { firing })?;
            }
        }
        if first_of_cycle.is_some_and(|first| first != marking) {
            return Err(NotARun::Open);
        }
        if self.cycle().is_some_and(<[_]>::is_empty)
            && let Some(transition) = enabled(pt, &marking).next()
        {
            return Err(NotARun::GoesOn {
                transition: pt.transitions[transition as usize].clone(),
            });
        }
        visit(self.len(), &marking);
        Ok(())
    }

    /// The marking after so many firings of a run; the initial one of what is none.
    pub(super) fn marking(&self, pt: &Pt, after: usize) -> Vec<u32> {
        let mut found = pt.initial.clone();
        let stop = |at: usize, marking: &[u32]| {
            if at == after {
                found.copy_from_slice(marking);
            }
        };
        // What is no run was refused before.
        let _ = self.walk(pt, stop);
        found
    }
}

/// The transitions that are enabled.
pub(super) fn enabled<'a>(pt: &'a Pt, marking: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
    (0..pt.transitions.len() as u32).filter(|it| pt.enabled(marking, *it))
}
