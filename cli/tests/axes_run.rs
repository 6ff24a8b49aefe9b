//! `cotama run` of missions with axes.

use crate::common::Folder;
use serde_json::json;

/// The shipped mission with one edit.
fn edited(from: &str, to: &str) -> String {
    let text = cotama_axes::PATROL;
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn the_patrol_that_loses_its_lasers_goes_on_at_the_speeds_of_sonars() {
    let folder = Folder::new("axes_run");
    let answer = folder.cotama(&["run", "patrol-axes", "--json"]).json(0);
    assert_eq!((&answer["outcome"], &answer["x_mm"]), (&json!("completed"), &json!(187_000)));
    let plans = answer["plans"].as_array().unwrap();
    let causes: Vec<_> = plans.iter().map(|it| (&it["x_mm"], &it["cause"])).collect();
    assert_eq!(causes, [(&json!(0), &json!("start")), (&json!(130_000), &json!("laser lost"))]);
    let row = json!({
        "objective": "O9", "x_start_mm": 130_000, "options": "M1 L1", "speed_mm_s": 330,
    });
    assert_eq!(plans[1]["choices"][0], row);
    let quiet = folder.cotama(&["run", "patrol-axes", "--faults", "none", "--json"]).json(0);
    assert_eq!(quiet["plans"].as_array().unwrap().len(), 1);
    let screen = folder.cotama(&["run", "patrol-axes"]).stdout;
    assert!(screen.contains("plan at 130 m, 345.1 s: laser lost"), "{screen}");
}

#[test]
fn a_robot_whose_return_is_kept_turns_round_before_it_is_stranded() {
    let folder = Folder::new("axes_run_home");
    let waits = "kind = \"costs\"\ncosts = { \"energy.RC\" = 2_400_000, \"energy.LC\" = 900_000 }";
    let text = edited(
        "x_mm = 130000\nkind = \"fault\"\nhardware = \"laser\"\nunits_lost = 2",
        &format!("x_mm = 70000\n{waits}"),
    );
    let withstands = "costs = { \"energy.RC\" = 2_400_000, \"energy.LC\" = 900_000 }\nlosses";
    let text = text.replacen("losses", withstands, 1);
    folder.write("kept.toml", &text);
    folder.write(
        "free.toml",
        text.replacen("\"guaranteed\"", "\"none\"", 1).split("[run.withstands]").next().unwrap(),
    );
    let home = folder.cotama(&["run", "kept.toml", "--json"]).json(1);
    assert_eq!((&home["outcome"], &home["x_mm"]), (&json!("returned"), &json!(0)));
    assert_eq!(home["turned"]["x_mm"], 93_500);
    let lost = folder.cotama(&["run", "free.toml", "--json"]).json(1);
    assert_eq!((&lost["outcome"], &lost["x_mm"]), (&json!("stopped"), &json!(109_363)));
}

#[test]
fn mistakes_in_what_happens_are_messages_at_their_place() {
    let folder = Folder::new("axes_run_mistakes");
    for (from, to, message) in [
        ("return = \"guaranteed\"", "return = \"sure\"", "unknown return `sure`"),
        ("return = \"guaranteed\"", "", "`withstands` speaks of a return that is not asked for"),
        ("kind = \"fault\"", "kind = \"falt\"", "unknown kind of an event `falt`"),
        ("hardware = \"laser\"", "hardware = \"lasr\"", "unknown hardware `lasr`"),
        ("units_lost = 2", "units_lost = 3", "`units_lost` must be 1 to 2, not 3"),
        ("x_mm = 130000", "x_mm = 190000", "`x_mm` must be 0 to 187000, not 190000"),
        ("permille = 50", "permille = -1001", "`permille` must be -1000 to 10000, not -1001"),
        (
            "indicator = \"energy.RC\"\nzone",
            "indicator = \"safety.impact\"\nzone",
            "does not add up",
        ),
        ("losses = { laser", "losses = { lasers", "unknown hardware `lasers`"),
        ("error_permille = {", "error_permile = {", "unknown key `error_permile`"),
    ] {
        folder.write("mine.toml", edited(from, to));
        let said = folder.cotama(&["run", "mine.toml"]);
        assert_eq!(said.code, Some(2), "{to}");
        assert!(said.stderr.contains(message), "{to}\n{}", said.stderr);
    }
    let said = folder.cotama(&["run", "patrol-axes", "--seed", "3"]);
    assert!(said.code == Some(2) && said.stderr.contains("--seed: a mission with axes"));
}
