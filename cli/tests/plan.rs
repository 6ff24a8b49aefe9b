//! `cotama plan`: the patrol of Lambert et al. 2024, Tables 5 and 6, and missions without a plan.

use crate::common::{Folder, patrol};
use serde_json::{Value, json};

fn plan(arguments: &[&str], code: i32) -> Value {
    let folder = Folder::new(&format!("plan_{}", arguments.join("_").replace(['/', ':'], "-")));
    folder.cotama(&[&["plan", "patrol", "--json"], arguments].concat()).json(code)
}

fn column(rows: &Value, name: &str) -> Vec<Value> {
    rows.as_array().unwrap().iter().map(|row| row[name].clone()).collect()
}

#[test]
fn the_activities_are_those_of_table_5() {
    let answer = plan(&[], 0);
    let activities = &answer["activities"];
    assert_eq!(activities.as_array().unwrap().len(), 17);
    let candidates = [21, 12, 4, 3, 2, 3, 12, 21, 21, 4, 3, 2, 3, 21, 21, 12, 21];
    assert_eq!(column(activities, "candidates"), candidates);
    let before = [21, 21, 21, 3, 2, 3, 21, 21, 21, 21, 3, 2, 3, 21, 21, 21, 21];
    assert_eq!(column(activities, "candidates_before"), before);
    let most = [410, 330, 330, 0, 0, 0, 330, 410, 560, 410, 0, 0, 0, 560, 410, 330, 410];
    assert_eq!(column(activities, "speed_max_mm_s"), most);
    let ninth = json!({ "id": "A9", "objective": "O5", "x_start_mm": 63500, "x_end_mm": 91500,
        "candidates": 21, "candidates_before": 21, "speed_max_mm_s": 560 });
    assert_eq!(activities[8], ninth);
    assert_eq!(answer["combinations"], "768288795144192");
}

#[test]
fn the_plan_is_that_of_table_6() {
    let answer = plan(&[], 0);
    let choices = "M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 L2,M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 \
        L2,M5 L2,M5 L2,M3 L1";
    assert_eq!(column(&answer["plan"], "choice"), choices.split(',').collect::<Vec<_>>());
    let speeds = [410, 330, 330, 0, 0, 0, 330, 410, 410, 410, 0, 0, 0, 410, 410, 330, 410];
    assert_eq!(column(&answer["plan"], "speed_mm_s"), speeds);
    assert_eq!(column(&answer["plan"], "activity")[..2], ["A1", "A2"]);
    let numbers = [
        ("duration_ms", 527_924),
        ("energy_mj", 8_563_613),
        ("quality", 19_190),
        ("duration_margin_ms", 72_076),
        ("energy_margin_mj", 76_387),
    ];
    for (field, value) in numbers {
        assert_eq!(answer[field], value, "{field}");
    }
    for field in ["duration_ms", "energy_mj", "quality"] {
        let sum: u64 = column(&answer["plan"], field).iter().map(|it| it.as_u64().unwrap()).sum();
        assert_eq!(answer[field], sum, "{field}");
    }
    assert_eq!((&answer["status"], &answer["allocator"]), (&json!("feasible"), &json!("panorama")));
    assert_eq!(answer["bound"], Value::Null);
}

#[test]
fn the_best_plans_are_proven() {
    let quality = plan(&["--objective", "quality"], 0);
    assert_eq!((&quality["quality"], &quality["bound"]), (&json!(21_830), &json!(21_830)));
    assert_eq!((&quality["status"], &quality["allocator"]), (&json!("optimal"), &json!("exact")));
    let energy = plan(&["--objective", "min-energy"], 0);
    assert_eq!((&energy["energy_mj"], &energy["bound"]), (&json!(4_675_896), &json!(4_675_896)));
    assert_eq!(energy["status"], "optimal");
}

#[test]
fn the_front_has_607_plans_and_every_best_one_is_on_it() {
    let answer = plan(&["--objective", "front"], 0);
    assert_eq!(answer["status"], "optimal");
    let front = answer["front"].as_array().unwrap();
    assert_eq!(front.len(), 607);
    assert_eq!(front.iter().map(|it| it["quality"].as_u64().unwrap()).max(), Some(21_830));
    assert_eq!(front.iter().map(|it| it["energy_mj"].as_u64().unwrap()).min(), Some(4_675_896));
    let within = |it: &Value| {
        it["duration_ms"].as_u64() <= Some(600_000) && it["energy_mj"].as_u64() <= Some(8_640_000)
    };
    assert!(front.iter().all(within));
    let durations: Vec<_> = front.iter().map(|it| it["duration_ms"].as_u64()).collect();
    assert!(durations.is_sorted());
}

