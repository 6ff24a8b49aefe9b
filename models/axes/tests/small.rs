//! Small missions, each for one kind of constraint, counted by hand.

use super::{problem, table};
use cotama_axes::{Case, Infeasible, Lifted, Reason, Steps};
use std::fmt::Write;

/// A walk of 10 m in two halves, and a look at its end. Moving costs 1 or 3 a metre, and 4 or 1
/// noise; looking costs 5 or 2.
pub(crate) const WALK: &str = r#"format = "cotama-axes/1"
name = "walk"
path_length_mm = 10000
ask = [["min", "work.cost"]]
[robot]
speed_max_mm_s = 500
speed_step_mm_s = 100
[motion_power]
c0 = 1000
c1 = 0
c2 = 0
[detection]
detect_by = "option"
[hardware.bumper]
units = 1
detect_ms = 10
[[tio]]
id = "M1"
task = "MOV"
needs = { bumper = 1 }
cost = 1
noise = 4
[[tio]]
id = "M2"
task = "MOV"
needs = { bumper = 1 }
cost = 3
noise = 1
[[tio]]
id = "D1"
task = "DET"
cost = 5
stand_ms = 1000
[[tio]]
id = "D2"
task = "DET"
cost = 2
stand_ms = 9000
[[objective]]
id = "go"
x_start_mm = 0
x_end_mm = 10000
tasks = ["MOV"]
[[objective]]
id = "look"
x_start_mm = 10000
x_end_mm = 10000
tasks = ["DET"]
[[zone]]
id = "near"
x_start_mm = 0
x_end_mm = 5000
[[axis]]
id = "work"
[[axis.indicator]]
id = "cost"
unit = "coins"
combine = "sum"
travel = "div_up(option(cost) * length_mm, 1000)"
stand = "option(cost)"
[[axis.indicator]]
id = "time"
unit = "ms"
combine = "sum"
travel = "duration_ms"
stand = "duration_ms"
[[axis]]
id = "noise"
[[axis.indicator]]
id = "level"
unit = "dB"
combine = "each"
travel = "option(noise) * div_down(speed_mm_s, 100)"
"#;

/// A constraint: id, indicator, kind, operator, goal, and another goal in the near half.
type Limit = (&'static str, &'static str, &'static str, &'static str, i64, Option<i64>);

