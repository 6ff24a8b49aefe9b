//! A net as plain data: what every other part of the crate reads.
//!
//! Ids are positions in the lists of the same [`Net`]. The lists are public, so a net can also be
//! written by hand, read from a file or made by a function; [`Net::defect`] says whether they fit
//! together.

/// A place of a net: its position in [`Net::places`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct PlaceId(pub u32);

/// An event that a net reacts to: its position in [`Net::events`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct EventId(pub u32);

/// A signal that a net emits: its position in [`Net::outputs`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct OutputId(pub u32);

/// A transition of a net: its position in [`Net::transitions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct TransitionId(pub u32);

/// A place/transition net with events, read arcs, bounds, priorities and time: a supervisor.
///
/// Its marking decides alone what an event does; nothing that decides is outside of it.
///
/// ```
/// use cotama_core::net;
/// net! {
///     /// A lamp.
///     mod lamp {
///         places { Off: 1, On }
///         events { press }
///         transitions { on on press: Off => On; off on press: On => Off; }
///     }
/// }
/// let net = &lamp::NET;
/// assert_eq!((net.name, net.doc, net.places[0].initial), ("lamp", "A lamp.", 1));
/// let off = &net.transitions[1];
/// assert_eq!((off.name, net.places[off.take[0].place.0 as usize].name), ("off", "On"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Net<'n> {
    /// Name of the net.
    pub name: &'n str,
    /// Purpose of the net.
    pub doc: &'n str,
    /// The places, which hold tokens.
    pub places: &'n [Place<'n>],
    /// The events accepted, from outside or from other nets of a system.
    pub events: &'n [Signal<'n>],
    /// The outputs emitted, to the outside or to other nets.
    pub outputs: &'n [Signal<'n>],
    /// How tokens move. Of transitions of the same priority the earlier one goes first.
    pub transitions: &'n [Transition<'n>],
    /// Events that a place leaves unanswered on purpose.
    pub ignored: &'n [Ignored<'n>],
    /// The properties claimed of the net.
    pub laws: &'n [Law<'n>],
}

/// A place, which holds tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place<'n> {
    /// Name, unique among the places of the net.
    pub name: &'n str,
    /// Meaning of a token in the place.
    pub doc: &'n str,
    /// Tokens at the start.
    pub initial: u32,
    /// The most tokens it is claimed to hold; [`Place::UNBOUNDED`] without a claim.
    pub bound: u32,
    /// Role of the place.
    pub role: Role,
}

impl Place<'_> {
    /// The bound of a place of which no bound is claimed.
    pub const UNBOUNDED: u32 = u32::MAX;
}

/// The role of a place. The token game does not depend on it.
///
/// ```
/// use cotama_core::{net, net::Role};
/// net! {
///     /// Counts to three, and remembers whether it may.
///     mod counting {
///         places { Ready: 1 }
///         flags { allowed }
///         counters { count: 0 of 3 }
///         events { allow, step }
///         transitions {
///             allow on allow [!allowed]: Ready => Ready do allowed = true;
///             step on step [allowed]: Ready => Ready do count += 1;
///         }
///     }
/// }
/// let roles: Vec<_> = counting::NET.places.iter().map(|it| it.role).collect();
/// assert_eq!(roles[..3], [Role::State, Role::Data, Role::Data]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A state or a condition of the supervisor.
    State,
    /// Data that guards read: a boolean, or a counter up to the bound of the place.
    Data,
    /// The free room of a [`Role::Data`] or [`Role::Shared`] place up to its bound: the two sum to
    /// the bound.
    Complement(PlaceId),
    /// A condition that another net of a system owns.
    Shared,
    /// Signals under way between nets of a system.
    Mailbox,
}

/// The name of an event or an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal<'n> {
    /// Name, unique among the events, or the outputs, of the net.
    pub name: &'n str,
    /// Meaning of the signal.
    pub doc: &'n str,
}

/// How tokens move: enabled when every place of `take` and `read` holds at least the weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition<'n> {
    /// Name, unique among the transitions of the net.
    pub name: &'n str,
    /// Purpose of the transition.
    pub doc: &'n str,
    /// Which line of the definition it comes from; one line can stand for several transitions (from
    /// any place of a group, for either value of a flag).
    pub line: u32,
    /// The event it needs; without one it fires by itself.
    pub on: Option<EventId>,
    /// Tokens that it removes. No place occurs twice in `take` and `read` together.
    pub take: &'n [Arc],
    /// Tokens that must be there and stay.
    pub read: &'n [Arc],
    /// Tokens that it adds. No place occurs twice.
    pub give: &'n [Arc],
    /// The outputs emitted, in this order.
    pub emits: &'n [OutputId],
    /// When it may fire, counted from the moment it became enabled. Without it: at any time when it
    /// needs an event, at once when it does not.
    pub within: Option<Within>,
    /// Priority: among enabled transitions the one with the highest fires.
    pub priority: i16,
}

