//! Missions whose speeds and limits follow from axes (Lambert et al., J. Intell. Robot. Syst. 110,
//! 2024, Sections 2 and 6.1), run as any other mission.
#![allow(clippy::unwrap_used, clippy::pedantic)]

use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::Options;
use cotama_sim::run::Outcome;
use cotama_sim::setup::Simulation;
use cotama_sim::trace::{Plan, Record, Trace, replay};

fn shipped(name: &str) -> Mission {
    let known = embedded::mission(name).unwrap();
    Mission::parse(name, known.text).unwrap()
}

/// Records after the header, which holds the text of the mission.
fn records(mission: &Mission) -> String {
    let trace = Trace::record(mission, &Options::default()).unwrap().0;
    let text = trace.to_json_lines();
    text.split_once('\n').unwrap().1.to_owned()
}

/// The patrol of the paper with the axes of `patrol-axes`: no speed limit of a zone is written.
/// `ends` are the constraints of the end that stay, `run` is the script.
fn patrol_with(ends: &[&str], run: &str) -> String {
    let axes = cotama_axes::PATROL;
    let (ground, _) = axes.split_once("\n[run]\n").unwrap();
    let mut parts = ground.split("[[constraint]]\n");
    let mut text = parts.next().unwrap().replace("cotama-axes/1", "panorama-mission/3");
    text = text.replacen("name = \"patrol-axes\"", "name = \"patrol\"", 1);
    for part in parts {
        let is_kept = ends.iter().any(|it| part.starts_with(&format!("id = \"{it}\"")));
        if is_kept {
            text += &format!("[[constraint]]\n{part}");
        }
    }
    text + "\n" + run
}

/// Constraints that the speeds of Table 5 follow from.
const CORE: [&str; 3] = ["harmless", "avoidance", "frames"];

#[test]
fn patrol_and_delivery_upgraded_leave_the_same_records() {
    for name in ["patrol", "delivery", "shift"] {
        let before = shipped(name);
        let after = Mission::parse(name, &before.upgraded().unwrap()).unwrap();
        assert_eq!(after.scenario().activities.len(), before.scenario().activities.len());
        assert_eq!(after.limits, before.limits);
        assert!(records(&after) == records(&before), "{name}");
    }
}

#[test]
fn the_patrol_with_derived_speeds_leaves_the_records_of_the_patrol() {
    let patrol = shipped("patrol");
    let (_, run) = patrol.text().split_once("\n[run]\n").unwrap();
    // The stand-in for quality of the shipped mission, which the paper's rule does not look at.
    let text =
        patrol_with(&[&CORE[..], &["duration", "energy"]].concat(), &format!("[run]\n{run}"));
    let (before, after) = text.split_once("ask = [").unwrap();
    let (_, after) = after.split_once("]]").unwrap();
    let text = format!("{before}plan.objective = \"paper\"{after}");
    let derived = Mission::parse("derived.toml", &text).unwrap();
    let speeds = |mission: &Mission| -> Vec<u64> {
        mission.scenario().activities.iter().map(|it| it.speed_max.0).collect()
    };
    assert_eq!(speeds(&derived), speeds(&patrol));
    assert!(records(&derived) == records(&patrol));
}

fn plans(mission: &Mission) -> (Vec<Plan>, Outcome) {
    let (mut records, options) = (Vec::new(), Options::default());
    let simulation = Simulation::new(mission, &options).unwrap();
    let run = simulation.run_recorded(options.seed, &mut records).unwrap();
    let plans = records.into_iter().filter_map(|it| match it {
        Record::Plan(it) => Some(*it),
        _ => None,
    });
    (plans.collect(), run.outcome)
}

