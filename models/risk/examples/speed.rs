//! Time of one search or one query, for scripts that compare programs in turns
//! (`tests/evidence/compare/networks.py`).
//!
//!     speed learn bic|bdeu DATA.csv            milliseconds of an exact search, and its score
//!     speed ask NET.bif QUERY [NAME=STATE]...  microseconds of a query, prepared, from the start
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_risk::{Constraints, Data, Families, Limits, Network, Plan, Score, Scratch, exact};
use std::hint::black_box;
use std::time::Instant;

/// Queries of which the mean is taken.
const EACH: u32 = 2_000;

fn learn(score: &str, path: &str) {
    let score = if score == "bic" { Score::Bic } else { Score::Bdeu { ess: 10.0 } };
    let data = Data::from_csv(&std::fs::read_to_string(path).unwrap()).unwrap();
    let none = Constraints::none(data.variables().len()).unwrap();
    let start = Instant::now();
    let found = exact(&mut Families::new(&data, score), &none, Limits::default()).unwrap();
    println!("{:.3} {:.6}", start.elapsed().as_secs_f64() * 1e3, found.score);
}

fn microseconds(mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..EACH).for_each(|_| work());
    start.elapsed().as_secs_f64() * 1e6 / f64::from(EACH)
}

fn ask(path: &str, query: &str, evidence: &[String]) {
    let (net, _) = Network::from_bif(&std::fs::read_to_string(path).unwrap()).unwrap();
    let query = net.variable(query).unwrap();
    let pair = |it: &String| it.split_once('=').and_then(|it| net.state(it.0, it.1).ok());
    let evidence: Vec<_> = evidence.iter().map(|it| pair(it).unwrap()).collect();
    let (given, states): (Vec<_>, Vec<_>) = evidence.iter().copied().unzip();
    let plan = Plan::new(&net, &[query], &given).unwrap();
    let (mut scratch, mut posterior) = (Scratch::default(), Vec::new());
    let prepared = microseconds(|| {
        plan.answer_in(&net, black_box(&states), &mut scratch, &mut posterior).unwrap();
        black_box(&posterior);
    });
    let whole = microseconds(|| {
        black_box(net.infer(query, black_box(&evidence)).unwrap());
    });
    println!("{prepared:.4} {whole:.4}");
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["learn", score, path] => learn(score, path),
        ["ask", path, query, ..] => ask(path, query, &words[3..]),
        _ => println!("speed learn bic|bdeu DATA.csv, or speed ask NET.bif QUERY [NAME=STATE]..."),
    }
}
