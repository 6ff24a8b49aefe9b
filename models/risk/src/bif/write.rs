//! The writer of BIF.

use crate::network::Network;
use std::fmt::Write;

impl Network {
    /// Writes the network in BIF, with each probability in as many digits as its double needs: read
    /// again, it is the same. A name that is no plain word stands in quotes.
    pub fn to_bif(&self) -> String {
        let mut text = format!("network {} {{\n}}\n", word(self.name()));
        for node in self.nodes() {
            let states: Vec<_> = node.variable.states.iter().map(|it| word(it)).collect();
            let (name, count) = (word(&node.variable.name), states.len());
            let states = states.join(", ");
            let _ = writeln!(
                text,
                "variable {name} {{\n  type discrete [ {count} ] {{ {states} }};\n}}"
            );
        }
        for node in self.nodes() {
            let variable = |it: &usize| &self.nodes()[*it].variable;
            let name = word(&node.variable.name);
            let rows = node.table.chunks(node.variable.states.len());
            if node.parents.is_empty() {
                let _ = writeln!(text, "probability ( {name} ) {{");
                rows.for_each(|row| {
                    let _ = writeln!(text, "  table {};", numbers(row));
                });
            } else {
                let parents: Vec<_> =
                    node.parents.iter().map(|it| word(&variable(it).name)).collect();
                let _ = writeln!(text, "probability ( {name} | {} ) {{", parents.join(", "));
                for (at, row) in rows.enumerate() {
                    let (mut at, mut states) = (at, Vec::new());
                    for parent in node.parents.iter().rev() {
                        let own = &variable(parent).states;
                        states.push(word(&own[at % own.len()]));
                        at /= own.len();
                    }
                    states.reverse();
                    let _ = writeln!(text, "  ({}) {};", states.join(", "), numbers(row));
                }
            }
            text.push_str("}\n");
        }
        text
    }
}

fn numbers(row: &[f64]) -> String {
    let numbers: Vec<_> = row.iter().map(|it| format!("{it:?}")).collect();
    numbers.join(", ")
}

/// A name as a word; in quotes if it would be read as more than one.
fn word(name: &str) -> String {
    let plain = |it: char| it.is_alphanumeric() || "_-.<>+*%".contains(it);
    if !name.is_empty() && name.chars().all(plain) {
        name.to_owned()
    } else {
        format!("\"{}\"", name.replace('"', "'"))
    }
}
