//! Several nets that work together, as plain data.

use crate::net::data::{EventId, Net, OutputId, PlaceId};

/// Nets in the order in which they take their turns, and what connects them.
///
/// An output of one net and an event of another are joined by a [`Link`]; several links from one
/// output are a broadcast. Events that no link leads to come from outside: from the robot, the
/// operator, or, when a system is closed for checking, from environment nets, which are nets like
/// any other. A [`Binding`] makes a shared place of one net the place of another.
///
/// ```
/// use cotama_core::{net, system};
/// use cotama_core::system::Delivery;
/// net! {
///     mod button {
///         places { Here: 1 }
///         events { press }
///         outputs { pressed }
///         transitions { press on press: Here => Here emit pressed; }
///     }
/// }
/// net! {
///     mod lamp {
///         places { Off: 1, On }
///         events { toggle }
///         transitions { on on toggle: Off => On; off on toggle: On => Off; }
///     }
/// }
/// system! {
///     mod room {
///         nets { button: button, lamp: lamp }
///         links { button.pressed => lamp.toggle now; }
///     }
/// }
/// # fn main() {
/// let system = &room::SYSTEM;
/// assert_eq!(system.components[1].name, "lamp");
/// assert_eq!(system.delivery(system.links[0].to), Some(Delivery::Now));
/// assert_eq!(system.defect(), None);
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct System<'s> {
    /// Name of the system.
    pub name: &'s str,
    /// Purpose of the system.
    pub doc: &'s str,
    /// The nets, in the order of their turns.
    pub components: &'s [Component<'s>],
    /// Which output causes which event.
    pub links: &'s [Link],
    /// The owner of each shared place.
    pub bindings: &'s [Binding],
    /// Which event empties which mailbox.
    pub clears: &'s [Clear],
}

/// A net with its name in a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Component<'s> {
    /// Name of the component.
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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Of<T> {
    /// The component.
    pub component: u16,
    /// The id in its net.
    pub id: T,
}

/// Something of a net alone.
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
    /// When it causes it.
    pub delivery: Delivery,
}

/// When an output causes an event.
///
/// ```
/// use cotama_core::{net, player::Outcome, system, units::Millis};
/// net! {
///     mod bell {
///         places { Here: 1 }
///         events { press }
///         outputs { ring }
///         transitions { ring on press: Here => Here emit ring; }
///     }
/// }
/// net! {
///     mod dog {
///         places { Asleep: 1, Awake }
///         events { heard }
///         transitions { wake on heard: Asleep => Awake; }
///     }
/// }
/// system! { mod now { nets { bell: bell, dog: dog } links { bell.ring => dog.heard now; } } }
/// system! { mod mail { nets { bell: bell, dog: dog } links { bell.ring => dog.heard mail 1; } } }
/// # fn main() {
/// let (mut now, mut mail) = (now::Player::new(), mail::Player::new());
/// assert!(now.offer(Millis(0), &now::Event::bell(bell::Event::press)).fired());
/// assert_eq!(now::state::dog(&now), dog::State::Awake);
/// let press = mail::Event::bell(bell::Event::press);
/// assert!(mail.offer(Millis(0), &press).fired());
/// assert_eq!(mail::state::dog(&mail), dog::State::Asleep); // its mail waits for its turn
/// let refused = mail.offer(Millis(1), &press); // there is no room
/// assert!(matches!(refused, Outcome::Refused { .. }));
/// assert_eq!(format!("{refused:?}"), "Refused { full: dog.heard }");
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delivery {
    /// At once, in the step that emits it: a rendezvous. The receiver fires or ignores it.
    Now,
    /// When the receiver takes its turn. Until then it waits in a mailbox of this capacity. While
    /// the mailbox of an event is full, a transition that emits it cannot fire; nothing is lost.
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
    /// The place or mailbox that it is.
    pub target: Target,
}

/// The target of a shared place.
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

/// The most rendezvous that follow from one another.
pub const DEPTH: usize = 8;

impl<'s> System<'s> {
    /// A net alone. Its shared places are its own.
    ///
    /// ```
    /// use cotama_core::net;
    /// use cotama_core::system::{Component, System};
    /// net! { mod lamp { places { Off: 1, On } transitions { on: Off => On after 5 ms; } } }
    /// let components = [Component::alone(&lamp::NET)];
    /// let system = System::alone(&components);
    /// assert_eq!((system.name, system.is_alone()), ("lamp", true));
    /// ```
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

    pub(super) const fn net(&self, component: u16) -> Option<&'s Net<'s>> {
        if (component as usize) < self.components.len() {
            Some(self.components[component as usize].net)
        } else {
            None
        }
    }

    pub(super) const fn has_event(&self, it: Of<EventId>) -> bool {
        matches!(self.net(it.component), Some(net) if (it.id.0 as usize) < net.events.len())
    }

    pub(super) const fn has_place(&self, it: Of<PlaceId>) -> bool {
        matches!(self.net(it.component), Some(net) if (it.id.0 as usize) < net.places.len())
    }

    /// A place that is there.
    pub(super) const fn place(&self, it: Of<PlaceId>) -> &crate::net::Place<'_> {
        &self.components[it.component as usize].net.places[it.id.0 as usize]
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

    /// Returns the target that a shared place is bound to.
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
}
