//! `cotama assign`: who does what. Answers are added again here, from the JSON of the instance and
//! of the answer alone.

use crate::common::{Ended, Folder, golden};
use crate::schemas::validate;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The instances of a folder of the models, sorted.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/teams").join(folder);
    let paths = std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
    let mut files: Vec<_> =
        paths.filter(|it| it.extension().is_some_and(|it| it == "json")).collect();
    files.sort();
    files
}

fn assign(folder: &Folder, file: &Path, arguments: &[&str]) -> Ended {
    let name = file.file_name().unwrap().to_str().unwrap();
    folder.write(name, std::fs::read(file).unwrap());
    folder.cotama(&[&["assign", name], arguments].concat())
}

fn list(of: &Value) -> &[Value] {
    of.as_array().unwrap()
}

/// The place of a name among the objects, or the texts, of a list.
fn place(all: &Value, name: &Value) -> usize {
    list(all).iter().position(|it| it == name || it.get("name") == Some(name)).unwrap()
}

/// The costs of the roles of a plan, in units.
struct Roles<'v>(Vec<&'v Value>);

impl Roles<'_> {
    fn of<'v>(task: &'v Value, plan: &Value) -> (Roles<'v>, u64) {
        if plan.is_null() {
            return (Roles(vec![&task["cost"]]), 0);
        }
        let plan = &task["plans"][place(&task["plans"], plan)];
        let roles = list(&plan["roles"]).iter().map(|it| &it["cost"]);
        (Roles(roles.collect()), plan["extra_cost"].as_u64().unwrap_or(0))
    }

    fn cost(&self, role: usize, robot: usize) -> Option<u64> {
        self.0[role][robot].as_u64()
    }

    /// In parts.
    fn joint(&self, task: &Value, parts: u64, extra: u64, costs: &[u64]) -> u64 {
        let sum: u64 = costs.iter().sum();
        let joint = match task["combine"].as_str() {
            Some("mean") => sum * (parts / self.0.len() as u64),
            Some("max") => parts * costs.iter().max().unwrap(),
            _ => sum * parts,
        };
        joint + parts * extra
    }

    /// No way to fill the roles costs less, at these prices: in units, of the sum.
    fn least_at(&self, prices: &[u64]) -> u64 {
        let pays = |role: usize| {
            let costs = prices.iter().enumerate();
            costs.filter_map(|(robot, price)| Some(self.cost(role, robot)? + price)).min().unwrap()
        };
        (0..self.0.len()).map(pays).sum::<u64>() - prices.iter().sum::<u64>()
    }
}

/// Adds up the cost of the assignment again.
fn added(instance: &Value, answer: &Value) -> u64 {
    let parts = instance["cost_denominator"].as_u64().unwrap();
    let mut taken = vec![false; list(&instance["robots"]).len()];
    let mut done = list(&answer["assignment"]).iter().peekable();
    let mut sum = 0;
    for task in list(&instance["tasks"]) {
        let Some(own) = done.next_if(|it| it["task"] == task["name"]) else {
            sum += parts * task["skip_cost"].as_u64().expect("it must be done");
            continue;
        };
        let (roles, extra) = Roles::of(task, &own["plan"]);
        assert_eq!(roles.0.len(), list(&own["robots"]).len());
        let costs = list(&own["robots"]).iter().enumerate().map(|(role, robot)| {
            let robot = place(&instance["robots"], robot);
            assert!(!std::mem::replace(&mut taken[robot], true), "a robot twice");
            roles.cost(role, robot).expect("it is capable")
        });
        let cost = roles.joint(task, parts, extra, &costs.collect::<Vec<_>>());
        assert_eq!(own["cost"], json!(cost));
        sum += cost;
    }
    assert!(done.next().is_none());
    sum
}

/// More of these roles than robots that cost less in one of them than the limit.
fn in_conflict(instance: &Value, roles: &Roles<'_>, own: &[usize], few: &Value, limit: u64) {
    assert!(own.len() > list(few).len(), "{few}");
    for (robot, name) in list(&instance["robots"]).iter().enumerate() {
        if !list(few).contains(name) {
            let able = |role: &usize| roles.cost(*role, robot).is_some_and(|it| it < limit);
            assert!(!own.iter().any(able), "{name}");
        }
    }
}

