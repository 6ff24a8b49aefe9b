//! Among coalitions of equal cost, the one whose least reliable member is most reliable (4.5.4).

use crate::fleet::bid::{Member, Offer, Share};
use cotama_core::team::Combine;
use cotama_models::team::Probability;
use cotama_models::team::scenario::Scenario;
use std::cmp::Ordering;

/// The most members that are tried for a task; the best of those is taken.
const STEPS: u32 = 20_000;

/// Puts in the place of each chosen coalition the most reliable one of the same cost that its own
/// robots and those that are chosen for nothing can form.
pub(super) fn prefer(
    scenario: &Scenario,
    denominator: u32,
    bids: &[(usize, &[Offer])],
    shares: &mut [Share],
) {
    if bids.iter().flat_map(|it| it.1).all(|it| it.success == Probability::ONE) {
        return;
    }
    for at in 0..shares.len() {
        let others = shares.iter().enumerate().filter(|it| it.0 != at);
        let taken: Vec<usize> =
            others.flat_map(|it| it.1.robots.iter().map(|it| it.robot)).collect();
        let task = shares[at].task;
        let spec = &scenario.tasks[task];
        for (plan, roles) in spec.plans.iter().enumerate() {
            let of = |role: usize| -> Vec<Member> {
                let free = bids.iter().filter(|it| !taken.contains(&it.0));
                let offers = free.flat_map(|it| it.1.iter().map(move |offer| (it.0, offer)));
                let offers =
                    offers.filter(|it| (it.1.task, it.1.plan, it.1.role) == (task, plan, role));
                let member = |(robot, it): (usize, &Offer)| Member {
                    robot,
                    cost_ms: it.cost_ms,
                    success: it.success,
                };
                offers.map(member).collect()
            };
            let roles_of: Vec<Vec<Member>> = (0..roles.roles.len()).map(of).collect();
            let mut search = Search {
                roles: &roles_of,
                cost: Joint { combine: spec.combine, denominator, extra_ms: roles.extra_ms },
                best: shares[at].clone(),
                plan,
                members: Vec::new(),
                steps: STEPS,
            };
            search.go();
            shares[at] = search.best;
        }
    }
}

/// How the costs of roles become that of a task.
struct Joint {
    combine: Combine,
    denominator: u32,
    extra_ms: u32,
}

impl Joint {
    /// In parts of a unit, of which `denominator` make one.
    fn of(&self, roles: usize, costs: impl Iterator<Item = u64>) -> u64 {
        let all = u64::from(self.denominator);
        let (joint, weight) = match self.combine {
            Combine::Sum => (costs.sum(), all),
            Combine::Mean => (costs.sum::<u64>(), all / roles.max(1) as u64),
            Combine::Max => (costs.max().unwrap_or(0), all),
        };
        joint * weight + all * u64::from(self.extra_ms)
    }
}

/// The search for coalitions of the cost of the best one.
struct Search<'a> {
    roles: &'a [Vec<Member>],
    cost: Joint,
    best: Share,
    plan: usize,
    members: Vec<Member>,
    steps: u32,
}

impl Search<'_> {
    fn go(&mut self) {
        // What the open roles cost at least, no matter by whom.
        let least = |it: &Vec<Member>| it.iter().map(|it| u64::from(it.cost_ms)).min();
        let done = self.members.iter().map(|it| u64::from(it.cost_ms));
        let open = self.roles.iter().skip(self.members.len()).map(least);
        let Some(open) = open.collect::<Option<Vec<u64>>>() else { return };
        let bound = self.cost.of(self.roles.len(), done.chain(open));
        if bound > self.best.cost || self.steps == 0 {
            return;
        }
        self.steps -= 1;
        let Some(role) = self.roles.get(self.members.len()) else {
            let (task, robots) = (self.best.task, self.members.clone());
            let found = Share { task, plan: self.plan, robots, cost: bound };
            let equal = bound == self.best.cost;
            if equal && found.is_more_reliable(&self.best) == Ordering::Greater {
                self.best = found;
            }
            return;
        };
        for member in role {
            if self.members.iter().all(|it| it.robot != member.robot) {
                self.members.push(*member);
                self.go();
                self.members.pop();
            }
        }
    }
}
