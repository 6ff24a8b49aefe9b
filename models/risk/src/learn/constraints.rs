//! Arcs that a user requires or forbids.

use crate::dag::{Dag, MAX_LEARNED, all, bits};
use crate::wrong::Wrong;

/// Arcs as a user wishes them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wish {
    /// Arcs, from parent to child, that the graph has.
    pub required: Vec<(usize, usize)>,
    /// Arcs that it has not.
    pub forbidden: Vec<(usize, usize)>,
    /// Tiers: no arc points from a later one to an earlier one. A variable of none is free.
    pub tiers: Vec<Vec<usize>>,
    /// The most parents of a variable, if there is a bound.
    pub max_parents: Option<usize>,
}

/// Constraints on a graph that some graph meets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraints {
    /// For each variable the parents that it has.
    required: Vec<u64>,
    /// For each variable the parents that it may have; holds those required.
    allowed: Vec<u64>,
    max_parents: usize,
}

impl Constraints {
    /// No constraints.
    ///
    /// # Errors
    /// For more than [`MAX_LEARNED`] variables.
    pub fn none(variables: usize) -> Result<Self, Wrong> {
        Self::new(variables, &Wish::default())
    }

    /// The constraints of a wish.
    ///
    /// # Errors
    /// For more than [`MAX_LEARNED`] variables, and where no graph meets the wish: an arc both
    /// required and forbidden, or required against the tiers, in a cycle or beyond the bound.
    pub fn new(variables: usize, wish: &Wish) -> Result<Self, Wrong> {
        if variables > MAX_LEARNED {
            let message = format!("{variables} variables; at most {MAX_LEARNED} are learned");
            return Err(Wrong::whole(message).help("leave columns out"));
        }
        let mut allowed: Vec<u64> = (0..variables).map(|it| all(variables) & !(1 << it)).collect();
        let tier = |it: usize| wish.tiers.iter().position(|tier| tier.contains(&it));
        for (to, mask) in allowed.iter_mut().enumerate() {
            for from in bits(*mask) {
                let is_late = matches!((tier(from), tier(to)), (Some(a), Some(b)) if a > b);
                if is_late || wish.forbidden.contains(&(from, to)) {
                    *mask &= !(1 << from);
                }
            }
        }
        let max_parents = wish.max_parents.unwrap_or(variables);
        let mut required = vec![0_u64; variables];
        for &(from, to) in &wish.required {
            if from >= variables || to >= variables || allowed[to] >> from & 1 == 0 {
                return Err(Wrong::whole("a required arc is forbidden, or against the tiers"));
            }
            required[to] |= 1 << from;
        }
        if required.iter().any(|it| it.count_ones() as usize > max_parents) {
            return Err(Wrong::whole("more arcs into a variable are required than are allowed"));
        }
        if Dag::new(required.clone()).is_none() {
            return Err(Wrong::whole("the required arcs make a cycle"));
        }
        Ok(Self { required, allowed, max_parents })
    }

    /// For each variable the parents that it has in every graph, as bits.
    pub(crate) fn required(&self) -> &[u64] {
        &self.required
    }

    pub(crate) fn allowed(&self) -> &[u64] {
        &self.allowed
    }

    pub(crate) const fn max_parents(&self) -> usize {
        self.max_parents
    }

    /// Returns whether a variable may have just these parents.
    pub fn allow(&self, child: usize, parents: u64) -> bool {
        let (required, allowed) = (self.required[child], self.allowed[child]);
        parents & !allowed == 0
            && required & !parents == 0
            && parents.count_ones() as usize <= self.max_parents
    }

    /// Returns whether a graph meets the constraints.
    pub fn meets(&self, dag: &Dag) -> bool {
        dag.parents().iter().enumerate().all(|(child, it)| self.allow(child, *it))
    }

    /// The graph with the required arcs alone.
    pub(crate) fn least(&self) -> Dag {
        Dag::new(self.required.clone()).unwrap_or_else(|| Dag::empty(self.required.len()))
    }
}