/// The certificate of an answer, added again; of a search nothing can be.
fn certified(instance: &Value, answer: &Value) {
    let parts = instance["cost_denominator"].as_u64().unwrap();
    let tasks = list(&instance["tasks"]);
    let certificate = &answer["certificate"];
    let prices =
        |of: &Value| -> Vec<u64> { list(of).iter().map(|it| it.as_u64().unwrap()).collect() };
    match certificate["by"].as_str().unwrap() {
        "prices" => {
            let prices = prices(&certificate["robot_prices"]);
            let pays = |task: &Value| {
                let costs = list(&task["cost"]).iter().zip(&prices);
                let costs = costs.filter_map(|(cost, price)| Some(cost.as_u64()? + price));
                costs.chain(task["skip_cost"].as_u64()).min().unwrap()
            };
            let least = tasks.iter().map(pays).sum::<u64>() - prices.iter().sum::<u64>();
            assert_eq!(answer["cost"], json!(parts * least));
        }
        "hall" => {
            let all = list(&answer["why_infeasible"]["tasks"]);
            let all = all.iter().map(|it| place(&instance["tasks"], it));
            let all: Vec<_> =
                all.inspect(|it| assert!(tasks[*it]["skip_cost"].is_null())).collect();
            let roles = Roles(tasks.iter().map(|it| &it["cost"]).collect());
            in_conflict(instance, &roles, &all, &answer["why_infeasible"]["robots"], u64::MAX);
        }
        "plans" => {
            let [task] = tasks else { panic!("one task") };
            let mut least = task["skip_cost"].as_u64().map(|it| it * parts);
            for (row, plan) in list(&certificate["plans"]).iter().zip(list(&task["plans"])) {
                assert_eq!(row["plan"], plan["name"]);
                let (roles, extra) = Roles::of(task, &row["plan"]);
                let own = || -> Vec<_> {
                    list(&row["roles"]).iter().map(|it| place(&plan["roles"], it)).collect()
                };
                if let Some(cost) = row["cost"].as_u64() {
                    let joint = if let Some(limit) = row["threshold"].as_u64() {
                        in_conflict(instance, &roles, &own(), &row["robots"], limit);
                        parts * limit
                    } else {
                        let sum = roles.least_at(&prices(&row["robot_prices"]));
                        sum * (parts / roles.0.len() as u64)
                    };
                    assert_eq!(joint + parts * extra, cost);
                    least = Some(least.map_or(cost, |it| it.min(cost)));
                } else {
                    in_conflict(instance, &roles, &own(), &row["robots"], u64::MAX);
                }
            }
            assert_eq!(answer["cost"], json!(least));
        }
        other => assert_eq!((other, &instance["kind"]), ("search", &json!("simultaneous"))),
    }
}

#[test]
fn all_instances_have_the_proven_answer() {
    let folder = Folder::new("assign_all");
    let files = files("");
    assert_eq!(files.len(), 12);
    for file in files {
        let instance: Value =
            serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let expected = &instance["expected"];
        let infeasible = expected["status"] == "infeasible";
        let answer = assign(&folder, &file, &["--json"]).json(i32::from(infeasible));
        for field in ["name", "status", "cost"] {
            let wanted = if field == "name" { &instance[field] } else { &expected[field] };
            assert_eq!(&answer[field], wanted, "{}: {field}", file.display());
        }
        if infeasible {
            assert_eq!(answer["assignment"], json!([]));
            assert!(!list(&answer["why_infeasible"]["tasks"]).is_empty());
        } else {
            assert_eq!(json!(added(&instance, &answer)), answer["cost"]);
            assert_eq!(answer["lower_bound"], answer["cost"]);
        }
        certified(&instance, &answer);
        let again = assign(&folder, &file, &["--json"]).json(i32::from(infeasible));
        assert_eq!(answer, again, "the same input gives the same bytes");
    }
}

#[test]
fn the_screens_show_assignment_and_bound() {
    let folder = Folder::new("assign_screens");
    let mut screens = String::new();
    for file in files("") {
        screens += &assign(&folder, &file, &["--greedy"]).stdout;
        screens.push('\n');
    }
    golden("assign.txt", &screens);
    let narrow = folder.shell("COLUMNS=50 cotama assign 07*.json").stdout;
    golden("assign_narrow.txt", &narrow);
    assert!(narrow.lines().all(|it| it.chars().count() <= 50), "{narrow}");
}

