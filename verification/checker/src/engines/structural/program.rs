//! The state equation of a net as a linear program: the marking is the initial one plus what
//! firings change.

use super::Limit;
use super::certificate::{LinearInvariant, Sum, Trap};
use super::flow::basis;
use super::row::Row;
use super::tableau::{Raised, Tableau};
use super::work::Work;
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::Linear;
use cotama_property::pt::{Lists, Pt};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The meaning of a variable of the program.
#[derive(Clone, Debug)]
enum Column {
    /// How often transitions with the effect of this one fire.
    Firings(TransitionId),
    /// Tokens of a place.
    Tokens(PlaceId),
    /// By how much an assumption is more than satisfied; its position.
    Premise(usize),
    /// How many tokens a trap has beyond the first.
    Trap(Arc<Trap>),
}

/// The state equation, assumptions, and constraints that traps give; and a point that satisfies
/// some of them.
#[derive(Clone, Debug)]
pub(super) struct Program {
    tableau: Tableau,
    columns: Vec<Column>,
    /// The variable of the first place; the others follow.
    places: u32,
    /// How many places there are.
    count: u32,
}

impl Program {
    /// The state equation alone, of the transitions that can fire; its point is the initial
    /// marking.
    pub(super) fn new(
        pt: &Pt,
        can_fire: impl Fn(TransitionId) -> bool,
        work: &mut Work,
    ) -> Result<Self, Limit> {
        let mut tableau = Tableau::default();
        let mut columns = Vec::new();
        let mut seen = BTreeMap::new();
        let mut variables = vec![None; pt.transitions.len()];
        for transition in 0..pt.transitions.len() as u32 {
            let effects = pt.effects.of(transition);
            if !effects.is_empty()
                && can_fire(TransitionId(transition))
                && !seen.contains_key(effects)
            {
                let variable = tableau.variable();
                seen.insert(effects, variable);
                variables[transition as usize] = Some(variable);
                columns.push(Column::Firings(TransitionId(transition)));
            }
        }
        let places = columns.len() as u32;
        for (place, &tokens) in pt.initial.iter().enumerate() {
            let changes = pt.changers.of(place as u32).iter();
            let terms: Row = changes
                .filter_map(|&(transition, by)| Some((variables[transition as usize]?, -by)))
                .collect();
            work.pass(terms.len() + 1)?;
            tableau.add(&terms, tokens.into(), work)?;
            columns.push(Column::Tokens(PlaceId(place as u32)));
        }
        Ok(Self { tableau, columns, places, count: pt.places.len() as u32 })
    }

    /// Makes the program of place invariants alone, with no regard to how often transitions fire:
    /// much smaller, and often enough.
    pub(super) fn invariants(
        pt: &Pt,
        can_fire: impl Fn(TransitionId) -> bool,
        work: Work,
    ) -> Result<Self, Limit> {
        let places = 0..pt.places.len() as u32;
        let changers = Lists::new(places.clone().map(|place| {
            pt.changers.of(place).iter().copied().filter(|it| can_fire(TransitionId(it.0)))
        }));
        let mut program =
            Self { tableau: Tableau::default(), columns: Vec::new(), places: 0, count: places.end };
        for place in places {
            program.tableau.variable();
            program.columns.push(Column::Tokens(PlaceId(place)));
        }
        let mut equating = work;
        for flow in basis(&changers, pt.transitions.len() as u32, &mut work.clone())? {
            let tokens = |&(place, weight): &(u32, i64)| {
                weight.checked_mul(pt.initial[place as usize].into())
            };
            let total = flow.iter().try_fold(0_i64, |sum, it| sum.checked_add(tokens(it)?));
            // With the marked places as basic variables the point is close to the initial marking.
            let preferred = |place: u32| pt.initial[place as usize] > 0;
            let total = total.ok_or(Limit::Tokens)?;
            program.tableau.equate(&flow, total, preferred, &mut equating)?;
        }
        program.satisfy(&[], &mut work.clone())?;
        Ok(program)
    }

    /// A weighted sum of tokens times a factor. Places that the net does not have are empty.
    fn terms(&self, weights: &[(PlaceId, i64)], factor: i64) -> Result<Row, Limit> {
        let mut terms = BTreeMap::new();
        for &(place, weight) in weights.iter().filter(|it| it.0.0 < self.count) {
            let sum: &mut i64 = terms.entry(self.places + place.0).or_insert(0);
            *sum = weight
                .checked_mul(factor)
                .and_then(|it| sum.checked_add(it))
                .ok_or(Limit::Tokens)?;
        }
        Ok(terms.into_iter().filter(|it| it.1 != 0).collect())
    }

    /// One more assumption, by its position.
    pub(super) fn assume(
        &mut self,
        at: usize,
        premise: &Linear,
        work: &mut Work,
    ) -> Result<(), Limit> {
        let terms = self.terms(&premise.weights, 1)?;
        let right = premise.constant.checked_neg().ok_or(Limit::Tokens)?;
        self.tableau.add(&terms, right, work)?;
        self.columns.push(Column::Premise(at));
        Ok(())
    }

