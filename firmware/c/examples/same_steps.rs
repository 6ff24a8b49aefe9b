//! The steps of `example.c` in Rust, which calls no C: both print the same text.
//!
//! `cargo run --manifest-path firmware/c/Cargo.toml --example same_steps`

use cotama_c::robot::names::{
    CONFIGURATIONS, FAILURES, FLAGS, LOSSES, MODULES, REPORTS, SUB_OBJECTIVES,
};
use cotama_c::robot::{
    Decider, LEVEL_STORED_BYTES, Program, Snapshot as StoredLevel, TABLES, at_rest, system,
};
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::hardware::Equipment;
use cotama_core::monitor::{Monitor, Request, Trigger, Upward};
use cotama_core::panorama::Panorama;
use cotama_core::player::{Checked, Firing, Names, Observer, Outcome, Snapshot, Why};
use cotama_core::problem::{Candidate, Problem};
use cotama_core::system::System;
use cotama_core::ticks::Ticks32;
use cotama_core::units::Millis;
use cotama_models::level::{Cause, Drive, Level, Perceived, Told};
use cotama_models::nets::watchdog;

fn main() {
    watchdog_steps();
    ticks_steps();
    level_steps();
    allocation_steps();
    monitor_steps();
}

/// Prints what fires, with the names of what it says.
struct Print;

impl<P: Names<Output = watchdog::Output, Transition = watchdog::Transition>> Observer<P> for Print {
    fn on_fire(&mut self, firing: &Firing<'_, P>) {
        let name = watchdog::NET.transitions[firing.id.id.0 as usize].name;
        print!("  {} {name}", firing.at);
        firing.outputs().for_each(|it| print!(" {it:?}"));
        println!();
    }
}

const fn word(outcome: Outcome<watchdog::Transition>) -> &'static str {
    match outcome {
        Outcome::Fired { .. } => "fired",
        Outcome::Refused { .. } => "refused",
        Outcome::Ignored { why } => match why {
            Why::OnPurpose => "ignored on purpose",
            Why::NotEnabled | Why::NoSuchEvent => "not enabled",
            Why::TooEarly(_) => "too early",
            Why::TooLate(_) => "too late",
            Why::Full(_) => "full",
            Why::Behind => "behind",
        },
    }
}

fn print_watchdog(watchdog: &watchdog::Checked) {
    let misses = watchdog.tokens(watchdog::Place::misses);
    print!("  state {}, misses {misses}, wakes ", watchdog.state() as u32);
    watchdog.wake_at().map_or_else(|| println!("never"), |at| println!("at {at}"));
}

fn watchdog_steps() {
    use watchdog::Event::{CsAck, Done, Release};
    let table = [
        (0, Release),
        (40, Done),
        (100, Release),
        (210, Done),
        (300, Release),
        (350, Release),
        (500, Done),
        (600, Release),
        (900, CsAck),
        (1_000, Release),
        (1_030, Done),
    ];
    let program = Checked(watchdog::Program);
    let mut watchdog = watchdog::Checked::start(program, Millis(0), &mut ());
    for (at, event) in table {
        // Firings are printed behind the outcome.
        let mut fired = watchdog;
        println!(
            "{}: event {} {}",
            Millis(at),
            event as u32,
            word(fired.offer(Millis(at), &event))
        );
        let _ = watchdog.offer_with(Millis(at), &event, &mut Print);
        print_watchdog(&watchdog);
    }

    // The power goes 60 ms after a release, and is back after four seconds.
    let _ = watchdog.offer(Millis(1_100), &Release);
    let _ = watchdog.advance(Millis(1_160));
    let mut flash = [0; 32];
    let written = watchdog.snapshot().write(&mut flash).expect("32 bytes are enough");
    print!("stored {} bytes:", written.len());
    for byte in written {
        print!(" {byte:02x}");
    }
    println!();
    let stored = Snapshot::read(&flash).expect("as it was written");
    let mut watchdog = watchdog::Checked::restore(program, Millis(5_160), &stored).expect("sound");
    print_watchdog(&watchdog);
    let mut fired = watchdog;
    println!("{}", if fired.advance(Millis(9_000)).behind { "behind" } else { "not behind" });
    let _ = watchdog.advance_with(Millis(9_000), &mut Print);
    print_watchdog(&watchdog);
}

