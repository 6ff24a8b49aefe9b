//! The tasks of engines, and their findings.

use super::reason::Reason;
use crate::explicit::Limit;
use crate::temporal::Run;
use crate::tpn::Time;
use cotama_certificate::Evidence;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::{Assumptions, Formula, Linear};
use std::fmt;

/// A task on a net.
#[derive(Clone, Copy, Debug)]
pub enum Task<'t> {
    /// A reachable marking of which this formula, which speaks of one marking, is true.
    Reach(&'t Formula),
    /// The most that `constant + sum of weight * tokens` ever is.
    Bound(&'t Linear),
    /// Whether no place ever holds two tokens.
    OneSafe,
    /// Which transitions never fire.
    Dead,
    /// Whether every transition can fire again from every reachable marking.
    Live,
    /// Whether a formula holds at the start, on runs as assumed: one with a quantifier in front.
    Holds(&'t Formula, &'t Assumptions),
    /// The least and the most time from a firing until a place is marked.
    Response(TransitionId, PlaceId),
}

/// The most of something.
///
/// ```
/// use cotama_models::nets::families::kanban;
/// use cotama_verification::check::{Extent, Model, Options, Verdict, check};
/// use cotama_verification::property;
/// let net = kanban(5).unwrap();
/// let model = Model::from(&net.view().net());
/// let place = &model.pt().places[0];
/// let most = property::parse(&format!("bounds({place})"), model.pt()).unwrap();
/// let answer = check(&model, &most, &Options::default());
/// assert_eq!(answer.verdict, Verdict::Bound(Extent::Finite(5)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// This number of tokens.
    Finite(u64),
    /// There is no most.
    Infinite,
}

impl Extent {
    pub(crate) fn of(tokens: i128) -> Self {
        Self::Finite(u64::try_from(tokens.max(0)).unwrap_or(u64::MAX))
    }
}

impl fmt::Display for Extent {
    /// A number or `+inf`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite(number) => number.fmt(f),
            Self::Infinite => f.write_str("+inf"),
        }
    }
}

/// The result of an engine.
#[derive(Clone, Debug)]
pub enum Found {
    /// A path to a marking that was looked for.
    Path(Vec<TransitionId>),
    /// There is such a marking; the path to it is too long to be written.
    Reached,
    /// There is no such marking.
    Never(Evidence),
    /// The most tokens, and a path to a marking that has them where one is known.
    Most(Extent, Option<Vec<TransitionId>>, Evidence),
    /// All transitions that never fire.
    Dead(Vec<TransitionId>),
    /// Transitions that never fire; there may be more.
    SomeDead(Vec<TransitionId>),
    /// Whether it is so, a run that shows it, and evidence.
    Holds(bool, Option<Run>, Evidence),
    /// The least and the most time; `None` when the transition never fires.
    Response(Option<(Time, Time)>),
    /// No result, for this reason.
    Nothing(Reason),
}

/// The result of an engine, and its effort.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The result.
    pub found: Found,
    /// How many markings it met.
    pub states: u64,
}

impl Finding {
    /// Nothing was found.
    pub const fn nothing(reason: Reason, states: u64) -> Self {
        Self { found: Found::Nothing(reason), states }
    }

    /// The engine does not do such tasks.
    pub const fn unsuited() -> Self {
        Self::nothing(Reason::Unsuited, 0)
    }

    /// The engine cannot tell, after so many markings.
    pub const fn undecided(states: u64) -> Self {
        Self::nothing(Reason::Undecided, states)
    }

    /// A limit was reached.
    pub const fn stopped(limit: Limit, states: u64) -> Self {
        Self::nothing(Reason::Limit(limit), states)
    }

    /// Whether something was found.
    pub const fn is_something(&self) -> bool {
        !matches!(self.found, Found::Nothing(_))
    }
}
