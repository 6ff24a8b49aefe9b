//! Looks for a marking that satisfies assumptions and the state equation, in whole tokens, or
//! proves that none is reachable.

use super::certificate::{Refutation, at_least, at_most, fewer, holds_at_start};
use super::program::Program;
use super::siphon::Graph;
use super::work::{Cost, Work};
use super::{Limit, Unknown};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::Linear;
use cotama_property::pt::Pt;

/// How deep cases may be nested.
const DEPTH: u32 = 256;

/// One question while it is worked on.
#[derive(Debug)]
pub(super) struct Search<'s> {
    pub(super) graph: &'s Graph<'s>,
    /// The assumptions: the goal, then the case that is looked at.
    pub(super) premises: Vec<Linear>,
    /// For a dead marking: the transitions that no assumption disables yet.
    pub(super) undecided: Vec<TransitionId>,
    /// Whether the marking is dead.
    pub(super) dead: bool,
    pub(super) work: Work,
    pub(super) nodes: u32,
    /// How many more cases may be nested.
    depth: u32,
}

/// Why there is no refutation.
#[derive(Debug)]
pub(super) enum End {
    /// A firing sequence leads to a marking that satisfies everything.
    Reached(Vec<TransitionId>),
    Unknown(Unknown),
}

impl From<Limit> for End {
    fn from(limit: Limit) -> Self {
        Self::Unknown(Unknown::Limit(limit))
    }
}

impl<'s> Search<'s> {
    pub(super) fn new(graph: &'s Graph<'s>, goal: &[Linear], cost: Cost) -> Self {
        Self {
            graph,
            premises: goal.to_vec(),
            undecided: Vec::new(),
            dead: false,
            work: cost.into(),
            nodes: cost.nodes,
            depth: DEPTH,
        }
    }

    /// The same question within other limits.
    pub(super) fn within(&self, cost: Cost) -> Self {
        let undecided = self.undecided.clone();
        Self { undecided, dead: self.dead, ..Self::new(self.graph, &self.premises, cost) }
    }

    /// Refutes all that is assumed. The program knows only the state equation and traps.
    pub(super) fn run(&mut self, base: &Program) -> Result<Refutation, End> {
        let mut program = base.copied(&mut self.work)?;
        for (at, premise) in self.premises.iter().enumerate() {
            program.assume(at, premise, &mut self.work)?;
        }
        self.solve(program)
    }

    fn pt(&self) -> &'s Pt {
        self.graph.pt
    }

    fn solve(&mut self, mut program: Program) -> Result<Refutation, End> {
        self.nodes = self.nodes.checked_sub(1).ok_or(Limit::Work)?;
        self.depth = self.depth.checked_sub(1).ok_or(Limit::Work)?;
        loop {
            if let Some(sum) = program.satisfy(&self.premises, &mut self.work)? {
                return Ok(Refutation::Sum(sum));
            }
            let empty =
                (0..self.pt().places.len() as u32).map(|it| program.tokens(it).0 == 0).collect();
            match self.graph.marked_trap(empty, &mut self.work)? {
                Some(trap) => program.mark(trap, &mut self.work)?,
                None => break,
            }
        }
        let below = |place, need: u32| {
            let (numerator, denominator) = program.tokens(place);
            i128::from(numerator) <= (i128::from(need) - 1) * i128::from(denominator)
        };
        let enabled = self.undecided.iter().position(|it| {
            !self.pt().needs.of(it.0).iter().any(|&(place, need)| below(place, need))
        });
        if let Some(at) = enabled {
            let transition = self.undecided.swap_remove(at);
            let needs = self.pt().needs.of(transition.0).iter();
            let cases = needs.map(|&(place, need)| self.case(&program, fewer(place, need)));
            let cases = cases.collect::<Result<_, _>>()?;
            self.undecided.push(transition);
            return Ok(Refutation::Disabled { transition, cases });
        }
        let fraction = (0..self.pt().places.len() as u32).find_map(|place| {
            let (numerator, denominator) = program.tokens(place);
            (numerator % denominator != 0).then_some((place, numerator / denominator))
        });
        let Some((place, at)) = fraction else { return Err(self.candidate(&program)) };
        let at = u32::try_from(at).map_err(|_| Limit::Tokens)?;
        let place = PlaceId(place);
        let below = Box::new(self.case(&program, at_most(place, at))?);
        let above = Box::new(self.case(&program, at_least(place, i64::from(at) + 1))?);
        Ok(Refutation::Tokens { place, at, below, above })
    }

    fn case(&mut self, base: &Program, premise: Linear) -> Result<Refutation, End> {
        let mut program = base.copied(&mut self.work)?;
        program.assume(self.premises.len(), &premise, &mut self.work)?;
        self.premises.push(premise);
        let refutation = self.solve(program);
        self.depth += 1;
        self.premises.pop();
        refutation
    }

    /// A point in whole tokens satisfies everything: fires what it says, whenever possible.
    fn candidate(&self, program: &Program) -> End {
        let pt = self.pt();
        let tokens = (0..pt.places.len() as u32).map(|it| u32::try_from(program.tokens(it).0));
        let Ok(marking) = tokens.collect::<Result<Vec<_>, _>>() else {
            return Limit::Tokens.into();
        };
        let trace = program.firings().and_then(|it| self.fire(it)).filter(|trace| {
            let after = trace.iter().try_fold(pt.initial.clone(), |now, it| pt.fire(&now, it.0));
            let moved = after.map(|initial| Pt { initial, ..pt.clone() });
            moved.is_some_and(|it| {
                let any = || (0..it.transitions.len() as u32).any(|at| it.enabled(&it.initial, at));
                holds_at_start(&it, &self.premises) && !(self.dead && any())
            })
        });
        trace.map_or(End::Unknown(Unknown::Candidate(marking)), End::Reached)
    }

    fn fire(&self, mut firings: Vec<(TransitionId, u64)>) -> Option<Vec<TransitionId>> {
        let pt = self.pt();
        let mut marking = pt.initial.clone();
        let mut trace = Vec::new();
        let total = firings.iter().try_fold(0_u64, |sum, it| sum.checked_add(it.1))?;
        if total.checked_mul(pt.places.len() as u64 + 1)? > self.work.left {
            return None;
        }
        // Transitions with the same effect may need different tokens.
        let alike = |it: TransitionId| {
            let place = pt.effects.of(it.0).first().map_or(0, |it| it.0);
            let others = pt.changers.of(place).iter().map(|it| it.0);
            others.filter(move |&other| pt.effects.of(other) == pt.effects.of(it.0))
        };
        let mut fired = true;
        while std::mem::take(&mut fired) {
            for (transition, left) in firings.iter_mut().filter(|it| it.1 > 0) {
                let Some(now) = alike(*transition).find(|&it| pt.enabled(&marking, it)) else {
                    continue;
                };
                marking = pt.fire(&marking, now)?;
                trace.push(TransitionId(now));
                *left -= 1;
                fired = true;
            }
        }
        (trace.len() as u64 == total).then_some(trace)
    }
}
