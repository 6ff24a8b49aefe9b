//! The patrol of Lambert et al. 2024 as it was driven: Tables 6 and 7, in their order, with their
//! causes.
#![allow(clippy::unwrap_used)]

mod common;

use common::{labels, patrol, run, with_period};
use cotama_sim::options::Options;
use cotama_sim::run::Outcome;

/// Margins after the start move with the monitor period and the order of rounding by up to so much.
const TOLERANCE_MS: u64 = 500;
const TOLERANCE_MJ: u64 = 5000;

/// What is found at a period of 1 s is far closer: 21 mJ at the first two replans, 47 mJ at the
/// third, 1 ms and 51 mJ at the end.
fn near(found: [i64; 2], reference: [i64; 2]) -> bool {
    found[0].abs_diff(reference[0]) <= TOLERANCE_MS
        && found[1].abs_diff(reference[1]) <= TOLERANCE_MJ
}

const RAS: [(&str, &str); 4] = [
    (
        "A1",
        "M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 L2,M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 L2,M5 L2,M5 \
         L2,M3 L1",
    ),
    ("A8", "M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 L2,M5 L2,M1 L2,M1 L1"),
    ("A14", "M3 L2,M3 L2,M1 L2,M3 L2"),
    ("A17", "M1 L2"),
];

#[test]
fn ras0_is_table_6_to_the_millijoule() {
    let mission = patrol();
    let run = run(&mission, &Options::default());
    let rows = run.plans[0].rows(&mission);
    let speeds: Vec<_> = rows.iter().map(|row| row.speed_mm_s).collect();
    assert_eq!(speeds, [410, 330, 330, 0, 0, 0, 330, 410, 410, 410, 0, 0, 0, 410, 410, 330, 410]);
    assert_eq!(rows.iter().map(|row| row.duration_ms).sum::<u64>(), 527_924);
    assert_eq!(rows.iter().map(|row| row.energy_mj).sum::<u64>(), 8_563_613);
    assert_eq!(run.plans[0].after, [72_076, 76_387]);
    assert_eq!(run.plans[0].before, None);
}

#[test]
fn the_replans_are_those_of_table_7_for_any_monitor_period() {
    let mission = patrol();
    for period in [100, 1_000, 10_000, 30_000] {
        let run = run(&mission, &with_period(period));
        let causes: Vec<_> =
            run.plans.iter().map(|plan| (plan.cause.text(&mission), plan.x_mm)).collect();
        let expected = [
            ("start".to_owned(), 0),
            ("energy margin below zero".to_owned(), 63_400),
            ("one laser lost".to_owned(), 118_000),
            ("energy margin below zero".to_owned(), 170_000),
        ];
        assert_eq!(causes, expected, "period {period} ms");
        for (index, (first, choice)) in RAS.iter().enumerate() {
            let first_activity = run.plans[index].first_activity;
            assert_eq!(mission.scenario().activities[first_activity].id, *first);
            assert_eq!(
                labels(&mission, &run, index).join(","),
                *choice,
                "RAS{index}, period {period} ms"
            );
        }
        assert_eq!((run.outcome, run.replans, run.operator_requests), (Outcome::Completed, 3, 0));
        assert!(run.margins.iter().all(|&margin| margin >= 0));
    }
}

#[test]
fn the_margins_are_near_the_references() {
    let mission = patrol();
    let run = run(&mission, &with_period(1_000));
    let energy = |plan: usize| (run.plans[plan].before.unwrap()[1], run.plans[plan].after[1]);
    for (plan, before, after) in [(1, -85_982, 115_400), (2, 240_164, 63_335), (3, -11_690, 25_626)]
    {
        let found = energy(plan);
        assert!(
            near([0, found.0], [0, before]) && near([0, found.1], [0, after]),
            "RAS{plan}: {found:?}"
        );
    }
    assert!(near(run.margins, [54_119, 31_348]), "{:?}", run.margins);
}

/// Exact values, so that a change of rounding is seen.
#[test]
fn the_run_is_fixed_to_the_picojoule() {
    let run = run(&patrol(), &Options::default());
    assert_eq!((run.time_us, run.energy_pj), (545_881_680, 8_608_600_609_236_450));
    assert_eq!(run.margins, [54_118, 31_399]);
    assert_eq!((run.checks, run.events.total(), run.events.faults), (552, 8, 1));
}

/// The paper: the duration margin is always positive.
#[test]
fn only_energy_runs_short() {
    let run = run(&patrol(), &Options::default());
    for plan in &run.plans {
        assert!(plan.after[0] > 0 && plan.before.is_none_or(|before| before[0] > 0));
    }
}
