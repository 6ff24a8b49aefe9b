//! Questions to the structure of a net, and their proofs.

use super::certificate::{
    self, Bound, DeadTransitions, DeadlockFree, Refutation, above, disabled, needs,
};
use super::program::Program;
use super::search::{End, Search};
use super::siphon::Graph;
use super::work::{Cost, Work};
use super::{Answer, Effort, Limit, Limits, Unknown};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_property::Linear;
use cotama_property::pt::Pt;
use std::sync::Arc;

/// A net, and what is known of its structure so far.
///
/// Each question has its own effort. Proofs lean on [`Structure::dead`] as it is when the proof
/// is made; it only grows with [`Structure::find_dead_transitions`], and earlier proofs stay valid.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::pt::Pt;
/// use cotama_checker::structural::{Answer, Limits, Structure};
///
/// let mut net = OwnedNet::new("mutex", "Two work, one tool.");
/// let tool = net.place(OwnedPlace::new("tool", 1)).unwrap();
/// for name in ["a", "b"] {
///     let idle = net.place(OwnedPlace::new(&format!("{name} idle"), 1)).unwrap();
///     let busy = net.place(OwnedPlace::new(&format!("{name} busy"), 0)).unwrap();
///     net.transition(
///         OwnedTransition::new(&format!("{name} takes"))
///             .take(idle, 1)
///             .take(tool, 1)
///             .give(busy, 1),
///     )
///     .unwrap();
///     net.transition(
///         OwnedTransition::new(&format!("{name} gives"))
///             .take(busy, 1)
///             .give(idle, 1)
///             .give(tool, 1),
///     )
///     .unwrap();
/// }
/// let net = Pt::from(&net.view().net());
/// let mut structure = Structure::new(&net, &Limits::default());
/// let both = [(net.place("a busy").unwrap(), 1), (net.place("b busy").unwrap(), 1)];
/// let bound = structure.upper_bound(&both).unwrap();
/// assert_eq!(bound.at_most, 1);
/// assert!(bound.holds(&net, structure.dead()));
/// assert!(matches!(structure.one_safe(), Answer::Impossible(_)));
/// let Answer::Impossible(proof) = structure.deadlock() else { panic!("not proved") };
/// assert!(proof.holds(&net, structure.dead()));
/// ```
#[derive(Debug)]
pub struct Structure<'a> {
    pt: &'a Pt,
    cost: Cost,
    dead: DeadTransitions,
    /// The programs of place invariants alone, and of the state equation.
    programs: [Result<Program, Limit>; 2],
    graph: Graph<'a>,
    bounds: Option<Vec<Option<Bound>>>,
    /// Which limit ended something that is kept.
    cut: Option<Limit>,
}

impl<'a> Structure<'a> {
    /// Looks at a net; finds the transitions that can never fire because a place never gets what
    /// they need.
    pub fn new(pt: &'a Pt, limits: &Limits) -> Self {
        Self::with_effort(pt, limits, Effort::default())
    }

    /// The same with another effort.
    pub fn with_effort(pt: &'a Pt, limits: &Limits, effort: Effort) -> Self {
        let cost = Cost::new(effort, limits);
        let dead = DeadTransitions { transitions: starved(pt, &[]), refutations: Vec::new() };
        let graph = Graph::new(pt, &dead);
        let programs = Self::programs(pt, &dead, cost);
        let mut structure = Self { pt, cost, dead, programs, graph, bounds: None, cut: None };
        structure.note_cut();
        structure
    }

    /// The same within other limits, with the usual effort; `None` when that is more than what it
    /// owes its gaps to.
    pub(crate) fn within(self, limits: &Limits) -> Option<Self> {
        let cost = Cost::new(Effort::default(), limits);
        let later =
            self.cost.deadline.is_some_and(|before| cost.deadline.is_none_or(|now| now > before));
        let is_owed = match self.cut {
            Some(Limit::Time) => later,
            Some(Limit::Work) => cost.work > self.cost.work,
            _ => false,
        };
        (!is_owed).then_some(Self { cost, ..self })
    }

    fn note_cut(&mut self) {
        let mut stops = self.programs.iter().filter_map(|it| it.as_ref().err().copied());
        self.cut = stops.rfind(|it| matches!(it, Limit::Work | Limit::Time)).or(self.cut);
    }

    fn programs(pt: &Pt, dead: &DeadTransitions, cost: Cost) -> [Result<Program, Limit>; 2] {
        let small = Program::invariants(pt, |it| dead.can_fire(it), cost.into());
        [small, Program::new(pt, |it| dead.can_fire(it), &mut cost.into())]
    }

    /// The transitions that are known never to fire, with the proof.
    pub const fn dead(&self) -> &DeadTransitions {
        &self.dead
    }

