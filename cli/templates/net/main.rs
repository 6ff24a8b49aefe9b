//! Plays the supervisor and records the run in `log.jsonl`: `cargo run`.

use cotama_core::player::Recorder;
use cotama_core::units::Millis;
use my_net::my_net::{Event, Firing, Player, Program};

fn main() -> std::io::Result<()> {
    // Called for each transition that fires; on a robot this drives the motors.
    let mut act = |it: &Firing| {
        let says: Vec<_> = it.outputs().collect();
        println!("{}: {:?} {says:?}", it.at, it.transition());
    };
    // Writes what `cotama conform my-net.json log.jsonl` holds against the net.
    let mut recorder = Recorder::new(String::new());
    let mut supervisor: Player = recorder.start(Program, Millis(0));
    for (at, event) in [
        (0, Event::start),
        (80, Event::heard),
        (450, Event::heard),
        (500, Event::start),
    ] {
        let outcome = recorder.offer_with(&mut supervisor, Millis(at), &event, &mut act);
        println!("{at} ms: {event:?} is offered: {outcome:?}");
    }
    println!("the supervisor is {:?}", supervisor.state());
    std::fs::write("log.jsonl", recorder.into_inner())
}
