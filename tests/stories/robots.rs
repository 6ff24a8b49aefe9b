//! Robots that are drawn, on missions with drawn failures: what a file says of a robot bounds what
//! the simulator sees it do, and its supervisors do what was checked.

use cotama_campaign::run::{Campaign, Settings};
use cotama_campaign::subject::{Policy, Subject};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::supervisors::of_mission;
use cotama_models::robots::{MAX_LOSSES, Moment, RobotFile};
use cotama_sim::options::{self as sim, FaultChoice, Fidelity};
use cotama_sim::robots::{Driven, Injection, Run, Script};
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
    let ready = Driven::new(mission).unwrap();
    runs_as_checked(mission, &ready, script);
}

/// The same of a mission that is ready to be run; returns the run.
fn runs_as_checked(mission: &Mission, ready: &Driven<'_>, script: &Script) -> Run {
    let mut records = Vec::new();
    let run = ready.run_recorded(script, Millis(1_000), &mut records).unwrap();
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
    run
}

/// Each failure of the delivery that signals show, alone, on its way to office A.
#[test]
fn a_delivery_by_signals_does_what_was_checked_and_reacts_within_the_proven_rounds() {
    let known = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(known.name, known.text).unwrap();
    let robot = mission.robot().unwrap().robot();
    let period = robot.body.as_ref().unwrap().period;
    let (fidelity, faults) = (Fidelity::Signal, FaultChoice::None);
    let options = sim::Options { fidelity, faults, ..sim::Options::default() };
    let ready = Driven::with(&mission, &options).unwrap();
    let (mut found, mut worst) = (0, 0);
    for (failure, row) in robot.failures.iter().enumerate() {
        let injections = vec![Injection::new(Moment::Place(Millimetres(20_000)), failure)];
        let run = runs_as_checked(&mission, &ready, &Script { injections, ..Script::default() });
        let Some(conduct) = run.conduct.first() else { continue };
        let Some((seen, answered)) = conduct.detected.zip(conduct.answered) else { continue };
        let most = conduct.taken_for.iter().filter_map(|it| robot.reacts_in(*it)).max().unwrap();
        let took = answered.0.saturating_sub(seen.0) / period.0;
        assert!(took <= most, "{}: {took} rounds, {most} at most", row.id);
        (found, worst) = (found + 1, worst.max(took));
    }
    assert_eq!((found, worst), (28, 3));
}

/// The exception: a motor runs away while the computer is down, so nothing can halt it.
fn nobody_stops(robot: &str, faults: &[String]) -> bool {
    // Faults are named with the place of the local supervisor: `X1@Drive`.
    let ids = || faults.iter().filter_map(|it| it.split('@').next());
    let rows = || ids().filter_map(|it| robot.split(&format!("id = \"{it}\"")).nth(1));
    ["runaway", "mindless"].into_iter().all(|it| {
        let motion = format!("motion = \"{it}\"");
        rows().any(|row| row.split("[[failure]]").next().is_some_and(|row| row.contains(&motion)))
    })
}

/// Reasons for which a drawn robot is refused. That nothing leads to a configuration follows from
/// severities, which the other reading does not look at.
const REASONS: [&str; 7] = [
    "stands on no hardware",
    "never runs",
    "starts",
    "nobody to ask",
    "nobody orders",
    "nothing leads there while it can run",
    "losses make a difference",
];

/// Whether another reading of a robot finds the reasons for which it is refused.
fn is_confirmed(drawn: &Drawn, refusal: &str) -> bool {
    let found = || REASONS.into_iter().filter(|it| refusal.contains(it));
    let many = drawn.losses().len() > MAX_LOSSES;
    let confirmed = |it: &str| match it {
        "losses make a difference" => many,
        "nothing leads there while it can run" => true,
        // The message of what is led to by nothing says this too.
        "never runs" if refusal.contains("nothing leads there while it can run") => true,
        it => many || drawn.faults().contains(it),
    };
    found().count() > 0 && found().all(confirmed)
}

/// The counts of drawn robots.
#[derive(Debug, Default)]
struct Counts {
    /// Robots that run, and their runs.
    robots: u64,
    runs: u64,
    /// Robots that are refused, by reason.
    refused: [u64; REASONS.len()],
    /// The most modules and the most rows of a robot that runs.
    most: [usize; 2],
}

/// Draws robots, and runs each that can move under this many failures and sets of failures.
fn robots(seed: u64, count: usize, runs: u64) -> Counts {
    let mut draw = Draw::new(seed);
    let mut counts = Counts::default();
    for number in 0..count {
        let drawn = Drawn::large(&mut |most| draw.between(0, u64::from(most) - 1) as usize);
        let text = drawn.text();
        let file = match RobotFile::parse("drawn.toml", &text) {
            Ok(it) => it,
            Err(why) => {
                let why = why.to_string();
                assert!(is_confirmed(&drawn, &why), "{number}: {why}\n{text}");
                for (count, reason) in counts.refused.iter_mut().zip(REASONS) {
                    *count += u64::from(why.contains(reason));
                }
                continue;
            }
        };
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
            counts.runs += 1;
        }
        let robot = mission.robot().unwrap().robot();
        let size = [robot.modules.len(), robot.failures.len()];
        counts.most = [0, 1].map(|it| counts.most[it].max(size[it]));
        let failures = robot.failures.len() as u64;
        let injections = (0..3).map(|_| Injection {
            when: Moment::Place(Millimetres(draw.between(0, 4_000))),
            failure: draw.between(0, failures - 1) as usize,
            until: None,
        });
        conforms(&mission, &Script { injections: injections.collect(), ..Script::default() });
        counts.robots += 1;
    }
    counts
}

#[test]
fn drawn_robots_do_what_was_checked_and_stop_in_time() {
    let Counts { robots: ran, runs, refused, most } = robots(3, 240, 20);
    assert!(ran >= 20 && runs > 19 * ran, "{ran} {runs} {refused:?}");
    assert!(most[0] >= 10 && most[1] >= 15, "{most:?}");
}

#[test]
#[ignore = "two thousand robots: minutes"]
fn two_thousand_drawn_robots_do_what_was_checked_and_stop_in_time() {
    println!("{:?} of 2 000 robots", robots(4, 2_000, 200));
}
