//! Does everything that the level can do, between marks at which an emulator counts instructions. A
//! line `batch NAME COUNT` is printed for each row of regions; that of the exploration, for each
//! state: a round, then each event; that of missions by dice, for each period: the observers, then
//! the period.
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
use cotama_models::level::Perceived;
use cotama_models::missions::tables::delivery::ACTIVITIES;
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, patrol, remaining};
use cotama_printed::{Careful, Level, TABLES, at_rest};
use decisional_level::reach::{Reached, all_told};
use decisional_level::walk::{Period, Walk};
use decisional_level::{PLANNING_BYTES, Robot, TASKS};
use entries::{
    robot_decide, robot_perceive, robot_plan_by_rule, robot_plan_exactly, robot_round,
    robot_schedule, robot_tell,
};
use semihosting::println;

/// The states that there is memory for: the supervisors reach more.
const STATES: usize = 48 * 1024;
/// The periods of missions by dice, and of each of them.
const PERIODS: u64 = 20_000;
const MISSION: u64 = 64;

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

    let mut states = [at_rest(Careful::default()); STATES];
    let mut index = [0_u32; 2 * STATES];
    let mut reached = Reached::new(&mut states, &mut index);
    let _ = reached.explore(
        |level| counted!(robot_round(black_box(level))),
        |level, told| counted!(robot_tell(level, black_box(told))),
    );
    println!("batch explore {}", reached.count() * (1 + all_told().count()));
    println!("states {}", reached.count());
    for (number, told) in all_told().enumerate() {
        println!("event {number} {told:?}");
    }

    let Some(robot) = Robot::new() else { panic!("the modules do not fit") };
    perceive(&robot);
    walk(&robot);
    schedule(&robot);
    plan(&robot);
    println!("bytes robot {}", size_of::<Robot>());
    println!("bytes supervisors {}", size_of::<Level<Careful>>());
    println!("bytes executive {}", size_of::<Executive<TASKS>>());
    println!("bytes rule {}", PLANNING_BYTES[0]);
    println!("bytes exact {}", PLANNING_BYTES[1]);
    semihosting::process::exit(0)
}

/// All flags of each failure and of each two are raised at once, and all flags that there are.
fn perceive(robot: &Robot) {
    let mut regions = 0;
    let mut raise = |raised| {
        let seen = Perceived { raised, works: u64::MAX, ..Perceived::default() };
        let mut robot = *robot;
        counted!(robot_perceive(&mut robot, Millis(100), black_box(seen)));
        regions += 1;
    };
    for (number, one) in TABLES.failures.iter().enumerate() {
        for other in &TABLES.failures[number..] {
            raise(one.flags | other.flags);
        }
    }
    raise(TABLES.failures.iter().fold(0, |all, it| all | it.flags));
    println!("batch perceive {regions}");
}

/// Missions by dice: observers, then a period, each time.
fn walk(robot: &Robot) {
    let (mut robot, mut dice) = (*robot, Walk::new(1));
    for number in 0..PERIODS {
        if number % MISSION == 0 {
            robot.restart(at_rest(Careful::default()));
        }
        let now = Millis(1_000 * (1 + number % MISSION));
        let Period { seen, said, drive } = dice.next(robot.decider());
        counted!(robot_perceive(&mut robot, now, black_box(seen)));
        counted!(robot_decide(&mut robot, now, said, black_box(drive), &mut 0));
    }
    println!("batch walk {}", 2 * PERIODS);
}

/// Ten seconds of the control loop: every job is done after half of its budget, or hangs.
fn schedule(robot: &Robot) {
    let mut regions = 0;
    for hangs in [false, true] {
        let mut robot = *robot;
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
                let mut robot = *robot;
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
