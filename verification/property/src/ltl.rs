//! The normal form of LTL.

use super::nodes::Nodes;
use super::{Assumptions, Atom, Formula};
use cotama_core::net::TransitionId;

/// A formula about one run as nodes that share what is equal, with negations in what is said of one
/// marking only. A node speaks of nodes before it only. Runs are infinite: the last marking before
/// a deadlock lasts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ltl {
    nodes: Vec<LtlNode>,
    root: u32,
}

/// A part of a formula about one run; numbers are positions in [`Ltl::nodes`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum LtlNode {
    /// A formula about the first marking.
    State(Formula),
    /// This transition fires first.
    Fires(TransitionId),
    /// The conjunction: all parts hold.
    And(Vec<u32>),
    /// The disjunction: some part holds.
    Or(Vec<u32>),
    /// From the next marking on.
    Next(u32),
    /// The first until the second, which comes.
    Until(u32, u32),
    /// The second as long as the first has not come, and when it comes; always, if it never comes.
    Release(u32, u32),
}

impl Ltl {
    /// The formula that stands after a quantifier. `None` when it has quantifiers, or speaks of
    /// time.
    pub fn new(path: &Formula) -> Option<Self> {
        Self::of(path, true)
    }

    /// Returns the formula that is true of a run exactly when this one is not: the condition of a
    /// counterexample to `A`.
    pub fn negation_of(path: &Formula) -> Option<Self> {
        Self::of(path, false)
    }

    fn of(path: &Formula, positive: bool) -> Option<Self> {
        Self::fair(path, &Assumptions::default(), positive)
    }

    /// Returns the formula that is true of the runs that are as assumed and of which the formula is
    /// true, or else false. A transition is treated weakly fair on a run that it is disabled on, or
    /// fires on, again and again; strongly fair on one that it is disabled on from some time on, or
    /// fires on again and again.
    ///
    /// ```
    /// use cotama_models::nets::door;
    /// use cotama_verification::property::{self, Formula, Ltl, LtlNode, Question};
    /// use cotama_verification::pt::Pt;
    /// let door = Pt::from(&door::NET);
    /// let asked = property::parse("A (F G Open) assuming weak(opened)", &door).unwrap();
    /// let Question::Fair(Formula::All(path), assumed) = asked.question else { panic!() };
    /// let counterexample = Ltl::fair(&path, &assumed, false).unwrap();
    /// assert!(counterexample.nodes().iter().any(|it| matches!(it, LtlNode::Fires(_))));
    /// ```
    pub fn fair(path: &Formula, assumed: &Assumptions, positive: bool) -> Option<Self> {
        let mut builder = Builder::default();
        let mut all = vec![builder.add(&path.simplified(), positive)?];
        for it in &assumed.weak {
            let rests = builder.disabled(*it);
            let fires = builder.push(LtlNode::Fires(*it));
            let either = builder.push(LtlNode::Or(vec![rests, fires]));
            all.push(builder.often(either));
        }
        for it in &assumed.strong {
            let rests = builder.disabled(*it);
            let never = builder.push(LtlNode::State(Formula::FALSE));
            let rests = builder.push(LtlNode::Release(never, rests));
            let always = builder.push(LtlNode::State(Formula::TRUE));
            let rests = builder.push(LtlNode::Until(always, rests));
            let fires = builder.push(LtlNode::Fires(*it));
            let fires = builder.often(fires);
            all.push(builder.push(LtlNode::Or(vec![rests, fires])));
        }
        for it in &assumed.often {
            let holds = builder.add(&it.simplified(), true)?;
            all.push(builder.often(holds));
        }
        let root = if all.len() == 1 { all[0] } else { builder.push(LtlNode::And(all)) };
        Some(Self { nodes: builder.into_list(), root })
    }

    /// Returns the parts of the formula.
    #[inline]
    pub fn nodes(&self) -> &[LtlNode] {
        &self.nodes
    }

    /// The node that is the whole formula.
    #[inline]
    pub fn root(&self) -> u32 {
        self.root
    }
}

type Builder = Nodes<LtlNode>;

impl Builder {
    /// Adds the condition that a transition is disabled.
    fn disabled(&mut self, transition: TransitionId) -> u32 {
        let enabled = Formula::Atom(Atom::Fireable(vec![transition]));
        self.push(LtlNode::State(enabled.negated()))
    }

    /// Again and again.
    fn often(&mut self, part: u32) -> u32 {
        let always = self.push(LtlNode::State(Formula::TRUE));
        let at_last = self.push(LtlNode::Until(always, part));
        let never = self.push(LtlNode::State(Formula::FALSE));
        self.push(LtlNode::Release(never, at_last))
    }

    /// A simple formula or its negation.
    fn add(&mut self, formula: &Formula, positive: bool) -> Option<u32> {
        if formula.is_state() {
            let state = if positive { formula.clone() } else { formula.clone().negated() };
            return Some(self.push(LtlNode::State(state)));
        }
        let node = match formula {
            Formula::Not(inner) => return self.add(inner, !positive),
            Formula::And(all) | Formula::Or(all) => {
                let mut parts =
                    all.iter().map(|it| self.add(it, positive)).collect::<Option<Vec<_>>>()?;
                parts.sort_unstable();
                parts.dedup();
                let conjunction = matches!(formula, Formula::And(_)) == positive;
                if conjunction { LtlNode::And(parts) } else { LtlNode::Or(parts) }
            }
            Formula::Next(inner) => LtlNode::Next(self.add(inner, positive)?),
            Formula::Until(a, b) => {
                let (a, b) = (self.add(a, positive)?, self.add(b, positive)?);
                if positive { LtlNode::Until(a, b) } else { LtlNode::Release(a, b) }
            }
            Formula::Finally(inner) | Formula::Globally(inner) => {
                let inner = self.add(inner, positive)?;
                if matches!(formula, Formula::Finally(_)) == positive {
                    LtlNode::Until(self.push(LtlNode::State(Formula::TRUE)), inner)
                } else {
                    LtlNode::Release(self.push(LtlNode::State(Formula::FALSE)), inner)
                }
            }
            _ => return None,
        };
        Some(self.push(node))
    }
}
