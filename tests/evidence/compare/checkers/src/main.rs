//! Counts reachable markings or state classes once, by one program, and says what it took.
//!
//! ```text
//! checkers nothing
//! checkers markings (cotama | cotama-2 | array-bfs | array-dfs | vec-bfs) NET
//! checkers classes (cotama | libpetri | linear) NET
//! ```
//!
//! It prints nodes, edges, markings, seconds on a processor, seconds by the clock, and the most
//! bytes that the process had. Exit status 2: the program cannot express the net, or did not end.

mod by_libpetri;
mod by_stateright;
mod measure;
mod nets;

use by_libpetri::Translated;
use by_stateright::{Search, by_array, by_vec};
use cotama_verification::explicit::{self, statespace};
use cotama_verification::pt::Pt;
use cotama_verification::tpn::{self, TimeNet};
use measure::{Counts, Measured, measure, measure_often, peak};
use std::process::ExitCode;

/// After so many classes libpetri is stopped.
const MOST_CLASSES: usize = 200_000;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[&str]) -> Result<String, String> {
    let (measured, markings) = match *arguments {
        ["nothing"] => (measure(|| Counts { nodes: 0, edges: 0 }), 0),
        ["markings", by, net] => {
            let measured = explored(by, &nets::untimed(net)?)?;
            let markings = measured.counts.nodes;
            (measured, markings)
        }
        ["classes", by, net] => classes(by, &nets::timed(net)?)?,
        _ => {
            return Err("give `nothing`, `markings PROGRAM NET` or `classes PROGRAM \
                NET`"
                .to_owned());
        }
    };
    let Measured { counts: Counts { nodes, edges }, processor, clock } = measured;
    Ok(format!("{nodes} {edges} {markings} {processor:.9} {clock:.9} {}", peak()?))
}

fn explored(by: &str, pt: &Pt) -> Result<Measured, String> {
    match by {
        "cotama" => ours(pt, 1),
        "cotama-2" => ours(pt, 2),
        "array-bfs" => by_array(pt, Search::Breadth),
        "array-dfs" => by_array(pt, Search::Depth),
        "vec-bfs" => by_vec(pt, Search::Breadth),
        _ => Err(format!("`{by}` goes through no markings")),
    }
}

fn ours(pt: &Pt, jobs: usize) -> Result<Measured, String> {
    let mut limit = None;
    let measured = measure(|| {
        let space = statespace(pt, &explicit::Limits::default(), jobs, &|_| ());
        limit = space.limit;
        Counts { nodes: space.states, edges: space.arcs }
    });
    limit.map_or(Ok(measured), |limit| Err(format!("stopped: {limit:?}")))
}

/// Returns the figures of classes, and how many markings they have. The graphs are kept and freed
/// within the time.
fn classes(by: &str, net: &TimeNet) -> Result<(Measured, u64), String> {
    match by {
        "cotama" => {
            let limits = tpn::Limits::default();
            let graph = tpn::classes(net, &limits);
            if let Some(limit) = graph.stopped() {
                return Err(format!("stopped: {limit:?}"));
            }
            let count = || {
                let graph = tpn::classes(net, &limits);
                Counts { nodes: graph.classes() as u64, edges: graph.edges() as u64 }
            };
            Ok((measure_often(count), graph.markings() as u64))
        }
        "libpetri" => {
            let translated = Translated::new(net)?;
            let graph = translated.classes(MOST_CLASSES)?;
            let markings = graph.reachable_markings().len() as u64;
            let count = || {
                let Ok(graph) = translated.classes(MOST_CLASSES) else {
                    unreachable!("it ended before")
                };
                by_libpetri::counts(&graph)
            };
            Ok((measure_often(count), markings))
        }
        // Measured once: it is for its counts only.
        "linear" => Ok((measure(|| by_libpetri::linear(net)), 0)),
        _ => Err(format!("`{by}` knows no state classes")),
    }
}
