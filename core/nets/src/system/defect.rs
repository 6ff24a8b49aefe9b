//! Whether the lists of a system fit together: in n log n time, and in the square of what one
//! transition says.

use super::data::{Binding, Clear, DEPTH, Delivery, Link, Of, System, Target};
use super::index::{Index, key, position};
use crate::net::data::{PlaceId, Role, TransitionId};
use crate::net::defect::NetError;
use core::fmt;

/// A defect of a [`System`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SystemError {
    /// A net is not sound.
    Net {
        /// Position of the component.
        component: u16,
        /// The defect of the net.
        defect: NetError,
    },
    /// A link, binding or clear at this position names something that is not there.
    UnknownId {
        /// In which list: links, bindings or clears.
        list: &'static str,
        /// Position of the entry.
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
    ChangesMailbox(Of<TransitionId>),
    /// A transition mails more to one event at once than its mailbox holds: it could never fire.
    Overfills(Of<TransitionId>),
}

impl fmt::Display for SystemError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Net { component, defect } => write!(f, "net {component} is not sound: {defect}"),
            Self::UnknownId { list, at } => write!(
                f,
                "entry {at} of the {list} names a net, an event, a place or a mailbox that is not \
                 there"
            ),
            Self::TooLong => write!(f, "the system has too many parts to be played"),
            Self::Unbound(Of { component, id }) => write!(
                f,
                "place {} of net {component} is shared and belongs to nobody; bind it to its owner",
                id.0
            ),
            Self::Binding { at } => write!(
                f,
                "entry {at} of the bindings binds a place a second time, or one that is not \
                 shared, or to a place of another bound or that is shared itself"
            ),
            Self::Delivery { at } => write!(
                f,
                "link {at} delivers in another way than an earlier link to the same event, or by \
                 mail without room; give both the same delivery, and a mailbox room for one"
            ),
            Self::Circle { component } => write!(
                f,
                "rendezvous lead from net {component} back to it, or on over more than {DEPTH} \
                 nets; let one of the links deliver by mail"
            ),
            Self::ChangesMailbox(Of { component, id }) => write!(
                f,
                "transition {} of net {component} changes a shared place that is a mailbox; it \
                 can only be read",
                id.0
            ),
            Self::Overfills(Of { component, id }) => write!(
                f,
                "transition {} of net {component} mails more at once than a mailbox holds, so it \
                 could never fire; give the mailbox more room",
                id.0
            ),
        }
    }
}

impl core::error::Error for SystemError {}

