//! Assumptions about answers of leaves, which remove false alarms.

use crate::diagnostic::nearest;
use crate::machine::{Machine, Reply};
use crate::tree::{Answer, Tree};

/// One assumption.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assumption {
    /// As it was written.
    pub text: String,
    /// Leaves that it is about.
    pub nodes: Vec<usize>,
    /// Answers that they do not give.
    pub never: Vec<Answer>,
    /// The entry until whose writing it holds: board, key.
    pub until: Option<(usize, String)>,
    /// Whether it has forbidden an answer.
    pub used: bool,
}

/// All assumptions of a question.
#[derive(Clone, Debug, Default)]
pub struct Assumptions {
    /// Each with its use.
    pub list: Vec<Assumption>,
    /// Time between two ticks in ms; without it timers go off when they like.
    pub period: Option<u32>,
    /// The cell that notes whether the entry of an assumption was written.
    cells: Vec<Option<usize>>,
    /// Leaves that write the entry of an assumption, with its cell.
    writers: Vec<(usize, usize)>,
}

/// Reads one assumption: `LEAF never K`, `LEAF succeeds`, `LEAF fails`, `LEAF ends`, each with
/// `until ENTRY written`; LEAF is a label, a tag, or `*` for all.
///
/// # Errors
///
/// Returns what is wrong, with the nearest name.
pub fn parse_assumption(tree: &Tree, text: &str) -> Result<Assumption, String> {
    let mut words = text.split_whitespace();
    let form =
        "LEAF never S|F|R|K, LEAF succeeds, LEAF fails, LEAF ends, each `until ENTRY written`";
    let name = words.next().ok_or_else(|| format!("an assumption reads {form}"))?;
    let leaves = tree.nodes.iter().enumerate().filter(|it| !it.1.is_built_in());
    let nodes: Vec<_> = leaves
        .clone()
        .filter(|(_, it)| name == "*" || it.label == name || it.name == name || it.tag == name)
        .map(|it| it.0)
        .collect();
    if nodes.is_empty() {
        let names = leaves.map(|it| it.1.label.as_str());
        return Err(match nearest(name, names) {
            Some(near) => format!("no leaf {name}; did you mean {near}?"),
            None => format!("no leaf {name}"),
        });
    }
    let never = match words.next() {
        Some("never") => {
            let letters = words.next().unwrap_or("");
            let answers: Option<Vec<_>> = letters
                .split('|')
                .map(|it| match it {
                    "S" | "SUCCESS" => Some(Answer::Success),
                    "F" | "FAILURE" => Some(Answer::Failure),
                    "R" | "RUNNING" => Some(Answer::Running),
                    "K" | "SKIPPED" => Some(Answer::Skipped),
                    _ => None,
                })
                .collect();
            answers.ok_or_else(|| format!("`{letters}` is none of S, F, R, K"))?
        }
        Some("succeeds") => vec![Answer::Failure, Answer::Skipped],
        Some("fails") => vec![Answer::Success, Answer::Skipped],
        Some("ends") => vec![Answer::Running],
        _ => return Err(format!("an assumption reads {form}")),
    };
    let until = match (words.next(), words.next(), words.next(), words.next()) {
        (None, ..) => None,
        (Some("until"), Some(entry), Some("written"), None) => {
            let writes = tree.nodes.iter().flat_map(|it| &it.writes);
            let found = writes.clone().find(|it| it.1 == entry);
            Some(found.cloned().ok_or_else(|| format!("no leaf writes an entry {entry}"))?)
        }
        _ => return Err(format!("an assumption reads {form}")),
    };
    Ok(Assumption { text: text.to_owned(), nodes, never, until, used: false })
}

impl Assumptions {
    /// Puts assumptions together.
    pub fn new(list: Vec<Assumption>) -> Assumptions {
        Assumptions { list, ..Assumptions::default() }
    }

    /// Lets ticks come every so many ms.
    #[must_use]
    pub fn every(mut self, ms: Option<u32>) -> Assumptions {
        self.period = ms;
        self
    }

    /// Makes a cell for each entry that an assumption waits for, and for each timer that counts.
    pub(crate) fn reserve(&mut self, machine: &mut Machine) {
        if let Some(ms) = self.period {
            machine.count(ms);
        }
        let mut known: Vec<((usize, String), usize)> = Vec::new();
        for it in &self.list {
            let cell = it.until.as_ref().map(|entry| {
                if let Some(it) = known.iter().find(|it| it.0 == *entry) {
                    return it.1;
                }
                let cell = machine.cells.len();
                machine.cells.push(0);
                machine.layout.widths.push(1);
                known.push((entry.clone(), cell));
                let nodes = machine.tree.nodes.iter().enumerate();
                let writers = nodes.filter(|it| it.1.writes.contains(entry));
                self.writers.extend(writers.map(|it| (it.0, cell)));
                cell
            });
            self.cells.push(cell);
        }
    }

    /// Returns whether a leaf may give this reply.
    pub(crate) fn allows(&mut self, node: usize, reply: Reply, cells: &[u32]) -> bool {
        let Reply::Leaf(answer) = reply else { return true };
        for (it, cell) in self.list.iter_mut().zip(&self.cells) {
            let holds = cell.is_none_or(|cell| cells[cell] == 0);
            if holds && it.nodes.contains(&node) && it.never.contains(&answer) {
                it.used = true;
                return false;
            }
        }
        true
    }

    /// Notes that a leaf has succeeded, and written what it writes.
    pub(crate) fn written(&self, node: usize, cells: &mut [u32]) {
        for (_, cell) in self.writers.iter().filter(|it| it.0 == node) {
            cells[*cell] = 1;
        }
    }
}
