//! The cost of a piece of work.

use rustix::time::{ClockId, clock_gettime};
use std::time::Instant;

/// The figures counted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Markings, or classes.
    pub nodes: u64,
    /// Firings from one to another.
    pub edges: u64,
}

/// The figures counted, and their cost.
pub struct Measured {
    pub counts: Counts,
    /// Seconds on a processor, of all threads.
    pub processor: f64,
    /// Seconds by the clock.
    pub clock: f64,
}

/// Seconds that all threads of this process have been on a processor.
fn processor() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 / 1e9
}

/// Does it once.
pub fn measure(run: impl FnOnce() -> Counts) -> Measured {
    let (before, start) = (processor(), Instant::now());
    let counts = run();
    let clock = start.elapsed().as_secs_f64();
    Measured { counts, processor: processor() - before, clock }
}

/// Does it again and again for half a second on the processor, and takes the mean.
pub fn measure_often(mut run: impl FnMut() -> Counts) -> Measured {
    let (before, start) = (processor(), Instant::now());
    for times in 1.. {
        let counts = run();
        let spent = processor() - before;
        if spent >= 0.5 {
            let clock = start.elapsed().as_secs_f64() / f64::from(times);
            return Measured { counts, processor: spent / f64::from(times), clock };
        }
    }
    unreachable!("time passes")
}

/// The most memory that this process had at one time, in bytes.
pub fn peak() -> Result<u64, String> {
    let status = std::fs::read_to_string("/proc/self/status").map_err(|error| error.to_string())?;
    let line = status.lines().find_map(|it| it.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
    line.and_then(|it| it.parse::<u64>().ok()).map(|it| it << 10).ok_or("no VmHWM".to_owned())
}
