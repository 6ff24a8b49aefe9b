//! The timer of the core: SysTick, at 1 kHz.

use crate::CLOCK_HZ;
use core::cell::Cell;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;

static TICKS: AtomicU32 = AtomicU32::new(0);
static EVERY_TICK: Mutex<Cell<Option<fn(u64)>>> = Mutex::new(Cell::new(None));

/// Counts milliseconds.
#[derive(Debug)]
pub struct Timer {
    seen: u32,
}

impl Timer {
    /// Starts it.
    pub fn start(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(CLOCK_HZ / 1_000 - 1);
        timer.clear_current();
        timer.enable_counter();
        timer.enable_interrupt();
        Self { seen: 0 }
    }

    /// Sleeps until the next millisecond; one that has passed already is not skipped.
    pub fn wait(&mut self) {
        while TICKS.load(Ordering::Relaxed) == self.seen {
            cortex_m::asm::wfi();
        }
        self.seen = self.seen.wrapping_add(1);
    }

    /// Milliseconds since the start. They wrap after 49 days.
    pub fn now() -> u64 {
        TICKS.load(Ordering::Relaxed).into()
    }
}

/// Sets the action in the interrupt of each millisecond.
pub fn every_tick(act: fn(u64)) {
    free(|token| EVERY_TICK.borrow(token).set(Some(act)));
}

#[exception]
fn SysTick() {
    // One core, and no interrupt here is more urgent: load and store are enough; M0 has no more.
    let now = TICKS.load(Ordering::Relaxed).wrapping_add(1);
    TICKS.store(now, Ordering::Relaxed);
    if let Some(act) = free(|token| EVERY_TICK.borrow(token).get()) {
        act(now.into());
    }
}
