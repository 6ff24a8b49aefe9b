//! Questions to a net: a language to write them in, and the forms in which engines read them.
//!
//! Beside the language, which is at the root, stand the other nouns of a question: nets as engines
//! read them ([`pt`], [`time`]), runs and dates that are shown as evidence ([`run`], [`schedule`]),
//! and [`limits`] of searches. Nothing here answers.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_verification::property::{self, Kind, Question};
//! use cotama_verification::pt::Pt;
//!
//! let mut lamp = OwnedNet::new("lamp", "");
//! let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
//! let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
//! lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
//! let lamp = Pt::from(&lamp.view().net());
//!
//! let property = property::parse("AG !(on & off)", &lamp).unwrap();
//! let Question::Formula(formula) = &property.question else { panic!("not a formula") };
//! assert_eq!(formula.kind(), Kind::Reachability);
//! assert_eq!(formula.display(&lamp).to_string(), "AG !(on & off)");
//!
//! let error = property::parse("EF onn", &lamp).unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "property:1:4: there is no place `onn`\n  help: did you mean `on`?"
//! );
//! ```
//!
//! # The language
//!
//! | question | asks |
//! | --- | --- |
//! | a formula | [`Question::Formula`] |
//! | CTL or LTL, then `assuming weak(t1, t2), strong(t3), often(p)` | [`Question::Fair`] |
//! | `bounds(p1 + p2)` | [`Question::Bound`] |
//! | `bound(t -> p)` | [`Question::Response`] |
//! | `live` | [`Question::Liveness`] |
//! | `quasi_live` | [`Question::QuasiLiveness`] |
//! | `stable` | [`Question::StableMarking`] |
//! | `one_safe` | [`Question::OneSafe`] |
//!
//! Operators from the one that binds loosest to the one that binds tightest:
//!
//! | operators | meaning |
//! | --- | --- |
//! | `<->` | equivalence, from left to right |
//! | `->` | implication, from right to left |
//! | `\|`, `\|\|`, `or` | disjunction |
//! | `&`, `&&`, `and` | conjunction |
//! | `U` | until, from right to left; beside one of the above it stands in parentheses |
//! | `!`, `not`, `A`, `E`, `X`, `F`, `G`, pairs such as `AG` | negation, quantifier, temporal |
//! | `<=`, `<`, `>=`, `>`, `=`, `==`, `!=` | comparison of numbers of tokens |
//! | `+`, `-` | sum, difference |
//! | `*` | product, of which one factor is a number |
//!
//! An operator of one operand takes a comparison, a negation or the like: `AG p <= 3` is
//! `AG (p <= 3)`.
//! A quantifier may have brackets: `E[a U b]`. How far one reaches is asked for where it could be
//! meant otherwise: `AG a -> b` is refused, with `AG (a -> b)` and `(AG a) -> b` as the ways to say
//! it, and so are `AG p & q` and `EF p | q`; `AG a & EF b`, of which each part has a quantifier, is
//! the conjunction of the two. A temporal operator stands inside of a quantifier; one `A` in front
//! of a formula makes it one of LTL: `A (G F a -> G F b)`. After `F`, `AF` and `EF` may stand a
//! limit of time: `AF<=200ms p`, in `ms` or `s`. Atoms are `true`, `false`, `deadlock`,
//! `fireable(t1, t2)` (one of them is enabled), comparisons, and names of places: `p` says that it
//! is marked. `deadlock_free` alone is the wish `AG !deadlock`.
//!
//! A loop that nobody would stay in is no reason for "never": what is assumed of runs stands behind
//! a formula, `AG (asked -> AF done) assuming weak(work), strong(grant), often(idle)`. A weakly
//! fair transition is not enabled for ever without firing, a strongly fair one fires again and
//! again if it is enabled again and again, and `often` holds again and again; there may be any
//! number of each.
//!
//! A name is written as it is when it is made of letters, digits, `_`, `'`, and dots inside of it,
//! does not start with a digit, and is no word of the language. Other names stand in quotes, `"a
//! b"` with `\"`, `\\` and `\u{1b}`, or in braces as in TINA, `{a b}` with `\{`, `\}` and `\\`. A
//! place that is called like a word needs no quotes where only a name can be meant: `EF E`, `AG (A
//! -> B)`, `fireable(F)`.
#![cfg_attr(kani, allow(clippy::pedantic))]

