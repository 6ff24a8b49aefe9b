//! Does what the firmware does, between marks at which an emulator counts instructions. A line
//! `batch NAME COUNT` is printed for each row of regions, in their order.
#![no_std]
#![no_main]

use board::icount_mark;
use core::hint::black_box;
use cortex_m_rt::entry;
use cotama_core::allocation::Allocator;
use cotama_core::net::EventId;
use cotama_core::panorama::Panorama;
use cotama_core::player::Program;
use cotama_core::problem::Problem;
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, Rest, remaining};
use cotama_models::nets::ace::selection;
use cotama_models::nets::by_hand::local;
use robot::control::{Control, PERIOD_MS};
use robot::dice::Dice;
use robot::guard::Guard;
use robot::link::{Receiver, Sender};
use robot::message::Period;
use robot::patrol::{CANDIDATES, COURSE, Patrol, Planner, STAGES, Tables, Workspace};
use robot::robots::{delivery, transport};
use robot::surroundings::{Incident, SEVEN_POINTS, Surroundings};
use robot::trace::{Nowhere, Trace};
use semihosting::println;

/// Counts the instructions between two marks.
macro_rules! counted {
    ($act:expr) => {{
        icount_mark();
        let answer = black_box($act);
        icount_mark();
        answer
    }};
}

/// The transport robot loses its lidar, then its markers, then its wheels slip.
const TRANSPORT: [Incident; 3] = [
    Incident { at_mm: 10_000, failure: 0 },
    Incident { at_mm: 20_000, failure: 1 },
    Incident { at_mm: 30_000, failure: 2 },
];
/// So many random events for a net.
const EVENTS: u32 = 4_000;

#[entry]
fn main() -> ! {
    let Some(tables) = cortex_m::singleton!(: Tables = Tables::EMPTY) else { board::exit(103) };
    let Some(workspace) = cortex_m::singleton!(: Workspace = Workspace::EMPTY) else {
        board::exit(103)
    };
    counted!(());
    println!("batch empty 1");
    nets();
    level();
    allocators(workspace);
    missions(tables, &mut Planner::Rule, "by_the_rule");
    missions(tables, &mut Planner::Exact(workspace), "exactly");
    println!("bytes the_state_of_the_control_loop {}", size_of::<delivery::Control>());
    println!("bytes the_state_of_the_transport_robot {}", size_of::<transport::Control>());
    println!("bytes a_problem {}", size_of::<Tables>());
    println!("bytes the_memory_of_the_exact_allocator {}", size_of::<Workspace>());
    board::exit(0)
}

#[inline(never)]
fn local(player: &mut local::Player, now: Millis, event: Of<EventId>) -> bool {
    player.offer_id(now, event, (), &mut ()).fired()
}

#[inline(never)]
fn selection(player: &mut selection::Player, now: Millis, event: Of<EventId>) -> bool {
    player.offer_id(now, event, (), &mut ()).fired()
}

fn nets() {
    let mut dice = Dice::new(1);
    let mut player = local::Player::new();
    let events = local::NET.events.len() as u32;
    for now in (0..EVENTS).map(|it| Millis(it.into())) {
        let event = Of { component: 0, id: EventId(dice.roll(events)) };
        counted!(local(&mut player, now, black_box(event)));
    }
    println!("batch an_event_on_20_transitions {EVENTS}");
    let mut player = selection::Player::new();
    let events = selection::NET.events.len() as u32;
    for now in (0..EVENTS).map(|it| Millis(it.into())) {
        let event = Of { component: 0, id: EventId(dice.roll(events)) };
        counted!(selection(&mut player, now, black_box(event)));
    }
    println!("batch an_event_on_61_transitions {EVENTS}");
}

#[inline(never)]
fn period<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
    control: &mut Control<P, W, C, S>,
    now: Millis,
    given: &Period,
) {
    let mut nowhere = Nowhere;
    let _ = control.period(now, given, &mut Trace::new(&mut nowhere));
}

/// Lives through 400 s with these incidents.
fn live<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
    control: &mut Control<P, W, C, S>,
    world: &mut Surroundings<'_>,
    robot: &str,
) {
    let mut periods = 0;
    for now in (0..4_000).map(|it| Millis(it * PERIOD_MS)) {
        let given = world.before(now, control);
        counted!(period(control, now, black_box(&given)));
        let level = control.decider().level();
        world.after(&control.decider().requests(now), level.tables());
        periods += 1;
    }
    println!("batch a_period_of_the_decisional_level{robot} {periods}");
}

fn level() {
    let (mut control, mut world) = (delivery::Control::default(), Surroundings::new(&SEVEN_POINTS));
    live(&mut control, &mut world, "");
    let mut bytes = [0; delivery::STORED_BYTES];
    counted!(control.store(black_box(&mut bytes)).is_some());
    println!("batch the_state_as_bytes 1");
    let mut other = transport::Control::default();
    live(&mut other, &mut Surroundings::new(&TRANSPORT), ",_transport_robot");

    let mut guard = Guard::default();
    for now in (0..1_000).map(Millis) {
        if now.0 % PERIOD_MS == 0 {
            guard.begin(now);
        }
        counted!(guard.feeds(black_box(now)));
        guard.end(now);
    }
    println!("batch the_watchdog,_a_tick 1000");

    let given = world.before(Millis(0), &control);
    let (mut sender, mut receiver) = (Sender::default(), Receiver::default());
    let mut frame = [0; robot::link::SENT];
    let mut length = 0;
    sender.send(&given.to_bytes(), |byte| {
        frame[length] = byte;
        length += 1;
    });
    counted!(for &byte in black_box(&frame[..length]) {
        black_box(receiver.take(byte).is_some());
    });
    println!("batch a_frame_received 1");
}

/// The plan of the whole patrol: the tables of its problem, the rule of the paper, the exact one.
fn allocators(workspace: &mut Workspace) {
    let (mut candidates, mut lists) = ([EMPTY; CANDIDATES], [&[][..]; STAGES]);
    let rest = Rest::Travel(ACTIVITIES[0].length());
    let lists = counted!(remaining(
        black_box(&ACTIVITIES),
        Some(rest),
        AVAILABLE,
        &mut candidates,
        &mut lists
    ));
    let Some(problem) = lists.ok().and_then(|it| Problem::new(it, LIMITS, ORDER).ok()) else {
        board::exit(104)
    };
    println!("batch the_patrol's_candidates 1");
    let mut plan = [0; STAGES];
    let mut caps = [[0; 2]; STAGES];
    let _ = counted!(Panorama::new(&mut caps).allocate(black_box(&problem), &mut plan));
    println!("batch the_patrol's_plan_by_the_rule 1");
    let _ = counted!(workspace.exact().allocate(black_box(&problem), &mut plan));
    println!("batch the_patrol's_plan,_exactly 1");
}

/// A whole mission with its three replans, and the watching between.
fn missions(tables: &mut Tables, planner: &mut Planner<'_>, name: &str) {
    let mut nowhere = Nowhere;
    let mut trace = Trace::new(&mut nowhere);
    counted!(Patrol::default().drive(&COURSE, planner, tables, &mut trace));
    println!("batch a_patrol_with_three_replans,_{name} 1");
}
