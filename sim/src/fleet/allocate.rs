//! Allocation in a team: from bids to awards, by `cotama_core::team`.

mod reliable;

use crate::fleet::bid::{Member, Offer, Share};
use cotama_core::team::winners::Workspace;
use cotama_core::team::{Cost, Costs, Memory, Plan, RobotSet, Task, Team, assign, coalition};
use cotama_models::team::Probability;
use cotama_models::team::scenario::{
    Formation, Gate, MAX_ROBOTS, Method, Passes, PlanSpec, RobotSpec, Scenario, TaskSpec,
    common_denominator,
};
use cotama_models::team::thesis::{self, Shares, State};

/// The most steps of one search for the least cost; what is found by then is taken.
const STEPS: u64 = 20_000;

/// Bids as tables: of each task, of each plan, roles by robots.
struct Tables {
    /// The numbers of the robots that bid: the columns.
    robots: Vec<usize>,
    /// The entries of each plan of each task.
    entries: Vec<Vec<Vec<Option<Cost>>>>,
    /// Offers of which not all actions are certain to succeed: task, plan, role, robot.
    success: Vec<([usize; 4], Probability)>,
    denominator: u32,
}

impl Tables {
    fn new(scenario: &Scenario, tasks: &[usize], bids: &[(usize, &[Offer])]) -> Self {
        let robots: Vec<usize> = bids.iter().filter(|it| !it.1.is_empty()).map(|it| it.0).collect();
        let width = robots.len();
        let specs = || tasks.iter().map(|&it| &scenario.tasks[it]);
        let empty = |it: &TaskSpec| -> Vec<Vec<Option<Cost>>> {
            it.plans.iter().map(|it| vec![None; it.roles.len() * width]).collect()
        };
        let mut entries: Vec<_> = specs().map(empty).collect();
        let place = |task: usize| tasks.iter().position(|it| *it == task);
        for (column, (_, offers)) in bids.iter().filter(|it| !it.1.is_empty()).enumerate() {
            let mut last = (usize::MAX, None);
            for it in *offers {
                if last.0 != it.task {
                    last = (it.task, place(it.task));
                }
                let Some(task) = last.1 else { continue };
                entries[task][it.plan][it.role * width + column] = Cost::new(it.cost_ms);
            }
        }
        let sizes = specs().flat_map(|it| it.plans.iter().map(|it| it.roles.len() as u32));
        let denominator = common_denominator(sizes);
        let uncertain = bids.iter().flat_map(|bid| {
            let risky = bid.1.iter().filter(|it| it.success != Probability::ONE);
            risky.map(|it| ([it.task, it.plan, it.role, bid.0], it.success))
        });
        let mut success: Vec<_> = uncertain.collect();
        success.sort_unstable_by_key(|it| it.0);
        Self { robots, entries, success, denominator }
    }

    fn success(&self, offer: [usize; 4]) -> Probability {
        let found = self.success.binary_search_by_key(&offer, |it| it.0);
        found.map_or(Probability::ONE, |it| self.success[it].1)
    }

    /// Plans of each task.
    fn plans<'t>(&'t self, scenario: &Scenario, tasks: &[usize]) -> Vec<Vec<Plan<'t>>> {
        let of = |(entries, &task): (&'t Vec<Vec<Option<Cost>>>, &usize)| {
            let plans = entries.iter().zip(&scenario.tasks[task].plans);
            let plan = |(entries, spec): (&'t Vec<Option<Cost>>, &PlanSpec)| {
                let roles = Costs::new(entries, self.robots.len())?;
                Some(Plan { roles, extra: spec.extra_ms })
            };
            plans.filter_map(plan).collect()
        };
        self.entries.iter().zip(tasks).map(of).collect()
    }
}

/// Whether no task and no robot is in two shares.
fn is_disjoint(shares: &[Share]) -> bool {
    let mut tasks: Vec<usize> = shares.iter().map(|it| it.task).collect();
    let mut robots: Vec<usize> =
        shares.iter().flat_map(|it| it.robots.iter().map(|it| it.robot)).collect();
    tasks.sort_unstable();
    robots.sort_unstable();
    tasks.windows(2).all(|it| it[0] < it[1]) && robots.windows(2).all(|it| it[0] < it[1])
}