#[test]
fn broken_instances_are_refused_with_their_place() {
    let folder = Folder::new("assign_broken");
    let files = files("broken");
    assert_eq!(files.len(), 8);
    let mut said = String::new();
    for file in files {
        let ended = assign(&folder, &file, &[]);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
        said += &ended.stderr;
        said.push('\n');
        let error = assign(&folder, &file, &["--json"]).json(2);
        assert!(error["line"].is_u64() && error["column"].is_u64(), "{error}");
    }
    golden("bad_assign.txt", &said);
}

#[test]
fn files_of_other_kinds_lead_to_their_command() {
    let folder = Folder::new("assign_kinds");
    folder
        .write("plan.json", r#"{"limits": {"duration_ms": 1, "energy_mj": 1}, "activities": []}"#);
    let said = folder.cotama(&["assign", "plan.json"]);
    assert!(said.code == Some(2) && said.stderr.contains("try `cotama allocate plan.json`"));
    assign(&folder, &files("")[0], &[]);
    let said = folder.cotama(&["allocate", "01-single-three-by-three.json"]);
    assert!(said.code == Some(2) && said.stderr.contains("try `cotama assign 01-"), "{said:?}");
}

#[test]
fn few_steps_leave_a_bound_and_a_remedy() {
    let folder = Folder::new("assign_steps");
    let mixed = &files("")[11];
    let answer = assign(&folder, mixed, &["--json", "--steps", "500"]).json(3);
    assert_eq!(answer["status"], "unknown");
    let bound = answer["lower_bound"].as_u64().unwrap();
    assert!(0 < bound && bound <= 525, "{answer}");
    let screen = assign(&folder, mixed, &["--steps", "500"]);
    assert_eq!(screen.code, Some(3));
    assert!(screen.stdout.contains("no assignment costs less than"), "{}", screen.stdout);
    assert!(screen.stdout.contains("--steps 5000"), "{}", screen.stdout);
}

#[test]
fn greedy_rounds_are_told_where_that_is_asked() {
    let folder = Folder::new("assign_greedy");
    let trap = assign(&folder, &files("")[9], &["--greedy", "--json"]).json(0);
    assert_eq!(trap["greedy"], json!({ "cost": 36, "unserved": 0, "rounds": 3 }));
    let indispensable = assign(&folder, &files("")[10], &["--greedy", "--json"]).json(0);
    assert_eq!(indispensable["greedy"]["unserved"], 1);
    let plain = assign(&folder, &files("")[9], &["--json"]).json(0);
    assert_eq!(plain["greedy"], Value::Null);
}

/// Tables 3.1 and 3.2, Fig. 3.4, 3.5 and 3.8 of the thesis.
#[test]
fn curves_are_counted_shown_and_drawn() {
    let folder = Folder::new("assign_curves");
    let shown = folder.cotama(&["assign", "--curves", "8", "--report", "curves"]);
    golden("assign_curves.txt", &shown.stdout);
    let page = folder.read("curves/index.html");
    assert!(page.contains("Fig. 3.8: work by the number of capable robots"));
    let answer = folder.cotama(&["assign", "--json", "--curves", "8"]).json(0);
    validate("assign-curves", &answer);
    let four = &answer["growth"][2];
    assert_eq!((&four["robots"], &four["coalitions"]), (&json!(4), &json!(15)));
    assert_eq!(four["messages"], json!({ "singles": 16, "central": 28, "distributed": 60 }));
    let rows = list(&answer["benchmark"]);
    assert_eq!(rows.len(), (3..=9).sum::<usize>());
    let half = rows.iter().find(|it| it["robots"] == 8 && it["capable"] == 4).unwrap();
    assert_eq!((&half["capable_steps"], &half["busiest_steps"]), (&json!(224), &json!(72)));
    let passed: Vec<_> = list(&half["conditions"]).iter().map(|it| &it["passed"]).collect();
    assert_eq!(passed, [249, 240, 15]);
}

#[test]
fn curves_take_no_instance_and_a_report_only_curves() {
    let folder = Folder::new("assign_curves_refused");
    for (line, said) in [
        ("assign", "<INSTANCE>"),
        ("assign --curves 17", "from 2 to 16"),
        ("assign --curves 1", "from 2 to 16"),
        ("assign --curves 4 --greedy", "--greedy"),
        ("assign service --curves", "--curves"),
        ("assign service --report out", "--curves"),
        ("assign --curves 4 --report none/out", "mkdir -p none"),
    ] {
        let ended = folder.cotama(&line.split(' ').collect::<Vec<_>>());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{line}");
        assert!(ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
    assert!(folder.files(".").is_empty(), "nothing is written");
}
