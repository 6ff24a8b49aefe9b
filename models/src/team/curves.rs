//! Growth of the thesis's methods with the number of robots (Fig. 3.4, 3.5, Table 3.2), and the
//! benchmark of one task with a plan for each number of robots, of which some are capable (3.6.4,
//! Fig. 3.8).
//!
//! All numbers are counts of steps, as the thesis counts them: to assign z roles to z robots takes
//! z³ steps. Coalitions are those of Algorithm A.1, one after the other.

use super::capability::CapabilitySet;
use super::scenario::{Gate, Give, Needs, PlanSpec, Pruning, RoleSpec, Take};
use super::service::{GRASP_2F, MOVE};
use super::thesis::{Shares, all_orderings};
use cotama_core::team::{Combine, Cost, Costs, Plan, Task};

/// The most robots of which all coalitions are listed.
pub const MOST_ROBOTS: usize = 16;
/// The most robots of which all orderings are listed: 986,409 of nine.
pub const MOST_ORDERED: usize = 9;

/// Work of one task with a plan for each number of robots, all of which are capable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Growth {
    /// Robots of the team.
    pub robots: u64,
    /// Coalitions, without the empty one.
    pub coalitions: u64,
    /// Steps of `MuRoCo`: the auctioneer assigns the roles of all coalitions.
    pub central: u64,
    /// Steps of `MuRoCo`-D: those of the robot whose share of coalitions takes most.
    pub distributed: u64,
    /// Orderings of robots, each a step, as an exhaustive search takes them; `None` for more than
    /// [`MOST_ORDERED`] robots.
    pub orderings: Option<u64>,
    /// Steps of one assignment a plan, as this project takes them: k²n for k roles and n robots.
    pub assignment: u64,
    /// Bounds of Table 3.2.
    pub bounds: Bounds,
}

/// Bounds of the thesis on the growth of methods (Table 3.2), for one plan of each size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// `MuRoCo`: 2ⁿn³.
    pub central: u64,
    /// `MuRoCo`-D: 2ⁿn².
    pub distributed: u64,
    /// An exhaustive search: n!.
    pub orderings: u64,
    /// The least share k/n, in thousandths, for which a search that takes coalitions of k robots
    /// at most, in nᵏ steps, takes as many as `MuRoCo` (Fig. 3.5a); above 1,000 there is none. 0
    /// for one robot.
    pub share_permille: u64,
    /// Steps that a message may take before `MuRoCo` is quicker than `MuRoCo`-D (Fig. 3.5b).
    pub steps_a_message: u64,
}

/// Returns the work for so many robots, at most [`MOST_ROBOTS`]; of more, that of these.
///
/// ```
/// use cotama_models::team::curves::growth;
/// let four = growth(4);
/// assert_eq!((four.coalitions, four.orderings), (15, Some(64)));
/// assert_eq!((four.central, four.distributed, four.assignment), (224, 92, 120));
/// assert_eq!(four.bounds.share_permille, 1_250); // Fig. 3.5a begins above 1
/// ```
pub fn growth(robots: usize) -> Growth {
    let own = benchmark(robots, robots);
    let sizes = 1..=own.robots;
    Growth {
        robots: own.robots,
        coalitions: own.all.coalitions,
        central: own.all.steps,
        distributed: own.busiest,
        orderings: orderings(robots),
        assignment: sizes.map(|it| it.pow(2) * own.robots).sum(),
        bounds: Bounds::of(own.robots),
    }
}

impl Bounds {
    fn of(n: u64) -> Self {
        let all = 1_u64 << n;
        // nᵏ = 2ⁿn³ where k/n = 1 / log₂ n + 3 / n.
        let share = |n: u64| {
            let parts = 1_000_u64 << FRACTION;
            let share = (u128::from(parts) << FRACTION) / u128::from(log2(n));
            let share = share as u64 + 3 * parts / n;
            (share + (1 << (FRACTION - 1))) >> FRACTION
        };
        Self {
            central: all * n.pow(3),
            distributed: all * n.pow(2),
            orderings: (1..=n).product(),
            share_permille: if n > 1 { share(n) } else { 0 },
            // (2ⁿn³ - 2ⁿn²) / 2n², by the messages of Table 3.1.
            steps_a_message: all / 2 * n.saturating_sub(1),
        }
    }
}

/// Digits of a logarithm after the point.
const FRACTION: u32 = 24;

/// Returns the logarithm of a number of robots to base 2, in parts of 2²⁴, rounded down.
fn log2(n: u64) -> u64 {
    let whole = n.max(1).ilog2();
    // The rest is from 1 to 2, in parts of 2⁶⁰: each square of it tells a digit.
    let mut rest = u128::from(n) << (60 - whole);
    let mut log = u64::from(whole);
    for _ in 0..FRACTION {
        rest = (rest * rest) >> 60;
        let digit = u64::from(rest >= 2 << 60);
        rest >>= digit;
        log = log << 1 | digit;
    }
    log
}