#[test]
fn the_rule_comes_first_and_the_exact_allocator_only_where_it_finds_nothing() {
    let both = plan(&["--allocator", "exact"], 0);
    assert_eq!((&both["allocator"], &both["energy_mj"]), (&json!("panorama"), &json!(8_563_613)));
    // Any plan but the cheapest is too expensive here: the rule lowers every activity to the end.
    let least = plan(&["--energy-limit", "4675896", "--allocator", "exact"], 0);
    assert_eq!((&least["energy_mj"], &least["energy_margin_mj"]), (&json!(4_675_896), &json!(0)));
}

#[test]
fn a_limit_that_cannot_be_met_is_explained() {
    let answer = plan(&["--energy-limit", "4000000"], 1);
    assert_eq!((&answer["status"], &answer["plan"]), (&json!("infeasible"), &json!([])));
    let reason = &answer["reason"];
    assert_eq!((&reason["axis"], &reason["limit"]), (&json!("energy"), &json!(4_000_000)));
    assert_eq!((&reason["least"], &reason["gap"]), (&json!(4_675_896), &json!(675_896)));
    assert_eq!(reason["heaviest"][0]["activity"], "A1");
    assert_eq!(reason["relaxations"][0]["kind"], "raise_limit");
    assert_eq!(reason["relaxations"][0]["energy_limit_mj"], 4_675_896);
    // The limit it advises has a plan, and one below has none.
    plan(&["--energy-limit", "4675896"], 0);
    plan(&["--energy-limit", "4675895"], 1);
}

#[test]
fn lost_hardware_is_left_out_and_its_need_explained() {
    let one = plan(&["--lost", "laser:1"], 0);
    let choices = column(&one["plan"], "choice");
    assert!(choices.iter().all(|choice| !choice.as_str().unwrap().contains("M5")), "{choices:?}");
    assert_eq!(one["activities"][0]["candidates"], 6);
    let blind = plan(&["--lost", "kinect"], 1);
    assert_eq!(
        (&blind["status"], &blind["reason"]["activity"]),
        (&json!("infeasible"), &json!("A3"))
    );
    assert_eq!(
        (&blind["activities"][2]["candidates"], &blind["combinations"]),
        (&json!(0), &json!("0"))
    );
    let kept = blind["reason"]["relaxations"].as_array().unwrap();
    let kept = kept.iter().find(|it| it["kind"] == "keep_hardware").unwrap();
    assert_eq!(kept["hardware"], json!([{ "hardware": "kinect", "units": 1 }]));
}

#[test]
fn a_front_without_plans_is_infeasible() {
    let answer = plan(&["--objective", "front", "--energy-limit", "4000000"], 1);
    assert_eq!((&answer["status"], &answer["front"]), (&json!("infeasible"), &json!([])));
    assert_eq!(answer["reason"]["gap"], 675_896);
}

#[test]
fn a_search_cut_short_says_so() {
    let answer = plan(&["--objective", "quality", "--steps", "1"], 3);
    assert_eq!((&answer["status"], &answer["plan"]), (&json!("unknown"), &json!([])));
    assert!(answer["bound"].as_u64().unwrap() >= 21_830);
}

#[test]
fn a_mission_is_read_from_a_file_and_from_standard_input() {
    let folder = Folder::new("plan_file");
    folder.write("short walk.toml", patrol(&[("name = \"patrol\"", "name = \"walk\"")]));
    let answer = folder.cotama(&["plan", "short walk.toml", "--json"]).json(0);
    assert_eq!((&answer["mission"], &answer["energy_mj"]), (&json!("walk"), &json!(8_563_613)));
    let answer = folder.shell("cotama plan - --json < 'short walk.toml'").json(0);
    assert_eq!(answer["mission"], "walk");
    let screen = folder.cotama(&["plan", "short walk.toml"]).stdout;
    assert!(screen.ends_with("next: cotama run 'short walk.toml'\n"), "{screen}");
}

