//! Plays the system and records the run in `log.jsonl`: `cargo run`.

use cotama_core::player::Recorder;
use cotama_core::units::Millis;
use my_system::my_system::{Event, Firing, Player, Program, state};
use my_system::{drive, link};

fn main() -> std::io::Result<()> {
    // Called for each transition that fires; on a robot this drives the motors.
    let mut act = |it: &Firing| {
        let says: Vec<_> = it.outputs().collect();
        println!("{}: {:?} {says:?}", it.at, it.transition());
    };
    // Writes the run down, one JSON object a line.
    let mut recorder = Recorder::new(String::new());
    let mut robot: Player = recorder.start(Program, Millis(0));
    let start = Event::drive(drive::Event::start);
    let heard = Event::link(link::Event::heard);
    for (at, event) in [
        (0, start),
        (300, heard),
        (900, start),
        (950, heard),
        (1_000, start),
    ] {
        let outcome = recorder.offer_with(&mut robot, Millis(at), &event, &mut act);
        println!("{at} ms: {event:?} is offered: {outcome:?}");
    }
    println!("the link is {:?}", state::link(&robot));
    println!("the drive is {:?}", state::drive(&robot));
    std::fs::write("log.jsonl", recorder.into_inner())
}
