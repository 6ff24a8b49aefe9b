//! Evidence from proofs of the structural engine.

use super::proof::{self as proof, Bound, DeadTransitions, DeadlockFree, disabled};
use super::read::{Claim, Numbered};
use super::sum::{ONE, Sum};
use super::verify::Known;
use super::{Case, Evidence, Fact, Formula, Linear, Refutation};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property as property;
use cotama_property::pt::Pt;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::iter::once;
use std::sync::Arc;

/// A case whose inequalities are not numbered yet, as more facts may be found.
enum Draft {
    Leaf { facts: Vec<(usize, u64)>, assumed: Vec<(usize, u64)> },
    Split(usize),
    Cut(Linear),
}

/// The contents of a fact: whether it is a trap, the constant, places and weights.
type Key = (bool, i64, Vec<(u32, i64)>);

/// A refutation while it is written.
struct Draught<'a> {
    pt: &'a Pt,
    dead: &'a DeadTransitions,
    facts: Vec<Fact>,
    /// The numbers of facts.
    numbers: BTreeMap<Key, usize>,
    /// The numbers of invariants that bounds of many places share.
    invariants: HashMap<*const proof::LinearInvariant, usize>,
    cases: Vec<Draft>,
}

/// The assumptions at a node: how many inequalities, which of them the assumptions of the engine
/// are, and the positions of the `or`s of transitions that are not enabled.
#[derive(Clone, Default)]
struct Node {
    assumed: usize,
    premises: Vec<usize>,
    ors: BTreeMap<TransitionId, usize>,
}

impl Node {
    /// With one more inequality, which is the next assumption of the engine.
    fn and(&self) -> Self {
        let mut node = self.clone();
        node.premises.push(node.assumed);
        node.assumed += 1;
        node
    }
}

impl Evidence {
    /// Returns the evidence that no marking of a kind is reached, from the refutation of each `and`
    /// of inequalities that the goal, as an `or`, is made of. The first [`DeadTransitions`] are
    /// those of the structure of the net.
    ///
    /// `None` when a part is missing, or a number has more than 64 bits.
    ///
    /// ```
    /// # use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
    /// # use cotama_verification::certificate::{Answer, Certificate, Evidence, verify};
    /// # use cotama_verification::property::{self, Formula, Question};
    /// # use cotama_verification::pt::Pt;
    /// # use cotama_checker::structural::{self, Structure};
    /// let mut lamp = OwnedNet::new("lamp", "");
    /// let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
    /// let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
    /// lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
    /// let lamp = Pt::from(&lamp.view().net());
    /// let both = property::parse("EF on + off >= 2", &lamp).unwrap();
    /// let Question::Formula(Formula::Exists(path)) = &both.question else {
    ///     panic!("not of that form")
    /// };
    /// let Formula::Finally(goal) = &**path else { panic!("not of that form") };
    ///
    /// let structure = Structure::new(&lamp, &structural::Limits::default());
    /// let inequality = property::Linear { constant: 2, weights: vec![(off, -1), (on, -1)] };
    /// let structural::Answer::Impossible(refutation) = structure.reach(&[inequality.clone()])
    /// else {
    ///     panic!()
    /// };
    /// let evidence =
    ///     Evidence::never(&lamp, structure.dead(), goal, &[(vec![inequality], refutation)])
    ///         .unwrap();
    /// let certificate = Certificate::new(&lamp, &both, Answer::Holds(false), evidence).unwrap();
    /// assert!(verify(&certificate.text()).is_ok());
    /// ```
    pub fn never(
        pt: &Pt,
        dead: &DeadTransitions,
        goal: &property::Formula,
        parts: &[(Vec<property::Linear>, proof::Refutation)],
    ) -> Option<Self> {
        let named = super::Net::from(pt);
        let net = Numbered::new(&named).ok()?;
        let goal = net.written_out(&Formula::new(pt, goal).ok()?).ok()?;
        let linear = |it: &property::Linear| {
            let weights = it.weights.iter().map(|it| (ONE + 1 + it.0.0 as usize, it.1.into()));
            Sum(once((ONE, it.constant.into())).chain(weights).collect())
        };
        let parts: Vec<_> = parts
            .iter()
            .map(|(goal, by)| (goal.iter().map(linear).collect::<Vec<_>>(), by))
            .collect();
        let mut draught = Draught::new(pt, dead);
        draught.goal(&net, (&goal, true), &mut Known::default(), 0, &parts)?;
        draught.finish()
    }

