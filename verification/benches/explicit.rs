//! Times the explicit engine on families of nets: `cargo bench -p cotama-verification --bench
//! explicit`.
//!
//! `--net TEXT` keeps the nets whose name contains the text; `--jobs N` uses N threads; `--mib N`
//! is a limit of memory, for a single run; other arguments are more nets: files that end in
//! `.pnml`, and families with a number, as in `philosophers:20`. Times are the best of three: CPU
//! time of the whole process where the system tells it, in the form of Linux, else time by the
//! clock.

#![allow(clippy::cast_precision_loss)] // times need no more than a double's digits

use cotama_models::nets::families::{FMS, Family, KANBAN, PHILOSOPHERS, SWIMMING_POOL, TOKEN_RING};
use cotama_verification::explicit::{Graph, Limits, StateSpace, statespace};
use cotama_verification::pnml;
use cotama_verification::pt::Pt;
use std::ffi::OsStr;
use std::path::Path;
use std::time::Instant;

/// Nanoseconds on a processor of all threads that run now; those that ended are not counted.
fn on_processor() -> Option<u64> {
    let threads = std::fs::read_dir("/proc/self/task").ok()?;
    let nanoseconds = |thread: std::fs::DirEntry| {
        let text = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        text.split(' ').next()?.parse::<u64>().ok()
    };
    threads.map(|it| nanoseconds(it.ok()?)).sum()
}

/// Returns the result, and the seconds by the clock, and on a processor when there is one thread.
fn timed<T>(jobs: usize, times: usize, mut run: impl FnMut() -> T) -> (T, f64, f64) {
    let once = |_| {
        let (start, before) = (Instant::now(), on_processor());
        let found = run();
        let clock = start.elapsed().as_secs_f64();
        let processor = before.zip(on_processor()).filter(|_| jobs == 1);
        (found, clock, processor.map_or(clock, |(before, after)| (after - before) as f64 / 1e9))
    };
    (0..times).map(once).min_by(|a, b| a.2.total_cmp(&b.2)).expect("it runs at least once")
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let after = |flag: &str| {
        arguments.iter().position(|it| it == flag).and_then(|at| arguments.get(at + 1))
    };
    let only = after("--net").map_or("", String::as_str);
    let jobs = after("--jobs").map_or(1, |it| it.parse().expect("--jobs takes a number"));
    let bytes = after("--mib").map(|it| it.parse::<u64>().expect("--mib takes a number") << 20);
    let limits = bytes.map_or(Limits::default(), |bytes| Limits { bytes, ..Limits::default() });
    // The peak memory of the process is to be seen from outside: a second run would find memory
    // that the first one left.
    let times = if bytes.is_some() { 1 } else { 3 };
    let member = |(family, n): (&Family, u32)| {
        let net = family.net(n).expect("n is in the range of the family");
        (format!("{}({n})", family.name), Pt::from(&net.view().net()))
    };
    let families = [&KANBAN, &FMS, &PHILOSOPHERS, &SWIMMING_POOL, &TOKEN_RING];
    let asked = arguments.iter().filter_map(|it| {
        let (name, n) = it.split_once(':')?;
        Some((families.into_iter().find(|it| it.name == name)?, n.parse().ok()?))
    });
    let usual = families.into_iter().zip([5, 5, 12, 2]);
    let mut nets: Vec<(String, Pt)> = usual.into_iter().chain(asked).map(member).collect();
    for file in arguments.iter().filter(|it| Path::new(it).extension() == Some(OsStr::new("pnml")))
    {
        let bytes = std::fs::read(file).unwrap_or_else(|error| panic!("{file}: {error}"));
        let net = pnml::read(file, &bytes).unwrap_or_else(|errors| panic!("{errors}"));
        nets.push((file.clone(), Pt::from(&net.view().net())));
    }
    println!(
        "{:<20} {:>12} {:>12} {:>8} {:>8} {:>12} {:>8} {:>9} {:>9}",
        "net", "states", "arcs", "clock s", "CPU s", "states/s", "B/state", "peak MB", "graph s"
    );
    for (name, pt) in nets.iter().filter(|it| it.0.contains(only)) {
        let (space, clock, processor): (StateSpace, _, _) =
            timed(jobs, times, || statespace(pt, &limits, jobs, &|_| ()));
        let (graph, _, graph_seconds) =
            timed(1, times, || Graph::new(pt, &limits, &|_| ()).map(|it| it.states()));
        let end = match (space.limit, graph) {
            (None, Ok(states)) if states as u64 == space.states => String::new(),
            (limit, graph) => format!("  {limit:?} {graph:?}"),
        };
        println!(
            "{name:<20} {:>12} {:>12} {clock:>8.3} {processor:>8.3} {:>12.0} {:>8.1} {:>9.1} \
             {graph_seconds:>9.3}{end}",
            space.states,
            space.arcs,
            space.states as f64 / processor,
            space.bytes_per_state(),
            space.peak as f64 / f64::from(1 << 20),
        );
    }
}
