//! Promises of the statistics, against models that are solved exactly.

use cotama_campaign::statistics::{Decision, Sprt, clopper_pearson};
use cotama_sim::streams::Streams;

/// How often a test is wrong in so many trials, and its mean number of runs.
fn wrong(truth: f64, is_wrong: Decision, trials: u64) -> (u64, f64) {
    let (streams, bound) = (Streams::new(5), 1 << 32);
    let (mut wrong, mut runs) = (0, 0);
    for trial in 0..trials {
        let mut stream = streams.stream(&format!("trial {trial}"));
        let mut test = Sprt::new(0.01, 0.02, 0.95).unwrap();
        let decided = loop {
            let fails = (stream.below(bound) as f64) < truth * bound as f64;
            if let Some(it) = test.add(fails) {
                break it;
            }
        };
        wrong += u64::from(decided == is_wrong);
        runs += test.runs();
    }
    (wrong, runs as f64 / trials as f64)
}

#[test]
fn a_sequential_test_is_wrong_no_more_often_than_it_promises() {
    /// A promise of 0.05 is kept unless so many trials say otherwise with 99 % confidence.
    const TRIALS: u64 = 3_000;
    let (large, small) =
        (wrong(0.01, Decision::Large, TRIALS), wrong(0.02, Decision::Small, TRIALS));
    println!("wrong of {TRIALS} at 0.01: {large:?}, at 0.02: {small:?}");
    let kept = |wrong| clopper_pearson(wrong, TRIALS, 0.99).low <= 0.05;
    assert!(kept(large.0) && kept(small.0), "{large:?} {small:?}");
    // A test that decided at half of the evidence would not keep it.
    assert!(!kept(TRIALS / 10));
}

/// The coverage is summed over all numbers of hits, weighted by how likely they are.
#[test]
fn exact_intervals_cover_at_least_as_often_as_they_say() {
    for (runs, truth) in [(20_u64, 0.1_f64), (50, 0.02), (200, 0.5)] {
        let (mut covered, mut likely) = (0.0, libm::pow(1.0 - truth, f64::from(runs as u32)));
        for hits in 0..=runs {
            if clopper_pearson(hits, runs, 0.95).holds(truth) {
                covered += likely;
            }
            likely *= (runs - hits) as f64 / (hits + 1) as f64 * truth / (1.0 - truth);
        }
        assert!((0.95..1.0).contains(&covered), "{runs} {truth}: {covered}");
    }
}
