//! Crowded ways: delays are those of the file, and bids count with the quantile of what is known.

use super::{run, run_recorded};
use crate::fleet::passages::Passages;
use crate::fleet::record::{Fate, Record, Run};
use crate::fleet::trace::{Trace, replay};
use crate::streams::Streams;
use cotama_models::team::scenario::{Scenario, Travel, Trust};

/// Two robots stand twelve metres from a store: `near` through a corridor that is crowded in one of
/// four drives, `far` by a yard that is free, and a little longer. Parcels come every ten minutes.
fn corridor(tasks: usize) -> Scenario {
    let mut text = String::from(
        "format = 'cotama-team/1'\nname = 'corridor'\n[floor]\n\
         places = ['corridor', 'store', 'yard']\n\
         [[floor.way]]\nbetween = ['corridor', 'store']\nlength_mm = 12000\n\
         delays_ms = [0, 0, 0, 120000]\n\
         [[floor.way]]\nbetween = ['yard', 'store']\nlength_mm = 15000\n\
         [[robot]]\nname = 'near'\nat = 'corridor'\nskills = ['move', 'grasp']\n\
         [[robot]]\nname = 'far'\nat = 'yard'\nskills = ['move', 'grasp']\n",
    );
    for task in 0..tasks {
        let arrives = 600_000 * task;
        text += &format!(
            "[[task]]\nname = 't{task}'\narrives_ms = {arrives}\nfrom = 'store'\nto = 'store'\n\
             skip_ms = 900000\n[[task.plan]]\nname = 'carry'\n\
             [[task.plan.role]]\nname = 'carrier'\n\
             needs = ['move', 'grasp']\ntake = 'object'\ngive = 'goal'\ntake_ms = 5000\n\
             give_ms = 5000\n"
        );
    }
    Scenario::parse("corridor", &text).unwrap()
}

fn with(scenario: &Scenario, travel: Travel, seed: u64) -> Run {
    run(&Scenario { travel, seed, ..scenario.clone() })
}

#[test]
fn a_drive_through_a_crowd_takes_as_much_longer_as_the_file_says() {
    let mut scenario = corridor(1);
    scenario.crowds[0].delays_ms = vec![0];
    let free = run(&scenario);
    scenario.crowds[0].delays_ms = vec![30_000];
    let crowded = run(&scenario);
    let more = crowded.end_ms - free.end_ms;
    assert!((30_000..=30_200).contains(&more), "{more}");
    assert_eq!(crowded.count(Fate::Done), 1);
    // The robot draws power while it stands in the corridor.
    assert!(crowded.energy_mj > free.energy_mj);
}

/// Returns the robot that gets the first task.
fn winner(scenario: &Scenario, travel: Travel) -> usize {
    let (_, records) = run_recorded(&Scenario { travel, ..scenario.clone() });
    let award = records.iter().find_map(|it| match it {
        Record::Awarded { robots, .. } => Some(robots[0]),
        _ => None,
    });
    award.unwrap()
}

#[test]
fn a_quantile_of_delays_decides_who_gets_a_task() {
    let scenario = corridor(1);
    let [near, far] = [0, 1];
    // In three of four drives nobody is met: 750 of a thousand are within the plain time.
    assert_eq!(winner(&scenario, Travel::Plain), near);
    assert_eq!(winner(&scenario, Travel::Quantile(750)), near);
    assert_eq!(winner(&scenario, Travel::Quantile(751)), far);
    // On average it takes 30 s longer, and the yard 10 s.
    assert_eq!(winner(&scenario, Travel::Mean), far);
}

#[test]
fn a_robot_learns_the_delays_that_it_meets() {
    let mut scenario = corridor(1);
    scenario.crowds[0].seen_ms = Some(vec![7]);
    let met = |trust| {
        let scenario = Scenario { trust, ..scenario.clone() };
        let streams = Streams::new(5);
        let mut passages = Passages::new(&scenario, &scenario.robots[0], streams);
        let mut met = Vec::new();
        for _ in 0..40 {
            let [first, second] = passages.enter(&scenario.crowds, [vec![0], vec![]]);
            assert_eq!(second, 0);
            passages.is_through(0);
            met.push(first);
        }
        (met, passages.seen()[0].clone())
    };
    let ((met_learning, learned), (met_stated, stated)) = (met(Trust::Learned), met(Trust::Stated));
    assert_eq!(met_learning, met_stated, "seeds are paired");
    assert_eq!((learned[0], &learned[1..]), (7, &met_learning[..]));
    assert_eq!(stated, [7]);
    assert!(met_learning.contains(&0) && met_learning.contains(&120_000));
}

/// Over 200 paired seeds: of a first task whose bids count with the 90 % quantile fewer take longer
/// than was bid, and the longest of all is shorter.
#[test]
fn bids_by_quantiles_are_kept_where_plain_ones_are_not() {
    let scenario = corridor(1);
    let of = |travel| {
        let runs = (0..200).map(|seed| with(&scenario, travel, seed).end_ms);
        let mut ends: Vec<u64> = runs.collect();
        ends.sort_unstable();
        (ends[179], ends[199])
    };
    let ((plain, plain_most), (quantile, most)) = (of(Travel::Plain), of(Travel::Quantile(900)));
    // Who waits for people gives the task back, and the other one begins a minute later.
    assert!(plain > quantile + 60_000 && plain_most >= plain, "{plain} {quantile}");
    assert!(most < quantile + 3_000, "{most} {quantile}");
}

#[test]
fn a_trace_of_a_crowded_floor_replays() {
    let scenario = Scenario { travel: Travel::Quantile(900), seed: 3, ..corridor(4) };
    let read = Trace::parse("t", &Trace::of(&scenario).to_json_lines()).unwrap();
    assert_eq!(replay(&read).unwrap().1, None);
}
