//! `cotama conform`: recorded runs, held against their models.

use crate::common::{Folder, golden};
use serde_json::{Value, json};

fn door() -> Vec<Value> {
    vec![
        json!({ "schema": "cotama-recording/1" }),
        json!({ "t_ms": 0, "event": "Call" }),
        json!({ "t_ms": 0, "fired": "call" }),
        json!({ "t_ms": 1_000, "event": "Call", "ignored": true }),
        json!({ "t_ms": 2_000, "event": "EndOpen" }),
        json!({ "t_ms": 2_000, "fired": "opened" }),
        json!({ "t_ms": 7_000, "fired": "close" }),
        json!({ "t_ms": 7_500, "end": true }),
    ]
}

fn text(lines: &[Value]) -> String {
    lines.iter().map(Value::to_string).collect::<Vec<_>>().join("\n") + "\n"
}

fn conforms(folder: &Folder, model: &str, lines: &[Value]) -> Value {
    folder.write("run.jsonl", text(lines));
    let answer = folder.cotama(&["conform", model, "run.jsonl", "--json"]).json(0);
    assert_eq!((&answer["conforms"], &answer["departs"]), (&json!(true), &Value::Null));
    answer
}

fn departs(folder: &Folder, arguments: &[&str], lines: &[Value]) -> Value {
    folder.write("run.jsonl", text(lines));
    let arguments = [&["conform"], arguments, &["run.jsonl", "--json"]].concat();
    let answer = folder.cotama(&arguments).json(1);
    assert_eq!(answer["conforms"], false);
    answer["departs"].clone()
}

#[test]
fn a_run_of_the_door_is_accepted() {
    let folder = Folder::new("conform_door");
    let answer = conforms(&folder, "door", &door());
    assert_eq!((&answer["events"], &answer["fired"]), (&json!(3), &json!(3)));
    let ended = folder.cotama(&["conform", "door", "run.jsonl"]);
    assert_eq!(ended.code, Some(0));
    golden("conform_door.txt", &ended.stdout);
}

#[test]
fn a_run_of_the_watchdog_keeps_its_deadlines() {
    let folder = Folder::new("conform_watchdog");
    let told = |event: &str, t_ms: u64| json!({ "t_ms": t_ms, "event": event });
    let fired = |name: &str, t_ms: u64| json!({ "t_ms": t_ms, "fired": name });
    let w3 = "w3.misses_0";
    let run = |deadline: u64| {
        vec![
            told("Release", 0),
            fired("w1", 0),
            fired(w3, deadline),
            told("Done", 110),
            fired("w4.misses_1", 110),
        ]
    };
    // The names of the lines of counters are those that the simulation prints.
    let names = folder.cotama(&["simulate", "watchdog", "Release", "+100", "Done@110", "--json"]);
    let names = names.json(0)["fired"].clone();
    let run = |deadline: u64| {
        let mut run = run(deadline);
        (run[2]["fired"], run[4]["fired"]) = (names[1].clone(), names[2].clone());
        run
    };
    conforms(&folder, "watchdog", &run(100));
    let early = departs(&folder, &["watchdog"], &run(99));
    assert_eq!(early["line"], 3);
    assert!(early["reason"].as_str().unwrap().contains("too early"), "{early}");
    let late = departs(&folder, &["watchdog"], &run(104));
    assert!(late["reason"].as_str().unwrap().contains("had to fire by 100 ms"), "{late}");
    let near = folder.cotama(&["conform", "watchdog", "run.jsonl", "--tolerance", "5"]);
    assert_eq!(near.code, Some(0), "{near:?}");
    let window = json!([{ "transition": names[1], "earliest_ms": 100, "latest_ms": 100 }]);
    assert_eq!(early["allowed"]["fired"], window);
}

