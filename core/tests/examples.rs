//! The examples, as their readers run them: each is a program that prints what is asserted here.

#[allow(dead_code)] // its `main` is for those who run it
#[path = "../examples/allocate.rs"]
mod allocate;
#[allow(dead_code, missing_docs)]
#[path = "../examples/board.rs"]
mod board;
#[allow(dead_code, missing_docs)]
#[path = "../examples/supervisor.rs"]
mod supervisor;
#[allow(dead_code, missing_docs)]
#[path = "../examples/system.rs"]
mod system;

use cotama_core::units::Millis;

#[test]
fn an_allocation_is_planned_watched_and_planned_again() {
    let plans = allocate::run().expect("the mission has a plan");
    assert_eq!(plans, [vec![2, 1, 0], vec![2, 0, 1], vec![0, 0]]);
}

#[test]
fn a_supervisor_stops_the_motors_in_time_and_goes_on_after_a_loss_of_power() {
    use supervisor::link::Output::{motors_off, motors_on};
    let told = [
        (Millis(5_100), motors_off),
        (Millis(5_300), motors_on),
        (Millis(5_800), motors_off),
        (Millis(6_000), motors_on),
    ];
    assert_eq!(supervisor::run(), told);
}

#[test]
fn an_arm_grips_each_part_a_camera_sees_or_says_that_it_did_not() {
    let belt = system::run();
    assert_eq!(belt.gripped, [(Millis(100), 100), (Millis(500), 90)]);
    assert_eq!(belt.passed, [180, 190]);
    assert_eq!(belt.refused, [200]);
}

#[test]
fn a_board_stops_its_pump_in_time_and_counts_the_interrupt_that_it_lost() {
    let mut out = Vec::new();
    board::run(&mut out).unwrap();
    let told = "204 ms: run\n1911 ms: stand\n2500 ms: run\n5500 ms: stand\n5500 ms: alarm\n\
                7000 ms: Off, lost 1\n";
    assert_eq!(String::from_utf8_lossy(&out), told);
}