/// Memory for what is solved again and again.
#[derive(Debug, Default)]
pub(super) struct Allocator {
    words: Vec<u32>,
    amounts: Vec<i64>,
    entries: Vec<Option<Cost>>,
    states: Vec<State>,
    workspace: Workspace<MAX_ROBOTS>,
}

impl Allocator {
    /// Returns the awards of these open tasks, from the bids of robots. `waited_ms` is for how long
    /// each has been waiting: by so much more it costs to leave it undone for now.
    pub(super) fn choose(
        &mut self,
        scenario: &Scenario,
        tasks: &[usize],
        waited_ms: &[u64],
        bids: &[(usize, &[Offer])],
    ) -> Vec<Share> {
        let tables = Tables::new(scenario, tasks, bids);
        if tables.robots.is_empty() || tasks.is_empty() {
            return Vec::new();
        }
        let plans = tables.plans(scenario, tasks);
        let mut listed: Vec<Task<'_>> = Vec::with_capacity(tasks.len());
        for ((&task, plans), waited) in tasks.iter().zip(&plans).zip(waited_ms) {
            let spec = &scenario.tasks[task];
            let skip = u64::from(spec.utility_ms).saturating_add(*waited).min(500_000_000);
            let skip = Cost::new(skip as u32);
            listed.push(Task { skip, combine: spec.combine, plans });
        }
        let Ok(team) = Team::new(tables.robots.len(), tables.denominator, &listed) else {
            return Vec::new();
        };
        let mut shares = match scenario.method {
            Method::Optimal => self.optimal(scenario, tasks, &tables, &team),
            Method::Rounds => self.rounds(scenario, tasks, &tables, &team),
            Method::OneByOne => self.one_by_one(scenario, tasks, &tables, &listed),
        };
        reliable::prefer(scenario, tables.denominator, bids, &mut shares);
        debug_assert!(is_disjoint(&shares), "a task is given once, a robot has one task");
        shares
    }

    /// All at once.
    fn optimal(
        &mut self,
        scenario: &Scenario,
        numbers: &[usize],
        tables: &Tables,
        team: &Team<'_>,
    ) -> Vec<Share> {
        let tasks = team.tasks();
        let mut joint = self.workspace.winners(team, 64 * tasks.len());
        if joint.solve(team, STEPS).is_err() {
            return Vec::new();
        }
        let mut shares = Vec::new();
        for (place, &task) in numbers.iter().enumerate() {
            let Some((plan, _)) = joint.chosen(place) else { continue };
            let columns: Vec<usize> = joint.robots(place).collect();
            shares.extend(share(scenario, tables, (task, place), plan, &columns, &tasks[place]));
        }
        shares
    }

