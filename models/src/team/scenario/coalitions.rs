//! Figures of a team at its start: how different its robots are, which coalitions are capable, and
//! how far from the best its rounds may end.

use super::{PlanSpec, RoleSpec, Scenario, TaskSpec, common_denominator};
use crate::team::capability::CapabilitySet;
use crate::team::heterogeneity::team_heterogeneity;
use crate::team::ratio::Ratio;
use cotama_core::team::{Cost, Costs, Fixed, Plan, Task, coalition};

/// The most coalitions that are looked at.
pub const MOST_COALITIONS: u64 = 100_000;
/// The most roles of a plan.
const ROLES: usize = 16;

/// The last of three ever sharper conditions that a coalition meets (3.4.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Passes {
    /// None of them.
    None,
    /// All robots together could fill each role (cap1, def. 3.12).
    Union,
    /// Each role has a robot that can fill it (cap2, def. 3.17).
    Roles,
    /// Each role has a robot of its own that can fill it (cap3, def. 3.18).
    Matching,
}

/// Which coalitions of a team can carry out a plan, known before any bid.
///
/// ```
/// use cotama_models::team::scenario::{Gate, Passes, RobotSpec, service};
/// let service = service().unwrap();
/// let robots: Vec<_> = service.robots.iter().map(RobotSpec::capabilities).collect();
/// let both = Gate::new(&service.tasks[1].plans[2], &robots); // fetch and bring
/// let passes = |robots: &[usize]| both.passes(robots.iter().fold(0, |all, it| all | 1 << it));
/// assert_eq!(passes(&[0, 2]), Passes::Matching); // Eddie and Poppy
/// assert_eq!(passes(&[1, 2]), Passes::None); // nobody speaks
/// assert_eq!(passes(&[0, 3]), Passes::Roles); // Tommy has no hand, and Eddie is but one
/// ```
#[derive(Clone, Debug)]
pub struct Gate<'s> {
    roles: &'s [RoleSpec],
    robots: &'s [CapabilitySet],
    /// The robots that can fill each role, a bit each.
    able: Vec<u64>,
}

impl<'s> Gate<'s> {
    /// A plan, and the capabilities of at most 64 robots.
    pub fn new(plan: &'s PlanSpec, robots: &'s [CapabilitySet]) -> Self {
        let able = |role: &RoleSpec| {
            let able = robots.iter().enumerate().filter(|it| role.possible(*it.1));
            able.fold(0, |all, it| all | 1_u64.wrapping_shl(it.0 as u32))
        };
        Self { roles: &plan.roles, robots, able: plan.roles.iter().map(able).collect() }
    }

    /// Returns the sharpest condition that these robots meet, a bit each.
    pub fn passes(&self, coalition: u64) -> Passes {
        let members = self.robots.iter().enumerate().filter(|it| coalition >> it.0 & 1 == 1);
        let union = members.fold(CapabilitySet::NONE, |all, it| all.and(*it.1));
        if !self.roles.iter().all(|it| it.possible(union)) {
            Passes::None
        } else if !self.able.iter().all(|it| it & coalition != 0) {
            Passes::Union
        } else if !self.has_matching(coalition) {
            Passes::Roles
        } else {
            Passes::Matching
        }
    }

    /// Whether each role has a robot of its own, by augmenting paths.
    fn has_matching(&self, coalition: u64) -> bool {
        let mut holds = [None; 64];
        (0..self.able.len()).all(|role| self.place(role, coalition, &mut 0, &mut holds))
    }

    fn place(
        &self,
        role: usize,
        coalition: u64,
        seen: &mut u64,
        holds: &mut [Option<usize>; 64],
    ) -> bool {
        for robot in 0..64 {
            if self.able[role] & coalition & !*seen & 1 << robot == 0 {
                continue;
            }
            *seen |= 1 << robot;
            let free = holds[robot].is_none_or(|it| self.place(it, coalition, seen, holds));
            if free {
                holds[robot] = Some(role);
                return true;
            }
        }
        false
    }
}

/// How many coalitions meet each condition, over the plans of all tasks for several robots: as many
/// robots as a plan has roles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pruning {
    /// All coalitions.
    pub coalitions: u64,
    /// Those that meet cap1.
    pub union: u64,
    /// Those that meet cap2.
    pub roles: u64,
    /// Those that meet cap3: for these alone a role assignment is to be computed.
    pub matching: u64,
    /// Steps of the role assignments of all coalitions: |z|³ each (3.4.4).
    pub steps: u64,
    /// Steps with cap3 before them: |z|³ for the condition, and as much for each that meets it.
    pub steps_matching: u64,
    /// Steps with cap2 before them: |z|² for the condition, and |z|³ for each that meets it.
    pub steps_roles: u64,
    /// Steps with cap1 before them: 2|z| for the condition, and |z|³ for each that meets it.
    pub steps_union: u64,
}

impl Pruning {
    /// Counts a coalition of so many robots, which meets conditions up to this one.
    pub fn meet(&mut self, size: u64, passes: Passes) {
        let assigned = |least: Passes| if passes >= least { size.pow(3) } else { 0 };
        self.coalitions += 1;
        self.union += u64::from(passes >= Passes::Union);
        self.roles += u64::from(passes >= Passes::Roles);
        self.matching += u64::from(passes >= Passes::Matching);
        self.steps += size.pow(3);
        self.steps_union += 2 * size + assigned(Passes::Union);
        self.steps_roles += size.pow(2) + assigned(Passes::Roles);
        self.steps_matching += size.pow(3) + assigned(Passes::Matching);
    }

