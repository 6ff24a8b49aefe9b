//! Bids and pledges of a robot.

use super::capability::{Capability, Robot};
use super::ratio::Ratio;
use super::reliability::Probability;
use super::task::{ActionPlan, Role};

/// An action plan has at most so many actions in a bid.
pub const MAX_STEPS: usize = 32;
/// The least common multiple of 1 to [`MAX_STEPS`].
const COMMON: u128 = 144_403_552_893_600;

/// An action of a plan, as one robot would carry it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Cost of the action.
    pub cost: u32,
    /// Probability that the action does not fail.
    pub success: Probability,
}

/// Returns the mean cost to repeat the actions lost when the last of these fails (3.4.5.2): the
/// failure sends the robot back to any action from the first to this, all equally likely. None for
/// more than [`MAX_STEPS`] actions.
///
/// ```
/// use cotama_models::team::{Ratio, failure_cost};
/// assert_eq!(failure_cost([10, 20, 30]), Ratio::new(140, 3));
/// ```
pub fn failure_cost(costs: impl IntoIterator<Item = u32>) -> Option<Ratio> {
    let (mut sum, mut count) = (0_u128, 0_u128);
    for cost in costs {
        count = count.saturating_add(1);
        sum = sum.saturating_add(count.saturating_mul(cost.into()));
    }
    if count > MAX_STEPS as u128 { None } else { Ratio::new(sum, count.max(1)) }
}

/// Returns the exact cost of a plan with failures counted in (3.13): each action, and the mean cost
/// of its failure times its probability. None for more than [`MAX_STEPS`] actions. Costs must be
/// such that they add up.
///
/// ```
/// use cotama_models::team::{Probability, Ratio, Step, failure_aware_cost};
/// let step = |cost, permille| Step { cost, success: Probability::permille(permille).unwrap() };
/// let cost = failure_aware_cost(&[step(10, 900), step(20, 800), step(30, 950)]).unwrap();
/// assert_eq!(Some(cost), Ratio::new(205, 3)); // 11 + 25 + 97/3
/// assert_eq!(cost.rounded_up(), 69);
/// ```
pub fn failure_aware_cost(steps: &[Step]) -> Option<Ratio> {
    if steps.len() > MAX_STEPS {
        return None;
    }
    // In parts of COMMON times 10⁹: below 2^128 for 32 actions of any cost.
    let (mut plain, mut risk, mut weighted, mut count) = (0_u128, 0_u128, 0_u128, 0_u128);
    for step in steps {
        count = count.saturating_add(1);
        weighted = weighted.saturating_add(count.saturating_mul(step.cost.into()));
        plain = plain.saturating_add(step.cost.into());
        let average = weighted.saturating_mul(COMMON.checked_div(count)?);
        risk = risk.saturating_add(average.saturating_mul(step.success.failing().into()));
    }
    let parts = COMMON.checked_mul(Probability::PARTS.into())?;
    Ratio::new(plain.checked_mul(parts)?.checked_add(risk)?, parts)
}

/// Returns the actions of a plan as a robot would carry them out: of alternatives each uses those
/// that cost least, failures counted in (3.11, 3.12). None where it is not capable, or where the
/// plan has more than [`MAX_STEPS`] actions. `cost` and `surcharge` are those of
/// [`Bid::for_plan`].
pub fn steps<'m>(
    robot: &Robot<'_>,
    plan: &ActionPlan<'_>,
    cost: impl Fn(usize) -> u32,
    surcharge: impl Fn(usize, Capability) -> u32,
    memory: &'m mut [Step; MAX_STEPS],
) -> Option<&'m [Step]> {
    for (place, action) in plan.actions.iter().enumerate() {
        let before = memory.iter().take(place).map(|it| it.cost);
        let failure = failure_cost(before.chain([cost(place)]))?;
        let more = |it| u64::from(surcharge(place, it));
        let used = action.needs.used(robot, &more, failure)?;
        let whole = u64::from(cost(place)).saturating_add(used.surcharge);
        let step = Step { cost: u32::try_from(whole).ok()?, success: used.success };
        *memory.get_mut(place)? = step;
    }
    memory.get(..plan.actions.len())
}

/// The bid of a robot for a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bid {
    /// The number of the action plan.
    pub plan: usize,
    /// Cost, failures counted in.
    pub cost: Ratio,
    /// Probability that no action fails.
    pub success: Probability,
}

impl Bid {
    /// Returns the bid of a robot for an action plan: the number of the plan is 0. None where it is
    /// not capable, or where the plan has more than [`MAX_STEPS`] actions.
    ///
    /// `cost` is what an action costs the robot, by its place in the plan; `surcharge` what it
    /// costs more with a capability.
    pub fn for_plan(
        robot: &Robot<'_>,
        plan: &ActionPlan<'_>,
        cost: impl Fn(usize) -> u32,
        surcharge: impl Fn(usize, Capability) -> u32,
    ) -> Option<Self> {
        let mut memory = [Step { cost: 0, success: Probability::ONE }; MAX_STEPS];
        let steps = steps(robot, plan, cost, surcharge, &mut memory)?;
        let success = steps.iter().fold(Probability::ONE, |all, it| all.and(it.success));
        Some(Self { plan: 0, cost: failure_aware_cost(steps)?, success })
    }

    /// The best bid of a robot for a role (3.3): the least cost; of equal ones the more reliable,
    /// then the first. `cost` is what an action costs, by the numbers of the action plan and of the
    /// action.
    pub fn for_role(
        robot: &Robot<'_>,
        role: &Role<'_>,
        cost: impl Fn(usize, usize) -> u32,
    ) -> Option<Self> {
        let bid = |(number, plan)| {
            let bid = Self::for_plan(robot, plan, |at| cost(number, at), |_, _| 0)?;
            Some(Self { plan: number, ..bid })
        };
        let bids = (0..role.plans.len()).zip(role.plans).filter_map(bid);
        bids.min_by_key(|it| (it.cost, core::cmp::Reverse(it.success)))
    }

    /// The cost as it is sent: an integer, rounded up.
    pub fn price(&self) -> u64 {
        self.cost.rounded_up()
    }
}

/// The cost that the winner of a task pledges not to exceed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pledge {
    /// The most that the task may come to cost.
    pub most: u64,
}

impl Pledge {
    /// How much more than its bid a task may cost if nothing else is said, in thousandths.
    pub const SLACK_PERMILLE: u32 = 500;

    /// The pledge of an award: the cost and some slack, or the second-best cost if that is less.
    ///
    /// The thesis takes the larger of α times the best reward, α > 1, and the second-best reward
    /// (3.15), which is more than the best itself where rewards are positive; this is our reading
    /// of it for costs.
    ///
    /// ```
    /// use cotama_models::team::Pledge;
    /// assert_eq!(Pledge::of(100, None, 250), Pledge { most: 125 });
    /// assert_eq!(Pledge::of(100, Some(110), 250), Pledge { most: 110 });
    /// ```
    #[must_use]
    pub fn of(cost: u64, second: Option<u64>, slack_permille: u32) -> Self {
        let whole = u128::from(slack_permille).saturating_add(1_000);
        let most = u128::from(cost).saturating_mul(whole) / 1_000;
        let most = u64::try_from(most).unwrap_or(u64::MAX);
        Self { most: second.map_or(most, |it| most.min(it.max(cost))) }
    }

    /// Whether it is kept if the task comes to cost this.
    pub const fn is_kept(self, cost: u64) -> bool {
        cost <= self.most
    }
}