impl Transition<'_> {
    /// A transition without a name that moves no token.
    pub const NOTHING: Self = Transition {
        name: "",
        doc: "",
        line: 0,
        on: None,
        take: &[],
        read: &[],
        give: &[],
        emits: &[],
        within: None,
        priority: 0,
    };
}

/// A number of tokens in a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    /// The place.
    pub place: PlaceId,
    /// How many tokens, at least one.
    pub weight: u32,
}

/// A time interval, closed on both sides, in milliseconds.
///
/// ```
/// use cotama_core::net::Within;
///
/// assert!(Within { earliest: 500, latest: Some(2_000) }.is_sound());
/// assert!(Within { earliest: 500, latest: None }.is_sound());
/// assert!(!Within { earliest: 500, latest: Some(400) }.is_sound());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Within {
    /// Least age at firing, in milliseconds since the transition became enabled.
    pub earliest: u32,
    /// Not after; `None`: no limit.
    pub latest: Option<u32>,
}

impl Within {
    /// The latest end that an interval can have, in milliseconds; one that ends later has none.
    pub const LATEST: u32 = u32::MAX - 1;

    /// Whether it ends, if at all, neither before it begins nor after [`LATEST`](Self::LATEST).
    pub const fn is_sound(self) -> bool {
        match self.latest {
            Some(latest) => self.earliest <= latest && latest <= Self::LATEST,
            None => true,
        }
    }
}

/// `event` is left unanswered where `place` is marked and the guard holds, on purpose.
///
/// ```
/// use cotama_core::net;
/// net! {
///     /// Uploads a picture when there is one, unless the link is too weak.
///     mod upload {
///         places { Waiting: 1, Sent }
///         shared { wifi, level: 0 of 3 }
///         events { picture }
///         transitions { send on picture [wifi & level >= 1]: Waiting => Sent; }
///         ignore { picture in Waiting [!wifi]; picture in Waiting [level < 1]; picture in Sent; }
///         laws { handles(all); }
///     }
/// }
/// let tokens = |place: net::PlaceId| upload::NET.places[place.0 as usize].initial;
/// let holds: Vec<bool> = upload::NET.ignored.iter().map(|it| it.holds(tokens)).collect();
/// assert_eq!(holds, [true, true, false]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ignored<'n> {
    /// The event.
    pub event: EventId,
    /// The place.
    pub place: PlaceId,
    /// Tokens that must be there as well, as those that a transition [reads](Transition::read); no
    /// place occurs twice.
    pub guard: &'n [Arc],
}

impl Ignored<'_> {
    /// Whether the place is marked and the guard holds, given the tokens of each place.
    pub fn holds(&self, tokens: impl Fn(PlaceId) -> u32) -> bool {
        tokens(self.place) > 0 && self.guard.iter().all(|arc| tokens(arc.place) >= arc.weight)
    }
}

/// A claim about everything that a [`Player`](crate::player::Player) of a net can do when it is
/// offered any event at any instant, is told the time, and other nets change the places that they
/// share at any instant.
///
/// A net *rests* where nothing fires by itself now. On the way there it *passes* markings: those
/// count as marked, but no event is offered in them. A *run* is what a player does from some
/// instant on.
///
/// ```
/// use cotama_core::{net, net::{Law, PlaceId}};
/// net! {
///     mod lamp {
///         places { Off: 1, On }
///         events { press }
///         transitions { on on press: Off => On; off on press: On => Off; }
///         laws { never_both(Off, On); always_can(Off); }
///     }
/// }
/// let laws = [Law::NeverBoth(PlaceId(0), PlaceId(1)), Law::AlwaysCan(PlaceId(0))];
/// assert_eq!(lamp::NET.laws, laws);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law<'n> {
    /// A weighted sum of tokens stays the same, also in passing: a place invariant.
    Invariant {
        /// Weights; a place that is not listed counts nothing.
        sum: &'n [Arc],
        /// The sum.
        equals: u32,
    },
    /// The two never hold a token at once, not even in passing.
    NeverBoth(PlaceId, PlaceId),
    /// Some run from the start marks it, be it in passing.
    Reachable(PlaceId),
    /// From wherever the net rests, some run marks it, be it in passing.
    AlwaysCan(PlaceId),
    /// Wherever and whenever the net rests, every event makes a transition fire, or is
    /// [ignored](Net::ignored) there on purpose: also before intervals begin and after they end.
    HandlesAll,
    /// A run of transitions that fire by themselves without time passing comes to an end.
    Settles,
    /// The net is never stuck, except where `end` is marked. It is *stuck* where it rests and no
    /// event and no passing of time makes a transition fire, now or ever, as long as the places it
    /// shares stay as they are.
    DeadlockFree {
        /// The place in which the net may stop.
        end: Option<PlaceId>,
    },
    /// Priorities and the order of lines decide nothing: where the net rests, no two transitions on
    /// one event are enabled and open together; where it passes, no two without event and interval
    /// are enabled together, and no two that are due at the same instant.
    Deterministic,
}
