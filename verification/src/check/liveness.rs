//! Which transitions can fire, and whether they always can again.

use super::Choice;
use super::Verdict;
use super::auto::{Asked, Shown};
use super::engine::{Engine, Found, Reason, Task};
use super::engines::{Coverability, Explicit, Structural};
use super::known::Known;
use crate::certificate::Evidence;
use crate::explicit::Limit;
use crate::property::{Atom, Formula};
use crate::structural;
use crate::temporal::{Rest, Run};
use cotama_core::net::TransitionId;

impl Asked<'_, '_> {
    /// A question about the transitions that never fire: they are those that are found by the
    /// structure, or all.
    pub(super) fn dead(&mut self, holds: impl Fn(&Known<'_>, &[TransitionId]) -> bool) -> Shown {
        let none = holds(self.net, &[]);
        if self.engine == Choice::Auto || self.engine == Choice::Structural {
            let some = self.found_dead();
            // More dead transitions change neither `yes, there is one` nor `yes, it is stable`.
            if holds(self.net, &some) != none {
                self.used("structural");
                return (Verdict::Holds(!none), None, Evidence::None);
            }
        }
        let engine: &dyn Engine =
            if self.engine == Choice::Structural { &Structural } else { &Explicit };
        let mut found = self.ask(engine, self.net, Task::Dead, self.budget.limits);
        if matches!(found.found, Found::Nothing(Reason::Limit(Limit::Unbounded))) {
            found = self.ask(&Coverability, self.net, Task::Dead, self.budget.limits);
        }
        match found.found {
            Found::Dead(dead, evidence) => (Verdict::Holds(holds(self.net, &dead)), None, evidence),
            Found::Nothing(reason) if self.engine == Choice::Auto => {
                self.dead_one_by_one(none, reason, &holds)
            }
            Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }

    /// Transitions of which the structure shows that they never fire.
    fn found_dead(&self) -> Vec<TransitionId> {
        let Some(mut structure) = self.structure() else { return Vec::new() };
        structure.find_dead_transitions();
        structure.dead().transitions.clone()
    }

    /// Asks for each transition alone; few markings may suffice for most.
    fn dead_one_by_one(
        &mut self,
        none: bool,
        reason: Reason,
        holds: &impl Fn(&Known<'_>, &[TransitionId]) -> bool,
    ) -> Shown {
        let mut dead = Vec::new();
        let mut open = Vec::new();
        for transition in (0..self.net.pt().transitions.len() as u32).map(TransitionId) {
            match self.reach(&Formula::Atom(Atom::Fireable(vec![transition]))).found {
                Found::Never(_) => dead.push(transition),
                Found::Way(_) | Found::Reached => {}
                _ => open.push(transition),
            }
            if self.budget.limits.is_over() {
                return (Verdict::Unknown(reason), None, Evidence::None);
            }
        }
        let mut most = [&dead[..], &open[..]].concat();
        most.sort_unstable();
        let (least, most) = (holds(self.net, &dead), holds(self.net, &most));
        if least == most || least != none {
            return (Verdict::Holds(least), None, Evidence::None);
        }
        (Verdict::Unknown(reason), None, Evidence::None)
    }

    pub(super) fn live(&mut self) -> Shown {
        let pt = self.net.pt();
        if self.engine == Choice::Auto && !pt.transitions.is_empty() {
            if !self.found_dead().is_empty() {
                self.used("structural");
                return (Verdict::Holds(false), None, Evidence::None);
            }
            let deadlock = Formula::Atom(Atom::Deadlock);
            let found = self.ask(&Structural, self.net, Task::Reach(&deadlock), self.budget.limits);
            if let Found::Way(stem) = found.found {
                return (
                    Verdict::Holds(false),
                    Some(Run { stem, rest: Rest::Stays }),
                    Evidence::None,
                );
            }
            let limits = structural::Limits::within(&self.budget.limits);
            let bytes = self.budget.limits.bytes / 2;
            let siphons = structural::minimal_siphons_within(pt, 10_000, limits, bytes);
            if let Some(live) = structural::commoner(pt, &siphons).live {
                self.used("structural");
                return (Verdict::Holds(live), None, Evidence::None);
            }
        }
        let engine: &dyn Engine =
            if self.engine == Choice::Structural { &Structural } else { &Explicit };
        match self.ask(engine, self.net, Task::Live, self.budget.limits).found {
            Found::Holds(holds, run, evidence) => (Verdict::Holds(holds), run, evidence),
            Found::Nothing(reason) => (Verdict::Unknown(reason), None, Evidence::None),
            _ => (Verdict::Unknown(Reason::Unsuited), None, Evidence::None),
        }
    }
}
