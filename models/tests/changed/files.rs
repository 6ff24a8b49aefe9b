//! Files with some words, numbers or lines changed: what is said of them, or all that they mean.

use crate::draw::Draw;
use crate::efforts::Effort;
use crate::{below, chance, pick};
use cotama_core::hardware::Equipment;
use cotama_models::fmeca::{Analysis, Set};
use cotama_models::missions::faults::Faults;
use cotama_models::missions::infeasible::explain_within;
use cotama_models::missions::{Constraint, Mission, MissionErrors, embedded};
use cotama_models::team::instance::{Instance, Reason, Verdict};
use std::fs;
use std::ops::Range;
use std::path::Path;

/// Numbers at which something ends.
const NUMBERS: [&str; 24] = [
    "0",
    "1",
    "2",
    "3",
    "7",
    "8",
    "10",
    "16",
    "100",
    "255",
    "256",
    "999",
    "1000",
    "1001",
    "65535",
    "65536",
    "1000000000",
    "1000000001",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "-1",
    "0.5",
];

/// Where words, numbers and texts in quotes stand.
fn tokens(text: &str) -> Vec<Range<usize>> {
    let mut tokens = Vec::new();
    let mut begin = None;
    for (at, sign) in text.char_indices().chain([(text.len(), ' ')]) {
        let inside = sign.is_alphanumeric() || sign == '_' || sign == '-';
        match (inside, begin) {
            (true, None) => begin = Some(at),
            (false, Some(first)) => {
                tokens.push(first..at);
                begin = None;
            }
            _ => {}
        }
    }
    tokens
}

/// The text with a change.
fn changed(draw: &mut Draw, text: &str) -> String {
    let mut lines: Vec<&str> = text.split('\n').collect();
    match draw.between(0, 19) {
        0 => drop(lines.remove(below(draw, lines.len()))),
        1 => lines.insert(below(draw, lines.len()), *pick(draw, &lines.clone())),
        2 => {
            let count = lines.len();
            lines.swap(below(draw, count), below(draw, count));
        }
        _ => {
            let tokens = tokens(text);
            let number = |it: &&Range<usize>| text[(*it).clone()].parse::<f64>().is_ok();
            let numbers: Vec<_> = tokens.iter().filter(number).cloned().collect();
            let words: Vec<_> = tokens.iter().filter(|it| !number(it)).cloned().collect();
            let (place, new) = if chance(draw, 60) && !numbers.is_empty() {
                let place = pick(draw, &numbers).clone();
                let old: u64 = text[place.clone()].parse().unwrap_or(0);
                let new = match draw.between(0, 4) {
                    0 => (old + 1).to_string(),
                    1 => old.saturating_sub(1).to_string(),
                    2 => (old * draw.between(1, 300) / 100).to_string(),
                    3 => text[pick(draw, &numbers).clone()].to_owned(),
                    _ => (*pick(draw, &NUMBERS)).to_owned(),
                };
                (place, new)
            } else {
                let place = pick(draw, &words).clone();
                let old = &text[place.clone()];
                let new = match draw.between(0, 3) {
                    0 => old.chars().skip(1).collect(),
                    1 => format!("{old}{old}"),
                    _ => text[pick(draw, &words).clone()].to_owned(),
                };
                (place, new)
            };
            let (before, after) = (&text[..place.start], &text[place.end..]);
            return format!("{before}{new}{after}");
        }
    }
    lines.join("\n")
}

/// With some changes, mostly few.
fn with_changes(draw: &mut Draw, text: &str) -> String {
    let mut text = changed(draw, text);
    while chance(draw, 30) {
        text = changed(draw, &text);
    }
    text
}

/// Notes what is said of a file, with the place of each mistake.
fn said(effort: &mut Effort, errors: &MissionErrors) {
    effort.count("refused", 1);
    effort.count("mistakes", errors.diagnostics().len() as u64);
    effort.note(&(errors.to_string(), errors.omitted(), errors.diagnostics()));
    for it in errors.diagnostics() {
        effort.note(&errors.position(it));
    }
}

/// Notes all that a mission means: its activities, its source, and why it has no plan under other
/// limits or with less hardware.
fn meant(effort: &mut Effort, draw: &mut Draw, mission: &Mission) {
    let scenario = mission.scenario();
    effort.count("activities", scenario.activities.len() as u64);
    effort.note(&(&**mission, scenario, mission.supervisor(), scenario.combinations()));
    for activity in &scenario.activities {
        effort.note(&(activity.unconstrained(), activity.table().length()));
    }
    effort.note(&scenario.to_rust("changed"));
    for zone in 0..mission.zones.len() {
        for constraint in [Constraint::Hardware, Constraint::Tio] {
            let lifted = mission.without_zone_constraint(zone, constraint);
            effort.note(&lifted.map(|it| it.scenario().combinations()));
        }
    }
    for objective in 0..=mission.objectives.len() {
        let less = mission.without_objective(objective);
        effort.note(&less.map(|it| (it.path_length, it.scenario().combinations())));
    }
    let limits = mission.limits.map(|it| it * draw.between(20, 110) / 100);
    let mut available = mission.available();
    if chance(draw, 50) && !mission.hardware.is_empty() {
        available = available.without(below(draw, mission.hardware.len()), 1);
    }
    explained(effort, mission, limits, available, draw.between(0, 3) * 3_000);
}

