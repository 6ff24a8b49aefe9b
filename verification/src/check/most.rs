//! How many tokens places ever hold.

use super::Choice;
use super::Verdict;
use super::auto::{Asked, Shown, half};
use super::engine::{Finding, Found, Reason, Task};
use super::engines::{Coverability, Explicit, Structural};
use super::known::Known;
use super::reduced::Smaller;
use crate::bounds::bounds_within;
use crate::certificate::Evidence;
use crate::explicit::{Limit, Limits};
use crate::property::{Atom, Formula, Linear, Reachability};
use crate::structural;
use crate::temporal::{Rest, Run};
use cotama_core::net::PlaceId;

/// ω-markings of a first look at a net that may be unbounded.
const OMEGAS: u64 = 2_000;

impl Asked<'_, '_> {
    pub(super) fn one_safe(&mut self) -> Shown {
        let pt = self.net.pt();
        if matches!(self.engine, Choice::Auto | Choice::Structural) {
            // What the structure says comes with evidence; sums of places are sooner found.
            if let Some(mut structure) = self.structure()
                && let structural::Answer::Impossible(bounds) = structure.one_safe()
            {
                let evidence = Evidence::one_safe(pt, structure.dead(), &bounds);
                self.used("structural");
                return (Verdict::Holds(true), None, evidence.unwrap_or(Evidence::None));
            }
            let is_one = |it: &Option<u32>| it.is_some_and(|it| it <= 1);
            if bounds_within(pt, &self.budget.limits).is_ok_and(|it| it.iter().all(is_one)) {
                self.used("structural");
                return (Verdict::Holds(true), None, Evidence::None);
            }
        }
        let two =
            |place| Formula::Atom(Atom::AtMost(Linear { constant: 2, weights: vec![(place, -1)] }));
        let goal = Formula::Or((0..pt.places.len() as u32).map(|it| two(PlaceId(it))).collect());
        self.reachability(&Reachability { goal, expected: false })
    }

    pub(super) fn bound(&mut self, places: &[PlaceId]) -> Shown {
        let mut sum = Linear::default();
        for &place in places {
            match sum.weights.binary_search_by_key(&place, |it| it.0) {
                Ok(at) => sum.weights[at].1 += 1,
                Err(at) => sum.weights.insert(at, (place, 1)),
            }
        }
        let found = self.most(&sum);
        match found.found {
            Found::Most(most, way, evidence) => {
                let run = way.map(|stem| Run { stem, rest: Rest::Any });
                (Verdict::Bound(most), run, evidence)
            }
            Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }

    fn most(&mut self, sum: &Linear) -> Finding {
        if self.engine != Choice::Auto {
            return self.chosen(Task::Bound(sum));
        }
        let first = self.ask(&Structural, self.net, Task::Bound(sum), self.budget.limits);
        if first.is_something() {
            return first;
        }
        let pt = self.net.pt();
        let Some(smaller) = Smaller::for_sum(pt, sum, &self.budget.limits) else {
            return self.search_most(self.net, sum);
        };
        let known = Known::new(&smaller.reduced.net);
        self.used("reductions");
        let mut found =
            self.ask(&Structural, &known, Task::Bound(&smaller.sum), self.budget.limits);
        if !found.is_something() {
            found = self.search_most(&known, &smaller.sum);
        }
        if let Found::Most(most, way, _) = found.found {
            let way = way.and_then(|it| smaller.reduced.trail.lift(pt, &it).ok());
            found.found = Found::Most(most, way, Evidence::None);
        }
        found
    }

    /// Of nets that no sum of places bounds, a few ω-markings may tell; else all markings.
    fn search_most(&mut self, net: &Known<'_>, sum: &Linear) -> Finding {
        let limits = self.budget.limits;
        let is_bounded =
            bounds_within(net.pt(), &limits).is_ok_and(|it| it.iter().all(Option::is_some));
        if !is_bounded {
            let few = Limits { states: limits.states.min(OMEGAS), ..half(limits) };
            let found = self.ask(&Coverability, net, Task::Bound(sum), few);
            if found.is_something() {
                return found;
            }
        }
        let found = self.ask(&Explicit, net, Task::Bound(sum), self.budget.limits);
        match found.found {
            Found::Nothing(Reason::Limit(Limit::Unbounded)) => {
                self.ask(&Coverability, net, Task::Bound(sum), self.budget.limits)
            }
            _ => found,
        }
    }
}
