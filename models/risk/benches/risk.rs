//! Time of exact searches, one core, and of queries.
//!
//! `cargo bench -p cotama-risk --bench risk`; with `--test` it runs briefly.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_risk::{
    Constraints, Data, Families, Limits, Network, Plan, Score, Scratch, Variable, exact,
};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The least over several rounds of how many milliseconds `work` takes: others share the machine.
fn milliseconds(rounds: usize, mut work: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[0]
}

fn text(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// Rows of variables of two states, each a copy of two before it with noise.
fn binary(variables: usize, rows: usize) -> Data {
    let mut state = 7_u64;
    let mut draw = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    let mut columns = vec![Vec::new(); variables];
    for _ in 0..rows {
        for at in 0..variables {
            let of =
                |back: usize| at.checked_sub(back).map_or(0, |it| *columns[it].last().unwrap());
            let chance = 0.15 + 0.3 * f64::from(of(1)) + 0.35 * f64::from(of(3));
            columns[at].push(u16::from(draw() < chance));
        }
    }
    let states = vec!["0".to_owned(), "1".to_owned()];
    let named = |at| Variable { name: format!("v{at}"), states: states.clone() };
    Data::new((0..variables).map(named).collect(), columns).unwrap()
}

fn search(name: &str, data: &Data, rounds: usize) {
    for (label, score) in [("BIC", Score::Bic), ("BDeu", Score::Bdeu { ess: 10.0 })] {
        let none = Constraints::none(data.variables().len()).unwrap();
        let mut found = None;
        let taken = milliseconds(rounds, || {
            let mut families = Families::new(data, score);
            found = Some(black_box(exact(&mut families, &none, Limits::default()).unwrap()));
        });
        let found = found.unwrap();
        let (value, mib) = (found.score, found.bytes >> 20);
        println!("{name:<24} {label:<5} {taken:>9.2} ms  {value:.6}  {mib} MiB");
    }
}

fn query(name: &str, query: &str, evidence: &[(&str, &str)], rounds: usize) {
    let (net, _) = Network::from_bif(&text(name)).unwrap();
    let query = net.variable(query).unwrap();
    let evidence: Vec<_> = evidence.iter().map(|it| net.state(it.0, it.1).unwrap()).collect();
    let (given, states): (Vec<_>, Vec<_>) = evidence.iter().copied().unzip();
    let plan = Plan::new(&net, &[query], &given).unwrap();
    let (mut scratch, mut posterior) = (Scratch::default(), Vec::new());
    let each = 1000;
    let prepared = milliseconds(rounds, || {
        for _ in 0..each {
            let states = black_box(&states);
            plan.answer_in(&net, states, &mut scratch, &mut posterior).unwrap();
            black_box(&posterior);
        }
    });
    let whole = milliseconds(rounds, || {
        for _ in 0..each {
            black_box(net.infer(query, black_box(&evidence)).unwrap());
        }
    });
    println!("{name:<24} prepared {prepared:>7.3} us, from the start {whole:>7.3} us");
}

fn main() {
    let brief = std::env::args().skip(1).any(|argument| argument == "--test");
    let rounds = if brief { 1 } else { 9 };
    for name in ["cancer", "two_ways", "asia", "sixteen"] {
        search(name, &Data::from_csv(&text(&format!("{name}.csv"))).unwrap(), rounds);
    }
    if !brief {
        search("20 binary, 2,000 rows", &binary(20, 2_000), 3);
    }
    query("cancer.bif", "Cancer", &[("Xray", "positive"), ("Dyspnoea", "True")], rounds);
    query("asia.bif", "lung", &[("dysp", "yes"), ("xray", "yes")], rounds);
    let failed = [("status", "failed"), ("way", "short"), ("object_speed", "medium")];
    query("two_ways.bif", "ratio", &failed, rounds);
    query("sixteen.bif", "v5", &[("v9", "0"), ("v10", "1"), ("v14", "0")], rounds);
}
