//! `cotama run`: the patrol as it was driven, Table 7, its files, and runs that do not complete.

use crate::common::{Folder, patrol};
use serde_json::{Value, json};

#[test]
fn the_patrol_is_driven_as_in_table_7() {
    let folder = Folder::new("run_patrol");
    let answer = folder.cotama(&["run", "patrol", "--json"]).json(0);
    assert_eq!((&answer["outcome"], &answer["replans"]), (&json!("completed"), &json!(3)));
    assert_eq!((&answer["operator_requests"], &answer["x_mm"]), (&json!(0), &json!(187_000)));
    let plans: Vec<_> = answer["plans"].as_array().unwrap().iter().collect();
    let expected = [
        ("start", 0, "A1", 17),
        ("energy margin below zero", 63_400, "A8", 10),
        ("one laser lost", 118_000, "A14", 4),
        ("energy margin below zero", 170_000, "A17", 1),
    ];
    assert_eq!(plans.len(), expected.len());
    for (plan, (cause, x_mm, first, rows)) in plans.iter().zip(expected) {
        assert_eq!((&plan["cause"], &plan["x_mm"]), (&json!(cause), &json!(x_mm)));
        assert_eq!(plan["first_activity"], first);
        assert_eq!(plan["plan"].as_array().unwrap().len(), rows);
    }
    assert_eq!(plans[3]["plan"][0]["choice"], "M1 L2");
    assert_eq!(plans[0]["energy_margin_after_mj"], 76_387);
    assert_eq!(plans[0]["energy_margin_before_mj"], Value::Null);
    let near = |value: &Value, reference: i64, tolerance: i64| {
        let value = value.as_i64().unwrap();
        assert!((value - reference).abs() <= tolerance, "{value} is not near {reference}");
    };
    near(&plans[1]["energy_margin_before_mj"], -85_982, 5_000);
    near(&plans[1]["energy_margin_after_mj"], 115_400, 5_000);
    near(&answer["energy_margin_mj"], 31_348, 5_000);
    // A robot that waits at the power of rest takes longer for the same energy than one that
    // drives.
    near(&answer["duration_margin_ms"], 54_119, 2_500);
    let kinds: Vec<_> =
        answer["events"].as_array().unwrap().iter().map(|it| it["kind"].clone()).collect();
    let before_64_m = ["obstacle", "odometry", "obstacle", "odometry", "odometry"];
    assert_eq!(kinds[..5], before_64_m);
    assert_eq!(kinds[5..], ["obstacle", "obstacle", "fault", "obstacle", "obstacle", "odometry"]);
}

#[test]
fn the_delivery_is_driven_in_seven_points() {
    let folder = Folder::new("run_delivery");
    let run = folder.cotama(&["run", "delivery", "--json", "--trace", "t.jsonl"]);
    assert_eq!(run.stderr, "");
    let answer = run.json(0);
    assert_eq!(
        (&answer["outcome"], &answer["operator_requests"]),
        (&json!("completed"), &json!(2))
    );
    assert_eq!((&answer["duration_ms"], &answer["x_mm"]), (&json!(415_200), &json!(80_000)));
    assert_eq!(
        (&answer["duration_margin_ms"], &answer["energy_margin_mj"]),
        (&json!(484_800), &json!(4_438_691))
    );
    assert_eq!(
        (&answer["replans"], &answer["plans"][1]["plan"][0]["choice"]),
        (&json!(1), &json!("PF.DEG"))
    );
    let supervised = &answer["supervised"];
    let points = supervised["points"].as_array().unwrap();
    let ladder: Vec<_> = points.iter().map(|it| it["ladder"].clone()).collect();
    let activity = json!(["activity"]);
    let expected = [
        json!([]),
        json!(["parameter"]),
        activity.clone(),
        activity.clone(),
        activity.clone(),
        json!(["set", "objective"]),
        // A collision, which may be the cause as well, slows the robot down.
        json!(["parameter", "activity"]),
    ];
    assert_eq!(ladder, expected);
    let sonar = json!({
        "mode": "SON1", "t_ms": 286_500, "x_mm": 66_010, "during": "Following",
        "detected_ms": 291_400, "flags": ["sonar \
            far"], "diagnosis": "unique", "candidates": ["SON1"],
        "report": "SON1", "severity": "medium", "by_severity": "adapter",
        "by_availability": "adapter",
        "decided_ms": 291_500, "decision": "adapter", "event": "adapt_Following",
        "transition": "SON1_PF_OPT1",
        "answered_ms": 291_600, "exposed_ms": 5_200,
    });
    assert_eq!(supervised["failures"][2], sonar);
    assert_eq!(supervised["told"][0], json!({ "round": 1, "event": "gs.mission_received" }));
    let fired = json!({
        "t_ms": 291_600, "net": "following", "transition": "PF_OPT_adapts8", "place": "PF_DEG",
        "cause": 3
    });
    assert!(supervised["fired"].as_array().unwrap().contains(&fired));
    let runs: Vec<_> = supervised["configurations"]
        .as_array()
        .unwrap()
        .iter()
        .map(|it| &it["configuration"])
        .collect();
    // Point 1 is after the object was received.
    let drive = [&json!("PP"), &json!("PF.OPT"), &Value::Null, &json!("TO.FULL")];
    assert_eq!((runs[..3] == [drive[0], drive[1], drive[2]], &runs[3..7]), (true, &drive[..]));

    let again = folder.cotama(&["replay", "t.jsonl", "--json"]).json(0);
    assert_eq!((&again["identical"], &again["supervised"]), (&json!(true), supervised));
    let html = folder.read("report/delivery/index.html");
    assert!(html.contains("Who was where, when"));
    // Nothing is random: another seed is the same run.
    let other = folder.cotama(&["run", "delivery", "--json", "--seed", "9", "--no-report"]).json(0);
    assert_eq!(&other["supervised"], supervised);
}

