//! The patrol: Tables 4 to 6 of Lambert et al. 2024 as results, and its plans with five limits.
//! Optima and fronts agree with those that OR-Tools CP-SAT 9.15 and a dynamic programme of its own
//! found.

use super::{lifted, problem, table};
use cotama_axes::rule::{NotTreated, rule};
use cotama_axes::{
    Activity, Ask, Case, Infeasible, Kind, Lifted, PATROL, Plan, Problem, Sense, Steps, Table,
    label,
};

const AXES: [&str; 5] =
    ["duration.MD", "energy.RC", "energy.LC", "localisation.located", "data.volume"];

fn patrol() -> Case {
    Case::parse(PATROL).unwrap()
}

/// The table under the core constraints that the paper prints.
fn published(case: &Case) -> Table {
    table(case, lifted(case, &["cpu", "error"]))
}

fn wish(case: &Case, name: &str) -> Ask {
    let sense = if name == "localisation.located" { Sense::Max } else { Sense::Min };
    Ask { sense, indicator: case.mission.indicator(name).unwrap() }
}

fn totals(case: &Case, plan: &Plan) -> [i64; 5] {
    AXES.map(|it| plan.totals[case.mission.indicator(it).unwrap()])
}

fn labels(case: &Case, table: &Table, choices: &[usize]) -> String {
    let rows = table.activities.iter().zip(choices);
    let label = |it: &[usize]| label(&case.mission, it);
    let all: Vec<_> = rows.map(|(it, &choice)| label(&it.candidates[choice].options)).collect();
    all.join(" | ")
}

fn paper_rule(case: &Case, table: &Table, order: &[&str]) -> Option<Vec<usize>> {
    let order: Vec<_> = order.iter().map(|it| case.mission.constraint(it).unwrap()).collect();
    rule(&case.mission, table, &order, case.mission.indicator("energy.RC").unwrap()).unwrap()
}

/// Borders, candidates before and after constraints, and speeds of Table 5.
pub(crate) const SPEEDS: [i64; 17] =
    [410, 330, 330, 0, 0, 0, 330, 410, 560, 410, 0, 0, 0, 560, 410, 330, 410];

#[test]
fn table_5_follows_from_zones_and_core_constraints() {
    let case = patrol();
    let table = published(&case);
    let starts: Vec<_> = table.activities.iter().map(|it| it.x_start_mm / 500).collect();
    let borders = [0, 62, 68, 74, 74, 74, 74, 82, 127, 183, 187, 187, 187, 187, 247, 292, 312];
    assert_eq!(starts, borders);
    assert_eq!(table.activities.last().unwrap().x_end_mm, 187_000);
    let before: Vec<_> = table.activities.iter().map(Activity::before).collect();
    assert_eq!(before, [21, 21, 21, 3, 2, 3, 21, 21, 21, 21, 3, 2, 3, 21, 21, 21, 21]);
    let after: Vec<_> = table.activities.iter().map(|it| it.candidates.len()).collect();
    assert_eq!(after, [21, 12, 4, 3, 2, 3, 12, 21, 21, 4, 3, 2, 3, 21, 21, 12, 21]);
    let speeds: Vec<_> = table.activities.iter().map(Activity::speed_max_mm_s).collect();
    assert_eq!(speeds, SPEEDS);
    assert_eq!(table.combinations(), Some(768_288_795_144_192));
}

#[test]
fn objectives_are_those_of_table_4() {
    let case = patrol();
    let places = |it: &cotama_axes::Objective| (it.x_start_mm / 500, it.x_end_mm / 500);
    let objectives: Vec<_> = case.mission.objectives.iter().map(places).collect();
    let (first, second) = ((74, 74), (187, 187));
    assert_eq!(
        objectives,
        [(0, 74), first, first, first, (74, 187), second, second, second, (187, 374)]
    );
}

#[test]
fn the_rule_plans_as_table_6() {
    let case = patrol();
    let table = published(&case);
    let plan = paper_rule(&case, &table, &["duration", "energy"]).unwrap();
    let stop = "T1 L2 | D2 | T1 L2";
    let printed = format!(
        "M5 L2 | M5 L2 | M5 L2 | {stop} | M5 L2 | M5 L2 | M5 L2 | M5 L2 | {stop} | M5 L2 | M5 L2 \
         | M5 L2 | M3 L1"
    );
    assert_eq!(labels(&case, &table, &plan), printed);
    let sum = |name: &str| -> i64 {
        let indicator = case.mission.indicator(name).unwrap();
        let rows = table.activities.iter().zip(&plan);
        rows.map(|(it, &choice)| it.candidates[choice].value(indicator)).sum()
    };
    assert_eq!(AXES.map(sum), [527_924, 8_563_613, 9_530_467, 1_580, 593_915]);
}

#[test]
fn the_least_energy_within_both_printed_limits_is_known() {
    let case = patrol();
    let table = published(&case);
    let others = lifted(&case, &["cpu", "error", "laptop", "located", "data"]);
    let problem = Problem::new(&case.mission, &table, others);
    let plan = problem.best(&[wish(&case, "energy.RC")], &mut Steps::default()).unwrap().unwrap();
    assert_eq!(totals(&case, &plan)[1], 4_675_896);
}

