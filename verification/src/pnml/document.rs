//! The parts of a PNML file as they stand in it: nodes and arcs by their ids, before anything is
//! looked up.

use super::error::{Span, Spanned};
use super::own::{OwnArc, OwnNet, OwnPlace, OwnTransition};
use cotama_core::net::Within;
use std::borrow::Cow;
use std::collections::HashMap;

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
    /// What each id stands for and where it is given.
    pub(super) ids: HashMap<Cow<'a, str>, (Object, Span)>,
}

/// What an id stands for; the number is its position in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Object {
    Place(u32),
    Transition(u32),
    Reference(u32),
    Arc,
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
    pub(super) weight: Option<Spanned<u64>>,
    /// It takes nothing, and has no arc back.
    pub(super) test: bool,
    pub(super) own: OwnArc,
}
