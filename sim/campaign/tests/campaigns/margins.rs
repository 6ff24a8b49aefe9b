//! Margins learned from patrols that drift, held against further ones.

use super::mission;
use cotama_campaign::run::{Campaign, Settings, Shard};
use cotama_campaign::space::Rates;
use cotama_campaign::statistics::Promise;
use cotama_campaign::subject::{Policy, Subject};
use cotama_core::hold::ONE;
use cotama_models::margins::{Calibration, Spent};
use cotama_models::missions::Mission;
use cotama_sim::run::Outcome;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Results of runs: the amounts of each, how they ended, their plans after the first.
#[derive(Default)]
struct Runs {
    spent: Vec<Vec<Spent>>,
    outcomes: [u64; 3],
    replans: u64,
    energy_mj: u64,
}

impl Runs {
    fn replans_each(&self) -> f64 {
        self.replans as f64 / self.spent.len() as f64
    }
}

/// Patrols under obstacles, wrong odometry and power that differs, so many of them a run.
fn patrols(
    mission: &Mission,
    rigid: bool,
    margins: Option<&Calibration>,
    (runs, seed, faults): (u64, u64, (u64, u64)),
) -> Runs {
    let margins = margins.cloned().map(Arc::new);
    let policy = Policy { rigid, ..Policy::default() };
    let subject = Subject::holding(mission, policy, margins).unwrap();
    let settings = Settings { runs, seed, rates: Rates::Drift, faults, ..Settings::new(false) };
    let campaign = Campaign::new(subject, settings).unwrap();
    let mut all = Runs::default();
    campaign.run(Shard::ALL, 0, 2, &mut |lines| {
        for it in lines.into_iter().map(|it| it.observed) {
            all.outcomes[it.outcome as usize] += 1;
            all.replans += it.replans;
            all.energy_mj += it.energy_mj;
            all.spent.push(it.spent);
        }
        ControlFlow::Continue(())
    });
    all
}

fn learned(mission: &Mission, runs: &[Vec<Spent>], coverage: u32) -> Calibration {
    let ids: Vec<_> = mission.scenario().activities.iter().map(|it| it.id.clone()).collect();
    Calibration::learn(&mission.name, &ids, runs, coverage)
}

/// The promise for the whole mission on an axis, after these runs, and after how many it broke.
fn watched(known: &Calibration, axis: usize, runs: &[Vec<Spent>]) -> (Promise, Option<u64>) {
    let first = &known.from[0];
    let mut promise = Promise::new(first.rank.unwrap().into(), first.runs.into());
    let mut broken = None;
    for run in runs {
        promise.add(known.missed(0, axis, run).unwrap());
        if broken.is_none() && promise.is_broken(0.001) {
            broken = Some(promise.seen());
        }
    }
    (promise, broken)
}

#[test]
fn a_run_takes_in_all_what_its_activities_took() {
    let patrol = mission("patrol");
    for rigid in [true, false] {
        let runs = patrols(&patrol, rigid, None, (200, 5, (1, 3)));
        for (run, spent) in runs.spent.iter().enumerate() {
            assert!(spent.iter().enumerate().all(|(at, it)| it.activity == at), "{run}");
            let is_open = |it: &&Spent| !it.done;
            assert!(spent.iter().filter(is_open).count() <= 1, "{run}");
            assert!(!spent.last().unwrap().done || spent.len() == 17, "{run}");
        }
        let used: u64 = runs.spent.iter().flatten().map(|it| it.used[1]).sum();
        assert_eq!(used, runs.energy_mj);
    }
}

#[test]
fn margins_learned_from_runs_keep_their_promise_until_runs_drift_otherwise() {
    let patrol = mission("patrol");
    let past = patrols(&patrol, true, None, (400, 1, (1, 3)));
    let known = learned(&patrol, &past.spent, 950_000);
    let later = patrols(&patrol, true, None, (1_000, 2, (1, 3)));
    let worse = patrols(&patrol, true, None, (300, 3, (4, 6)));
    for axis in [0, 1] {
        let (promise, broken) = watched(&known, axis, &later.spent);
        let (missed, promised) = (promise.missed(), promise.coverage(0.999));
        assert_eq!(broken, None);
        // 1,000 runs are themselves chance of 0.7 %, beside that of the calibration.
        let share = 1.0 - missed as f64 / 1_000.0;
        assert!(promised.low - 0.02 < share && share < promised.high + 0.02, "{share}");
        let (_, broken) = watched(&known, axis, &worse.spent);
        assert!(broken.is_some_and(|it| it < 290), "{broken:?}");
    }
}