mod ctl;
mod display;
mod error;
mod evaluate;
mod expression;
pub mod integer;
mod lexer;
pub mod limits;
mod linear;
mod ltl;
pub mod mcc;
mod names;
mod nodes;
mod operand;
mod parser;
pub mod pt;
mod reachability;
pub mod run;
pub mod schedule;
mod simplify;
#[cfg(kani)]
pub mod small;
pub mod source;
pub mod time;
mod value;
mod xml;

pub use ctl::{Ctl, CtlNode};
pub use error::PropertyError;
pub use evaluate::{Condition, Marking};
pub use ltl::{Ltl, LtlNode};
pub use names::Ids;
pub use parser::{MAX_DEPTH, MAX_TEXT, parse_with};
pub use reachability::Reachability;

use crate::pt::Pt;
use cotama_core::net::{PlaceId, TransitionId};
use std::collections::{HashMap, HashSet};

/// Reads a question about a net. Its name is the text without white space around it.
///
/// # Errors
/// The first thing that is wrong with the text, and where.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::{property, pt::Pt};
/// let door = Pt::from(&door::NET);
/// let wish = property::parse("AG (Closing -> !obstacle)", &door).unwrap();
/// assert_eq!(wish.name, "AG (Closing -> !obstacle)");
/// assert_eq!(wish.question.display(&door).to_string(), "AG (!Closing | !obstacle)");
/// let error = property::parse("AG (Closing -> ", &door).unwrap_err();
/// assert_eq!((error.at.line, error.at.column), (1, 16));
/// ```
pub fn parse(text: &str, net: &Pt) -> Result<Property, PropertyError> {
    parse_with(text, net, Ids::default())
}

/// A question with its name.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::{property, property::Question, pt::Pt};
/// let door = Pt::from(&door::NET);
/// let asked = property::parse(" bounds(Open + Closed) ", &door).unwrap();
/// assert_eq!(asked.name, "bounds(Open + Closed)");
/// assert!(matches!(&asked.question, Question::Bound(places) if places.len() == 2));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Name of the property; of one that was typed, its text.
    pub name: String,
    /// The question.
    pub question: Question,
}

impl Property {
    /// Lets no two have the same name: a second one of a name gets `#2` behind it.
    ///
    /// ```
    /// use cotama_verification::property::{Property, Question};
    /// let named = |name: &str| Property { name: name.into(), question: Question::Liveness };
    /// let mut all = ["a", "b", "a", "a#2", "a"].map(named);
    /// Property::tell_apart(&mut all);
    /// assert_eq!(all.map(|it| it.name), ["a", "b", "a#3", "a#2", "a#4"]);
    /// ```
    pub fn tell_apart(properties: &mut [Self]) {
        let mut taken: HashSet<String> = properties.iter().map(|it| it.name.clone()).collect();
        let mut seen: HashMap<String, usize> = HashMap::new();
        for property in properties {
            let times = seen.entry(property.name.clone()).or_insert(0);
            *times += 1;
            if *times == 1 {
                continue;
            }
            let mut name = format!("{}#{times}", property.name);
            while !taken.insert(name.clone()) {
                *times += 1;
                name = format!("{}#{times}", property.name);
            }
            property.name = name;
        }
    }
}

/// The question of a property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// Whether a temporal formula holds at the start.
    Formula(Formula),
    /// Whether a formula of CTL, or of LTL behind one quantifier, holds at the start when
    /// quantifiers speak of fair runs only.
    Fair(Formula, Assumptions),
    /// The most tokens that these places ever hold together.
    Bound(Vec<PlaceId>),
    /// The least and the most time from a firing of a transition to the first later instant at
    /// which a place is marked.
    Response {
        /// The transition.
        from: TransitionId,
        /// The place.
        to: PlaceId,
    },
    /// Whether every transition can fire again from every reachable marking.
    Liveness,
    /// Whether every transition can fire.
    QuasiLiveness,
    /// Whether some place always holds as many tokens as at the start.
    StableMarking,
    /// Whether no place ever holds more than one token.
    OneSafe,
}

