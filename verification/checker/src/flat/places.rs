//! The places of a system: those of its nets, and two for each mailbox.

use super::FlatError;
use super::interleaving::Flat;
use cotama_core::net::owned::OwnedPlace;
use cotama_core::net::{EventId, Place, PlaceId, Role};
use cotama_core::system::{Delivery, Of, Target};

impl Flat<'_> {
    pub(super) fn add_places(&mut self) {
        for at in 0..self.components() {
            let (name, net) = self.component(at);
            let own = |place: &Place<'_>| match place.role {
                Role::Shared => false,
                Role::Complement(of) => net.places[of.0 as usize].role != Role::Shared,
                _ => true,
            };
            let mut ids = vec![PlaceId(u32::MAX); net.places.len()];
            for (place, id) in net.places.iter().zip(&mut ids).filter(|(place, _)| own(place)) {
                let Place { name: of, doc, initial, bound, role } = *place;
                *id = self.push(OwnedPlace {
                    name: format!("{name}.{of}"),
                    doc: doc.to_owned(),
                    initial,
                    bound,
                    role,
                });
            }
            for (place, &id) in net.places.iter().zip(&ids).filter(|(place, _)| own(place)) {
                if let Role::Complement(of) = place.role {
                    let of = ids[of.0 as usize];
                    self.net.places[id.0 as usize].role = Role::Complement(of);
                    self.absent.insert(of, id);
                }
            }
            self.places.push(ids);
        }
        for at in 0..self.components() {
            let (name, net) = self.component(at);
            for (event, number) in net.events.iter().zip(0..) {
                let Some(Delivery::Mail { capacity }) =
                    self.system.delivery(Of { component: at, id: EventId(number) })
                else {
                    continue;
                };
                let bound = u32::from(capacity);
                let label = |what: &str| format!("{name}.{}.{what}", event.name);
                let waiting = self.push(OwnedPlace {
                    name: label("waiting"),
                    doc: event.doc.to_owned(),
                    initial: 0,
                    bound,
                    role: Role::Mailbox,
                });
                let role = Role::Complement(waiting);
                let room = self.push(OwnedPlace {
                    name: label("room"),
                    doc: String::new(),
                    initial: bound,
                    bound,
                    role,
                });
                self.absent.insert(waiting, room);
                self.mailboxes.insert((at, number), (waiting, room, capacity));
            }
        }
        self.bind();
    }

    /// Shared places are where they are bound to.
    fn bind(&mut self) {
        for binding in self.system.bindings {
            let target = match binding.target {
                Target::Place(of) => self.places[usize::from(of.component)][of.id.0 as usize],
                Target::Mailbox(of) => self.mailboxes[&(of.component, of.id.0)].0,
            };
            self.places[usize::from(binding.shared.component)][binding.shared.id.0 as usize] =
                target;
        }
    }

    /// The place that holds what this one lacks to its bound; it may have to be made.
    pub(super) fn complement(&mut self, place: PlaceId) -> Result<PlaceId, FlatError> {
        if let Some(&complement) = self.absent.get(&place) {
            return Ok(complement);
        }
        let of = &self.net.places[place.0 as usize];
        if let Role::Complement(of) = of.role {
            return Ok(of);
        }
        if of.bound == Place::UNBOUNDED {
            return Err(FlatError::Unbounded { place: of.name.clone() });
        }
        self.wanted.insert(place);
        Ok(place) // of the first pass only, whose net is thrown away
    }

    /// The place of a component, complements of shared places among them.
    pub(super) fn place(&mut self, component: u16, place: PlaceId) -> Result<PlaceId, FlatError> {
        let (_, net) = self.component(component);
        if let Role::Complement(of) = net.places[place.0 as usize].role
            && net.places[of.0 as usize].role == Role::Shared
        {
            let of = self.places[usize::from(component)][of.0 as usize];
            return self.complement(of);
        }
        Ok(self.places[usize::from(component)][place.0 as usize])
    }
}
