//! Bids of the robots for roles: the time of the drives and of the hands, failures counted in.

use super::{Give, Needs, Place, RobotSpec, RoleSpec, Scenario, Spot, Stage, Take};
use crate::team::bid::{Bid, MAX_STEPS, Step, steps};
use crate::team::capability::{Capability, CapabilitySet, Robot, Skill};
use crate::team::reliability::{Probability, Reliability};
use std::cmp::Reverse;

/// Time of the rounds of the decisional component between the parts of a task, all together, in ms.
const ROUNDS: u64 = 1_500;

/// The part of a robot in a role as things stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outlook<'a> {
    /// The robot.
    pub robot: &'a RobotSpec,
    /// The skills of the robot, as it takes them to be.
    pub skills: &'a [Skill],
    /// The capabilities with which it would do so.
    pub able: CapabilitySet,
    /// The place of the robot.
    pub from: Spot,
    /// The speed of the robot, in mm/s.
    pub pace: u64,
    /// The spots where it takes and where it gives.
    pub ends: [Spot; 2],
    /// Whether it has the object on board, and need not take it.
    pub holds: bool,
    /// The delays that it knows of each crowded way, in ms.
    pub seen: &'a [Vec<u64>],
}

impl Outlook<'_> {
    /// Returns the skills that it can use.
    pub(super) fn usable(&self) -> Vec<Skill> {
        self.skills.iter().filter(|it| self.able.has(it.capability)).copied().collect()
    }
}

/// The ways and times of a role, when nothing fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The ways to where it takes, and from there to where it gives, in mm.
    pub ways_mm: [u64; 2],
    /// The times of these drives, in ms, the planning before each included.
    pub drives_ms: [u64; 2],
    /// The delays of these drives on crowded ways, in ms, as bids take them to be.
    pub delays_ms: [u64; 2],
    /// Time of the rounds of the decisional component, in ms.
    pub rounds_ms: u64,
    /// How long it takes to take the object, in ms; 0 where it has it on board.
    pub take_ms: u64,
    /// How long it takes to give it, in ms.
    pub give_ms: u64,
}

impl Parts {
    /// Returns the costs of drives and hands in their order, in ms.
    pub fn costs(&self) -> [u64; 4] {
        let drive = |it: usize| self.drives_ms[it].saturating_add(self.delays_ms[it]);
        [drive(0).saturating_add(self.rounds_ms), self.take_ms, drive(1), self.give_ms]
    }

    /// Returns the whole time, in ms.
    pub fn sum_ms(&self) -> u64 {
        sum(&self.costs())
    }
}

/// The bid of a robot for a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quote {
    /// Cost, failures counted in (3.13), in ms.
    pub cost_ms: u32,
    /// Probability that no action fails.
    pub success: Probability,
}

impl Needs {
    /// Returns the capabilities that a robot of these skills uses: of each set the most reliable
    /// one (3.12), of equal ones the first. Sets of which it has none are left out.
    pub fn used(&self, skills: &[Skill]) -> impl Iterator<Item = Capability> {
        let robot = Robot { name: "", skills };
        let best = move |any: &CapabilitySet| {
            let has = any.iter().filter_map(|it| Some((it, robot.reliability(it)?)));
            has.min_by_key(|it| Reverse(it.1)).map(|it| it.0)
        };
        self.0.iter().filter_map(best)
    }
}

impl RoleSpec {
    /// Returns the actions of a stage of the hands: the second action takes, the fourth gives, with
    /// all that follow. A role of fewer actions does the rest by its last.
    pub fn by_hand(&self, stage: Stage) -> &[Needs] {
        let last = self.actions.len().saturating_sub(1);
        let of = match stage {
            Stage::Takes => last.min(1)..(last + 1).min(2),
            Stage::Gives => last.min(3)..last + 1,
            _ => 0..0,
        };
        self.actions.get(of).unwrap_or_default()
    }

    /// Returns the bid of a robot of these skills, for the costs of its drives and hands in their
    /// order, in ms: those that are over cost nothing. `None` where it cannot.
    pub fn quote(&self, skills: &[Skill], costs: [u64; 4]) -> Option<Quote> {
        let certain = skills.iter().all(|it| it.reliability == Reliability::CERTAIN);
        if certain || self.actions.is_empty() {
            let cost_ms = u32::try_from(sum(&costs)).ok()?;
            return Some(Quote { cost_ms, success: Probability::ONE });
        }
        let cost = self.cost_of_action(costs);
        let who = Robot { name: "", skills };
        let bid = self.with_role(|role| Bid::for_role(&who, role, |_, at| cost(at)))?;
        Some(Quote { cost_ms: u32::try_from(bid.price()).ok()?, success: bid.success })
    }

    /// Returns the actions of the role as [`quote`](Self::quote) counts them; `None` where a robot
    /// of these skills cannot.
    pub(super) fn steps(&self, skills: &[Skill], costs: [u64; 4]) -> Option<Vec<Step>> {
        let (cost, who) = (self.cost_of_action(costs), Robot { name: "", skills });
        let mut memory = [Step { cost: 0, success: Probability::ONE }; MAX_STEPS];
        self.with_role(|role| {
            let plan = role.plans.first()?;
            Some(steps(&who, plan, cost, |_, _| 0, &mut memory)?.to_vec())
        })
    }