impl Question {
    /// The wish that something can always happen, `AG !deadlock`.
    ///
    /// ```
    /// use cotama_models::nets::door;
    /// use cotama_verification::{property::{self, Question}, pt::Pt};
    /// let asked = property::parse("deadlock_free", &Pt::from(&door::NET)).unwrap();
    /// assert_eq!(asked.question, Question::deadlock_free());
    /// ```
    pub fn deadlock_free() -> Self {
        let alive = Formula::Not(Formula::Atom(Atom::Deadlock).into());
        Self::Formula(Formula::All(Formula::Globally(alive.into()).into()))
    }

    /// The same question with its formula simplified, as certificates hold it.
    #[must_use]
    pub fn simplified(&self) -> Self {
        match self {
            Self::Formula(formula) => Self::Formula(formula.simplified()),
            other => other.clone(),
        }
    }

    /// The formula that it asks for.
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Self::Formula(formula) | Self::Fair(formula, _) => Some(formula),
            _ => None,
        }
    }
}

/// Assumptions on runs: one that does not meet all of them does not count. One that ends in a
/// deadlock stays there for ever.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Assumptions {
    /// Weakly fair transitions: none is enabled for ever from some time on without firing.
    pub weak: Vec<TransitionId>,
    /// Each of these fires again and again if it is enabled again and again.
    pub strong: Vec<TransitionId>,
    /// Each of these holds again and again; they speak of one marking.
    pub often: Vec<Formula>,
}

impl Assumptions {
    /// Whether nothing is assumed.
    pub const fn is_empty(&self) -> bool {
        self.weak.is_empty() && self.strong.is_empty() && self.often.is_empty()
    }
}

/// A formula of CTL, of LTL (one `All` in front), or bounded response. `Exists` and `All` quantify
/// over maximal runs: those that go on for ever, and those that end in a deadlock, in which the
/// last marking lasts.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula {
    /// Something about the marking.
    Atom(Atom),
    /// The negation.
    Not(Box<Formula>),
    /// All of them; true when there are none.
    And(Vec<Formula>),
    /// One of them; false when there are none.
    Or(Vec<Formula>),
    /// On some run from here.
    Exists(Box<Formula>),
    /// On all runs from here.
    All(Box<Formula>),
    /// In the next marking. Right after a quantifier, of something that needs no run: in some or in
    /// every successor; after a deadlock there is none, so that `EX` is false and `AX` true there.
    /// Elsewhere: after a deadlock in the marking that lasts.
    Next(Box<Formula>),
    /// At some time.
    Finally(Box<Formula>),
    /// At all times.
    Globally(Box<Formula>),
    /// The first until the second, which comes.
    Until(Box<Formula>, Box<Formula>),
    /// At some time, at most so many milliseconds from now; of time nets.
    Within(u64, Box<Formula>),
}

/// Something that is true or false of a marking.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Atom {
    /// A linear inequality.
    AtMost(Linear),
    /// Some of these transitions is enabled.
    Fireable(Vec<TransitionId>),
    /// No transition is enabled.
    Deadlock,
}

/// `constant + sum of weight * tokens <= 0`, weights not zero, by place.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Linear {
    /// Constant added to the weighted sum.
    pub constant: i64,
    /// Weights of places, sorted by place, each once.
    pub weights: Vec<(PlaceId, i64)>,
}

/// The kind of a formula: which engines can answer it.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::property::{self, Kind};
/// use cotama_verification::pt::Pt;
/// let door = Pt::from(&door::NET);
/// let kind = |text| property::parse(text, &door).unwrap().question.formula().unwrap().kind();
/// assert_eq!(kind("Closed"), Kind::Initial);
/// assert_eq!(kind("AG !(Closing & obstacle)"), Kind::Reachability);
/// assert_eq!(kind("AG EF Closed"), Kind::Ctl);
/// assert_eq!(kind("A (G F Closed)"), Kind::Ltl);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// About the initial marking alone.
    Initial,
    /// `EF` or `AG` of something about markings.
    Reachability,
    /// Every temporal operator follows a quantifier.
    Ctl,
    /// One `All` in front of a formula without quantifiers.
    Ltl,
    /// The formula speaks of milliseconds.
    Timed,
    /// Anything else.
    Other,
}

impl Formula {
    /// Always true.
    pub const TRUE: Self = Self::And(Vec::new());
    /// Always false.
    pub const FALSE: Self = Self::Or(Vec::new());