/// Counts orderings by going through them.
fn orderings(robots: usize) -> Option<u64> {
    if robots > MOST_ORDERED {
        return None;
    }
    let costs = vec![Cost::new(0); robots * robots];
    let plan = |roles: usize| {
        let roles = Costs::new(costs.get(..roles * robots)?, robots)?;
        Some(Plan { roles, extra: 0 })
    };
    let plans: Option<Vec<_>> = (1..=robots).map(plan).collect();
    let task = Task { skip: None, combine: Combine::Sum, plans: &plans? };
    Some(all_orderings(&task, 1, &mut [0; MOST_ORDERED]).looked_at)
}

/// One task with a plan for each number of robots, of which some are capable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Benchmark {
    /// Robots of the team.
    pub robots: u64,
    /// Robots that can fill a role.
    pub capable: u64,
    /// Work of the auctioneer, with each condition on coalitions and without.
    pub all: Pruning,
    /// Steps of the robot whose share of coalitions takes most (`MuRoCo`-D), for those alone that
    /// are capable.
    pub busiest: u64,
}

/// Returns the work of a team of which some robots are capable. All roles need the same (Fig. 3.8):
/// to move and to grasp, as robots do that carry something together. The other robots can move, or
/// grasp, in turns.
///
/// ```
/// use cotama_models::team::curves::benchmark;
/// let half = benchmark(8, 4).all;
/// // Nearly all of 255 coalitions can move and grasp, as long as nobody asks who.
/// assert_eq!([half.union, half.roles, half.matching], [249, 240, 15]);
/// ```
pub fn benchmark(robots: usize, capable: usize) -> Benchmark {
    let robots = robots.min(MOST_ROBOTS);
    let capable = capable.min(robots);
    let able = |number: usize| match number.checked_sub(capable) {
        None => CapabilitySet::of(&[MOVE, GRASP_2F]),
        Some(it) if it % 2 == 0 => CapabilitySet::of(&[MOVE]),
        Some(_) => CapabilitySet::of(&[GRASP_2F]),
    };
    let able: Vec<CapabilitySet> = (0..robots).map(able).collect();
    let role = RoleSpec {
        name: "carry".to_owned(),
        actions: vec![Needs::all(&[MOVE, GRASP_2F])],
        take: Take::Object,
        give: Give::Goal,
        take_ms: 0,
        give_ms: 0,
    };
    let plan = |size| {
        let roles = vec![role.clone(); size];
        PlanSpec { name: "carry".to_owned(), extra_ms: 0, roles }
    };
    let plans: Vec<PlanSpec> = (1..=robots).map(plan).collect();
    let gates: Vec<Gate<'_>> = plans.iter().map(|it| Gate::new(it, &able)).collect();
    let (mut all, mut shares) = (Pruning::default(), [Pruning::default(); MOST_ROBOTS]);
    each(robots, |coalition, robot| {
        let size = coalition.count_ones();
        let Some(gate) = gates.get(size as usize - 1) else { return };
        let passes = gate.passes(coalition);
        all.meet(size.into(), passes);
        shares[robot].meet(size.into(), passes);
    });
    Benchmark {
        robots: robots as u64,
        capable: capable as u64,
        all,
        busiest: shares.iter().map(Pruning::steps_capable).max().unwrap_or(0),
    }
}

/// Runs something on each coalition, with the robot that answers for it (Algorithm A.1).
fn each(robots: usize, mut act: impl FnMut(u64, usize)) {
    let act = |(set, robot): (u128, usize)| act(set as u64, robot);
    macro_rules! of {
        ($($size:literal)*) => {
            match robots {
                $($size => Shares::<$size>::new().for_each(act),)*
                _ => {}
            }
        };
    }
    of!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
}

/// A condition on coalitions before their roles are assigned, and what it pays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PayOff {
    /// Coalitions that meet it.
    pub passed: u64,
    /// Steps with the condition first (3.16).
    pub steps: u64,
    /// Whether these are fewer than without.
    pub pays: bool,
    /// By the rule of the thesis it pays where at most this share of coalitions meets it (3.17),
    /// in thousandths: 1 - 1/z², 1 - 1/z and 0 for a mean of z = n/2 robots.
    pub rule_permille: u64,
}

impl Benchmark {
    /// Returns the pay-off of the three conditions: cap1, cap2, cap3.
    pub fn pay_offs(&self) -> [PayOff; 3] {
        let (n, it) = (self.robots.max(2), &self.all);
        let rule = |over: u64, under: u64| (under - over) * 1_000 / under;
        [
            (it.union, it.steps_union, rule(4, n * n)),
            (it.roles, it.steps_roles, rule(2, n)),
            (it.matching, it.steps_matching, 0),
        ]
        .map(|(passed, steps, rule_permille)| {
            let pays = steps < it.steps;
            PayOff { passed, steps, pays, rule_permille }
        })
    }

    /// Returns the share of coalitions that meet a condition, in thousandths, rounded down.
    pub fn share_permille(&self, passed: u64) -> u64 {
        passed * 1_000 / self.all.coalitions.max(1)
    }
}
