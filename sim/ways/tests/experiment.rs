//! The experiment as stories: one world, few maps; the whole series is ignored by default.
#![allow(clippy::unwrap_used, missing_docs)]

use cotama_risk::{ChoiceRule, Measure, Memory};
use cotama_ways::{
    Condition, End, Learned, MAPS, ObjectSpeed, Place, Policy, Ratio, Results, Row, Rules, Series,
    Way, World, run, to_csv, train,
};

fn place(map: usize, trial: usize) -> Place {
    Place { series: Series::Run(0), condition: Condition::Limited, map, trial }
}

#[test]
fn a_robot_arrives_on_a_way_that_it_finds_free_and_is_stopped_by_a_disc_elsewhere() {
    let mut world = World::new(1, ObjectSpeed::Medium);
    let ends: Vec<End> = (0..8).map(|it| world.trial(place(6, it), Way::Short).end).collect();
    assert!(ends.contains(&End::Arrived) && ends.contains(&End::Disc), "{ends:?}");
    let arrived = (0..8).map(|it| world.trial(place(6, it), Way::Short));
    let arrived = arrived.into_iter().find(cotama_ways::Trial::is_success).unwrap();
    // 10 m less the 0.3 m at which the goal counts as reached, and the corners cut.
    assert!((9.0..12.0).contains(&arrived.length_m), "{arrived:?}");
    assert!(arrived.cost() > 9.0);
}

#[test]
fn the_same_seed_gives_the_same_trials_and_another_one_others() {
    let times = |seed| {
        let mut world = World::new(seed, ObjectSpeed::Fast);
        [0, 1, 2].map(|it| world.trial(place(it, 0), Way::Long).time)
    };
    assert_eq!(times(5), times(5));
    assert_ne!(times(5), times(6));
}

#[test]
fn discs_of_a_trial_are_the_same_for_both_ways() {
    let world = World::new(1, ObjectSpeed::Medium);
    let streams = world.streams(place(0, 0));
    let mut first = [Vec::new(), Vec::new()];
    for way in Way::ALL {
        let seen = &mut first[way as usize];
        let note = |_: &_, discs: &[_]| {
            if seen.is_empty() {
                seen.extend_from_slice(discs);
            }
        };
        cotama_ways::trial(world.ring(0), way, ObjectSpeed::Medium, &streams, note);
    }
    assert_eq!(first[0].len(), 6);
    assert_eq!(first[0], first[1]);
}

/// Trials whose failures on the short way come early and on the long one late: the odd case.
fn odd() -> Learned {
    let trial = |end, seconds: u64, length_m| cotama_ways::Trial {
        end,
        time: cotama_core::units::Millis(1_000 * seconds),
        length_m,
    };
    let rows = |way, failed: usize, of: usize, early: u64, late: u64| {
        (0..of).map(move |at| Row {
            ratio: Ratio::R31,
            way,
            trial: if at < failed {
                trial(End::Disc, if at % 4 == 0 { late } else { early }, 3.0)
            } else {
                trial(End::Arrived, 25, 10.0)
            },
        })
    };
    let short = rows(Way::Short, 22, 30, 5, 9);
    let long = rows(Way::Long, 11, 21, 15, 35);
    Learned::new(&short.chain(long).collect::<Vec<_>>()).unwrap()
}

#[test]
fn a_quantile_of_the_cost_given_failure_rewards_failing_early_and_the_total_does_not() {
    let model = odd().model().unwrap();
    let belief = Ratio::ALL.map(|it| f64::from(u8::from(it == Ratio::R31)));
    let way = |measure, rule| Way::ALL[model.estimate(&belief, 3, measure, rule).way];
    let level = Measure::Quantile(0.75);
    assert_eq!(way(Measure::Mean, ChoiceRule::Exact), Way::Long);
    assert_eq!(way(level, ChoiceRule::Thesis), Way::Short);
    assert_eq!(way(level, ChoiceRule::Total), Way::Long);
}

#[test]
fn trials_add_up_in_the_network_and_as_csv() {
    let learned = odd();
    assert_eq!((learned.rows(), learned.tally(Ratio::R31, Way::Short)), (51, [30, 22]));
    let mut more = learned.clone();
    let mut world = World::new(1, ObjectSpeed::Medium);
    let trial = world.trial(place(0, 0), Way::Short);
    let row = Row { ratio: MAPS[0].ratio, way: Way::Short, trial };
    more.add(&row).unwrap();
    assert_eq!(more.tally(Ratio::R51, Way::Short)[0], 1);
    assert_ne!(more.network().unwrap(), learned.network().unwrap());
    let csv = to_csv(&[row]);
    assert!(csv.starts_with("ratio,way,status,path_length_m,run_time_s\nr5_1,short,"), "{csv}");
}

/// The whole experiment, and what of it the claims name.
#[test]
#[ignore = "15 runs of 40 maps for ten policies at three speeds take about a minute"]
fn quantiles_of_the_total_reach_their_reliability_and_those_of_trials_not_at_every_speed() {
    for speed in ObjectSpeed::ALL {
        let mut world = World::new(1, speed);
        let (learned, _) = train(&mut world).unwrap();
        let mut results = |policy, rules| {
            let one = |at| {
                let mut own = learned.clone();
                run(&mut world, Series::Run(at), policy, rules, &mut own, false).unwrap()
            };
            Results::new(policy, &(0..15).map(one).collect::<Vec<_>>())
        };
        let all = Policy::COMPARED.map(|it| results(it, Rules::default()));
        let [random, defensive, mean, half, high] = &all;
        let [half, high] = [half, high].map(|it| it.reliability.unwrap());
        if speed == ObjectSpeed::Fast {
            assert!(half.high < 0.5 && high.high < 0.5, "{half:?} {high:?}");
        } else {
            assert!(half.low > 0.5 && high.low > 0.75, "{half:?} {high:?}");
        }
        assert!(mean.reward.value > defensive.reward.value);
        assert!(defensive.reward.value > random.reward.value);
        let rules = Rules { choice: ChoiceRule::Total, memory: Memory::Product };
        for level in [0.5, 0.75] {
            let total = results(Policy::Inference(Measure::Quantile(level)), rules);
            assert!(total.reliability.unwrap().low > level, "{total:?}");
        }
    }
}
