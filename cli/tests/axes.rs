//! `cotama plan` of a mission with performance axes of its own: the patrol of Lambert et al. 2024
//! with five limits, whose optima the tests of `cotama-axes` tell.

use crate::common::{Folder, golden};
use serde_json::json;
use std::fmt::Write;

const PATROL: &str = include_str!("../../models/axes/missions/patrol.toml");

#[test]
fn a_mission_with_axes_is_planned_exactly() {
    let folder = Folder::new("axes_planned");
    folder.write("patrol.toml", PATROL);
    let answer = folder.cotama(&["plan", "patrol.toml", "--json"]).json(0);
    assert_eq!(answer["status"], "optimal");
    assert_eq!(answer["plan"][4], "D1");
    assert_eq!(answer["combinations"], "68215900896000");
    let totals: Vec<_> =
        answer["totals"].as_array().unwrap().iter().map(|it| &it["value"]).collect();
    assert_eq!(json!(totals), json!([1_503, 490_031, 6_181_615, 7_765_567, 317_231]));
    let bound = &answer["activities"][8]["bounded_by"][0];
    let said = ["constraint", "value", "value_next", "goal"].map(|it| &bound[it]);
    assert_eq!(json!(said), json!(["harmless", 3_920, 4_062, 4_000]));
    let mass = json!({ "name": "robot.mass_g", "value": 25_000, "of": "" });
    assert_eq!(bound["inducers"][1], mass);
    assert_eq!(answer["activities"][2]["dropped"][0]["by"], json!(["valve1-approach.require_tio"]));
}

#[test]
fn an_answer_for_people_shows_the_phases_of_the_paper() {
    let folder = Folder::new("axes_screen");
    folder.write("patrol.toml", PATROL);
    let shown = folder.cotama(&["plan", "patrol.toml"]);
    assert_eq!((shown.code, shown.stderr.as_str()), (Some(0), ""));
    golden("axes.txt", &shown.stdout);
}

#[test]
fn a_mission_without_a_plan_blames_a_constraint_or_names_several() {
    let folder = Folder::new("axes_infeasible");
    folder.write("data.toml", PATROL.replace("goal = 450000", "goal = 90000"));
    let ended = folder.cotama(&["plan", "data.toml", "--json"]);
    let answer = ended.json(1);
    let said = ["status", "blame", "needed", "correction"].map(|it| &answer[it]);
    assert_eq!(json!(said), json!(["infeasible", "located", 1_075, null]));
    let data = json!({ "constraint": "data", "needed": [248_159] });
    assert_eq!(answer["single"][1], data);
    let shown = folder.cotama(&["plan", "data.toml"]).stdout;
    let lines = [("located", 1_075), ("data", 248_159)].map(|(name, goal)| {
        format!("  without `{name}` there is a plan; a goal of {goal} suffices\n")
    });
    let end = lines.concat() + "\nnext: cotama explain data.toml\n";
    assert!(shown.ends_with(&end), "{shown}");
    let both = PATROL.replace("goal = 450000", "goal = 90000").replace("goal = 600000", "goal = 9");
    folder.write("both.toml", both);
    let answer = folder.cotama(&["plan", "both.toml", "--json"]).json(1);
    let said = ["status", "blame", "needed", "correction"].map(|it| &answer[it]);
    assert_eq!(json!(said), json!(["infeasible", null, null, ["duration", "located"]]));
    let shown = folder.cotama(&["plan", "both.toml"]).stdout;
    assert!(shown.contains("lifted together, these leave a plan: duration, located\n"), "{shown}");
}

#[test]
fn a_limit_of_the_search_is_the_answer_unknown() {
    let folder = Folder::new("axes_unknown");
    folder.write("patrol.toml", PATROL);
    let answer = folder.cotama(&["plan", "patrol.toml", "--steps", "1000", "--json"]).json(3);
    assert_eq!(answer["status"], "unknown");
}

