//! Other sets of states than bit vectors: the labels of CTL do not ask what a set is.

use crate::properties::oracle::Space;
use crate::properties::random::{Random, branching, net};
use cotama_checker::temporal::{Labelling, StateSets};
use cotama_verification::explicit::{Goal, Graph, Limit, Limits};
use cotama_verification::property::{Ctl, Formula};
use std::collections::BTreeSet;

/// Sets as lists in order, and fixed points by the book.
struct Lists<'g>(&'g Graph);

type Set = BTreeSet<u32>;

impl Lists<'_> {
    fn states(&self, which: impl Fn(u32) -> bool) -> Set {
        (0..self.0.states() as u32).filter(|it| which(*it)).collect()
    }

    fn leads_to(&self, state: u32, set: &Set) -> bool {
        self.0.successors(state).iter().any(|it| set.contains(it))
    }
}

impl StateSets for Lists<'_> {
    type Set = Set;
    type Ranks = ();

    fn all(&mut self, is_full: bool) -> Result<Set, Limit> {
        Ok(self.states(|_| is_full))
    }

    fn satisfying(&mut self, formula: &Formula) -> Result<Set, Limit> {
        let holds = self.0.satisfying(Goal::new(formula).unwrap(), 1);
        Ok(self.states(|it| holds.has(it)))
    }

    fn complement(&mut self, set: &Set) -> Result<Set, Limit> {
        Ok(self.states(|it| !set.contains(&it)))
    }

    fn and(&mut self, set: &mut Set, other: &Set) {
        set.retain(|it| other.contains(it));
    }

    fn or(&mut self, set: &mut Set, other: &Set) {
        set.extend(other);
    }

    fn before(&mut self, set: &Set) -> Result<Set, Limit> {
        Ok(self.states(|it| self.leads_to(it, set)))
    }

    fn until(&mut self, through: &Set, goal: &Set) -> Result<(Set, ()), Limit> {
        let mut holds = goal.clone();
        loop {
            let more = self.states(|it| through.contains(&it) && self.leads_to(it, &holds));
            let met = holds.len();
            holds.extend(more);
            if holds.len() == met {
                return Ok((holds, ()));
            }
        }
    }

    fn always(&mut self, region: &Set) -> Result<Set, Limit> {
        let mut holds = region.clone();
        loop {
            let ends = |it: u32| self.0.successors(it).is_empty();
            let stay = self.states(|it| ends(it) || self.leads_to(it, &holds));
            let met = holds.len();
            self.and(&mut holds, &stay);
            if holds.len() == met {
                return Ok(holds);
            }
        }
    }

    fn has_first(&self, set: &Set) -> bool {
        set.contains(&0)
    }

    fn is_empty(&self, set: &Set) -> bool {
        set.is_empty()
    }
}

#[test]
fn lists_of_states_give_the_verdicts_of_the_oracle() {
    let (mut random, mut compared, mut hold) = (Random(23), 0, 0);
    while compared < 500 {
        let pt = net(&mut random);
        let space = Space::new(&pt);
        let said = branching(&mut random, &pt, 3);
        if space.markings.len() > 40 || said.is_state() {
            continue;
        }
        compared += 1;
        let graph = Graph::new(&pt, &Limits::default(), &|_| ()).unwrap();
        let formula = Ctl::new(&said).unwrap();
        let found = Labelling::new(Lists(&graph), &formula).holds(formula.root()).unwrap();
        assert_eq!(found, space.satisfying(&said)[0], "{} on {pt:?}", said.display(&pt));
        hold += u32::from(found);
    }
    assert!((100..400).contains(&hold), "{hold}");
}
