//! The same firmware with the exact allocator in place of the rule.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use robot::patrol::{Tables, Workspace};

mod serve;

#[entry]
fn main() -> ! {
    let Some(tables) = cortex_m::singleton!(: Tables = Tables::EMPTY) else { board::exit(103) };
    let Some(workspace) = cortex_m::singleton!(: Workspace = Workspace::EMPTY) else {
        board::exit(103)
    };
    serve::serve(tables, Some(workspace))
}