/// The walk with constraints.
fn walk(constraints: &[Limit]) -> Case {
    let mut text = WALK.to_owned();
    for (id, indicator, kind, op, goal, near) in constraints {
        let _ = write!(
            text,
            "[[constraint]]\nid = \"{id}\"\nindicator = \"{indicator}\"\nkind = \"{kind}\"\n\
             op = \"{op}\"\ngoal = {goal}\n"
        );
        if let Some(near) = near {
            let _ = writeln!(text, "at = [{{ zone = \"near\", goal = {near} }}]");
        }
    }
    Case::parse(&text).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// How many plans there are, and the options and the sums of cost and time of the best.
fn solved(case: &Case) -> (u128, Option<(String, [i64; 2])>) {
    let table = table(case, Lifted::default());
    let problem = problem(case, &table);
    let steps = &mut Steps::default();
    let plan = problem.best(&case.ask, steps).unwrap().map(|plan| {
        let rows = table.activities.iter().zip(&plan.choices);
        let label = rows
            .map(|(it, &choice)| cotama_axes::label(&case.mission, &it.candidates[choice].options));
        (label.collect::<Vec<_>>().join(" "), [plan.totals[0], plan.totals[1]])
    });
    (problem.count(steps).unwrap().unwrap(), plan)
}

fn infeasible(case: &Case) -> Infeasible {
    let table = table(case, Lifted::default());
    Infeasible::of(&case.mission, &table, &mut Steps::default()).unwrap()
}

fn plan(label: &str, sums: [i64; 2]) -> (String, [i64; 2]) {
    (label.to_owned(), sums)
}

#[test]
fn without_constraints_the_cheapest_of_eight_plans_is_taken() {
    assert_eq!(solved(&walk(&[])), (8, Some(plan("M1 M1 D2", [12, 29_000]))));
}

#[test]
fn a_core_constraint_bounds_speeds_by_place() {
    // Level 4 a step of 100 mm/s with M1: 5 steps make 20. M2 makes 5.
    let case = walk(&[("loud", "noise.level", "core", "<", 20, Some(12))]);
    let table = table(&case, Lifted::default());
    let speeds = table.activities.iter().map(|it| {
        it.candidates.iter().map(|it| (it.speed_mm_s, it.bounded_by.len())).collect::<Vec<_>>()
    });
    let stands = vec![(0, 0), (0, 0)];
    assert_eq!(
        speeds.collect::<Vec<_>>(),
        [vec![(200, 1), (500, 0)], vec![(400, 1), (500, 0)], stands]
    );
    assert_eq!(solved(&case), (8, Some(plan("M1 M1 D2", [12, 46_500]))));
}

#[test]
fn an_equality_can_leave_one_plan_of_eight() {
    assert_eq!(
        solved(&walk(&[("sum", "work.cost", "end", "=", 32, None)])),
        (1, Some(plan("M2 M2 D2", [32, 29_000])))
    );
    // Sums are 12, 15, 22, 25, 32, 35.
    let found = infeasible(&walk(&[("sum", "work.cost", "end", "=", 20, None)]));
    assert_eq!(found.single[0].needed, [Some(15), Some(22)]);
    assert_eq!((found.blame, found.single[0].nearest(20)), (Some(0), Some(22)));
}

#[test]
fn a_running_constraint_looks_at_sums_on_the_way() {
    // So much must be paid in the near half that M2 goes there.
    let early = ("early", "work.cost", "running", ">=", 0, Some(11));
    assert_eq!(solved(&walk(&[early])), (4, Some(plan("M2 M1 D2", [22, 29_000]))));
    let late = ("late", "work.cost", "running", "<=", 24, Some(14));
    let found = infeasible(&walk(&[early, late]));
    assert_eq!(found.corrections.len(), 2);
    let single: Vec<_> = found.single.iter().map(|it| (it.constraint, it.needed)).collect();
    assert_eq!((single, found.blame), (vec![(0, [None; 2]), (1, [None; 2])], Some(0)));
}

#[test]
fn two_limits_may_have_to_give_way_together() {
    let cheap = ("cheap", "work.cost", "end", "<", 12, None);
    let dear = ("dear", "work.cost", "end", ">=", 30, None);
    let quick = ("quick", "work.time", "end", "<=", 20_000, None);
    // Cheap and dear exclude each other, and nothing is as cheap.
    let found = infeasible(&walk(&[cheap, dear, quick]));
    let sets: Vec<_> = found.corrections.iter().map(|it| it.iter().collect::<Vec<_>>()).collect();
    assert_eq!((sets, found.blame), (vec![vec![0, 2]], None));
    // Alone, each says how far it is off: 12 coins are 13 - 1.
    let found = infeasible(&walk(&[cheap]));
    assert_eq!(found.single[0].needed, [None, Some(13)]);
}

#[test]
fn the_least_change_against_the_goal_is_blamed() {
    // The quick look costs 15 at least, and the cheap one takes 29 s.
    let cheap = ("cheap", "work.cost", "end", "<=", 12, None);
    let quick = ("quick", "work.time", "end", "<=", 28_000, None);
    let found = infeasible(&walk(&[cheap, quick]));
    let needed: Vec<_> = found.single.iter().map(|it| it.needed[1]).collect();
    assert_eq!((needed, found.blame), (vec![Some(15), Some(29_000)], Some(1)));
}

#[test]
fn an_activity_without_candidates_says_what_removed_them() {
    let case =
        Case::parse(&WALK.replace("x_end_mm = 5000\n", "x_end_mm = 5000\nblind = [\"bumper\"]\n"));
    let case = case.unwrap();
    assert_eq!(solved(&case), (0, None));
    let found = infeasible(&case);
    assert_eq!((found.corrections.len(), found.blame), (0, None));
    assert_eq!(found.empty, [(0, vec![Reason::Blind])]);
    let silent = walk(&[("loud", "noise.level", "core", "<", 1, None)]);
    let found = infeasible(&silent);
    let by = vec![Reason::Core(0)];
    assert_eq!(found.empty, [(0, by.clone()), (1, by)]);
    assert_eq!((found.blame, found.single[0].nearest(1)), (Some(0), None));
}
