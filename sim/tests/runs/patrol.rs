//! The patrol of Lambert et al. 2024: the first plan is that of Table 6 (7.2.3), and the replans
//! are those of Table 7 (7.3.3), each at its place and for its cause.
#![allow(clippy::unwrap_used)]

use crate::common::{labels, patrol, run, with_period};
use cotama_core::units::Millimetres;
use cotama_models::missions::Mission;
use cotama_models::missions::faults::EventKind;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::{Outcome, Run};

/// Margins of energy after the start move with the monitor period and the order of rounding by up
/// to so much.
const TOLERANCE_MJ: u64 = 5000;

/// The references are of an older script, whose first replan had one cause and whose robot drew
/// the power of driving while it waited. Ours, with three, is off by 4360 mJ at most at the replans
/// and by 4666 mJ at the end, but takes 2.4 s more: at the power of rest it waits longer for the
/// same energy.
fn near(found: i64, reference: i64) -> bool {
    found.abs_diff(reference) <= TOLERANCE_MJ
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
        assert!(near(found.0, before) && near(found.1, after), "RAS{plan}: {found:?}");
    }
    assert!(near(run.margins[1], 31_348), "{:?}", run.margins);
}

/// The place of the first replan in the paper: 64 m, in A8, which ends at 63.5 m.
const FIRST_REPLAN: Millimetres = Millimetres(63_400);

/// The patrol under only some of the three causes that act before the first replan.
fn caused_by(mission: &Mission, [error, odometry, obstacles]: [bool; 3]) -> Run {
    let way_out = mission.zones.iter().position(|zone| zone.id == "H1-out").unwrap();
    let mut faults = mission.run.faults.clone();
    faults.power_errors.retain(|it| error || it.zone != way_out);
    faults.events.retain(|event| match event.kind {
        EventKind::Obstacle { .. } => obstacles || event.x > FIRST_REPLAN,
        EventKind::Odometry { .. } => odometry || event.x > FIRST_REPLAN,
        _ => true,
    });
    let faults = FaultChoice::Given { source: "test".into(), faults };
    run(mission, &Options { faults, ..Options::default() })
}

/// The paper (7.3.3) names three: an odometer that drifts, obstacles on the way, and a model of the
/// power that errs. Each costs energy, and only all three together give the printed plan: less
/// hindered, only A17 changes.
#[test]
fn the_first_replan_has_the_three_causes_of_the_paper() {
    const ONLY_A17: &str = "M5 L2,M5 L2,M5 L2,T1 L2,D2,T1 L2,M5 L2,M5 L2,M5 L2,M1 L1";
    let mission = patrol();
    // The power error of the hall, odometry, obstacles; margin before (mJ) and plan, if replanned.
    let expected = [
        ([true, true, true], Some((-81_626, RAS[1].1))),
        ([false, true, true], Some((-65_113, ONLY_A17))),
        ([true, true, false], Some((-51_095, ONLY_A17))),
        ([false, true, false], Some((-34_733, ONLY_A17))),
        ([true, false, true], None),
        ([false, false, true], None),
        ([true, false, false], None),
        ([false, false, false], None),
    ];
    for (causes, first_replan) in expected {
        let run = caused_by(&mission, causes);
        let found = (run.plans[1].x_mm == FIRST_REPLAN.0)
            .then(|| (run.plans[1].before.unwrap()[1], labels(&mission, &run, 1).join(",")));
        let expected = first_replan.map(|(margin, plan)| (margin, plan.to_owned()));
        assert_eq!(found, expected, "error, odometry, obstacles: {causes:?}");
        // Without a replan there, the margin holds until the laser fails.
        assert!(found.is_some() || run.plans[1].x_mm == 118_000);
    }
}

/// Exact values, so that a change of rounding is seen.
#[test]
fn the_run_is_fixed_to_the_picojoule() {
    let run = run(&patrol(), &Options::default());
    assert_eq!((run.time_us, run.energy_pj), (548_301_197, 8_613_317_997_215_125));
    assert_eq!(run.margins, [51_699, 26_682]);
    assert_eq!((run.checks, run.events.total(), run.events.faults), (586, 11, 1));
}

/// The paper: the duration margin is always positive.
#[test]
fn only_energy_runs_short() {
    let run = run(&patrol(), &Options::default());
    for plan in &run.plans {
        assert!(plan.after[0] > 0 && plan.before.is_none_or(|before| before[0] > 0));
    }
}
