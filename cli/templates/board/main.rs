//! Plays the supervisor on a microcontroller: `cargo run --release`.
//!
//! A timer counts milliseconds and wakes the processor; in between it sleeps. What the supervisor
//! does by itself it does when it is due. On a robot, events come from interrupts, and outputs
//! drive pins: `log` is the place for them.
#![no_std]
#![no_main]

use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::Peripherals;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{entry, exception};
use cotama_core::units::Millis;
use my_net::my_net::{Event, Firing, Player};
use semihosting::{print, println, process};

/// Ticks of the timer in a millisecond: the clock of the board in kHz.
const CLOCK_KHZ: u32 = 25_000;
/// Events offered, with their times in ms.
const EVENTS: [(u64, Event); 4] =
    [(0, Event::start), (80, Event::heard), (450, Event::heard), (500, Event::start)];

static NOW: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    NOW.store(NOW.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}

fn now() -> Millis {
    Millis(NOW.load(Ordering::Relaxed).into())
}

#[entry]
fn main() -> ! {
    let Some(core) = Peripherals::take() else { process::exit(1) };
    let mut timer = core.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(CLOCK_KHZ - 1);
    timer.clear_current();
    timer.enable_counter();
    timer.enable_interrupt();

    let mut log = |it: &Firing| {
        print!("{}: {:?}", it.at, it.transition());
        it.outputs().for_each(|output| print!(" {output:?}"));
        println!();
    };
    let mut supervisor = Player::new();
    for (at, event) in EVENTS {
        while now() < Millis(at) {
            // Due transitions fire now; then the processor sleeps until the next millisecond.
            let _ = supervisor.advance_with(now(), &mut log);
            cortex_m::asm::wfi();
        }
        let outcome = supervisor.offer_with(Millis(at), &event, &mut log);
        println!("{at} ms: {event:?} is offered: {outcome:?}");
    }
    println!("the supervisor is {:?}", supervisor.state());
    process::exit(0)
}