#[test]
fn the_tables_of_the_patrol_are_those_of_the_library() {
    let printed = Folder::new("table").cotama(&["table", "patrol"]);
    let stored = include_str!("../../models/src/missions/tables/patrol.rs");
    assert_eq!((printed.code, printed.stdout.as_str()), (Some(0), stored));
}

/// The rule fills the limits: it can lose on every axis.
#[test]
fn a_mission_that_does_not_ask_for_the_rule_is_planned_by_a_complete_search() {
    let folder = Folder::new("plan_objective");
    let plan = |file: &str, more: &[&str]| {
        let answer = folder.cotama(&[&["plan", file, "--json"], more].concat()).json(0);
        let text = |name: &str| answer[name].as_str().unwrap().to_owned();
        (text("objective"), text("allocator"), answer["quality"].as_u64().unwrap())
    };
    let is = |objective: &str, allocator: &str, quality| {
        (objective.to_owned(), allocator.to_owned(), quality)
    };
    let paper = "plan.objective = \"paper\" ";
    folder.write("walk.toml", patrol(&[(paper, "")]));
    assert_eq!(plan("walk.toml", &[]), is("quality", "exact", 21_830));
    assert_eq!(plan("walk.toml", &["--objective", "paper"]), is("paper", "panorama", 19_190));
    assert_eq!(plan("walk.toml", &["--allocator", "panorama"]), is("paper", "panorama", 19_190));
    folder.write("rule.toml", patrol(&[]));
    assert_eq!(plan("rule.toml", &[]), is("paper", "panorama", 19_190));
    assert_eq!(plan("rule.toml", &["--objective", "quality"]), is("quality", "exact", 21_830));
    folder.write("saving.toml", patrol(&[(paper, "plan.objective = \"min-energy\" ")]));
    let energy = folder.cotama(&["plan", "saving.toml", "--json"]).json(0);
    assert_eq!(
        (&energy["objective"], &energy["energy_mj"]),
        (&json!("min-energy"), &json!(4_675_896))
    );
    // A run pursues the same, and so does a run of faults that is made again.
    let run = |file: &str| {
        let line = ["run", file, "--faults", "none", "--no-report", "--json"];
        folder.cotama(&line).json(0)["plans"][0]["allocator"].clone()
    };
    assert_eq!((run("walk.toml"), run("rule.toml")), (json!("exact"), json!("panorama")));
    folder.write("quiet.toml", "format = \"panorama-faults/1\"\n");
    let line = ["replay", "quiet.toml", "--mission", "walk.toml", "--json"];
    assert_eq!(folder.cotama(&line).json(0)["plans"][0]["allocator"], "exact");
}

/// Ways of 1 s and 3 J or 2 s and 5 J, and then of 1 s and 5 J, 4 s and 0.25 J or 3 s and 2 J; the
/// only plan within 4 s and 5 J takes the first way and the last.
const MISSED: &str = r#"
format = "panorama-mission/1"
name = "missed"
path_length_mm = 10
limits = { order = ["duration", "energy"], duration_ms = 4100, energy_mj = 5001 }
robot = { mass_g = 9000, speed_max_mm_s = 700, impact_energy_max_mj = 4000 }
motion_power = { c0 = 0, c1 = 0, c2 = 0 }
hardware.arm = { units = 1, power_mw = 0 }
tio = [
  { id = "m", task = "MOV", needs.arm = 1, speed_max_mm_s = 100 },
  { id = "a", task = "RCV", needs.arm = 1, duration_ms = 1000, power_mw = 3000 },
  { id = "b", task = "RCV", needs.arm = 1, duration_ms = 2000, power_mw = 2500 },
  { id = "c", task = "DLV", needs.arm = 1, duration_ms = 1000, power_mw = 5000 },
  { id = "d", task = "DLV", needs.arm = 1, duration_ms = 4000, power_mw = 250 },
  { id = "e", task = "DLV", needs.arm = 1, duration_ms = 3000, power_mw = 667 },
]
objective = [
  { id = "go", x_start_mm = 0, x_end_mm = 10, tasks = ["MOV"] },
  { id = "one", x_start_mm = 10, x_end_mm = 10, tasks = ["RCV"] },
  { id = "two", x_start_mm = 10, x_end_mm = 10, tasks = ["DLV"] },
]
"#;

