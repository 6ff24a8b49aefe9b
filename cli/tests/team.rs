//! Teams of robots: `cotama run service`, `cotama run fleet`, and what other commands make of one.

use crate::common::{Folder, golden};
use crate::schemas::validate;
use serde_json::{Value, json};

#[test]
fn the_service_is_that_of_the_thesis() {
    let folder = Folder::new("team_service");
    let screen = folder.cotama(&["run", "service"]);
    assert_eq!((screen.code, screen.stderr.as_str()), (Some(0), ""));
    golden("run_service.txt", &screen.stdout);
    let page = folder.read("report/service/index.html");
    assert!(page.contains("All 2 tasks are done") && page.contains("fetch-and-bring"));
    let answer = folder.cotama(&["run", "service", "--json", "--no-report"]).json(0);
    validate("run-team", &answer);
    let awards = answer["run"]["awards"].as_array().unwrap().iter();
    let awards: Vec<_> = awards.map(|it| json!([it["task"], it["plan"], it["robots"]])).collect();
    assert_eq!(
        awards,
        [
            json!(["order", "order", ["Eddie"]]),
            json!(["serve", "bring", ["Eddie"]]),
            json!(["serve", "fetch-and-bring", ["Poppy", "Eddie"]]),
            json!(["serve", "fetch", ["Poppy"]]),
        ]
    );
    let errors = answer["run"]["errors"].as_array().unwrap().iter();
    let classes: Vec<_> = errors.map(|it| it["class"].clone()).collect();
    assert_eq!(classes, ["recoverable", "semi-recoverable", "semi-recoverable"]);
}

#[test]
fn a_cup_out_of_reach_is_fetched_for_another_robot() {
    let folder = Folder::new("team_handle");
    let answer = folder.cotama(&["run", "service", "--hidden-handle", "--json"]).json(0);
    let awards = answer["run"]["awards"].as_array().unwrap();
    assert_eq!(awards.len(), 2);
    assert_eq!(awards[1]["robots"], json!(["Poppy", "Eddie"]));
}

#[test]
fn a_fleet_ends_all_its_tasks_and_leaves_a_trace() {
    let folder = Folder::new("team_fleet");
    let small = ["run", "fleet", "--robots", "8", "--tasks", "20", "--failures", "2"];
    let with = |more: &[&str]| folder.cotama(&[&small[..], more].concat());
    golden("run_fleet.txt", &with(&["--loss", "10", "--seed", "3"]).stdout);
    let answer = with(&["--json", "--trace", "t.jsonl"]).json(0);
    validate("run-team", &answer);
    assert_eq!((&answer["outcome"], &answer["run"]["done"]), (&json!("completed"), &json!(20)));
    let trace = folder.read("t.jsonl");
    let first: serde_json::Value = serde_json::from_str(trace.lines().next().unwrap()).unwrap();
    assert_eq!(first["schema"], "cotama/team-trace/2");
    assert!(trace.lines().last().unwrap().contains("\"record\":\"end\""));
    assert_eq!(trace.lines().filter(|it| it.contains("\"record\":\"done\"")).count(), 20);
}

#[test]
fn allocations_are_compared_on_common_seeds() {
    let folder = Folder::new("team_seeds");
    let small = ["run", "fleet", "--robots", "6", "--tasks", "12", "--seeds", "4"];
    golden("run_fleet_seeds.txt", &folder.cotama(&small).stdout);
    let answer = folder.cotama(&[&small[..], &["--json"]].concat()).json(0);
    validate("run-team", &answer);
    let rows = answer["compared"]["allocations"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|it| it["allocation"].clone()).collect();
    assert_eq!(names, ["optimal", "rounds", "one-by-one"]);
    assert_eq!(rows[0]["more_ms"], json!({ "mean": 0, "low": 0, "high": 0 }));
}

#[test]
fn trust_in_skills_is_compared_on_common_seeds() {
    let folder = Folder::new("team_trust");
    let small =
        ["run", "fleet", "--robots", "4", "--tasks", "12", "--failures", "0", "--loss", "0"];
    let failing = [&small[..], &["--gripper", "30"]].concat();
    let many = [&failing[..], &["--seeds", "4", "--compare", "trust"]].concat();
    golden("run_fleet_trust.txt", &folder.cotama(&many).stdout);
    let answer = folder.cotama(&[&many[..], &["--json"]].concat()).json(0);
    validate("run-team", &answer);
    let rows = answer["compared"]["trusts"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|it| it["trust"].clone()).collect();
    assert_eq!(names, ["certain", "stated", "learned", "known"]);
    assert_eq!(rows[3]["undue_milli"], json!({ "mean": 0, "low": 0, "high": 0 }));
    let one = [&failing[..], &["--trust", "learned", "--json", "--no-report"]].concat();
    let answer = folder.cotama(&one).json(0);
    validate("run-team", &answer);
    assert_eq!(answer["run"]["skills"].as_array().unwrap().len(), 4);
    for (options, said) in [
        ("--seeds 2 --compare trust --trust known", "every trust is run and compared"),
        ("--compare trust", "--seeds"),
        ("--gripper 101", "a number from 0 to 100"),
        ("--trust luck", "certain, stated, learned, known"),
    ] {
        let ended = folder.shell(&format!("cotama run fleet {options}"));
        assert_eq!(ended.code, Some(2), "{options}");
        assert!(ended.stderr.contains(said), "{options}: {}", ended.stderr);
    }
}

