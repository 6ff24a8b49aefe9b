//! Assigns teams of eight robots, between marks at which an emulator counts instructions. A line
//! `batch NAME COUNT` is printed for each row of regions, and `stack NAME BYTES` for the deepest
//! call of each.
#![no_std]
#![no_main]

mod depth;
#[allow(dead_code)]
#[path = "../../../../../../core/tests/common/draw.rs"]
mod draw;

use core::hint::black_box;
use cortex_m_rt::entry;
use cotama_core::team::winners::WinnersMemory;
use cotama_core::team::{Combine, Cost, Costs, Fixed, Plan, Task, Team, is_least};
use depth::depth;
use draw::Draw;
use entries::{TeamRoom, robot_assign, robot_bottleneck, robot_joint};
use semihosting::println;

/// Instances of each kind; of all tasks at once a tenth.
const EACH: u64 = 2_500;

/// The emulator looks for this function by its name.
// `no_mangle` counts as unsafe because two equal names would meet at link time: no other
// function is called so.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn icount_mark() {
    black_box(());
}

/// Counts the instructions between two marks.
fn counted<R>(act: impl FnOnce() -> R) -> R {
    icount_mark();
    let answer = black_box(act());
    icount_mark();
    answer
}

/// A table of eight rows: costs to the most, so many percent missing.
fn table(draw: &mut Draw, most: u64, missing: u64) -> [Option<Cost>; 64] {
    core::array::from_fn(|_| {
        let cost = Cost::new(draw.between(1, most) as u32);
        cost.filter(|_| draw.between(1, 100) > missing)
    })
}

/// Costs to this, and so many percent missing: few ties, many, and teams in which not all can all.
const KINDS: [(u64, u64); 4] = [(1_000_000, 0), (100, 0), (9, 0), (1_000_000, 50)];

#[entry]
fn main() -> ! {
    counted(|| ());
    println!("batch empty 1");
    let mut fixed = Fixed::<i32, 8, 8>::new();
    let (mut feasible, mut deepest) = (0_u32, [0; 3]);
    for (most, missing) in KINDS {
        let mut draw = Draw::new(most + missing);
        for number in 0..EACH {
            let entries = table(&mut draw, most, missing);
            let Some(costs) = Costs::new(&entries, 8) else { panic!("eight columns") };
            let total = counted(|| robot_assign(black_box(&costs), &mut fixed));
            let memory = fixed.memory();
            let proven = is_least(&costs, |row| memory.column(row), |column| memory.price(column));
            assert!(total.ok() == proven.ok(), "not proven");
            feasible += u32::from(total.is_ok());
            if number < 100 {
                let used = depth(|| _ = black_box(robot_assign(&costs, &mut fixed)));
                deepest[0] = used.max(deepest[0]);
            }
        }
    }
    println!("batch assign {}", 4 * EACH);
    println!("feasible {feasible}");
    for (most, missing) in KINDS {
        let mut draw = Draw::new(most + missing);
        for number in 0..EACH {
            let entries = table(&mut draw, most, missing);
            let Some(costs) = Costs::new(&entries, 8) else { panic!("eight columns") };
            let _ = counted(|| robot_bottleneck(black_box(&costs), &mut fixed));
            if number < 100 {
                let used = depth(|| _ = black_box(robot_bottleneck(&costs, &mut fixed)));
                deepest[1] = used.max(deepest[1]);
            }
        }
    }
    println!("batch bottleneck {}", 4 * EACH);
    let mut room = TeamRoom::EMPTY;
    for (most, missing) in KINDS {
        let mut draw = Draw::new(most + missing);
        for number in 0..EACH / 10 {
            // Four tasks of two roles each; which of them must be done is drawn.
            let entries = table(&mut draw, most, missing);
            let skip: [_; 4] = core::array::from_fn(|_| {
                Cost::new(draw.between(1, 2 * most) as u32).filter(|_| draw.between(0, 1) == 0)
            });
            let plans: [_; 4] = core::array::from_fn(|task| {
                let own = entries.get(16 * task..16 * task + 16).unwrap_or(&[]);
                let Some(roles) = Costs::new(own, 8) else { panic!("eight columns") };
                [Plan { roles, extra: 0 }]
            });
            let tasks: [_; 4] = core::array::from_fn(|task| Task {
                skip: skip[task],
                combine: if task % 2 == 0 { Combine::Sum } else { Combine::Max },
                plans: &plans[task],
            });
            let Ok(team) = Team::new(8, 1, &tasks) else { panic!("a team") };
            let solved = counted(|| robot_joint(black_box(&team), room.memory(), 100_000));
            assert!(solved.is_ok(), "there is memory");
            if number < 20 {
                let used = depth(|| _ = black_box(robot_joint(&team, room.memory(), 100_000)));
                deepest[2] = used.max(deepest[2]);
            }
        }
    }
    println!("batch joint {}", 4 * EACH / 10);
    println!("stack assign {}", deepest[0]);
    println!("stack bottleneck {}", deepest[1]);
    println!("stack joint {}", deepest[2]);
    println!("bytes table {}", size_of::<[Option<Cost>; 64]>());
    println!("bytes assign {}", size_of::<Fixed<i32, 8, 8>>());
    println!("bytes joint {}", size_of::<TeamRoom>() + size_of::<WinnersMemory<'_, 8>>());
    semihosting::process::exit(0)
}
