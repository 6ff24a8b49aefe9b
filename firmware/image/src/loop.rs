//! The robot's firmware: the control loop behind the UART, the state in flash, the watchdog, and
//! the patrol planned by the rule of the paper.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use robot::patrol::Tables;

mod serve;

#[entry]
fn main() -> ! {
    let Some(tables) = cortex_m::singleton!(: Tables = Tables::EMPTY) else { board::exit(103) };
    serve::serve(tables, None)
}
