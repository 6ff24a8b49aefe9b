//! Small random nets and formulas; the same on every run.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_fuzz::split_mix;
use cotama_verification::property::{Atom, Formula, Linear};
use cotama_verification::pt::Pt;

/// The generator `SplitMix64`.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    pub(crate) fn choose<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }
}

/// Names that are hard to write.
pub(crate) const NAMES: [&str; 8] = ["p", "a b", "E", "say \"x\\y\"", "{é}", "", "x.y'", "7\u{1b}"];

/// A net with 2 to 4 places and as many transitions, none of which makes tokens more.
pub(crate) fn net(random: &mut Random) -> Pt {
    let mut net = OwnedNet::new("random", "");
    let places = 2 + random.below(3);
    let places: Vec<_> = (0..places)
        .map(|at| net.place(OwnedPlace::new(&format!("p{at}"), random.below(3) as u32)).unwrap())
        .collect();
    for at in 0..2 + random.below(3) {
        let mut transition = OwnedTransition::new(&format!("t{at}"));
        let mut from = places.clone();
        let mut to = places.clone();
        let takes = 1 + random.below(2);
        for _ in 0..takes {
            let place = from.swap_remove(random.below(from.len()));
            transition = transition.take(place, 1);
        }
        for _ in 0..random.below(takes + 1).max(usize::from(random.below(3) > 0)) {
            transition = transition.give(to.swap_remove(random.below(to.len())), 1);
        }
        if !from.is_empty() && random.below(4) == 0 {
            transition = transition.read(*random.choose(&from), 1);
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}

pub(crate) fn atom(random: &mut Random, net: &Pt) -> Formula {
    Formula::Atom(match random.below(8) {
        0 => Atom::Deadlock,
        1 | 2 => {
            let count = 1 + random.below(2);
            let transition =
                |random: &mut Random| TransitionId(random.below(net.transitions.len()) as u32);
            Atom::Fireable((0..count).map(|_| transition(random)).collect())
        }
        3 | 4 => Atom::AtMost(Linear::marked(PlaceId(random.below(net.places.len()) as u32))),
        _ => {
            let weights = (0..net.places.len() as u32)
                .map(|place| (PlaceId(place), i64::try_from(random.below(7)).unwrap() - 3));
            let weights = weights.filter(|&(_, weight)| weight != 0).collect();
            Atom::AtMost(Linear { constant: i64::try_from(random.below(9)).unwrap() - 4, weights })
        }
    })
}

/// A formula about one marking.
pub(crate) fn state(random: &mut Random, net: &Pt, depth: usize) -> Formula {
    boolean(random, net, depth, &|random, depth| state(random, net, depth))
        .unwrap_or_else(|| atom(random, net))
}

fn boolean(
    random: &mut Random,
    net: &Pt,
    depth: usize,
    part: &dyn Fn(&mut Random, usize) -> Formula,
) -> Option<Formula> {
    if depth == 0 {
        return Some(if random.below(8) == 0 {
            random.choose(&[Formula::TRUE, Formula::FALSE]).clone()
        } else {
            atom(random, net)
        });
    }
    let several =
        |random: &mut Random| (0..2 + random.below(2)).map(|_| part(random, depth - 1)).collect();
    match random.below(8) {
        0 => Some(Formula::Not(part(random, depth - 1).into())),
        1 => Some(Formula::And(several(random))),
        2 => Some(Formula::Or(several(random))),
        3 => Some(atom(random, net)),
        _ => None,
    }
}

/// A formula that needs no run.
pub(crate) fn branching(random: &mut Random, net: &Pt, depth: usize) -> Formula {
    let part = |random: &mut Random, depth| branching(random, net, depth);
    boolean(random, net, depth, &part).unwrap_or_else(|| {
        let path = temporal(random, depth, &part);
        quantified(random, path)
    })
}

/// A formula about a run, with quantifiers inside of it or not.
pub(crate) fn path(random: &mut Random, net: &Pt, depth: usize, quantifiers: bool) -> Formula {
    let part = |random: &mut Random, depth| path(random, net, depth, quantifiers);
    boolean(random, net, depth, &part).unwrap_or_else(|| {
        if quantifiers && random.below(3) == 0 {
            let inner = part(random, depth - 1);
            return quantified(random, inner);
        }
        temporal(random, depth, &part)
    })
}

fn temporal(
    random: &mut Random,
    depth: usize,
    part: &dyn Fn(&mut Random, usize) -> Formula,
) -> Formula {
    let first = part(random, depth - 1);
    match random.below(5) {
        0 => Formula::Next(first.into()),
        1 => Formula::Finally(first.into()),
        2 => Formula::Globally(first.into()),
        _ => Formula::Until(first.into(), part(random, depth - 1).into()),
    }
}

pub(crate) fn quantified(random: &mut Random, path: Formula) -> Formula {
    if random.below(2) == 0 { Formula::Exists(path.into()) } else { Formula::All(path.into()) }
}
