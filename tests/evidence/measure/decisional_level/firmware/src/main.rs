//! Does everything that the level can do, between marks at which an emulator counts instructions. A
//! line `batch NAME COUNT` is printed for each row of regions; that of the exploration, for each
//! state: a round, then each event.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m_rt::entry;
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Seen, Stage};
use cotama_core::executive::Executive;
use cotama_core::hardware::Equipment;
use cotama_core::panorama::Panorama;
use cotama_core::problem::Problem;
use cotama_core::units::{Micros, Millimetres, Millis};
use cotama_models::cotama::load::Load;
use cotama_models::cotama::{
    Body, DecisionalLevel, FailureMode, Losses, Modules, Perceived, Situation,
};
use cotama_models::missions::tables::delivery::ACTIVITIES;
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, patrol, remaining};
use decisional_level::reach::{Reached, TOLD};
use decisional_level::{PLANNING_BYTES, Robot, TASKS};
use entries::{
    robot_decide, robot_perceive, robot_plan_by_rule, robot_plan_exactly, robot_round,
    robot_schedule, robot_tell,
};
use semihosting::println;

const STATES: usize = 112 * 1024;
/// The situations of the supervisors of a drive, at most.
const SITUATIONS: usize = 32;

/// The emulator looks for this function by its name.
// `no_mangle` counts as unsafe because two equal names would meet at link time: no other
// function is called so.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn icount_mark() {
    black_box(());
}

/// Counts the instructions between two marks.
macro_rules! counted {
    ($act:expr) => {{
        icount_mark();
        let answer = black_box($act);
        icount_mark();
        answer
    }};
}

#[entry]
fn main() -> ! {
    counted!(());
    println!("batch empty 1");
    plan_patrol();

    let mut states = [DecisionalLevel::default(); STATES];
    let mut index = [0_u32; 2 * STATES];
    let mut reached = Reached::new(&mut states, &mut index);
    let complete = reached.explore(
        |level| counted!(robot_round(black_box(level))),
        |level, told| counted!(robot_tell(level, black_box(told))),
    );
    assert!(complete, "more than {STATES} states");
    println!("batch explore {}", reached.count() * (1 + TOLD.len()));
    println!("states {}", reached.count());
    for (number, told) in TOLD.iter().enumerate() {
        println!("event {number} {told:?}");
    }

    let Some(robot) = Robot::new(black_box(Load::Busy)) else { panic!("the modules do not fit") };
    let (situations, count) = situations(&reached);
    // Each row of the FMECA shows in each situation with each set of losses, and is told.
    let each = |act: &mut dyn FnMut(&mut Robot, Perceived)| {
        let mut regions = 0;
        for &level in &situations[..count] {
            for lost in (0..=Losses::ALL.bits()).filter_map(Losses::from_bits) {
                for &mode in FailureMode::ALL {
                    let raised = mode.rule().signature.always;
                    let seen = Perceived { raised, ..Perceived::nothing(Modules::ALL) };
                    act(&mut robot.at(level, lost.health()), black_box(seen));
                    regions += 1;
                }
            }
        }
        regions
    };
    let perceived = each(&mut |robot, seen| {
        counted!(robot_perceive(robot, Millis(100), seen));
    });
    println!("batch perceive {perceived}");
    let decided = each(&mut |robot, seen| {
        let body = Body { at_goal: false, stands: false };
        let _ = robot_perceive(robot, Millis(100), seen);
        counted!(robot_decide(robot, Millis(100), None, body, &mut 0));
    });
    println!("batch decide {decided}");
    println!("situations {count}");
    schedule(&robot);
    plan(&robot);
    println!("bytes robot {}", size_of::<Robot>());
    println!("bytes supervisors {}", size_of::<DecisionalLevel>());
    println!("bytes executive {}", size_of::<Executive<TASKS>>());
    println!("bytes rule {}", PLANNING_BYTES[0]);
    println!("bytes exact {}", PLANNING_BYTES[1]);
    semihosting::process::exit(0)
}

