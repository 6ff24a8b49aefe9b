//! `cotama plan` of a mission with performance axes of its own: the patrol of Lambert et al. 2024
//! with five limits, whose optima the tests of `cotama-axes` tell.

use crate::common::{Folder, golden};
use serde_json::json;

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
    assert!(shown.ends_with(&lines.concat()), "{shown}");
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
fn options_of_other_missions_are_refused() {
    let folder = Folder::new("axes_options");
    folder.write("patrol.toml", PATROL);
    let error = folder.cotama(&["plan", "patrol.toml", "--lost", "laser", "--json"]).json(2);
    assert_eq!(error["message"], "--lost: a mission with axes says all of this in its file");
    let error = folder.cotama(&["run", "patrol.toml", "--json"]).json(2);
    assert_eq!(error["help"], "try `cotama plan patrol.toml`");
}
