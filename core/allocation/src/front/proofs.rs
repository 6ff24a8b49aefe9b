//! The front against all plans of small problems.

use super::*;
use crate::problem::Candidate;
use cotama_units::proofs::few;

/// Whether these totals are no worse than those in anything.
fn beats(one: ([u64; 2], u64), other: ([u64; 2], u64)) -> bool {
    one.0[0] <= other.0[0] && one.0[1] <= other.0[1] && one.1 >= other.1
}

/// The front holds plans within the limits that no plan beats, each totals once, and one for every
/// totals that no plan beats.
#[kani::proof]
#[kani::unwind(8)]
pub fn the_front_has_the_points_that_nothing_beats() {
    let bit = || u32::from(few::<1>());
    let c = |energy: u32| Candidate { cost: [2 * bit() + bit(), energy], quality: bit(), id: 0 };
    let (a, b) = ([c(bit()), c(1)], [c(2 * bit()), c(1)]);
    let activities = [&a[..], &b[..]];
    let limits = [1 + 2 * u64::from(few::<1>()), 1 + u64::from(few::<1>())];
    let Ok(problem) = Problem::new(&activities, limits, [0, 1]) else { unreachable!() };
    let (mut nodes, mut plan) = ([Node::EMPTY; 16], [0; 2]);
    let mut front = Front::new(&mut nodes);
    let Ok(found) = front.find(&problem) else { unreachable!() };
    let on_front = |totals| (0..found.len()).any(|at| found.totals(at) == Some(totals));
    let mut some_beaten = false;
    for choices in [[0, 0], [0, 1], [1, 0], [1, 1]] {
        let Some(totals) = problem.totals(&choices) else { unreachable!() };
        let within = problem.within_limits(&totals.0);
        let is_beaten = (0..found.len())
            .filter_map(|at| found.totals(at))
            .any(|it| it != totals && beats(it, totals));
        assert!(on_front(totals) == (within && !is_beaten));
        some_beaten |= within && is_beaten;
    }
    for at in 0..found.len() {
        assert!(found.plan(at, &mut plan) && problem.totals(&plan) == found.totals(at));
        assert!((0..at).all(|before| found.totals(before) != found.totals(at)));
    }
    kani::cover!(found.len() >= 3, "three that differ");
    kani::cover!(some_beaten && found.len() == 1, "one beats another");
    kani::cover!(found.is_empty(), "none");
}

/// Memory that does not suffice is said, and never written beyond.
#[kani::proof]
#[kani::unwind(8)]
pub fn too_little_memory_is_said() {
    let c = |cost| Candidate { cost, quality: 0, id: 0 };
    let a = [c([u32::from(few::<2>()), u32::from(few::<2>())]), c([1, 2])];
    let activities = [&a[..], &a[..]];
    let Ok(problem) = Problem::new(&activities, [4, 4], [0, 1]) else { unreachable!() };
    let mut nodes = [Node::EMPTY; 8];
    let given = usize::from(few::<3>());
    let mut front = Front::new(&mut nodes[..given]);
    match front.find(&problem) {
        Ok(found) => assert!(found.len() <= given),
        Err(lacks) => {
            assert!(lacks.given == given && lacks.needed > given);
            kani::cover!(given > 1, "some, and not enough");
        }
    }
}
