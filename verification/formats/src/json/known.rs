//! What names of two parts mean in a system: `NET.PART`.

use super::name::{Misnamed, Name, meant};
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{EventId, OutputId, PlaceId};
use cotama_core::system::Of;
use std::collections::BTreeMap;

/// The numbers of the names of a list.
type Numbers<'n> = BTreeMap<&'n str, u32>;

/// A kind of what a net has.
#[derive(Clone, Copy)]
enum Kind {
    Place,
    Event,
    Output,
}

/// Finds what a name of two parts means.
pub(super) struct Known<'n> {
    nets: Numbers<'n>,
    /// Places, events and outputs of each net.
    parts: Vec<[Numbers<'n>; 3]>,
}

impl<'n> Known<'n> {
    pub(super) fn of(nets: &'n [(String, OwnedNet)]) -> Self {
        let parts = |net: &'n OwnedNet| {
            let places = net.places.iter().map(|it| it.name.as_str());
            let events = net.events.iter().map(|it| it.name.as_str());
            let outputs = net.outputs.iter().map(|it| it.name.as_str());
            [places.zip(0..).collect(), events.zip(0..).collect(), outputs.zip(0..).collect()]
        };
        Self {
            nets: nets.iter().map(|it| it.0.as_str()).zip(0..).collect(),
            parts: nets.iter().map(|it| parts(&it.1)).collect(),
        }
    }

    fn parts(&self, component: u32, kind: Kind) -> Option<&Numbers<'n>> {
        self.parts.get(component as usize).map(|it| &it[kind as usize])
    }

    fn find(&self, name: &Name, kind: Kind) -> Result<Of<u32>, Misnamed> {
        let word = ["place", "event", "output"][kind as usize];
        let it = name.as_str();
        let splits = it.match_indices('.').map(|(dot, _)| (&it[..dot], &it[dot + 1..]));
        let in_nets = splits.filter_map(|(net, part)| Some((net, *self.nets.get(net)?, part)));
        let in_nets: Vec<_> = in_nets.collect();
        let found = in_nets.iter().filter_map(|&(_, component, part)| {
            let id = *self.parts(component, kind)?.get(part)?;
            Some(Of { component: component as u16, id })
        });
        let found: Vec<_> = found.collect();
        match (found[..].first(), in_nets.first()) {
            (Some(it), _) if found.len() == 1 => Ok(*it),
            (Some(_), _) => {
                let message = format!("`{it}` means more than one {word}: names have dots");
                Err(Misnamed::new(name, message).help("give a net another name"))
            }
            (None, Some(&(net, component, part))) => {
                let known = self.parts(component, kind).into_iter().flatten();
                let error = Misnamed::new(name, format!("the net `{net}` has no {word} `{part}`"));
                Err(match meant(part, known.map(|it| *it.0)) {
                    Some(near) => error.help(near),
                    None => error,
                })
            }
            (None, None) => {
                let Some((net, _)) = it.split_once('.') else {
                    let message = format!("`{it}` is no {word} of a net");
                    return Err(Misnamed::new(name, message).help(format!("write `NET.{word}`")));
                };
                let error = Misnamed::new(name, format!("the system has no net `{net}`"));
                Err(match meant(net, self.nets.keys().copied()) {
                    Some(near) => error.help(near),
                    None => error,
                })
            }
        }
    }

    pub(super) fn output(&self, name: &Name) -> Result<Of<OutputId>, Misnamed> {
        self.find(name, Kind::Output).map(|it| Of { component: it.component, id: OutputId(it.id) })
    }

    pub(super) fn event(&self, name: &Name) -> Result<Of<EventId>, Misnamed> {
        self.find(name, Kind::Event).map(|it| Of { component: it.component, id: EventId(it.id) })
    }

    pub(super) fn place(&self, name: &Name) -> Result<Of<PlaceId>, Misnamed> {
        self.find(name, Kind::Place).map(|it| Of { component: it.component, id: PlaceId(it.id) })
    }
}
