//! The executive of the optimal path following, on a timer of 1 kHz: jobs take ticks of it, and the
//! localisation hangs for a while.

use crate::control::executive;
use crate::trace::{Sink, Trace};
use cotama_core::executive::{Happening, What};
use cotama_core::units::Micros;

/// So long is a tick of the timer, in microseconds.
pub const TICK_US: u64 = 1_000;
/// So many ticks are played.
pub const TICKS: u64 = 3_000;
/// In these ticks the localisation, which is the last task, does not end its jobs.
const HANGS: core::ops::Range<u64> = 1_000..1_700;

pub(super) fn play(tick: &mut dyn FnMut(), trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let Some(mut executive) = executive() else { return [0; 2] };
    let last = executive.tasks().len() - 1;
    let mut counts = [0; 2];
    for ticks in 0..TICKS {
        tick();
        let now = Micros(ticks * TICK_US);
        while let Some(happening) = executive.step(now) {
            record(&happening, trace);
            if happening.rt_fault() {
                counts[1] += 1;
                if let Some(answered) = executive.acknowledge(happening.task, now) {
                    record(&answered, trace);
                }
            }
        }
        let Some(task) = executive.running() else { continue };
        let used = executive.used(task).unwrap_or(Micros::ZERO);
        let needed = executive.tasks()[task].cost.0 / 2;
        let hangs = task == last && HANGS.contains(&ticks);
        if used.0 >= needed
            && !hangs
            && let Ok(done) = executive.complete(task, now)
        {
            record(&done, trace);
            counts[0] += 1;
        }
    }
    counts
}

fn record(it: &Happening, trace: &mut Trace<'_, impl Sink>) {
    let what = match it.what {
        What::Released => 0,
        What::Done => 1,
        What::DoneLate { rt_fault } => 2 + u8::from(rt_fault),
        What::DeadlineMissed => 4,
        What::Exhausted => 5,
        What::Skipped { rt_fault } => 6 + u8::from(rt_fault),
        What::Acknowledged => 8,
        _ => 9,
    };
    trace.happening(it.at.0, it.task, what);
}