#[test]
fn supervisors_deal_with_the_failures_of_a_file() {
    let folder = Folder::new("run_delivery_faults");
    let faults = "format = \"panorama-faults/1\"\n[[event]]\nx_mm = 5000\nkind = \"failure\"\nmode \
        = \"BAT2\"\n";
    folder.write("flat.toml", faults);
    let answer = folder.cotama(&["run", "delivery", "--faults", "flat.toml", "--json"]).json(1);
    assert_eq!(
        (&answer["outcome"], &answer["supervised"]["failures"][0]["decision"]),
        (&json!("safe"), &json!("global"))
    );
    assert!(answer["reason"].as_str().unwrap().ends_with("(BAT2)"), "{}", answer["reason"]);
    let twice = folder.cotama(&["replay", "flat.toml", "--mission", "delivery", "--json"]).json(1);
    assert_eq!((&twice["identical"], &twice["supervised"]), (&Value::Null, &answer["supervised"]));

    let quiet = folder.cotama(&["run", "delivery", "--faults", "none", "--json"]).json(0);
    assert_eq!(
        (&quiet["operator_requests"], &quiet["supervised"]["failures"]),
        (&json!(0), &json!([]))
    );
    folder.write(
        "crowd.toml",
        "format = \"panorama-faults/1\"\nevent = \
         [{ x_mm = 9, kind = \"obstacle\", delay_ms = 9 }]\nrandom = \
         [{ name = \"crowd\", per_km = 9, kind = \"obstacle\", delay_ms = 9 }]\n",
    );
    let run = folder.cotama(&["run", "delivery", "--faults", "crowd.toml", "--json"]);
    assert_eq!(
        run.stderr,
        "not simulated: 1 fault that only plans know; the mission is run by its supervisors\n"
    );
}

#[test]
fn a_limit_that_the_delivery_exceeds_is_a_failure() {
    let folder = Folder::new("run_delivery_limit");
    let answer =
        folder.cotama(&["run", "delivery", "--duration-limit", "400000", "--json"]).json(1);
    assert_eq!(
        (&answer["outcome"], &answer["duration_margin_ms"]),
        (&json!("failed"), &json!(-33_000))
    );
    assert_eq!(answer["reason"], "duration limit exceeded by 33 s");
    // Without a plan for the rest, the adapter goes on and the operator is asked.
    let points = &answer["supervised"]["points"];
    assert_eq!((&answer["replans"], &points[5]["ladder"]), (&json!(0), &json!(["set"])));
    let asked = "PLN1: mission, no plan is left that keeps the limits";
    assert_eq!((&points[6]["text"], &points[6]["ladder"]), (&json!(asked), &json!(["activity"])));
}

