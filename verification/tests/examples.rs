//! The examples, as their readers run them: each is a program that prints what is asserted here.

#[allow(dead_code, missing_docs)] // its `main` is for those who run it
#[path = "../examples/check_supervisor.rs"]
mod check_supervisor;
#[allow(dead_code, missing_docs)]
#[path = "../examples/property_test.rs"]
mod property_test;

#[test]
fn a_forgotten_guard_is_found_its_counterexample_verified_and_the_guarded_net_holds() {
    let mut out = Vec::new();
    check_supervisor::run(&mut out).expect("the supervisor is checked");
    let told = "\
4 markings, 7 arcs, 0 dead
AG !(Current & Away): Holds(false) (stubborn)
  1. arrive on contact
  2. charge on start
  3. leave on go
verified: false by a trace of 3 firings
guarded: true
";
    assert_eq!(String::from_utf8_lossy(&out), told);
}

/// 500 ms is the planted number.
#[test]
fn random_events_find_the_cover_that_opens_too_early_and_shrink_to_three() {
    let mut out = Vec::new();
    property_test::run(&mut out).expect("it prints");
    let told = "\
after 0 ms: start
after 0 ms: stop
after 500 ms: start
mended: no case found
";
    assert_eq!(String::from_utf8_lossy(&out), told);
}
