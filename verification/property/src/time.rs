//! A net whose transitions have a clock each.

use crate::pt::{Bounds, Lists, Pt};
use cotama_core::net::{Arc, PlaceId, TransitionId};
use std::collections::HashSet;
use std::fmt;

/// When a transition may fire, counted from the moment it became enabled. No unit is attached;
/// bounds are integers.
///
/// ```
/// use cotama_verification::tpn::Interval;
/// let both = Interval::closed(2, 5).intersection(Interval::at_least(4));
/// assert_eq!(both, Interval::closed(4, 5));
/// assert!(Interval::closed(2, 5).intersection(Interval::NOW).is_empty());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interval {
    /// Least age at firing.
    pub lower: u64,
    /// Not even at `lower`.
    pub lower_strict: bool,
    /// Not after; `None`: no limit.
    pub upper: Option<u64>,
    /// Not even at `upper`; of no account without a limit.
    pub upper_strict: bool,
}

impl Interval {
    /// The largest bound: sums of a few of them still fit into 64 bits.
    pub const LARGEST: u64 = (1 << 58) - 1;
    /// At any time.
    pub const ANY: Self = Self::at_least(0);
    /// At once.
    pub const NOW: Self = Self::closed(0, 0);

    /// Both bounds belong to it.
    pub const fn closed(lower: u64, upper: u64) -> Self {
        Self { lower, lower_strict: false, upper: Some(upper), upper_strict: false }
    }

    /// From `lower` on, without a limit.
    pub const fn at_least(lower: u64) -> Self {
        Self { lower, lower_strict: false, upper: None, upper_strict: true }
    }

    /// Whether no time lies in it.
    pub fn is_empty(&self) -> bool {
        self.upper.is_some_and(|upper| {
            upper < self.lower || upper == self.lower && (self.lower_strict || self.upper_strict)
        })
    }

    /// The times that lie in both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let (lower, lower_strict) =
            (self.lower, self.lower_strict).max((other.lower, other.lower_strict));
        // The strict one of two equal upper bounds is the smaller.
        let end = |it: Self| it.upper.map_or((u64::MAX, true), |upper| (upper, !it.upper_strict));
        let upper = if end(self) <= end(other) { self } else { other };
        Self { lower, lower_strict, upper: upper.upper, upper_strict: upper.upper_strict }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{},", if self.lower_strict { ']' } else { '[' }, self.lower)?;
        match self.upper {
            Some(upper) => write!(f, "{upper}{}", if self.upper_strict { '[' } else { ']' }),
            None => f.write_str("w["),
        }
    }
}

/// A place of a [`TimeNet`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TimePlace {
    /// Name, unique among the places.
    pub name: String,
    /// A word for it that need not be unique.
    pub label: Option<String>,
    /// Tokens at the start.
    pub initial: u32,
}

/// A transition of a [`TimeNet`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimeTransition {
    /// Name, unique among the transitions.
    pub name: String,
    /// A word for it that need not be unique.
    pub label: Option<String>,
    /// When it may fire; its upper bound is when it must.
    pub interval: Interval,
    /// Tokens that it removes, sorted by place, each place once.
    pub take: Vec<Arc>,
    /// Tokens that must be there and stay, sorted likewise. A place may be in `take` as well: the
    /// larger weight counts.
    pub read: Vec<Arc>,
    /// Tokens that it adds, sorted likewise.
    pub give: Vec<Arc>,
}

impl TimeTransition {
    /// A transition without arcs that may fire at any time.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            label: None,
            interval: Interval::ANY,
            take: Vec::new(),
            read: Vec::new(),
            give: Vec::new(),
        }
    }
}

/// Why parts do not make a [`TimeNet`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TimeNetDefect {
    /// More places or transitions than ids can count.
    TooLong,
    /// Two places of this name.
    PlaceTwice(String),
    /// Two transitions of this name.
    TransitionTwice(String),
    /// An arc of this transition names a place that is not there.
    UnknownPlace(TransitionId),
    /// The weights of a place at this transition sum to more than 4,294,967,295.
    Weight(TransitionId),
    /// The interval of this transition is empty.
    Empty(TransitionId),
    /// A bound of this transition is larger than [`Interval::LARGEST`].
    Bound(TransitionId),
}

