//! The executive of the optimal path following, on a timer of 1 kHz: jobs take ticks of it, and the
//! localisation hangs for a while.

use crate::robots::delivery::{TASKS, names};
use crate::trace::{Sink, Trace};
use cotama_core::executive::{Executive, Happening, Task, What};
use cotama_core::units::Micros;

/// So long is a tick of the timer, in microseconds.
pub const TICK_US: u64 = 1_000;
/// So many ticks are played.
pub const TICKS: u64 = 3_000;
/// The most tasks of a configuration.
const MOST: usize = 16;
/// In these ticks the localisation does not end its jobs.
const HANGS: core::ops::Range<u64> = 1_000..1_700;

pub(super) fn play(tick: &mut dyn FnMut(), trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let found = names::CONFIGURATIONS.iter().position(|it| *it == "PF.OPT");
    let tasks = found.and_then(|it| TASKS.get(it)).copied().unwrap_or_default();
    let localises = |it: &(u8, Task)| names::MODULES.get(usize::from(it.0)) == Some(&"MCL");
    let localisation = tasks.iter().position(localises);
    // Tasks that are left over take no time to speak of, once a day.
    let idle = Task::new(Micros(86_400_000_000), Micros(1));
    let mut all = [idle; MOST];
    all.iter_mut().zip(tasks).for_each(|(to, (_, task))| *to = *task);
    let Ok(mut executive) = Executive::new(all) else { return [0; 2] };
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
        let hangs = Some(task) == localisation && HANGS.contains(&ticks);
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