    /// Whether a marking that satisfies all of these inequalities is reachable.
    pub fn reach(&self, goal: &[Linear]) -> Answer<Refutation> {
        if certificate::holds_at_start(self.pt, goal) {
            return Answer::Reachable(Vec::new());
        }
        let answer = self.answer(Search::new(&self.graph, goal, self.cost));
        debug_assert!(answer.is_proved(self.pt, &self.dead, goal), "a proof is one to others");
        answer
    }

    /// Asks the small program, which often suffices, then the large one.
    fn run(&self, search: &mut Search<'_>) -> Result<Refutation, End> {
        let [small, large] = &self.programs;
        if let Ok(small) = small {
            let share = search.work.left / 4;
            let mut first =
                search.within(Cost { work: share, nodes: search.nodes.min(16), ..self.cost });
            let found = first.run(small);
            search.work.left -= share - first.work.left;
            match found {
                Err(End::Unknown(Unknown::Limit(Limit::Time))) | Ok(_) => return found,
                Err(_) => {}
            }
        }
        search.run(large.as_ref().map_err(|&it| End::from(it))?)
    }

    fn answer(&self, mut search: Search<'_>) -> Answer<Refutation> {
        match self.run(&mut search) {
            Ok(refutation) => Answer::Impossible(refutation),
            Err(End::Reached(trace)) => Answer::Reachable(trace),
            Err(End::Unknown(unknown)) => Answer::Unknown(unknown),
        }
    }

    /// The least number found that a weighted sum of tokens never exceeds; `None` when none was
    /// found.
    pub fn upper_bound(&mut self, weights: &[(PlaceId, i64)]) -> Option<Bound> {
        let share = self.cost.work / 4;
        let mut work = Work::from(self.cost).with(2 * share);
        let large = self.relaxed_bound(1, weights, &mut work);
        work.left += share;
        let mut bound = large.or_else(|_| self.relaxed_bound(0, weights, &mut work)).ok()??;
        let mut left = Cost { work: work.left + share, ..self.cost };
        // The bound may be due to fractions of tokens: is it reached in whole ones?
        while let Some(at_most) = bound.at_most.checked_sub(1) {
            let goal: Vec<_> = above(weights, at_most).into_iter().collect();
            if goal.is_empty() || certificate::holds_at_start(self.pt, &goal) {
                break;
            }
            let mut search = Search::new(&self.graph, &goal, left);
            let Ok(refutation) = self.run(&mut search) else { break };
            bound = Bound { at_most, refutation, ..bound };
            left = Cost { work: search.work.left, nodes: search.nodes, ..left };
        }
        Some(bound)
    }

    /// The bound by the state equation and traps, in fractions of tokens.
    fn relaxed_bound(
        &mut self,
        program_at: usize,
        weights: &[(PlaceId, i64)],
        work: &mut Work,
    ) -> Result<Option<Bound>, Limit> {
        let mut program = self.programs[program_at].as_ref().map_err(|&it| it)?.copied(work)?;
        loop {
            let Some((at_most, sum)) = program.maximise(weights, work)? else { return Ok(None) };
            let empty =
                (0..self.pt.places.len() as u32).map(|it| program.tokens(it).0 == 0).collect();
            let Some(trap) = self.graph.marked_trap(empty, work)? else {
                self.programs[program_at] = Ok(program);
                let refutation = Refutation::Sum(sum);
                return Ok(Some(Bound { weights: weights.to_vec(), at_most, refutation }));
            };
            program.mark(trap, work)?;
            program.satisfy(&[], work)?;
        }
    }

    /// For each place the most tokens that it can hold; `None` where no bound was found.
    pub fn bounds(&mut self) -> &[Option<Bound>] {
        if self.bounds.is_none() {
            self.bounds = Some(self.find_bounds());
        }
        self.bounds.as_deref().unwrap_or_default()
    }

    fn find_bounds(&mut self) -> Vec<Option<Bound>> {
        let mut bounds: Vec<Option<Bound>> = vec![None; self.pt.places.len()];
        let all = Work::from(self.cost);
        let (few, work) = (all.with(all.left / 4), all);
        self.improve(0, &mut bounds, few, |_| true);
        self.improve(1, &mut bounds, work, Option::is_none);
        self.improve(1, &mut bounds, few, |_| true);
        bounds
    }

