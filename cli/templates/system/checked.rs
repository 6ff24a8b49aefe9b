//! Promises of the system: `cargo test`.

use cotama_core::units::Millis;
use cotama_verification::assert_holds;
use my_system::my_system::{Event, Player, SYSTEM, state};
use my_system::{drive, link};

#[test]
fn the_motors_stand_when_the_operator_falls_silent() {
    let mut robot = Player::new();
    let start = Event::drive(drive::Event::start);
    assert!(robot.offer(Millis(0), &start).fired());
    let _ = robot.advance(Millis(499));
    assert_eq!(state::drive(&robot), drive::State::Running);
    let _ = robot.advance(Millis(500));
    assert_eq!(state::drive(&robot), drive::State::Stopped);
    assert_eq!(state::link(&robot), link::State::Silent);
}

/// The checker looks at all that can happen, in any order. Where a property does not hold, the test
/// shows a shortest way there.
#[test]
fn in_everything_that_can_happen_the_motors_never_run_unheard() {
    assert_holds!(SYSTEM, "AG !(drive.Running & link.Silent)");
    assert_holds!(SYSTEM, "AG EF drive.Running");
}
