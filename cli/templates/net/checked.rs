//! Promises of the supervisor: `cargo test`.

use cotama_core::units::Millis;
use cotama_verification::assert_holds;
use my_net::PATIENCE;
use my_net::my_net::{Event, NET, Player, State};

#[test]
fn the_motors_stand_after_three_silences() {
    let mut supervisor = Player::new();
    assert!(supervisor.offer(Millis(0), &Event::start).fired());
    let last = u64::from(3 * PATIENCE);
    let _ = supervisor.advance(Millis(last - 1));
    assert_eq!(supervisor.state(), State::Running);
    let _ = supervisor.advance(Millis(last));
    assert_eq!(supervisor.state(), State::Lost);
}

/// The checker looks at all that can happen. Where a property does not hold, the test shows a
/// shortest way there.
#[test]
fn in_everything_that_can_happen_no_operator_is_lost_too_early() {
    assert_holds!(NET, "AG (Lost -> missed = 3)", "AG !(Running & Lost)");
}