#[test]
fn options_of_missions_and_of_teams_are_told_apart() {
    let folder = Folder::new("team_options");
    let tenth = "fault = [{ at_ms = 0, robot = \"r10\", mode = \"SON1\" }]";
    folder.write("tenth.toml", format!("format = \"cotama-team-faults/1\"\n{tenth}\n"));
    folder.shell("cotama show service > team.toml");
    for (line, said) in [
        ("run patrol --robots 3", "--robots is for teams"),
        ("run flete", "did you mean the team `fleet`?"),
        ("run fleet --upward", "--upward is for missions"),
        ("run fleet --faults f.toml", "give the path of a file of a team's faults"),
        ("run fleet --robots 3 --failures 0 --faults tenth.toml", "unknown robot `r10`"),
        ("run - < team.toml", "a team is read from a file"),
        ("run fleet --hidden-handle", "is for `cotama run service`"),
        ("run service --tasks 3", "--tasks is for `cotama run fleet`"),
        ("run fleet --robots 3 --failures 4", "there are 3 robots"),
        ("run fleet --loss 51", "a number from 0 to 50"),
        ("run fleet --robots 65", "from 1 to 64"),
    ] {
        let ended = folder.shell(&format!("cotama {line}"));
        assert_eq!(ended.code, Some(2), "{line}");
        assert!(ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
}

/// Two robots, of which both can carry and one can speak.
const TWO: &str = r#"format = "cotama-team/1"
name = "two robots"
floor = { places = ["hall", "desk"], way = [{ between = ["hall", "desk"], length_mm = 6000 }] }
robot = [
  { name = "anna", at = "hall", skills = ["grasp", "talk"] },
  { name = "ben", at = "desk", skills = ["grasp"] },
]
[[task]]
name = "parcel"
from = "hall"
to = "desk"
skip_ms = 600000
[[task.plan]]
name = "carry"
[[task.plan.role]]
name = "carrier"
needs = ["grasp"]
take = "object"
give = "goal"
take_ms = 5000
give_ms = 5000
[[task.plan]]
name = "hand over"
[[task.plan.role]]
name = "first"
needs = ["grasp"]
take = "object"
give = { partner_at = "desk" }
take_ms = 1000
give_ms = 1000
[[task.plan.role]]
name = "second"
needs = ["talk"]
take = { partner_at = "desk" }
give = "goal"
take_ms = 1000
give_ms = 1000
[[task]]
name = "greet"
from = "hall"
to = "desk"
skip_ms = 9000
[[task.plan]]
name = "speak"
[[task.plan.role]]
name = "speaker"
needs = ["talk"]
take = { words_at = "desk" }
give = "nobody"
take_ms = 1000
give_ms = 0
"#;

/// The same in JSON.
fn two_in_json() -> serde_json::Value {
    let role = |name: &str, needs: &str, take: serde_json::Value, give: serde_json::Value| {
        json!({ "name": name, "needs": [needs], "take": take, "give": give, "take_ms": 1000,
                "give_ms": 1000 })
    };
    let there = json!({ "partner_at": "desk" });
    json!({
        "format": "cotama-team/1",
        "name": "two robots",
        "floor": {
            "places": ["hall", "desk"],
            "way": [{ "between": ["hall", "desk"], "length_mm": 6000 }],
        },
        "robot": [
            { "name": "anna", "at": "hall", "skills": ["grasp", "talk"] },
            { "name": "ben", "at": "desk", "skills": ["grasp"] },
        ],
        "task": [
            {
                "name": "parcel", "from": "hall", "to": "desk", "skip_ms": 600_000,
                "plan": [
                    { "name": "carry", "role": [
                        { "name": "carrier", "needs": ["grasp"], "take": "object", "give": "goal",
                          "take_ms": 5000, "give_ms": 5000 },
                    ]},
                    { "name": "hand over", "role": [
                        role("first", "grasp", json!("object"), there.clone()),
                        role("second", "talk", there, json!("goal")),
                    ]},
                ],
            },
            {
                "name": "greet", "from": "hall", "to": "desk", "skip_ms": 9000,
                "plan": [{ "name": "speak", "role": [
                    { "name": "speaker", "needs": ["talk"], "take": { "words_at": "desk" },
                      "give": "nobody", "take_ms": 1000, "give_ms": 0 },
                ]}],
            },
        ],
    })
}

#[test]
fn a_team_in_json_is_the_team_in_toml_for_every_command() {
    let folder = Folder::new("team_json");
    folder.write("two.toml", TWO);
    folder.write("two.json", format!("{:#}", two_in_json()));
    for line in [
        "show FILE",
        "run FILE --no-report --json",
        "assign FILE --json",
        "assign - --json < FILE",
        "statespace FILE --mcc",
        "export FILE --format json",
        "campaign FILE --runs 3 --json",
    ] {
        let said = |file: &str| {
            let ended = folder.shell(&format!("cotama {}", line.replace("FILE", file)));
            assert_eq!(ended.code, Some(0), "{line}: {}", ended.stderr);
            ended.stdout.replace(file, "FILE")
        };
        assert_eq!(said("two.json"), said("two.toml"), "{line}");
    }
}

#[test]
fn a_team_at_work_is_assigned_as_it_starts() {
    let folder = Folder::new("team_assign");
    golden("assign_service.txt", &folder.cotama(&["assign", "service"]).stdout);
    folder.shell("cotama show service > mine.toml");
    let named = folder.cotama(&["assign", "service", "--json"]).json(0);
    validate("assign", &named);
    assert_eq!(folder.cotama(&["assign", "mine.toml", "--json"]).json(0), named);
    // Anna stands where the parcel is. She carries it: to greet besides would take two of her.
    folder.write("two.toml", TWO);
    let answer = folder.cotama(&["assign", "two.toml", "--json"]).json(0);
    validate("assign", &answer);
    assert_eq!(answer["cost_denominator"], 2);
    let done = answer["assignment"].as_array().unwrap();
    assert_eq!(done.len(), 1, "{answer}");
    assert_eq!((&done[0]["plan"], &done[0]["robots"]), (&json!("carry"), &json!(["anna"])));
}

#[test]
fn the_protocol_of_a_team_keeps_its_requirements() {
    let folder = Folder::new("team_check");
    folder.write("two.toml", TWO);
    let answer = folder.cotama(&["check", "two.toml", "--json"]).json(0);
    validate("check", &answer);
    let results = answer["results"].as_array().unwrap();
    let ids: Vec<_> = results.iter().map(|it| it["id"].as_str().unwrap()).collect();
    let all = ["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9", "L1", "L2", "L3", "L4"];
    assert_eq!(ids, all);
    assert!(results.iter().all(|it| it["verdict"] == "true"));
    // A robot that cannot speak never greets; and the questions can be answered no.
    let fault = "[[fault]]\nat_ms = 9\nrobot = \"anna\"\nmode = \"EST1\"\n";
    folder.write("fails.toml", format!("{TWO}{fault}"));
    for (file, property, code) in [
        ("two.toml", "AG !r2.executing.t2", 0),
        ("two.toml", "EF (r2.executing.t1 & !r1.executing.t1)", 0),
        ("two.toml", "EF (r1.executing.t1 & r2.executing.t1)", 0),
        ("two.toml", "EF r1.down", 1),
        ("two.toml", "AF t2.reported", 1),
        ("fails.toml", "EF r1.down", 0),
        ("fails.toml", "EF t2.reported", 0),
        ("fails.toml", "EF t1.reported", 1),
    ] {
        let ended = folder.cotama(&["check", file, "--property", property]);
        assert_eq!(ended.code, Some(code), "{file} {property}: {}{}", ended.stdout, ended.stderr);
    }
    assert_eq!(folder.cotama(&["check", "fails.toml"]).code, Some(0));
}

#[test]
fn a_team_too_large_for_a_net_is_unknown() {
    let folder = Folder::new("team_large");
    let ended = folder.cotama(&["check", "fleet"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(3), ""));
    golden("check_fleet.txt", &ended.stdout);
    let answer = folder.cotama(&["check", "fleet", "--json", "--junit", "f.xml"]).json(3);
    validate("check", &answer);
    let verdicts = answer["results"].as_array().unwrap().iter().map(|it| it["verdict"].clone());
    assert_eq!(verdicts.collect::<Vec<_>>(), vec![json!("unknown"); 13]);
    assert!(folder.read("f.xml").contains("S1"));
    let asked = ["check", "fleet", "--mcc", "--property", "AG !(a & b)"];
    assert_eq!(
        folder.cotama(&asked).stdout,
        "FORMULA AG\\u{20}!(a\\u{20}&\\u{20}b) CANNOT_COMPUTE\n"
    );
    let other = folder.cotama(&["statespace", "fleet"]);
    assert_eq!(other.code, Some(2));
    assert!(other.stderr.contains("may have more than 100000 transitions"), "{}", other.stderr);
}

#[test]
fn a_broken_team_is_told_once_with_its_place() {
    let folder = Folder::new("team_broken");
    let whole = format!("{:#}", two_in_json());
    for (from, to, at, said) in [
        ("\"hall\",\n", "\"hall\" \n", None, "`,` or `]` is needed here"),
        ("\"length_mm\": 6000", "\"length_mm\": \"far\"", None, "must be an integer, not a text"),
        ("\"at\": \"desk\"", "\"at\": \"dsk\"", None, "did you mean `desk`?"),
        ("\"skip_ms\": 9000", "\"skip\": 9000", None, "did you mean `skip_ms`?"),
        (&whole, "{\"format\": \"cotama-team/1\"", Some("1:27"), "the text is cut off"),
        (&whole, "{\"format\": \"cotama-team/2\"}", Some("1:12"), "unknown format"),
    ] {
        assert!(whole.contains(from), "{from}");
        folder.write("t.json", whole.replacen(from, to, 1));
        for command in ["assign t.json", "run t.json --no-report", "check t.json", "show t.json"] {
            let ended = folder.shell(&format!("cotama {command}"));
            assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{command}: {to}");
            assert!(ended.stderr.contains(said), "{command}: {}", ended.stderr);
            assert_eq!(ended.stderr.matches(" --> ").count(), 1, "{command}: {}", ended.stderr);
            if let Some(at) = at {
                assert!(ended.stderr.contains(&format!("t.json:{at}")), "{}", ended.stderr);
            }
        }
    }
}

/// Each bid is taken apart into parts that add up, and is that of the run.
#[test]
fn a_bid_is_explained_by_the_parts_of_which_it_is_made() {
    let folder = Folder::new("team_explained");
    let mut screens = folder.cotama(&["explain", "service"]).stdout;
    screens += &folder.cotama(&["explain", "service", "serve"]).stdout;
    folder.write("two.toml", TWO);
    screens += &folder.cotama(&["explain", "two.toml", "parcel"]).stdout;
    golden("explain_team.txt", &screens);

    let service = folder.cotama(&["explain", "service", "--json"]).json(0);
    validate("explain-team", &service);
    let two = folder.cotama(&["explain", "two.toml", "parcel", "--json"]).json(0);
    validate("explain-team", &two);
    let number = |it: &Value| it.as_u64().unwrap();
    let mut bids = 0;
    for answer in [&service, &two] {
        let tasks = answer["because"].as_array().unwrap().iter();
        let plans = tasks.flat_map(|it| it["plans"].as_array().unwrap());
        let roles = plans.flat_map(|it| it["roles"].as_array().unwrap());
        for bid in roles.flat_map(|it| it["bids"].as_array().unwrap()) {
            let Some(cost) = bid["bid_ms"].as_u64() else {
                assert!(!bid["lacks"].as_array().unwrap().is_empty(), "{bid}");
                continue;
            };
            let counts = &bid["counts"];
            let drives: u64 = counts["drives_ms"].as_array().unwrap().iter().map(number).sum();
            let rest = ["rounds_ms", "take_ms", "give_ms"].map(|it| number(&counts[it]));
            let sum = drives + rest.iter().sum::<u64>() + number(&bid["failures_ms"]);
            assert_eq!(sum, cost, "{bid}");
            bids += 1;
        }
    }
    assert_eq!(bids, 14);
    // The award of a run has the bid of its winner.
    let run = folder.cotama(&["run", "two.toml", "--no-report", "--json"]).json(0);
    let best = &two["because"][0]["best"];
    assert_eq!(run["run"]["awards"][0]["robots"], best["robots"]);
    let parts = number(&two["because"][0]["cost_denominator"]);
    assert_eq!(number(&run["run"]["awards"][0]["costs_ms"][0]) * parts, number(&best["cost"]));
    // So has the assignment, in as many parts.
    let assigned = folder.cotama(&["assign", "two.toml", "--json"]).json(0);
    assert_eq!(assigned["assignment"][0]["cost"], best["cost"]);
}

#[test]
fn a_task_that_a_team_does_not_have_is_not_explained() {
    let folder = Folder::new("team_not_explained");
    for (line, said) in [
        ("explain service serv", "did you mean `serve`?"),
        ("explain service A1", "its tasks: order, serve"),
        ("explain service serve --steps 9", "--steps is for missions"),
        ("explain service serve --candidate x", "--candidate is for missions"),
    ] {
        let ended = folder.cotama(&line.split(' ').collect::<Vec<_>>());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{line}");
        assert!(ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
}
