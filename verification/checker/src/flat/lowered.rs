//! Ways through a round as transitions with arcs: what is held at most is held at least by a
//! complement.

use super::FlatError;
use super::rounds::Rounds;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Place, PlaceId, Role};
use std::collections::{BTreeMap, BTreeSet};

impl Rounds {
    /// The net. Its places are those of [`flat`](super::flat()), then those of the round, of
    /// observers, and complements.
    ///
    /// # Errors
    /// When the absence of tokens in a place without a bound decides.
    pub fn net(&self) -> Result<OwnedNet, FlatError> {
        let (mut net, mut absent) = (self.draft.clone(), self.absent.clone());
        let bound = |place: PlaceId| self.draft.places[place.0 as usize].bound;
        for place in self.wanted() {
            let of = &self.draft.places[place.0 as usize];
            if of.bound == Place::UNBOUNDED {
                return Err(FlatError::Unbounded { place: of.name.clone() });
            }
            let role = Role::Complement(place);
            let (name, doc) = (format!("{}.absent", of.name), of.doc.clone());
            let initial = of.bound - of.initial;
            net.places.push(OwnedPlace { name, doc, initial, bound: of.bound, role });
            absent.insert(place, PlaceId(net.places.len() as u32 - 1));
        }
        let mut names: BTreeMap<&str, u32> = BTreeMap::new();
        for path in &self.paths {
            let (mut needs, mut changes) = (BTreeMap::new(), BTreeMap::new());
            for (&place, &(low, high)) in &path.held {
                needs.insert(place, low);
                if let Some(&absent) = absent.get(&place) {
                    needs.insert(absent, i64::from(bound(place)) - high);
                }
            }
            for (&place, &change) in &path.change {
                changes.insert(place, change);
                if let Some(&absent) = absent.get(&place) {
                    changes.insert(absent, -change);
                }
            }
            let count = names.entry(&path.name).and_modify(|it| *it += 1).or_insert(1);
            let name =
                if *count == 1 { path.name.clone() } else { format!("{} #{count}", path.name) };
            let mut it = OwnedTransition::new(&name).doc(&path.doc);
            (it.on, it.emits) = (path.on, path.emits.clone());
            let it = with_arcs(it, &needs, &changes);
            net.transition(it).map_err(|_| FlatError::TooMany)?;
        }
        Ok(net)
    }

    /// The places that need a complement which is not there, in the order of the complements.
    pub(super) fn wanted(&self) -> BTreeSet<PlaceId> {
        let held = self.paths.iter().flat_map(|it| &it.held);
        let from_above = held.filter(|it| it.1.1 < self.known.bound(*it.0)).map(|it| *it.0);
        from_above.filter(|it| !self.absent.contains_key(it)).collect()
    }
}

fn with_arcs(
    mut it: OwnedTransition,
    needs: &BTreeMap<PlaceId, i64>,
    changes: &BTreeMap<PlaceId, i64>,
) -> OwnedTransition {
    let places: BTreeSet<PlaceId> = needs.keys().chain(changes.keys()).copied().collect();
    let weight = |tokens: i64| u32::try_from(tokens).unwrap_or(u32::MAX);
    for place in places {
        let change = changes.get(&place).copied().unwrap_or(0);
        let need = needs.get(&place).copied().unwrap_or(0).max(-change);
        if change == 0 && need > 0 {
            it = it.read(place, weight(need));
            continue;
        }
        if need > 0 {
            it = it.take(place, weight(need));
        }
        if need + change > 0 {
            it = it.give(place, weight(need + change));
        }
    }
    it
}
