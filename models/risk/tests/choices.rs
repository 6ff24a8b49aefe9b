//! Choices with a known risk, against enumerated rewards.

use crate::common::{cells, network};
use cotama_risk::{
    ChoiceRule, Knows, Measure, Memory, Model, Names, Seen, expected_reward, optimal_reward,
};

/// The short way and the long way, objects at this speed: `data/two_ways.toml`.
fn two_ways(speed: &str) -> Model {
    let bound = |name: &str, low| (name.to_owned(), low, low + 10.0);
    let outcome = ["status", "success", "failed"].map(str::to_owned);
    let [variable, success, failure] = outcome;
    let names = Names {
        utility: 100.0,
        trials: 3,
        choice: "way".to_owned(),
        hidden: "ratio".to_owned(),
        given: vec![("object_speed".to_owned(), speed.to_owned())],
        outcome: (variable, success, failure),
        observed: vec!["path_length".to_owned()],
        cost: "run_time".to_owned(),
        bounds: vec![
            bound("t0_10", 0.0),
            bound("t10_20", 10.0),
            bound("t20_30", 20.0),
            bound("t30_40", 30.0),
        ],
    };
    Model::new(&network("two_ways"), &names).unwrap()
}

fn measure(text: &str) -> Measure {
    match text {
        "mean" => Measure::Mean,
        level => Measure::Quantile(level.parse().unwrap()),
    }
}

fn known(model: &Model, state: &str) -> Vec<f64> {
    model.hidden_states().iter().map(|it| f64::from(u8::from(it == state))).collect()
}

#[test]
fn all_54_rewards_are_those_of_exact_fractions() {
    let mut rows = 0;
    for row in cells("rewards.tsv") {
        let model = two_ways(&row[0]);
        let belief =
            if row[1] == "unknown" { model.prior().to_vec() } else { known(&model, &row[1]) };
        let found = model.estimate(&belief, 3, measure(&row[2]), ChoiceRule::Thesis);
        let wanted = [&row[3], &row[4], &row[6]].map(|it| it.parse::<f64>().unwrap());
        for (found, wanted) in [found.costs[0], found.costs[1], found.reward].iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-9, "{row:?} {found}");
        }
        assert_eq!(model.way(found.way), row[5], "{row:?}");
        rows += 1;
    }
    assert_eq!(rows, 54);
}

#[test]
fn beliefs_after_failures_are_those_of_exact_fractions() {
    let model = two_ways("medium");
    let mut rows = 0;
    for row in cells("beliefs.tsv") {
        let trial = |it: &str| {
            let (way, length) = it.split_once('/').unwrap();
            let observation = model.observations().iter().position(|it| it == length).unwrap();
            Seen { way: model.way_of(way).unwrap(), observation }
        };
        let trials: Vec<Seen> = row[0].split(' ').map(trial).collect();
        let memories: &[Memory] = match row[1].split(' ').next().unwrap() {
            "sum" => &[Memory::Sum],
            "product" => &[Memory::Product],
            _ => &[Memory::Sum, Memory::Product],
        };
        for memory in memories {
            let belief = model.belief(model.prior(), &trials, *memory);
            for (found, wanted) in belief.iter().zip(&row[2..7]) {
                assert!((found - wanted.parse::<f64>().unwrap()).abs() < 1e-11, "{row:?}");
            }
            for (level, way) in ["mean", "0.5", "0.75"].iter().zip(&row[7..]) {
                let left = 3 - trials.len();
                let best = model.estimate(&belief, left, measure(level), ChoiceRule::Thesis);
                assert_eq!(model.way(best.way), way, "{row:?} {level}");
            }
        }
        rows += 1;
    }
    assert_eq!(rows, 5);
}

/// Chances of ways by a policy of `policies.tsv`.
fn policy(model: &Model, name: &str, prior: &[f64], failed: &[Seen]) -> Vec<f64> {
    let only = |way: usize| (0..2).map(|it| f64::from(u8::from(it == way))).collect::<Vec<_>>();
    if let Some(way) = model.way_of(name) {
        return only(way);
    }
    if let Some((level, memory)) =
        name.strip_prefix("inference ").and_then(|it| it.split_once(", "))
    {
        let memory = if memory == "sum" { Memory::Sum } else { Memory::Product };
        let belief = model.belief(prior, failed, memory);
        let left = model.trials() - failed.len();
        return only(model.estimate(&belief, left, measure(level), ChoiceRule::Thesis).way);
    }
    // Fewer objects, the short way for equal ones; either way where that is not known.
    let known = model.hidden_states().iter().zip(prior).find(|it| *it.1 >= 1.0);
    match known.filter(|_| name == "defensive") {
        Some((ratio, _)) => only(usize::from(["r3_1", "r5_1"].contains(&ratio.as_str()))),
        None => vec![0.5, 0.5],
    }
}

