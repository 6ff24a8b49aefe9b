//! Plans a mission of three activities within a time and an energy limit, watches it, and plans
//! the rest anew when it no longer fits: `cargo run -p cotama-core --example allocate`.
//!
//! The robot crosses a hall, reads a gauge and returns. Each activity can be done in several ways,
//! which cost time and energy and differ in how well the robot knows where it is.

use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request, Trigger};
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem};

const DURATION: usize = 0;
const ENERGY: usize = 1;

/// One way to do an activity: ms, mJ, quality.
const fn way(duration_ms: u32, energy_mj: u32, quality: u32) -> Candidate<2> {
    Candidate { cost: [duration_ms, energy_mj], quality, id: 0 }
}

/// Odometry alone, sonar, laser: the better the localisation, the more energy it takes.
static CROSS: [Candidate<2>; 3] =
    [way(60_000, 600_000, 1), way(75_000, 900_000, 4), way(70_000, 1_400_000, 9)];
/// From afar or close by.
static READ: [Candidate<2>; 2] = [way(10_000, 100_000, 2), way(20_000, 300_000, 5)];
static RETURN: [Candidate<2>; 3] =
    [way(60_000, 500_000, 1), way(75_000, 800_000, 6), way(70_000, 1_400_000, 9)];
static MISSION: [&[Candidate<2>]; 3] = [&CROSS, &READ, &RETURN];

/// Three minutes and 2,400 J; time is treated first.
const LIMITS: [u64; 2] = [180_000, 2_400_000];
const ORDER: [usize; 2] = [DURATION, ENERGY];

/// The best plan by quality, with its totals; nothing if no plan is within the limits.
fn plan<'p>(problem: &Problem<'_, 2>, plan: &'p mut [u16; 3]) -> Option<(&'p [u16], [u64; 2])> {
    // Memory for a problem of at most eight candidates and three activities.
    let (mut items, mut stages) = ([Item::EMPTY; 8], [Stage::EMPTY; 3]);
    let mut exact = Exact::new(&[Objective::MostQuality], 10_000, &mut items, &mut stages);
    match exact.allocate(problem, plan).ok()? {
        Answer::Planned(planned) => Some((&plan[..problem.activities().len()], planned.cost)),
        Answer::Infeasible { shortfall, .. } => {
            println!("no plan: {shortfall:?}");
            None
        }
        Answer::Unknown { .. } => None,
    }
}

/// Runs the program; returns the plan of the paper's rule, the best one, and the new one for the
/// rest.
pub(crate) fn run() -> Option<[Vec<u16>; 3]> {
    let problem = Problem::new(&MISSION, LIMITS, ORDER).ok()?;

    let (mut caps, mut by_rule) = ([[0; 2]; 3], [0; 3]);
    let answer = Panorama::new(&mut caps).allocate(&problem, &mut by_rule).ok()?;
    let Answer::Planned(planned) = answer else { return None };
    println!("by the paper's rule {by_rule:?}, quality {}", planned.quality);

    let mut memory = [0; 3];
    let (best, cost) = plan(&problem, &mut memory)?;
    let best = best.to_vec();
    let (_, quality) = problem.totals(&best)?;
    println!("the best            {best:?}, quality {quality}, {cost:?} ms and mJ");

    // People in the hall: crossing it took 15 s and 300 J more than planned.
    let mut monitor = Monitor::new(LIMITS, ORDER).ok()?;
    monitor.planned(&cost).ok()?;
    let crossing = MISSION[0][usize::from(best[0])].cost.map(u64::from);
    monitor.spend(&[crossing[DURATION] + 15_000, crossing[ENERGY] + 300_000]).ok()?;
    let rest = [cost[DURATION] - crossing[DURATION], cost[ENERGY] - crossing[ENERGY]];
    println!("margins after the first activity {:?}", monitor.margins(&rest).ok()?);

    let request = monitor.assess(&rest, Equipment::NONE, Equipment::NONE).ok()?;
    let Request::Down(Trigger::Margin { axis }) = request else { return None };
    println!("axis {axis} is short: a new plan for the rest");
    let left = Problem::new(&MISSION[1..], monitor.left(), ORDER).ok()?;
    let (new, cost) = plan(&left, &mut memory)?;
    monitor.planned(&cost).ok()?;
    println!("the new rest        {new:?}, {cost:?} ms and mJ");
    Some([by_rule.to_vec(), best, new.to_vec()])
}

fn main() {
    if run().is_none() {
        println!("the mission cannot be done like this");
    }
}