/// A counter of milliseconds of 32 bits begins anew 60 ms after a release: the deadline stays.
fn ticks_steps() {
    let counts = [u32::MAX - 59, u32::MAX, 0, 39, u32::MAX, 40, 60, 1_000];
    let mut ticks = Ticks32::starting_at(counts[0]);
    let program = Checked(watchdog::Program);
    let mut watchdog = watchdog::Checked::start(program, ticks.latest(), &mut ());
    let _ = watchdog.offer(ticks.latest(), &watchdog::Event::Release);
    for count in counts {
        let now = ticks.widen(count);
        let back = watchdog.clock_went_back(now).unwrap_or(Millis(0));
        println!("count {count} at {now}, back by {back}");
        let _ = watchdog.advance_with(now, &mut Print);
    }
    print_watchdog(&watchdog);
}

/// A number as C prints it with `%#x`.
fn hexadecimal(number: u64) -> String {
    if number == 0 { "0".to_owned() } else { format!("{number:#x}") }
}

fn flag(name: &str) -> u64 {
    1 << FLAGS.iter().position(|it| *it == name).expect("a flag")
}

fn sub_objective(name: &str) -> usize {
    SUB_OBJECTIVES.iter().position(|it| *it == name).expect("a sub-objective")
}

fn told(told: Told) -> String {
    match told {
        Told::Begins => "begins".to_owned(),
        Told::Over(it) => format!("over {it}"),
        Told::Stopped => "stopped".to_owned(),
        Told::Reached(it) => format!("reached {}", SUB_OBJECTIVES[it]),
        Told::Report(it) => format!("report {}", REPORTS[it]),
        Told::Back(it) => format!("back {}", LOSSES[it]),
        Told::Chooses(it) => format!("chooses {}", SUB_OBJECTIVES[it]),
        Told::Done(it) => format!("done {}", SUB_OBJECTIVES[it]),
        Told::GivesUp => "gives up".to_owned(),
    }
}

/// A set in print: the names of its members.
fn print_set(of: &str, set: u64, names: &[&str]) {
    if set != 0 {
        let all = names.iter().enumerate().filter(|it| set >> it.0 & 1 == 1);
        println!("  {of} {}", all.map(|it| *it.1).collect::<Vec<_>>().join(" "));
    }
}

/// A period of the level.
fn period(level: &mut Decider, now: u64, seen: Perceived, said: Option<Told>, drive: Drive) {
    const SYSTEM: System<'static> = system::SYSTEM;
    let now = Millis(now);
    println!("{now}");
    let found = level.perceive(now, seen);
    if !found.is_empty() {
        let all: Vec<_> = found.worst_first(TABLES.failures).take(4).collect();
        let names: Vec<_> = all.iter().map(|it| FAILURES[*it]).collect();
        println!("  found {}: {}", found.count(), names.join(" "));
    }
    if !level.listens() {
        println!("  reports go first");
    }
    let mut fired = Vec::new();
    let mut note = |it: &Firing<'_, Program, Cause>| fired.push(it.id);
    let round = level.period(now, said, drive, &mut note);
    if let Some(it) = round.told {
        println!("  told {}", told(it));
    }
    for it in fired {
        let net = &SYSTEM.components[usize::from(it.component)];
        let transition = &net.net.transitions[it.id.0 as usize];
        let says = transition.emits.iter().fold(0, |all, it| all | 1_u64 << it.0);
        println!("  {}.{} says {}", net.name, transition.name, hexadecimal(says));
    }
    print_set("starts anew:", round.restarts, &MODULES);
    let it = level.requests(now);
    let says = |wanted, word| if wanted { word } else { "" };
    println!(
        "  runs {},{}{}{}{} {} mm/s",
        it.configuration.map_or("nothing", |it| CONFIGURATIONS[it]),
        says(it.drive, " drive"),
        says(it.halt, " halt"),
        says(it.ask, " ask"),
        says(it.alarm, " alarm"),
        it.speed.0,
    );
    print_set("settings:", it.settings, &REPORTS);
}

