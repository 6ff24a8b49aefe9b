//! The firing rule, what questions mean, and where formulas hold.

use super::{Checked, Claim, MAX_MEMORY, Marking, Numbered, Question};
use super::{at, each, ensure, error, marking_bytes};
use crate::Formula::{self, All, AllNext, And, AtMost, Exists, ExistsNext, Fireable};
use crate::Formula::{Finally, Globally, Next, Not, Or, Until};
use std::{collections::BTreeMap, rc::Rc, slice::from_ref};

enum Kind {
    Marking,
    Run,
    Graph,
}

/// Markings, and for each of them those that follow.
pub(super) struct Space(Kind, Vec<Rc<Marking>>, Vec<Vec<usize>>);

impl Numbered<'_> {
    /// Returns the question in inequalities; no formula says that there is no bound.
    pub(super) fn meaning(&self, question: &Question) -> Checked<Formula> {
        let (places, transitions) = (self.net.places.iter(), self.net.transitions.iter());
        let fireable = transitions.map(|it| Fireable(vec![it.name.clone()]));
        let (always, reached) = (Formula::always, Formula::reached);
        let (at_least, at_most) = (Formula::at_least, Formula::at_most);
        let stays = |(place, now): &(String, u32)| {
            let (place, now) = (from_ref(place), i64::from(*now));
            always(And(vec![at_least(now, place), at_most(now, place)]))
        };
        self.written_out(&match question {
            Question::Formula(formula) => formula.clone(),
            Question::Bound { places, most } => {
                And(vec![always(at_most(*most, places)), reached(at_least(*most, places))])
            }
            Question::Unbounded { .. } => return Err(error("only growth can show it")),
            Question::Live => And(fireable.map(|it| always(reached(it))).collect()),
            Question::QuasiLive => And(fireable.map(reached).collect()),
            Question::Stable => Or(places.map(stays).collect()),
            Question::OneSafe => {
                always(And(places.map(|it| at_most(1, from_ref(&it.0))).collect()))
            }
        })
    }

    /// Whether a transition could fire if no other one went before it.
    fn is_ready(&self, at: &Marking, transition: usize) -> Checked<bool> {
        let (take, inhibit) = (&self.arcs[transition][0], &self.special[transition].0);
        let met = take.iter().take_while(|it| at[*it.0] >= *it.1).count();
        let free = inhibit.iter().all(|it| at[*it.0] < *it.1);
        self.spend(1 + met + inhibit.len()).map(|()| met == take.len() && free)
    }

    fn enabled(&self, at: &Marking, transition: usize) -> Checked<bool> {
        self.spend(if self.is_plain { 0 } else { self.arcs.len() })?;
        let mut others = self.going_first(transition);
        Ok(self.is_ready(at, transition)?
            && others.try_fold(true, |none, it| Ok(none && !self.is_ready(at, it)?))?)
    }

    /// The marking after a transition that is enabled.
    fn fire(&self, from: &Marking, transition: usize) -> Checked<Marking> {
        let ([take, give], mut after) = (&self.arcs[transition], from.clone());
        self.spend(4 * from.len() + give.len())?;
        for (place, weight) in take {
            after[*place] -= weight;
        }
        for place in &self.special[transition].1 {
            after[*place] = 0;
        }
        for (place, weight) in give {
            let sum = after[*place].checked_add(*weight);
            after[*place] = sum.ok_or_else(|| error("numbers get too large"))?;
        }
        Ok(after)
    }

    /// The markings before each of these firings, and the one after all of them.
    pub(super) fn path(
        &self,
        from: &Marking,
        names: &[String],
    ) -> Checked<(Vec<Marking>, Marking)> {
        let mut now = from.clone();
        let way = each(names, |name| {
            let transition = self.transition(name)?;
            ensure(self.enabled(&now, transition)?, format_args!("`{name}` is not enabled"))?;
            let after = self.fire(&now, transition)?;
            self.hold(marking_bytes(now.len()))?;
            Ok(std::mem::replace(&mut now, after))
        })?;
        Ok((way, now))
    }

    /// The run: the last marking leads back to the end of the stem, a deadlock to itself.
    pub(super) fn run(&self, from: &Marking, lasso: &crate::Lasso) -> Checked<Space> {
        let (mut run, start) = self.path(from, &lasso.stem).map_err(at(".stem"))?;
        let (cycle, end) = self.path(&start, &lasso.cycle).map_err(at(".loop"))?;
        let dead = || self.graph(&start, 1).is_ok_and(|it| it.2[0].is_empty());
        let lasts = if cycle.is_empty() { dead() } else { start == end };
        ensure(lasts, "does not lead back, or is empty where there is no deadlock")
            .map_err(at(".loop"))?;
        let back = run.len();
        run.extend(if cycle.is_empty() { vec![start] } else { cycle });
        let next = (1..run.len()).chain([back]).map(|it| vec![it]).collect();
        Ok(Space(Kind::Run, run.into_iter().map(Rc::new).collect(), next))
    }

    /// All markings that are reachable from here, which is the first one.
    pub(super) fn graph(&self, from: &Marking, count: usize) -> Checked<Space> {
        // So many take so much at least, which is known before any is passed through.
        let least = count.saturating_mul(marking_bytes(from.len()));
        ensure(least as u64 <= MAX_MEMORY, "takes too much memory to check")?;
        let (mut markings, mut next) = (vec![Rc::new(from.clone())], Vec::new());
        let mut numbers = BTreeMap::from([(Rc::clone(&markings[0]), 0)]);
        while next.len() < markings.len() {
            let (now, mut after) = (Rc::clone(&markings[next.len()]), Vec::new());
            for transition in 0..self.arcs.len() {
                if self.enabled(&now, transition)? {
                    let reached = Rc::new(self.fire(&now, transition)?);
                    let number = *numbers.entry(Rc::clone(&reached)).or_insert(markings.len());
                    let is_new = number == markings.len();
                    self.hold(16 + if is_new { marking_bytes(from.len()) } else { 0 })?;
                    markings.extend(is_new.then_some(reached));
                    after.push(number);
                }
            }
            ensure(markings.len() <= count, "there are more markings")?;
            next.push(after);
        }
        ensure(markings.len() == count, "there are fewer markings")?;
        Ok(Space(Kind::Graph, markings, next))
    }

    /// Checks that the claim, which is about one marking, is true at this one.
    pub(super) fn holds(&self, at: &Marking, claim: Claim<'_>) -> Checked<()> {
        self.shows(&Space(Kind::Marking, vec![Rc::new(at.clone())], Vec::new()), claim)
    }

    /// Checks that the claim is true at the first marking, or of the run from there.
    pub(super) fn shows(&self, space: &Space, (formula, truth): Claim<'_>) -> Checked<()> {
        ensure(self.label(space, formula)?[0] == truth, "the opposite of what is claimed is so")
    }

    /// Returns the truth of a formula at each marking.
    fn label(&self, space: &Space, formula: &Formula) -> Checked<Vec<bool>> {
        let Space(kind, markings, next) = space;
        let every = matches!(formula, And(_) | All(_) | AllNext(_));
        self.spend(1 + markings.len())?;
        match (formula, kind) {
            (AtMost(linear), _) => {
                let sum = self.linear(linear)?;
                self.spend(markings.len() * sum.0.len())?;
                Ok(markings.iter().map(|it| sum.value(it) <= 0).collect())
            }
            (Not(a), _) => Ok(self.label(space, a)?.iter().map(|it| !it).collect()),
            (And(parts) | Or(parts), _) => {
                parts.iter().try_fold(vec![every; markings.len()], |so_far, it| {
                    let both = so_far.into_iter().zip(self.label(space, it)?);
                    Ok(both.map(|(a, b)| if every { a && b } else { a || b }).collect())
                })
            }
            (Next(a), Kind::Run) | (ExistsNext(a) | AllNext(a), Kind::Graph) => {
                let a = self.label(space, a)?;
                let leads = |next: &Vec<usize>| {
                    if every { next.iter().all(|it| a[*it]) } else { next.iter().any(|it| a[*it]) }
                };
                Ok(next.iter().map(leads).collect())
            }
            (Finally(_) | Globally(_) | Until(_), Kind::Run) => self.on_runs(space, formula, false),
            (Exists(path) | All(path), Kind::Graph) => self.on_runs(space, path, every),
            _ => Err(error("speaks of runs where one marking is to decide")),
        }
    }

    /// Returns for each marking whether a path formula holds of every run from there, or of some
    /// run.
    fn on_runs(&self, space: &Space, path: &Formula, every: bool) -> Checked<Vec<bool>> {
        let not = |it: Vec<bool>| it.into_iter().map(|it| !it).collect::<Vec<_>>();
        let (label, anywhere) = (|it| self.label(space, it), vec![true; space.1.len()]);
        match path {
            Not(path) => self.on_runs(space, path, !every).map(not),
            Finally(a) => self.until(space, [anywhere, label(a)?], every),
            Globally(a) => self.until(space, [anywhere, not(label(a)?)], !every).map(not),
            Until(both) => self.until(space, [label(&both.0)?, label(&both.1)?], every),
            _ => Err(error("is not of CTL")),
        }
    }

    /// Returns the truth of an until: the first holds until the second does, which comes; backwards
    /// from the second.
    fn until(&self, space: &Space, both: [Vec<bool>; 2], every: bool) -> Checked<Vec<bool>> {
        let [first, mut until] = both;
        let mut before = vec![Vec::new(); until.len()];
        for (from, next) in space.2.iter().enumerate() {
            for to in next {
                before[*to].push(from);
            }
        }
        let mut open: Vec<usize> = (0..until.len()).filter(|it| until[*it]).collect();
        while let Some(to) = open.pop() {
            for &from in &before[to] {
                self.spend(1 + space.2[from].len())?;
                let leads = !every || space.2[from].iter().all(|it| until[*it]);
                if first[from] && leads && !until[from] {
                    until[from] = true;
                    open.push(from);
                }
            }
        }
        Ok(until)
    }
}