#[test]
fn patrols_that_hold_back_what_runs_take_end_less_often_before_their_goal() {
    let patrol = mission("patrol");
    let past = patrols(&patrol, true, None, (400, 1, (1, 3)));
    let known = learned(&patrol, &past.spent, 950_000);
    let of = |margins| patrols(&patrol, false, margins, (500, 2, (1, 3)));
    let (fixed, held) = (of(None), of(Some(&known)));
    assert_eq!(fixed.outcomes, [397, 103, 0]);
    assert!(held.outcomes[Outcome::Completed as usize] >= 490, "{:?}", held.outcomes);
    assert!(held.replans_each() < fixed.replans_each());
}

#[test]
fn a_reserve_that_no_plan_holds_ends_no_mission() {
    let patrol = mission("patrol");
    let past = patrols(&patrol, true, None, (100, 1, (1, 3)));
    let mut known = learned(&patrol, &past.spent, 900_000);
    // Three times the plan: no plan is so short, and none needs so little energy.
    known.from.iter_mut().for_each(|it| it.bounds = [Some(3 * ONE), Some(3 * ONE)]);
    let runs = patrols(&patrol, false, Some(&known), (200, 2, (1, 1)));
    assert!(runs.outcomes[Outcome::Completed as usize] >= 199, "{:?}", runs.outcomes);
}

/// The table of `docs/margins.md`; half a minute with `--release`.
#[test]
#[ignore = "20,000 patrols for each row"]
fn margins_over_20_000_patrols() {
    let patrol = mission("patrol");
    let past = patrols(&patrol, true, None, (2_000, 1, (1, 3)));
    let later = patrols(&patrol, true, None, (20_000, 2, (1, 3)));
    let worse = patrols(&patrol, true, None, (20_000, 3, (4, 6)));
    for coverage in [900_000, 950_000, 990_000] {
        let known = learned(&patrol, &past.spent, coverage);
        for axis in [0, 1] {
            let (promise, broken) = watched(&known, axis, &later.spent);
            let promised = promise.coverage(0.95);
            let share = 1.0 - promise.missed() as f64 / promise.seen() as f64;
            println!(
                "{coverage} axis {axis}: {share:.4} in {:.4} to {:.4}",
                promised.low, promised.high
            );
            assert!(promised.holds(share) && broken.is_none());
            let (promise, broken) = watched(&known, axis, &worse.spent);
            let share = 1.0 - promise.missed() as f64 / promise.seen() as f64;
            println!("  worse drift: {share:.4}, broken after {}", broken.unwrap());
        }
    }
    let constant = |permille: u32| {
        let mut known = learned(&patrol, &past.spent, 900_000);
        known.from.iter_mut().for_each(|it| it.bounds = [Some(permille * 1_000); 2]);
        known
    };
    let calibrated = |coverage| learned(&patrol, &past.spent, coverage);
    let rows = [
        ("none", None),
        ("5 %", Some(constant(1_050))),
        ("10 %", Some(constant(1_100))),
        ("20 %", Some(constant(1_200))),
        ("calibrated 90 %", Some(calibrated(900_000))),
        ("calibrated 95 %", Some(calibrated(950_000))),
        ("calibrated 99 %", Some(calibrated(990_000))),
    ];
    for faults in [(1, 3), (4, 6)] {
        println!("{faults:?} faults a run: completed, safe, failed; plans after the first; energy");
        for (name, margins) in &rows {
            let runs = patrols(&patrol, false, margins.as_ref(), (20_000, 2, faults));
            let energy = runs.energy_mj as f64 / 20_000.0 / 1_000.0;
            println!("{name:<16} {:?} {:.3} {energy:.0} J", runs.outcomes, runs.replans_each());
        }
    }
}
