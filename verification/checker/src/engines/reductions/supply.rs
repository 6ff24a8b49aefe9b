//! Tokens that can be had when they are needed.

use super::lift::{LiftError, MAX_LENGTH};
use cotama_property::pt::Lists;
use std::collections::{BTreeMap, VecDeque};

/// A net in which some places are filled on demand.
#[derive(Clone, Debug)]
pub(super) struct Supply {
    initial: Vec<u32>,
    needs: Lists<u32>,
    effects: Lists<i64>,
    /// For each place that is filled the transitions that fill it, and from where they move a token
    /// if from somewhere.
    pub(super) fills: BTreeMap<u32, Vec<(u32, Option<u32>)>>,
}

impl Supply {
    pub(super) fn new(initial: Vec<u32>, needs: Lists<u32>, effects: Lists<i64>) -> Self {
        Self { initial, needs, effects, fills: BTreeMap::new() }
    }

    /// A run with what must fire in between.
    pub(super) fn supplied(&self, run: &[u32]) -> Result<Vec<u32>, LiftError> {
        let (mut marking, mut all) = (self.initial.clone(), Vec::new());
        for &transition in run {
            if transition as usize >= self.needs.len() {
                return Err(LiftError::NotARun);
            }
            for &(place, need) in self.needs.of(transition) {
                while marking[place as usize] < need {
                    for filler in
                        self.path(&marking, transition, place).ok_or(LiftError::NotARun)?
                    {
                        self.fire(&mut marking, filler, &mut all)?;
                    }
                }
            }
            self.fire(&mut marking, transition, &mut all)?;
        }
        Ok(all)
    }

    fn fire(
        &self,
        marking: &mut [u32],
        transition: u32,
        all: &mut Vec<u32>,
    ) -> Result<(), LiftError> {
        for &(place, by) in self.effects.of(transition) {
            let tokens = &mut marking[place as usize];
            *tokens = u32::try_from(i64::from(*tokens) + by).map_err(|_| LiftError::NotARun)?;
        }
        if all.len() == MAX_LENGTH {
            return Err(LiftError::TooLong);
        }
        all.push(transition);
        Ok(())
    }

    /// The shortest path to get a token to a place that `user` does not itself need elsewhere.
    fn path(&self, marking: &[u32], user: u32, place: u32) -> Option<Vec<u32>> {
        let spare = |at: u32| {
            let needs = self.needs.of(user);
            let need = needs.binary_search_by_key(&at, |it| it.0).map_or(0, |at| needs[at].1);
            marking[at as usize] > need
        };
        let mut next = BTreeMap::from([(place, None)]);
        let mut queue = VecDeque::from([place]);
        let path = |next: &BTreeMap<u32, Option<(u32, u32)>>, mut at: u32, mut all: Vec<u32>| {
            while let Some(&Some((filler, to))) = next.get(&at) {
                all.push(filler);
                at = to;
            }
            Some(all)
        };
        while let Some(at) = queue.pop_front() {
            if at != place && spare(at) {
                return path(&next, at, Vec::new());
            }
            for &(filler, from) in self.fills.get(&at)? {
                match from {
                    None => return path(&next, at, vec![filler]),
                    Some(from) if !next.contains_key(&from) => {
                        next.insert(from, Some((filler, at)));
                        queue.push_back(from);
                    }
                    Some(_) => {}
                }
            }
        }
        None
    }
}
