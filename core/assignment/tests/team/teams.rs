//! Random teams with tasks, owned; and all that they can do, by sets of robots.

use crate::draw::Draw;
use cotama_core::team::winners::Winners;
use cotama_core::team::{Combine, Cost, Costs, Plan, RobotSet, Task, Team};

/// A plan: what is lost by it, and the costs of its roles, row after row.
pub struct OwnedPlan {
    pub extra: u32,
    pub costs: Vec<Option<Cost>>,
}

pub struct OwnedTask {
    pub skip: Option<Cost>,
    pub combine: Combine,
    pub plans: Vec<OwnedPlan>,
}

pub struct OwnedTeam {
    pub robots: usize,
    pub denominator: u32,
    pub tasks: Vec<OwnedTask>,
}

impl OwnedTeam {
    /// Runs something on the team.
    pub fn with<R>(&self, act: impl FnOnce(&Team<'_>) -> R) -> R {
        let mut plans: Vec<Vec<Plan<'_>>> = vec![];
        for task in &self.tasks {
            let roles = |it| Costs::new(it, self.robots).unwrap();
            let all = task.plans.iter();
            plans.push(all.map(|it| Plan { extra: it.extra, roles: roles(&it.costs) }).collect());
        }
        let mut tasks = vec![];
        for (it, plans) in self.tasks.iter().zip(&plans) {
            tasks.push(Task { skip: it.skip, combine: it.combine, plans });
        }
        act(&Team::new(self.robots, self.denominator, &tasks).unwrap())
    }
}

/// The kind of team drawn.
#[derive(Clone, Copy)]
pub struct Kind {
    pub robots: usize,
    pub tasks: usize,
    /// The most roles of a plan, and the most plans of a task.
    pub roles: u64,
    pub plans: u64,
    /// Costs go to this; so many percent are missing.
    pub most: u64,
    pub missing: u64,
    /// So many percent of the tasks must be done; what leaving another one undone costs at most.
    pub must: u64,
    pub skip: u64,
    /// Only the largest cost counts.
    pub largest: bool,
}

/// A team of this kind.
pub fn team(draw: &mut Draw, kind: Kind) -> OwnedTeam {
    let denominator = (1..=kind.roles as u32).fold(1, |a, b| a * b / gcd(a, b));
    let cost = |draw: &mut Draw| {
        let cost = Cost::new(draw.between(1, kind.most) as u32);
        cost.filter(|_| draw.between(1, 100) > kind.missing)
    };
    let task = |_| {
        let must = draw.between(1, 100) <= kind.must;
        let single = draw.between(0, 3) == 0 && !kind.largest;
        let combine = match draw.between(0, 2) {
            _ if kind.largest => Combine::Max,
            _ if single => Combine::Sum,
            0 => Combine::Sum,
            1 => Combine::Mean,
            _ => Combine::Max,
        };
        let plans = if single { 1 } else { draw.between(1, kind.plans) };
        let plan = |number: u64| {
            let roles =
                if single { 1 } else { draw.between(1 + u64::from(number == 0), kind.roles) };
            let costs = (0..roles as usize * kind.robots).map(|_| cost(draw)).collect();
            OwnedPlan { extra: draw.between(0, kind.most / 8) as u32, costs }
        };
        let plans: Vec<_> = (0..plans).map(plan).collect();
        let skip = draw.between(kind.skip / 4, kind.skip) as u32;
        OwnedTask { skip: Cost::new(skip).filter(|_| !must), combine, plans }
    };
    OwnedTeam { robots: kind.robots, denominator, tasks: (0..kind.tasks).map(task).collect() }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Returns the cost of a task by each set of robots, over all its plans and all ways to fill the
/// roles; and with the set that leaves it undone.
pub fn by_set(team: &Team<'_>, task: &Task<'_>) -> Vec<Option<u64>> {
    let parts = u64::from(team.denominator());
    let mut all = vec![None; 1 << team.robots()];
    all[0] = task.skip.map(|it| parts * u64::from(it.get()));
    for plan in task.plans {
        let k = plan.roles.rows() as u64;
        let mut now = vec![None; 1 << team.robots()];
        now[0] = Some(0);
        for role in 0..plan.roles.rows() {
            let mut next = vec![None; now.len()];
            for (set, before) in now.iter().enumerate().filter_map(|(set, it)| Some((set, (*it)?)))
            {
                for (robot, cost) in plan.roles.row(role).enumerate() {
                    let (Some(cost), true) = (cost, set & (1 << robot) == 0) else { continue };
                    let cost = u64::from(cost.get());
                    let joint: u64 =
                        if task.combine == Combine::Max { cost.max(before) } else { cost + before };
                    let slot: &mut Option<u64> = &mut next[set | (1 << robot)];
                    *slot = Some(slot.map_or(joint, |it| it.min(joint)));
                }
            }
            now = next;
        }
        for (slot, cost) in all.iter_mut().zip(now) {
            let Some(cost) = cost else { continue };
            let cost = match task.combine {
                Combine::Mean => parts / k * cost,
                _ => parts * cost,
            };
            let cost = cost + parts * u64::from(plan.extra);
            *slot = Some(slot.map_or(cost, |it: u64| it.min(cost)));
        }
    }
    all
}

/// The least cost of all tasks, by the sets of robots that the first tasks have.
pub fn least_of_all(team: &Team<'_>) -> Option<u64> {
    let whole = (1_usize << team.robots()) - 1;
    let mut best = vec![None; whole + 1];
    best[0] = Some(0_u64);
    for task in team.tasks() {
        let costs = by_set(team, task);
        let mut next = vec![None; best.len()];
        for (taken, before) in best.iter().enumerate().filter_map(|(set, it)| Some((set, (*it)?))) {
            let free = whole & !taken;
            let mut set = free;
            loop {
                if let Some(cost) = costs[set] {
                    let slot: &mut Option<u64> = &mut next[taken | set];
                    *slot = Some(slot.map_or(before + cost, |it| it.min(before + cost)));
                }
                if set == 0 {
                    break;
                }
                set = (set - 1) & free;
            }
        }
        best = next;
    }
    best.into_iter().flatten().min()
}

/// The cost of the answer, added again from who does what; asserts that it is allowed.
pub fn again<const N: usize>(team: &Team<'_>, joint: &mut Winners<'_, N>) -> u64 {
    let (mut taken, mut sum): (RobotSet, u64) = (0, 0);
    let parts = u64::from(team.denominator());
    for (number, task) in team.tasks().iter().enumerate() {
        let Some((plan, set)) = joint.chosen(number) else {
            sum += parts * u64::from(task.skip.expect("it must be done").get());
            continue;
        };
        assert_eq!(taken & set, 0, "a robot is in two tasks");
        taken |= set;
        let plan = &task.plans[plan];
        let robots: Vec<_> = joint.robots(number).collect();
        assert_eq!(robots.len(), plan.roles.rows());
        assert_eq!(robots.iter().fold(0, |set: RobotSet, it| set | (1 << it)), set);
        assert_eq!(set.count_ones() as usize, robots.len());
        let costs = robots.iter().enumerate();
        let costs: Vec<u64> =
            costs.map(|(role, it)| plan.roles.cost(role, *it).unwrap().get().into()).collect();
        let all: u64 = costs.iter().sum();
        sum += parts * u64::from(plan.extra)
            + match task.combine {
                Combine::Sum => parts * all,
                Combine::Mean => parts / costs.len() as u64 * all,
                Combine::Max => parts * costs.iter().max().unwrap(),
            };
    }
    sum
}
