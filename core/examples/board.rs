//! A supervisor on a board: `cargo run -p cotama-core --example board`.
//!
//! A pump fills a tank. Interrupts do one thing: they put an event and its tick into a queue of
//! four. The main loop wakes at each tick, offers what is in the queue, lets time pass, and drives
//! the pump's pin. `firmware` uses no std, no heap and no floating point; here a table of
//! interrupts and a list of pins stand for the board.

use cotama_core::units::Millis;
use std::io::{self, Write};

mod firmware {
    use core::mem;
    use cotama_core::net;
    use cotama_core::player::{Firing, Names, Observer};
    use cotama_core::units::Millis;

    /// So often the timer wakes the main loop, ms.
    pub(crate) const TICK: u64 = 10;

    net! {
        /// Fills a tank, and never runs for longer than three seconds.
        pub mod pump {
            constants { LONGEST: 3_000 }
            places { Off: 1, Running, Fault }
            events { low, full, reset }
            outputs { run, stand, alarm }
            transitions {
                fill on low:    Off => Running emit run;
                end on full:    Running => Off emit stand;
                give_up:        Running => Fault emit stand & alarm within LONGEST..=LONGEST ms;
                again on reset: Fault => Off;
            }
            ignore { low in Running & Fault; full in Off & Fault; reset in Off & Running; }
            laws { handles(all); deadlock_free; always_can(Off); }
        }
    }

    /// The events that interrupts leave to the main loop. A fifth event in one tick is counted, not
    /// kept.
    #[derive(Default)]
    pub(crate) struct Queue {
        events: [Option<(Millis, pump::Event)>; 4],
        filled: usize,
        pub(crate) lost: u32,
    }

    impl Queue {
        /// All that an interrupt does.
        pub(crate) fn interrupt(&mut self, at: Millis, event: pump::Event) {
            match self.events.get_mut(self.filled) {
                Some(free) => (*free, self.filled) = (Some((at, event)), self.filled + 1),
                None => self.lost += 1,
            }
        }
    }

    /// The pins of the board.
    pub(crate) trait Pins {
        fn set(&mut self, at: Millis, output: pump::Output);
    }

    /// The supervisor's outputs are pins.
    struct Drive<'p, T>(&'p mut T);

    impl<P: Names<Output = pump::Output>, T: Pins> Observer<P> for Drive<'_, T> {
        fn on_fire(&mut self, firing: &Firing<'_, P>) {
            firing.outputs().for_each(|output| self.0.set(firing.at, output));
        }
    }

    /// The body of the main loop, once a tick.
    pub(crate) fn tick(
        now: Millis,
        pump: &mut pump::Player,
        queue: &mut Queue,
        pins: &mut impl Pins,
    ) {
        // On a board, interrupts are off while the queue is taken.
        let events = mem::take(&mut queue.events);
        queue.filled = 0;
        for (at, event) in events.into_iter().flatten() {
            let _ = pump.offer_with(at, &event, &mut Drive(pins)); // law `handles(all)`
        }
        // Transitions due since the last tick fire with the time when they were due.
        let _ = pump.advance_with(now, &mut Drive(pins));
    }
}

use firmware::pump::{Event, Output, Player};

/// The board: pins are lines of text.
struct Board<W>(W, io::Result<()>);

impl<W: Write> firmware::Pins for Board<W> {
    fn set(&mut self, at: Millis, output: Output) {
        let written = writeln!(self.0, "{at}: {output:?}");
        self.1 = std::mem::replace(&mut self.1, Ok(())).and(written);
    }
}

/// The events of the sensors, with their times in ms. At 2.5 s a contact bounces; that filling
/// never gets full.
const INTERRUPTS: [(u64, Event); 9] = [
    (204, Event::low),
    (1_911, Event::full),
    (2_500, Event::low),
    (2_501, Event::low),
    (2_502, Event::low),
    (2_504, Event::low),
    (2_505, Event::low),
    (2_507, Event::low),
    (6_000, Event::reset),
];

/// Runs the board for seven seconds.
pub(crate) fn run(out: impl Write) -> io::Result<()> {
    let mut board = Board(out, Ok(()));
    let (mut pump, mut queue) = (Player::new(), firmware::Queue::default());
    let mut interrupts = INTERRUPTS.into_iter().peekable();
    for now in (0..=7_000).step_by(firmware::TICK as usize) {
        while let Some((at, event)) = interrupts.next_if(|it| it.0 <= now) {
            queue.interrupt(Millis(at), event);
        }
        firmware::tick(Millis(now), &mut pump, &mut queue, &mut board);
    }
    board.1?;
    writeln!(board.0, "{}: {:?}, lost {}", pump.now(), pump.state(), queue.lost)
}

fn main() -> io::Result<()> {
    run(io::stdout())
}