/// By option, as Section 6.1.4 says, Table 5 stays and Table 6 does not.
#[test]
fn detection_by_option_changes_the_last_activity_of_table_6() {
    let case =
        Case::parse(&PATROL.replace("detect_by = \"zone\"", "detect_by = \"option\"")).unwrap();
    let table = published(&case);
    let speeds: Vec<_> = table.activities.iter().map(Activity::speed_max_mm_s).collect();
    assert_eq!(speeds, SPEEDS);
    let plan = paper_rule(&case, &table, &["duration", "energy"]).unwrap();
    assert!(labels(&case, &table, &plan).ends_with("M5 L2 | M5 L2 | M5 L2 | M1 L1"));
    let of = |activity: usize| {
        let shown = ["M1 L1", "M1 L2", "M3 L1", "M5 L1"];
        let row = |it: &cotama_axes::Candidate| (label(&case.mission, &it.options), it.speed_mm_s);
        let rows = table.activities[activity].candidates.iter().map(row);
        let rows: Vec<_> = rows.filter(|it| shown.contains(&&*it.0)).map(|it| it.1).collect();
        rows
    };
    assert_eq!([of(0), of(8)], [[330, 330, 410, 410], [490, 410, 560, 560]]);
    assert_eq!([of(1), of(2)], [vec![330, 330, 330], vec![330]]);
}

/// The requirement of QR codes before the valves follows from the position error.
#[test]
fn options_before_valves_follow_from_the_error() {
    let case = patrol();
    let bare = Case::parse(&PATROL.replace("require_tio = \"L2\"", "")).unwrap();
    let left = |case: &Case| {
        let lists = table(case, Lifted::default()).activities.into_iter();
        let names = |it: &cotama_axes::Candidate| label(&case.mission, &it.options);
        lists.map(|it| it.candidates.iter().map(names).collect()).collect::<Vec<Vec<_>>>()
    };
    assert_eq!(left(&bare), left(&case));
}

#[test]
fn five_limits_leave_fewer_candidates_each_for_a_reason() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let counts: Vec<_> = table.activities.iter().map(|it| it.candidates.len()).collect();
    assert_eq!(counts, [13, 11, 3, 3, 2, 3, 11, 20, 20, 3, 3, 2, 3, 13, 20, 11, 13]);
    assert_eq!(table.combinations(), Some(68_215_900_896_000));
    let dropped = table.activities.iter().flat_map(|it| &it.dropped).flat_map(|it| &it.by);
    let mut reasons: Vec<_> = dropped.map(|it| it.name(&case.mission)).collect();
    reasons.sort();
    let counted = reasons.chunk_by(|a, b| a == b).map(|it| (it[0].as_str(), it.len()));
    assert_eq!(
        counted.collect::<Vec<_>>(),
        [
            ("blind", 36),
            ("cpu", 11),
            ("error", 21),
            ("valve1-approach.require_tio", 14),
            ("valve2-approach.require_hardware", 9),
            ("valve2-approach.require_tio", 14),
        ]
    );
}

/// Least and most of each sum without limits, and its best and its nearest to the goal within all.
#[test]
fn sums_of_five_axes_reach_so_far() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let every = (0..case.mission.constraints.len()).fold(Lifted::default(), Lifted::with);
    let free = Problem::new(&case.mission, &table, every);
    let within = problem(&case, &table);
    let reach = |problem: &Problem<'_>, name: &str, sense| {
        let indicator = case.mission.indicator(name).unwrap();
        let plan = problem.best(&[Ask { sense, indicator }], &mut Steps::default());
        plan.unwrap().unwrap().totals[indicator]
    };
    let rows = AXES.map(|name| {
        let [least, most] = [Sense::Min, Sense::Max].map(|it| reach(&free, name, it));
        let [low, high] = [Sense::Min, Sense::Max].map(|it| reach(&within, name, it));
        [least, most, low, high]
    });
    assert_eq!(
        rows,
        [
            [490_031, 527_924, 490_031, 527_924],
            [5_310_748, 9_176_054, 6_181_615, 8_241_191],
            [6_727_937, 10_037_810, 7_684_401, 9_000_000],
            [694, 1_890, 1_500, 1_722],
            [81_460, 683_740, 248_159, 450_000],
        ]
    );
}

#[test]
fn optima_of_five_axes_are_the_proven_ones() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let order = |names: [&str; 5]| names.map(|it| wish(&case, it));
    let [duration, robot, laptop, located, data] = AXES;
    let least_energy = order([robot, located, laptop, data, duration]);
    assert_eq!(case.ask, least_energy);
    let most_located = order([located, robot, laptop, data, duration]);
    let mut most_energy = order([robot, laptop, located, data, duration]);
    most_energy[0].sense = Sense::Max;
    for (ask, expected) in [
        (least_energy, [490_031, 6_181_615, 7_765_567, 1_503, 317_231]),
        (most_located, [527_924, 6_861_631, 8_688_529, 1_722, 449_574]),
        (most_energy, [509_631, 8_241_191, 8_999_065, 1_513, 448_940]),
    ] {
        let plan = problem(&case, &table).best(&ask, &mut Steps::default()).unwrap().unwrap();
        assert_eq!(totals(&case, &plan), expected);
    }
}