    /// Returns the evidence that a sum of tokens never passes a bound: an answer to
    /// `AG sum <= bound`, or the first of the two parts that [`Evidence::most`] puts together.
    pub fn bounded(pt: &Pt, dead: &DeadTransitions, bound: &Bound) -> Option<Self> {
        let mut draught = Draught::new(pt, dead);
        draught.refutation(&bound.refutation, &Node::default().and())?;
        draught.finish()
    }

    /// Returns the evidence of a largest sum: there are never more tokens, and a path leads to as
    /// many.
    pub fn most(never_more: Self, pt: &Pt, way: &[u32]) -> Self {
        Self::Each(vec![never_more, Self::trace(pt, way)])
    }

    /// Returns the evidence that no reachable marking is dead: an answer to `AG !deadlock`.
    pub fn deadlock_free(pt: &Pt, dead: &DeadTransitions, proof: &DeadlockFree) -> Option<Self> {
        let mut draught = Draught::new(pt, dead);
        draught.deadlock(proof)?;
        draught.finish()
    }

    /// Returns the evidence that no place ever holds two tokens, from a bound of each place.
    pub fn one_safe(pt: &Pt, dead: &DeadTransitions, bounds: &[Bound]) -> Option<Self> {
        let mut draught = Draught::new(pt, dead);
        if pt.places.len() != 1 {
            draught.cases.push(Draft::Split(0));
        }
        let of_places = of_places(bounds.iter().filter(|it| it.at_most <= 1));
        for place in 0..pt.places.len() as u32 {
            let bound = of_places.get(&PlaceId(place))?;
            draught.refutation(&bound.refutation, &Node::default().and())?;
        }
        draught.finish()
    }
}

impl<'a> Draught<'a> {
    fn new(pt: &'a Pt, dead: &'a DeadTransitions) -> Self {
        let (facts, cases) = (Vec::new(), Vec::new());
        Self { pt, dead, facts, numbers: BTreeMap::new(), invariants: HashMap::new(), cases }
    }

    fn finish(mut self) -> Option<Evidence> {
        let goal = std::mem::take(&mut self.cases);
        let mut dead = Vec::new();
        for &transition in &self.dead.transitions {
            self.never_fires(transition)?;
            let name = self.pt.transitions.get(transition.0 as usize)?.clone();
            dead.push((name, std::mem::take(&mut self.cases)));
        }
        let count = self.facts.len();
        let number = |drafts: Vec<Draft>| {
            let case = |it| match it {
                Draft::Leaf { mut facts, assumed } => {
                    facts.extend(
                        assumed.into_iter().map(|(number, factor)| (count + number, factor)),
                    );
                    Case::Contradiction(facts)
                }
                Draft::Split(or) => Case::Split(or),
                Draft::Cut(linear) => Case::Cut(linear),
            };
            drafts.into_iter().map(case).collect::<Vec<_>>()
        };
        let dead = dead.into_iter().map(|(name, cases)| (name, number(cases))).collect();
        Some(Evidence::Refutation(Refutation { dead, cases: number(goal), facts: self.facts }))
    }

    /// The number of a fact.
    fn fact(&mut self, trap: bool, constant: i64, weights: Vec<(u32, i64)>) -> usize {
        let (pt, facts) = (self.pt, &mut self.facts);
        *self.numbers.entry((trap, constant, weights)).or_insert_with_key(
            |(trap, constant, weights)| {
                facts.push(if *trap {
                    Fact::trap(pt, &weights.iter().map(|it| it.0).collect::<Vec<_>>())
                } else {
                    Fact::AtMost(Linear::new(pt, *constant, weights.iter().copied()))
                });
                facts.len() - 1
            },
        )
    }