    /// The memory for one assignment of so many rows and columns.
    fn memory(&mut self, rows: usize, columns: usize) -> Option<Memory<'_, i64>> {
        let words = Memory::<i64>::words(rows, columns);
        let amounts = Memory::<i64>::amounts(columns);
        self.words.resize(words.max(self.words.len()), 0);
        self.amounts.resize(amounts.max(self.amounts.len()), 0);
        Memory::new(rows, columns, &mut self.words, &mut self.amounts).ok()
    }

    /// The rounds of the thesis.
    fn rounds(
        &mut self,
        scenario: &Scenario,
        numbers: &[usize],
        tables: &Tables,
        team: &Team<'_>,
    ) -> Vec<Share> {
        let tasks = team.tasks();
        let rows = tasks.len() + 8;
        let columns = tables.robots.len() + tasks.len();
        self.entries.resize((rows * columns).max(self.entries.len()), None);
        self.states.resize(tasks.len(), State::Open);
        let (mut states, mut entries) =
            (std::mem::take(&mut self.states), std::mem::take(&mut self.entries));
        let done = self.memory(rows, columns).and_then(|mut memory| {
            thesis::greedy(team, &mut states, &mut entries, &mut memory).ok()
        });
        let mut shares = Vec::new();
        for (place, state) in states.iter().enumerate().filter(|_| done.is_some()) {
            if let State::Done { plan, robots } = *state {
                let columns = self.staff(&tasks[place], plan, robots).unwrap_or_default();
                let at = (numbers[place], place);
                shares.extend(share(scenario, tables, at, plan, &columns, &tasks[place]));
            }
        }
        (self.states, self.entries) = (states, entries);
        shares
    }

    /// One task after the other.
    fn one_by_one(
        &mut self,
        scenario: &Scenario,
        numbers: &[usize],
        tables: &Tables,
        tasks: &[Task<'_>],
    ) -> Vec<Share> {
        let mut free: RobotSet = (1 << tables.robots.len()) - 1;
        let mut shares = Vec::new();
        for (place, task) in tasks.iter().enumerate() {
            let mut best: Option<(u64, usize, Vec<usize>)> = None;
            for (plan, it) in task.plans.iter().enumerate() {
                if it.roles.rows() > free.count_ones() as usize {
                    continue;
                }
                let Some(columns) = self.staff(task, plan, free) else { continue };
                let costs = columns
                    .iter()
                    .enumerate()
                    .filter_map(|(role, &it)| task.plans[plan].roles.cost(role, it));
                let cost = task.cost(it, tables.denominator, costs);
                if best.as_ref().is_none_or(|it| cost < it.0) {
                    best = Some((cost, plan, columns));
                }
            }
            let Some((cost, plan, columns)) = best else { continue };
            let skip = u64::from(task.skip.map_or(0, Cost::get));
            if cost >= skip * u64::from(tables.denominator) {
                continue;
            }
            free = columns.iter().fold(free, |set, it| set & !(1 << it));
            shares.extend(share(scenario, tables, (numbers[place], place), plan, &columns, task));
        }
        shares
    }

    /// The column of each role of a plan, from these.
    fn staff(&mut self, task: &Task<'_>, plan: usize, free: RobotSet) -> Option<Vec<usize>> {
        let roles = &task.plans.get(plan)?.roles;
        let columns: Vec<usize> = (0..roles.columns()).filter(|it| free >> it & 1 == 1).collect();
        let rows = 0..roles.rows();
        let table: Vec<Option<Cost>> = rows
            .flat_map(|row| columns.iter().map(move |&it| (row, it)))
            .map(|(row, it)| roles.cost(row, it))
            .collect();
        let only = [Plan { roles: Costs::new(&table, columns.len())?, extra: 0 }];
        let only = Task { plans: &only, ..*task };
        let denominator = common_denominator(1..=roles.rows() as u32);
        let mut memory = self.memory(roles.rows(), columns.len())?;
        coalition(&only, denominator, &mut memory).ok()?;
        (0..roles.rows()).map(|row| columns.get(memory.column(row)?).copied()).collect()
    }

    /// The best coalition among those that a broker answers for (Algorithm A.1), from the replies
    /// of all bidders; the first of equal ones. Announced is one task.
    pub(super) fn best_of_shares(
        &mut self,
        scenario: &Scenario,
        broker: usize,
        task: usize,
        bids: &[(usize, &[Offer])],
    ) -> Option<Share> {
        let tables = Tables::new(scenario, &[task], bids);
        let spec = &scenario.tasks[task];
        let plans = tables.plans(scenario, &[task]);
        let plans = plans.first()?;
        let whole = Task { skip: None, combine: spec.combine, plans };
        let sets = shares_of(scenario.robots.len(), broker);
        // Coalitions that are not capable are passed over before their bids are (3.4.2).
        let robots: Vec<_> = scenario.robots.iter().map(RobotSpec::capabilities).collect();
        let gates: Vec<_> = spec.plans.iter().map(|it| Gate::new(it, &robots)).collect();
        let mut best: Option<Share> = None;
        for set in sets {
            let columns = tables.robots.iter().enumerate().filter(|it| set >> it.1 & 1 == 1);
            let columns: RobotSet = columns.fold(0, |all, it| all | 1 << it.0);
            for (plan, it) in plans.iter().enumerate() {
                let size = it.roles.rows() as u32;
                if size != set.count_ones() || size != columns.count_ones() {
                    continue;
                }
                let capable = |it: &Gate<'_>| it.passes(set as u64) == Passes::Matching;
                if !gates.get(plan).is_some_and(capable) {
                    continue;
                }
                let Some(chosen) = self.staff(&whole, plan, columns) else { continue };
                let found = share(scenario, &tables, (task, 0), plan, &chosen, &whole);
                let better = |it: &Share| {
                    best.as_ref().is_none_or(|best| {
                        let reliable = || best.is_more_reliable(it);
                        it.cost.cmp(&best.cost).then_with(reliable).is_lt()
                    })
                };
                if let Some(found) = found.filter(better) {
                    best = Some(found);
                }
            }
        }
        best
    }

    /// Whether some coalition of these robots can do a task: `can` says who can fill which role.
    pub(super) fn can_staff(
        &mut self,
        spec: &TaskSpec,
        robots: &[usize],
        can: impl Fn(usize, usize, usize) -> bool,
    ) -> bool {
        let width = robots.len();
        spec.plans.iter().enumerate().any(|(plan, it)| {
            let roles = 0..it.roles.len();
            let entry = |(role, &robot)| {
                if can(plan, role, robot) { Cost::new(0) } else { None }
            };
            let table: Vec<_> =
                roles.flat_map(|role| robots.iter().map(move |it| (role, it))).map(entry).collect();
            let Some(table) = Costs::new(&table, width).filter(|_| width >= it.roles.len()) else {
                return false;
            };
            let memory = self.memory(it.roles.len(), width);
            memory.is_some_and(|mut memory| assign(&table, &mut memory).is_ok())
        })
    }
}

