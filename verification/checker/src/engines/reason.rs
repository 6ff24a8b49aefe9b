//! Why there is no answer.

use crate::explicit::Limit;
use crate::temporal;
use cotama_property::{Formula, Question};
use std::fmt;

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
    /// Returns a remedy, as half a sentence, for a question to a net with time or without.
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
            Self::Limit(Limit::Work) | Self::Undecided => "let all engines be asked",
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
            Self::Limit(Limit::Work) => "the work for one question is done",
            Self::Undecided => "what the engine looks at allows both answers",
            Self::Automaton => "the automaton of the formula is too large",
            Self::Unsuited => "the engine does not answer such questions",
        })
    }
}
