//! The example, as its readers run it: a program that prints what is asserted here.

#[allow(dead_code)] // its `main` is for those who run it
#[path = "../../examples/run_with_fault.rs"]
mod run_with_fault;

#[test]
fn a_patrol_plans_anew_for_power_and_for_a_lost_laser_and_is_completed() {
    let mut out = Vec::new();
    run_with_fault::run(&mut out).expect("the patrol has a plan");
    let told = r#"   0 s    0 m  plan: start, 76 J to spare
 113 s   37 m  plan: energy margin below zero, 67 J to spare
 182 s   60 m  Fault { hardware: "laser", units_lost: 1, units_left: 1 }
 182 s   60 m  plan: one laser lost, 476 J to spare
 260 s   90 m  Obstacle { delay_ms: 5000 }
 532 s  187 m  completed
again, the same bytes: true
"#;
    assert_eq!(String::from_utf8_lossy(&out), told);
}