    /// Returns the cost of each action. The last one costs all that is still to be done; one that
    /// follows the last step costs nothing more.
    fn cost_of_action(&self, costs: [u64; 4]) -> impl Fn(usize) -> u32 {
        let last = self.actions.len().saturating_sub(1);
        move |at| {
            let rest = costs.get(at..).unwrap_or_default();
            let own = rest.first().copied().unwrap_or(0);
            u32::try_from(if at == last { sum(rest) } else { own }).unwrap_or(u32::MAX)
        }
    }
}

fn sum(costs: &[u64]) -> u64 {
    costs.iter().fold(0, |all, it| all.saturating_add(*it))
}

/// Returns the least number that each of these numbers of roles divides: in such parts the mean of
/// the costs of a plan's roles is whole. Plans have 16 roles at most, so it fits.
///
/// ```
/// use cotama_models::team::scenario::common_denominator;
/// assert_eq!(common_denominator([1, 2, 3, 4]), 12);
/// ```
pub fn common_denominator(roles: impl IntoIterator<Item = u32>) -> u32 {
    roles.into_iter().fold(1, |all, roles| {
        let (mut x, mut y) = (all, roles);
        while y != 0 {
            (x, y) = (y, x % y);
        }
        all / x.max(1) * roles
    })
}

impl Scenario {
    /// Returns the spots where a role of a task takes and gives, with the object of the task there.
    pub fn ends(&self, task: usize, role: &RoleSpec, object: Spot) -> [Spot; 2] {
        let takes = match role.take {
            Take::Partner(place) | Take::Words(place) => Spot::at(place),
            Take::Object => object,
        };
        let goal = self.tasks.get(task).map(|it| Spot::at(it.goal));
        let gives = match role.give {
            Give::Goal => goal.unwrap_or(takes),
            Give::Partner(place) => Spot::at(place),
            Give::Nobody => takes,
        };
        [takes, gives]
    }

    /// Returns the bid of a robot for a role; `None` where it cannot.
    pub fn quote(&self, role: &RoleSpec, outlook: &Outlook<'_>) -> Option<Quote> {
        if !role.possible(outlook.able) {
            return None;
        }
        role.quote(&outlook.usable(), self.parts(role, outlook)?.costs())
    }

    /// Returns the ways and times of a role for a robot; `None` where no way leads there.
    pub(super) fn parts(&self, role: &RoleSpec, outlook: &Outlook<'_>) -> Option<Parts> {
        let Outlook { robot, from, pace, ends: [takes, gives], holds, seen, .. } = *outlook;
        let ways_mm = [self.floor.distance(from, takes)?, self.floor.distance(takes, gives)?];
        Some(Parts {
            ways_mm,
            drives_ms: ways_mm.map(|it| robot.drive_ms(it, pace)),
            delays_ms: self.delays([(from, takes), (takes, gives)], seen),
            rounds_ms: ROUNDS,
            take_ms: if holds { 0 } else { role.take_ms },
            give_ms: role.give_ms,
        })
    }

    /// Returns the cost of a role of a task for a robot at the start of a run, in ms: nothing has
    /// failed, each robot and each object is at its place. `None` where it cannot.
    ///
    /// ```
    /// use cotama_models::team::scenario::service;
    /// let service = service().unwrap();
    /// let order = &service.tasks[0].plans[0].roles[0];
    /// let bids = [0, 1, 2, 3].map(|robot| service.bid(robot, 0, order));
    /// assert!(bids[0].is_some() && bids[1..] == [None, None, None]); // Eddie alone speaks
    /// ```
    pub fn bid(&self, robot: usize, task: usize, role: &RoleSpec) -> Option<u32> {
        self.at_start(robot, task, role, |outlook| {
            let cost = self.quote(role, outlook)?.cost_ms;
            self.is_charged_for(role, outlook).then_some(cost)
        })?
    }

    /// Runs something on the part of a robot in a role at the start of a run; `None` where there is
    /// no such robot or task, or the robot joins later.
    pub(super) fn at_start<R>(
        &self,
        robot: usize,
        task: usize,
        role: &RoleSpec,
        act: impl FnOnce(&Outlook<'_>) -> R,
    ) -> Option<R> {
        let who = self.robots.get(robot).filter(|it| it.stay.works(0))?;
        let object = self.tasks.get(task)?.start;
        let at = |place: Place| Spot::at(place);
        let skills = who.trusted(self.trust);
        let seen = self.delays_seen();
        Some(act(&Outlook {
            robot: who,
            skills: &skills,
            able: who.capabilities(),
            from: at(who.start),
            pace: who.pace(0)?,
            ends: self.ends(task, role, at(object)),
            holds: false,
            seen: &seen,
        }))
    }
}
