//! Systems that are made at run time: read from a file or built by a function.

use super::data::{Binding, Clear, Component, Link, System};
use crate::net::Net;
use crate::net::owned::{OwnedNet, View};
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

/// A [`System`] that owns its nets and lists. [`with`](Self::with) lends it.
///
/// ```
/// use cotama_core::net::owned::OwnedNet;
/// use cotama_core::net;
/// use cotama_core::system::owned::OwnedSystem;
/// net! { mod lamp { places { Off: 1, On } transitions { on: Off => On after 5 ms; } } }
/// let mut system = OwnedSystem::new("two_lamps", "");
/// system.nets.push(("left".to_owned(), OwnedNet::from(&lamp::NET)));
/// system.nets.push(("right".to_owned(), OwnedNet::from(&lamp::NET)));
/// assert_eq!(system.with(|it| it.components[1].name.to_owned()), "right");
/// assert_eq!(system.with(|it| OwnedSystem::from(it)), system);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnedSystem {
    /// Name of the system.
    pub name: String,
    /// Purpose of the system.
    pub doc: String,
    /// The nets with their names, in the order of their turns.
    pub nets: Vec<(String, OwnedNet)>,
    /// Which output causes which event.
    pub links: Vec<Link>,
    /// The owner of each shared place.
    pub bindings: Vec<Binding>,
    /// Which event empties which mailbox.
    pub clears: Vec<Clear>,
}

impl OwnedSystem {
    /// A system without nets.
    pub fn new(name: &str, doc: &str) -> Self {
        Self { name: name.to_owned(), doc: doc.to_owned(), ..Self::default() }
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

    /// Lends it for good, for a system that is made once: its memory is never freed.
    ///
    /// ```
    /// use cotama_core::system::owned::OwnedSystem;
    /// let system = OwnedSystem::new("empty", "").leak();
    /// assert_eq!((system.name, system.components.len()), ("empty", 0));
    /// ```
    pub fn leak(self) -> System<'static> {
        let it: &'static Self = Box::leak(Box::new(self));
        let views: &'static [View<'_>] =
            it.nets.iter().map(|it| it.1.view()).collect::<Vec<_>>().leak();
        let nets: &'static [Net<'_>] = views.iter().map(View::net).collect::<Vec<_>>().leak();
        let names = it.nets.iter().map(|it| it.0.as_str());
        let components = names.zip(nets).map(|(name, net)| Component { name, net });
        System {
            name: &it.name,
            doc: &it.doc,
            components: components.collect::<Vec<_>>().leak(),
            links: &it.links,
            bindings: &it.bindings,
            clears: &it.clears,
        }
    }
}

impl From<&System<'_>> for OwnedSystem {
    fn from(system: &System<'_>) -> Self {
        let net = |it: &Component<'_>| (it.name.to_owned(), OwnedNet::from(it.net));
        Self {
            name: system.name.to_owned(),
            doc: system.doc.to_owned(),
            nets: system.components.iter().map(net).collect(),
            links: system.links.to_vec(),
            bindings: system.bindings.to_vec(),
            clears: system.clears.to_vec(),
        }
    }
}