fn level_steps() {
    let sound = Perceived { raised: 0, lowered: 0, works: (1 << MODULES.len()) - 1 };
    let raised = |name| Perceived { raised: flag(name), ..sound };
    let mut level = at_rest();
    for now in (0..=4_000).step_by(100) {
        let seen = match now {
            700 => raised("MCL late"),
            1_800 => raised("sonar far"),
            2_500 => raised("bumper"),
            2_600 => Perceived { lowered: flag("bumper"), ..sound },
            _ => sound,
        };
        let said = match now {
            0 => Some(Told::Begins),
            200 | 1_500 => Some(Told::Reached(sub_objective("Planning"))),
            1_300 => Some(Told::Over(1)),
            2_900 => Some(Told::Chooses(sub_objective("Teleoperation"))),
            3_300 => Some(Told::Done(sub_objective("Teleoperation"))),
            3_800 => Some(Told::Over(3)),
            _ => None,
        };
        let at_goal = now == 1_000 || now == 3_600;
        let drive = Drive { at_goal, stands: now <= 200 || now >= 1_000 };
        period(&mut level, now, seen, said, drive);
    }

    // The power goes before another mission begins, and is back after two seconds; then no plan is
    // left.
    let mut level = at_rest();
    let drives = Drive { at_goal: false, stands: false };
    period(&mut level, 10_000, raised("module silent"), Some(Told::Begins), drives);
    let mut flash = [0; LEVEL_STORED_BYTES];
    let written = level.level().snapshot().write(&mut flash).expect("as many as it needs");
    print!("stored {} bytes:", written.len());
    for byte in written {
        print!(" {byte:02x}");
    }
    println!();
    let stored = StoredLevel::read(&flash).expect("as it was written");
    let restored = Level::restore(TABLES, Checked(system::Program), Millis(12_000), &stored);
    let mut level = Decider::new(restored.expect("sound"));
    for now in (12_000..=12_500).step_by(100) {
        let seen = if now == 12_100 { raised("module silent") } else { sound };
        period(&mut level, now, seen, Some(Told::Begins), drives);
    }
    let none = FAILURES.iter().position(|it| *it == "PLN1").expect("a failure");
    level.report(none, Cause(0));
    period(&mut level, 12_600, sound, None, drives);
    period(&mut level, 12_700, sound, None, drives);
}

/// Knuth's MMIX generator; the upper bits are the better ones.
struct Draws(u64);

impl Draws {
    fn below(&mut self, below: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32 % below
    }
}

fn print_answer(by: &str, answer: Answer<2>, activities: &[&[Candidate<2>]], plan: &[u16]) {
    print!("  {by}: ");
    let steps = match answer {
        Answer::Planned(it) => {
            for (ways, choice) in activities.iter().zip(plan) {
                print!("{} ", ways[usize::from(*choice)].id);
            }
            let best = if it.optimal { ", the best" } else { "" };
            print!("costs {} ms, {} mJ, quality {}{best}", it.cost[0], it.cost[1], it.quality);
            if let Some(bound) = it.bound {
                print!(", bound {bound}");
            }
            it.steps
        }
        Answer::Infeasible { shortfall, steps } => {
            print!("infeasible");
            if let Some(it) = shortfall {
                print!(", axis {}: {} of {}", it.axis(), it.least(), it.limit());
            }
            steps
        }
        Answer::Unknown { bound, steps } => {
            print!("out of budget, bound {bound}");
            steps
        }
    };
    println!(", {steps} steps");
}