    /// Adds the proof that the engine's assumptions do not hold together.
    fn refutation(&mut self, by: &proof::Refutation, node: &Node) -> Option<()> {
        match by {
            proof::Refutation::Sum(sum) => self.sum(sum, node),
            proof::Refutation::Tokens { place, at, below, above } => {
                self.cases.push(Draft::Cut(Linear::new(self.pt, -i64::from(*at), [(place.0, 1)])));
                self.refutation(below, &node.and())?;
                self.refutation(above, &node.and())
            }
            proof::Refutation::Disabled { transition, cases } => {
                self.cases.push(Draft::Split(*node.ors.get(transition)?));
                cases.iter().try_for_each(|it| self.refutation(it, &node.and()))
            }
        }
    }

    fn sum(&mut self, sum: &proof::Sum, node: &Node) -> Option<()> {
        let factor = |it: i128| u64::try_from(it).ok();
        let mut facts = Vec::new();
        for (trap, times) in &sum.traps {
            let places = trap.places.iter().map(|it| (it.0, -1)).collect();
            facts.push((self.fact(true, 1, places), factor(*times)?));
        }
        if !sum.invariant.weights.is_empty() || sum.invariant.constant != 0 {
            facts.push((self.invariant(&sum.invariant)?, 1));
        }
        let assumed =
            sum.premises.iter().map(|it| Some((*node.premises.get(it.0)?, factor(it.1)?)));
        let assumed = assumed.collect::<Option<_>>()?;
        self.cases.push(Draft::Leaf { facts, assumed });
        Some(())
    }

    fn invariant(&mut self, invariant: &Arc<proof::LinearInvariant>) -> Option<usize> {
        // The proofs outlive the draught.
        if let Some(&known) = self.invariants.get(&Arc::as_ptr(invariant)) {
            return Some(known);
        }
        let weights = invariant.weights.iter().map(|it| Some((it.0.0, i64::try_from(it.1).ok()?)));
        let constant = i64::try_from(invariant.constant.checked_neg()?).ok()?;
        let fact = self.fact(false, constant, weights.collect::<Option<_>>()?);
        self.invariants.insert(Arc::as_ptr(invariant), fact);
        Some(fact)
    }

    fn never_fires(&mut self, transition: TransitionId) -> Option<()> {
        let needs = self.pt.needs.of(transition.0);
        if let Some((_, by)) = self.dead.refutations.iter().find(|it| it.0 == transition) {
            return self.refutation(by, &needs.iter().fold(Node::default(), |node, _| node.and()));
        }
        // The transition needs more tokens of a place than there ever are.
        let fed =
            |&(transition, by): &(u32, i64)| by > 0 && self.dead.can_fire(TransitionId(transition));
        let (at, place) = needs.iter().enumerate().find_map(|(at, &(place, need))| {
            let starves = self.pt.initial[place as usize] < need
                && !self.pt.changers.of(place).iter().any(fed);
            starves.then_some((at, place))
        })?;
        let fact = self.fact(false, -i64::from(self.pt.initial[place as usize]), vec![(place, 1)]);
        self.cases.push(Draft::Leaf { facts: vec![(fact, 1)], assumed: vec![(at, 1)] });
        Some(())
    }