#[test]
fn fronts_of_chosen_axes_are_the_proven_ones() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let problem = problem(&case, &table);
    let front = |names: &[&str]| {
        let ask: Vec<_> = names.iter().map(|it| wish(&case, it)).collect();
        problem.front(&ask, &mut Steps::default()).unwrap()
    };
    let values = |names: &[&str]| -> Vec<Vec<i64>> {
        front(names).into_iter().map(|it| it.values).collect()
    };
    let [duration, robot, laptop, located, data] = AXES;
    assert_eq!(values(&[duration, robot]), [[490_031, 6_181_615]]);
    assert_eq!(values(&[duration, laptop]), [[490_031, 7_684_401]]);
    assert_eq!(
        values(&[duration, located]),
        [[490_031, 1_710], [508_324, 1_715], [509_631, 1_721], [527_924, 1_722]]
    );
    assert_eq!(values(&[duration, data]), [[490_031, 248_806], [509_631, 248_159]]);
    assert_eq!(
        values(&[robot, laptop]),
        [
            [6_181_615, 7_765_567],
            [6_197_454, 7_729_972],
            [6_262_454, 7_707_972],
            [6_267_097, 7_706_401],
            [6_332_097, 7_684_401],
        ]
    );
    let sizes = [
        vec![robot, located],
        vec![robot, data],
        vec![laptop, located],
        vec![laptop, data],
        vec![located, data],
        vec![robot, located, data],
        vec![robot, laptop, located],
        AXES.to_vec(),
    ]
    .map(|it| front(&it).len());
    assert_eq!(sizes, [41, 8, 36, 41, 85, 408, 171, 2_641]);
    // Each plan has the sums that it stands for.
    for point in front(&AXES) {
        assert_eq!(totals(&case, &point.plan)[..], point.values[..]);
    }
}

fn orders(names: &[&'static str]) -> Vec<Vec<&'static str>> {
    if names.is_empty() {
        return vec![Vec::new()];
    }
    let begun = |first: &&'static str| {
        let rest: Vec<_> = names.iter().copied().filter(|it| it != first).collect();
        orders(&rest).into_iter().map(|it| [vec![*first], it].concat()).collect::<Vec<_>>()
    };
    names.iter().flat_map(begun).collect()
}

#[test]
fn the_rule_finds_a_plan_in_40_of_120_orders() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let orders = orders(&["duration", "energy", "located", "laptop", "data"]);
    let found: Vec<_> =
        orders.iter().filter(|it| paper_rule(&case, &table, it).is_some()).collect();
    assert_eq!((found.len(), orders.len()), (40, 120));
    assert!(found.contains(&&vec!["duration", "energy", "located", "laptop", "data"]));
    assert!(!found.contains(&&vec!["duration", "energy", "laptop", "located", "data"]));
    // The file has them in the first of these orders.
    let ends = case.mission.constraints.iter().filter(|it| it.kind == Kind::End);
    let ends: Vec<_> = ends.map(|it| it.id.as_str()).collect();
    let plan = paper_rule(&case, &table, &ends).unwrap();
    assert_eq!(
        labels(&case, &table, &plan),
        "M5 L2 | M1 L3 | M1 L2 | T1 L1 | D1 | T1 L1 | M1 L1 | M1 L3 | M1 L2 | M1 L2 | T1 L2 | D1 \
         | T1 L2 | M1 L2 | M1 L2 | M1 L2 | M3 L3"
    );
    let core = case.mission.constraint("cpu").unwrap();
    assert_eq!(rule(&case.mission, &table, &[core], 0), Err(NotTreated { constraint: core }));
}

#[test]
fn a_goal_out_of_reach_is_blamed_with_the_nearest_that_suffices() {
    for (from, to, constraint, needed) in [
        ("goal = 9000000", "goal = 7000000", "laptop", 7_684_401),
        ("goal = 1500 ", "goal = 1800 ", "located", 1_722),
        ("goal = 450000", "goal = 90000", "data", 248_159),
    ] {
        assert_eq!(PATROL.matches(from).count(), 1, "{from}");
        let case = Case::parse(&PATROL.replace(from, to)).unwrap();
        let table = table(&case, Lifted::default());
        let mut steps = Steps::default();
        assert_eq!(problem(&case, &table).best(&case.ask, &mut steps), Ok(None));
        let found = Infeasible::of(&case.mission, &table, &mut steps).unwrap();
        let number = case.mission.constraint(constraint).unwrap();
        let it = found.single.iter().find(|it| it.constraint == number).unwrap();
        let goal = case.mission.constraints[number].goal;
        assert_eq!(it.nearest(goal), Some(needed), "{constraint}");
    }
}

#[test]
fn a_search_without_steps_says_so() {
    let case = patrol();
    let table = table(&case, Lifted::default());
    let few = &mut Steps::new(1_000);
    assert_eq!(problem(&case, &table).best(&case.ask, few), Err(cotama_axes::Stop::Limit));
}
