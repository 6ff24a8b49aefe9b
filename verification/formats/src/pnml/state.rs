//! The state of the parser: its position, and the parts read so far.

use super::Limits;
use super::document::{Document, Text};
use super::error::{Findings, Span};
use super::xml::Xml;
use std::borrow::Cow;

/// An element whose text counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Label {
    Name,
    InitialMarking,
    Inscription,
    /// The kind of an arc.
    ArcKind,
    /// An element that is a kind by its name, around what the arc says.
    Wrapped,
    Capacity,
    Timed,
    Priority,
    Guard,
}

impl Label {
    /// Whether text counts that stands in it without a `<text>` around.
    pub(super) fn holds_text(self) -> bool {
        !matches!(self, Self::Name | Self::InitialMarking | Self::Inscription | Self::Capacity)
    }
}

/// The owner of a part of another tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Place,
    Transition,
    Arc,
}

/// The position of the parser: one for each open element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Context {
    Pnml,
    Net,
    Page,
    Place,
    Transition,
    Arc,
    Reference,
    Label(Label, Span),
    /// `<text>` or `<value>`, the content of a label.
    Text,
    Delay,
    Interval(Span),
    /// A bound of an interval.
    Bound,
    /// An element of what is wrapped.
    Inside,
    /// A part of another tool in an arc, a transition or a place.
    Foreign(Owner),
    /// `<toolspecific tool="cotama">`.
    OwnNet,
    OwnPlace,
    OwnTransition,
    OwnArc,
    /// An element inside of that.
    Own,
    /// `<invariant>` inside of that.
    OwnInvariant,
    /// `<ignored>` inside of that.
    OwnIgnored,
    /// Nothing in here is read.
    Skipped,
}

/// The parser. What it does at a tag stands in `parser`, `label` and `own`.
pub(super) struct Parser<'a> {
    pub(super) xml: Xml<'a>,
    pub(super) limits: Limits,
    pub(super) document: Document<'a>,
    pub(super) findings: Findings,
    pub(super) contexts: Vec<Context>,
    /// The text of the label or bound that is being read.
    pub(super) text: Option<Text<'a>>,
    /// The labels that the open object has so far.
    pub(super) labels: Vec<Label>,
    pub(super) bounds: Vec<Text<'a>>,
    pub(super) closure: Cow<'a, str>,
    pub(super) net: Option<Span>,
    pub(super) coloured: Option<Span>,
    pub(super) objects: usize,
    /// An object could not be kept, so ids may be missing.
    pub(super) incomplete: bool,
}
