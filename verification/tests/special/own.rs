//! Nets with inhibitor arcs, read arcs, reset arcs and priorities, played by a rule of their own:
//! slow, and written to be obviously right. It shares nothing with the rule of the engines, nor
//! with that of the checker of certificates.

use crate::properties::oracle::Space;
use crate::properties::random::Random;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_verification::certificate;
use cotama_verification::pt::{Extras, Pt};

/// Places by position, and tokens.
type Arcs = Vec<(usize, u32)>;

#[derive(Clone, Debug, Default)]
pub(crate) struct Move {
    pub(crate) name: String,
    pub(crate) take: Arcs,
    pub(crate) read: Arcs,
    pub(crate) give: Arcs,
    /// Fires only while the place holds fewer.
    pub(crate) inhibit: Arcs,
    pub(crate) reset: Vec<usize>,
    pub(crate) priority: u32,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Own {
    pub(crate) places: Vec<(String, u32)>,
    pub(crate) moves: Vec<Move>,
}

impl Own {
    fn is_ready(&self, marking: &[u32], at: usize) -> bool {
        let it = &self.moves[at];
        let has = |arcs: &Arcs| arcs.iter().all(|&(place, tokens)| marking[place] >= tokens);
        let inhibited = it.inhibit.iter().any(|&(place, tokens)| marking[place] >= tokens);
        has(&it.take) && has(&it.read) && !inhibited
    }

    /// The transitions that can fire.
    pub(crate) fn enabled(&self, marking: &[u32]) -> Vec<u32> {
        let ready: Vec<_> =
            (0..self.moves.len()).filter(|&it| self.is_ready(marking, it)).collect();
        let first = ready.iter().map(|&it| self.moves[it].priority).max();
        let goes = |it: &usize| Some(self.moves[*it].priority) == first;
        ready.into_iter().filter(goes).map(|it| it as u32).collect()
    }

    /// Takes, empties, gives; `None` when that is too many tokens.
    pub(crate) fn fire(&self, marking: &[u32], transition: u32) -> Option<Vec<u32>> {
        let it = &self.moves[transition as usize];
        let mut after = marking.to_vec();
        it.take.iter().for_each(|&(place, tokens)| after[place] -= tokens);
        it.reset.iter().for_each(|&place| after[place] = 0);
        for &(place, tokens) in &it.give {
            after[place] = after[place].checked_add(tokens)?;
        }
        Some(after)
    }

    /// The markings, the transitions enabled in each, and where they lead; `None` when there are
    /// more than so many.
    #[expect(clippy::type_complexity, reason = "three lists side by side")]
    pub(crate) fn explored(
        &self,
        most: usize,
    ) -> Option<(Vec<Vec<u32>>, Vec<Vec<u32>>, Vec<Vec<usize>>)> {
        let mut markings = vec![self.places.iter().map(|it| it.1).collect::<Vec<_>>()];
        let (mut enabled, mut successors) = (Vec::new(), Vec::new());
        while enabled.len() < markings.len() {
            let now = markings[enabled.len()].clone();
            let (fire, mut leads) = (self.enabled(&now), Vec::new());
            for &transition in &fire {
                let after = self.fire(&now, transition)?;
                let known = markings.iter().position(|it| *it == after);
                leads.push(known.unwrap_or(markings.len()));
                if known.is_none() {
                    markings.push(after);
                }
            }
            enabled.push(fire);
            successors.push(leads);
            if markings.len() > most {
                return None;
            }
        }
        Some((markings, enabled, successors))
    }

