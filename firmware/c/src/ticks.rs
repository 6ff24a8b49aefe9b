//! Counters of milliseconds of 32 bits, widened.

use crate::error::{Done, cotama_error};
use crate::memory::Pieces;
use cotama_core::ticks::Ticks32;
use cotama_core::units::Millis;

/// A counter of milliseconds of 32 bits, which begins anew after 49.7 days, on its way to times of
/// 64 bits, which do not: `cotama_ticks ticks = {first_count};`
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_ticks {
    /// The latest time, ms: at first the first count.
    pub latest_ms: u64,
}

/// The time of a count, ms: the nearest to the latest one that has these low 32 bits.
///
/// A count that was read before another one and is told after it has its own, earlier time. Ask at
/// least every 24 days. Ticks of another length are widened in the same way, to ticks.
///
/// # Safety
/// The pointers are null or point to what their types say; no other thread uses the ticks.
// SAFETY: no other function of the program has this name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_ticks_widen(
    ticks: *mut cotama_ticks,
    count: u32,
    now_ms: *mut u64,
) -> cotama_error {
    let widen = || {
        let mut pieces = Pieces::new();
        // SAFETY: the caller promises the same.
        let ((was, ticks), now) = unsafe { (pieces.change(ticks)?, pieces.out(now_ms)?) };
        let mut wide = Ticks32::going_on_at(Millis(was.latest_ms));
        now.put(wide.widen(count).0);
        ticks.put(cotama_ticks { latest_ms: wide.latest().0 });
        Ok(())
    };
    Done::into(widen())
}
