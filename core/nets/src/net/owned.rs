//! Nets that are made at run time: read from a file or built by a function.

use super::data::{
    Arc, EventId, Ignored, Law, Net, OutputId, Place, PlaceId, Role, Signal, Transition, Within,
};
use super::defect::NetError;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;

/// A [`Net`] that owns its lists. It is read through [`OwnedNet::view`].
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// net.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
/// let view = net.view();
/// assert_eq!(view.net().defect(), None);
/// assert_eq!(view.net().transitions[1].name, "release");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnedNet {
    /// Name of the net.
    pub name: String,
    /// Purpose of the net.
    pub doc: String,
    /// The places, which hold tokens.
    pub places: Vec<OwnedPlace>,
    /// The events accepted.
    pub events: Vec<OwnedSignal>,
    /// The outputs emitted.
    pub outputs: Vec<OwnedSignal>,
    /// How tokens move.
    pub transitions: Vec<OwnedTransition>,
    /// Events that a place leaves unanswered on purpose.
    pub ignored: Vec<OwnedIgnored>,
    /// The properties claimed of the net.
    pub laws: Vec<OwnedLaw>,
}

/// A [`Place`] that owns its texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnedPlace {
    /// Name of the place.
    pub name: String,
    /// Meaning of a token in the place.
    pub doc: String,
    /// Tokens at the start.
    pub initial: u32,
    /// The most tokens it is claimed to hold.
    pub bound: u32,
    /// Role of the place.
    pub role: Role,
}

impl OwnedPlace {
    /// A place without a claimed bound.
    pub fn new(name: &str, initial: u32) -> Self {
        Self {
            name: name.to_owned(),
            doc: String::new(),
            initial,
            bound: Place::UNBOUNDED,
            role: Role::State,
        }
    }

    /// The same with a claimed bound.
    #[must_use]
    pub fn at_most(self, bound: u32) -> Self {
        Self { bound, ..self }
    }

    /// The same with a documentation.
    #[must_use]
    pub fn doc(self, doc: &str) -> Self {
        Self { doc: doc.to_owned(), ..self }
    }
}

/// A [`Signal`] that owns its texts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnedSignal {
    /// Name of the signal.
    pub name: String,
    /// Meaning of the signal.
    pub doc: String,
}

/// A [`Transition`] that owns its lists.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
///
/// let mut net = OwnedNet::new("egg", "");
/// let raw = net.place(OwnedPlace::new("raw", 1).at_most(1)).unwrap();
/// let hard = net.place(OwnedPlace::new("hard", 0)).unwrap();
/// let boil = OwnedTransition::new("boil").take(raw, 1).give(hard, 1);
/// net.transition(boil.within(300_000, Some(360_000))).unwrap();
/// assert_eq!(net.transitions[0].within.unwrap().latest, Some(360_000));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnedTransition {
    /// Name of the transition.
    pub name: String,
    /// Purpose of the transition.
    pub doc: String,
    /// Which line of the definition it comes from; [`OwnedNet::transition`] sets it to the
    /// position.
    pub line: u32,
    /// The event it needs.
    pub on: Option<EventId>,
    /// Tokens that it removes.
    pub take: Vec<Arc>,
    /// Tokens that must be there and stay.
    pub read: Vec<Arc>,
    /// Tokens that it adds.
    pub give: Vec<Arc>,
    /// The outputs emitted, in this order.
    pub emits: Vec<OutputId>,
    /// When it may fire.
    pub within: Option<Within>,
    /// Priority: among enabled transitions the one with the highest fires.
    pub priority: i16,
}

impl OwnedTransition {
    /// A transition without arcs.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// The same with a documentation.
    #[must_use]
    pub fn doc(self, doc: &str) -> Self {
        Self { doc: doc.to_owned(), ..self }
    }

    /// The same, on an event.
    #[must_use]
    pub fn on(self, event: EventId) -> Self {
        Self { on: Some(event), ..self }
    }

    /// The same, removing tokens as well.
    #[must_use]
    pub fn take(mut self, place: PlaceId, weight: u32) -> Self {
        self.take.push(Arc { place, weight });
        self
    }

    /// The same, needing tokens as well.
    #[must_use]
    pub fn read(mut self, place: PlaceId, weight: u32) -> Self {
        self.read.push(Arc { place, weight });
        self
    }

    /// The same, adding tokens as well.
    #[must_use]
    pub fn give(mut self, place: PlaceId, weight: u32) -> Self {
        self.give.push(Arc { place, weight });
        self
    }

    /// The same in a time interval, in milliseconds.
    #[must_use]
    pub fn within(self, earliest: u32, latest: Option<u32>) -> Self {
        Self { within: Some(Within { earliest, latest }), ..self }
    }
}