impl fmt::Display for TimeNetDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong => f.write_str("there are more places or transitions than ids can count"),
            Self::PlaceTwice(name) => write!(f, "two places are named `{name}`"),
            Self::TransitionTwice(name) => write!(f, "two transitions are named `{name}`"),
            Self::UnknownPlace(id) => {
                write!(f, "an arc of transition {} names a place that is not there", id.0)
            }
            Self::Weight(id) => {
                write!(f, "weights of transition {} sum to more than {}", id.0, u32::MAX)
            }
            Self::Empty(id) => write!(f, "the interval of transition {} is empty", id.0),
            Self::Bound(id) => {
                write!(f, "a bound of transition {} is larger than {}", id.0, Interval::LARGEST)
            }
        }
    }
}

impl std::error::Error for TimeNetDefect {}

/// A time Petri net: places, and transitions with an interval each.
///
/// A transition is enabled when every place of `take` and `read` holds at least the weight. Each
/// enabled transition has one clock, however many times the marking would allow it. It may fire
/// when its clock is in its interval, and time cannot pass the end of the interval of any enabled
/// transition. After a firing the clocks start anew of transitions that are enabled now and either
/// fired or were not enabled in the intermediate marking, when tokens were removed and not yet
/// added. So a read arc disturbs no clock, and taking a token and putting it back does.
///
/// ```
/// use cotama_core::net::PlaceId;
/// use cotama_verification::tina;
/// let net = tina::read("egg.net", b"tr boil [300,360] raw -> hard  pl raw (1)").unwrap();
/// assert_eq!(net.place("hard"), Some(PlaceId(1)));
/// assert_eq!(net.transitions()[0].interval.to_string(), "[300,360]");
/// assert_eq!(net.untimed().initial, [1, 0]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TimeNet {
    name: String,
    places: Vec<TimePlace>,
    transitions: Vec<TimeTransition>,
}

impl TimeNet {
    /// The same net with each name and label written as `write` says, to be shown: two names may
    /// become one.
    #[must_use]
    pub fn relabelled(mut self, write: impl Fn(&str) -> String) -> Self {
        let places = self.places.iter_mut().map(|it| (&mut it.name, &mut it.label));
        let lines = self.transitions.iter_mut().map(|it| (&mut it.name, &mut it.label));
        for (name, label) in places.chain(lines) {
            *name = write(name);
            *label = label.take().map(|it| write(&it));
        }
        self.name = write(&self.name);
        self
    }

    /// Puts a net together. Arcs are sorted; those of one list to the same place become one
    /// (weights of `take` and `give` add up, of `read` the largest counts), and those of weight
    /// zero are dropped.
    ///
    /// # Errors
    /// What does not fit together.
    pub fn new(
        name: String,
        places: Vec<TimePlace>,
        mut transitions: Vec<TimeTransition>,
    ) -> Result<Self, TimeNetDefect> {
        if [places.len(), transitions.len()].iter().any(|&length| length >= u32::MAX as usize) {
            return Err(TimeNetDefect::TooLong);
        }
        let mut names = HashSet::new();
        if let Some(twice) = places.iter().find(|it| !names.insert(&*it.name)) {
            return Err(TimeNetDefect::PlaceTwice(twice.name.clone()));
        }
        names.clear();
        if let Some(twice) = transitions.iter().find(|it| !names.insert(&*it.name)) {
            return Err(TimeNetDefect::TransitionTwice(twice.name.clone()));
        }
        for (id, it) in (0..).map(TransitionId).zip(&mut transitions) {
            let known = |arc: &Arc| (arc.place.0 as usize) < places.len();
            if !it.take.iter().chain(&it.read).chain(&it.give).all(known) {
                return Err(TimeNetDefect::UnknownPlace(id));
            }
            let sums = merge(&mut it.take, u32::checked_add)
                .and_then(|()| merge(&mut it.give, u32::checked_add))
                .and_then(|()| merge(&mut it.read, |a, b| Some(a.max(b))));
            sums.ok_or(TimeNetDefect::Weight(id))?;
            if it.interval.is_empty() {
                return Err(TimeNetDefect::Empty(id));
            }
            if it.interval.lower.max(it.interval.upper.unwrap_or(0)) > Interval::LARGEST {
                return Err(TimeNetDefect::Bound(id));
            }
            it.interval.upper_strict |= it.interval.upper.is_none();
        }
        Ok(Self { name, places, transitions })
    }

