//! Traces in which one thing is changed.

use crate::folder::{folder, load, text};
use cotama_streams::Streams;
use cotama_trees::conform::{Row, conform, read};
use cotama_trees::reader::Options;

/// Changes one thing in a row; `None` where there is nothing of the kind.
fn changed(row: &Row, how: usize, draw: &mut impl FnMut(usize) -> usize) -> Option<Row> {
    let mut row = row.clone();
    let mut words: Vec<String> = row.events.split(' ').map(str::to_owned).collect();
    match how {
        // A reply.
        0 => {
            let asked = |it: &&mut String| it.contains(['~', ':', '?']) && !it.contains('|');
            let mut all: Vec<_> = words.iter_mut().filter(asked).collect();
            let at = draw(all.len().max(1));
            let word = all.get_mut(at)?;
            let letter = word.pop()?;
            let letters: Vec<_> = if "TN".contains(letter) { "TN" } else { "SFRK" }
                .chars()
                .filter(|it| *it != letter)
                .collect();
            word.push(letters[draw(letters.len())]);
        }
        // A halt, left out or added.
        1 => match words.iter().position(|it| it.ends_with('!')) {
            Some(at) => drop(words.remove(at)),
            None => words.push("A1!".to_owned()),
        },
        // The order of two events.
        2 => {
            let at = draw(words.len().checked_sub(1).filter(|it| *it > 0)?);
            words.swap(at, at + 1);
        }
        // The status of the root.
        3 => {
            let others = ["S", "F", "R", "K"].into_iter().filter(|it| *it != row.status);
            let others: Vec<_> = others.collect();
            row.status = others[draw(others.len())].to_owned();
        }
        // An entry.
        _ => {
            if row.blackboard == "-" {
                return None;
            }
            row.blackboard += "1";
        }
    }
    row.events = words.join(" ");
    Some(row)
}

#[test]
fn five_thousand_traces_with_a_change_are_refused_at_it_or_later() {
    let Some(folder) = folder() else { return };
    let mut stream = Streams::new(46).stream("mutants");
    let mut draw = |below: usize| stream.below(below as u64) as usize;
    let mut traces = Vec::new();
    for line in text(&folder.join("traces/index.tsv")).lines().filter(|it| !it.starts_with('#')) {
        let columns: Vec<_> = line.split('\t').collect();
        if columns[0].starts_with("real/") {
            continue;
        }
        let file = |end: &str| folder.join(format!("traces/{}.{end}", columns[0]));
        let tree = load(&file("xml"), &Options::default()).unwrap().tree;
        traces.push((tree, columns[1] == "yes", read(&text(&file("tsv"))).unwrap()));
    }
    let (mut made, mut refused, mut same, mut other) = (0, 0, 0, 0);
    while made < 5_000 {
        let (tree, clock, rows) = &traces[draw(traces.len())];
        let at = draw(rows.len());
        let row = &rows[at];
        let how = draw(5);
        let Some(new) = changed(row, how, &mut draw) else { continue };
        made += 1;
        if new == *row {
            same += 1;
            continue;
        }
        let mut run: Vec<_> = rows.iter().filter(|it| it.run == row.run).cloned().collect();
        let place = run.iter().position(|it| it.line == row.line).unwrap();
        run[place] = new;
        match conform(tree, &run, *clock) {
            Err(departs) => {
                assert!(departs.row.line >= row.line, "{departs:?}");
                refused += 1;
            }
            // Another reply, and nothing else of the run shows it.
            Ok(_) => {
                assert_eq!(how, 0, "{:?}", run[place]);
                other += 1;
            }
        }
    }
    assert_eq!((refused, same, other), (4_899, 0, 101));
}
