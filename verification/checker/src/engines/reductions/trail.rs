//! From a reduced net back to the original one.

use super::lift::{LiftError, MAX_LENGTH};
use super::supply::Supply;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::pt::Pt;
use std::collections::BTreeMap;

/// `constant + sum of weight * tokens`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tokens {
    /// Constant added to the weighted sum.
    pub constant: i64,
    /// Weights of places, sorted by place, each once, none zero.
    pub weights: Vec<(PlaceId, i64)>,
}

impl Tokens {
    /// How many tokens these are; `None` beyond 64 bits, and when the marking is too short.
    pub fn of(&self, marking: &[u32]) -> Option<i64> {
        self.weights.iter().try_fold(self.constant, |sum, &(place, weight)| {
            sum.checked_add(weight.checked_mul((*marking.get(place.0 as usize)?).into())?)
        })
    }
}

/// How a reduced net came to be, to go back from it.
#[derive(Clone, Debug)]
pub struct Trail {
    pub(super) layers: Vec<Layer>,
    pub(super) values: Vec<Option<Tokens>>,
}

/// The firings that a transition stands for.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A transition of the layer below.
    Below(u32),
    /// These, one after the other, each so many times.
    Steps([(u32, u32); 2]),
}

/// Rules after one another that put runs together from those below.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) steps: Vec<Step>,
    /// The steps of the transitions at the top.
    pub(super) roots: Vec<u32>,
    /// The steps that fire before anything else, each so many times.
    pub(super) start: Vec<(u32, u32)>,
    /// The transitions that fire in the end as long as they can, the last ones first.
    pub(super) rests: Vec<Vec<u32>>,
    /// The net that fires in between where tokens are missing below.
    pub(super) supply: Option<Supply>,
}

impl Layer {
    pub(super) fn new(transitions: usize, supply: Option<Supply>) -> Self {
        let steps = (0..transitions as u32).map(Step::Below).collect();
        Self { steps, roots: Vec::new(), start: Vec::new(), rests: Vec::new(), supply }
    }

    /// Appends what a step stands for.
    fn expand(&self, step: u32, times: u32, run: &mut Vec<u32>) -> Result<(), LiftError> {
        let mut stack = vec![(step, times)];
        while let Some((step, times)) = stack.pop() {
            if times == 0 {
                continue;
            }
            match self.steps.get(step as usize).ok_or(LiftError::NotARun)? {
                Step::Below(transition) => {
                    if run.len() + times as usize > MAX_LENGTH {
                        return Err(LiftError::TooLong);
                    }
                    run.extend(std::iter::repeat_n(*transition, times as usize));
                }
                Step::Steps([first, second]) => {
                    stack.push((step, times - 1));
                    stack.push(*second);
                    stack.push(*first);
                }
            }
        }
        Ok(())
    }
}

impl Trail {
    /// The most firings of a lifted run.
    pub const MAX_LENGTH: usize = MAX_LENGTH;

    /// The tokens of a place of the original net, told from the places of the reduced one; `None`
    /// when they cannot be. They can for every place that was to be kept visible.
    pub fn place(&self, place: PlaceId) -> Option<&Tokens> {
        self.values.get(place.0 as usize)?.as_ref()
    }

    /// A sum over places of the original net as one over places of the reduced one; `None` when it
    /// cannot be told, or beyond 64 bits.
    pub fn tokens(&self, sum: &Tokens) -> Option<Tokens> {
        let mut constant = sum.constant;
        let mut weights = BTreeMap::new();
        for &(place, weight) in &sum.weights {
            let value = self.place(place)?;
            constant = constant.checked_add(weight.checked_mul(value.constant)?)?;
            for &(place, factor) in &value.weights {
                let all: &mut i64 = weights.entry(place).or_insert(0);
                *all = all.checked_add(weight.checked_mul(factor)?)?;
            }
        }
        Some(Tokens { constant, weights: weights.into_iter().filter(|it| it.1 != 0).collect() })
    }