    /// Returns the name; may be empty.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the places; a [`PlaceId`] is a position here.
    pub fn places(&self) -> &[TimePlace] {
        &self.places
    }

    /// Returns the transitions; a [`TransitionId`] is a position here.
    pub fn transitions(&self) -> &[TimeTransition] {
        &self.transitions
    }

    /// The place of this name.
    pub fn place(&self, name: &str) -> Option<PlaceId> {
        self.places.iter().position(|it| it.name == name).map(|at| PlaceId(at as u32))
    }

    /// The transition of this name.
    pub fn transition(&self, name: &str) -> Option<TransitionId> {
        self.transitions.iter().position(|it| it.name == name).map(|at| TransitionId(at as u32))
    }

    /// The same net without intervals. Time only takes runs away, so what holds of all its markings
    /// holds here too.
    pub fn untimed(&self) -> Pt {
        let weights =
            |arcs: &[Arc]| arcs.iter().map(|arc| (arc.place.0, arc.weight)).collect::<Vec<_>>();
        let needs =
            Lists::new(self.transitions.iter().map(|it| {
                merged(weights(&it.take).into_iter().chain(weights(&it.read)), u32::max)
            }));
        let effects = Lists::new(self.transitions.iter().map(|it| {
            let taken = it.take.iter().map(|arc| (arc.place.0, -i64::from(arc.weight)));
            let given = it.give.iter().map(|arc| (arc.place.0, i64::from(arc.weight)));
            let mut effects = merged(taken.chain(given), |a, b| a + b);
            effects.retain(|&(_, change)| change != 0);
            effects
        }));
        let arcs = |it: &TimeTransition| it.take.len() + 2 * it.read.len() + it.give.len();
        Pt {
            name: self.name.clone(),
            places: self.places.iter().map(|it| it.name.clone()).collect(),
            transitions: self.transitions.iter().map(|it| it.name.clone()).collect(),
            initial: self.places.iter().map(|it| it.initial).collect(),
            consumers: needs.reversed(self.places.len()),
            changers: effects.reversed(self.places.len()),
            needs,
            effects,
            arcs: self.transitions.iter().map(arcs).sum(),
            special: None,
            bounds: Bounds::default(),
        }
    }
}

/// Sorts arcs by place and joins those to the same place; `None` when weights do not fit.
fn merge(arcs: &mut Vec<Arc>, join: impl Fn(u32, u32) -> Option<u32>) -> Option<()> {
    arcs.retain(|arc| arc.weight > 0);
    arcs.sort_by_key(|arc| arc.place);
    let mut fits = true;
    arcs.dedup_by(|later, kept| {
        later.place == kept.place && {
            let weight = join(kept.weight, later.weight);
            fits &= weight.is_some();
            kept.weight = weight.unwrap_or(u32::MAX);
            true
        }
    });
    fits.then_some(())
}

/// Pairs sorted by id, of the same id joined to one.
fn merged<T: Copy>(
    pairs: impl Iterator<Item = (u32, T)>,
    join: impl Fn(T, T) -> T,
) -> Vec<(u32, T)> {
    let mut pairs: Vec<_> = pairs.collect();
    pairs.sort_by_key(|&(id, _)| id);
    pairs.dedup_by(|later, kept| {
        later.0 == kept.0 && {
            kept.1 = join(kept.1, later.1);
            true
        }
    });
    pairs
}
