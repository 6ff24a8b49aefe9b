//! Whether a recorded run is one of the tree, and where it departs.
//!
//! The answers of the world stand in the trace; everything else is compared: the order of events,
//! the status of the root, the blackboards.

use crate::machine::{Machine, Reply, Stop};
use crate::script::parse;
use crate::tree::{NET, Tree};
use std::collections::VecDeque;

/// Ticks of the root within one `tickOnce`, after which it counts as spinning.
const SPIN: usize = 20;

/// A row of a trace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Line of the file, from 1.
    pub line: usize,
    /// Number of the run.
    pub run: String,
    /// Operation: `tick`, `once` or `halt`.
    pub op: Op,
    /// Milliseconds that pass before.
    pub wait: i64,
    /// Assignments from outside: name, value.
    pub set: Vec<(String, String)>,
    /// Events, separated by blanks; ticks of one `once` by bars.
    pub events: String,
    /// Status of the root.
    pub status: String,
    /// All entries.
    pub blackboard: String,
}

/// Operation on a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// `tickExactlyOnce`.
    Tick,
    /// `tickOnce`.
    Once,
    /// `haltTree`.
    Halt,
}

/// Reads a trace: eight columns, separated by tabs.
///
/// # Errors
///
/// Returns the line and the cause.
pub fn read(text: &str) -> Result<Vec<Row>, (usize, String)> {
    let mut rows = Vec::new();
    for (at, line) in text.lines().enumerate() {
        let fail = |why: String| Err((at + 1, why));
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let columns: Vec<&str> = line.split('\t').collect();
        let [run, _, op, wait, set, events, status, blackboard] = columns[..] else {
            return fail(format!(
                "{} columns, not 8: run step op wait set events status blackboard",
                columns.len()
            ));
        };
        let op = match op {
            "tick" => Op::Tick,
            "once" => Op::Once,
            "halt" => Op::Halt,
            _ => return fail(format!("op `{op}` is none of tick, once, halt")),
        };
        let Ok(wait @ 0..) = wait.parse::<i64>() else {
            return fail(format!("wait `{wait}` is no number of ms"));
        };
        let mut pairs = Vec::new();
        for pair in set.split(';').filter(|_| set != "-") {
            match pair.split_once('=') {
                Some((name, value)) => pairs.push((name.to_owned(), value.to_owned())),
                None => return fail(format!("set `{pair}` is no assignment")),
            }
        }
        rows.push(Row {
            line: at + 1,
            run: run.to_owned(),
            op,
            wait,
            set: pairs,
            events: events.to_owned(),
            status: status.to_owned(),
            blackboard: blackboard.to_owned(),
        });
    }
    Ok(rows)
}

/// Numbers of runs and rows that were accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Accepted {
    /// Runs.
    pub runs: usize,
    /// Rows.
    pub rows: usize,
}

/// The first row that is not what the tree does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Departure {
    /// The row.
    pub row: Row,
    /// The column that differs: `events`, `status`, `blackboard` or `set`.
    pub column: &'static str,
    /// Row of the tree there with the same answers.
    pub allowed: String,
    /// The question that the row does not answer, or answers with what is not allowed.
    pub asked: Option<String>,
}

/// Compares all runs of a trace with the tree.
///
/// ```
/// use cotama_trees::{conform, reader};
/// let loaded = reader::read_text(
///     r#"<root BTCPP_format="4"><BehaviorTree ID="Main"><Inverter><A1/></Inverter>
///     </BehaviorTree></root>"#,
/// ).unwrap();
/// let text = "1\t1\ttick\t0\t-\tA1:R\tR\t-\n1\t2\ttick\t0\t-\tA1~S\tS\t-\n";
/// let rows = conform::read(text).unwrap();
/// let departs = conform::conform(&loaded.tree, &rows, false).unwrap_err();
/// assert_eq!((departs.row.line, departs.column, departs.allowed.as_str()), (2, "status", "F"));
/// ```
///
/// # Errors
///
/// Returns the first row that differs.
pub fn conform(tree: &Tree, rows: &[Row], clock: bool) -> Result<Accepted, Box<Departure>> {
    let mut accepted = Accepted::default();
    let mut runs: Vec<&str> = Vec::new();
    for row in rows {
        if !runs.contains(&row.run.as_str()) {
            runs.push(&row.run);
        }
    }
    for run in runs {
        let rows = rows.iter().filter(|it| it.run == run);
        accepted.rows += one(tree, rows, clock)?;
        accepted.runs += 1;
    }
    Ok(accepted)
}

