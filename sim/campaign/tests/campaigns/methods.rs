//! Methods of giving out tasks over many seeds.

use cotama_campaign::methods::{Spread, compare};
use cotama_models::team::scenario::Method;
use cotama_sim::fleet::scenarios::{FleetOptions, fleet};

#[test]
#[ignore = "takes a minute"]
fn every_task_is_done_once_or_reported_over_a_thousand_seeds() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    for (number, loss_permille) in [10, 20, 50, 100, 200].into_iter().enumerate() {
        let seed = 1_000 * number as u64;
        let of = |seed, method| {
            fleet(&FleetOptions { seed, loss_permille, method, ..FleetOptions::default() })
        };
        let results = compare(&of, seed, 200, &[Method::Optimal], threads);
        let (ended, unsound) = (results[0].done + results[0].reported, results[0].unsound);
        assert_eq!((ended, unsound), (200 * 200, 0), "{loss_permille}: {results:?}");
        println!("{loss_permille}: {results:?}");
    }
}

#[test]
fn a_spread_is_a_mean_rounded_half_away_from_zero_and_a_width_rounded_up() {
    let of = |values: &[i64]| Spread::of(values).map(|it| (it.mean, it.half_width));
    assert_eq!(of(&[]), None);
    assert_eq!(of(&[7]), Some((7, 0)));
    // 2.5 and 1.96 times the root of 5/12, 1.27; 25 and 49 sharp.
    assert_eq!((of(&[1, 2, 3, 4]), of(&[-1, -2, -3, -4])), (Some((3, 2)), Some((-3, 2))));
    assert_eq!(of(&[0, 50]), Some((25, 49)));
}