    /// Adds the constraint that a trap is marked.
    pub(super) fn mark(&mut self, trap: Trap, work: &mut Work) -> Result<(), Limit> {
        let weights: Vec<_> = trap.places.iter().map(|&it| (it, 1)).collect();
        let terms = self.terms(&weights, -1)?;
        self.tableau.add(&terms, -1, work)?;
        self.columns.push(Column::Trap(Arc::new(trap)));
        Ok(())
    }

    /// Moves to a point that satisfies everything; otherwise the proof that there is none.
    pub(super) fn satisfy(
        &mut self,
        premises: &[Linear],
        work: &mut Work,
    ) -> Result<Option<Sum>, Limit> {
        while let Some(row) = self.tableau.violated(work)? {
            if self.tableau.raise(row, true, work)? != Raised::Feasible {
                return self.sum(row, premises).map(Some);
            }
        }
        Ok(None)
    }

    /// Moves to a point with the largest value of a weighted sum of tokens. The value, rounded
    /// down, and the proof with the assumption that the sum is larger; `None` when there is no
    /// largest value.
    pub(super) fn maximise(
        &mut self,
        weights: &[(PlaceId, i64)],
        work: &mut Work,
    ) -> Result<Option<(i64, Sum)>, Limit> {
        let terms = self.terms(weights, -1)?;
        let row = self.tableau.add(&terms, 0, work)?;
        self.columns.push(Column::Premise(0));
        let raised = self.tableau.raise(row, false, work);
        let found = match raised {
            Ok(Raised::Maximal) => {
                let (numerator, denominator) = self.tableau.value(self.columns.len() as u32 - 1);
                let most = numerator.div_euclid(denominator);
                // The variable of the row is the sum itself, not by how much it passes the bound.
                let negated = weights.iter().map(|&(place, weight)| (place, -weight)).collect();
                self.sum(row, &[Linear { constant: 0, weights: negated }])
                    .map(|sum| Some((most, sum)))
            }
            Ok(_) => Ok(None),
            Err(stop) => Err(stop),
        };
        self.tableau.remove_last();
        self.columns.pop();
        found
    }

    /// Returns the sum proved by a row without negative numbers: tokens, surpluses and firings add
    /// up to a constant. Surpluses written as tokens, the tokens are what no firing increases.
    fn sum(&self, row: usize, premises: &[Linear]) -> Result<Sum, Limit> {
        self.checked_sum(row, premises).ok_or(Limit::Tokens)
    }

    fn checked_sum(&self, row: usize, premises: &[Linear]) -> Option<Sum> {
        let (terms, right) = self.tableau.row(row);
        let mut sum = Sum::default();
        let mut weights: BTreeMap<PlaceId, i128> = BTreeMap::new();
        let mut constant = i128::from(right);
        let mut add = |place, weight: i64, factor: i64| {
            let sum = weights.entry(place).or_insert(0);
            *sum = sum.checked_add(i128::from(weight) * i128::from(factor))?;
            Some(())
        };
        for &(column, number) in terms {
            match &self.columns[column as usize] {
                Column::Firings(_) => {}
                Column::Tokens(place) => add(*place, 1, number)?,
                Column::Premise(at) => {
                    let premise = premises.get(*at)?;
                    for &(place, weight) in &premise.weights {
                        add(place, weight, number.checked_neg()?)?;
                    }
                    constant =
                        constant.checked_add(i128::from(premise.constant) * i128::from(number))?;
                    sum.premises.push((*at, number.into()));
                }
                Column::Trap(trap) => {
                    for &place in &trap.places {
                        add(place, 1, number)?;
                    }
                    constant = constant.checked_add(number.into())?;
                    sum.traps.push((Trap::clone(trap), number.into()));
                }
            }
        }
        weights.retain(|_, weight| *weight != 0);
        let weights = weights.into_iter().collect();
        sum.invariant = Arc::new(LinearInvariant { weights, constant });
        Some(sum)
    }

    /// A copy to go on with.
    pub(super) fn copied(&self, work: &mut Work) -> Result<Self, Limit> {
        work.pass(self.tableau.len() + self.columns.len())?;
        Ok(self.clone())
    }

    /// Tokens of a place in the point, as numerator and positive denominator.
    pub(super) fn tokens(&self, place: u32) -> (i64, i64) {
        self.tableau.value(self.places + place)
    }

    /// How often transitions fire in the point, one transition for all with the same effect; `None`
    /// when not a whole number of times.
    pub(super) fn firings(&self) -> Option<Vec<(TransitionId, u64)>> {
        let mut firings = Vec::new();
        for (variable, column) in self.columns.iter().enumerate() {
            if let Column::Firings(transition) = column {
                let (numerator, denominator) = self.tableau.value(variable as u32);
                if numerator % denominator != 0 {
                    return None;
                }
                if numerator > 0 {
                    firings.push((*transition, (numerator / denominator).unsigned_abs()));
                }
            }
        }
        Some(firings)
    }
}