#[test]
fn a_broken_mission_with_axes_is_refused_at_its_place() {
    let folder = Folder::new("axes_broken");
    folder.write("a.toml", PATROL.replace("option(cpu_permille)", "option(cpu_permille"));
    let error = folder.cotama(&["plan", "a.toml", "--json"]).json(2);
    let line = 1 + PATROL.lines().position(|it| it.contains("option(cpu_permille)")).unwrap();
    let column = "travel = { form = \"sum\", of = [\"option(cpu_permille".len() + 1;
    assert_eq!((&error["line"], &error["column"]), (&json!(line), &json!(column)), "{error}");
    assert_eq!(error["message"], "no formula: `)` is needed here");
    folder.write("a.json", "{\"format\": \"axes-case/1\", \"id\": \"a\"}");
    let error = folder.cotama(&["plan", "a.json", "--json"]).json(2);
    assert_eq!(error["message"], "`mission` is missing in the file");
}

#[test]
fn a_mission_with_axes_is_found_by_its_name() {
    let folder = Folder::new("axes_named");
    folder.write("patrol.toml", PATROL);
    let [named, read] = ["patrol-axes", "patrol.toml"].map(|it| folder.cotama(&["plan", it]));
    let renamed = read.stdout.replace("explain patrol.toml", "explain patrol-axes");
    assert_eq!((named.code, &named.stdout), (Some(0), &renamed));
    assert_eq!(folder.cotama(&["show", "patrol-axes"]).stdout, PATROL);
    let listed = folder.cotama(&["list", "--json"]).json(0);
    let missions = listed["missions"].as_array().unwrap();
    assert!(missions.iter().any(|it| it["name"] == "patrol-axes"), "{listed}");
    let error = folder.cotama(&["campaign", "patrol-axes", "--json"]).json(2);
    assert_eq!(
        error["message"],
        "`patrol-axes` is a mission with axes, and a plain one is needed here"
    );
    let error = folder.cotama(&["plan", "patrol-axis", "--json"]).json(2);
    assert!(error["message"].as_str().unwrap().ends_with("did you mean `patrol-axes`?"));
}

#[test]
fn a_begun_mission_with_axes_is_planned_and_explained_as_it_is() {
    let folder = Folder::new("axes_new");
    assert_eq!(folder.cotama(&["new", "axes", "tower"]).code, Some(0));
    let answer = folder.cotama(&["plan", "tower.toml", "--json"]).json(0);
    assert_eq!((&answer["mission"], &answer["status"]), (&json!("tower"), &json!("optimal")));
    let speeds = answer["activities"].as_array().unwrap().iter().map(|it| &it["speed_max_mm_s"]);
    assert_eq!(json!(speeds.collect::<Vec<_>>()), json!([470, 470, 470, 0, 470, 400]));
    let shown = folder.cotama(&["explain", "tower.toml", "A2"]).stdout;
    assert!(shown.contains("removed by blind: by-laser"), "{shown}");
}

/// A change of one number, as the answer has it.
fn change(name: &str, now: i64, needed: i64, speed: i64) -> serde_json::Value {
    json!({ "name": name, "now": now, "needed": needed, "speed_mm_s": speed })
}