#[test]
fn a_wait_makes_the_robot_plan_again_on_each_sum_that_it_costs() {
    let ends = ["duration", "energy", "located", "laptop", "data"];
    let all = [&CORE[..], &["error", "cpu"], &ends].concat();
    let wait = |x_mm: u64, delay_ms: u64| {
        format!("[run]\n[[run.event]]\nx_mm = {x_mm}\nkind = \"obstacle\"\ndelay_ms = {delay_ms}\n")
    };
    let error = "[run]\npower_error_permille = { H2 = 120 }\n".to_owned();
    let located = "[\"max\", \"localisation.located\"]";
    let energy = "[\"max\", \"energy.RC\"]";
    let (free_laptop, free_data) =
        (("goal = 9000000 ", "goal = 99000000 "), ("goal = 450000 ", "goal = 9900000 "));
    // The plan of each wish uses what it may of a sum; the wait or the error takes more of it.
    let cases = [
        (located, vec![free_laptop, free_data], wait(70_000, 80_000), "duration", 70),
        (energy, vec![free_laptop, free_data], error, "energy", 63),
        (energy, vec![free_data], wait(2_000, 20_000), "laptop", 2),
        (located, vec![free_laptop], wait(70_000, 10_000), "data", 70),
    ];
    for (wish, edits, run, limit, metre) in cases {
        let text = patrol_with(&all, &run);
        let text = edits.iter().fold(text, |text, (old, new)| text.replacen(old, new, 1));
        let (before, after) = text.split_once("ask = [").unwrap();
        let (_, after) = after.split_once("]]").unwrap();
        let text = format!("{before}ask = [{wish}]{after}");
        let mission = Mission::parse("five.toml", &text).unwrap();
        let (plans, outcome) = plans(&mission);
        println!("{limit} {}", plans.len());
        let first = (plans[1].cause.as_str(), plans[1].x_mm / 1_000);
        assert_eq!(plans[0].allocator, "axes");
        assert_eq!(first, (format!("{limit} margin below zero").as_str(), metre));
        assert!(plans[1].further.iter().all(|it| it.margin >= 0), "{limit}");
        assert_eq!(outcome, Outcome::Completed, "{limit}");
    }
}

#[test]
fn a_sum_of_the_laptop_is_counted_to_a_part_in_ten_thousand_of_a_wait_and_a_plan() {
    let ends = ["duration", "energy", "located", "laptop", "data"];
    let all = [&CORE[..], &["error", "cpu"], &ends].concat();
    let wait = "[run]\n[[run.event]]\nx_mm = 50000\nkind = \"obstacle\"\ndelay_ms = 10000\n";
    let with = |goal: i64| {
        let text = patrol_with(&all, wait);
        let goal = format!("goal = {goal} ");
        Mission::parse("laptop.toml", &text.replacen("goal = 9000000 ", &goal, 1)).unwrap()
    };
    let (first, _) = plans(&with(9_000_000));
    let laptop = first[0].further.iter().find(|it| it.constraint == "laptop").unwrap();
    // The wait takes the laptop idle, both algorithms, the sonars and the Kinect: 16.96 W.
    let used = 9_000_000 - laptop.margin + 169_600;
    assert_eq!(used, 7_935_167);
    let ended = |goal: i64| {
        let (plans, outcome) = plans(&with(goal));
        assert_eq!(
            (plans[0].plan[7].activity.as_str(), plans[0].plan[7].choice.as_str()),
            ("A8", "M1 L2")
        );
        (plans.len(), outcome)
    };
    assert_eq!(ended(used + 400), (1, Outcome::Completed));
    // With less another plan is needed.
    assert_ne!(ended(used - 400), (1, Outcome::Completed));
}

#[test]
fn both_lasers_lost_make_the_robot_slower_on_line() {
    let fault = "[run]\n[[run.event]]\nx_mm = 70000\nkind = \"fault\"\nhardware = \"laser\"\n\
                 units_lost = 2\n";
    let ends = [&CORE[..], &["duration", "energy"]].concat();
    let text = patrol_with(&ends, fault).replacen("goal = 600000 ", "goal = 900000 ", 1);
    assert!(Mission::parse("lost.toml", &text).unwrap().plans_by_wishes());
    let mission = Mission::parse("lost.toml", &text).unwrap();
    let (plans, outcome) = plans(&mission);
    let speed = |plan: &Plan, id: &str| {
        plan.plan.iter().find(|it| it.activity == id).map(|it| it.speed_mm_s)
    };
    // Only sonars are left to see obstacles: every 420 ms in place of every 100 ms.
    assert_eq!(plans.iter().map(|it| it.x_mm).collect::<Vec<_>>(), [0, 70_000]);
    assert_eq!((speed(&plans[0], "A14"), speed(&plans[1], "A14")), (Some(560), Some(490)));
    assert_eq!(outcome, Outcome::Completed);
    let trace = Trace::record(&mission, &Options::default()).unwrap().0;
    let read = Trace::parse("lost.jsonl", &trace.to_json_lines()).unwrap();
    assert!(replay(&read).unwrap().identical);
}
