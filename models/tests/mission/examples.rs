//! The example, as its readers run it: a program that prints what is asserted here.
#![cfg(feature = "std")]

#[allow(dead_code)] // its `main` is for those who run it
#[path = "../../examples/allocate_patrol.rs"]
mod allocate_patrol;

#[test]
fn the_patrol_is_read_split_and_planned() {
    let mut out = Vec::new();
    allocate_patrol::run(&mut out).expect("the patrol has a plan");
    let told = "\
9 objectives, 17 activities, 768288795144192 plans
 A1 to A1  M5 L2 up to 31000 mm
 A2 to A2  M1 L2 up to 34000 mm
 A3 to A3  M5 L2 up to 37000 mm
 A4 to A4  T1 L1 up to 37000 mm
 A5 to A5  D1    up to 37000 mm
 A6 to A6  T1 L1 up to 37000 mm
 A7 to A8  M1 L2 up to 63500 mm
 A9 to A9  M5 L2 up to 91500 mm
A10 to A10 M1 L2 up to 93500 mm
A11 to A11 T1 L1 up to 93500 mm
A12 to A12 D1    up to 93500 mm
A13 to A13 T1 L1 up to 93500 mm
A14 to A17 M5 L2 up to 187000 mm
527.924 s, 8627.514 J, quality 21830: no plan is better
";
    assert_eq!(String::from_utf8_lossy(&out), told);
}