    /// The first so many markings that are met, of which the last ones seem dead.
    pub(crate) fn first<'n>(&self, net: &'n Pt, most: usize) -> Space<'n> {
        let mut markings = vec![self.places.iter().map(|it| it.1).collect::<Vec<_>>()];
        let (mut enabled, mut successors) = (Vec::new(), Vec::new());
        while let Some(now) = markings.get(enabled.len()).cloned() {
            let fire = self.enabled(&now);
            for &it in &fire {
                let after = self.fire(&now, it).filter(|it| !markings.contains(it));
                markings.extend(after.filter(|_| markings.len() < most));
            }
            enabled.push(fire);
            successors.push(Vec::new());
        }
        Space { net, markings, enabled, successors }
    }

    /// The same for the oracle of formulas.
    pub(crate) fn space<'n>(&self, net: &'n Pt, most: usize) -> Option<Space<'n>> {
        let (markings, enabled, successors) = self.explored(most)?;
        Some(Space { net, markings, enabled, successors })
    }

    /// The same net for the engines.
    pub(crate) fn pt(&self) -> Pt {
        let mut net = OwnedNet::new("own", "");
        let place = |at: usize| PlaceId(at as u32);
        for (name, tokens) in &self.places {
            net.place(OwnedPlace::new(name, *tokens)).unwrap();
        }
        let mut extras = Extras::default();
        for (it, id) in self.moves.iter().zip(0..) {
            let id = TransitionId(id);
            let mut transition = OwnedTransition::new(&it.name);
            for &(at, tokens) in &it.take {
                transition = transition.take(place(at), tokens);
            }
            for &(at, tokens) in &it.read {
                transition = transition.read(place(at), tokens);
            }
            for &(at, tokens) in &it.give {
                transition = transition.give(place(at), tokens);
            }
            net.transition(transition).unwrap();
            let inhibitor = |&(at, weight): &(usize, u32)| (id, Arc { place: place(at), weight });
            extras.inhibitors.extend(it.inhibit.iter().map(inhibitor));
            extras.resets.extend(it.reset.iter().map(|&at| (id, place(at))));
            extras.priorities.push(it.priority);
        }
        Pt::extended(&net.view().net(), &extras)
    }
}

/// Reads the net of a certificate.
impl From<&certificate::Net> for Own {
    fn from(net: &certificate::Net) -> Self {
        let place = |name: &String| net.places.iter().position(|it| it.0 == *name).unwrap();
        let arcs =
            |list: &[(String, u32)]| list.iter().map(|it| (place(&it.0), it.1)).collect::<Arcs>();
        let moves = net.transitions.iter().map(|it| Move {
            name: it.name.clone(),
            take: arcs(&it.take),
            read: Vec::new(),
            give: arcs(&it.give),
            inhibit: arcs(&it.inhibit),
            reset: it.reset.iter().map(place).collect(),
            priority: it.priority,
        });
        Self { places: net.places.clone(), moves: moves.collect() }
    }
}

/// A net with some of everything.
pub(crate) fn any(random: &mut Random) -> Own {
    let count = 2 + random.below(4);
    let places = (0..count).map(|at| (format!("p{at}"), random.below(3) as u32)).collect();
    let has_priorities = random.below(5) == 0;
    let some = |random: &mut Random, most: usize, weight: usize| {
        let mut left: Vec<usize> = (0..count).collect();
        let arc = |_| {
            let place = left.swap_remove(random.below(left.len()));
            (place, 1 + random.below(weight) as u32)
        };
        (0..most.min(count)).map(arc).collect::<Arcs>()
    };
    let one = |random: &mut Random, at: usize| {
        let mut it = Move { name: format!("t{at}"), ..Move::default() };
        let [takes, gives] = [random.below(3), random.below(3)];
        let [heavy, strong] = [1 + usize::from(random.below(4) == 0), 1 + random.below(3)];
        it.take = some(random, takes, heavy);
        it.give = some(random, gives, heavy);
        if random.below(4) == 0 {
            it.read = some(random, 1, heavy);
            it.read.retain(|arc| it.take.iter().all(|take| take.0 != arc.0));
        }
        if random.below(2) == 0 {
            let inhibits = 1 + usize::from(random.below(4) == 0);
            it.inhibit = some(random, inhibits, strong);
        }
        if random.below(4) == 0 {
            it.reset = some(random, 1, 1).iter().map(|it| it.0).collect();
        }
        if has_priorities {
            it.priority = random.below(3) as u32;
        }
        it
    };
    let transitions = 2 + random.below(4);
    let moves = (0..transitions).map(|at| one(random, at)).collect();
    Own { places, moves }
}