    /// The run of the original net for one of the reduced net, from its start. The visible places
    /// hold the same in the end, and where the one is dead in the end, so is the other.
    ///
    /// # Errors
    ///
    /// When it is no run of the reduced net, or becomes too long.
    pub fn lift(
        &self,
        original: &Pt,
        run: &[TransitionId],
    ) -> Result<Vec<TransitionId>, LiftError> {
        let mut lifted = self.lowered(run)?;
        let mut marking =
            replayed(original, original.initial.clone(), &lifted).ok_or(LiftError::NotARun)?;
        for layer in self.layers.iter().rev() {
            for rests in layer.rests.iter().rev() {
                rest(original, layer, rests, &mut marking, &mut lifted)?;
            }
        }
        debug_assert_eq!(
            replayed(original, original.initial.clone(), &lifted),
            Some(marking),
            "a lifted run is a run of the original net"
        );
        Ok(lifted.into_iter().map(TransitionId).collect())
    }

    /// As [`lift`](Self::lift) for a run that goes on for ever: a stem and a cycle, which is not
    /// empty.
    ///
    /// # Errors
    ///
    /// When it is no such run of the reduced net, or becomes too long.
    pub fn lift_lasso(
        &self,
        original: &Pt,
        stem: &[TransitionId],
        cycle: &[TransitionId],
    ) -> Result<(Vec<TransitionId>, Vec<TransitionId>), LiftError> {
        let whole = self.lowered(&[stem, cycle].concat())?;
        let stem = self.lowered(stem)?;
        let (before, after) = whole.split_at_checked(stem.len()).ok_or(LiftError::NotARun)?;
        let start =
            replayed(original, original.initial.clone(), before).ok_or(LiftError::NotARun)?;
        if before != stem
            || after.is_empty()
            || replayed(original, start.clone(), after).as_ref() != Some(&start)
        {
            return Err(LiftError::NotARun);
        }
        let ids = |run: &[u32]| run.iter().map(|&it| TransitionId(it)).collect();
        Ok((ids(before), ids(after)))
    }

    fn lowered(&self, run: &[TransitionId]) -> Result<Vec<u32>, LiftError> {
        let mut run: Vec<u32> = run.iter().map(|it| it.0).collect();
        for layer in self.layers.iter().rev() {
            let mut below = Vec::new();
            for &(step, times) in &layer.start {
                layer.expand(step, times, &mut below)?;
            }
            for transition in run {
                let step = *layer.roots.get(transition as usize).ok_or(LiftError::NotARun)?;
                layer.expand(step, 1, &mut below)?;
            }
            run = match &layer.supply {
                Some(supply) => supply.supplied(&below)?,
                None => below,
            };
        }
        Ok(run)
    }
}

/// Fires a run; `None` when it is none from there. Then some of it may have been fired.
fn replayed(pt: &Pt, mut marking: Vec<u32>, run: &[u32]) -> Option<Vec<u32>> {
    run.iter().all(|&it| fire(pt, &mut marking, it)).then_some(marking)
}

/// Fires a transition, if it can.
fn fire(pt: &Pt, marking: &mut [u32], transition: u32) -> bool {
    if transition as usize >= pt.transitions.len() || !pt.enabled(marking, transition) {
        return false;
    }
    let effects = pt.effects.of(transition);
    let after =
        |&(place, by): &(u32, i64)| u32::try_from(i64::from(marking[place as usize]) + by).is_ok();
    if !effects.iter().all(after) {
        return false;
    }
    for &(place, by) in effects {
        let tokens = &mut marking[place as usize];
        *tokens = tokens.wrapping_add_signed(by as i32);
    }
    true
}

/// Takes the firing of a transition back.
fn unfire(pt: &Pt, marking: &mut [u32], transition: u32) {
    for &(place, by) in pt.effects.of(transition) {
        let tokens = &mut marking[place as usize];
        *tokens = tokens.wrapping_add_signed(-by as i32);
    }
}

/// Fires steps as long as one can.
fn rest(
    original: &Pt,
    layer: &Layer,
    steps: &[u32],
    marking: &mut [u32],
    run: &mut Vec<u32>,
) -> Result<(), LiftError> {
    let mut again = true;
    while std::mem::take(&mut again) {
        for &step in steps {
            let mut fired = Vec::new();
            layer.expand(step, 1, &mut fired)?;
            loop {
                let count = fired.iter().take_while(|&&it| fire(original, marking, it)).count();
                if count < fired.len() || fired.is_empty() {
                    fired[..count].iter().rev().for_each(|&it| unfire(original, marking, it));
                    break;
                }
                if run.len() + fired.len() > MAX_LENGTH {
                    return Err(LiftError::TooLong);
                }
                run.extend(&fired);
                again = true;
            }
        }
    }
    Ok(())
}
