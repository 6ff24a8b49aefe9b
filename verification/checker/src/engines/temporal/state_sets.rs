//! The interface between labels of formulas of CTL and sets of states.

use crate::explicit::Limit;
use cotama_property::Formula;

/// Sets of the states of something, of which the first one is known, on fair runs if some are
/// assumed. Bit vectors of a stored graph are such sets; so would be decision diagrams, which store
/// none.
pub trait StateSets {
    /// A set.
    type Set;
    /// The record of a search backwards, from which a run is shown.
    type Ranks;

    /// All states, or none.
    ///
    /// # Errors
    /// As all others here: the limit that was reached.
    fn all(&mut self, is_full: bool) -> Result<Self::Set, Limit>;

    /// The states of which this formula, which speaks of one state, is true.
    ///
    /// # Errors
    /// The limit that was reached.
    fn satisfying(&mut self, formula: &Formula) -> Result<Self::Set, Limit>;

    /// The states that are not in a set.
    ///
    /// # Errors
    /// The limit that was reached.
    fn complement(&mut self, set: &Self::Set) -> Result<Self::Set, Limit>;

    /// Leaves in a set what is in both.
    fn and(&mut self, set: &mut Self::Set, other: &Self::Set);

    /// Adds to a set what is in the other.
    fn or(&mut self, set: &mut Self::Set, other: &Self::Set);

    /// `EX`: the states of which one in the set follows.
    ///
    /// # Errors
    /// The limit that was reached.
    fn before(&mut self, set: &Self::Set) -> Result<Self::Set, Limit>;

    /// `E[through U goal]`.
    ///
    /// # Errors
    /// The limit that was reached.
    fn until(
        &mut self,
        through: &Self::Set,
        goal: &Self::Set,
    ) -> Result<(Self::Set, Self::Ranks), Limit>;

    /// `EG`: the states from which a run stays in the region for ever, or until it ends.
    ///
    /// # Errors
    /// The limit that was reached.
    fn always(&mut self, region: &Self::Set) -> Result<Self::Set, Limit>;

    /// Whether the first state is in the set.
    fn has_first(&self, set: &Self::Set) -> bool;

    /// Whether no state is in the set.
    fn is_empty(&self, set: &Self::Set) -> bool;
}
