//! The parts of a PNML file as they stand in it: nodes and arcs by their ids, before anything is
//! looked up.

use super::error::{Span, Spanned};
use super::kind::Kind;
use cotama_core::net::Within;
use cotama_core::net::owned::OwnedSignal;
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

/// A text of the file and where it stands.
pub(super) type Text<'a> = Spanned<Cow<'a, str>>;

/// A P/T net with its ids.
#[derive(Default)]
pub(super) struct Document<'a> {
    pub(super) id: Cow<'a, str>,
    pub(super) name: Option<Cow<'a, str>>,
    pub(super) own: OwnNet<'a>,
    pub(super) places: Vec<RawPlace<'a>>,
    pub(super) transitions: Vec<RawTransition<'a>>,
    pub(super) references: Vec<Reference<'a>>,
    pub(super) arcs: Vec<RawArc<'a>>,
    /// The object of each id and the position of its definition.
    pub(super) ids: HashMap<Cow<'a, str>, (Object, Span)>,
    /// The first transition with a random delay.
    pub(super) random: Option<Span>,
    /// Notes on what was left out, each once.
    pub(super) notes: BTreeSet<String>,
}

/// The object of an id; the number is its position in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Object {
    Place(u32),
    Transition(u32),
    Reference(u32),
    /// Nothing refers to it.
    Arc,
    /// Nothing refers to it.
    Page,
}

impl Object {
    pub(super) fn noun(self) -> &'static str {
        match self {
            Self::Place(_) => "a place",
            Self::Transition(_) => "a transition",
            Self::Reference(_) => "a reference",
            Self::Arc => "an arc",
            Self::Page => "a page",
        }
    }
}

pub(super) struct RawPlace<'a> {
    pub(super) id: Text<'a>,
    pub(super) name: Option<Cow<'a, str>>,
    pub(super) initial: u32,
    pub(super) own: Option<Box<OwnPlace<'a>>>,
}

pub(super) struct RawTransition<'a> {
    pub(super) id: Text<'a>,
    pub(super) name: Option<Cow<'a, str>>,
    /// The interval as TINA writes it.
    pub(super) delay: Option<Within>,
    /// Whether `ProM` or pm4py calls it invisible.
    pub(super) invisible: bool,
    /// Whether its delay is random, so that immediate ones go before it.
    pub(super) is_random: bool,
    /// The larger goes first.
    pub(super) priority: Option<u32>,
    pub(super) own: Option<Box<OwnTransition<'a>>>,
}

/// A node that stands for another one.
pub(super) struct Reference<'a> {
    pub(super) id: Text<'a>,
    pub(super) to: Text<'a>,
    /// The element: it says whether a place or a transition is meant.
    pub(super) to_place: bool,
}

pub(super) struct RawArc<'a> {
    pub(super) span: Span,
    pub(super) source: Text<'a>,
    pub(super) target: Text<'a>,
    pub(super) weight: Option<Box<Spanned<u64>>>,
    pub(super) kind: Kind,
    pub(super) own: OwnArc,
}

/// The contents of the net-level part.
#[derive(Default)]
pub(super) struct OwnNet<'a> {
    pub(super) name: Option<String>,
    pub(super) doc: String,
    pub(super) events: Vec<(Text<'a>, OwnedSignal)>,
    pub(super) outputs: Vec<(Text<'a>, OwnedSignal)>,
    pub(super) ignored: Vec<RawIgnored<'a>>,
    pub(super) laws: Vec<RawLaw<'a>>,
}

/// An ignored event by ids.
pub(super) struct RawIgnored<'a> {
    pub(super) event: Text<'a>,
    pub(super) place: Text<'a>,
    pub(super) guard: Vec<(Text<'a>, u32)>,
}

/// A law by the ids of its places.
pub(super) enum RawLaw<'a> {
    Invariant { sum: Vec<(Text<'a>, u32)>, equals: u32 },
    NeverBoth(Text<'a>, Text<'a>),
    Reachable(Text<'a>),
    AlwaysCan(Text<'a>),
    HandlesAll,
    Settles,
    DeadlockFree { end: Option<Text<'a>> },
    Deterministic,
}

pub(super) struct OwnPlace<'a> {
    pub(super) span: Span,
    pub(super) name: Option<String>,
    pub(super) doc: String,
    pub(super) bound: Option<u32>,
    pub(super) role: RawRole<'a>,
}

#[derive(Default)]
pub(super) enum RawRole<'a> {
    #[default]
    State,
    Data,
    Complement(Text<'a>),
    Shared,
    Mailbox,
}

pub(super) struct OwnTransition<'a> {
    pub(super) name: Option<String>,
    pub(super) doc: String,
    pub(super) line: Option<u32>,
    pub(super) on: Option<Text<'a>>,
    pub(super) emits: Option<Text<'a>>,
    pub(super) within: Option<Within>,
    pub(super) priority: i16,
}

/// How many of the tokens on an arc belong to a read arc.
#[derive(Clone, Copy, Default)]
pub(super) struct OwnArc {
    pub(super) read: u32,
}
