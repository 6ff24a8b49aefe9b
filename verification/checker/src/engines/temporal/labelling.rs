//! Sets of states in which the parts of a formula of CTL hold.

use super::state_sets::StateSets;
use crate::explicit::Limit;
use cotama_property::{Ctl, CtlNode, Formula};

/// The labels of the parts of a formula, by sets of states of any kind.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::explicit::{Graph, Limits};
/// use cotama_verification::property::{Ctl, Question, parse};
/// use cotama_verification::pt::Pt;
/// use cotama_checker::temporal::{BitSets, Labelling};
/// let door = Pt::from(&door::NET);
/// let graph = Graph::new(&door, &Limits::default(), &|_| ()).unwrap();
/// let Question::Formula(formula) = parse("AG EF Open", &door).unwrap().question else { panic!() };
/// let formula = Ctl::new(&formula).unwrap();
/// let sets = BitSets::new(&graph, &Default::default(), 1 << 20, 1).unwrap();
/// assert!(Labelling::new(sets, &formula).holds(formula.root()).unwrap());
/// ```
pub struct Labelling<'f, S: StateSets> {
    pub(super) sets: S,
    pub(super) formula: &'f Ctl,
    pub(super) labels: Vec<Option<S::Set>>,
    pub(super) ranks: Vec<Option<S::Ranks>>,
}

impl<'f, S: StateSets> Labelling<'f, S> {
    /// Nothing is looked at yet.
    pub fn new(sets: S, formula: &'f Ctl) -> Self {
        let nodes = formula.nodes().len();
        let labels = (0..nodes).map(|_| None).collect();
        Self { sets, formula, labels, ranks: (0..nodes).map(|_| None).collect() }
    }

    /// Whether a part holds in the first state; parts of it that do not matter for this are not
    /// looked at.
    ///
    /// # Errors
    /// The limit that was reached.
    pub fn holds(&mut self, node: u32) -> Result<bool, Limit> {
        let formula = self.formula;
        Ok(match &formula.nodes()[node as usize] {
            CtlNode::Not(a) => !self.holds(*a)?,
            CtlNode::And(all) => {
                for it in all {
                    if !self.holds(*it)? {
                        return Ok(false);
                    }
                }
                true
            }
            CtlNode::Or(all) => {
                for it in all {
                    if self.holds(*it)? {
                        return Ok(true);
                    }
                }
                false
            }
            CtlNode::Until(a, b) if self.is_true(*a) => {
                self.label(*b)?;
                let goal = self.labels[*b as usize].as_ref();
                !goal.is_none_or(|it| self.sets.is_empty(it)) && self.has_first(node)?
            }
            _ => self.has_first(node)?,
        })
    }

    fn has_first(&mut self, node: u32) -> Result<bool, Limit> {
        self.label(node)?;
        let label = &self.labels[node as usize];
        Ok(label.as_ref().is_some_and(|it| self.sets.has_first(it)))
    }

    fn is_true(&self, node: u32) -> bool {
        matches!(&self.formula.nodes()[node as usize],
            CtlNode::State(it) if *it == Formula::TRUE)
    }

    /// Finds the states in which a part holds. Nesting is as deep as formulas may be.
    fn label(&mut self, node: u32) -> Result<(), Limit> {
        if self.labels[node as usize].is_some() {
            return Ok(());
        }
        let formula = self.formula;
        let parts: &[u32] = match &formula.nodes()[node as usize] {
            CtlNode::State(_) => &[],
            CtlNode::Not(a) | CtlNode::Next(a) | CtlNode::Globally(a) => &[*a],
            CtlNode::And(all) | CtlNode::Or(all) => all,
            CtlNode::Until(a, b) => &[*a, *b],
        };
        for part in parts {
            self.label(*part)?;
        }
        let (sets, labels) = (&mut self.sets, &self.labels);
        let known = |part: &u32| labels[*part as usize].as_ref().ok_or(Limit::Bytes);
        let label = match &formula.nodes()[node as usize] {
            CtlNode::State(state) => sets.satisfying(state)?,
            CtlNode::Not(a) => sets.complement(known(a)?)?,
            CtlNode::And(all) => {
                let mut holds = sets.all(true)?;
                for part in all {
                    sets.and(&mut holds, known(part)?);
                }
                holds
            }
            CtlNode::Or(all) => {
                let mut holds = sets.all(false)?;
                for part in all {
                    sets.or(&mut holds, known(part)?);
                }
                holds
            }
            CtlNode::Next(a) => sets.before(known(a)?)?,
            CtlNode::Until(a, b) => {
                let (holds, ranks) = sets.until(known(a)?, known(b)?)?;
                self.ranks[node as usize] = Some(ranks);
                holds
            }
            CtlNode::Globally(a) => sets.always(known(a)?)?,
        };
        self.labels[node as usize] = Some(label);
        Ok(())
    }
}