#[test]
fn an_explanation_says_what_holds_a_speed_and_what_would_raise_it() {
    let folder = Folder::new("axes_explained");
    let explain = |activity: &str, candidate: &str| {
        let words = ["explain", "patrol-axes", activity, "--candidate", candidate, "--json"];
        let answer = folder.cotama(&words).json(0);
        let row = &answer["because"][0]["candidates"][0];
        assert_eq!(row["options"], candidate, "{answer}");
        let constraints = row["constraints"].as_array().unwrap();
        let binding: Vec<_> =
            constraints.iter().filter(|it| it["binds"] == true).cloned().collect();
        let names: Vec<_> = binding.iter().map(|it| it["constraint"].clone()).collect();
        let raises = &binding[0]["binding"]["raises"];
        (row["speed_mm_s"].clone(), json!(names), raises.as_array().unwrap().clone())
    };
    let (speed, by, raises) = explain("A9", "M5 L1");
    assert_eq!((speed, by), (json!(560), json!(["harmless"])));
    assert_eq!(
        raises,
        [change("robot.mass_g", 25_000, 24_616, 570), change("goal", 4_000, 4_063, 570)]
    );
    let (speed, by, raises) = explain("A9", "M5 L2");
    assert_eq!((speed, by), (json!(410), json!(["frames"])));
    assert_eq!(raises, [change("L2.frames", 1, 0, 560), change("goal", 14_000, 14_001, 420)]);
    let (speed, by, raises) = explain("A1", "M3 L2");
    assert_eq!((speed, by), (json!(410), json!(["avoidance", "frames"])));
    assert!(raises.iter().all(|it| it["speed_mm_s"] == 410), "both must give way: {raises:?}");
}

#[test]
fn explanations_for_people_are_of_an_activity_or_a_table_of_all() {
    let folder = Folder::new("axes_explained_screen");
    let mut all = String::new();
    for words in [
        &["explain", "patrol-axes"][..],
        &["explain", "patrol-axes", "A9"],
        &["explain", "patrol-axes", "A1", "--candidate", "L2 M3"],
        &["explain", "patrol-axes", "A2", "--candidate", "M3 L1"],
        &["explain", "patrol-axes", "A4"],
    ] {
        let shown = folder.cotama(words);
        assert_eq!((shown.code, shown.stderr.as_str()), (Some(0), ""));
        let _ = write!(all, "$ cotama {}\n{}", words.join(" "), shown.stdout);
    }
    golden("explain.txt", &all);
}

#[test]
fn an_unknown_activity_or_combination_leads_to_the_nearest() {
    let folder = Folder::new("axes_unexplained");
    let message = |words: &[&str]| {
        let words = [&["explain", "patrol-axes"], words, &["--json"]].concat();
        folder.cotama(&words).json(2)["message"].clone()
    };
    assert_eq!(message(&["A99"]), "the mission has no activity `A99`; did you mean `A9`?");
    assert_eq!(
        message(&["A9", "--candidate", "M5 L9"]),
        "A9 has no combination `M5 L9`; did you mean `M5 L1`?"
    );
    let error = folder.cotama(&["explain", "patrol", "--json"]).json(2);
    assert_eq!(error["message"], "`patrol` says its speeds itself, and has no axes");
    let few = folder.cotama(&["explain", "patrol-axes", "--steps", "60000", "--json"]).json(3);
    assert_eq!(few["limit_reached"], true);
}

#[test]
fn causes_and_effects_are_drawn_by_other_tools() {
    let folder = Folder::new("axes_causes");
    let export = |format: &str| folder.cotama(&["export", "patrol-axes", "--format", format]);
    golden("causes.dot", &export("dot").stdout);
    golden("causes.mmd", &export("mermaid").stdout);
    golden("causes.svg", &export("svg").stdout);
    let refused = export("pnml");
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--format dot|mermaid|svg"), "{refused:?}");
    let style = ["export", "patrol-axes", "--output", "a.dot", "--style", "net"];
    assert_eq!(folder.cotama(&style).code, Some(2));
}

#[test]
fn options_of_other_missions_are_refused() {
    let folder = Folder::new("axes_options");
    folder.write("patrol.toml", PATROL);
    let error = folder.cotama(&["plan", "patrol.toml", "--lost", "laser", "--json"]).json(2);
    assert_eq!(error["message"], "--lost: a mission with axes says all of this in its file");
    let error = folder.cotama(&["campaign", "patrol.toml", "--json"]).json(2);
    assert_eq!(error["help"], "try `cotama plan patrol.toml`");
}
