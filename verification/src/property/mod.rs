//! What is asked of a net.

use cotama_core::net::{PlaceId, TransitionId};

/// A question with its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its name; of one that was typed, its text.
    pub name: String,
    /// The question.
    pub question: Question,
}

/// What is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// Whether a temporal formula holds at the start.
    Formula(Formula),
    /// The most tokens that these places ever hold together.
    Bound(Vec<PlaceId>),
    /// The least and the most time from a firing of a transition to the first later instant at which a place is marked.
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

/// A formula of CTL, of LTL (one `All` in front), or bounded response. `Exists` and `All` quantify over maximal runs: those that
/// go on for ever, and those that end in a deadlock, in which the last marking lasts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Formula {
    /// Something about the marking.
    Atom(Atom),
    /// Not.
    Not(Box<Formula>),
    /// All of them; true when there are none.
    And(Vec<Formula>),
    /// One of them; false when there are none.
    Or(Vec<Formula>),
    /// On some run from here.
    Exists(Box<Formula>),
    /// On all runs from here.
    All(Box<Formula>),
    /// In the next marking. There is none after a deadlock.
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Atom {
    /// A linear inequality.
    AtMost(Linear),
    /// Some of these transitions is enabled.
    Fireable(Vec<TransitionId>),
    /// No transition is enabled.
    Deadlock,
}

/// `constant + sum of weight * tokens <= 0`, weights not zero, by place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Linear {
    /// What is added.
    pub constant: i64,
    /// Weights of places, sorted by place, each once.
    pub weights: Vec<(PlaceId, i64)>,
}

/// What kind of formula it is: which engines can answer it.
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
    /// It speaks of milliseconds.
    Timed,
    /// Anything else.
    Other,
}

impl Formula {
    /// Always true.
    pub const TRUE: Self = Self::And(Vec::new());
    /// Always false.
    pub const FALSE: Self = Self::Or(Vec::new());

    /// What kind of formula it is.
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
            Self::All(path) if !path.any(&|it| matches!(it, Self::Exists(_) | Self::All(_))) => Kind::Ltl,
            _ => Kind::Other,
        }
    }

    /// Whether it speaks of one marking only.
    pub fn is_state(&self) -> bool {
        !self.any(&|it| !matches!(it, Self::Atom(_) | Self::Not(_) | Self::And(_) | Self::Or(_)))
    }

    fn is_ctl(&self) -> bool {
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

    /// Whether this holds of some part of it.
    pub fn any(&self, holds: &impl Fn(&Self) -> bool) -> bool {
        holds(self)
            || match self {
                Self::Atom(_) => false,
                Self::And(all) | Self::Or(all) => all.iter().any(|it| it.any(holds)),
                Self::Until(a, b) => a.any(holds) || b.any(holds),
                Self::Not(a)
                | Self::Exists(a)
                | Self::All(a)
                | Self::Next(a)
                | Self::Finally(a)
                | Self::Globally(a)
                | Self::Within(_, a) => a.any(holds),
            }
    }
}
