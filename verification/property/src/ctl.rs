//! The normal form of CTL.

use super::Formula;
use super::nodes::Nodes;

/// A formula of CTL as nodes that share what is equal. A node speaks of nodes before it only, so
/// that one pass in their order finds where each of them holds.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::property::{self, Ctl};
/// use cotama_verification::pt::Pt;
/// let door = Pt::from(&door::NET);
/// let ctl = |text| Ctl::new(property::parse(text, &door).unwrap().question.formula().unwrap());
/// assert!(ctl("AG EF Closed").is_some());
/// assert!(ctl("A (F G Open)").is_none()); // LTL
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ctl {
    nodes: Vec<CtlNode>,
    root: u32,
}

/// A part of a formula of CTL; numbers are positions in [`Ctl::nodes`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum CtlNode {
    /// A formula about one marking.
    State(Formula),
    /// The negation.
    Not(u32),
    /// The conjunction: all parts hold.
    And(Vec<u32>),
    /// The disjunction: some part holds.
    Or(Vec<u32>),
    /// `EX`: some successor; after a deadlock there is none.
    Next(u32),
    /// `E[a U b]`: on some run the first until the second, which comes.
    Until(u32, u32),
    /// `EG`: always on some run, which goes on for ever or ends in a deadlock.
    Globally(u32),
}

impl Ctl {
    /// Returns the formula of CTL; `None` when a temporal operator does not follow a quantifier, or
    /// speaks of time.
    pub fn new(formula: &Formula) -> Option<Self> {
        let mut builder = Builder::default();
        let root = builder.add(formula)?;
        Some(Self { nodes: builder.into_list(), root })
    }

    /// Returns the parts of the formula.
    #[inline]
    pub fn nodes(&self) -> &[CtlNode] {
        &self.nodes
    }

    /// The node that is the whole formula.
    #[inline]
    pub fn root(&self) -> u32 {
        self.root
    }
}

type Builder = Nodes<CtlNode>;

impl Builder {
    fn not(&mut self, inner: u32) -> u32 {
        match self.at(inner) {
            CtlNode::Not(twice) => *twice,
            CtlNode::State(formula) => {
                let negated = formula.clone().negated();
                self.push(CtlNode::State(negated))
            }
            _ => self.push(CtlNode::Not(inner)),
        }
    }

    fn add(&mut self, formula: &Formula) -> Option<u32> {
        if formula.is_state() {
            return Some(self.push(CtlNode::State(formula.clone())));
        }
        match formula {
            Formula::Not(inner) => {
                let inner = self.add(inner)?;
                Some(self.not(inner))
            }
            Formula::And(all) => {
                let parts = self.parts(all, Formula::And)?;
                Some(self.push(CtlNode::And(parts)))
            }
            Formula::Or(all) => {
                let parts = self.parts(all, Formula::Or)?;
                Some(self.push(CtlNode::Or(parts)))
            }
            Formula::Exists(path) => self.exists(path),
            Formula::All(path) => self.all(path),
            _ => None,
        }
    }

    /// The parts of a conjunction or disjunction, those about one marking as one.
    fn parts(&mut self, all: &[Formula], join: fn(Vec<Formula>) -> Formula) -> Option<Vec<u32>> {
        let (state, other): (Vec<_>, Vec<_>) = all.iter().partition(|it| it.is_state());
        let mut parts = Vec::with_capacity(other.len() + 1);
        match state.as_slice() {
            [] => {}
            [only] => parts.push(self.push(CtlNode::State((*only).clone()))),
            _ => parts.push(self.push(CtlNode::State(join(state.into_iter().cloned().collect())))),
        }
        for part in other {
            parts.push(self.add(part)?);
        }
        parts.sort_unstable();
        parts.dedup();
        Some(parts)
    }

    fn exists(&mut self, path: &Formula) -> Option<u32> {
        let node = match path {
            Formula::Next(inner) => CtlNode::Next(self.add(inner)?),
            Formula::Finally(goal) => {
                let always = self.push(CtlNode::State(Formula::TRUE));
                CtlNode::Until(always, self.add(goal)?)
            }
            Formula::Globally(law) => CtlNode::Globally(self.add(law)?),
            Formula::Until(a, b) => CtlNode::Until(self.add(a)?, self.add(b)?),
            // A formula that needs no run holds on each of them or on none.
            inner => return self.add(inner),
        };
        Some(self.push(node))
    }

    fn all(&mut self, path: &Formula) -> Option<u32> {
        let counterexample = match path {
            Formula::Next(inner) => {
                let inner = self.add(inner)?;
                CtlNode::Next(self.not(inner))
            }
            Formula::Finally(goal) => {
                let goal = self.add(goal)?;
                CtlNode::Globally(self.not(goal))
            }
            Formula::Globally(law) => {
                let law = self.add(law)?;
                let always = self.push(CtlNode::State(Formula::TRUE));
                CtlNode::Until(always, self.not(law))
            }
            // Either the second never comes, or before it comes the first ends.
            Formula::Until(a, b) => {
                let (a, b) = (self.add(a)?, self.add(b)?);
                let (not_a, not_b) = (self.not(a), self.not(b));
                let neither = self.push(CtlNode::And(vec![not_a, not_b]));
                let ends = self.push(CtlNode::Until(not_b, neither));
                let never = self.push(CtlNode::Globally(not_b));
                CtlNode::Or(vec![ends, never])
            }
            inner => return self.add(inner),
        };
        let counterexample = self.push(counterexample);
        Some(self.not(counterexample))
    }
}