impl System<'_> {
    /// Returns the first defect of the system, or `None`. Its nets are taken to be sound.
    #[cfg(feature = "alloc")]
    pub fn defect(&self) -> Option<SystemError> {
        use alloc::vec;
        self.defect_by(&mut Index {
            links: &mut vec![(0, 0); self.links.len()],
            says: &mut vec![(0, 0); self.links.len()],
            bindings: &mut vec![(0, 0); self.bindings.len()],
            chains: &mut vec![0; self.components.len()],
        })
    }

    /// The same while compiling.
    pub(super) const fn defect_by(&self, index: &mut Index<'_>) -> Option<SystemError> {
        if self.is_alone() {
            return None;
        }
        let most = u16::MAX as usize - 1;
        if self.components.len() > most || self.links.len() > most || self.bindings.len() > most {
            return Some(SystemError::TooLong);
        }
        index.fill(self);
        // One after the other: later ones rely on what earlier ones have found to be there.
        if let defect @ Some(_) = self.link_defect(index) {
            return defect;
        }
        if let defect @ Some(_) = self.clear_defect(index) {
            return defect;
        }
        if let defect @ Some(_) = self.binding_defect(index) {
            return defect;
        }
        if let defect @ Some(_) = self.unbound(index) {
            return defect;
        }
        if let defect @ Some(_) = self.changed_mailbox(index) {
            return defect;
        }
        if let defect @ Some(_) = self.overfilled(index) {
            return defect;
        }
        self.circle(index.chains)
    }

    const fn link_defect(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut at = 0;
        while at < self.links.len() {
            let Link { from, to, delivery } = self.links[at];
            let net = self.net(from.component);
            let known = matches!(net, Some(net) if (from.id.0 as usize) < net.outputs.len());
            if !known || !self.has_event(to) {
                return Some(SystemError::UnknownId { list: "links", at });
            }
            let same = match (index.delivery(self, to), delivery) {
                (Some(Delivery::Now), Delivery::Now) => true,
                (Some(Delivery::Mail { capacity: first }), Delivery::Mail { capacity }) => {
                    first == capacity && capacity > 0
                }
                _ => false,
            };
            if !same {
                return Some(SystemError::Delivery { at });
            }
            at += 1;
        }
        None
    }

    const fn clear_defect(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut at = 0;
        while at < self.clears.len() {
            let Clear { on, mailbox } = self.clears[at];
            let mailbox = Of { component: on.component, id: mailbox };
            if !self.has_event(on) || index.mailbox(self, mailbox).is_none() {
                return Some(SystemError::UnknownId { list: "clears", at });
            }
            at += 1;
        }
        None
    }

    const fn binding_defect(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut at = 0;
        while at < self.bindings.len() {
            let Binding { shared, target } = self.bindings[at];
            let bound = match target {
                Target::Place(owner) if self.has_place(owner) => {
                    let it = self.place(owner);
                    match it.role {
                        Role::Shared | Role::Complement(_) => 0,
                        _ => it.bound,
                    }
                }
                Target::Place(_) => return Some(SystemError::UnknownId { list: "bindings", at }),
                Target::Mailbox(event) => match index.mailbox(self, event) {
                    Some(capacity) => capacity as u32,
                    None => return Some(SystemError::UnknownId { list: "bindings", at }),
                },
            };
            if !self.has_place(shared) {
                return Some(SystemError::UnknownId { list: "bindings", at });
            }
            let place = self.place(shared);
            let once = matches!(index.binding(shared), Some(first) if first == at);
            if !once || bound != place.bound || !matches!(place.role, Role::Shared) {
                return Some(SystemError::Binding { at });
            }
            at += 1;
        }
        None
    }

    const fn unbound(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut component = 0;
        while component < self.components.len() {
            let places = self.components[component].net.places;
            let mut place = 0;
            while place < places.len() {
                let of = Of { component: component as u16, id: PlaceId(place as u32) };
                if matches!(places[place].role, Role::Shared) && index.binding(of).is_none() {
                    return Some(SystemError::Unbound(of));
                }
                place += 1;
            }
            component += 1;
        }
        None
    }

    /// A transition that would change a mailbox through a shared place.
    const fn changed_mailbox(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut component = 0;
        while component < self.components.len() {
            let net = self.components[component].net;
            let mut at = 0;
            while at < net.transitions.len() {
                let (take, give) = (net.transitions[at].take, net.transitions[at].give);
                let mut arc = 0;
                while arc < take.len() + give.len() {
                    let arcs = if arc < take.len() { take } else { give };
                    let place = arcs[if arc < take.len() { arc } else { arc - take.len() }].place;
                    let place = match net.places[place.0 as usize].role {
                        Role::Complement(of) => of,
                        _ => place,
                    };
                    let component = component as u16;
                    if let Some(binding) = index.binding(Of { component, id: place })
                        && let Target::Mailbox(_) = self.bindings[binding].target
                    {
                        let id = TransitionId(at as u32);
                        return Some(SystemError::ChangesMailbox(Of { component, id }));
                    }
                    arc += 1;
                }
                at += 1;
            }
            component += 1;
        }
        None
    }

    /// A transition that mails more to one event at once than there is room for.
    const fn overfilled(&self, index: &Index<'_>) -> Option<SystemError> {
        let mut link = 0;
        while link < index.says.len() {
            let Link { from: Of { component, .. }, .. } = self.links[index.says[link].1 as usize];
            let transitions = self.components[component as usize].net.transitions;
            let mut at = 0;
            while at < transitions.len() {
                let from = Of { component, id: TransitionId(at as u32) };
                if self.overfills(index, from) {
                    return Some(SystemError::Overfills(from));
                }
                at += 1;
            }
            // On to the links of the next net.
            link = position(index.says, key(component + 1, 0));
        }
        None
    }

    const fn overfills(&self, index: &Index<'_>, from: Of<TransitionId>) -> bool {
        let emits =
            self.components[from.component as usize].net.transitions[from.id.0 as usize].emits;
        let mut emit = 0;
        while emit < emits.len() {
            let key = key(from.component, emits[emit].0);
            let mut at = position(index.says, key);
            while at < index.says.len() && index.says[at].0 == key {
                let Link { to, delivery, .. } = self.links[index.says[at].1 as usize];
                if let Delivery::Mail { capacity } = delivery
                    && index.mailed(self, from, to) > capacity as usize
                {
                    return true;
                }
                at += 1;
            }
            emit += 1;
        }
        false
    }

    /// A rendezvous that comes back to where it began, or goes on too long. In each round every
    /// link is followed once, so after [`DEPTH`] rounds each chain of so many links is found.
    const fn circle(&self, chains: &mut [u8]) -> Option<SystemError> {
        let mut round = 0;
        while round < DEPTH {
            let mut at = 0;
            while at < self.links.len() {
                let Link { from, to, delivery } = self.links[at];
                let follow = chains[to.component as usize];
                let from = &mut chains[from.component as usize];
                if matches!(delivery, Delivery::Now) && *from <= follow && (*from as usize) < DEPTH
                {
                    *from = if (follow as usize) < DEPTH { follow + 1 } else { follow };
                }
                at += 1;
            }
            round += 1;
        }
        let mut component = 0;
        while component < chains.len() {
            if chains[component] as usize == DEPTH {
                return Some(SystemError::Circle { component: component as u16 });
            }
            component += 1;
        }
        None
    }
}
