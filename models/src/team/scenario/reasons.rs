//! Why each bid of a team is what it is, as it starts, and what comes of the bids for a task.

use super::bid::Parts;
use super::{Formation, Quote, RoleSpec, Scenario, TaskSpec, common_denominator};
use crate::team::bid::{Pledge, Step, failure_cost};
use crate::team::capability::{Capability, CapabilitySet, Skill};
use crate::team::ratio::Ratio;
use crate::team::reliability::Probability;
use cotama_core::team::{Combine, Cost, Costs, Fixed, Plan, Task, coalition};

/// The most roles of a plan, and robots of a team.
const ROLES: usize = 16;
const ROBOTS: usize = super::MAX_ROBOTS;

/// Parts of a bid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reasons {
    /// Ways and times, in the order of the role.
    pub parts: Parts,
    /// The actions of the role, as they enter (3.13).
    pub actions: Vec<Counted>,
    /// The bid itself.
    pub quote: Quote,
}

/// An action as a bid counts it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counted {
    /// Skills that it uses: of each choice the most reliable one (3.11, 3.12).
    pub used: Vec<Capability>,
    /// Cost, and the probability that it does not fail.
    pub step: Step,
    /// The mean cost to repeat what is lost when it fails, in ms.
    pub repeated: Ratio,
}

impl Counted {
    /// Returns what failures of the action add to the bid on average, in ms, rounded up.
    pub fn surcharge_ms(&self) -> u64 {
        let risk = self.repeated.numerator().checked_mul(self.step.success.failing().into());
        let parts = self.repeated.denominator().checked_mul(Probability::PARTS.into());
        let mean = risk.zip(parts).and_then(|(risk, parts)| Ratio::new(risk, parts));
        mean.map_or(u64::MAX, Ratio::rounded_up)
    }
}

/// Why a robot does not bid for a role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Lack {
    /// Skills: it has none of each of these sets.
    Skills(Vec<CapabilitySet>),
    /// No way leads to where it takes, or from there to where it gives.
    Way,
    /// The cost is more than a bid can say.
    Cost,
    /// The robot joins the team later.
    Away,
    /// Charge: its battery is too low for the role and the way home.
    Charge,
}

/// A coalition that can do a task by one of its plans.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Number of the plan.
    pub plan: usize,
    /// The robot of each role.
    pub robots: Vec<usize>,
    /// Cost of the task, in parts of a ms.
    pub cost: u64,
}

/// The coalitions for one task alone: each robot is free.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contest {
    /// So many parts make a ms.
    pub denominator: u32,
    /// The best coalition of each plan; `None` where it cannot be carried out.
    pub plans: Vec<Option<Offer>>,
    /// The best of all; of equal ones that with fewer roles, then the first plan.
    pub best: Option<Offer>,
    /// The best one that is another plan, or has other robots.
    pub second: Option<Offer>,
    /// The cost without each robot of the best coalition, in parts; `None` where nobody else can.
    pub without: Vec<(usize, Option<u64>)>,
}

impl Scenario {
    /// Returns what the bid of a robot for a role of a task is made of at the start of a run, or
    /// why there is none. The bid is that of [`Scenario::bid`].
    ///
    /// # Errors
    /// [`Lack`]: why the robot does not bid. A robot or a task that is not there lacks a way.
    ///
    /// ```
    /// use cotama_models::team::scenario::{Lack, service};
    /// use cotama_models::team::service::{DIALOGUE, MOVE};
    /// let service = service().unwrap();
    /// let order = &service.tasks[0].plans[0].roles[0];
    /// let eddie = service.reasons(0, 0, order).unwrap();
    /// assert_eq!(Some(eddie.quote.cost_ms), service.bid(0, 0, order));
    /// let Err(Lack::Skills(missing)) = service.reasons(1, 0, order) else { panic!() };
    /// assert_eq!(missing.len(), 1);
    /// assert!(missing[0].has(DIALOGUE) && !missing[0].has(MOVE));
    /// ```
    pub fn reasons(&self, robot: usize, task: usize, role: &RoleSpec) -> Result<Reasons, Lack> {
        if self.robots.get(robot).is_some_and(|it| !it.stay.works(0)) {
            return Err(Lack::Away);
        }
        let reasons = self.at_start(robot, task, role, |outlook| {
            let missing = role.missing(outlook.able);
            if !missing.is_empty() {
                return Err(Lack::Skills(missing));
            }
            let parts = self.parts(role, outlook).ok_or(Lack::Way)?;
            if !self.is_charged_for(role, outlook) {
                return Err(Lack::Charge);
            }
            let usable = outlook.usable();
            let counted = role.counted(&usable, parts.costs());
            let quote = self.quote(role, outlook);
            let (actions, quote) = counted.zip(quote).ok_or(Lack::Cost)?;
            Ok(Reasons { parts, actions, quote })
        });
        reasons.unwrap_or(Err(Lack::Way))
    }

