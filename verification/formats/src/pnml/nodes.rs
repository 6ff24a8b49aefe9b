//! The objects of the ids of a file, through references on other pages.

use super::document::{Object, Reference, Text};
use super::error::{Finding, Findings, Span};
use cotama_core::net::PlaceId;
use cotama_property::source::quoted;
use std::borrow::Cow;
use std::collections::HashMap;

/// A node of the net.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Node {
    Place(u32),
    Transition(u32),
}

/// The objects of the ids of a file.
pub(super) struct Nodes<'a> {
    ids: HashMap<Cow<'a, str>, (Object, Span)>,
    /// The node that each reference leads to in the end.
    references: Vec<Option<Node>>,
}

impl<'a> Nodes<'a> {
    /// Follows the references, each one once.
    pub(super) fn new(
        ids: HashMap<Cow<'a, str>, (Object, Span)>,
        references: &[Reference<'a>],
        findings: &mut Findings,
    ) -> Self {
        #[derive(Clone, Copy, PartialEq)]
        enum State {
            New,
            OnPath,
            Done(Option<Node>),
        }
        let mut states = vec![State::New; references.len()];
        let mut path = Vec::new();
        for start in 0..references.len() {
            let mut at = start;
            let end = loop {
                match states[at] {
                    State::Done(node) => break node,
                    State::OnPath => {
                        let of = &references[at];
                        let message =
                            format!("the reference {} leads back to itself", quoted(&of.id.value));
                        findings.push(
                            Finding::new(of.to.span, message)
                                .help("let one of the circle refer to a place or transition"),
                        );
                        break None;
                    }
                    State::New => {}
                }
                states[at] = State::OnPath;
                path.push(at);
                let of = &references[at];
                match ids.get(&of.to.value) {
                    Some(&(Object::Reference(next), _)) => at = next as usize,
                    Some(&(Object::Place(place), _)) if of.to_place => {
                        break Some(Node::Place(place));
                    }
                    Some(&(Object::Transition(it), _)) if !of.to_place => {
                        break Some(Node::Transition(it));
                    }
                    Some(&(object, span)) => {
                        let noun = if of.to_place { "a place" } else { "a transition" };
                        let message = format!(
                            "a reference to {noun} names {}, {}",
                            quoted(&of.to.value),
                            object.noun()
                        );
                        findings.push(
                            Finding::new(of.to.span, message)
                                .help(format!("refer to {noun}"))
                                .related(span),
                        );
                        break None;
                    }
                    None => {
                        findings.push(unknown_id(&of.to));
                        break None;
                    }
                }
            };
            for at in path.drain(..) {
                let fits = end
                    .is_none_or(|node| matches!(node, Node::Place(_)) == references[at].to_place);
                if !fits {
                    let message =
                        "a reference to a place and one to a transition lead to the same node";
                    findings.push(
                        Finding::new(references[at].to.span, message)
                            .help("make both of the same kind"),
                    );
                }
                states[at] = State::Done(end.filter(|_| fits));
            }
        }
        let done = |state: &State| if let State::Done(node) = *state { node } else { None };
        let references = states.iter().map(done).collect();
        Self { ids, references }
    }

    /// The node of an id; `None` when an error is known.
    pub(super) fn find(&self, id: &Text<'_>, findings: &mut Findings) -> Option<Node> {
        match self.ids.get(&id.value) {
            Some(&(Object::Place(place), _)) => Some(Node::Place(place)),
            Some(&(Object::Transition(transition), _)) => Some(Node::Transition(transition)),
            Some(&(Object::Reference(reference), _)) => {
                self.references.get(reference as usize).copied().flatten()
            }
            Some(&(object, span)) => {
                let message = format!(
                    "{} is {}, not a place or a transition",
                    quoted(&id.value),
                    object.noun()
                );
                findings.push(
                    Finding::new(id.span, message)
                        .help("name a place or a transition")
                        .related(span),
                );
                None
            }
            None => {
                findings.push(unknown_id(id));
                None
            }
        }
    }

    pub(super) fn place(&self, id: &Text<'_>, findings: &mut Findings) -> Option<PlaceId> {
        match self.find(id, findings)? {
            Node::Place(place) => Some(PlaceId(place)),
            Node::Transition(_) => {
                let message = format!("{} is a transition, not a place", quoted(&id.value));
                findings.push(Finding::new(id.span, message).help("name a place"));
                None
            }
        }
    }
}

fn unknown_id(id: &Text<'_>) -> Finding {
    Finding::new(id.span, format!("nothing in the net has the id {}", quoted(&id.value)))
        .help("name the `id` of a place or a transition, not its name")
}