/// An [`Ignored`] that owns its guard.
///
/// ```
/// use cotama_core::net::owned::{OwnedIgnored, OwnedNet, OwnedPlace};
///
/// let mut net = OwnedNet::new("door", "");
/// let shut = net.place(OwnedPlace::new("shut", 1)).unwrap();
/// let locked = net.place(OwnedPlace::new("locked", 0)).unwrap();
/// let knock = net.event("knock", "").unwrap();
/// net.ignored.push(OwnedIgnored::new(knock, shut).guard(locked, 1));
/// assert!(!net.view().net().ignored[0].holds(|place| net.places[place.0 as usize].initial));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnedIgnored {
    /// The event.
    pub event: EventId,
    /// The place.
    pub place: PlaceId,
    /// Tokens that must be there as well.
    pub guard: Vec<Arc>,
}

impl OwnedIgnored {
    /// An event that is ignored wherever this place is marked.
    pub fn new(event: EventId, place: PlaceId) -> Self {
        Self { event, place, guard: Vec::new() }
    }

    /// The same where these tokens are there as well.
    #[must_use]
    pub fn guard(mut self, place: PlaceId, weight: u32) -> Self {
        self.guard.push(Arc { place, weight });
        self
    }

    /// Borrows the pair.
    pub fn view(&self) -> Ignored<'_> {
        Ignored { event: self.event, place: self.place, guard: &self.guard }
    }
}

impl From<&Ignored<'_>> for OwnedIgnored {
    fn from(it: &Ignored<'_>) -> Self {
        Self { event: it.event, place: it.place, guard: it.guard.to_vec() }
    }
}

/// A [`Law`] that owns its lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OwnedLaw {
    /// A weighted sum of tokens stays the same.
    Invariant {
        /// Weights.
        sum: Vec<Arc>,
        /// The sum.
        equals: u32,
    },
    /// Never a token in both at once.
    NeverBoth(PlaceId, PlaceId),
    /// Some firing sequence marks it.
    Reachable(PlaceId),
    /// From wherever the net is, some firing sequence marks it.
    AlwaysCan(PlaceId),
    /// Every event is answered or ignored on purpose.
    HandlesAll,
    /// Transitions that fire at once and by themselves come to an end.
    Settles,
    /// Some transition is enabled, except where `end` is marked.
    DeadlockFree {
        /// The place in which to stop is meant.
        end: Option<PlaceId>,
    },
    /// Priorities and the order of lines decide nothing.
    Deterministic,
}

/// The lists of an [`OwnedNet`] as a [`Net`] borrows them.
#[derive(Debug)]
pub struct View<'n> {
    net: &'n OwnedNet,
    places: Vec<Place<'n>>,
    events: Vec<Signal<'n>>,
    outputs: Vec<Signal<'n>>,
    transitions: Vec<Transition<'n>>,
    ignored: Vec<Ignored<'n>>,
    laws: Vec<Law<'n>>,
}

impl OwnedNet {
    /// A net without places and transitions.
    pub fn new(name: &str, doc: &str) -> Self {
        Self { name: name.to_owned(), doc: doc.to_owned(), ..Self::default() }
    }

    /// Adds a place.
    ///
    /// # Errors
    /// [`NetError::TooLong`] when ids cannot count it.
    pub fn place(&mut self, place: OwnedPlace) -> Result<PlaceId, NetError> {
        push(&mut self.places, place).map(PlaceId)
    }

    /// Adds an event that it reacts to.
    ///
    /// # Errors
    /// [`NetError::TooLong`] when ids cannot count it.
    pub fn event(&mut self, name: &str, doc: &str) -> Result<EventId, NetError> {
        push(&mut self.events, OwnedSignal { name: name.to_owned(), doc: doc.to_owned() })
            .map(EventId)
    }

    /// Adds a signal that it emits.
    ///
    /// # Errors
    /// [`NetError::TooLong`] when ids cannot count it.
    pub fn output(&mut self, name: &str, doc: &str) -> Result<OutputId, NetError> {
        push(&mut self.outputs, OwnedSignal { name: name.to_owned(), doc: doc.to_owned() })
            .map(OutputId)
    }

    /// Adds a transition, a line of its own.
    ///
    /// # Errors
    /// [`NetError::TooLong`] when ids cannot count it.
    pub fn transition(
        &mut self,
        transition: OwnedTransition,
    ) -> Result<super::TransitionId, NetError> {
        let line = u32::try_from(self.transitions.len()).map_err(|_| NetError::TooLong)?;
        push(&mut self.transitions, OwnedTransition { line, ..transition }).map(super::TransitionId)
    }

