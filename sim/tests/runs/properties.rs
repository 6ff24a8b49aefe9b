//! Properties that hold whatever goes wrong.
#![allow(clippy::unwrap_used, clippy::pedantic)]

use crate::common::{patrol, shuttle};
use cotama_core::monitor::Upward;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError, RandomEvent};
use cotama_sim::faults_text::faults_text;
use cotama_sim::options::{FaultChoice, Fidelity, Options, Planner};
use cotama_sim::run::{MAX_REPLANS, Outcome, Reason, Run};
use cotama_sim::setup::Simulation;
use cotama_sim::trace::{Occurrence, Record};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use std::sync::LazyLock;

static PATROL: LazyLock<Mission> = LazyLock::new(patrol);
static SHUTTLE: LazyLock<Mission> = LazyLock::new(shuttle);

fn hindrance() -> BoxedStrategy<EventKind> {
    let length = prop_oneof![30 => 1u64..5_000, 6 => 5_000u64..60_000, 1 => 1u64..=1_000_000_000];
    let obstacle = length.clone().prop_map(|ms| EventKind::Obstacle { delay: Millis(ms) });
    let odometry = length.prop_map(|mm| EventKind::Odometry { extra: Millimetres(mm) });
    prop_oneof![obstacle, odometry].boxed()
}

fn faults(mission: &'static Mission) -> impl Strategy<Value = Faults> {
    let kind = move || {
        let hardware = 0..mission.hardware.len();
        let units = move |hardware: usize, units: u8| {
            (hardware, units.min(mission.hardware[hardware].units))
        };
        let lost = (hardware.clone(), 1u8..=2).prop_map(move |(kind, count)| {
            let (hardware, units) = units(kind, count);
            EventKind::Fault { hardware, units }
        });
        let back = (hardware, 1u8..=2).prop_map(move |(kind, count)| {
            let (hardware, units) = units(kind, count);
            EventKind::Repair { hardware, units }
        });
        prop_oneof![4 => hindrance(), 1 => lost, 1 => back]
    };
    let length = mission.path_length.0;
    let place = prop_oneof![
        4 => 0..=length,
        1 => Just(0),
        1 => Just(length),
        1 => (0..=length / 500).prop_map(|x| x * 500)
    ];
    let event = (place, kind()).prop_map(|(x, kind)| Event { x: Millimetres(x), kind });
    let zones = mission.zones.len();
    let errors = prop::collection::btree_map(
        0..zones,
        prop_oneof![3 => -300i32..0, 3 => -50i32..50, 1 => -999i32..=10_000],
        0..=3,
    );
    let random = prop_oneof![
        2 => Just(Vec::new()),
        1 => prop::collection::vec((1u16..=30, hindrance()), 1..3)
    ];
    (prop::collection::vec(event, 0..12), errors, random).prop_map(
        |(mut events, errors, random)| {
            events.sort_by_key(|event| event.x);
            let power_errors =
                errors.into_iter().map(|(zone, permille)| PowerError { zone, permille }).collect();
            let random = random
                .into_iter()
                .enumerate()
                .map(|(index, (per_km, kind))| RandomEvent {
                    name: format!("r{index}"),
                    per_km,
                    kind,
                })
                .collect();
            Faults { power_errors, events, random, of_robot: Vec::new() }
        },
    )
}

#[derive(Clone, Debug)]
struct Case {
    mission: &'static Mission,
    options: Options,
}

fn case() -> impl Strategy<Value = Case> {
    let mission = prop_oneof![Just(&*PATROL), Just(&*SHUTTLE)];
    let upward = prop::option::of((1u64..100_000, 1u64..1_000_000, 0u64..10_000, 0u64..100_000));
    let planner = prop_oneof![
        2 => Just(Planner::Panorama),
        1 => Just(Planner::PanoramaThenExact { steps: 20_000 })
    ];
    let period = prop::option::of(prop_oneof![Just(100u64), 1u64..100_000, Just(3_600_000)]);
    mission.prop_flat_map(move |mission| {
        (faults(mission), upward.clone(), planner.clone(), period.clone(), any::<u64>()).prop_map(
            move |(faults, upward, planner, period, seed)| Case {
                mission,
                options: Options {
                    seed,
                    faults: FaultChoice::Given { source: "property".into(), faults },
                    // Below 20 ms the traces are large and say nothing new.
                    monitor_period: period.map(|ms| Millis(ms.max(20))),
                    planner: Some(planner),
                    rigid: false,
                    fidelity: Fidelity::Line,
                    measured: None,
                    margins: None,
                    people: 0,
                    upward: upward
                        .map(|(t, e, rt, re)| Upward { growth: [t, e], reserve: [rt, re] }),
                },
            },
        )
    })
}

fn run(case: &Case) -> (Run, Vec<Record>) {
    let simulation = Simulation::new(case.mission, &case.options).unwrap();
    let mut records = Vec::new();
    let run = simulation.run_recorded(case.options.seed, &mut records).unwrap();
    (run, records)
}

