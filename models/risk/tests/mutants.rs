//! 60,000 mutants of the files: no reader panics or hangs, a refusal has its place, and a file that
//! is accepted is written and read again. A failure prints the number of its mutant.

use crate::common::text;
use cotama_fuzz::split_mix;
use cotama_risk::{Cells, Data, Network, Rule, Wrong, discretise};

/// The first bytes of a file, a few of them changed, moved or taken from elsewhere.
fn mutant(text: &str, number: u64) -> String {
    let mut state = number;
    let mut bytes = text.as_bytes()[..text.len().min(3_000)].to_vec();
    let pieces = ["-1", "1e999", "nan", "\"", "/*", "(", "{", "]", "<", "&", ",", "|", "\n", "é"];
    for _ in 0..1 + number % 3 {
        let mut below = |end: usize| (split_mix(&mut state) % end.max(1) as u64) as usize;
        let (at, length) = (below(bytes.len()), below(40));
        let end = (at + length).min(bytes.len());
        match below(5) {
            0 => drop(bytes.drain(at..end)),
            1 => {
                let copy = bytes[at..end].to_vec();
                let to = below(bytes.len());
                bytes.splice(to..to, copy);
            }
            2 => bytes.truncate(at),
            3 => drop(bytes.splice(at..at, pieces[below(pieces.len())].bytes())),
            _ => bytes[at] ^= 1 << below(7),
        }
        if bytes.is_empty() {
            break;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A place of a refusal lies in the text.
fn lies_in(wrong: &Wrong, text: &str, number: u64) {
    let lines = text.split('\n').count();
    assert!(wrong.line <= lines && !wrong.message.is_empty(), "{number}: {wrong}");
}

#[test]
fn a_mutant_is_refused_at_its_place_or_reads_as_it_was_written() {
    let files = ["cancer_spelled_otherwise.bif", "dog_problem.bif", "two_ways.bif"];
    let mut accepted = 0;
    for number in 0..30_000 {
        let text = mutant(&text(files[number as usize % 3]), number);
        match Network::from_bif(&text) {
            Err(wrong) => lies_in(&wrong, &text, number),
            Ok((net, _)) => {
                let (again, _) = Network::from_bif(&net.to_bif()).unwrap();
                assert_eq!(again.nodes().len(), net.nodes().len(), "{number}");
                accepted += 1;
            }
        }
    }
    assert!(accepted > 1_000, "{accepted}");
    for number in 0..15_000 {
        let text = mutant(&text("cancer.xmlbif"), number);
        if let Err(wrong) = Network::from_xmlbif(&text) {
            lies_in(&wrong, &text, number);
        }
    }
}

#[test]
fn a_mutant_of_data_is_refused_or_has_all_its_cells() {
    let mut accepted = 0;
    let whole: String = text("sixteen.csv").split_inclusive('\n').take(60).collect();
    for number in 0..15_000 {
        let text = mutant(&whole, number);
        match Cells::parse(&text) {
            Err(wrong) => lies_in(&wrong, &text, number),
            Ok(cells) => {
                assert_eq!(Cells::parse(&cells.to_csv()).unwrap(), cells, "{number}");
                discretise(&cells, &Rule::Frequency { bins: 2 }).unwrap();
                let data: Data = cells.into_data().unwrap();
                assert!(data.variables().iter().all(|it| !it.states.is_empty()));
                accepted += 1;
            }
        }
    }
    assert!(accepted > 1_000, "{accepted}");
}
