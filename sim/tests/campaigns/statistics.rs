//! What the statistics promise, against models that are solved exactly.

use cotama_sim::campaign::rare::{Process, sampling, splitting};
use cotama_sim::campaign::statistics::{Decision, Sprt, clopper_pearson};
use cotama_sim::streams::{Stream, Streams};

/// A gambler with one coin: three steps up in ten, seven down; it ends at 0, or at the top.
struct Walk(u32);

impl Process for Walk {
    type State = u32;

    fn start(&self) -> u32 {
        1
    }

    fn step(&self, at: &mut u32, stream: &mut Stream) -> bool {
        *at = if stream.below(10) < 3 { *at + 1 } else { *at - 1 };
        *at == 0
    }

    fn level(&self, at: &u32) -> u32 {
        *at
    }

    fn top(&self) -> u32 {
        self.0
    }
}

impl Walk {
    /// The probability of the top: (r − 1) / (r^n − 1), r = 7/3 (the gambler's ruin).
    fn truth(&self) -> f64 {
        let ratio: f64 = 7.0 / 3.0;
        (ratio - 1.0) / (ratio.powi(self.0 as i32) - 1.0)
    }

    /// A walk of the opposite law, with its likelihood ratio and its steps.
    fn tilted(&self, stream: &mut Stream) -> (f64, u64) {
        let (mut at, mut steps, mut ratio) = (1, 0, 1.0);
        while at > 0 && at < self.0 {
            steps += 1;
            if stream.below(10) < 7 {
                (at, ratio) = (at + 1, ratio * 3.0 / 7.0);
            } else {
                (at, ratio) = (at - 1, ratio * 7.0 / 3.0);
            }
        }
        (if at == 0 { 0.0 } else { ratio }, steps)
    }
}

/// How many of so many repetitions cover the truth, and how much cheaper than plain sampling each
/// is: with splitting, and with importance sampling.
fn measured(top: u32, repetitions: u64) -> [(u64, f64); 2] {
    let walk = Walk(top);
    let truth = walk.truth();
    // A plain walk takes 1 / (0.7 − 0.3) steps on average, as it nearly always ends at 0.
    let plain = truth * (1.0 - truth) * 2.5;
    let (mut covered, mut work) = ([0; 2], [0.0; 2]);
    for seed in 0..repetitions {
        let both = [
            splitting(&walk, 200, 40, seed, 0.95),
            sampling(|stream| walk.tilted(stream), 2_000, seed, 0.95),
        ];
        for (at, it) in both.into_iter().enumerate() {
            covered[at] += u64::from(it.interval.holds(truth));
            work[at] += it.work / repetitions as f64;
        }
    }
    [0, 1].map(|at| (covered[at], plain / work[at]))
}

#[test]
fn intervals_of_rare_events_cover_the_truth() {
    let found = measured(14, 20);
    assert!(found.iter().all(|it| it.0 >= 17 && it.1 >= 10.0), "{found:?}");
}

#[test]
#[ignore = "a minute"]
fn of_a_hundred_intervals_for_rare_events_at_least_93_cover_the_truth() {
    for top in [14, 19] {
        let found = measured(top, 100);
        println!("p = {:.3e}: {found:?}", Walk(top).truth());
        assert!(found.iter().all(|it| it.0 >= 93 && it.1 >= 10.0), "{top} {found:?}");
    }
}

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

/// Of all numbers of hits, weighted by how likely they are.
#[test]
fn exact_intervals_cover_at_least_as_often_as_they_say() {
    for (runs, truth) in [(20_u64, 0.1_f64), (50, 0.02), (200, 0.5)] {
        let (mut covered, mut likely) = (0.0, (1.0 - truth).powi(runs as i32));
        for hits in 0..=runs {
            if clopper_pearson(hits, runs, 0.95).holds(truth) {
                covered += likely;
            }
            likely *= (runs - hits) as f64 / (hits + 1) as f64 * truth / (1.0 - truth);
        }
        assert!((0.95..1.0).contains(&covered), "{runs} {truth}: {covered}");
    }
}