fn explained(
    effort: &mut Effort,
    mission: &Mission,
    limits: [u64; 2],
    available: Equipment,
    steps: u64,
) {
    let why = explain_within(mission, limits, available, steps);
    effort.note(&why);
    let Some(why) = why else { return };
    effort.count("without a plan", 1);
    effort.note(&why.reason.wording(mission));
    for it in &why.heaviest {
        effort.note(&it.wording(mission));
    }
    for it in &why.relaxations {
        effort.note(&it.wording(mission));
        effort.note(&it.apply(mission, limits, available).map(|it| (it.1, it.2)));
    }
}

#[test]
fn missions_with_changes_are_refused_with_the_same_words_or_mean_the_same() {
    let (mut draw, mut effort) = (Draw::new(91), Effort::new(20));
    for at in 0..800 {
        let text = embedded::embedded()[at % 2].text;
        match Mission::parse("changed.toml", &with_changes(&mut draw, text)) {
            Ok(mission) => meant(&mut effort, &mut draw, &mission),
            Err(errors) => said(&mut effort, &errors),
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_missions.txt");
}

/// All kinds of events and incidents.
const FAULTS: [&str; 2] = [
    r#"format = "panorama-faults/1"
random = [{ name = "door", kind = "obstacle", per_km = 3, delay_ms = 4000 },
          { name = "slip", kind = "odometry", per_km = 5, extra_mm = 300 }]
[[event]]
x_mm = 12000
kind = "obstacle"
delay_ms = 1500
[[event]]
x_mm = 20000
kind = "hardware"
hardware = "sonar"
units_lost = 1
[[event]]
x_mm = 50000
kind = "odometry"
extra_mm = 700
"#,
    "",
];

#[test]
fn faults_with_changes_are_refused_with_the_same_words_or_mean_the_same() {
    let (mut draw, mut effort) = (Draw::new(92), Effort::new(50));
    let missions: Vec<_> =
        embedded::embedded().iter().map(|it| Mission::parse(it.name, it.text).unwrap()).collect();
    // What stands in [run] of the missions, as a file of its own.
    let mut texts = vec![(0, FAULTS[0].to_owned())];
    for (number, it) in embedded::embedded().iter().enumerate() {
        let run = &it.text[it.text.find("[run").unwrap()..];
        let script = run.replace("[run]", "format = \"panorama-faults/1\"");
        let script = script.replace("run.", "").replace("monitor_period_ms = 1000", "");
        texts.push((number, script));
    }
    for at in 0..2_000 {
        let (mission, text) = &texts[at % texts.len()];
        let text = with_changes(&mut draw, text);
        match Faults::parse("changed.toml", &text, &missions[*mission]) {
            Ok(faults) => effort.note(&faults),
            Err(errors) => said(&mut effort, &errors),
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_faults.txt");
}

/// The files of a folder, by name.
fn folder(path: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let mut files: Vec<_> = fs::read_dir(path).unwrap().map(|it| it.unwrap().path()).collect();
    files.retain(|it| it.extension().is_some_and(|it| it == "json"));
    files.sort();
    files.iter().map(|it| fs::read_to_string(it).unwrap()).collect()
}

/// Every escape of a text, and every part of a number.
const ESCAPED: &str = r#"{
 "format": "cotama-team-assignment/1", "name": "a \" b \\ c \/ d \u00e4 \ud83e\uddf9 e",
 "kind": "simultaneous", "cost_denominator": 6, "robots": ["a\/b", "b", "c"],
 "drawn_by": ["\b\f\n\r\t", -1.5e-3, 2E+7, 0.25, true, false, null, {"a": {}, "b": []}],
 "tasks": [
  {"name": "t\u0031", "skip_cost": 12, "cost": [3, null, 2]},
  {"name": "t2", "skip_cost": null, "combine": "mean", "plans": [
   {"name": "p", "extra_cost": 4, "roles": [
    {"name": "x", "cost": [1, 2, 3]}, {"name": "y", "cost": [2, null, 1]}]},
   {"name": "q", "roles": [{"name": "z", "cost": [null, 5, 9]}]}]},
  {"name": "t3", "skip_cost": 7, "combine": "max", "plans": [
   {"name": "p", "roles": [{"name": "x", "cost": [4, 4, 4]}]}]}]}"#;

#[test]
fn escapes_and_numbers_are_read_as_they_are_written() {
    let instance = Instance::parse("escaped.json", ESCAPED).unwrap();
    assert_eq!(instance.name, "a \" b \\ c / d \u{e4} \u{1f9f9} e");
    assert_eq!((instance.robots[0].as_str(), instance.tasks[0].name.as_str()), ("a/b", "t1"));
}

/// Two tasks that must be done, both by the second robot alone, and one that anybody can do.
#[test]
fn tasks_that_compete_for_one_robot_are_named_with_it() {
    let task = |name: &str, cost: &str| {
        format!("{{\"name\": \"{name}\", \"skip_cost\": null, \"cost\": {cost}}}")
    };
    let tasks = [
        task("any", "[1, 1, 1, 1]"),
        task("one", "[null, 2, null, null]"),
        task("other", "[null, 3, null, null]"),
    ];
    let text = format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"conflict\", \
         \"kind\": \"simultaneous\", \"cost_denominator\": 1, \
         \"robots\": [\"a\", \"b\", \"c\", \"d\"], \"tasks\": [{}]}}",
        tasks.join(", ")
    );
    let answer = Instance::parse("conflict.json", &text).unwrap().solve(10_000).unwrap();
    let expected = Verdict::Infeasible(Reason { tasks: vec![1, 2], robots: vec![1] });
    assert_eq!(answer.verdict, expected);
}

#[test]
fn instances_with_changes_are_refused_with_the_same_words_or_have_the_same_answer() {
    let (mut draw, mut effort) = (Draw::new(93), Effort::new(50));
    let mut texts = [folder("teams"), folder("teams/broken")].concat();
    for _ in 0..5 {
        texts.push(ESCAPED.to_owned());
    }
    for at in 0..2_000 {
        let text = with_changes(&mut draw, &texts[at % texts.len()]);
        match Instance::parse("changed.json", &text) {
            Ok(instance) => {
                let solved = instance.solve([0, 300, 20_000][at % 3]).unwrap();
                effort.note(&(&instance, &solved, solved.cost(), solved.bound()));
                effort.note(&instance.greedy());
                for done in &solved.done {
                    effort.note(&instance.cost_of(done));
                }
                effort.count("solved", u64::from(solved.cost().is_some()));
            }
            Err(errors) => said(&mut effort, &errors),
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_instances.txt");
}

/// Notes all that is found in an analysis.
fn analysed(effort: &mut Effort, draw: &mut Draw, analysis: &Analysis) {
    effort.note(&(analysis, analysis.title(), analysis.period_h(), analysis.to_csv()));
    for function in analysis.functions() {
        effort.note(&analysis.ribs(function));
    }
    for mode in analysis.modes() {
        let it = analysis.criticality(mode);
        effort.note(&(it, it.rpn(), it.class(), mode.worst(), mode.is_detected()));
    }
    let mut status = analysis.sound();
    let sound = analysis.diagnose(&status);
    effort.count("pairs", sound.pairs.len() as u64);
    effort.note(&sound);
    if !analysis.modes().is_empty() {
        let modes: Vec<_> = (0..3).map(|_| below(draw, analysis.modes().len())).collect();
        effort.note(&(analysis.shared(&modes, &status), analysis.ids(modes.iter().copied())));
    }
    // Without some flags and modes.
    let some = |draw: &mut Draw, all: usize| -> Set {
        Set::of(all, (0..all).filter(|_| chance(draw, 80)))
    };
    status.flags = some(draw, analysis.flags().len());
    status.modes = some(draw, analysis.modes().len());
    effort.note(&(analysis.diagnose(&status), analysis.names(&status.flags)));
}

#[test]
fn analyses_with_changes_are_refused_with_the_same_words_or_say_the_same() {
    let (mut draw, mut effort) = (Draw::new(94), Effort::new(50));
    let small = include_str!("../fmeca/main.rs");
    let begin = small.find("r#\"").unwrap() + 3;
    let small = &small[begin..begin + small[begin..].find("\"#").unwrap()];
    let csv = Analysis::parse("small.toml", small).unwrap().to_csv();
    let robot = Analysis::of_the_robot().to_csv();
    for at in 0..1_500 {
        let text = with_changes(&mut draw, [small, &csv, &robot][at % 3]);
        let read = match at % 3 {
            0 => Analysis::parse("changed.toml", &text),
            _ => Analysis::parse_csv("changed.csv", &text),
        };
        match read {
            Ok(analysis) => analysed(&mut effort, &mut draw, &analysis),
            Err(errors) => said(&mut effort, &errors),
        }
        effort.next();
    }
    effort.compare("tests/golden/changed_analyses.txt");
}
