//! The power fails 500 times while the state is stored: each time the board really resets, and what
//! it restores is compared with what was written. The flash is RAM that survives the reset.
#![no_std]
#![no_main]

use board::Uart;
use core::mem::MaybeUninit;
use core::ptr::addr_of_mut;
use cortex_m::peripheral::SCB;
use cortex_m_rt::entry;
use robot::scenes::Power;
use robot::trace::{Sink, Trace};
use semihosting::println;

/// Memory that survives: whether it was begun, and the flash with the test's notes on it.
struct Kept {
    begun: u32,
    power: MaybeUninit<Power>,
}

const BEGUN: u32 = 0xB007_ED01;

#[unsafe(link_section = ".uninit.KEPT")]
static mut KEPT: MaybeUninit<Kept> = MaybeUninit::uninit();

struct Out(Uart);

impl Sink for Out {
    fn put(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.0.put(byte));
    }
}

#[entry]
fn main() -> ! {
    // SAFETY: the only reference to it; `begun` is a number whatever the RAM held.
    let kept = unsafe { &mut *addr_of_mut!(KEPT).cast::<Kept>() };
    if kept.begun != BEGUN {
        kept.power.write(Power::NEW);
        kept.begun = BEGUN;
    }
    // SAFETY: written by this boot or by one before: nothing else writes this memory.
    let power = unsafe { kept.power.assume_init_mut() };
    let mut out = Out(Uart::start());
    let mut trace = Trace::new(&mut out);
    if power.boots == 0 {
        trace.scene(7); // as the scene of this name begins
    }
    if power.boot(&mut trace) {
        SCB::sys_reset()
    }
    let [whole, anew, wrong] = power.counts;
    println!("{} boots: {whole} restored whole, {anew} started anew, {wrong} wrong", power.boots);
    board::exit(i32::from(wrong > 0))
}
