//! Failures that a campaign finds come back from their files, and mended ones do not.

use super::mission;
use cotama_campaign::findings::Findings;
use cotama_campaign::recorded::again;
use cotama_campaign::requirement::Requirement;
use cotama_campaign::results::Tally;
use cotama_campaign::run::{Campaign, Settings};
use cotama_campaign::subject::{Policy, Subject};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::FaultsFile;
use cotama_sim::options::{Aim, FaultChoice, Fidelity, Options, Planner};
use cotama_sim::setup::Simulation;
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::trace::Trace;
use std::fmt::Write;

/// A mission of up to six objectives over zones, with the limits and the plan given.
fn text(stream: &mut Stream, number: u64) -> String {
    let mut between = |least: u64, most: u64| least + stream.below(most - least + 1);
    let mut text = format!(
        "format = \"panorama-mission/1\"\nname = \"m{number}\"\n[robot]\nmass_g = 5000\n\
         speed_max_mm_s = {}\nimpact_energy_max_mj = 4000\n[motion_power]\nc0 = {}\nc1 = {}\n\
         c2 = {}\n[fixed]\nturn_ms = {}\nturn_power_mw = {}\n",
        between(400, 900),
        between(2_000, 8_000),
        between(0, 5_000),
        between(0, 9_000),
        between(2_000, 9_000),
        between(3_000, 9_000)
    );
    for kind in ["sonar", "laser", "camera"] {
        let (units, power) = (between(1, 2), between(500, 4_000));
        writeln!(text, "[hardware.{kind}]\nunits = {units}\npower_mw = {power}").unwrap();
    }
    let mut options = vec![
        ("M1", "MOV", "sonar = 1"),
        ("M2", "MOV", "laser = 1"),
        ("L1", "LOC", ""),
        ("L2", "LOC", "camera = 1"),
        ("T1", "TUR", ""),
    ];
    if between(0, 1) == 1 {
        options.push(("M3", "MOV", "sonar = 1, laser = 1"));
    }
    for (id, task, needs) in options {
        let quality = match task {
            "TUR" => String::new(),
            _ => format!("quality_per_dm = {}\nquality = {}\n", between(0, 9), between(0, 20)),
        };
        let slow = if between(0, 2) == 0 {
            format!("speed_max_mm_s = {}\n", between(200, 500))
        } else {
            String::new()
        };
        let slow = if task == "TUR" { "" } else { slow.as_str() };
        write!(text, "[[tio]]\nid = \"{id}\"\ntask = \"{task}\"\nneeds = {{ {needs} }}\n").unwrap();
        text += &quality;
        text += slow;
    }
    let mut x = 0;
    for objective in 0..between(1, 6) {
        let turns = objective % 2 == 1 && between(0, 1) == 1;
        let end = if turns { x } else { x + between(5, 40) * 1_000 };
        let tasks = if turns { "\"TUR\", \"LOC\"" } else { "\"MOV\", \"LOC\"" };
        writeln!(
            text,
            "[[objective]]\nid = \"O{objective}\"\nx_start_mm = {x}\nx_end_mm = {end}\ntasks = \
             [{tasks}]"
        )
        .unwrap();
        x = end;
    }
    for zone in 0..between(1, 3) {
        let start = between(0, x - 1);
        let (end, speed) = (between(start + 1, x), between(200, 700));
        writeln!(
            text,
            "[[zone]]\nid = \"z{zone}\"\nx_start_mm = {start}\nx_end_mm = {end}\nspeed_max_mm_s = \
             {speed}"
        )
        .unwrap();
    }
    let plan = ["", "", "objective = \"quality\"", "objective = \"min-energy\"", "paper"];
    let plan = match plan[between(0, 4) as usize] {
        "" => String::new(),
        "paper" => "[plan]\nobjective = \"paper\"\n".to_owned(),
        other => format!("[plan]\n{other}\n"),
    };
    format!("path_length_mm = {x}\n{text}{plan}")
}

/// The same with limits in front.
fn limited(text: &str, [duration, energy]: [u64; 2]) -> String {
    let limits = format!(
        "limits = {{ order = [\"duration\", \"energy\"], duration_ms = {duration}, energy_mj = \
         {energy} }}\n"
    );
    limits + text
}

