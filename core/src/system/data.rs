//! Several nets that work together, as plain data.

use crate::net::data::{EventId, Net, OutputId, PlaceId};
use crate::net::defect::Defect;

/// Nets in the order in which they take their turns, and what connects them.
///
/// An output of one net and an event of another are joined by a [`Link`]; several links from one
/// output are a broadcast. Events that no link leads to come from outside: from the robot, the
/// operator, or, when a system is closed for checking, from environment nets, which are nets like
/// any other. A [`Binding`] makes a shared place of one net the place of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct System<'s> {
    /// Its name.
    pub name: &'s str,
    /// What it is for.
    pub doc: &'s str,
    /// Its nets, in the order of their turns.
    pub components: &'s [Component<'s>],
    /// Which output causes which event.
    pub links: &'s [Link],
    /// Whose place a shared place is.
    pub bindings: &'s [Binding],
    /// Which event empties which mailbox.
    pub clears: &'s [Clear],
}

/// A net with its name in a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Component<'s> {
    /// Its name.
    pub name: &'s str,
    /// The net.
    pub net: &'s Net<'s>,
}

impl<'s> Component<'s> {
    /// A net alone, by its own name.
    pub const fn alone(net: &'s Net<'s>) -> Self {
        Self { name: net.name, net }
    }
}

/// Something of a component: its position in [`System::components`], and an id of its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Of<T> {
    /// The component.
    pub component: u16,
    /// What of its net.
    pub id: T,
}

/// Of a net alone.
impl<T> From<T> for Of<T> {
    fn from(id: T) -> Self {
        Self { component: 0, id }
    }
}

/// An output that causes an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// The output.
    pub from: Of<OutputId>,
    /// The event.
    pub to: Of<EventId>,
    /// When it does.
    pub delivery: Delivery,
}

/// When an output causes an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delivery {
    /// In the very step that emits it: a rendezvous. The receiver fires or ignores it.
    Now,
    /// When the receiver takes its turn: it waits in a mailbox with room for so many. While the
    /// mailbox of an event is full, a transition that emits it cannot fire; nothing is lost.
    Mail {
        /// At least one. Links to the same event share its mailbox, so they say the same.
        capacity: u16,
    },
}

/// A shared place that is another net's place, or a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The shared place.
    pub shared: Of<PlaceId>,
    /// Whose it is.
    pub target: Target,
}

/// What a shared place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A place, flag or counter of another component.
    Place(Of<PlaceId>),
    /// The mailbox of an event: marked while something waits in it. It can be read, not changed.
    Mailbox(Of<EventId>),
}

/// An event that empties a mailbox of the same component, whether a transition on it fires or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clear {
    /// The event.
    pub on: Of<EventId>,
    /// The event whose mailbox is emptied.
    pub mailbox: EventId,
}

/// What is wrong with a [`System`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SystemDefect {
    /// A net is not sound.
    Net {
        /// Which component.
        component: u16,
        /// What is wrong with its net.
        defect: Defect,
    },
    /// A link, binding or clear at this position names something that is not there.
    UnknownId {
        /// In which list: links, bindings or clears.
        list: &'static str,
        /// Its position.
        at: usize,
    },
    /// The lists are longer than 65,534.
    TooLong,
    /// A shared place has no binding.
    Unbound(Of<PlaceId>),
    /// A shared place has two bindings, or one of another bound, or is bound to a shared place.
    Binding {
        /// The position of the binding.
        at: usize,
    },
    /// Two links to one event differ in delivery, or a mailbox has no room.
    Delivery {
        /// The position of the link.
        at: usize,
    },
    /// A net would receive its own rendezvous, directly or through others, or through more than
    /// [`DEPTH`] of them.
    Circle {
        /// The component where it begins.
        component: u16,
    },
    /// A transition changes a shared place that is a mailbox.
    ChangesMailbox(Of<crate::net::data::TransitionId>),
}

/// The most rendezvous that follow from one another.
pub const DEPTH: usize = 8;