    /// Improves the bounds that one program can improve, of the places asked for.
    fn improve(
        &mut self,
        program: usize,
        bounds: &mut [Option<Bound>],
        mut work: Work,
        wanted: impl Fn(&Option<Bound>) -> bool,
    ) {
        // The most tokens in a point of the program: it proves no smaller bound.
        let mut seen: Vec<i64> = self.pt.initial.iter().map(|&it| it.into()).collect();
        for place in 0..bounds.len() {
            if !wanted(&bounds[place])
                || bounds[place].as_ref().is_some_and(|it| it.at_most <= seen[place])
            {
                continue;
            }
            let found = match self.relaxed_bound(program, &[(PlaceId(place as u32), 1)], &mut work)
            {
                Ok(found) => found,
                Err(Limit::Tokens) => None,
                Err(stop) => {
                    if stop == Limit::Time {
                        self.cut = Some(stop);
                    }
                    return;
                }
            };
            if work.pass(bounds.len()).is_err() {
                return;
            }
            for (seen, place) in seen.iter_mut().zip(0..) {
                if let Ok((numerator, denominator)) =
                    self.programs[program].as_ref().map(|it| it.tokens(place))
                {
                    *seen = (*seen).max(numerator / denominator);
                }
            }
            let Some(bound) = found else { continue };
            improved(bounds, &bound);
            let known = &mut bounds[place];
            if known.as_ref().is_none_or(|it| it.at_most > bound.at_most) {
                *known = Some(bound);
            }
        }
    }

    /// Whether a marking with two tokens in one place is reachable; the proof has a bound of each
    /// place.
    pub fn one_safe(&mut self) -> Answer<Vec<Bound>> {
        if self.pt.initial.iter().any(|&it| it > 1) {
            return Answer::Reachable(Vec::new());
        }
        let mut proof = Vec::new();
        let mut unknown = None;
        let mut left = self.cost;
        for (bound, place) in self.bounds().to_vec().into_iter().zip(0..) {
            if let Some(bound) = bound.filter(|it| it.at_most <= 1) {
                proof.push(bound);
                continue;
            }
            let weights = vec![(PlaceId(place), 1)];
            let premise = Linear { constant: 2, weights: vec![(PlaceId(place), -1)] };
            let mut search = Search::new(&self.graph, &[premise], left);
            match self.run(&mut search) {
                Ok(refutation) => proof.push(Bound { weights, at_most: 1, refutation }),
                Err(End::Reached(trace)) => return Answer::Reachable(trace),
                Err(End::Unknown(it @ Unknown::Limit(Limit::Time))) => return Answer::Unknown(it),
                Err(End::Unknown(it)) => unknown = unknown.or(Some(it)),
            }
            left = Cost { work: search.work.left, nodes: search.nodes, ..left };
        }
        unknown.map_or(Answer::Impossible(proof), Answer::Unknown)
    }

    /// Whether a dead marking is reachable. May look for dead transitions.
    pub fn deadlock(&mut self) -> Answer<DeadlockFree> {
        let known = self.dead.transitions.len();
        match self.dead_marking() {
            Answer::Unknown(Unknown::Candidate(marking)) => {
                self.find_dead_transitions();
                if self.dead.transitions.len() > known {
                    return self.dead_marking();
                }
                Answer::Unknown(Unknown::Candidate(marking))
            }
            answer => answer,
        }
    }

    fn dead_marking(&mut self) -> Answer<DeadlockFree> {
        let known = self.bounds().to_vec();
        let bound = |place: PlaceId| known.get(place.0 as usize)?.as_ref().map(|it| it.at_most);
        let minimal = self.weakest();
        let (mut assumed, mut premises, mut undecided) = (Vec::new(), Vec::new(), Vec::new());
        for transition in minimal {
            match disabled(self.pt, transition, bound) {
                Some(premise) => {
                    assumed.push(transition);
                    premises.push(premise);
                }
                None => undecided.push(transition),
            }
        }
        let mut search = Search::new(&self.graph, &premises, self.cost);
        (search.undecided, search.dead) = (undecided, true);
        self.answer(search).map(|refutation| {
            let used = |place: &PlaceId| {
                assumed.iter().any(|it| {
                    let needs = self.pt.needs.of(it.0);
                    needs.len() > 1 && needs.iter().any(|need| need.0 == place.0)
                })
            };
            let bounds = known
                .into_iter()
                .flatten()
                .filter(|it| it.weights.iter().any(|(place, _)| used(place)));
            DeadlockFree { bounds: bounds.collect(), disabled: assumed, refutation }
        })
    }