fn parse(text: &str) -> Mission {
    Mission::parse("random.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

/// A random mission with limits a little above what its best plan takes, and much wider ones.
fn random(seed: u64) -> [Mission; 2] {
    let mut stream = Streams::new(seed).stream("missions");
    let body = text(&mut stream, seed);
    let wide = [100_000_000, 100_000_000_000];
    let free = parse(&limited(&body, wide));
    let planner = Some(Planner::Exact { aim: Aim::Quality, steps: 100_000 });
    let options = Options { planner, faults: FaultChoice::None, ..Options::default() };
    let used = Simulation::new(&free, &options).unwrap().run(0).unwrap().used;
    let mut limit = |used: u64| used * (102 + stream.below(15)) / 100 + 50;
    let tight = limited(&body, [limit(used[0]), limit(used[1])]);
    let mended = limited(&body, wide);
    [parse(&tight), parse(&mended)]
}

/// Every planner with every way to adapt.
fn policies() -> Vec<Policy> {
    let steps = 100_000;
    let planners = [
        None,
        Some(Planner::Panorama),
        Some(Planner::PanoramaThenExact { steps }),
        Some(Planner::Exact { aim: Aim::Quality, steps }),
        Some(Planner::Exact { aim: Aim::MinEnergy, steps }),
    ];
    let all = planners.into_iter().flat_map(|planner| {
        [(false, false), (true, false), (false, true)].map(|(upward, rigid)| Policy {
            planner,
            upward,
            rigid,
            fidelity: Fidelity::Line,
        })
    });
    all.collect()
}

/// The failures of a campaign as files, each with its requirement.
fn failures(
    mission: &Mission,
    policy: Policy,
    requirements: Vec<Requirement>,
    (runs, most): (u64, usize),
) -> Vec<(Requirement, String)> {
    let Ok(subject) = Subject::new(mission, policy) else { return Vec::new() };
    let settings = Settings {
        runs,
        requirements: requirements.into_iter().collect(),
        ..Settings::new(mission.robot().is_some())
    };
    let campaign = Campaign::new(subject.named("random.toml"), settings).unwrap();
    let mut tally = Tally::default();
    for line in campaign.block(0) {
        tally.add(&line, &serde_json::to_string(&line).unwrap());
    }
    let requirements = &campaign.settings.requirements;
    let found = Findings::of(&campaign.subject, requirements, &tally, most);
    found.clusters.into_iter().map(|it| (it.requirement, it.scenario)).collect()
}

/// Holds a file against what it records; the run with a trace must be the same.
fn returns(mission: &Mission, file: &str) {
    let read =
        FaultsFile::parse("001.toml", file, mission).unwrap_or_else(|e| panic!("{e}\n{file}"));
    let found = again(mission, &read).unwrap();
    assert!(found.returns(), "{:?}\n{file}\n{}", found.differences(), mission.text());
    let expected = read.expected.unwrap();
    assert_eq!(expected.mission.as_deref(), Some("random.toml"));
    if expected.end.broken_ms.is_none() {
        let policy = Policy::from(&read.planner.unwrap());
        let faults = FaultChoice::Given { source: "file".into(), faults: read.faults };
        let options = policy.options(mission, faults);
        let (trace, run) = Trace::record(mission, &options).unwrap();
        let end = &expected.end;
        assert_eq!(
            (run.outcome.name(), run.used, run.x_mm),
            (end.outcome, [end.time_ms, end.energy_mj], end.x_mm),
            "{file}"
        );
        assert_eq!(Some(run.replans), end.replans);
        let read = Trace::parse("t", &trace.to_json_lines()).unwrap();
        assert!(cotama_sim::trace::replay(&read).unwrap().identical);
    }
}

/// Returns the requirements of a mission without supervisors.
fn asked(mission: &Mission) -> Vec<Requirement> {
    let [time, energy] = mission.limits;
    let texts = [
        "completed".to_owned(),
        "not-failed".to_owned(),
        format!("time<={}", time * 97 / 100),
        format!("energy<={}", energy * 97 / 100),
    ];
    texts.iter().map(|it| it.parse().unwrap()).collect()
}

/// Runs campaigns until so many failures were replayed; how many, on how many missions, and how
/// many were mended.
fn held(missions: u64, most: usize) -> (usize, usize, usize) {
    let (mut count, mut mended, mut on) = (0, 0, 0);
    for seed in 0..missions {
        let [tight, wide] = random(seed);
        let policies = policies();
        let before = count;
        for policy in policies {
            if count >= most * (seed as usize + 1) / missions as usize {
                break;
            }
            for (requirement, file) in failures(&tight, policy, asked(&tight), (60, 2)) {
                returns(&tight, &file);
                count += 1;
                // Without its events nothing fails; a limit that is raised is kept.
                let read = FaultsFile::parse("001.toml", &file, &wide).unwrap();
                let found = again(&wide, &read).unwrap();
                let by_limits = matches!(requirement, Requirement::NotFailed);
                assert!(!by_limits || !found.returns(), "{file}");
                let nothing = FaultsFile { faults: Default::default(), ..read };
                let found = again(&tight, &nothing).unwrap();
                if !found.breaks {
                    assert!(!found.returns());
                    mended += 1;
                }
            }
        }
        on += usize::from(count > before);
    }
    (count, on, mended)
}

#[test]
fn failures_of_random_missions_come_back_from_their_files_and_mended_ones_do_not() {
    let (count, missions, mended) = held(10, 60);
    assert!(count >= 60 && missions >= 8 && mended >= 40, "{count} {missions} {mended}");
}

#[test]
fn a_thousand_failures_on_fifty_missions_come_back() {
    let (count, missions, mended) = held(50, 1_000);
    println!("{count} failures on {missions} missions, {mended} mended");
    assert!(count >= 1_000 && missions >= 45 && mended >= 500, "{count} {missions} {mended}");
}

/// Whatever a campaign of a supervised mission can break, a property that ends the run among it.
#[test]
fn failures_under_supervisors_come_back_whatever_they_break() {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap();
    let asked = [
        "completed",
        "not-failed",
        "in-time",
        "time<=330000",
        "energy<=2200000",
        "requests<=0",
        "exposed<=400",
        "never ls.ask_Following",
        "AG !gs.Security",
        "AG (ls.Waits -> AF<=5s !ls.Waits)",
    ];
    let tight = delivery.text.replace("duration_ms = 900000", "duration_ms = 300000");
    let steps = 100_000;
    let mut broken = std::collections::BTreeSet::new();
    for (text, planner) in [
        (delivery.text, None),
        (&tight, Some(Planner::PanoramaThenExact { steps })),
        (&tight, Some(Planner::Exact { aim: Aim::MinEnergy, steps })),
    ] {
        let mission = Mission::parse("delivery", text).unwrap();
        let policy = Policy { planner, ..Policy::default() };
        let asked = asked.map(|it| it.parse().unwrap()).to_vec();
        for (requirement, file) in failures(&mission, policy, asked, (400, 3)) {
            returns(&mission, &file);
            broken.insert(requirement.to_string());
            let read = FaultsFile::parse("001.toml", &file, &mission).unwrap();
            let nothing = FaultsFile { faults: Default::default(), ..read };
            let found = again(&mission, &nothing).unwrap();
            assert!(!found.returns() || found.breaks, "{file}");
        }
    }
    assert!(broken.len() >= 8, "{broken:?}");
}

/// A file whose end was changed is no record of what happens, field by field.
#[test]
fn each_field_of_the_end_is_compared() {
    let patrol = mission("patrol");
    let asked = vec!["completed".parse().unwrap()];
    let (_, file) = failures(&patrol, Policy::default(), asked, (100, 1)).remove(0);
    let read = |text: &str| {
        let file = FaultsFile::parse("001.toml", text, &patrol).unwrap();
        again(&patrol, &file).unwrap()
    };
    assert!(read(&file).returns());
    for key in ["time_ms", "energy_mj", "x_mm", "replans", "requests", "exposed_ms"] {
        let line = file.lines().find(|it| it.starts_with(&format!("{key} = "))).unwrap();
        let line = format!("\n{line}\n");
        let found = read(&file.replace(&line, &format!("\n{key} = 999999999\n")));
        assert_eq!((found.breaks, found.is_identical(), found.returns()), (true, false, false));
        assert_eq!(found.differences()[0].0, key);
    }
    let other = file.replace("outcome = \"safe\"", "outcome = \"completed\"");
    assert_ne!(other, file);
    assert_eq!(read(&other).differences()[0].0, "outcome");
    let weaker = file.replace("requirement = \"completed\"", "requirement = \"not-failed\"");
    let found = read(&weaker);
    assert_eq!((found.breaks, found.is_identical(), found.returns()), (false, true, false));
}