/// The energy used, in pJ, as the trace alone tells it: each leg and each hindrance at the power of
/// the last sample before it.
fn energy_of_legs(records: &[Record]) -> u128 {
    let (mut time, mut power, mut energy) = (0, 0, 0);
    for record in records {
        energy += u128::from(record.t_us() - time) * u128::from(power) * 1000;
        time = record.t_us();
        if let Record::Sample(sample) = record {
            power = sample.real_power_mw;
        }
    }
    energy
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn every_mission_ends_and_its_books_balance(case in case()) {
        let (run, records) = run(&case);

        // Time and place never run backwards.
        for pair in records.windows(2) {
            prop_assert!(pair[0].t_us() <= pair[1].t_us() && pair[0].x_mm() <= pair[1].x_mm());
        }
        let Some(Record::End(end)) = records.last() else { panic!("no end") };
        prop_assert_eq!(end.t_us, run.time_us);

        // The time used is that of the end, the energy used that of all legs; power is traced to
        // half a mW.
        prop_assert_eq!(run.used[0], (run.time_us + 500) / 1000);
        prop_assert_eq!(u128::from(run.used[1]), (run.energy_pj + 500_000_000) / 1_000_000_000);
        let error = energy_of_legs(&records).abs_diff(run.energy_pj);
        prop_assert!(error <= u128::from(run.time_us) * 500, "{error} pJ");

        // The outcome is what limits and plans say.
        let within = run.margins.iter().all(|&margin| margin >= 0);
        match run.outcome {
            Outcome::Completed => prop_assert!(within && run.reason.is_none()),
            Outcome::Failed => {
                let exceeded = matches!(run.reason, Some(Reason::LimitExceeded { .. }));
                prop_assert!(!within && exceeded);
            }
            Outcome::Safe => {
                let exceeded = matches!(run.reason, Some(Reason::LimitExceeded { .. }));
                prop_assert!(within && run.reason.is_some() && !exceeded);
            }
        }
        prop_assert_eq!(run.operator_requests, 0);
        if run.outcome == Outcome::Completed {
            prop_assert_eq!(run.x_mm, case.mission.path_length.0);
        }
        prop_assert!(run.replans <= MAX_REPLANS);
        // Every plan met the limits when it was made, with the hardware that worked.
        for plan in &run.plans {
            prop_assert!(plan.after.iter().all(|&margin| margin >= 0), "{plan:?}");
        }
    }

    #[test]
    fn the_margins_are_never_checked_later_than_promised(case in case(), rigid in any::<bool>()) {
        let case = Case { options: Options { rigid, ..case.options }, ..case };
        let (run, records) = run(&case);
        let period = case.options.monitor_period.unwrap_or(case.mission.run.monitor_period);
        let samples: Vec<_> = records
            .iter()
            .filter_map(|it| if let Record::Sample(it) = it { Some(*it) } else { None })
            .collect();
        let times = samples.iter().map(|it| it.t_us).chain([run.time_us]);
        let mut last = 0;
        for time in times {
            prop_assert!(time - last <= period.0 * 1000, "{last} to {time} µs, every {period:?}");
            last = time;
        }
        // No run that is beyond a limit is called completed or safe, whatever ended it.
        let within = run.used.iter().zip(case.mission.limits).all(|(used, limit)| *used <= limit);
        prop_assert_eq!(within, run.outcome != Outcome::Failed);
        // A robot that waits stands, at the power of rest: with less than it drives with.
        for event in records.iter().filter_map(|it| {
            if let Record::Event(it) = it { Some(it) } else { None }
        }) {
            let began = event.t_us - event.lost_us;
            let inside = samples.iter().filter(|it| began < it.t_us && it.t_us < event.t_us);
            if let Occurrence::Obstacle { delay_ms } = event.event {
                prop_assert!(inside.clone().all(|it| it.speed_mm_s == 0));
                let whole = event.lost_us == delay_ms * 1000;
                prop_assert!(whole || run.x_mm == event.x_mm, "it stays where it was given up");
            }
            prop_assert!(inside.clone().all(|it| it.x_mm == event.x_mm));
        }
    }

    #[test]
    fn a_run_without_a_trace_is_the_same_run(case in case()) {
        let simulation = Simulation::new(case.mission, &case.options).unwrap();
        let (recorded, _) = run(&case);
        prop_assert_eq!(simulation.run(case.options.seed).unwrap(), recorded);
    }

    #[test]
    fn faults_read_back_from_their_text(faults in faults(&PATROL)) {
        let text = faults_text(&faults, &PATROL);
        let read = Faults::parse("faults.toml", &text, &PATROL);
        prop_assert_eq!(read.map_err(|errors| errors.to_string()), Ok(faults), "{}", text);
    }
}

/// The canary of the properties: their cases reach every outcome, and replans of every kind.
#[test]
fn the_cases_reach_the_premises_of_the_properties() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut seen = std::collections::BTreeMap::<String, u32>::new();
    for _ in 0..400 {
        let case = case().new_tree(&mut runner).unwrap().current();
        let (run, _) = run(&case);
        *seen.entry(run.outcome.name().into()).or_default() += 1;
        for plan in &run.plans {
            let cause = plan.cause.text(case.mission);
            let cause = if cause.ends_with("lost") { "lost" } else { cause.as_str() };
            *seen.entry(cause.into()).or_default() += 1;
        }
    }
    let needed = [
        "completed",
        "safe",
        "failed",
        "lost",
        "energy margin below zero",
        "duration margin below zero",
        "room for a better plan",
    ];
    for what in needed {
        assert!(seen.get(what).is_some_and(|&count| count >= 5), "{what}: {seen:?}");
    }
}
