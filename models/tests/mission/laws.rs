//! Laws of cutting, generating and costing, on random missions.
#![cfg(feature = "std")]

use cotama_core::hardware::Equipment;
use cotama_core::units::Millimetres;
use cotama_models::missions::tables::{
    Alternative, EMPTY, RemainingError, Rest, buffer_sizes, remaining,
};
use cotama_models::missions::{Mission, embedded, harmless_speed};
use proptest::prelude::*;
use std::fmt::Write;

/// The patrol with other zones: each a start, a length, and a speed limit.
fn with_zones(zones: &[(u64, u64, u64)]) -> Mission {
    let text = embedded::mission("patrol").unwrap().text;
    let (before, rest) = text.split_at(text.find("[[zone]]").unwrap());
    let run = &rest[rest.find("[run]").unwrap()..];
    let run = run.lines().filter(|line| !line.starts_with("power_error"));
    let mut mission = before.to_owned();
    for (index, (start, length, speed)) in zones.iter().enumerate() {
        let end = (start + length).min(187_000);
        writeln!(mission, "[[zone]]\nid = \"z{index}\"\nx_start_mm = {start}\nx_end_mm = {end}")
            .unwrap();
        writeln!(mission, "speed_max_mm_s = {speed}").unwrap();
    }
    run.for_each(|line| mission.extend([line, "\n"]));
    Mission::parse("zones", &mission).unwrap()
}

fn zones() -> impl Strategy<Value = Vec<(u64, u64, u64)>> {
    prop::collection::vec((0..187_000u64, 1..100_000u64, 1..800u64), 0..8)
}

proptest! {
    #[test]
    fn cutting_keeps_the_path_and_every_zone(zones in zones()) {
        let mission = with_zones(&zones);
        let activities = &mission.scenario().activities;
        let mut at = Millimetres(0);
        for activity in activities {
            prop_assert_eq!(activity.x_start, at);
            at = activity.x_end;
            for zone in &mission.zones {
                let apart = activity.x_end <= zone.x_start || zone.x_end <= activity.x_start;
                let inside = zone.x_start <= activity.x_start && activity.x_end <= zone.x_end;
                prop_assert!(apart || inside);
                let limit = zone.speed_max.unwrap();
                prop_assert!(apart || !activity.table().travels() || activity.speed_max <= limit);
            }
            for alternative in &activity.alternatives {
                prop_assert!(alternative.speed <= activity.speed_max);
                prop_assert!(mission.scenario().available().covers(alternative.needs));
            }
        }
        prop_assert_eq!(at, mission.path_length);
    }

    #[test]
    fn less_hardware_leaves_a_part_of_the_candidates(
        lost in prop::collection::vec((0..4usize, 0..3u8), 0..4),
    ) {
        let patrol = embedded::mission("patrol").unwrap();
        let mission = Mission::parse(patrol.name, patrol.text).unwrap();
        let activities = mission.scenario().activities();
        let all = mission.scenario().available();
        let less = lost.iter().fold(all, |units, &(kind, count)| units.without(kind, count));
        let first = activities[0].whole(&activities[0].alternatives[0]);
        let ids = |available: Equipment| {
            let mut candidates = vec![EMPTY; buffer_sizes(&activities).0];
            let mut lists = vec![&[][..]; activities.len()];
            let (candidates, lists) = (&mut candidates, &mut lists[..]);
            let lists = remaining(&activities, Some(first), available, candidates, lists)?;
            let ids = lists.iter().map(|list| list.iter().map(|it| it.id).collect());
            Ok(ids.collect::<Vec<Vec<_>>>())
        };
        let whole = ids(all).unwrap();
        match ids(less) {
            Ok(part) => {
                for ((part, whole), activity) in part.iter().zip(&whole).zip(&activities) {
                    let needs = |id: u16| activity.alternatives[usize::from(id)].needs;
                    let covered = whole.iter().copied().filter(|&id| less.covers(needs(id)));
                    prop_assert_eq!(part, &covered.collect::<Vec<_>>());
                }
            }
            Err(RemainingError::NoCandidates { activity }) => {
                let alternatives = activities[activity].alternatives;
                prop_assert!(alternatives.iter().all(|it| !less.covers(it.needs)));
            }
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn two_halves_cost_the_whole_but_for_rounding(
        length in 0..1_000_000u64,
        cut in 0..1_000_000u64,
        speed in 1..2_000u64,
        power in 0..50_000u64,
    ) {
        let alternative = Alternative::travelling(speed, power, Equipment::NONE, 3);
        let cost = |mm| alternative.cost(Rest::Travel(Millimetres(mm)));
        let cut = cut.min(length);
        if let (Some(a), Some(b), Some(whole)) = (cost(cut), cost(length - cut), cost(length)) {
            prop_assert!((a[0] + b[0]).abs_diff(whole[0]) <= 1);
            // A millisecond more or less is so much energy; each rounding adds half a millijoule.
            let millisecond = power.div_ceil(1000) as u32;
            let parts = u64::from(a[1]) + u64::from(b[1]);
            prop_assert!(parts.abs_diff(whole[1].into()) <= u64::from(millisecond + 2));
        }
    }

    #[test]
    fn the_harmless_speed_is_the_largest(
        mass in 1..=1_000_000_000u64,
        energy in 1..=1_000_000_000u64,
    ) {
        let v = u128::from(harmless_speed(mass, cotama_core::units::Millijoules(energy)).0);
        let harmless = |v: u128| u128::from(mass) * v * v < 2_000_000 * u128::from(energy);
        prop_assert!((v == 0 || harmless(v)) && !harmless(v + 1));
    }
}
