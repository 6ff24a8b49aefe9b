//! Inhibitor arcs, reset arcs and priorities: the firing rule beyond that of a place/transition
//! net.
//!
//! A transition is enabled when its places hold what it needs, each inhibiting place holds fewer
//! tokens than the weight of its arc, and no transition of a higher priority has both. All of that
//! is asked of the marking before the firing. Firing then takes, empties the places of reset arcs,
//! and gives, in this order: a place that is emptied and given to holds what was given.
//!
//! The rule is that of C. Dufourd, A. Finkel, Ph. Schnoebelen, *Reset nets between decidability and
//! undecidability*, ICALP 1998, for reset arcs, and of M. Ajmone Marsan et al., *Modelling with
//! generalized stochastic Petri nets*, 1995, for inhibitor arcs and priorities.

use super::lists::Lists;
use cotama_core::net::{Arc, PlaceId, TransitionId};

/// Arcs and priorities beyond taking, reading and giving, as a file says them.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_core::net::{Arc, TransitionId};
/// use cotama_verification::pt::{Extras, Pt};
///
/// let mut net = OwnedNet::new("gate", "");
/// let idle = net.place(OwnedPlace::new("idle", 1)).unwrap();
/// let human = net.place(OwnedPlace::new("human", 1)).unwrap();
/// net.transition(OwnedTransition::new("drive").take(idle, 1)).unwrap();
/// net.transition(OwnedTransition::new("leave").take(human, 1)).unwrap();
/// let nobody = (TransitionId(0), Arc { place: human, weight: 1 });
/// let extras = Extras { inhibitors: vec![nobody], ..Extras::default() };
/// let gate = Pt::extended(&net.view().net(), &extras);
/// assert!(!gate.enabled(&gate.initial, 0));
/// assert!(gate.enabled(&gate.fire(&gate.initial, 1).unwrap(), 0));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Extras {
    /// Inhibitor arcs: the transition is enabled only while the place holds fewer tokens than the
    /// weight.
    pub inhibitors: Vec<(TransitionId, Arc)>,
    /// Reset arcs: firing empties the place.
    pub resets: Vec<(TransitionId, PlaceId)>,
    /// For each transition its priority, the larger the sooner; empty when no file says one.
    pub priorities: Vec<u32>,
}

impl Extras {
    /// Whether the net is a place/transition net.
    pub fn is_empty(&self) -> bool {
        self.inhibitors.is_empty() && self.resets.is_empty() && !self.has_priorities()
    }

    fn has_priorities(&self) -> bool {
        self.priorities.windows(2).any(|it| it[0] != it[1])
    }

    /// Names them in words, such as `inhibitor arcs and priorities`.
    pub fn named(&self) -> String {
        let all = [
            (!self.inhibitors.is_empty(), "inhibitor arcs"),
            (!self.resets.is_empty(), "reset arcs"),
            (self.has_priorities(), "priorities"),
        ];
        let all: Vec<_> = all.into_iter().filter(|it| it.0).map(|it| it.1).collect();
        match all.as_slice() {
            [] => "nothing".to_owned(),
            [one] => (*one).to_owned(),
            [some @ .., last] => format!("{} and {last}", some.join(", ")),
        }
    }
}

/// The same, ready to be asked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Special {
    /// For each transition the places that keep it from firing, and how many tokens do.
    inhibits: Lists<u32>,
    /// For each transition the places that it empties, and the tokens that it then gives there.
    resets: Lists<u32>,
    /// For each transition its priority; empty when all are equal.
    priorities: Vec<u32>,
    /// Transitions with inhibitor arcs.
    inhibited: Vec<u32>,
    /// For each priority, the highest first, a bit for each of its transitions.
    levels: Vec<Vec<u64>>,
}

impl Special {
    /// Prepares them for a net of so many transitions; `given` tells how many tokens one gives to
    /// a place.
    pub fn new(extras: &Extras, transitions: usize, given: impl Fn(u32, u32) -> u32) -> Self {
        let mut inhibits = vec![Vec::new(); transitions];
        for &(transition, Arc { place, weight }) in &extras.inhibitors {
            inhibits[transition.0 as usize].push((place.0, weight));
        }
        let mut resets = vec![Vec::new(); transitions];
        for &(transition, place) in &extras.resets {
            resets[transition.0 as usize].push((place.0, given(transition.0, place.0)));
        }
        for list in inhibits.iter_mut().chain(&mut resets) {
            // The smaller weight of two arcs from one place decides.
            list.sort_unstable();
            list.dedup_by_key(|it| it.0);
        }
        let priorities =
            if extras.has_priorities() { extras.priorities.clone() } else { Vec::new() };
        let inhibited = (0..transitions as u32).filter(|it| !inhibits[*it as usize].is_empty());
        let inhibited = inhibited.collect();
        let mut all = priorities.clone();
        all.sort_unstable_by(|a, b| b.cmp(a));
        all.dedup();
        let level = |of: u32| {
            let mut bits = vec![0; transitions.div_ceil(64)];
            for (transition, _) in priorities.iter().enumerate().filter(|it| *it.1 == of) {
                bits[transition / 64] |= 1_u64 << (transition % 64);
            }
            bits
        };
        let levels = all.into_iter().map(level).collect();
        let (inhibits, resets) = (Lists::new(inhibits), Lists::new(resets));
        Self { inhibits, resets, priorities, inhibited, levels }
    }