impl<'s> System<'s> {
    /// A net alone. Its shared places are its own.
    pub const fn alone(component: &'s [Component<'s>; 1]) -> Self {
        let Net { name, doc, .. } = *component[0].net;
        Self { name, doc, components: component, links: &[], bindings: &[], clears: &[] }
    }

    /// Whether it is a net alone: nothing is connected.
    pub const fn is_alone(&self) -> bool {
        self.components.len() == 1
            && self.links.is_empty()
            && self.bindings.is_empty()
            && self.clears.is_empty()
    }

    const fn net(&self, component: u16) -> Option<&'s Net<'s>> {
        if (component as usize) < self.components.len() {
            Some(self.components[component as usize].net)
        } else {
            None
        }
    }

    const fn has_event(&self, it: Of<EventId>) -> bool {
        matches!(self.net(it.component), Some(net) if (it.id.0 as usize) < net.events.len())
    }

    const fn has_place(&self, it: Of<PlaceId>) -> bool {
        matches!(self.net(it.component), Some(net) if (it.id.0 as usize) < net.places.len())
    }

    /// How the events of this kind arrive: `None` from outside.
    pub const fn delivery(&self, to: Of<EventId>) -> Option<Delivery> {
        let mut at = 0;
        while at < self.links.len() {
            let link = &self.links[at];
            if link.to.component == to.component && link.to.id.0 == to.id.0 {
                return Some(link.delivery);
            }
            at += 1;
        }
        None
    }

    /// What a shared place is bound to.
    pub const fn target(&self, shared: Of<PlaceId>) -> Option<Target> {
        let mut at = 0;
        while at < self.bindings.len() {
            let binding = &self.bindings[at];
            if binding.shared.component == shared.component && binding.shared.id.0 == shared.id.0 {
                return Some(binding.target);
            }
            at += 1;
        }
        None
    }

    /// What is wrong with it, if anything. Its nets are taken to be sound.
    pub const fn defect(&self) -> Option<SystemDefect> {
        if self.is_alone() {
            return None;
        }
        if self.components.len() > u16::MAX as usize - 1 || self.links.len() > u16::MAX as usize - 1
        {
            return Some(SystemDefect::TooLong);
        }
        let mut at = 0;
        while at < self.links.len() {
            let Link { from, to, delivery } = self.links[at];
            let known = matches!(self.net(from.component), Some(net) if (from.id.0 as usize) < net.outputs.len());
            if !known || !self.has_event(to) {
                return Some(SystemDefect::UnknownId { list: "links", at });
            }
            let same = match (self.delivery(to), delivery) {
                (Some(Delivery::Now), Delivery::Now) => true,
                (Some(Delivery::Mail { capacity: first }), Delivery::Mail { capacity }) => {
                    first == capacity && capacity > 0
                }
                _ => false,
            };
            if !same {
                return Some(SystemDefect::Delivery { at });
            }
            at += 1;
        }
        let mut at = 0;
        while at < self.clears.len() {
            let Clear { on, mailbox } = self.clears[at];
            let mailbox = Of { component: on.component, id: mailbox };
            if !self.has_event(on) || !matches!(self.delivery(mailbox), Some(Delivery::Mail { .. }))
            {
                return Some(SystemDefect::UnknownId { list: "clears", at });
            }
            at += 1;
        }
        match (self.binding_defect(), self.changed_mailbox()) {
            (Some(defect), _) | (None, Some(defect)) => Some(defect),
            (None, None) => self.circle(),
        }
    }

    /// A transition that would change a mailbox through a shared place.
    const fn changed_mailbox(&self) -> Option<SystemDefect> {
        let mut component = 0;
        while component < self.components.len() {
            let net = self.components[component].net;
            let mut at = 0;
            while at < net.transitions.len() {
                let mut arc = 0;
                let (take, give) = (net.transitions[at].take, net.transitions[at].give);
                while arc < take.len() + give.len() {
                    let place = if arc < take.len() {
                        take[arc].place
                    } else {
                        give[arc - take.len()].place
                    };
                    let of = match net.places[place.0 as usize].role {
                        crate::net::data::Role::Complement(of) => of,
                        _ => place,
                    };
                    if let Some(Target::Mailbox(_)) =
                        self.target(Of { component: component as u16, id: of })
                    {
                        let id = crate::net::data::TransitionId(at as u32);
                        return Some(SystemDefect::ChangesMailbox(Of {
                            component: component as u16,
                            id,
                        }));
                    }
                    arc += 1;
                }
                at += 1;
            }
            component += 1;
        }
        None
    }

    const fn binding_defect(&self) -> Option<SystemDefect> {
        let mut at = 0;
        while at < self.bindings.len() {
            let Binding { shared, target } = self.bindings[at];
            if !self.has_place(shared) {
                return Some(SystemDefect::UnknownId { list: "bindings", at });
            }
            let place =
                &self.components[shared.component as usize].net.places[shared.id.0 as usize];
            let bound = match target {
                Target::Place(owner) if self.has_place(owner) => {
                    let owner =
                        &self.components[owner.component as usize].net.places[owner.id.0 as usize];
                    if matches!(
                        owner.role,
                        crate::net::data::Role::Shared | crate::net::data::Role::Complement(_)
                    ) {
                        0
                    } else {
                        owner.bound
                    }
                }
                Target::Mailbox(event) => match self.delivery(event) {
                    Some(Delivery::Mail { capacity }) => capacity as u32,
                    _ => return Some(SystemDefect::UnknownId { list: "bindings", at }),
                },
                Target::Place(_) => return Some(SystemDefect::UnknownId { list: "bindings", at }),
            };
            let mut other = 0;
            while other < at {
                let earlier = self.bindings[other].shared;
                if earlier.component == shared.component && earlier.id.0 == shared.id.0 {
                    return Some(SystemDefect::Binding { at });
                }
                other += 1;
            }
            if bound != place.bound || !matches!(place.role, crate::net::data::Role::Shared) {
                return Some(SystemDefect::Binding { at });
            }
            at += 1;
        }
        let mut component = 0;
        while component < self.components.len() {
            let net = self.components[component].net;
            let mut place = 0;
            while place < net.places.len() {
                let of = Of { component: component as u16, id: PlaceId(place as u32) };
                if matches!(net.places[place].role, crate::net::data::Role::Shared)
                    && self.target(of).is_none()
                {
                    return Some(SystemDefect::Unbound(of));
                }
                place += 1;
            }
            component += 1;
        }
        None
    }

    /// A rendezvous that comes back to where it began, or goes on too long.
    const fn circle(&self) -> Option<SystemDefect> {
        let mut component = 0;
        while component < self.components.len() {
            // After `DEPTH` steps along rendezvous nothing may be left to reach.
            if self.reaches(component as u16, DEPTH) {
                return Some(SystemDefect::Circle { component: component as u16 });
            }
            component += 1;
        }
        None
    }

    const fn reaches(&self, from: u16, steps: usize) -> bool {
        if steps == 0 {
            return true;
        }
        let mut at = 0;
        while at < self.links.len() {
            let link = &self.links[at];
            if matches!(link.delivery, Delivery::Now)
                && link.from.component == from
                && self.reaches(link.to.component, steps - 1)
            {
                return true;
            }
            at += 1;
        }
        false
    }
}