    /// Returns the steps of the role assignments of capable coalitions alone, without those of any
    /// condition.
    pub fn steps_capable(&self) -> u64 {
        self.steps_matching - self.steps
    }
}

/// Figures of a team at its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Figures {
    /// How different its robots are (3.5): from 0, all equal, to 1; `None` of one robot.
    pub heterogeneity: Option<Ratio>,
    /// Which coalitions are capable; `None` where more than [`MOST_COALITIONS`] were to be looked
    /// at.
    pub pruning: Option<Pruning>,
    /// At least so much of the largest possible reward is kept by rounds that take one task for
    /// several robots after the other (3.5.3). It holds while enough free capable coalitions
    /// remain; `None` where no task is for several robots, where a coalition costs as much as its
    /// task yields, or where coalitions are not looked at.
    pub bound: Option<Ratio>,
}

impl Scenario {
    /// Returns the figures of the team at its start.
    ///
    /// ```
    /// use cotama_models::team::{Ratio, scenario::service};
    /// let figures = service().unwrap().figures();
    /// assert_eq!(figures.heterogeneity, Ratio::new(1, 3)); // Table 3.4
    /// let pruning = figures.pruning.unwrap();
    /// let passed = [pruning.coalitions, pruning.union, pruning.roles, pruning.matching];
    /// assert_eq!(passed, [14, 7, 7, 6]);
    /// ```
    pub fn figures(&self) -> Figures {
        let robots: Vec<_> = self.robots.iter().map(super::RobotSpec::robot).collect();
        let heterogeneity = team_heterogeneity(&robots);
        let several = |it: &(usize, &TaskSpec)| it.1.plans.iter().any(|it| it.roles.len() > 1);
        let several: Vec<_> = self.tasks.iter().enumerate().filter(several).collect();
        let plans = || several.iter().flat_map(|it| &it.1.plans);
        let count = plans().map(|it| coalitions(self.robots.len(), it.roles.len()));
        if count.fold(0, u64::saturating_add) > MOST_COALITIONS {
            return Figures { heterogeneity, pruning: None, bound: None };
        }
        let denominator = common_denominator(plans().map(|it| it.roles.len() as u32));
        let mut pruning = Pruning::default();
        let mut rewards: Option<(i128, i128)> = None;
        for (number, task) in &several {
            for plan in &task.plans {
                self.look_at((*number, task), plan, denominator, &mut pruning, &mut rewards);
            }
        }
        let bound = rewards.and_then(|(least, most)| {
            let [least, most] = [least, most].map(|it| u128::try_from(it).ok());
            let (least, most, count) = (least?, most?, several.len() as u128);
            let sum = (count - 1).checked_mul(least)?.checked_add(most)?;
            Ratio::new(sum, count.checked_mul(most)?).filter(|_| least > 0)
        });
        Figures { heterogeneity, pruning: Some(pruning), bound }
    }

    /// Looks at all coalitions of a plan; keeps the least and the largest reward.
    fn look_at(
        &self,
        (number, task): (usize, &TaskSpec),
        plan: &PlanSpec,
        denominator: u32,
        pruning: &mut Pruning,
        rewards: &mut Option<(i128, i128)>,
    ) {
        let robots: Vec<_> = self.robots.iter().map(super::RobotSpec::capabilities).collect();
        let gate = Gate::new(plan, &robots);
        let bid = |role| {
            let bids = (0..robots.len()).map(move |it| self.bid(it, number, role));
            bids.map(|it| it.and_then(Cost::new)).collect::<Vec<_>>()
        };
        let bids: Vec<Vec<Option<Cost>>> = plan.roles.iter().map(bid).collect();
        let mut fixed = Fixed::<i64, ROLES, ROLES>::new();
        let size = plan.roles.len() as u64;
        each(robots.len(), plan.roles.len(), &mut |members| {
            let set = members.iter().fold(0, |all, it| all | 1_u64.wrapping_shl(*it as u32));
            let passes = gate.passes(set);
            pruning.meet(size, passes);
            if passes < Passes::Matching {
                return;
            }
            let row = |it: &Vec<Option<Cost>>| members.iter().map(|at| it[*at]).collect::<Vec<_>>();
            let table: Vec<Option<Cost>> = bids.iter().flat_map(row).collect();
            let Some(roles) = Costs::new(&table, members.len()) else { return };
            let plans = [Plan { roles, extra: plan.extra_ms }];
            let only = Task { skip: None, combine: task.combine, plans: &plans };
            if let Ok(found) = coalition(&only, denominator, &mut fixed.memory()) {
                let utility = i128::from(task.utility_ms) * i128::from(denominator);
                let reward = utility - i128::from(found.cost);
                let (least, most) = rewards.unwrap_or((reward, reward));
                *rewards = Some((least.min(reward), most.max(reward)));
            }
        });
    }
}

/// The number of coalitions of so many of some robots.
fn coalitions(robots: usize, size: usize) -> u64 {
    if size > robots {
        return 0;
    }
    let step = |all: u64, at: u64| {
        let more = u128::from(all) * u128::from(robots as u64 - at) / u128::from(at + 1);
        u64::try_from(more).unwrap_or(u64::MAX)
    };
    (0..size as u64).fold(1, step)
}

/// Runs something on each coalition of this size, in lexicographic order.
fn each(robots: usize, size: usize, act: &mut impl FnMut(&[usize])) {
    let mut members: Vec<usize> = (0..size).collect();
    if size == 0 || size > robots {
        return;
    }
    loop {
        act(&members);
        let Some(at) = (0..size).rev().find(|it| members[*it] < robots - size + it) else { return };
        members[at] += 1;
        for next in at + 1..size {
            members[next] = members[next - 1] + 1;
        }
    }
}