    /// The places that keep a transition from firing, and how many tokens do.
    #[inline]
    pub fn inhibits(&self, transition: u32) -> &[(u32, u32)] {
        self.inhibits.of(transition)
    }

    /// The places that a transition empties, and the tokens that it then gives there.
    #[inline]
    pub fn resets(&self, transition: u32) -> &[(u32, u32)] {
        self.resets.of(transition)
    }

    /// The priority of a transition.
    #[inline]
    pub fn priority(&self, transition: u32) -> u32 {
        self.priorities.get(transition as usize).copied().unwrap_or(0)
    }

    /// Whether a firing of some transition empties a place.
    pub fn has_resets(&self) -> bool {
        (0..self.resets.len() as u32).any(|it| !self.resets.of(it).is_empty())
    }

    /// Returns the same without priorities.
    #[must_use]
    pub fn without_priorities(&self) -> Self {
        Self { priorities: Vec::new(), levels: Vec::new(), ..self.clone() }
    }

    /// Whether nothing is special.
    pub fn is_empty(&self) -> bool {
        self.inhibited.is_empty() && !self.has_resets() && !self.has_priorities()
    }

    /// Whether transitions differ in priority.
    pub fn has_priorities(&self) -> bool {
        !self.priorities.is_empty()
    }

    /// Whether no place keeps a transition from firing.
    pub fn is_free(&self, transition: u32, tokens: &impl Fn(u32) -> u64) -> bool {
        self.inhibits.of(transition).iter().all(|&(place, below)| tokens(place) < below.into())
    }

    /// Transitions that go before this one.
    pub fn before(&self, transition: u32) -> impl Iterator<Item = u32> + '_ {
        let own = self.priority(transition);
        (0..).zip(&self.priorities).filter(move |it| *it.1 > own).map(|it| it.0)
    }

    /// Leaves the enabled ones of transitions that have what they need, a bit for each.
    pub fn restrict(&self, ready: &mut [u64], tokens: &impl Fn(u32) -> u64) {
        for &transition in &self.inhibited {
            let (word, bit) = (transition as usize / 64, 1 << (transition % 64));
            if ready[word] & bit != 0 && !self.is_free(transition, tokens) {
                ready[word] &= !bit;
            }
        }
        let is_ready = |it: &&Vec<u64>| it.iter().zip(&*ready).any(|(it, ready)| it & ready != 0);
        if let Some(level) = self.levels.iter().find(is_ready) {
            ready.iter_mut().zip(level).for_each(|(ready, it)| *ready &= it);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Extras, Special};
    use cotama_core::net::{Arc, PlaceId, TransitionId};

    const fn inhibitor(transition: u32, place: u32, weight: u32) -> (TransitionId, Arc) {
        (TransitionId(transition), Arc { place: PlaceId(place), weight })
    }

    fn left(special: &Special, ready: u64, marking: &[u64]) -> u64 {
        let mut ready = [ready];
        special.restrict(&mut ready, &|place| marking[place as usize]);
        ready[0]
    }

    #[test]
    fn an_inhibitor_arc_forbids_its_transition_from_its_weight_on() {
        let extras = Extras { inhibitors: vec![inhibitor(1, 0, 2)], ..Extras::default() };
        let special = Special::new(&extras, 3, |_, _| 0);
        for (tokens, enabled) in [(0, 0b111), (1, 0b111), (2, 0b101), (3, 0b101)] {
            assert_eq!(left(&special, 0b111, &[tokens]), enabled, "{tokens} tokens");
        }
    }

    #[test]
    fn of_two_inhibitor_arcs_from_one_place_the_smaller_weight_decides() {
        let inhibitors = vec![inhibitor(0, 0, 3), inhibitor(0, 0, 2)];
        let special = Special::new(&Extras { inhibitors, ..Extras::default() }, 1, |_, _| 0);
        assert_eq!([1, 2, 3].map(|it| left(&special, 1, &[it])), [1, 0, 0]);
    }

    #[test]
    fn a_transition_that_is_inhibited_keeps_no_other_one_from_firing() {
        let inhibitors = vec![inhibitor(0, 0, 1)];
        let extras = Extras { inhibitors, priorities: vec![2, 1, 1], ..Extras::default() };
        let special = Special::new(&extras, 3, |_, _| 0);
        assert_eq!([0, 1].map(|it| left(&special, 0b111, &[it])), [0b001, 0b110]);
        assert_eq!(left(&special, 0b100, &[0]), 0b100);
        assert_eq!(special.before(1).collect::<Vec<_>>(), [0]);
    }

    #[test]
    fn equal_priorities_are_none() {
        let extras = Extras { priorities: vec![4, 4], ..Extras::default() };
        assert!(extras.is_empty());
        assert_eq!(extras.named(), "nothing");
        let extras = Extras { priorities: vec![4, 3], resets: vec![], inhibitors: vec![] };
        assert_eq!(extras.named(), "priorities");
    }
}
