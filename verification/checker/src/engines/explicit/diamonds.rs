//! Firings that may be left out of a search, because the same firings in another order lead to the
//! same marking.
//!
//! Let `m` follow `p` by `u`, and let `t` be enabled in both, and `u` after `t`. Then `t` from `m`
//! leads where `u` leads from the marking that follows `p` by `t`. When `t` comes after `u` in the
//! net, `t` may be left out in `m`: the other marking is at most as far from the start, and what it
//! is left out for there has a smaller number, and so on, which ends. So every level of a breadth
//! first search has the same markings as without this. These are the sleep sets of P. Godefroid,
//! *Using partial orders to improve automatic verification methods*, CAV 1990, for one firing back.

use cotama_property::pt::Pt;

/// The most words of all sets; nothing is left out in larger nets.
const MOST: usize = 1 << 19;

/// For each transition those that may be left out in a marking that it leads to.
#[derive(Debug)]
pub(super) struct Diamonds {
    words: usize,
    sets: Vec<u64>,
}

impl Diamonds {
    /// Stands for the transition into a marking that no transition leads to.
    pub(super) const NONE: u32 = u32::MAX;

    pub(super) fn new(pt: &Pt) -> Self {
        let transitions = pt.transitions.len();
        let words = transitions.div_ceil(64);
        let mut sets = Vec::new();
        // A token more, or less, can keep others from firing as well.
        let some = pt.is_plain() && transitions * words <= MOST;
        for via in (0..transitions as u32).take_while(|_| some) {
            let start = sets.len();
            sets.resize(start + words, 0);
            let set = &mut sets[start..];
            for later in via + 1..transitions as u32 {
                set[later as usize / 64] |= 1 << (later % 64);
            }
            // A transition that needs the given tokens may not have been enabled before; one that
            // takes tokens that this one needs may disable it.
            let given = pt.effects.of(via).iter().filter(|it| it.1 > 0);
            let needing = given.flat_map(|it| pt.consumers.of(it.0)).map(|it| it.0);
            let changers = pt.needs.of(via).iter().flat_map(|it| pt.changers.of(it.0));
            for other in needing.chain(changers.filter(|it| it.1 < 0).map(|it| it.0)) {
                set[other as usize / 64] &= !(1 << (other % 64));
            }
        }
        // One set more, an empty one, for other numbers.
        sets.resize(sets.len() + words, 0);
        Self { words, sets }
    }

    /// A bit for each transition that may be left out in a marking that was first met by this one.
    #[inline]
    pub(super) fn of(&self, via: u32) -> &[u64] {
        let start = (via as usize).saturating_mul(self.words).min(self.sets.len() - self.words);
        &self.sets[start..start + self.words]
    }
}

#[cfg(test)]
mod tests {
    use super::Diamonds;
    use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
    use cotama_property::pt::Pt;

    #[test]
    fn of_two_independent_firings_the_later_one_is_left_out_after_the_first() {
        let mut net = OwnedNet::new("net", "");
        let [p, q, r] = ["p", "q", "r"].map(|it| net.place(OwnedPlace::new(it, 1)).unwrap());
        net.transition(OwnedTransition::new("move").take(p, 1).give(q, 1)).unwrap();
        net.transition(OwnedTransition::new("apart").take(r, 1)).unwrap();
        net.transition(OwnedTransition::new("follow").take(q, 1)).unwrap();
        net.transition(OwnedTransition::new("compete").take(p, 1)).unwrap();
        net.transition(OwnedTransition::new("read").read(p, 1)).unwrap();
        let diamonds = Diamonds::new(&Pt::from(&net.view().net()));
        let sets = [0, 1, 2, 3, 4, Diamonds::NONE].map(|it| diamonds.of(it)[0]);
        // Each digit is a transition, the first one on the right.
        assert_eq!(sets, [0b1_0010, 0b1_1100, 0b1_1000, 0b1_0000, 0, 0]);
    }
}