fn one<'r>(
    tree: &Tree,
    rows: impl Iterator<Item = &'r Row>,
    clock: bool,
) -> Result<usize, Box<Departure>> {
    let mut machine = if clock { Machine::with_clock(tree) } else { Machine::new(tree) };
    let mut accepted = 0;
    let mut over: Option<String> = None;
    for row in rows {
        let departs = |column, allowed: String, asked| {
            Err(Box::new(Departure { row: row.clone(), column, allowed, asked }))
        };
        if let Some(status) = over {
            return departs("status", format!("nothing: the run ended with {status}"), None);
        }
        machine.wait(row.wait);
        for (name, value) in &row.set {
            let script = parse(&format!("{name}:={value}")).map_err(|it| it.message);
            if let Err(why) = script.and_then(|it| machine.assign(&it)) {
                return departs("set", why, None);
            }
        }
        let done = step(&mut machine, row);
        let (events, status, asked) = match done {
            Ok((events, status)) => (events, status, None),
            Err((events, asked)) => (events, String::new(), Some(asked)),
        };
        if asked.is_some() || events != row.events {
            return departs("events", events, asked);
        }
        if status != row.status {
            return departs("status", status, None);
        }
        let blackboard = machine.blackboard();
        if blackboard != row.blackboard {
            return departs("blackboard", blackboard, None);
        }
        if status.starts_with('X') || status == "SPIN" {
            over = Some(status);
        }
        accepted += 1;
    }
    Ok(accepted)
}

/// Returns the replies that stand in the events of a row.
fn replies(events: &str) -> VecDeque<Reply> {
    let reply = |word: &str| {
        let mut end = word.chars().rev();
        let (letter, sign) = (end.next()?, end.next()?);
        ":~?".contains(sign).then(|| Reply::of_letter(letter))?
    };
    events.split([' ', '|']).filter_map(reply).collect()
}

/// Does what a row says, with its replies: events and status, or the question that it leaves open.
fn step(machine: &mut Machine, row: &Row) -> Result<(String, String), (String, String)> {
    let mut replies = replies(&row.events);
    let mut parts: Vec<String> = Vec::new();
    let tree = machine.tree;
    let shown = |machine: &mut Machine| {
        let events = machine.take_events();
        events.iter().map(|it| it.shown(tree)).collect::<Vec<_>>().join(" ")
    };
    let joined = |parts: &[String]| match parts.join("|") {
        it if it.is_empty() => "-".to_owned(),
        it => it,
    };
    loop {
        let halts = row.op == Op::Halt;
        let mut stop = if halts { machine.halt_tree() } else { machine.tick() };
        while let Stop::Asked(question) = stop {
            let reply = replies.pop_front();
            if let Some(reply) = reply.filter(|it| question.replies.contains(it)) {
                stop = machine.reply(reply);
                continue;
            }
            parts.push(shown(machine));
            let letters = question.replies.iter().map(|it| it.letter().to_string());
            let label = tree.nodes.get(question.node).map_or(NET, |it| &it.label);
            let letters = letters.collect::<Vec<_>>().join(" ");
            let asked = format!("{label}{} with one of {letters}", question.how.sign());
            return Err((joined(&parts), asked));
        }
        parts.push(shown(machine));
        let status = match stop {
            Stop::Answered(answer) => answer.letter().to_string(),
            Stop::Thrown(thrown) => match thrown.node {
                Some(node) if !halts => format!("X@{}", tree.nodes[node].name),
                _ => "X".to_owned(),
            },
            Stop::Asked(_) => String::new(),
            Stop::Halted => "H".to_owned(),
        };
        if row.op != Op::Once || status != "R" || !machine.take_wake() {
            return Ok((joined(&parts), status));
        }
        if parts.len() == SPIN {
            return Ok((joined(&parts), "SPIN".to_owned()));
        }
    }
}