#[test]
fn the_report_is_written_where_it_is_said_and_nothing_else() {
    let folder = Folder::new("run_report");
    let answer = folder.cotama(&["run", "patrol", "--json"]).json(0);
    assert_eq!(
        (&answer["report"], &answer["trace"]),
        (&json!("report/patrol/index.html"), &Value::Null)
    );
    assert_eq!(folder.files("report/patrol"), ["index.html"]);
    let html = folder.read("report/patrol/index.html");
    assert!(
        html.to_lowercase().starts_with("<!doctype html>") && html.trim_end().ends_with("</html>")
    );
    // Again, over the old one, and elsewhere.
    std::fs::create_dir(folder.path().join("a")).unwrap();
    folder.cotama(&["run", "patrol", "--json", "--report", "a/b"]).json(0);
    folder.cotama(&["run", "patrol", "--json", "--report", "a/b"]).json(0);
    assert_eq!(folder.files("a/b"), ["index.html"]);
    assert_eq!(folder.read("a/b/index.html"), html);
    let none = folder.cotama(&["run", "patrol", "--json", "--no-report"]).json(0);
    assert_eq!(none["report"], Value::Null);
    assert_eq!(folder.files(""), ["a", "report"]);
}

#[test]
fn the_same_run_is_the_same_answer() {
    let folder = Folder::new("run_again");
    let first = folder.cotama(&["run", "patrol", "--json", "--seed", "7", "--trace", "a.jsonl"]);
    let second = folder.cotama(&["run", "patrol", "--json", "--seed", "7", "--trace", "a.jsonl"]);
    assert_eq!(first.json(0), second.json(0));
    assert_eq!(first.json(0)["seed"], 7);
}

#[test]
fn without_faults_there_is_one_plan_and_it_holds() {
    let answer =
        Folder::new("run_quiet").cotama(&["run", "patrol", "--faults", "none", "--json"]).json(0);
    assert_eq!((&answer["replans"], &answer["events"]), (&json!(0), &json!([])));
    // The plan rounds each activity, the run only its sums.
    assert_eq!(
        (&answer["energy_mj"], &answer["duration_ms"]),
        (&json!(8_563_598), &json!(527_923))
    );
}

#[test]
fn faults_come_from_a_file() {
    let folder = Folder::new("run_faults");
    let faults = "format = \"panorama-faults/1\"\n[[event]]\nx_mm = 90000\nkind = \"fault\"\n\
        hardware = \"kinect\"\nunits_lost = 1\n";
    folder.write("blind.toml", faults);
    let answer = folder.cotama(&["run", "patrol", "--faults", "blind.toml", "--json"]).json(1);
    assert_eq!((&answer["outcome"], &answer["operator_requests"]), (&json!("safe"), &json!(0)));
    assert_eq!(
        (&answer["x_mm"], &answer["events"][0]["hardware"]),
        (&json!(90_000), &json!("kinect"))
    );
    assert!(answer["reason"].as_str().unwrap().contains("A10"), "{}", answer["reason"]);
}

#[test]
fn hardware_lost_at_the_start_is_a_fault_at_the_start() {
    let folder = Folder::new("run_lost");
    let one = folder
        .cotama(&["run", "patrol", "--lost", "laser:1", "--faults", "none", "--json"])
        .json(0);
    let fault = json!({ "time_ms": 0, "x_mm": 0, "kind": "fault", "text": "laser failed: 1 lost, 1 \
        left",
        "lost_ms": 0, "hardware": "laser", "units": 1, "units_left": 1 });
    assert_eq!(one["events"], json!([fault]));
    assert_eq!((&one["replans"], &one["plans"][1]["x_mm"]), (&json!(1), &json!(0)));
    let blind = folder.cotama(&["run", "patrol", "--lost", "kinect", "--json"]).json(1);
    assert_eq!((&blind["outcome"], &blind["x_mm"]), (&json!("safe"), &json!(0)));
    assert_eq!(blind["infeasible"]["activity"], "A3");
}

#[test]
fn without_a_plan_at_the_start_the_robot_does_not_leave() {
    let folder = Folder::new("run_infeasible");
    let answer = folder.cotama(&["run", "patrol", "--energy-limit", "4000000", "--json"]).json(1);
    assert_eq!((&answer["outcome"], &answer["plans"]), (&json!("safe"), &json!([])));
    assert_eq!(answer["infeasible"]["gap"], 675_896);
    assert_eq!(answer["report"], Value::Null);
}

