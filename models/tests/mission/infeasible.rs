//! Missions without a plan: the reason and the relaxations, exactly, and that each relaxation is
//! what it says. What is said of them is in `tests/golden/infeasible_*.txt`; `UPDATE_GOLDEN=1 cargo
//! test -p cotama-models --test mission infeasible` writes it again.
#![cfg(feature = "std")]
#![allow(clippy::cast_precision_loss)] // shares are compared roughly

use cotama_core::hardware::Equipment;
use cotama_models::missions::infeasible::{
    Explanation, Reason, Relaxation, explain, explain_within,
};
use cotama_models::missions::{Constraint, Mission, Unfolded, embedded};
use proptest::prelude::*;

const ENERGY: usize = 1;
const SONAR: usize = 0;
const LASER: usize = 1;
const KINECT: usize = 2;

/// The patrol with each `(old, new)` text replaced wherever it stands.
fn patrol_with(edits: &[(&str, &str)]) -> Mission {
    let text = embedded::mission("patrol").unwrap().text.to_owned();
    let text = edits.iter().fold(text, |text, (old, new)| {
        assert!(text.contains(old), "{old:?} is not in the patrol");
        text.replace(old, new)
    });
    Mission::parse("patrol.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn patrol() -> Mission {
    patrol_with(&[])
}

/// Every pair of total duration and energy that no other beats, with this hardware: none where an
/// activity has no alternative. No search, and no allocator: sums over the activities, one after
/// the other.
fn front(mission: &Unfolded, available: Equipment) -> Vec<[u64; 2]> {
    let mut front = vec![[0, 0]];
    for activity in mission.scenario().activities() {
        let mut next = Vec::new();
        for alternative in activity.alternatives.iter().filter(|it| available.covers(it.needs)) {
            let cost = alternative.cost(activity.whole(alternative)).unwrap().map(u64::from);
            next.extend(front.iter().map(|sum: &[u64; 2]| [sum[0] + cost[0], sum[1] + cost[1]]));
        }
        next.sort_unstable();
        front.clear();
        for pair in next {
            if front.last().is_none_or(|last| pair[1] < last[1]) {
                front.push(pair);
            }
        }
    }
    front
}

fn feasible(mission: &Unfolded, limits: [u64; 2], available: Equipment) -> bool {
    front(mission, available).iter().any(|cost| cost[0] <= limits[0] && cost[1] <= limits[1])
}

/// Whether a relaxation, applied, is feasible.
fn suffices(
    relaxation: &Relaxation,
    mission: &Mission,
    limits: [u64; 2],
    available: Equipment,
) -> bool {
    let (mission, limits, available) = relaxation.apply(mission, limits, available).unwrap();
    feasible(&mission, limits, available)
}

/// The same relaxation, one unit less of something; one for each thing that can be less.
fn less(relaxation: &Relaxation) -> Vec<Relaxation> {
    let without = |axis: usize, to: [u64; 2]| {
        let mut to = to;
        to[axis] -= 1;
        to
    };
    match relaxation.clone() {
        Relaxation::RaiseLimit { axis, from, to } => {
            vec![Relaxation::RaiseLimit { axis, from, to: to - 1 }]
        }
        Relaxation::RaiseLimits { from, to } => {
            [0, 1].map(|axis| Relaxation::RaiseLimits { from, to: without(axis, to) }).to_vec()
        }
        Relaxation::LiftConstraints { constraints } => (0..constraints.len())
            .map(|left_out| {
                let mut constraints = constraints.clone();
                constraints.remove(left_out);
                Relaxation::LiftConstraints { constraints }
            })
            .collect(),
        Relaxation::KeepHardware { hardware, units } => {
            vec![Relaxation::KeepHardware { hardware, units: units - 1 }]
        }
        Relaxation::KeepHardwares { hardware } => (0..hardware.len())
            .map(|lowered| {
                let mut hardware = hardware.clone();
                hardware[lowered].1 -= 1;
                Relaxation::KeepHardwares { hardware }
            })
            .collect(),
        Relaxation::LiftConstraint { .. } | Relaxation::DropObjective { .. } => vec![],
    }
}

/// Checks the promises of every complete explanation.
fn check(why: &Explanation, mission: &Mission, limits: [u64; 2], available: Equipment) {
    assert!(why.complete);
    for relaxation in &why.relaxations {
        assert!(
            suffices(relaxation, mission, limits, available),
            "{relaxation:?} does not suffice"
        );
        for less in less(relaxation) {
            assert!(
                !suffices(&less, mission, limits, available),
                "{less:?} is enough for {relaxation:?}"
            );
        }
    }
    // Nothing that suffices is missing.
    let front = front(mission, available);
    let single = |relaxation: &Relaxation| why.relaxations.contains(relaxation);
    let raises =
        why.relaxations.iter().filter(|it| matches!(it, Relaxation::RaiseLimit { .. })).count();
    let reachable = [0, 1].map(|axis| front.iter().any(|cost| cost[1 - axis] <= limits[1 - axis]));
    assert_eq!(raises, reachable.into_iter().filter(|&it| it).count());
    let both =
        why.relaxations.iter().filter(|it| matches!(it, Relaxation::RaiseLimits { .. })).count();
    assert_eq!(both > 0, raises == 0 && !front.is_empty());
    let (mut lifted, mut bare) = (0, Unfolded::clone(mission));
    for zone in 0..mission.zones.len() {
        for constraint in [Constraint::Hardware, Constraint::Tio] {
            let relaxation = Relaxation::LiftConstraint { zone, constraint };
            let helps = relaxation
                .apply(mission, limits, available)
                .is_some_and(|(mission, limits, available)| feasible(&mission, limits, available));
            assert_eq!(single(&relaxation), helps, "{relaxation:?}");
            lifted += usize::from(helps);
            bare = bare.without_zone_constraint(zone, constraint).unwrap_or(bare);
        }
    }
    let sets = why
        .relaxations
        .iter()
        .filter(|it| matches!(it, Relaxation::LiftConstraints { .. }))
        .count();
    assert_eq!(sets, usize::from(lifted == 0 && feasible(&bare, limits, available)));
    let mut kept = 0;
    for (hardware, it) in mission.hardware.iter().enumerate() {
        let helps = (available.of(hardware) + 1..=it.units).find(|&units| {
            suffices(&Relaxation::KeepHardware { hardware, units }, mission, limits, available)
        });
        let listed = why.relaxations.iter().find_map(|relaxation| match *relaxation {
            Relaxation::KeepHardware { hardware: kind, units } if kind == hardware => Some(units),
            _ => None,
        });
        assert_eq!(listed, helps, "hardware {hardware}");
        kept += usize::from(helps.is_some());
    }
    let sets =
        why.relaxations.iter().filter(|it| matches!(it, Relaxation::KeepHardwares { .. })).count();
    assert_eq!(sets, usize::from(kept == 0 && feasible(mission, limits, mission.available())));
    let mut last_end = None;
    for (objective, it) in mission.objectives.iter().enumerate() {
        let relaxation = Relaxation::DropObjective { objective };
        let helps = relaxation
            .apply(mission, limits, available)
            .is_some_and(|(mission, limits, available)| feasible(&mission, limits, available));
        if it.travels() {
            last_end = helps.then_some(objective).or(last_end);
        } else {
            assert_eq!(single(&relaxation), helps, "{relaxation:?}");
        }
    }
    let ends = why.relaxations.iter().filter_map(|it| match it {
        Relaxation::DropObjective { objective } if mission.objectives[*objective].travels() => {
            Some(*objective)
        }
        _ => None,
    });
    assert_eq!(ends.collect::<Vec<_>>(), last_end.into_iter().collect::<Vec<_>>());
    check_order(why, mission);
    check_heaviest(why, mission);
}

/// Raised limits by the larger part they add, then constraints, hardware, objectives as the file
/// has them.
fn check_order(why: &Explanation, mission: &Mission) {
    let part = |from: u64, to: u64| to.saturating_sub(from) as f64 / from as f64;
    let key = |relaxation: &Relaxation| match *relaxation {
        Relaxation::RaiseLimit { from, to, .. } => (0, part(from, to), 0, 0),
        Relaxation::RaiseLimits { from, to } => {
            (0, part(from[0], to[0]).max(part(from[1], to[1])), 0, 0)
        }
        Relaxation::LiftConstraint { zone, constraint } => (1, 0.0, zone, constraint as usize),
        Relaxation::LiftConstraints { .. } => (1, 0.0, 0, 0),
        Relaxation::KeepHardware { hardware, .. } => (2, 0.0, hardware, 0),
        Relaxation::KeepHardwares { .. } => (2, 0.0, 0, 0),
        Relaxation::DropObjective { objective } => {
            (3, 0.0, usize::from(mission.objectives[objective].travels()), objective)
        }
    };
    assert!(why.relaxations.windows(2).all(|pair| key(&pair[0]) <= key(&pair[1])), "{why:?}");
}

/// Checks that the figures of a reason about a limit are proven, however early the search ended.
fn check_reason(reason: &Reason, front: &[[u64; 2]], limits: [u64; 2]) {
    let least = |axis: usize, other: u64| {
        front.iter().filter(|cost| cost[1 - axis] <= other).map(|cost| cost[axis]).min()
    };
    match *reason {
        Reason::Limit { axis, limit, least: said } => {
            assert_eq!((limit, least(axis, limits[1 - axis])), (limits[axis], Some(said)));
            assert!(said > limit);
        }
        Reason::Limits { limits: of, least: said } => {
            assert_eq!((of, [0, 1].map(|axis| least(axis, u64::MAX))), (limits, said.map(Some)));
            assert!([0, 1].iter().all(|&axis| said[axis] > limits[axis]));
        }
        _ => {}
    }
}

fn check_heaviest(why: &Explanation, mission: &Mission) {
    let total = match why.reason {
        Reason::Limit { axis, least, .. } => Some((axis, least)),
        Reason::Limits { least, .. } => Some((mission.order[0], least[mission.order[0]])),
        Reason::NoAlternative { .. } | Reason::SomeLimit { .. } | Reason::Undecided { .. } => None,
    };
    assert_eq!(total.is_some(), !why.heaviest.is_empty());
    for heavy in &why.heaviest {
        let (axis, least) = total.unwrap();
        assert_eq!((heavy.axis, heavy.permille <= 1000), (axis, true));
        let share = f64::from(heavy.cost) / least as f64 * 1000.0;
        assert!((share - f64::from(heavy.permille)).abs() < 0.51);
    }
    assert!(why.heaviest.windows(2).all(|pair| pair[0].cost >= pair[1].cost));
}

fn compare(name: &str, why: &Explanation, mission: &Mission) {
    let heaviest = why.heaviest.iter().map(|it| it.wording(mission));
    let relaxations = why.relaxations.iter().map(|it| it.wording(mission));
    let lines = std::iter::once(why.reason.wording(mission)).chain(heaviest).chain(relaxations);
    let said = lines.collect::<Vec<_>>().join("\n") + "\n";
    cotama_golden::compare(format!("tests/golden/infeasible_{name}.txt"), &said);
}

#[test]
fn a_mission_with_a_plan_needs_no_explanation() {
    let mission = patrol();
    let all = mission.available();
    assert_eq!(explain(&mission, mission.limits, all), None);
    assert_eq!(explain(&mission, [u64::MAX; 2], all), None);
    // The limits are inclusive.
    assert_eq!(explain(&mission, [600_000, 4_675_896], all), None);
}

#[test]
fn half_the_energy_is_too_little() {
    let mission = patrol();
    let all = mission.available();
    let limits = [600_000, 4_320_000];
    let why = explain(&mission, limits, all).unwrap();
    assert_eq!(why.reason, Reason::Limit { axis: ENERGY, limit: 4_320_000, least: 4_675_896 });
    assert_eq!(
        why.relaxations[0],
        Relaxation::RaiseLimit { axis: ENERGY, from: 4_320_000, to: 4_320_000 + 355_896 }
    );
    compare("half_the_energy", &why, &mission);
    check(&why, &mission, limits, all);
}

#[test]
fn four_hundred_seconds_are_too_short() {
    let mission = patrol();
    let all = mission.available();
    let limits = [400_000, 8_640_000];
    let why = explain(&mission, limits, all).unwrap();
    compare("too_short", &why, &mission);
    check(&why, &mission, limits, all);
}

#[test]
fn both_limits_too_low_are_raised_together() {
    let mission = patrol();
    let all = mission.available();
    let limits = [400_000, 4_320_000];
    let why = explain(&mission, limits, all).unwrap();
    compare("both_limits", &why, &mission);
    check(&why, &mission, limits, all);
}

#[test]
fn competing_limits_get_two_offers_to_raise_both() {
    let mission = slow_is_cheap();
    let all = mission.available();
    let limits = [400_000, 1_000_000];
    let why = explain(&mission, limits, all).unwrap();
    compare("competing_limits", &why, &mission);
    check(&why, &mission, limits, all);
}

#[test]
fn without_the_sonar_the_glazed_zones_have_no_alternative() {
    let mission = patrol();
    let available = mission.available().without(SONAR, 1);
    let why = explain(&mission, mission.limits, available).unwrap();
    let zone = |id| mission.zones.iter().position(|zone| zone.id == id).unwrap();
    let reason = Reason::NoAlternative {
        activity: 1,
        lacks: vec![Equipment::NONE.with(SONAR, 1).unwrap()],
        constraints: vec![(zone("glass-out"), Constraint::Hardware)],
        others: vec![2, 6, 9, 15],
    };
    assert_eq!(why.reason, reason);
    compare("no_sonar", &why, &mission);
    check(&why, &mission, mission.limits, available);
}

#[test]
fn a_zone_that_needs_two_lasers_needs_both() {
    let mission = lasers_in_glass();
    let available = mission.available().without(LASER, 2);
    let why = explain(&mission, mission.limits, available).unwrap();
    assert!(why.relaxations.contains(&Relaxation::KeepHardware { hardware: LASER, units: 2 }));
    compare("no_lasers", &why, &mission);
    check(&why, &mission, mission.limits, available);
}

#[test]
fn hardware_of_several_kinds_is_kept_together() {
    let mission = patrol();
    // The lasers need not be kept.
    let available = mission.available().without(SONAR, 1).without(LASER, 2).without(KINECT, 1);
    let why = explain(&mission, mission.limits, available).unwrap();
    compare("several_kinds", &why, &mission);
    check(&why, &mission, mission.limits, available);
}

#[test]
fn a_search_cut_short_says_so() {
    let mission = slow_is_cheap();
    let all = mission.available();
    let front = front(&mission, all);
    let [duration, energy] = front[front.len() / 2];
    // One unit from a plan it takes long to see that there is none; far from one, to find the least
    // limit.
    for (limits, what) in
        [([duration, energy - 1], "reason"), ([duration, energy / 2], "relaxations")]
    {
        let why = explain(&mission, limits, all).unwrap();
        check(&why, &mission, limits, all);
        let mut cut_short = 0;
        for steps in [0, 1, 10, 20, 50, 100, 200, 500, 1_000, 10_000, 100_000] {
            let within = explain_within(&mission, limits, all, steps).unwrap();
            if within.complete {
                assert_eq!(within, why);
                continue;
            }
            assert!(
                within.relaxations.iter().all(|it| suffices(it, &mission, limits, all)),
                "{within:?}"
            );
            check_reason(&within.reason, &front, limits);
            let undecided = within.reason == Reason::Undecided { steps };
            assert!(!undecided || within.relaxations.is_empty());
            cut_short += usize::from(undecided == (what == "reason"));
        }
        assert!(cut_short > 0, "no search was cut short that looked for the {what}");
    }
    let said = Reason::Undecided { steps: 7 }.wording(&mission);
    assert_eq!(said, "neither a plan nor the proof that there is none was found in 7 steps");
}

/// A patrol on which slow options save energy, so that the limits compete.
fn slow_is_cheap() -> Mission {
    patrol_with(&[
        ("c0 = 4890", "c0 = 0"),
        ("power_mw = 1300", "power_mw = 53"),
        ("power_mw = 2200", "power_mw = 22"),
        ("power_mw = 4600", "power_mw = 46"),
        ("\nat = ", "\n# at = "),
        ("id = \"M1\"\n", "id = \"M1\"\nspeed_max_mm_s = 217\n"),
        ("id = \"M3\"\n", "id = \"M3\"\nspeed_max_mm_s = 291\n"),
        ("id = \"M4\"\n", "id = \"M4\"\nspeed_max_mm_s = 353\n"),
    ])
}

/// A patrol whose first glazed zone requires both lasers.
fn lasers_in_glass() -> Mission {
    let sonar = "31000\nx_end_mm = 41000\nrequire_hardware = \"sonar\"";
    let lasers = "31000\nx_end_mm = 41000\nrequire_hardware = \"laser\"\nrequire_units = 2";
    patrol_with(&[(sonar, lasers)])
}

#[test]
fn the_smaller_raise_is_first_if_either_limit_could_be_raised() {
    let mission = slow_is_cheap();
    let all = mission.available();
    let limits = [500_000, 1_700_000];
    let why = explain(&mission, limits, all).unwrap();
    compare("either_limit", &why, &mission);
    check(&why, &mission, limits, all);
}

#[test]
fn a_limit_of_nothing_is_raised_too() {
    let mission = patrol();
    let all = mission.available();
    let why = explain(&mission, [0, 0], all).unwrap();
    assert!(matches!(why.reason, Reason::Limits { .. }));
    let why = explain(&mission, [600_000, 0], all).unwrap();
    let raise = why.relaxations[0].wording(&mission);
    assert_eq!(raise, "raise the energy limit from 0 J to 4675.896 J (+4675.896 J)");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]
    #[test]
    fn an_explanation_is_given_exactly_where_there_is_no_plan_and_its_relaxations_suffice(
        which in 0..3usize,
        duration in 300_000..1_200_000u64,
        energy in 1_000_000..6_000_000u64,
        lost in prop::collection::vec((0..4usize, 1..3u8), 0..5),
    ) {
        let mission = [patrol, slow_is_cheap, lasers_in_glass][which]();
        let limits = [duration, energy];
        let without = |all: Equipment, &(kind, count): &(usize, u8)| all.without(kind, count);
        let available = lost.iter().fold(mission.available(), without);
        match explain(&mission, limits, available) {
            None => prop_assert!(feasible(&mission, limits, available)),
            Some(why) => {
                prop_assert!(!feasible(&mission, limits, available));
                check(&why, &mission, limits, available);
            }
        }
    }
}