    /// Returns the coalitions for a task alone, from the bids of all robots at the start of a run;
    /// `None` where there is no such task.
    ///
    /// ```
    /// use cotama_models::team::scenario::service;
    /// let order = service().unwrap().contest(0).unwrap();
    /// assert_eq!(order.best.unwrap().robots, [0]); // Eddie alone speaks
    /// assert_eq!((order.second, order.without), (None, vec![(0, None)]));
    /// ```
    pub fn contest(&self, task: usize) -> Option<Contest> {
        let spec = self.tasks.get(task)?;
        let denominator = match spec.combine {
            Combine::Mean => common_denominator(spec.plans.iter().map(|it| it.roles.len() as u32)),
            _ => 1,
        };
        let bids = Bids::new(self, task, spec);
        let nobody = |_: usize| false;
        let plans: Vec<_> =
            (0..spec.plans.len()).map(|it| bids.best(it, denominator, &nobody)).collect();
        let best = least(plans.iter().flatten());
        let (mut others, mut without) = (Vec::new(), Vec::new());
        if let Some(best) = &best {
            others.extend(plans.iter().flatten().filter(|it| it.plan != best.plan).cloned());
            for robot in &best.robots {
                let gone = |it: usize| it == *robot;
                let best_of = |plan| bids.best(plan, denominator, &gone);
                let rest: Vec<_> = (0..spec.plans.len()).filter_map(best_of).collect();
                without.push((*robot, least(rest.iter()).map(|it| it.cost)));
                others.extend(rest);
            }
        }
        let second = least(others.iter());
        Some(Contest { denominator, plans, best, second, without })
    }

    /// Returns what each robot of a coalition would pledge for a task (3.15), as a run has it;
    /// `None` where that hangs on the coalitions that brokers happen to bid.
    pub fn pledge(&self, task: usize, offer: &Offer) -> Option<Pledge> {
        let roles = &self.tasks.get(task)?.plans.get(offer.plan)?.roles;
        let costs = roles.iter().zip(&offer.robots);
        let slowest = costs.filter_map(|(role, robot)| self.bid(*robot, task, role)).max()?;
        let second = match (roles.as_slice(), self.second_best, self.formation) {
            ([_], true, Formation::Distributed) => return None,
            ([role], true, Formation::Central) => {
                let others = (0..self.robots.len()).filter(|it| !offer.robots.contains(it));
                others.filter_map(|it| self.bid(it, task, role)).min().map(u64::from)
            }
            _ => None,
        };
        Some(Pledge::of(slowest.into(), second, self.slack_permille))
    }
}

impl RoleSpec {
    /// Returns the sets of skills of which these have none.
    fn missing(&self, able: CapabilitySet) -> Vec<CapabilitySet> {
        let mut missing = Vec::new();
        for any in self.actions.iter().flat_map(|it| &it.0) {
            if !able.has_any(*any) && !missing.contains(any) {
                missing.push(*any);
            }
        }
        missing
    }

    fn counted(&self, skills: &[Skill], costs: [u64; 4]) -> Option<Vec<Counted>> {
        let steps = self.steps(skills, costs)?;
        let counted = |(at, step): (usize, &Step)| {
            let until = steps.iter().take(at + 1).map(|it| it.cost);
            let used = self.actions.get(at)?.used(skills).collect();
            Some(Counted { used, step: *step, repeated: failure_cost(until)? })
        };
        steps.iter().enumerate().map(counted).collect()
    }
}

/// Bids of all robots for all roles of a task.
struct Bids<'s> {
    spec: &'s TaskSpec,
    robots: usize,
    /// For each plan those of each role, robot after robot.
    plans: Vec<Vec<Option<Cost>>>,
}

impl<'s> Bids<'s> {
    fn new(scenario: &Scenario, task: usize, spec: &'s TaskSpec) -> Self {
        let robots = scenario.robots.len();
        let of = |role: &RoleSpec| {
            let bids = (0..robots).map(|it| scenario.bid(it, task, role).and_then(Cost::new));
            bids.collect::<Vec<_>>()
        };
        let plans = spec.plans.iter().map(|it| it.roles.iter().flat_map(of).collect());
        Self { spec, robots, plans: plans.collect() }
    }

    /// Returns the best coalition of a plan without some robots.
    fn best(&self, plan: usize, denominator: u32, gone: &dyn Fn(usize) -> bool) -> Option<Offer> {
        let own = self.spec.plans.get(plan)?;
        let entry = |(at, it): (usize, &Option<Cost>)| it.filter(|_| !gone(at % self.robots));
        let costs: Vec<_> = self.plans.get(plan)?.iter().enumerate().map(entry).collect();
        if own.roles.len() > self.robots {
            return None;
        }
        let plans = [Plan { roles: Costs::new(&costs, self.robots)?, extra: own.extra_ms }];
        let only = Task { skip: None, combine: self.spec.combine, plans: &plans };
        let mut fixed = Fixed::<i64, ROLES, ROBOTS>::new();
        let mut memory = fixed.memory();
        let cost = coalition(&only, denominator, &mut memory).ok()?.cost;
        let robots = (0..own.roles.len()).map(|it| memory.column(it)).collect::<Option<_>>()?;
        Some(Offer { plan, robots, cost })
    }
}

/// Returns the offer of the least cost.
fn least<'o>(offers: impl Iterator<Item = &'o Offer>) -> Option<Offer> {
    offers.min_by_key(|it| (it.cost, it.robots.len(), it.plan)).cloned()
}