#[test]
fn the_trace_of_a_supervised_mission_is_a_run_of_its_supervisors() {
    let folder = Folder::new("conform_delivery");
    let ran = folder.cotama(&["run", "delivery", "--no-report", "--trace", "d.jsonl"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let answer = folder.cotama(&["conform", "delivery", "d.jsonl", "--json"]).json(0);
    assert!(answer["rounds"].as_u64() > Some(1_000), "{answer}");
    // And one that was told less, or that says less, is not.
    let trace = folder.read("d.jsonl");
    let lines: Vec<_> = trace.lines().collect();
    let without = |left_out: usize| {
        let kept = lines.iter().enumerate().filter(|it| it.0 != left_out);
        kept.map(|it| *it.1).collect::<Vec<_>>().join("\n") + "\n"
    };
    let of_kind = |kind: &str| {
        let marked = format!("\"record\":\"{kind}\"");
        (0..lines.len()).filter(|&at| lines[at].contains(&marked)).collect::<Vec<_>>()
    };
    let (told, fired) = (of_kind("told"), of_kind("fired"));
    assert!(told.len() > 10 && fired.len() > 10, "{} {}", told.len(), fired.len());
    let mut refused = 0;
    for &left_out in &told {
        folder.write("less.jsonl", without(left_out));
        let code = folder.cotama(&["conform", "delivery", "less.jsonl"]).code;
        assert_eq!(code, Some(1), "{}", lines[left_out]);
        refused += 1;
    }
    assert!(refused > 10);
    for &left_out in fired.iter().step_by(5) {
        folder.write("less.jsonl", without(left_out));
        let code = folder.cotama(&["conform", "delivery", "less.jsonl"]).code;
        assert_eq!(code, Some(1), "{}", lines[left_out]);
    }
    folder.write("less.jsonl", without(told[3]));
    let ended = folder.cotama(&["conform", "delivery", "less.jsonl"]);
    golden("conform_delivery.txt", &ended.stdout);
}

#[test]
fn a_simulated_game_is_a_run() {
    let folder = Folder::new("conform_simulated");
    let runs: [&[&str]; 7] = [
        &["door", "Call", "EndOpen@2000", "+5000", "EndClosed", "Call"],
        &["watchdog", "Release", "+100", "Release", "Done", "+300"],
        &["crossing", "Button", "+30000", "Button"],
        &["charger", "+30000"],
        &["philosophers:3", "left_first_1", "then_right_1", "left_first_2", "end_1"],
        &["delivery", "gs.mission_received", "ls.Planning_done", "+10", "faults.fail_BMP1"],
        &["delivery", "--rounds", "gs.mission_received", "+100", "ls.Planning_done", "+100"],
    ];
    for run in runs {
        let played = folder.cotama(&[&["simulate"], run, &["--trace", "run.jsonl"]].concat());
        assert_eq!(played.code, Some(0), "{played:?}");
        for line in folder.read("run.jsonl").lines() {
            crate::schemas::validate("recording", &serde_json::from_str(line).unwrap());
        }
        let ended = folder.cotama(&["conform", run[0], "run.jsonl"]);
        assert_eq!(ended.code, Some(0), "{run:?}: {ended:?}\n{}", folder.read("run.jsonl"));
    }
    let both = folder.cotama(&["simulate", "door", "--rounds", "Call", "--trace", "x.jsonl"]);
    assert_eq!(both.code, Some(2), "{both:?}");
}

/// Both have one limit of time.
#[test]
fn a_game_at_any_time_is_read_again_or_refused_before_it_is_written() {
    let folder = Folder::new("conform_times");
    let last = (1_u64 << 53) - 1;
    for (steps, code) in [
        (format!("Call EndOpen@{last}"), 0),
        (format!("Call EndOpen@{}", last - 1), 0),
        (format!("Call +{last}"), 0),
        (format!("Call EndOpen@{} +5000", last - 5_000), 0),
        (format!("Call@{last} EndOpen"), 0),
        (format!("Call EndOpen@{}", last + 1), 2),
        (format!("Call +{}", last + 1), 2),
        (format!("Call EndOpen@5 +{last}"), 2),
        (format!("Call +{last} +1"), 2),
        (format!("Call EndOpen@{}", u64::MAX), 2),
        (format!("Call EndOpen@{}0", u64::MAX), 2),
    ] {
        let _ = std::fs::remove_file(folder.path().join("t.jsonl"));
        let simulated = folder.shell(&format!("cotama simulate door {steps} --trace t.jsonl"));
        assert_eq!(simulated.code, Some(code), "{steps}: {}", simulated.stderr);
        if code == 0 {
            assert_eq!(folder.shell("cotama conform door t.jsonl").code, Some(0), "{steps}");
        } else {
            let said = simulated.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(said.contains(&format!("at most {last}")), "{said}");
            assert_eq!(folder.files(""), [""; 0], "{steps}");
        }
    }
}

#[test]
fn the_first_line_that_departs_is_named_with_its_reason_and_the_allowed_ones() {
    let folder = Folder::new("conform_departs");
    let edited = |name: &str, edit: &dyn Fn(&mut Vec<Value>)| {
        let mut run = door();
        edit(&mut run);
        folder.write("run.jsonl", text(&run));
        let ended = folder.cotama(&["conform", "door", "run.jsonl"]);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{name}");
        golden(&format!("conform_{name}.txt"), &ended.stdout);
    };
    edited("no_event", &|run| drop(run.remove(4)));
    edited("no_firing", &|run| drop(run.remove(2)));
    edited("late", &|run| run[6]["t_ms"] = json!(7_200));
    edited("early", &|run| run[6]["t_ms"] = json!(6_000));
    edited("other", &|run| run[5]["fired"] = json!("closed"));
    edited("not_ignored", &|run| run[1]["ignored"] = json!(true));
    edited("ignored", &|run| run[3] = json!({ "t_ms": 1_000, "event": "Call", "ignored": false }));
    edited("never", &|run| drop(run.remove(6)));
    edited("cut", &|run| run.truncate(2));
    let departs = departs(&folder, &["door"], &door()[..2]);
    assert_eq!(
        (&departs["line"], &departs["reason"]),
        (&json!(2), &json!("the recording ends, and `call` had to fire on `Call` at 0 ms"))
    );
    let allowed = json!([{ "transition": "call", "earliest_ms": 0, "latest_ms": 0 }]);
    assert_eq!(departs["allowed"], json!({ "fired": allowed, "events": [] }));
}

#[test]
fn a_mailbox_is_read_in_rounds() {
    let folder = Folder::new("conform_rounds");
    let told = |event: &str| json!({ "t_ms": 0, "event": event });
    let header = |every: u64| {
        json!({ "schema": "cotama-recording/1", "round_every_ms": every,
        "silent": ["operator"] })
    };
    // Once told, nobody starts the drive before the next round.
    let run = |first: Value, start: u64| {
        let start = json!({ "t_ms": start, "fired": "ls.ls1" });
        vec![first, told("gs.mission_received"), json!({ "t_ms": 0, "fired": "gs.gs1" }), start]
    };
    let names = folder.cotama(&["simulate", "delivery", "gs.mission_received", "--json"]).json(0);
    let named = |mut run: Vec<Value>| {
        (run[2]["fired"], run[3]["fired"]) = (names["fired"][0].clone(), names["fired"][1].clone());
        run
    };
    conforms(&folder, "delivery", &named(run(header(100), 100)));
    let early = departs(&folder, &["delivery"], &named(run(header(200), 100)));
    assert!(early["reason"].as_str().unwrap().contains("nothing made it fire"), "{early}");
    conforms(&folder, "delivery", &named(run(json!({ "schema": "cotama-recording/1" }), 0)));
}

#[test]
fn a_time_net_of_tina_fires_anywhere_in_its_intervals() {
    let folder = Folder::new("conform_tina");
    folder.write(
        "lamp.net",
        "net lamp\ntr on [2,5] off -> lit\ntr out [10,w[ lit -> off\npl off (1)\n",
    );
    let fired = |name: &str, t_ms: u64| json!({ "t_ms": t_ms, "fired": name });
    for at in [2, 4, 5] {
        conforms(&folder, "lamp.net", &[fired("on", at), fired("out", at + 10)]);
    }
    let late = departs(&folder, &["lamp.net"], &[fired("on", 6)]);
    assert_eq!(late["reason"], "`on` fired at 6 ms, too late: it had to fire by 5 ms");
    let early = departs(&folder, &["lamp.net"], &[fired("on", 4), fired("out", 12)]);
    let reason = "`out` fired at 12 ms, too early: it could not fire before 14 ms";
    assert_eq!(early["reason"], reason);
    let window = json!([{ "transition": "out", "earliest_ms": 14, "latest_ms": null }]);
    assert_eq!(early["allowed"]["fired"], window);
}

#[test]
fn recordings_that_are_none() {
    let folder = Folder::new("conform_bad");
    let refused = |name: &str, model: &str, text: &str| {
        folder.write("run.jsonl", text);
        let ended = folder.cotama(&["conform", model, "run.jsonl"]);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{name}: {ended:?}");
        golden(&format!("bad_conform_{name}.txt"), &ended.stderr);
    };
    let call = "{\"t_ms\":0,\"event\":\"Call\"}\n";
    refused("name", "door", &format!("{call}{{\"t_ms\":0,\"fired\":\"cal\"}}\n"));
    refused("event", "door", "{\"t_ms\":0,\"event\":\"Ring\"}\n");
    refused("net_missing", "delivery", "{\"t_ms\":0,\"event\":\"mission_received\"}\n");
    refused("broken", "door", &format!("{call}{{\"t_ms\":0,\"fired\":\n"));
    refused("fraction", "door", &format!("{call}{{\"t_ms\":0.5,\"fired\":\"call\"}}\n"));
    refused("nothing_said", "door", &format!("{call}{{\"t_ms\":0,\"evnt\":\"Call\"}}\n"));
    refused("no_time", "door", "{\"event\":\"Call\"}\n");
    refused("empty", "door", "");
    refused("back", "door", "{\"t_ms\":9,\"event\":\"Call\"}\n{\"t_ms\":8,\"event\":\"Call\"}\n");
    refused("after_end", "door", &format!("{{\"t_ms\":0,\"end\":true}}\n{call}"));
    refused("schema", "door", "{\"schema\":\"cotama-recording/2\"}\n");
    let silent = "{\"schema\":\"cotama-recording/1\",\"silent\":[\"cx\"]}\n";
    refused("silent", "delivery", &format!("{silent}{{\"t_ms\":0,\"end\":true}}\n"));
    refused("header_alone", "delivery", silent);
    folder.write("patrol.toml", crate::common::patrol(&[]));
    let ran = folder.cotama(&["run", "patrol", "--no-report", "--trace", "run.jsonl"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let trace = folder.read("run.jsonl");
    refused("no_supervisor", "door", &trace);
    let header = trace.lines().next().unwrap();
    refused("half_trace", "delivery", &format!("{header}\n{{\"record\":\"sample\",\"t_us\""));
}
