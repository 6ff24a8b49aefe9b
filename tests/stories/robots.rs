//! Robots that are drawn, on missions with drawn failures: what a file says of a robot bounds what
//! the simulator sees it do, and its supervisors do what was checked.

use cotama_campaign::run::{Campaign, Settings};
use cotama_campaign::subject::{Policy, Subject};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::robots::supervisors::of_mission;
use cotama_models::robots::{Moment, RobotFile};
use cotama_sim::robots::{Driven, Injection, Script};
use cotama_sim::trace::Record;
use cotama_tests::draw::Draw;
use cotama_tests::drawn::Drawn;
use cotama_verification::conform::{Line, Options, Recording, What, conform};

const MISSION: &str = r#"format = "panorama-mission/2"
name = "drawn"
robot = "drawn.toml"
path_length_mm = 4_000
limits = { order = ["duration", "energy"], duration_ms = 1_000_000, energy_mj = 10_000_000 }
tio = [{ id = "look", task = "WAI", duration_ms = 1_000, power_mw = 1_000 }]
objective = [
  { id = "there", does = "drive", x_start_mm = 0, x_end_mm = 2_000 },
  { id = "look", does = "wait", x_start_mm = 2_000, x_end_mm = 2_000 },
  { id = "on", does = "drive", x_start_mm = 2_000, x_end_mm = 4_000 },
]
"#;

/// Records what supervisors are told and fire under these failures, and holds it to their net.
fn conforms(mission: &Mission, script: &Script) {
    let mut records = Vec::new();
    let ready = Driven::new(mission).unwrap();
    ready.run_recorded(script, Millis(1_000), &mut records).unwrap();
    let said = |(number, record): (usize, &Record)| {
        let what = match record {
            Record::Told(it) => What::Event { name: it.event.clone(), ignored: Some(false) },
            Record::Fired(it) => What::Fired(format!("{}.{}", it.net, it.transition)),
            _ => return None,
        };
        Some(Line { number, column: 1, at: Millis(record.t_us() / 1_000), what })
    };
    let mut lines: Vec<_> = records.iter().enumerate().filter_map(said).collect();
    lines.sort_by_key(|it| (it.at, matches!(it.what, What::Fired(_))));
    let robot = mission.robot().unwrap().robot();
    let operator = robot.operator.is_some().then_some("operator");
    let silent = ["faults"].into_iter().chain(operator).map(str::to_owned).collect();
    let round_every = Some(robot.body.as_ref().unwrap().period);
    let recording = Recording { round_every, silent, lines, ..Recording::default() };
    let system = of_mission(robot, &mission.steps());
    let verdict = system.with(|it| conform(it, &recording, Options::default()).unwrap());
    assert!(verdict.departs.is_none() && verdict.unknown.is_none(), "{verdict:?}");
}

/// The exception: a motor runs away while the computer is down, so nothing can halt it.
fn nobody_stops(robot: &str, faults: &[String]) -> bool {
    let rows = || faults.iter().filter_map(|it| robot.split(&format!("id = \"{it}\"")).nth(1));
    ["runaway", "mindless"].into_iter().all(|it| {
        let motion = format!("motion = \"{it}\"");
        rows().any(|row| row.split("[[failure]]").next().is_some_and(|row| row.contains(&motion)))
    })
}

/// Draws robots, and runs each that can move under this many failures and sets of failures. Returns
/// how many run, and their runs.
fn robots(seed: u64, count: usize, runs: u64) -> (u64, u64) {
    let mut draw = Draw::new(seed);
    let mut ran = (0, 0);
    for number in 0..count {
        let drawn = Drawn::new(&mut |most| draw.between(0, u64::from(most) - 1) as usize);
        let text = drawn.text();
        let Ok(file) = RobotFile::parse("drawn.toml", &text) else { continue };
        // A robot without a part of a drive that moves is refused.
        let Ok(mission) = Mission::parse_under("drawn", MISSION, Some(file)) else { continue };
        let subject = Subject::new(&mission, Policy::default()).unwrap();
        let settings = Settings { runs, seed: number as u64, ..Settings::new(true) };
        for line in Campaign::new(subject, settings).unwrap().block(0) {
            if nobody_stops(&text, &line.faults) {
                continue;
            }
            let what = (&line.violated, line.plan, &line.observed);
            assert!(line.violated.is_empty(), "{number}: {what:?}\n{text}");
            ran.1 += 1;
        }
        let failures = mission.robot().unwrap().robot().failures.len() as u64;
        let injections = (0..3).map(|_| Injection {
            when: Moment::Place(Millimetres(draw.between(0, 4_000))),
            failure: draw.between(0, failures - 1) as usize,
            until: None,
        });
        conforms(&mission, &Script { injections: injections.collect(), ..Script::default() });
        ran.0 += 1;
    }
    ran
}

#[test]
fn drawn_robots_do_what_was_checked_and_stop_in_time() {
    let (ran, runs) = robots(3, 120, 20);
    assert!(ran >= 20 && runs > 19 * ran, "{ran} {runs}");
}

#[test]
#[ignore = "two thousand robots: minutes"]
fn two_thousand_drawn_robots_do_what_was_checked_and_stop_in_time() {
    let (ran, runs) = robots(4, 2_000, 200);
    println!("{ran} of 2 000 robots run, {runs} runs");
}
