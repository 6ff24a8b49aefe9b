//! Loops over a queue: constants, a text on the blackboard, or what the world put there.

use super::{Fault, Machine, Move, Status, Step, fault};
use crate::script::{Value, number_of};
use crate::tree::{Answer, EntryType, Queue};

/// Cells: next item, or the number of the text that is left; the child runs.
const AT: usize = 0;
const RUNS: usize = 1;

/// Returns the items of a text as the library splits it: nothing follows the last separator.
pub(crate) fn items(text: &str) -> Vec<&str> {
    let mut items: Vec<&str> = text.split(';').collect();
    if items.last() == Some(&"") {
        items.pop();
    }
    items
}

/// Returns the value that an item is.
pub(crate) fn item(text: &str, kind: EntryType) -> Option<Value> {
    match kind {
        EntryType::Text => Some(Value::text(text)),
        EntryType::Integer => text.trim().parse().ok().map(Value::Integer),
        EntryType::Real => number_of(text).map(Value::Real),
        EntryType::Truth => match text {
            "1" | "true" | "True" | "TRUE" => Some(Value::Real(1.0)),
            "0" | "false" | "False" | "FALSE" => Some(Value::Real(0.0)),
            _ => None,
        },
    }
}

/// Begins the tick of a loop.
pub(super) fn enter(
    m: &mut Machine,
    node: usize,
    queue: &Queue,
    value: Option<&str>,
    if_empty: Answer,
) -> Step {
    if m.status(node) == Status::Idle {
        m.set(node, RUNS, 0);
        if let Queue::Items(_) = queue {
            m.set(node, AT, 0);
        }
    }
    if m.get(node, RUNS) == 1 {
        return begin(m, node);
    }
    let popped = match queue {
        Queue::Items(items) => {
            let at = m.get(node, AT);
            let item = items.get(at as usize).cloned();
            m.set(node, AT, at + item.is_some() as u32);
            item
        }
        Queue::Entry(key, kind) => match left(m, node, key, *kind)? {
            None => return Ok(Move::Ask),
            Some(text) => pop(m, node, &text, *kind)?,
        },
    };
    let Some(item) = popped else { return Ok(Move::Answer(if_empty)) };
    if let Some(key) = value {
        m.put(m.tree.nodes[node].board, key, &item);
    }
    begin(m, node)
}

fn begin(m: &mut Machine, node: usize) -> Step {
    if m.status(node) == Status::Idle {
        m.put_status(node, Status::Running);
    }
    Ok(Move::Child(0))
}

/// Returns what is left of a text; `None` where the tree itself has put nothing there.
fn left(m: &mut Machine, node: usize, key: &str, kind: EntryType) -> Result<Option<String>, Fault> {
    let kept = m.get(node, AT);
    if kept != 0 {
        return Ok(m.store.of_number(kept).map(Value::shown));
    }
    match m.read(m.tree.nodes[node].board, key) {
        None => Ok(None),
        Some(Value::Text(text)) => match items(&text).iter().find(|it| item(it, kind).is_none()) {
            Some(wrong) => fault(format!("`{wrong}` in entry {key} is no item of the queue")),
            None => Ok(Some(text.to_string())),
        },
        Some(_) => fault(format!("entry {key} holds a number, not a queue")),
    }
}

fn pop(m: &mut Machine, node: usize, text: &str, kind: EntryType) -> Result<Option<Value>, Fault> {
    let (first, rest) = text.split_once(';').unwrap_or((text, ""));
    let is_empty = text.is_empty();
    let rest = m.store.value(&Value::text(if is_empty { text } else { rest }));
    m.set(node, AT, rest);
    Ok(if is_empty { None } else { item(first, kind) })
}

/// Goes on when the world has said whether an item is left, of which nothing else is known.
pub(super) fn looked(
    m: &mut Machine,
    node: usize,
    value: Option<&str>,
    if_empty: Answer,
    yes: bool,
) -> Step {
    if !yes {
        return Ok(Move::Answer(if_empty));
    }
    if let Some(key) = value {
        let entry = m.entry(m.tree.nodes[node].board, key);
        m.touch(entry);
    }
    begin(m, node)
}

/// Takes the answer of the child.
pub(super) fn answered(m: &mut Machine, node: usize, it: Answer) -> Step {
    m.set(node, RUNS, (it == Answer::Running) as u32);
    if it.is_done() {
        m.reset(m.child(node, 0))?;
    }
    Ok(Move::Answer(if it == Answer::Failure { it } else { Answer::Running }))
}
