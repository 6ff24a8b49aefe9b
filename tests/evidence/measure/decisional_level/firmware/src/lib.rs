//! The entry points of the decisional level, of teams of eight robots, and of posteriors: linked
//! alone, each keeps its own code and tables only.
#![no_std]

#[path = "../../../../no_std/src/asia.rs"]
mod asia;
#[path = "../../../../no_std/src/two_ways.rs"]
mod two_ways;

use core::panic::PanicInfo;
use cotama_core::allocation::MemoryError;
use cotama_core::executive::Happening;
use cotama_core::hardware::Equipment;
use cotama_core::monitor::Request;
use cotama_core::team::winners::{
    Column, Level, Open, PlanEntry, Slot, Solved, Winners, WinnersMemory,
};
use cotama_core::team::{AssignmentError, Bottleneck, Costs, Fixed, Team, assign, bottleneck};
use cotama_core::units::{Micros, Millis};
use cotama_inference::{Answer, NoAnswer, Query};
use cotama_models::level::{Drive, Perceived, Requests, Round, Rows, Told};
use cotama_models::missions::tables::Rest;
use cotama_printed::{Careful, Level as Supervisors};
use decisional_level::Robot;

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `robot_`, which nothing else does, and the linker starts at them.
macro_rules! entries {
    ($(
        $(#[$doc:meta])* $name:ident($($arg:ident: $type:ty),*) $(-> $out:ty)? = $body:expr;
    )*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        #[inline(never)]
        pub fn $name($($arg: $type),*) $(-> $out)? { $body }
    )*};
}

entries! {
    /// At rest.
    robot_new() -> Option<Robot> = Robot::new();
    /// An event from outside.
    robot_tell(level: &mut Supervisors<Careful>, told: Told) =
        decisional_level::reach::tell(level, told);
    /// A round.
    robot_round(level: &mut Supervisors<Careful>) = decisional_level::reach::round(level);
    /// Flags: diagnosed, and what they are taken for waits to be told.
    robot_perceive(robot: &mut Robot, now: Millis, seen: Perceived) -> Rows =
        robot.perceive(now, seen);
    /// A period, with everything that fires shown to a witness, and its requests.
    robot_decide(
        robot: &mut Robot, now: Millis, said: Option<Told>, drive: Drive, fired: &mut u32
    ) -> (Round, Requests) = robot.decide(now, said, drive, fired);
    /// Time, a job that is done, a fault that was answered.
    robot_schedule(
        robot: &mut Robot, now: Micros, done: Option<usize>, answered: Option<usize>
    ) -> Option<Happening> = robot.schedule(now, done, answered);
    /// Consumption.
    robot_watch(robot: &mut Robot, spent: &[u64; 2], rest: &[u64; 2]) -> Option<Request> =
        robot.watch(spent, rest);
    /// A plan by the rule of the paper.
    robot_plan_by_rule(robot: &mut Robot, first: usize, rest: Rest, units: Equipment) -> bool =
        robot.mission().plan_by_rule(first, rest, units);
    /// A plan by the exact allocator.
    robot_plan_exactly(robot: &mut Robot, first: usize, rest: Rest, units: Equipment) -> bool =
        robot.mission().plan_exactly(first, rest, units);
    /// Roles to robots at the least sum.
    robot_assign(
        costs: &Costs<'_>, memory: &mut Fixed<i32, 8, 8>
    ) -> Result<u64, AssignmentError> = assign(costs, &mut memory.memory());
    /// Roles to robots with the largest cost as small as can be.
    robot_bottleneck(
        costs: &Costs<'_>, memory: &mut Fixed<i32, 8, 8>
    ) -> Result<Bottleneck, AssignmentError> = bottleneck(costs, &mut memory.memory());
    /// All tasks of eight robots at once.
    robot_joint(
        team: &Team<'_>, memory: WinnersMemory<'_, 8>, steps: u64
    ) -> Result<Solved, MemoryError> = Winners::new(memory).solve(team, steps);
    /// Asia: lung given dyspnoea and an X-ray.
    robot_asia(evidence: &[u8; 2]) -> Found<2> =
        found::<{ asia::QUERY.scratch }, 2>(&asia::QUERY, evidence);
    /// Two ways: the ratio of objects given a trial.
    robot_two_ways(evidence: &[u8; 4]) -> Found<5> =
        found::<{ two_ways::QUERY.scratch }, 5>(&two_ways::QUERY, evidence);
}

/// The two queries.
pub const QUERIES: [Query<'_>; 2] = [asia::QUERY, two_ways::QUERY];

/// Probabilities in units of 2⁻³⁰, and that of the evidence.
pub type Found<const STATES: usize> = Result<([u32; STATES], Answer), NoAnswer>;

fn found<const CELLS: usize, const STATES: usize>(
    query: &Query<'_>,
    evidence: &[u8],
) -> Found<STATES> {
    let (mut scratch, mut posterior) = ([0; CELLS], [0; STATES]);
    let answer = query.answer(evidence, &mut scratch, &mut posterior)?;
    Ok((posterior, answer))
}

/// Memory for eight robots and four tasks of two roles.
pub struct TeamRoom {
    roles: [[i64; 8]; 8],
    plans: [PlanEntry; 4],
    slots: [Slot; 4],
    columns: [Column; 256],
    open: [Open; 17],
    levels: [Level<8>; 9],
}

impl TeamRoom {
    /// Unused.
    pub const EMPTY: Self = Self {
        roles: [[0; 8]; 8],
        plans: [PlanEntry::EMPTY; 4],
        slots: [Slot::EMPTY; 4],
        columns: [Column::EMPTY; 256],
        open: [Open::EMPTY; 17],
        levels: [Level::EMPTY; 9],
    };

    /// The memory.
    pub fn memory(&mut self) -> WinnersMemory<'_, 8> {
        WinnersMemory {
            roles: &mut self.roles,
            plans: &mut self.plans,
            slots: &mut self.slots,
            columns: &mut self.columns,
            open: &mut self.open,
            levels: &mut self.levels,
        }
    }
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    semihosting::process::exit(101)
}
