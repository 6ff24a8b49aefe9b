//! Plays the supervisor: `cargo run`.

use cotama_core::units::Millis;
use my_net::my_net::{Event, Firing, Player};

fn main() {
    // Called for each transition that fires; on a robot this drives the motors.
    let mut log = |it: &Firing| {
        let says: Vec<_> = it.outputs().collect();
        println!("{}: {:?} {says:?}", it.at, it.transition());
    };
    let mut supervisor = Player::new();
    for (at, event) in [
        (0, Event::start),
        (80, Event::heard),
        (450, Event::heard),
        (500, Event::start),
    ] {
        let outcome = supervisor.offer_with(Millis(at), &event, &mut log);
        println!("{at} ms: {event:?} is offered: {outcome:?}");
    }
    println!("the supervisor is {:?}", supervisor.state());
}