fn allocation_steps() {
    let mut draws = Draws(1);
    for number in 0..100 {
        let activities = 1 + draws.below(17) as usize;
        let (mut all, mut most) = (Vec::new(), [0_u64; 2]);
        for _ in 0..activities {
            let count = 1 + draws.below(21);
            most = [most[0] + 30_000, most[1] + 400_000];
            let ways = (0..count as u16).map(|id| {
                let cost = [1_000 + draws.below(50_000), 10_000 + draws.below(700_000)];
                let quality = draws.below(100);
                let units = Equipment::NONE.with(draws.below(4) as usize, 1).expect("a kind");
                (Candidate { cost, quality, id }, units)
            });
            all.push(ways.collect::<Vec<_>>());
        }
        let available = if draws.below(4) == 0 { 0x0111 } else { 0x1111 };
        let available = Equipment::from_bits(available).expect("one unit each");
        let limits = [
            most[0] * u64::from(40 + draws.below(60)) / 100,
            most[1] * u64::from(30 + draws.below(60)) / 100,
        ];
        let order = if number % 2 == 0 { [0, 1] } else { [1, 0] };
        let steps = if draws.below(5) == 0 { 20 + u64::from(draws.below(200)) } else { 100_000 };
        let candidates = all.iter().map(Vec::len).sum::<usize>();
        println!("problem {number}: {activities} activities, {candidates} candidates");

        let there = |ways: &Vec<(Candidate<2>, Equipment)>| {
            let there = ways.iter().filter(|it| available.covers(it.1));
            there.map(|it| it.0).collect::<Vec<_>>()
        };
        let left = all.iter().map(there).collect::<Vec<_>>();
        let lists = left.iter().map(Vec::as_slice).collect::<Vec<_>>();
        if let Some(lacks) = lists.iter().position(|it| it.is_empty()) {
            println!("  by the rule: without hardware, activity {lacks}, 0 steps");
            println!("  exactly: without hardware, activity {lacks}, 0 steps");
            continue;
        }
        let problem = Problem::new(&lists, limits, order).expect("a problem");
        let (mut plan, mut caps) = ([0; 17], [[0; 2]; 17]);
        let answer = Panorama::new(&mut caps).allocate(&problem, &mut plan).expect("memory");
        print_answer("by the rule", answer, &lists, &plan);
        let objectives = [Objective::MostQuality, Objective::Least(1)];
        let (mut items, mut stages) = (vec![Item::EMPTY; candidates], [Stage::EMPTY; 17]);
        let mut exact = Exact::new(&objectives, steps, &mut items, &mut stages);
        let answer = exact.allocate(&problem, &mut plan).expect("memory");
        print_answer("exactly", answer, &lists, &plan);
    }
}

fn monitor_steps() {
    let upward = Upward { growth: [0, 50_000], reserve: [0, 10_000] };
    let monitor = Monitor::new([600_000, 8_640_000], [0, 1]).expect("limits");
    let mut monitor = monitor.with_upward(upward);
    let mut rest = [527_924, 8_563_613];
    monitor.planned(&rest).expect("amounts");
    let units = |bits| Equipment::from_bits(bits).expect("units");
    for step in 0..12 {
        rest = [rest[0] - 40_000, rest[1] - 700_000];
        monitor.spend(&[40_000, if step < 6 { 560_000 } else { 900_000 }]).expect("amounts");
        let (margins, left) = (monitor.margins(&rest).expect("amounts"), monitor.left());
        let available = units(if step == 3 { 0x10 } else { 0x11 });
        let request = monitor.assess(&rest, units(0x11), available).expect("amounts");
        print!("margins {} ms, {} mJ of {} ms, {} mJ: ", margins[0], margins[1], left[0], left[1]);
        match request {
            Request::Keep => println!("keep"),
            Request::Down(Trigger::Margin { axis }) => println!("down, a margin of axis {axis}"),
            Request::Down(Trigger::Hardware) => println!("down, hardware"),
            Request::Up => println!("up"),
        }
        if request == Request::Up {
            monitor.planned(&rest).expect("amounts");
        }
    }
}
