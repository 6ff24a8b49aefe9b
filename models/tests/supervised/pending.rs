//! The queue of what supervisors are still to be told, by itself: no flood of events reaches it
//! through the component.

#[path = "../../src/cotama/decider/pending.rs"]
mod pending;

use pending::Pending;

#[test]
fn a_flood_loses_no_kind_of_failure() {
    let mut pending = Pending::default();
    (0..1_000).for_each(|it| pending.push("drift", it));
    pending.push("lose_vital", 1_000);
    assert!(!pending.is_empty());
    let told: Vec<_> = std::iter::from_fn(|| pending.pop()).collect();
    assert_eq!(told.last(), Some(&("lose_vital", 1_000)));
    assert!(told.len() <= 16 && told[0] == ("drift", 0));
}
