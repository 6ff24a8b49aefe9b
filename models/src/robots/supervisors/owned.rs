//! A system of nets that is made at run time.

use cotama_core::net::owned::{OwnedNet, View};
use cotama_core::net::{EventId, Net, OutputId, PlaceId};
use cotama_core::system::{Binding, Clear, Component, Delivery, Link, Of, System, Target};

/// A net of a system by its name there, and the name of a part of it.
type Port<'n> = (&'n str, &'n str);

/// Nets that work together, with what connects them. [`with`](Self::with) lends it as a [`System`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnedSystem {
    /// Name of the system.
    pub name: String,
    /// Documentation of the system.
    pub doc: String,
    /// The nets with their names, in the order in which they act in a round.
    pub nets: Vec<(String, OwnedNet)>,
    /// Links from outputs to events.
    pub links: Vec<Link>,
    /// Targets of shared places.
    pub bindings: Vec<Binding>,
    /// Events that empty mailboxes.
    pub clears: Vec<Clear>,
}

impl OwnedSystem {
    /// A system without nets.
    pub(super) fn new(name: &str, doc: &str) -> Self {
        let (nets, links, bindings, clears) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { name: name.to_owned(), doc: doc.to_owned(), nets, links, bindings, clears }
    }

    pub(super) fn net(&mut self, name: &str, net: OwnedNet) {
        self.nets.push((name.to_owned(), net));
    }

    /// The number of a net and the position of a part in one of its lists. A name that is not there
    /// is a mistake of the program.
    fn find<'s, T: 's>(
        &'s self,
        (net, part): Port<'_>,
        list: impl Fn(&'s OwnedNet) -> &'s [T],
        name: impl Fn(&T) -> &str,
    ) -> (u16, u32) {
        let component = self.nets.iter().position(|it| it.0 == net);
        debug_assert!(component.is_some(), "the net {net}");
        let of = component.and_then(|it| self.nets.get(it));
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
        self.links.push(Link { from, to, delivery: Delivery::Now });
    }

    /// An output waits in the mailbox of an event, one at most.
    pub(super) fn mail(&mut self, from: Port<'_>, to: Port<'_>) {
        let (from, to) = (self.output(from), self.event(to));
        self.links.push(Link { from, to, delivery: Delivery::Mail { capacity: 1 } });
    }

    /// A shared place is the place of another net.
    pub(super) fn share(&mut self, shared: Port<'_>, owner: Port<'_>) {
        let (shared, owner) = (self.place(shared), self.place(owner));
        self.bindings.push(Binding { shared, target: Target::Place(owner) });
    }

    /// A shared place is marked while something waits for an event.
    pub(super) fn pending(&mut self, shared: Port<'_>, event: Port<'_>) {
        let (shared, event) = (self.place(shared), self.event(event));
        self.bindings.push(Binding { shared, target: Target::Mailbox(event) });
    }

    /// An event empties a mailbox of the same net.
    pub(super) fn clear(&mut self, on: Port<'_>, mailbox: &str) {
        let (on, mailbox) = (self.event(on), self.event((on.0, mailbox)).id);
        self.clears.push(Clear { on, mailbox });
    }

    /// Runs something on the system as data that is borrowed.
    pub fn with<R>(&self, run: impl FnOnce(&System<'_>) -> R) -> R {
        let views: Vec<View<'_>> = self.nets.iter().map(|it| it.1.view()).collect();
        let nets: Vec<Net<'_>> = views.iter().map(View::net).collect();
        let names = self.nets.iter().map(|it| it.0.as_str());
        let components: Vec<_> =
            names.zip(&nets).map(|(name, net)| Component { name, net }).collect();
        run(&System {
            name: &self.name,
            doc: &self.doc,
            components: &components,
            links: &self.links,
            bindings: &self.bindings,
            clears: &self.clears,
        })
    }
}
