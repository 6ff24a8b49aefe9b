//! The questions to a run, and the decisions of its markings.

use cotama_property::pt::Pt;
use cotama_property::{Atom, Condition, Formula};
use std::fmt;

/// A question to a run: a formula with one temporal operator behind a quantifier, made to be asked
/// of each marking fast.
#[derive(Clone, Debug)]
pub struct Asked<'n> {
    wants: Wants,
    path: Path<'n>,
}

/// The kind of evidence that one run can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wants {
    /// The property speaks of all runs: one that breaks it refutes it.
    All,
    /// The property speaks of some run: one that holds it proves it.
    Some,
}

/// Why a run cannot be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotOfARun {
    /// The property is about the marking at the start alone.
    Start,
    /// The property speaks of milliseconds.
    Time,
    /// The property has other operators than one of `G`, `F` and `U` behind one quantifier.
    Nested,
}

impl fmt::Display for NotOfARun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Start => "it is about the marking at the start, which is no matter of chance",
            Self::Time => "it speaks of time, and runs are drawn without",
            Self::Nested => "a single run cannot be held against it",
        })
    }
}

impl std::error::Error for NotOfARun {}

#[derive(Clone, Debug)]
enum Path<'n> {
    Globally(State<'n>),
    Finally(State<'n>),
    Until(State<'n>, State<'n>),
}

/// A formula about a marking in which something is enabled, and in one in which nothing is: what is
/// enabled is known of each marking, and need not be looked for.
#[derive(Clone, Debug)]
struct State<'n> {
    alive: Condition<'n>,
    dead: Condition<'n>,
}

/// The judgement of a run so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Judged {
    Open,
    Holds,
    Broken,
}

impl<'n> Asked<'n> {
    /// A question to runs of a net: `AG p`, `EF p`, `AF p`, `EG p`, `A (p U q)`, `E (p U q)` of
    /// what is about one marking, and the negation of one of the first four.
    ///
    /// # Errors
    /// When it is another one.
    pub fn new(formula: &Formula, net: &'n Pt) -> Result<Self, NotOfARun> {
        if formula.is_state() {
            return Err(NotOfARun::Start);
        }
        if formula.any(&|it| matches!(it, Formula::Within(..))) {
            return Err(NotOfARun::Time);
        }
        Self::of(formula, false, net).ok_or(NotOfARun::Nested)
    }

    /// Returns the kind of evidence that one run can be.
    pub fn wants(&self) -> Wants {
        self.wants
    }

    fn of(formula: &Formula, negated: bool, net: &'n Pt) -> Option<Self> {
        let (wants, path) = match (formula, negated) {
            (Formula::Not(inner), _) => return Self::of(inner, !negated, net),
            (Formula::All(path), false) | (Formula::Exists(path), true) => (Wants::All, path),
            (Formula::Exists(path), false) | (Formula::All(path), true) => (Wants::Some, path),
            _ => return None,
        };
        let state = |it: &Formula| State::new(it, negated, net);
        let path = match (&**path, negated) {
            (Formula::Globally(it), false) | (Formula::Finally(it), true) => {
                Path::Globally(state(it)?)
            }
            (Formula::Finally(it), false) | (Formula::Globally(it), true) => {
                Path::Finally(state(it)?)
            }
            (Formula::Until(first, then), false) => Path::Until(state(first)?, state(then)?),
            _ => return None,
        };
        Some(Self { wants, path })
    }

    /// Returns the judgement of the next marking; `Open` when the run must go on.
    #[inline]
    pub(super) fn sees(&self, marking: &[u32], is_dead: bool) -> Judged {
        let holds = |state: &State<'_>| {
            if is_dead { state.dead.holds(marking) } else { state.alive.holds(marking) }
        };
        match &self.path {
            Path::Globally(it) if !holds(it) => Judged::Broken,
            // The last marking lasts.
            Path::Globally(_) if is_dead => Judged::Holds,
            Path::Finally(it) | Path::Until(_, it) if holds(it) => Judged::Holds,
            Path::Finally(_) if is_dead => Judged::Broken,
            Path::Until(first, _) if is_dead || !holds(first) => Judged::Broken,
            _ => Judged::Open,
        }
    }

    /// Whether a run that went on to its last step undecided counts as one that holds: of what
    /// should be so all the time nothing was seen that breaks it.
    pub(super) fn holds_so_far(&self) -> bool {
        matches!(self.path, Path::Globally(_))
    }
}

impl<'n> State<'n> {
    fn new(formula: &Formula, negated: bool, net: &'n Pt) -> Option<Self> {
        let known = |is_dead: bool| {
            let whole = formula.with_atoms(&mut |atom| {
                Some(match atom {
                    Atom::Deadlock if is_dead => Formula::TRUE,
                    Atom::Deadlock => Formula::FALSE,
                    other => Formula::Atom(other.clone()),
                })
            })?;
            let whole = if negated { Formula::Not(whole.into()) } else { whole };
            Condition::new(&whole, net)
        };
        Some(Self { alive: known(false)?, dead: known(true)? })
    }
}
