//! The examples, as their readers run them: each is a program that prints what is asserted here.

#[allow(dead_code)] // its `main` is for those who run it
#[path = "../examples/allocate.rs"]
mod allocate;

#[test]
fn an_allocation_is_planned_watched_and_planned_again() {
    let plans = allocate::run().expect("the mission has a plan");
    assert_eq!(plans, [vec![2, 1, 0], vec![2, 0, 1], vec![0, 0]]);
}
