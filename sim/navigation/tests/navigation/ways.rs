//! Ways of the lazy roadmap, held against the grid.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common::{RADIUS, clutter, hall, place};
use cotama_floor::{Footprint, Needs, Path, Planner, Pose, Surface};
use cotama_navigation::{NoWay, Roadmap, Sampling};
use cotama_streams::Streams;
use proptest::prelude::*;

const CELL: f64 = 0.05;

fn is_free(path: &Path, surface: &dyn Surface) -> bool {
    let disc = Footprint::disc(RADIUS);
    let mut lengths = (0..).map(|it| f64::from(it) * 0.01).take_while(|it| *it <= path.length());
    lengths.all(|it| surface.is_free(&disc, &Pose::new(path.pose(it).translation.vector, 0.0)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// The grid finds a way wherever a roadmap does for a radius that is two cells more.
    #[test]
    fn a_way_of_a_roadmap_is_free_and_known_to_the_grid(
        boxes in clutter(), from in place(), to in place(), seed: u64,
    ) {
        let floor = hall(&boxes);
        let streams = Streams::new(seed);
        let sampling = Sampling { samples: 300, near_m: 2.0, radius_m: RADIUS };
        if let Ok(path) = Roadmap::new(&floor, sampling, &streams).route(from, to) {
            prop_assert!(is_free(&path, &floor));
        }
        let wide = Sampling { radius_m: RADIUS + 2.0 * CELL, ..sampling };
        if Roadmap::new(&floor, wide, &streams).route(from, to).is_ok() {
            let needs = Needs { radius_m: RADIUS, liked_m: RADIUS, cell_m: CELL };
            prop_assert!(Planner::new(&floor, needs).unwrap().route(from, to).is_ok());
        }
    }
}

#[test]
fn a_wall_across_leaves_no_way_and_a_known_roadmap_asks_no_more() {
    let floor = hall(&[[4.0, 0.0, 0.5, 10.0]]);
    let sampling = Sampling { samples: 200, near_m: 2.0, radius_m: RADIUS };
    let mut roadmap = Roadmap::new(&floor, sampling, &Streams::new(1));
    let [left, right, top] = [[1.0, 5.0], [9.0, 5.0], [2.0, 9.0]].map(Into::into);
    assert_eq!(roadmap.route(left, right), Err(NoWay::InRoadmap));
    assert_eq!(roadmap.route([4.2, 5.0].into(), right), Err(NoWay::Start));
    assert_eq!(roadmap.route(left, [4.2, 5.0].into()), Err(NoWay::Goal));
    let way = roadmap.route(left, top).unwrap();
    // What is known stays known: but for the ends, the same way costs less.
    let before = roadmap.work();
    assert_eq!(roadmap.route(left, top), Ok(way));
    let again = roadmap.work().rays - before.rays;
    let first = {
        let mut fresh = Roadmap::new(&floor, sampling, &Streams::new(1));
        fresh.route(left, top).unwrap();
        fresh.work().rays
    };
    assert!(again <= first, "{again} {first}");
}
