//! Random nets, compared with simple methods.

use super::oracle::{Draw, backward, covers_all, random, reachable};
use super::{end, pumps_ten_times};
use cotama_core::net::PlaceId;
use cotama_verification::coverability::{
    Bounded, CoverabilitySet, Coverable, Limits, Tokens, bounded, coverable,
};

const LIMITS: Limits = Limits { states: 3_000, bytes: 1 << 30, deadline: None };

#[test]
fn the_set_covers_all_that_is_reachable_and_nothing_else() {
    let (mut finished, mut unbounded, mut written) = (0, 0, 0);
    for seed in 0..5_000 {
        let pt = random(seed);
        let Ok(set) = CoverabilitySet::new(&pt, &LIMITS) else { continue };
        finished += 1;
        let markings: Vec<Vec<Tokens>> = set.markings().map(<[Tokens]>::to_vec).collect();
        assert!(covers_all(&pt, &markings), "net {seed}");
        for one in &markings {
            let greater = markings.iter().filter(|it| one.iter().zip(*it).all(|(a, b)| a <= b));
            assert_eq!(greater.count(), 1, "net {seed}");
            // The marking is a limit of reachable ones: five tokens wherever it has ω.
            let target: Vec<(PlaceId, u64)> =
                (0..).map(PlaceId).zip(one.iter().map(|it| it.finite().unwrap_or(5))).collect();
            let way = set.covers(&target).unwrap();
            if way.firings.is_some() {
                let marking = end(&pt, &way);
                assert!(
                    target.iter().all(|it| u64::from(marking[it.0.0 as usize]) >= it.1),
                    "net {seed}"
                );
                written += 1;
            }
        }
        unbounded += usize::from(markings.iter().flatten().any(|it| it.is_omega()));
    }
    eprintln!("{finished} sets, {unbounded} of unbounded nets, {written} ways");
    assert!(finished > 4_900 && unbounded > 1_000, "{finished} {unbounded}");
}

#[test]
fn bounded_nets_have_the_bounds_of_their_markings_and_unbounded_ones_a_pump() {
    let (mut yes, mut no) = (0, 0);
    for seed in 0..5_000 {
        let pt = random(seed);
        let all = reachable(&pt, 2_000);
        match bounded(&pt, &LIMITS) {
            Bounded::Yes => {
                yes += 1;
                let Some(all) = all else { continue };
                let set = CoverabilitySet::new(&pt, &LIMITS).unwrap();
                for place in 0..pt.places.len() {
                    let most = all.iter().map(|it| it[place]).max().unwrap();
                    assert_eq!(set.bounds()[place], Tokens::from(most), "net {seed}");
                }
                let two = [PlaceId(0), PlaceId(1)];
                let most = all.iter().map(|it| u128::from(it[0]) + u128::from(it[1])).max();
                assert_eq!(set.bound(&two), most, "net {seed}");
                let fires = |it: u32| all.iter().any(|marking| pt.enabled(marking, it));
                let dead = (0..pt.transitions.len() as u32).filter(|&it| !fires(it));
                let said: Vec<u32> = set.dead_transitions().iter().map(|it| it.0).collect();
                assert_eq!(said, dead.collect::<Vec<_>>(), "net {seed}");
            }
            Bounded::No(growth) => {
                no += 1;
                assert_eq!(all, None, "net {seed}");
                pumps_ten_times(&pt, &growth);
            }
            Bounded::Unknown(unfinished) => panic!("net {seed}: {unfinished}"),
        }
    }
    eprintln!("{yes} bounded, {no} unbounded");
    assert!(yes > 1_000 && no > 1_000);
}

#[test]
fn coverable_markings_agree_with_the_backward_method() {
    let (mut yes, mut no) = (0, 0);
    for seed in 0..5_100 {
        let pt = random(seed);
        let mut draw = Draw(seed ^ 0xc0ff_ee00);
        let target: Vec<u64> =
            pt.places.iter().map(|_| [0, 0, 0, 1, 1, 2, 3][draw.below(7) as usize]).collect();
        let asked: Vec<(PlaceId, u64)> = (0..).map(PlaceId).zip(target.iter().copied()).collect();
        let Some(expected) = backward(&pt, &target) else { continue };
        match coverable(&pt, &asked, &LIMITS) {
            Coverable::Yes(way) => {
                assert!(expected, "net {seed}");
                let marking = end(&pt, &way);
                assert!(
                    marking.iter().zip(&target).all(|(&has, &needs)| u64::from(has) >= needs),
                    "net {seed}"
                );
                yes += 1;
            }
            Coverable::No => {
                assert!(!expected, "net {seed}");
                no += 1;
            }
            Coverable::Unknown(unfinished) => panic!("net {seed}: {unfinished}"),
        }
    }
    eprintln!("{yes} coverable, {no} not");
    assert!(yes + no >= 5_000 && yes > 1_000, "{yes} {no}");
}
