//! The contents of a drawing of a net, before any format or coordinate: the same for DOT, Mermaid
//! and SVG.

mod bundled;
mod condition;
mod label;
mod net;
mod states;

pub(crate) use label::Label;

use cotama_core::net::{Net, Place};

/// How a net is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// [`Style::States`] when the net is a state machine, otherwise [`Style::Net`]; of 50
    /// transitions and more, those with the same arrows share a bar, a line of the definition is
    /// drawn once, and data are words in the labels.
    #[default]
    Auto,
    /// Places as circles, transitions as bars. Complements that only mirror another place are left
    /// out; what is asked of them stands as a guard, `[!sonar]`, at the transition.
    Net,
    /// Places as states, transitions as edges labelled `event [guard] / emits  a..b ms`. Only for
    /// nets whose state places hold one token in all, which every transition takes from one and
    /// gives to one; others are drawn as [`Style::Net`].
    ///
    /// When one line of the definition leads from three or more states to the same one with the
    /// same label, it is drawn once, as an arrow from `any other state` or from the names of those
    /// states.
    States,
}

/// The nodes and edges of a drawing.
#[derive(Debug)]
pub(crate) struct Figure<'n> {
    pub(crate) name: &'n str,
    pub(crate) doc: &'n str,
    /// Whether the nodes are states.
    pub(crate) is_states: bool,
    pub(crate) nodes: Vec<Node<'n>>,
    pub(crate) edges: Vec<Edge<'n>>,
}

/// A state, a place or a transition.
#[derive(Debug)]
pub(crate) struct Node<'n> {
    pub(crate) kind: Kind,
    pub(crate) name: &'n str,
    pub(crate) doc: &'n str,
    /// Label of a transition: its conditions and actions, beside its arcs.
    pub(crate) label: Option<Label<'n>>,
    /// Transitions into this state that are not drawn as edges.
    pub(crate) entries: Vec<Entry<'n>>,
    /// Further transitions with the same arrows that share this bar.
    pub(crate) also: Vec<(&'n str, Label<'n>)>,
}

impl<'n> Node<'n> {
    /// Makes the node of a place, without transitions.
    pub(crate) fn of(kind: Kind, place: &Place<'n>) -> Self {
        let (name, doc) = (place.name, place.doc);
        Self { kind, name, doc, label: None, entries: Vec::new(), also: Vec::new() }
    }
}

impl Node<'_> {
    /// The transitions that a bar stands for; none for a place.
    pub(crate) fn transitions(&self) -> impl Iterator<Item = u32> {
        let labels = self.label.iter().chain(self.also.iter().map(|it| &it.1));
        let is_bar = matches!(self.kind, Kind::Transition(_));
        labels.filter(move |_| is_bar).flat_map(|it| &it.transitions).copied()
    }
}

/// The part of the net that a node stands for, by its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A place as a state.
    State(usize),
    /// A place as a circle; `shared` when another net owns it.
    Place { place: usize, shared: bool },
    /// A transition as a bar.
    Transition(usize),
}

/// One line of the definition that leads here from many states.
#[derive(Debug)]
pub(crate) struct Entry<'n> {
    /// `any other state`, or the names of the states.
    pub(crate) sources: String,
    pub(crate) label: Label<'n>,
}

/// An arc, or all transitions from one state to another.
#[derive(Debug)]
pub(crate) struct Edge<'n> {
    /// The node it starts at.
    pub(crate) from: usize,
    /// The node it ends at.
    pub(crate) to: usize,
    pub(crate) flow: Flow,
    /// Number of tokens moved.
    pub(crate) weight: u32,
    /// The transitions of an edge between states.
    pub(crate) labels: Vec<Label<'n>>,
}

/// The effect of an edge on tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// Moves them.
    Move,
    /// Takes and gives back the same number.
    Borrow,
    /// Only needs them.
    Read,
}

impl<'n> Figure<'n> {
    /// Ids that point nowhere are left out.
    pub(crate) fn of(net: &Net<'n>, style: Style) -> Self {
        let states = if style == Style::Net { None } else { states::figure(net) };
        let bundled = || if style == Style::Auto { bundled::figure(net) } else { None };
        states.or_else(bundled).unwrap_or_else(|| net::figure(net))
    }
}