/// A reachable level for each situation of the supervisors of a drive.
fn situations(reached: &Reached<'_>) -> ([DecisionalLevel; SITUATIONS], usize) {
    let mut found = [(Situation::AT_REST, DecisionalLevel::default()); SITUATIONS];
    let mut count = 0;
    for number in 0..reached.count() {
        let Some(level) = reached.state(number) else { break };
        let situation = level.situation(Losses::NONE);
        if found[..count].iter().all(|it| it.0 != situation) {
            found[count] = (situation, level);
            count += 1;
        }
    }
    (found.map(|it| it.1), count)
}

/// Ten seconds of the control loop: every job is done after half of its budget, or hangs.
fn schedule(robot: &Robot) {
    let mut regions = 0;
    for hangs in [false, true] {
        let mut robot = robot.at(DecisionalLevel::default(), Losses::NONE.health());
        for now in (0..10_000_000).step_by(500).map(Micros) {
            while counted!(robot_schedule(&mut robot, black_box(now), None, None)).is_some() {
                regions += 1;
            }
            regions += 1;
            if let (false, Some(task)) = (hangs, robot.running()) {
                let _ = counted!(robot_schedule(&mut robot, black_box(now), Some(task), None));
                regions += 1;
            }
        }
    }
    println!("batch schedule {regions}");
}

/// From each activity on, with each set of modules.
fn plan(robot: &Robot) {
    let regions = ACTIVITIES.len() << 11;
    let each = |name: &str, plans: fn(&mut Robot, usize, Rest, Equipment) -> bool| {
        for (first, activity) in ACTIVITIES.iter().enumerate() {
            let rest = match activity.length() {
                Millimetres(0) => Rest::Time(Millis(30_000)),
                length => Rest::Travel(length),
            };
            for kinds in 0..1_u32 << 11 {
                let have = (0..11).filter(|kind| kinds >> kind & 1 == 1);
                let units =
                    have.fold(Equipment::NONE, |units, kind| units.with(kind, 1).unwrap_or(units));
                let mut robot = robot.at(DecisionalLevel::default(), Losses::NONE.health());
                counted!(plans(&mut robot, first, black_box(rest), black_box(units)));
            }
        }
        println!("batch {name} {regions}");
    };
    each("rule", robot_plan_by_rule);
    each("exact", robot_plan_exactly);
}

/// The patrol, whose 17 activities have 185 candidates, by the rule and exactly: the allocators
/// alone, without the candidates' costs.
fn plan_patrol() {
    use patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
    const CANDIDATES: usize = buffer_sizes(&ACTIVITIES).0;
    const STAGES: usize = ACTIVITIES.len();
    const SEEN: usize = 64;

    let mut candidates = [EMPTY; CANDIDATES];
    let mut lists = [&[][..]; STAGES];
    let first = ACTIVITIES[0].whole(&ACTIVITIES[0].alternatives[0]);
    let Ok(lists) = remaining(&ACTIVITIES, Some(first), AVAILABLE, &mut candidates, &mut lists)
    else {
        panic!("an activity of the patrol has no candidate")
    };
    let Ok(problem) = Problem::new(lists, LIMITS, ORDER) else { panic!("no problem") };
    let mut plan = [0; STAGES];

    let mut caps = [[0; 2]; STAGES];
    let mut rule = Panorama::new(&mut caps);
    let planned = counted!(rule.allocate(black_box(&problem), &mut plan));
    assert!(matches!(planned, Ok(Answer::Planned(_))), "the rule finds a plan");
    println!("batch patrol_rule 1");

    let (mut items, mut stages) = ([Item::EMPTY; CANDIDATES], [Stage::EMPTY; STAGES]);
    let mut seen = [Seen::EMPTY; SEEN];
    let mut exact = Exact::new(&[Objective::MostQuality], u64::MAX, &mut items, &mut stages)
        .with_memory(&mut seen);
    let planned = counted!(exact.allocate(black_box(&problem), &mut plan));
    assert!(matches!(planned, Ok(Answer::Planned(it)) if it.optimal), "the best plan is found");
    println!("batch patrol_exact 1");
    println!(
        "bytes patrol_exact {}",
        size_of_val(&items) + size_of_val(&stages) + size_of_val(&seen)
    );
}