#[test]
fn all_33_policies_earn_what_enumeration_says() {
    let mut rows = 0;
    for row in cells("policies.tsv") {
        let model = two_ways(&row[1]);
        for (knows, wanted) in [Knows::Prior, Knows::Hidden].into_iter().zip(&row[2..]) {
            let found = if row[0].starts_with("optimal") {
                optimal_reward(&model, knows)
            } else {
                expected_reward(&model, knows, |prior, failed| {
                    policy(&model, &row[0], prior, failed)
                })
            };
            assert!((found - wanted.parse::<f64>().unwrap()).abs() < 1e-9, "{row:?}: {found}");
        }
        rows += 1;
    }
    assert_eq!(rows, 33);
}

/// The odd case of the thesis (section 4.5.3.2): failures on the short way come early, so that a
/// quantile of the cost given failure rewards to fail early. The quantile of the total does not.
#[test]
fn the_quantile_of_the_total_cost_cures_the_odd_case() {
    let model = two_ways("medium");
    let belief = known(&model, "r3_1");
    let choice = |level, rule| model.estimate(&belief, 3, measure(level), rule).way;
    let [short, long] = ["short", "long"].map(|it| model.way_of(it).unwrap());
    assert_eq!(
        ["mean", "0.5", "0.75"].map(|it| choice(it, ChoiceRule::Thesis)),
        [long, short, short]
    );
    assert_eq!(["mean", "0.5", "0.75"].map(|it| choice(it, ChoiceRule::Total)), [long, long, long]);
}

#[test]
fn the_exact_rule_is_the_mean_of_the_total_where_one_way_is_taken() {
    // With one trial both are the expected cost under the belief.
    for speed in ["slow", "medium", "fast"] {
        let model = two_ways(speed);
        let of = |rule| model.estimate(model.prior(), 1, Measure::Mean, rule).costs;
        for (exact, total) in of(ChoiceRule::Exact).iter().zip(of(ChoiceRule::Total)) {
            assert!((exact - total).abs() < 1e-12);
        }
        // The recursion may answer a failure; a sequence that is fixed cannot know more.
        let of = |rule| model.estimate(model.prior(), 3, Measure::Mean, rule);
        let (exact, total) = (of(ChoiceRule::Exact), of(ChoiceRule::Total));
        assert!((exact.reward - total.reward).abs() < 1e-9, "{exact:?} {total:?}");
        assert!(optimal_reward(&model, Knows::Prior) >= exact.reward - 1e-9);
    }
}

#[test]
fn a_choice_with_a_wrong_name_is_refused() {
    let names = |change: &dyn Fn(&mut Names)| {
        let mut names = Names {
            utility: 100.0,
            trials: 3,
            choice: "way".to_owned(),
            hidden: "ratio".to_owned(),
            given: vec![],
            outcome: ("status".to_owned(), "success".to_owned(), "failed".to_owned()),
            observed: vec![],
            cost: "path_length".to_owned(),
            bounds: ["low", "middle", "high"].map(|it| (it.to_owned(), 0.0, 1.0)).to_vec(),
        };
        change(&mut names);
        Model::new(&network("two_ways"), &names).map_err(|it| it.to_string())
    };
    assert!(names(&|_| ()).is_ok());
    let refused = |change: &dyn Fn(&mut Names)| names(change).unwrap_err();
    assert_eq!(
        refused(&|it| it.choice = "waay".to_owned()),
        "no variable waay\n  help: did you mean `way`?"
    );
    assert_eq!(refused(&|it| it.hidden = "way".to_owned()), "way has two parts in the choice");
    assert_eq!(refused(&|it| it.trials = 9), "trials: 1 to 8, not 9");
    assert_eq!(
        refused(&|it| {
            it.bounds.pop();
        }),
        "high of path_length has no interval"
    );
}
