//! A supervisor on a board that loses its power: `cargo run -p cotama-core --example supervisor`.
//!
//! The motors may run while the operator's radio is heard. The main loop sleeps until something is
//! heard or the supervisor wants to be woken. Before its power is gone the board stores the
//! supervisor; when it is back, the supervisor goes on where it was, its timer too.

use cotama_core::net;
use cotama_core::player::{Checked, Firing, Names, Observer, Snapshot};
use cotama_core::units::Millis;

/// So long may the radio be silent, ms.
const SILENCE: u32 = 500;

net! {
    /// Stops the motors while the operator's radio is silent.
    pub mod link {
        places { Up: 1, Down }
        events { heard }
        outputs { motors_on, motors_off }
        transitions {
            still on heard: Up => Up;
            lose: Up => Down emit motors_off within SILENCE..=SILENCE ms;
            recover on heard: Down => Up emit motors_on;
        }
        laws { handles(all); deadlock_free; always_can(Up); }
    }
}

/// The outputs of the supervisor, with their times.
struct Motors(Vec<(Millis, link::Output)>);

impl<P: Names<Output = link::Output>> Observer<P> for Motors {
    fn on_fire(&mut self, firing: &Firing<'_, P>) {
        for output in firing.outputs() {
            match output {
                link::Output::motors_on => println!("{}: the motors run", firing.at),
                link::Output::motors_off => println!("{}: the motors stand", firing.at),
            }
            self.0.push((firing.at, output));
        }
    }
}

/// Events that the board meets.
enum Meets {
    Radio,
    /// The last that the capacitors allow for is to store the supervisor.
    NoPower {
        until: Millis,
    },
}
const TABLE: [(Millis, Meets); 4] = [
    (Millis(300), Meets::Radio),
    (Millis(700), Meets::NoPower { until: Millis(5_000) }),
    (Millis(5_300), Meets::Radio),
    (Millis(6_000), Meets::Radio),
];

/// The supervisor as it was stored, or as it starts. What was stored may be anything, so only a
/// player that checks every firing goes on with it.
fn boot(flash: &[u8], now: Millis) -> link::Checked {
    let stored = Snapshot::read(flash);
    let program = Checked(link::Program);
    let restored = stored.map(|it| link::Checked::restore(program, now, &it));
    match restored {
        Some(Ok(supervisor)) => supervisor,
        Some(Err(_)) | None => link::Checked::start(program, now, &mut ()),
    }
}

/// Runs the program; returns what the motors were told.
pub(crate) fn run() -> Vec<(Millis, link::Output)> {
    // One word of marking, one clock.
    let mut flash = [0; Snapshot::<1, 1>::BYTES];
    let mut motors = Motors(Vec::new());
    let mut supervisor = boot(&flash, Millis(0));
    for (at, meets) in TABLE {
        while let Some(due) = supervisor.wake_at().filter(|&due| due <= at) {
            let _ = supervisor.advance_with(due, &mut motors);
        }
        match meets {
            Meets::Radio => {
                let outcome = supervisor.offer_with(at, &link::Event::heard, &mut motors);
                assert!(outcome.fired(), "law `handles(all)`");
            }
            Meets::NoPower { until } => {
                let _ = supervisor.advance_with(at, &mut motors);
                let _ = supervisor.snapshot().write(&mut flash);
                supervisor = boot(&flash, until);
            }
        }
    }
    println!("{}: the link is {:?}", supervisor.now(), supervisor.state());
    motors.0
}

fn main() {
    run();
}