    /// Returns the kind of the formula.
    pub fn kind(&self) -> Kind {
        match self {
            _ if self.any(&|it| matches!(it, Self::Within(..))) => Kind::Timed,
            _ if self.is_state() => Kind::Initial,
            Self::Not(inner) => inner.kind(),
            Self::Exists(path) if matches!(&**path, Self::Finally(goal) if goal.is_state()) => {
                Kind::Reachability
            }
            Self::All(path) if matches!(&**path, Self::Globally(goal) if goal.is_state()) => {
                Kind::Reachability
            }
            _ if self.is_ctl() => Kind::Ctl,
            Self::All(path) if !path.any(&|it| matches!(it, Self::Exists(_) | Self::All(_))) => {
                Kind::Ltl
            }
            _ => Kind::Other,
        }
    }

    /// Whether it speaks of one marking only.
    pub fn is_state(&self) -> bool {
        !self.any(&|it| !matches!(it, Self::Atom(_) | Self::Not(_) | Self::And(_) | Self::Or(_)))
    }

    /// Whether it speaks of a run: whether some temporal operator stands outside of quantifiers.
    pub fn needs_run(&self) -> bool {
        match self {
            Self::Atom(_) | Self::Exists(_) | Self::All(_) => false,
            Self::Not(inner) => inner.needs_run(),
            Self::And(all) | Self::Or(all) => all.iter().any(Self::needs_run),
            Self::Next(_)
            | Self::Finally(_)
            | Self::Globally(_)
            | Self::Until(..)
            | Self::Within(..) => true,
        }
    }

    pub(crate) fn is_ctl(&self) -> bool {
        match self {
            Self::Atom(_) => true,
            Self::Not(inner) => inner.is_ctl(),
            Self::And(all) | Self::Or(all) => all.iter().all(Self::is_ctl),
            Self::Exists(path) | Self::All(path) => match &**path {
                Self::Next(a) | Self::Finally(a) | Self::Globally(a) => a.is_ctl(),
                Self::Until(a, b) => a.is_ctl() && b.is_ctl(),
                _ => false,
            },
            _ => false,
        }
    }

    /// The same formula with other formulas in place of its atoms; `None` when there is none for
    /// one of them.
    pub fn with_atoms(&self, other: &mut impl FnMut(&Atom) -> Option<Self>) -> Option<Self> {
        let mut boxed = |it: &Self| it.with_atoms(other).map(Box::new);
        Some(match self {
            Self::Not(a) => Self::Not(boxed(a)?),
            Self::Exists(a) => Self::Exists(boxed(a)?),
            Self::All(a) => Self::All(boxed(a)?),
            Self::Next(a) => Self::Next(boxed(a)?),
            Self::Finally(a) => Self::Finally(boxed(a)?),
            Self::Globally(a) => Self::Globally(boxed(a)?),
            Self::Until(a, b) => Self::Until(boxed(a)?, boxed(b)?),
            Self::Within(time, a) => Self::Within(*time, boxed(a)?),
            Self::Atom(atom) => other(atom)?,
            Self::And(all) => {
                Self::And(all.iter().map(|it| it.with_atoms(other)).collect::<Option<_>>()?)
            }
            Self::Or(all) => {
                Self::Or(all.iter().map(|it| it.with_atoms(other)).collect::<Option<_>>()?)
            }
        })
    }

    /// Whether this holds of some part of it.
    pub fn any(&self, holds: &impl Fn(&Self) -> bool) -> bool {
        holds(self) || self.parts().any(|it| it.any(holds))
    }

    /// Returns the formulas that it is made of.
    fn parts(&self) -> impl Iterator<Item = &Self> {
        let (list, some): (&[Self], [Option<&Self>; 2]) = match self {
            Self::Atom(_) => (&[], [None, None]),
            Self::And(all) | Self::Or(all) => (all, [None, None]),
            Self::Until(a, b) => (&[], [Some(a), Some(b)]),
            Self::Not(a)
            | Self::Exists(a)
            | Self::All(a)
            | Self::Next(a)
            | Self::Finally(a)
            | Self::Globally(a)
            | Self::Within(_, a) => (&[], [Some(a), None]),
        };
        list.iter().chain(some.into_iter().flatten())
    }
}
