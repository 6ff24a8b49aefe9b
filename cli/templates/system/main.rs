//! Plays the system: `cargo run`.

use cotama_core::units::Millis;
use my_system::my_system::{Event, Firing, Player, state};
use my_system::{drive, link};

fn main() {
    // Called for each transition that fires; on a robot this drives the motors.
    let mut log = |it: &Firing| {
        let says: Vec<_> = it.outputs().collect();
        println!("{}: {:?} {says:?}", it.at, it.transition());
    };
    let mut robot = Player::new();
    let start = Event::drive(drive::Event::start);
    let heard = Event::link(link::Event::heard);
    for (at, event) in [
        (0, start),
        (300, heard),
        (900, start),
        (950, heard),
        (1_000, start),
    ] {
        let outcome = robot.offer_with(Millis(at), &event, &mut log);
        println!("{at} ms: {event:?} is offered: {outcome:?}");
    }
    println!("the link is {:?}", state::link(&robot));
    println!("the drive is {:?}", state::drive(&robot));
}