/// The coalitions that a broker of so many answers for.
fn shares_of(robots: usize, broker: usize) -> Vec<RobotSet> {
    fn of<const N: usize>(broker: usize) -> Vec<RobotSet> {
        Shares::<N>::new().filter(|it| it.1 == broker).map(|it| it.0).collect()
    }
    match robots {
        1 => of::<1>(broker),
        2 => of::<2>(broker),
        3 => of::<3>(broker),
        4 => of::<4>(broker),
        5 => of::<5>(broker),
        6 => of::<6>(broker),
        7 => of::<7>(broker),
        8 => of::<8>(broker),
        9 => of::<9>(broker),
        10 => of::<10>(broker),
        11 => of::<11>(broker),
        12 => of::<12>(broker),
        _ => Vec::new(),
    }
}

/// The most robots of which brokers share the coalitions: these are 2ⁿ.
pub(super) const MAX_SHARED: usize = 12;

/// A choice with its costs.
fn share(
    scenario: &Scenario,
    tables: &Tables,
    (task, _place): (usize, usize),
    plan: usize,
    columns: &[usize],
    of: &Task<'_>,
) -> Option<Share> {
    let chosen = of.plans.get(plan)?;
    let cost = |(role, &column): (usize, &usize)| chosen.roles.cost(role, column);
    let costs: Vec<Cost> = columns.iter().enumerate().map(cost).collect::<Option<_>>()?;
    if costs.len() != scenario.tasks[task].plans[plan].roles.len() {
        return None;
    }
    let robots = columns.iter().zip(&costs).enumerate().map(|(role, (&column, cost))| {
        let robot = tables.robots[column];
        let success = tables.success([task, plan, role, robot]);
        Member { robot, cost_ms: cost.get(), success }
    });
    let cost = of.cost(chosen, tables.denominator, costs.iter().copied());
    Some(Share { task, plan, robots: robots.collect(), cost })
}

/// The scale of costs where brokers bid: that of all plans of the task.
pub(super) fn denominator(spec: &TaskSpec) -> u32 {
    common_denominator(spec.plans.iter().map(|it| it.roles.len() as u32))
}

/// Whether brokers can share the coalitions of this team.
pub(super) fn is_shared(scenario: &Scenario) -> bool {
    scenario.formation == Formation::Distributed && scenario.robots.len() <= MAX_SHARED
}
