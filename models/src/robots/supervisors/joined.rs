//! A system that is joined net by net, with names in place of ids.

use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{EventId, OutputId, PlaceId};
use cotama_core::system::owned::OwnedSystem;
use cotama_core::system::{Binding, Clear, Delivery, Link, Of, Target};

/// A net of a system by its name there, and the name of a part of it.
type Port<'n> = (&'n str, &'n str);

/// A system under way.
pub(super) struct Joined {
    system: OwnedSystem,
}

impl Joined {
    /// A system without nets.
    pub(super) fn new(name: &str, doc: &str) -> Self {
        Self { system: OwnedSystem::new(name, doc) }
    }

    pub(super) fn done(self) -> OwnedSystem {
        self.system
    }

    pub(super) fn net(&mut self, name: &str, net: OwnedNet) {
        self.system.nets.push((name.to_owned(), net));
    }

    /// The number of a net and the position of a part in one of its lists. A name that is not there
    /// is a mistake of the program.
    fn find<'s, T: 's>(
        &'s self,
        (net, part): Port<'_>,
        list: impl Fn(&'s OwnedNet) -> &'s [T],
        name: impl Fn(&T) -> &str,
    ) -> (u16, u32) {
        let component = self.system.nets.iter().position(|it| it.0 == net);
        debug_assert!(component.is_some(), "the net {net}");
        let of = component.and_then(|it| self.system.nets.get(it));
        let id = of.and_then(|it| list(&it.1).iter().position(|it| name(it) == part));
        debug_assert!(id.is_some(), "{part} of the net {net}");
        (component.unwrap_or(0) as u16, id.map_or(u32::MAX, |it| it as u32))
    }

    fn output(&self, of: Port<'_>) -> Of<OutputId> {
        let (component, id) = self.find(of, |it| &it.outputs, |it| &it.name);
        Of { component, id: OutputId(id) }
    }

    fn event(&self, of: Port<'_>) -> Of<EventId> {
        let (component, id) = self.find(of, |it| &it.events, |it| &it.name);
        Of { component, id: EventId(id) }
    }

    fn place(&self, of: Port<'_>) -> Of<PlaceId> {
        let (component, id) = self.find(of, |it| &it.places, |it| &it.name);
        Of { component, id: PlaceId(id) }
    }

    /// An output is an event of another net, at once.
    pub(super) fn now(&mut self, from: Port<'_>, to: Port<'_>) {
        let (from, to) = (self.output(from), self.event(to));
        self.system.links.push(Link { from, to, delivery: Delivery::Now });
    }

    /// An output waits in the mailbox of an event, one at most.
    pub(super) fn mail(&mut self, from: Port<'_>, to: Port<'_>) {
        let (from, to) = (self.output(from), self.event(to));
        self.system.links.push(Link { from, to, delivery: Delivery::Mail { capacity: 1 } });
    }

    /// A shared place is the place of another net.
    pub(super) fn share(&mut self, shared: Port<'_>, owner: Port<'_>) {
        let (shared, owner) = (self.place(shared), self.place(owner));
        self.system.bindings.push(Binding { shared, target: Target::Place(owner) });
    }

    /// A shared place is marked while something waits for an event.
    pub(super) fn pending(&mut self, shared: Port<'_>, event: Port<'_>) {
        let (shared, event) = (self.place(shared), self.event(event));
        self.system.bindings.push(Binding { shared, target: Target::Mailbox(event) });
    }

    /// An event empties a mailbox of the same net.
    pub(super) fn clear(&mut self, on: Port<'_>, mailbox: &str) {
        let (on, mailbox) = (self.event(on), self.event((on.0, mailbox)).id);
        self.system.clears.push(Clear { on, mailbox });
    }
}
