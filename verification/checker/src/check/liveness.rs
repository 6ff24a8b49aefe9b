//! Which transitions never fire.

use super::Verdict;
use super::question::Shown;
use super::strategy::Strategy;
use crate::engines::{Found, Known, Reason, Task};
use cotama_core::net::TransitionId;
use cotama_property::{Atom, Formula};

/// Whether something holds of a net of which these transitions never fire, and all others do.
type Holds<'h> = &'h dyn Fn(&Known<'_>, &[TransitionId]) -> bool;

impl Strategy<'_, '_> {
    /// A question about the transitions that never fire: they are those that are found by the
    /// structure, or all.
    pub(super) fn dead(&mut self, holds: Holds<'_>) -> Shown {
        let net = self.net;
        let none = holds(net, &[]);
        // More dead transitions change neither `yes, there is one` nor `yes, it is stable`.
        let is_enough = |some: &[TransitionId]| holds(net, some) != none;
        match self.solve_until(Task::Dead, &is_enough).found {
            Found::SomeDead(_) => Shown::bare(Verdict::Holds(!none)),
            Found::Dead(dead) => Shown::bare(Verdict::Holds(holds(net, &dead))),
            Found::Nothing(reason) if self.asks_for_ways() => {
                self.dead_one_by_one(none, reason, holds)
            }
            Found::Nothing(reason) => Shown::unknown(reason),
            _ => Shown::unknown(Reason::Unsuited),
        }
    }

    /// Asks for each transition alone; few markings may suffice for most.
    fn dead_one_by_one(&mut self, none: bool, reason: Reason, holds: Holds<'_>) -> Shown {
        let (mut dead, mut open) = (Vec::new(), Vec::new());
        for transition in (0..self.net.pt().transitions.len() as u32).map(TransitionId) {
            let goal = Formula::Atom(Atom::Fireable(vec![transition]));
            match self.solve(Task::Reach(&goal)).found {
                Found::Never(_) => dead.push(transition),
                Found::Path(_) | Found::Reached => {}
                _ => open.push(transition),
            }
            if self.budget.limits.is_over() {
                return Shown::unknown(reason);
            }
        }
        let mut most = [&dead[..], &open[..]].concat();
        most.sort_unstable();
        let (least, most) = (holds(self.net, &dead), holds(self.net, &most));
        if least == most || least != none {
            return Shown::bare(Verdict::Holds(least));
        }
        Shown::unknown(reason)
    }
}
