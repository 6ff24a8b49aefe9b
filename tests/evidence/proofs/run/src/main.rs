//! Runs proof harnesses: `cotama-proofs [--table FILE] [NAME...]`.
//!
//! Each harness whose name holds one of the names is run, all without names. `--table` writes the
//! table of them. Exit status 1 when a harness fails, when a canary does not, or when one that is
//! listed as exhaustive was not, or the other way round.

mod canaries;
mod harnesses;
mod table;

use harnesses::{Listed, Word};
use kani::Report;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The name without what every name has.
fn short(name: &str) -> String {
    name.replace("cotama_", "").replace("::proofs::", "::")
}

/// Returns the sort key: a room before those in it.
fn by_room(name: &str) -> (String, String) {
    let (room, own) = name.rsplit_once("::").unwrap_or(("", name));
    (room.to_string(), own.to_string())
}

fn is_replay() -> bool {
    std::env::var_os("KANI_SHIM_REPLAY").is_some()
}

/// Checks that a harness did what it must.
fn verdict(listed: &Listed, report: &Report) -> Result<(), String> {
    match &report.failure {
        Some(_) if listed.harness.must_fail => Ok(()),
        Some(why) => Err(format!("FAILS: {why}")),
        None if listed.harness.must_fail => Err("HOLDS, and must fail: the engine is blind".into()),
        None if std::env::var_os("KANI_SHIM_RUNS").is_some() => Ok(()),
        None if is_replay() => Ok(()),
        None => match (listed.word, report.exhaustive) {
            (Word::Exhaustive, false) => Err("IS SAMPLED, and listed as exhaustive".into()),
            (Word::Sampled, true) => Err("IS EXHAUSTIVE, and listed as sampled".into()),
            _ => Ok(()),
        },
    }
}

fn line(listed: &Listed, report: &Report, time: Duration) -> String {
    let word = match report {
        _ if listed.harness.must_fail => "a canary, fails as it must".into(),
        Report { exhaustive: true, cases, .. } => format!("exhaustive ({cases} cases)"),
        Report { cases, .. } => format!("sampled ({cases} runs)"),
    };
    format!("{}: {word}, {} ms", short(listed.harness.name), time.as_millis())
}

fn main() -> ExitCode {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let table = names.iter().position(|it| it == "--table").map(|at| {
        names.remove(at);
        names.remove(at)
    });
    let wanted = |it: &Listed| {
        let name = short(it.harness.name);
        names.is_empty() || names.iter().any(|wanted| name.contains(wanted.as_str()))
    };
    let all: Vec<Listed> = harnesses::all().into_iter().filter(wanted).collect();
    if all.is_empty() {
        eprintln!("no harness has such a name");
        return ExitCode::from(2);
    }
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(listed) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
            let start = Instant::now();
            let report = kani::explore(&listed.harness);
            if let (true, Some(why)) = (is_replay(), &report.failure) {
                println!("{why}");
            }
            match verdict(listed, &report) {
                Ok(()) => println!("{}", line(listed, &report, start.elapsed())),
                Err(why) => println!("{}: {why}", short(listed.harness.name)),
            }
            done.lock().expect("no thread panics").push((listed, report));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        (0..threads).for_each(|_| _ = scope.spawn(work));
    });
    let mut done = done.into_inner().expect("no thread panics");
    done.sort_by_key(|it| by_room(&short(it.0.harness.name)));
    let failed = done.iter().filter(|it| verdict(it.0, &it.1).is_err()).count();
    println!("{} harnesses, {failed} not as they must be", done.len());
    if let Some(file) = table
        && let Err(error) = std::fs::write(&file, table::of(&done))
    {
        eprintln!("{file}: {error}");
        return ExitCode::from(2);
    }
    ExitCode::from(u8::from(failed > 0))
}
