//! Plays all scenes on the chip: the trace goes out over the UART, byte by byte that of the host,
//! and what it came to over semihosting.
#![no_std]
#![no_main]

use board::{Timer, Uart, stack_used};
use cortex_m::Peripherals;
use cortex_m_rt::entry;
use robot::scenes::{Memory, play_all};
use robot::trace::Sink;
use semihosting::println;

struct Out(Uart);

impl Sink for Out {
    fn put(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.0.put(byte));
    }
}

#[entry]
fn main() -> ! {
    board::set_up();
    let Some(core) = Peripherals::take() else { board::exit(103) };
    let Some(memory) = cortex_m::singleton!(: Memory = Memory::EMPTY) else { board::exit(103) };
    let mut timer = Timer::start(core.SYST);
    let mut out = Out(Uart::start());
    let (digest, bytes) =
        play_all(memory, &mut || timer.wait(), &mut out, |scene, numbers, (digest, bytes)| {
            let [first, second] = scene.says();
            let [a, b] = numbers;
            let name = scene.name();
            println!("{name}: {first} {a}, {second} {b}; {bytes} bytes, {digest:016x}");
        });
    println!("all: {bytes} bytes, {digest:016x}");
    println!("stack: {} bytes", stack_used());
    board::exit(0)
}
