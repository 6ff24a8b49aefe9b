//! The value of a part of a text: a number or a statement.

use super::error::Fault;
use super::linear::Sum;
use super::{Atom, Formula, Linear};
use std::ops::Range;

/// The value read: a number or a statement.
pub(super) struct Value {
    pub(super) what: What,
    pub(super) span: Range<usize>,
    /// Position of its `U`, if it is an until without parentheses.
    pub(super) until: Option<Range<usize>>,
    /// Whether it stands in parentheses or brackets as a whole, behind its last operator.
    pub(super) closed: bool,
    /// The quantifier whose operand ends with it, if one does.
    pub(super) open: Option<Open>,
}

/// A quantifier and its operand, behind which an operator could go on with the operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Open {
    /// The start of the quantifier.
    pub(super) quantifier: usize,
    /// The start of its operand.
    pub(super) operand: usize,
    /// The end of its operand.
    pub(super) end: usize,
    /// Whether the operand stands in parentheses or brackets as a whole.
    pub(super) closed: bool,
}

pub(super) enum What {
    Sum(Sum),
    Formula(Formula),
}

/// Operators between statements, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Join {
    Equivalence,
    Implication,
    Or,
    And,
    Until,
}

impl Join {
    pub(super) fn tighter(self) -> Self {
        match self {
            Self::Equivalence => Self::Implication,
            Self::Implication => Self::Or,
            Self::Or => Self::And,
            Self::And | Self::Until => Self::Until,
        }
    }
}

impl Value {
    pub(super) fn new(what: What, span: Range<usize>) -> Self {
        Self { what, span, until: None, closed: false, open: None }
    }

    pub(super) fn formula(self) -> Result<Formula, Fault> {
        match self.what {
            What::Formula(formula) => Ok(formula),
            What::Sum(sum) => match sum.as_place() {
                Some(place) => Ok(Formula::Atom(Atom::AtMost(Linear::marked(place)))),
                None => Err(Fault::new(self.span, "this is a number, and a statement is expected")
                    .help("compare it with another number, as in `p + q <= 3`")),
            },
        }
    }

    /// An operand of anything but an until.
    pub(super) fn operand(self) -> Result<Formula, Fault> {
        match self.until {
            Some(span) => Err(Fault::new(span, "an until beside another operator")
                .help("put it in parentheses, as in `(a U b) & c`")),
            None => self.formula(),
        }
    }

    pub(super) fn sum(self) -> Result<Sum, Fault> {
        match self.what {
            What::Sum(sum) => Ok(sum),
            What::Formula(_) => Err(Fault::new(
                self.span,
                "this is a statement, and a number is \
                expected",
            )
            .help(
                "`+`, `-`, `*` and comparisons are for numbers of tokens; join statements \
                    with `&`, `|`, `->` or `<->`",
            )),
        }
    }
}