    /// Assumes a goal; refutes it by the part that is assumed then, or else by the cases of the
    /// first `or` that is still open.
    fn goal<'c>(
        &mut self,
        net: &Numbered<'_>,
        goal: Claim<'c>,
        known: &mut Known<'c>,
        split: usize,
        parts: &[(Vec<Sum>, &proof::Refutation)],
    ) -> Option<()> {
        let (sums, lists) = (known.sums.len(), known.lists.len());
        net.assume(goal, known).ok()?;
        let at = |it: &Sum| known.sums.iter().position(|known| known == it);
        let refuted = parts.iter().find_map(|(goal, by)| {
            let premises = goal.iter().map(at).collect::<Option<Vec<_>>>()?;
            Some((Node { assumed: known.sums.len(), premises, ors: BTreeMap::new() }, *by))
        });
        if let Some((node, by)) = refuted {
            self.refutation(by, &node)?;
        } else {
            let (cases, holds) = *known.lists.get(split)?;
            self.cases.push(Draft::Split(split));
            cases.iter().try_for_each(|it| self.goal(net, (it, holds), known, split + 1, parts))?;
        }
        known.sums.truncate(sums);
        known.lists.truncate(lists);
        Some(())
    }

    /// Cuts for the bounds, and for the inequalities that hold within them where a transition is
    /// not enabled, both as far as they are used; in the last of the cases stands the refutation,
    /// and then follows why the others do not occur.
    fn deadlock(&mut self, by: &DeadlockFree) -> Option<()> {
        let mut node = Node::default();
        let mut single = BTreeMap::new();
        for transition in (0..self.pt.transitions.len() as u32).map(TransitionId) {
            if self.pt.needs.of(transition.0).len() == 1 {
                single.insert(transition, node.assumed);
                node.assumed += 1;
            } else {
                node.ors.insert(transition, node.ors.len());
            }
        }
        let mut used = BTreeSet::new();
        premises(&by.refutation, &mut used);
        let cut: Vec<_> = by
            .disabled
            .iter()
            .enumerate()
            .filter(|it| used.contains(&it.0))
            .map(|it| *it.1)
            .collect();
        let cut: Vec<_> = cut.into_iter().filter(|it| !single.contains_key(it)).collect();
        let needed: BTreeSet<u32> =
            cut.iter().flat_map(|it| self.pt.needs.of(it.0).iter().map(|need| need.0)).collect();
        let of_places = of_places(by.bounds.iter());
        let bound = |place: PlaceId| of_places.get(&place).copied();
        let bounds: Vec<_> = needed
            .into_iter()
            .map(|it| bound(PlaceId(it)).map(|bound| (it, bound)))
            .collect::<Option<_>>()?;
        let mut nodes = Vec::new();
        let mut bound_at = BTreeMap::new();
        for &(place, bound) in &bounds {
            self.cases.push(Draft::Cut(Linear::new(
                self.pt,
                bound.at_most.checked_neg()?,
                [(place, 1)],
            )));
            bound_at.insert(place, node.assumed);
            nodes.push(node.and());
            node.assumed += 1;
        }
        let mut cut_at = BTreeMap::new();
        let mut inequalities = Vec::new();
        for &transition in &cut {
            let linear = disabled(self.pt, transition, |it| bound(it).map(|it| it.at_most))?;
            let weights = linear.weights.iter().map(|it| (it.0.0, it.1));
            self.cases.push(Draft::Cut(Linear::new(self.pt, linear.constant, weights)));
            cut_at.insert(transition, node.assumed);
            inequalities.push((transition, linear, node.assumed));
            node.assumed += 1;
        }
        let premise = |it: &TransitionId| {
            single.get(it).or_else(|| cut_at.get(it)).copied().unwrap_or(usize::MAX)
        };
        node.premises = by.disabled.iter().map(premise).collect();
        self.refutation(&by.refutation, &node)?;
        for (transition, linear, at) in inequalities.into_iter().rev() {
            self.cases.push(Draft::Split(*node.ors.get(&transition)?));
            for (place, weight) in &linear.weights {
                // The place holds too little, all others at most their bounds.
                let mut assumed = vec![(at, 1), (at + 1, u64::try_from(*weight).ok()?)];
                for (other, weight) in linear.weights.iter().filter(|it| it.0 != *place) {
                    assumed.push((*bound_at.get(&other.0)?, u64::try_from(*weight).ok()?));
                }
                self.cases.push(Draft::Leaf { facts: Vec::new(), assumed });
            }
        }
        let mut others = bounds.iter().zip(&nodes).rev();
        others.try_for_each(|((_, bound), node)| self.refutation(&bound.refutation, node))
    }
}

/// The first bound of each place alone.
fn of_places<'b>(bounds: impl Iterator<Item = &'b Bound>) -> HashMap<PlaceId, &'b Bound> {
    let mut all = HashMap::new();
    for bound in bounds {
        if let [(place, 1)] = bound.weights[..] {
            all.entry(place).or_insert(bound);
        }
    }
    all
}

/// Which assumptions take part.
fn premises(by: &proof::Refutation, used: &mut BTreeSet<usize>) {
    match by {
        proof::Refutation::Sum(sum) => used.extend(sum.premises.iter().map(|it| it.0)),
        proof::Refutation::Tokens { below, above, .. } => {
            premises(below, used);
            premises(above, used);
        }
        proof::Refutation::Disabled { cases, .. } => cases.iter().for_each(|it| premises(it, used)),
    }
}
