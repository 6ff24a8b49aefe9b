//! The trait of engines.

use super::budget::Budget;
use super::known::Known;
use crate::certificate::Evidence;
use crate::explicit::Limit;
use crate::property::{Assumptions, Formula, Linear, Question};
use crate::temporal::{self, Run};
use cotama_core::net::TransitionId;
use std::fmt;

/// What is looked for in a net.
#[derive(Clone, Copy, Debug)]
pub enum Task<'t> {
    /// A reachable marking of which this formula, which speaks of one marking, is true.
    Reach(&'t Formula),
    /// The most that `constant + sum of weight * tokens` ever is.
    Bound(&'t Linear),
    /// Which transitions never fire.
    Dead,
    /// Whether every transition can fire again from every reachable marking.
    Live,
    /// Whether a formula holds at the start.
    Temporal(&'t Formula),
    /// Whether a formula of CTL holds at the start, on fair runs.
    Fair(&'t Formula, &'t Assumptions),
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
    /// So many.
    Finite(u64),
    /// There is no most.
    Infinite,
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

/// What an engine found.
#[derive(Clone, Debug)]
pub enum Found {
    /// A way to a marking that was looked for.
    Way(Vec<TransitionId>),
    /// There is such a marking; the way to it is too long to be written.
    Reached,
    /// There is no such marking.
    Never(Evidence),
    /// The most tokens, and a way to a marking that has them where one is known.
    Most(Extent, Option<Vec<TransitionId>>, Evidence),
    /// All transitions that never fire.
    Dead(Vec<TransitionId>, Evidence),
    /// Whether it is so, a run that shows it, and evidence.
    Holds(bool, Option<Run>, Evidence),
    /// Nothing.
    Nothing(Reason),
}

/// What an engine found, and how far it went for it.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What it found.
    pub found: Found,
    /// How many markings it met.
    pub states: u64,
}

impl Finding {
    /// Nothing was found.
    pub const fn nothing(reason: Reason, states: u64) -> Self {
        Self { found: Found::Nothing(reason), states }
    }

    /// Whether something was found.
    pub const fn is_something(&self) -> bool {
        !matches!(self.found, Found::Nothing(_))
    }
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A limit was reached.
    Limit(Limit),
    /// The engine cannot tell: what it looks at allows both.
    Undecided,
    /// The automaton of a formula of LTL is too large.
    Automaton,
    /// The engine does not answer such questions.
    Unsuited,
}

impl From<temporal::Reason> for Reason {
    fn from(reason: temporal::Reason) -> Self {
        match reason {
            temporal::Reason::Limit(limit) => Self::Limit(limit),
            temporal::Reason::Formula => Self::Automaton,
            temporal::Reason::Kind => Self::Unsuited,
        }
    }
}

impl Reason {
    /// What can be done about it, half a sentence; of a question to a net with time or without.
    pub fn way_out(self, question: &Question, is_timed: bool) -> &'static str {
        let within = |it: &Formula| matches!(it, Formula::Within(..));
        match self {
            Self::Limit(Limit::States) => "allow more markings",
            Self::Limit(Limit::Bytes) => "allow more memory",
            Self::Limit(Limit::Time) => "allow more time",
            Self::Limit(Limit::Unbounded) if is_timed => {
                "give the place that grows a place for the room that is left"
            }
            Self::Limit(Limit::Unbounded) => {
                "`EF`, `AG` and `bounds(..)` of sums of tokens are answered without a bound"
            }
            Self::Limit(Limit::Tokens | Limit::Words) => "check a smaller net",
            Self::Undecided => "let all engines be asked",
            Self::Automaton => "ask for its parts one by one",
            Self::Unsuited => match question {
                Question::Response { .. } if !is_timed => "keep the intervals of the net",
                Question::Formula(formula) | Question::Fair(formula, _) if formula.any(&within) => {
                    if is_timed {
                        "ask for `AF<=5ms p` or `AG (cause -> AF<=5ms effect)`"
                    } else {
                        "limits of time ask for a net with intervals"
                    }
                }
                Question::Formula(_) | Question::Fair(..) => {
                    "put a quantifier in front of each temporal operator, or one in front of all"
                }
                _ => "let all engines be asked",
            },
        }
    }
}

impl fmt::Display for Reason {
    /// Half a sentence.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Limit(Limit::States) => "the limit of markings was reached",
            Self::Limit(Limit::Bytes) => "the limit of memory was reached",
            Self::Limit(Limit::Time) => "the limit of time was reached",
            Self::Limit(Limit::Tokens) => "a place can hold more than 4294967295 tokens",
            Self::Limit(Limit::Words) => "markings have come to take more than 128 words",
            Self::Limit(Limit::Unbounded) => "the net is unbounded",
            Self::Undecided => "what the engine looks at allows both answers",
            Self::Automaton => "the automaton of the formula is too large",
            Self::Unsuited => "the engine does not answer such questions",
        })
    }
}

/// An engine. What it says is so; when it does not know, it says that.
pub trait Engine {
    /// The name that users know it by.
    fn name(&self) -> &'static str;

    /// Does a task on a net.
    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding;
}