    /// Borrows the lists as a [`Net`].
    pub fn view(&self) -> View<'_> {
        View {
            net: self,
            places: self.places.iter().map(OwnedPlace::view).collect(),
            events: self.events.iter().map(OwnedSignal::view).collect(),
            outputs: self.outputs.iter().map(OwnedSignal::view).collect(),
            transitions: self.transitions.iter().map(OwnedTransition::view).collect(),
            ignored: self.ignored.iter().map(OwnedIgnored::view).collect(),
            laws: self.laws.iter().map(OwnedLaw::view).collect(),
        }
    }
}

fn push<T>(list: &mut Vec<T>, item: T) -> Result<u32, NetError> {
    let id = u32::try_from(list.len()).ok().filter(|&id| id < u32::MAX).ok_or(NetError::TooLong)?;
    list.push(item);
    Ok(id)
}

impl OwnedPlace {
    fn view(&self) -> Place<'_> {
        Place {
            name: &self.name,
            doc: &self.doc,
            initial: self.initial,
            bound: self.bound,
            role: self.role,
        }
    }
}

impl OwnedSignal {
    fn view(&self) -> Signal<'_> {
        Signal { name: &self.name, doc: &self.doc }
    }
}

impl OwnedTransition {
    fn view(&self) -> Transition<'_> {
        Transition {
            name: &self.name,
            doc: &self.doc,
            line: self.line,
            on: self.on,
            take: &self.take,
            read: &self.read,
            give: &self.give,
            emits: &self.emits,
            within: self.within,
            priority: self.priority,
        }
    }
}

impl OwnedLaw {
    fn view(&self) -> Law<'_> {
        match *self {
            Self::Invariant { ref sum, equals } => Law::Invariant { sum, equals },
            Self::NeverBoth(a, b) => Law::NeverBoth(a, b),
            Self::Reachable(place) => Law::Reachable(place),
            Self::AlwaysCan(place) => Law::AlwaysCan(place),
            Self::HandlesAll => Law::HandlesAll,
            Self::Settles => Law::Settles,
            Self::DeadlockFree { end } => Law::DeadlockFree { end },
            Self::Deterministic => Law::Deterministic,
        }
    }
}

impl View<'_> {
    /// The net.
    pub fn net(&self) -> Net<'_> {
        Net {
            name: &self.net.name,
            doc: &self.net.doc,
            places: &self.places,
            events: &self.events,
            outputs: &self.outputs,
            transitions: &self.transitions,
            ignored: &self.ignored,
            laws: &self.laws,
        }
    }
}

impl From<&Net<'_>> for OwnedNet {
    fn from(net: &Net<'_>) -> Self {
        let signals = |from: &[Signal<'_>]| {
            let owned =
                |it: &Signal<'_>| OwnedSignal { name: it.name.to_owned(), doc: it.doc.to_owned() };
            from.iter().map(owned).collect()
        };
        let place = |it: &Place<'_>| OwnedPlace {
            name: it.name.to_owned(),
            doc: it.doc.to_owned(),
            initial: it.initial,
            bound: it.bound,
            role: it.role,
        };
        let transition = |it: &Transition<'_>| OwnedTransition {
            name: it.name.to_owned(),
            doc: it.doc.to_owned(),
            line: it.line,
            on: it.on,
            take: it.take.to_vec(),
            read: it.read.to_vec(),
            give: it.give.to_vec(),
            emits: it.emits.to_vec(),
            within: it.within,
            priority: it.priority,
        };
        let law = |it: &Law<'_>| match *it {
            Law::Invariant { sum, equals } => OwnedLaw::Invariant { sum: sum.to_vec(), equals },
            Law::NeverBoth(a, b) => OwnedLaw::NeverBoth(a, b),
            Law::Reachable(place) => OwnedLaw::Reachable(place),
            Law::AlwaysCan(place) => OwnedLaw::AlwaysCan(place),
            Law::HandlesAll => OwnedLaw::HandlesAll,
            Law::Settles => OwnedLaw::Settles,
            Law::DeadlockFree { end } => OwnedLaw::DeadlockFree { end },
            Law::Deterministic => OwnedLaw::Deterministic,
        };
        Self {
            name: net.name.to_owned(),
            doc: net.doc.to_owned(),
            places: net.places.iter().map(place).collect(),
            events: signals(net.events),
            outputs: signals(net.outputs),
            transitions: net.transitions.iter().map(transition).collect(),
            ignored: net.ignored.iter().map(OwnedIgnored::from).collect(),
            laws: net.laws.iter().map(law).collect(),
        }
    }
}
