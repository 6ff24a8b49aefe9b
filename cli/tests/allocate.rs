//! `cotama allocate`: bare problems.

use crate::common::Folder;
use serde_json::{Value, json};

/// The paper's rule finds no plan here, in this order of the limits, but there is one.
const MISSED: &str = r#"{"limits": {"duration_ms": 6, "energy_mj": 3},
    "activities": [[[0,5,1],[2,1,2]], [[3,5,1],[0,1,10]]]}"#;

fn allocate(name: &str, instance: &str, arguments: &[&str], code: i32) -> Value {
    let folder = Folder::new(&format!("allocate_{name}"));
    folder.write("instance.json", instance);
    folder.cotama(&[&["allocate", "instance.json", "--json"], arguments].concat()).json(code)
}

#[test]
fn the_most_quality_is_found_and_proven() {
    let instance = r#"{"limits":{"duration_ms":10,"energy_mj":10},
        "activities":[[[5,6,6],[3,4,4]],[[5,6,6],[4,4,4]]]}"#;
    let answer = allocate("quality", instance, &["--objective", "quality"], 0);
    let expected = json!({ "schema": "cotama/allocate/\
        1", "status": "optimal", "quality": 9, "duration_ms": 10,
        "energy_mj": 10, "choice": [0, 1], "bound": 9, "steps": answer["steps"] });
    assert_eq!(answer, expected);
    let least = allocate("energy", instance, &["--objective", "min-energy"], 0);
    assert_eq!(
        (&least["choice"], &least["energy_mj"], &least["bound"]),
        (&json!([1, 1]), &json!(8), &json!(8))
    );
}

#[test]
fn a_plan_that_the_rule_misses_is_found_by_the_exact_allocator() {
    let exact = allocate("exact", MISSED, &[], 0);
    assert_eq!((&exact["status"], &exact["choice"]), (&json!("optimal"), &json!([1, 0])));
    let rule = allocate("rule", MISSED, &["--allocator", "panorama"], 1);
    assert_eq!((&rule["status"], &rule["choice"]), (&json!("infeasible"), &json!([])));
    assert!(
        rule["reason"]["text"].as_str().unwrap().contains("but a complete search does"),
        "{rule}"
    );
}

#[test]
fn the_rule_proves_nothing() {
    let instance =
        r#"{"limits":{"duration_ms":99,"energy_mj":99},"activities":[[[1,2,3],[9,1,1]]]}"#;
    let answer = allocate("feasible", instance, &["--allocator", "panorama"], 0);
    assert_eq!(
        (&answer["status"], &answer["choice"], &answer["bound"]),
        (&json!("feasible"), &json!([0]), &Value::Null)
    );
}

#[test]
fn infeasible_says_which_limit_and_by_how_much() {
    let instance = r#"{"limits":{"duration_ms":6,"energy_mj":2},
        "activities":[[[0,5,1],[2,1,2]],[[3,5,1],[0,1,10]]]}"#;
    for allocator in ["exact", "panorama"] {
        let answer =
            allocate(&format!("infeasible_{allocator}"), instance, &["--allocator", allocator], 1);
        let reason = &answer["reason"];
        assert_eq!((&answer["status"], &reason["axis"]), (&json!("infeasible"), &json!("energy")));
        assert_eq!(
            (&reason["limit"], &reason["least"], &reason["gap"]),
            (&json!(2), &json!(3), &json!(1))
        );
    }
}

#[test]
fn infeasible_names_no_limit_where_the_steps_ended_before_it_was_known() {
    let instance = r#"{"limits":{"duration_ms":6,"energy_mj":2},"activities":[[[0,5,3]]]}"#;
    let reason = |steps| allocate(steps, instance, &["--steps", steps], 1)["reason"].clone();
    assert_eq!((&reason("1")["axis"], &reason("1")["least"]), (&Value::Null, &Value::Null));
    let said = "no plan is within the limits; which of them cannot be met is \
                not known after 1 steps: use more `--steps`";
    assert_eq!(reason("1")["text"], json!(said));
    assert_eq!((&reason("99")["axis"], &reason("99")["least"]), (&json!("energy"), &json!(3)));
}

#[test]
fn the_largest_numbers_are_exact() {
    let instance = r#"{"limits":{"duration_ms":18446744073709551615,"energy_mj":8589934590},
        "activities":[[[4294967295,4294967295,4294967295]],[[4294967295,4294967295,4294967295]]]}"#;
    let answer = allocate("largest", instance, &[], 0);
    assert_eq!(
        (&answer["quality"], &answer["energy_mj"]),
        (&json!(8_589_934_590_u64), &json!(8_589_934_590_u64))
    );
}

#[test]
fn no_activity_is_a_plan_of_nothing() {
    let instance = r#"{"limits":{"duration_ms":0,"energy_mj":0},"activities":[]}"#;
    let answer = allocate("nothing", instance, &[], 0);
    assert_eq!((&answer["choice"], &answer["quality"]), (&json!([]), &json!(0)));
}
