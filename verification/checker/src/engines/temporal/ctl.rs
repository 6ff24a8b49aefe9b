//! Formulas of CTL on a stored graph.

use super::bit_sets::BitSets;
use super::fairness::Fairness;
use super::labelling::Labelling;
use super::successors::Successors;
use super::witness::{Witness, explained};
use crate::explicit::{BitSet, Limit};
use cotama_property::Ctl;

/// The answer to a formula of CTL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CtlAnswer {
    /// Whether it holds in the initial marking.
    pub verdict: bool,
    /// For each of [`Ctl::nodes`] whether it holds in each marking of the graph. `None` of parts
    /// that the verdict does not depend on.
    pub labels: Vec<Option<BitSet>>,
    /// For each `Until` that was looked at and each marking how many firings its second operand is
    /// away, through markings in which the first holds; `u32::MAX` where the `Until` does not hold.
    pub ranks: Vec<Option<Vec<u32>>>,
    /// A run that shows the verdict, as far as one run can.
    pub witness: Option<Witness>,
}

/// Returns the states in which a formula holds, on runs that are fair.
///
/// ```
/// use cotama_core::net::TransitionId;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::explicit::{Graph, Limits};
/// use cotama_verification::property::{Ctl, Question, parse};
/// use cotama_verification::pt::Pt;
/// use cotama_verification::temporal::{Fairness, Rest, ctl};
///
/// let mut lamp = OwnedNet::new("lamp", "A lamp that blinks as long as nobody lights it.");
/// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
/// lamp.transition(OwnedTransition::new("blink").take(off, 1).give(off, 1)).unwrap();
/// lamp.transition(OwnedTransition::new("light").take(off, 1).give(on, 1)).unwrap();
/// let lamp = Pt::from(&lamp.view().net());
/// let graph = Graph::new(&lamp, &Limits::default(), &|_| ()).unwrap();
/// let Question::Formula(formula) = parse("AF on", &lamp).unwrap().question else {
///     panic!("not a formula")
/// };
/// let formula = Ctl::new(&formula).unwrap();
///
/// let answer = ctl(&graph, &formula, &Fairness::default(), 1 << 20, 1).unwrap();
/// assert!(!answer.verdict);
/// assert_eq!(answer.witness.unwrap().run.rest, Rest::Cycle(vec![TransitionId(0)]));
///
/// let fairness = Fairness { weak: vec![TransitionId(1)], ..Fairness::default() };
/// assert!(ctl(&graph, &formula, &fairness, 1 << 20, 1).unwrap().verdict);
/// ```
///
/// # Errors
/// [`Limit::Bytes`] when that takes more than so many bytes beside the graph.
pub fn ctl<S: Successors>(
    graph: &S,
    formula: &Ctl,
    fairness: &Fairness<'_>,
    bytes: u64,
    jobs: usize,
) -> Result<CtlAnswer, Limit> {
    let mut labelling = Labelling::new(BitSets::new(graph, fairness, bytes, jobs)?, formula);
    let verdict = labelling.holds(formula.root())?;
    let witness = explained(&labelling, verdict);
    Ok(CtlAnswer { verdict, labels: labelling.labels, ranks: labelling.ranks, witness })
}