#[test]
fn the_rule_with_the_exact_allocator_finds_the_plans_that_the_rule_misses() {
    let folder = Folder::new("plan_missed");
    folder.write("missed.toml", MISSED);
    let plan = |allocator: &str, code| {
        let words = ["plan", "missed.toml", "--objective", "paper", "--allocator", allocator];
        folder.cotama(&[&words[..], &["--json"]].concat()).json(code)
    };
    assert_eq!(plan("panorama", 1)["status"], "infeasible");
    let found = plan("exact", 0);
    assert_eq!((&found["status"], &found["allocator"]), (&json!("optimal"), &json!("exact")));
    assert_eq!(column(&found["plan"], "choice"), ["m", "a", "e"]);
}

/// A limit that no plan keeps is an answer with reasons, whatever the limit and the mission.
#[test]
fn every_limit_that_is_too_small_is_explained() {
    for (mission, option, limits) in [
        ("delivery", "--energy-limit", [1u64, 1_000, 138_000, 1_000_000, 1_029_331, 2_000_000]),
        ("delivery", "--duration-limit", [1, 500, 29_999, 30_000, 133_332, 200_000]),
        ("patrol", "--energy-limit", [1, 1_000, 50_000, 1_000_000, 2_000_000, 4_000_000]),
        ("patrol", "--duration-limit", [1, 1_000, 8_000, 100_000, 300_000, 400_000]),
    ] {
        for limit in limits {
            let limit = limit.to_string();
            for command in ["plan", "run"] {
                let mut words = vec![command, mission, option, &limit, "--json"];
                words.extend((command == "run").then_some("--no-report"));
                let answer = folder_of_none().cotama(&words).json(1);
                let reason =
                    if command == "plan" { &answer["reason"] } else { &answer["infeasible"] };
                assert_eq!(
                    reason["axis"],
                    option[2..].split('-').next().unwrap(),
                    "{words:?} {answer}"
                );
                assert!(!reason["heaviest"].as_array().unwrap().is_empty(), "{words:?}");
                assert!(!reason["relaxations"].as_array().unwrap().is_empty(), "{words:?}");
            }
        }
    }
}

/// The answer where a plan is asked for, and an error where one is needed to begin.
#[test]
fn a_mission_without_any_plan_has_the_same_reason_in_every_command() {
    let folder = Folder::new("plan_none");
    folder.write("faults.toml", "format = \"panorama-faults/1\"\n");
    let hall = include_str!("../templates/mission.toml");
    let limit = |text: &str, key: &str, to: u64| {
        let line = text.lines().find(|it| it.starts_with(&format!("{key} = "))).unwrap();
        text.replacen(line, &format!("{key} = {to}"), 1)
    };
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap().text;
    for (text, why) in [
        (limit(hall, "energy_mj", 1_000), "no plan within the energy limit: "),
        (limit(hall, "energy_mj", 100_000), "no plan within the energy limit: "),
        (limit(hall, "duration_ms", 9_000), "no plan within the duration limit: "),
        (limit(&patrol(&[]), "energy_mj", 4_000_000), "no plan within the energy limit: 675.896 J"),
        (limit(&patrol(&[]), "duration_ms", 90_000), "no plan within the duration limit: "),
        (limit(delivery, "energy_mj", 1_000_000), "no plan within the energy limit: "),
        (limit(delivery, "duration_ms", 29_999), "no plan within the duration limit: "),
    ] {
        folder.write("it.toml", &text);
        let axis = if why.contains("energy") { "energy" } else { "duration" };
        assert_eq!(folder.cotama(&["plan", "it.toml", "--json"]).json(1)["reason"]["axis"], axis);
        let run = folder.cotama(&["run", "it.toml", "--no-report", "--json"]).json(1);
        assert_eq!(run["infeasible"]["axis"], axis, "{why}");
        for line in [
            "campaign it.toml --runs 9 --json",
            "campaign it.toml --compare --runs 9 --json",
            "replay faults.toml --mission it.toml --json",
        ] {
            let words: Vec<_> = line.split(' ').collect();
            let error = folder.cotama(&words).json(2);
            assert!(error["message"].as_str().unwrap().contains(why), "{line}: {error}");
            assert!(error["help"].as_str().unwrap().contains("cotama plan"), "{line}: {error}");
        }
    }
}

fn folder_of_none() -> Folder {
    Folder::new("plan_limits")
}