#[test]
fn objectives_are_pursued_in_a_run() {
    let folder = Folder::new("run_objectives");
    let run = |objective| {
        let arguments = [
            "run",
            "patrol",
            "--json",
            "--no-report",
            "--faults",
            "none",
            "--objective",
            objective,
        ];
        folder.cotama(&arguments).json(0)
    };
    assert_eq!(run("min-energy")["plans"][0]["energy_margin_after_mj"], 8_640_000 - 4_675_896);
    assert_eq!(run("quality")["plans"][0]["allocator"], "exact");
}

#[test]
fn limits_of_the_command_line_are_those_of_the_run() {
    let folder = Folder::new("run_limits");
    let arguments = [
        "run",
        "patrol",
        "--json",
        "--faults",
        "none",
        "--energy-limit",
        "9000000",
        "--trace",
        "t.jsonl",
    ];
    let answer = folder.cotama(&arguments).json(0);
    let used = answer["energy_mj"].as_i64().unwrap();
    assert_eq!(answer["energy_margin_mj"], 9_000_000 - used);
    // The trace holds them: it comes out the same.
    assert_eq!(folder.cotama(&["replay", "t.jsonl", "--json"]).json(0)["identical"], true);
}

#[test]
fn the_monitor_period_and_better_plans_are_options() {
    let folder = Folder::new("run_options");
    let run = |arguments: &[&str]| {
        folder.cotama(&[&["run", "patrol", "--json", "--no-report"], arguments].concat()).json(0)
    };
    assert_eq!(run(&["--monitor-period", "30000"])["replans"], 3);
    let causes = |answer: &Value| {
        let plans = answer["plans"].as_array().unwrap();
        plans.iter().map(|plan| plan["cause"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert!(causes(&run(&["--upward"])).contains(&"room for a better plan".to_owned()));
}

#[test]
fn a_mission_file_names_its_report() {
    let folder = Folder::new("run_file");
    folder.write("night watch.toml", patrol(&[]));
    let answer = folder.cotama(&["run", "night watch.toml", "--json"]).json(0);
    assert_eq!(answer["report"], "report/night-watch/index.html");
}

/// The header of the trace has the options of a run: a better plan is looked for when a margin has
/// grown by a hundredth of its limit and leaves half of that; hardware lost at the start is lost
/// before anything in the file happens.
#[test]
fn a_trace_has_the_options_of_its_run() {
    let folder = Folder::new("run_asked");
    let faults = "format = \"panorama-faults/1\"\n\
        event = [{ x_mm = 0, kind = \"obstacle\", delay_ms = 3 }]";
    folder.write("faults.toml", faults);
    let words = ["run", "patrol", "--upward", "--lost", "laser", "--faults", "faults.toml"];
    let ended = folder.cotama(&[&words[..], &["--trace", "t.jsonl"]].concat());
    assert_eq!(ended.code, Some(0), "{ended:?}");
    let trace = folder.read("t.jsonl");
    let header: Value = serde_json::from_str(trace.lines().next().unwrap()).unwrap();
    let options = &header["options"];
    let amounts = |ms: u64, mj: u64| json!({ "duration_ms": ms, "energy_mj": mj });
    let upward = json!({ "growth": amounts(6_000, 86_400), "reserve": amounts(3_000, 43_200) });
    assert_eq!(options["upward"], upward);
    let text = options["faults"]["text"].as_str().unwrap();
    let kinds: Vec<_> = text.lines().filter(|it| it.starts_with("kind")).collect();
    assert_eq!(kinds, ["kind = \"fault\"", "kind = \"obstacle\""]);
}

#[test]
fn a_mission_says_the_seed_of_its_runs_unless_another_is_given() {
    let folder = Folder::new("run_seed");
    let ward = cotama_models::missions::embedded::mission("ward").unwrap().text;
    folder.write("mine.toml", ward.replacen("[run]\n", "[run]\nseed = 7\n", 1));
    let run = |mission: &str, more: &[&str]| {
        let given = ["run", mission, "--fidelity", "signal", "--no-report", "--json"];
        folder.cotama(&[&given[..], more].concat()).json(0)
    };
    let mine = run("mine.toml", &[]);
    assert_eq!(mine["seed"], 7);
    assert_eq!(mine, run("ward", &["--seed", "7"]));
    let plain = run("ward", &[]);
    assert_eq!(run("mine.toml", &["--seed", "0"]), plain);
    assert_ne!(mine, plain);
}