    /// The transitions that can fire, without those that need all that another one needs: they are
    /// disabled with it.
    fn weakest(&self) -> Vec<TransitionId> {
        let pt = self.pt;
        let within = |a: u32, b: u32| {
            pt.needs.of(a).iter().all(|&(place, need)| {
                pt.needs.of(b).iter().any(|&(other, most)| other == place && need <= most)
            })
        };
        let mut kept: Vec<u32> = (0..pt.transitions.len() as u32)
            .filter(|&it| self.dead.can_fire(TransitionId(it)))
            .collect();
        if let Some(&free) = kept.iter().find(|&&it| pt.needs.of(it).is_empty()) {
            return vec![TransitionId(free)];
        }
        let all = kept.clone();
        let alive = |it: u32| all.binary_search(&it).is_ok();
        kept.retain(|&transition| {
            let rivals = pt.needs.of(transition).iter().flat_map(|need| pt.consumers.of(need.0));
            !rivals.map(|it| it.0).any(|rival| {
                rival != transition
                    && alive(rival)
                    && pt.needs.of(rival).len() <= pt.needs.of(transition).len()
                    && within(rival, transition)
                    && (rival < transition || !within(transition, rival))
            })
        });
        kept.into_iter().map(TransitionId).collect()
    }

    /// Looks for more transitions that can never fire. Those found are in [`Structure::dead`]; the
    /// other questions are answered better afterwards.
    pub fn find_dead_transitions(&mut self) {
        let mut left = self.cost;
        let mut found = Vec::new();
        let bounds: Vec<_> =
            self.bounds().iter().map(|it| it.as_ref().map(|it| it.at_most)).collect();
        for transition in (0..self.pt.transitions.len() as u32).map(TransitionId) {
            if !self.dead.can_fire(transition) || self.pt.enabled(&self.pt.initial, transition.0) {
                continue;
            }
            let goal = needs(self.pt, transition);
            // Single needs within single bounds say nothing: only several together can contradict.
            let plain = |&(place, need): &(u32, u32)| {
                bounds[place as usize].is_none_or(|it| it >= need.into())
            };
            if goal.len() == 1 && self.pt.needs.of(transition.0).iter().all(plain) {
                continue;
            }
            let mut search = Search::new(&self.graph, &goal, left);
            match self.run(&mut search) {
                Ok(refutation) => found.push((transition, refutation)),
                Err(End::Unknown(Unknown::Limit(Limit::Work | Limit::Time))) => break,
                Err(_) => {}
            }
            left = Cost { work: search.work.left, nodes: search.nodes, ..left };
        }
        if found.is_empty() {
            return;
        }
        let unable: Vec<_> =
            self.dead.transitions.iter().copied().chain(found.iter().map(|it| it.0)).collect();
        self.dead.transitions = starved(self.pt, &unable);
        self.dead.refutations.extend(found);
        self.dead.refutations.sort_by_key(|it| it.0);
        self.programs = Self::programs(self.pt, &self.dead, self.cost);
        self.note_cut();
        self.graph = Graph::new(self.pt, &self.dead);
        self.bounds = None;
    }
}

/// Improves the bounds of places by the invariant behind a bound, if its proof is that simple.
fn improved(bounds: &mut [Option<Bound>], by: &Bound) {
    let Refutation::Sum(sum) = &by.refutation else { return };
    if !sum.traps.is_empty() || sum.invariant.weights.iter().any(|it| it.1 < 0) {
        return;
    }
    for &(place, weight) in &sum.invariant.weights {
        let Ok(at_most) = i64::try_from(sum.invariant.constant / weight) else { continue };
        let known = &mut bounds[place.0 as usize];
        if known.as_ref().is_some_and(|it| it.at_most <= at_most) {
            continue;
        }
        let invariant = Arc::clone(&sum.invariant);
        let sum = certificate::Sum { premises: vec![(0, weight)], traps: Vec::new(), invariant };
        let weights = vec![(place, 1)];
        *known = Some(Bound { weights, at_most, refutation: Refutation::Sum(sum) });
    }
}

/// The transitions that need more of a place than it has at the start, while no others but such
/// transitions, and those given, add tokens to it.
fn starved(pt: &Pt, unable: &[TransitionId]) -> Vec<TransitionId> {
    let mut fires = vec![false; pt.transitions.len()];
    let mut grows = vec![false; pt.places.len()];
    let fed = |grows: &[bool], transition: u32| {
        let mut needs = pt.needs.of(transition).iter();
        needs.all(|&(place, need)| grows[place as usize] || pt.initial[place as usize] >= need)
    };
    let mut open: Vec<u32> = (0..fires.len() as u32).filter(|&it| fed(&grows, it)).collect();
    while let Some(transition) = open.pop() {
        if unable.contains(&TransitionId(transition))
            || std::mem::replace(&mut fires[transition as usize], true)
        {
            continue;
        }
        for &(place, by) in pt.effects.of(transition) {
            if by > 0 && !std::mem::replace(&mut grows[place as usize], true) {
                open.extend(
                    pt.consumers.of(place).iter().map(|it| it.0).filter(|&it| fed(&grows, it)),
                );
            }
        }
    }
    (0..fires.len() as u32).filter(|&it| !fires[it as usize]).map(TransitionId).collect()
}
