//! Counterexamples lose what they do not need.

use crate::diagnosis::nets;
use cotama_core::net::TransitionId;
use cotama_verification::diagnosis::{Run, shrink};
use cotama_verification::pt::Pt;

/// Numbers that look random, always the same ones.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }
}

/// So many firings, each of any enabled transition.
fn walk(pt: &Pt, random: &mut Random, steps: usize) -> Vec<TransitionId> {
    let (mut marking, mut fired) = (pt.initial.clone(), Vec::new());
    for _ in 0..steps {
        let enabled: Vec<u32> =
            (0..pt.transitions.len() as u32).filter(|it| pt.enabled(&marking, *it)).collect();
        if enabled.is_empty() {
            break;
        }
        let next = enabled[random.below(enabled.len())];
        marking = pt.fire(&marking, next).unwrap();
        fired.push(TransitionId(next));
    }
    fired
}

#[test]
fn a_long_walk_to_a_collision_becomes_the_four_firings_that_matter() {
    let pt = Pt::from(&nets::trains().view().net());
    let places = ["west_in_section", "east_in_section"].map(|it| pt.place(it).unwrap().0 as usize);
    let goal = |marking: &[u32]| places.iter().all(|it| marking[*it] > 0);
    let long = walk(&pt, &mut Random(1), 500);
    let short = shrink(&pt, &long, goal);
    assert!(long.len() > 400);
    let names: Vec<&str> = short.iter().map(|it| pt.transitions[it.0 as usize].as_str()).collect();
    assert_eq!(names, ["west_arrives", "east_arrives", "east_enters", "west_enters"]);
}

#[test]
fn a_shrunk_run_meets_the_goal_and_needs_every_firing() {
    let mut random = Random(7);
    let mut shorter = 0;
    for net in
        [nets::trains(), nets::mailbox(), nets::belts(), nets::server(), nets::philosophers()]
    {
        let pt = Pt::from(&net.view().net());
        for _ in 0..40 {
            let long = walk(&pt, &mut random, 60);
            let mut last = pt.initial.clone();
            Run::to(long.clone()).walk(&pt, |_, marking| last.copy_from_slice(marking)).unwrap();
            let place = random.below(last.len());
            let goal = |marking: &[u32]| marking[place] == last[place] && marking[0] == last[0];
            let short = shrink(&pt, &long, goal);
            assert_eq!(short, shrink(&pt, &long, goal));
            let meets = |trace: &[TransitionId]| {
                let mut end = pt.initial.clone();
                let walked =
                    Run::to(trace.to_vec()).walk(&pt, |_, marking| end.copy_from_slice(marking));
                walked.is_ok() && goal(&end)
            };
            assert!(meets(&short));
            for at in 0..short.len() {
                let mut less = short.clone();
                less.remove(at);
                assert!(!meets(&less));
            }
            shorter += usize::from(short.len() < long.len());
        }
    }
    assert!(shorter > 150, "{shorter}");
}

#[test]
fn a_sequence_that_cannot_fire_comes_back_unchanged() {
    let pt = Pt::from(&nets::trains().view().net());
    let no_run = [TransitionId(1), TransitionId(99)];
    assert_eq!(shrink(&pt, &no_run, |_| false), no_run);
    assert_eq!(shrink(&pt, &no_run, |_| true), []);
}
