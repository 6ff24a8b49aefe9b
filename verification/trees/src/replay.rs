//! Runs told again by the executor: what each tick does, as text and as frames of a picture.

use crate::explore::Run;
use crate::machine::{Machine, Stop};
use crate::tree::{Answer, Tree};

/// Record of one tick.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Events, as traces have them.
    pub events: Vec<String>,
    /// Status of the root after the tick: S, F, R, K, an exception, or `..` within a tick.
    pub status: String,
    /// Letter of each node's status after the tick: I, R, S, F.
    pub statuses: String,
    /// Letter of each node's answer within the tick: S, F, R, K, or `-` where it was not ticked.
    pub answers: String,
    /// All entries.
    pub blackboard: String,
    /// Places of the supervisor that are marked.
    pub marked: Vec<String>,
    /// Whether a wake-up is pending: `tickOnce` ticks again at once.
    pub wakes: bool,
}

/// Ticks a fresh tree with the replies of a run.
///
/// # Errors
///
/// Returns the tick, from 1, that does not take the replies: then the run is of another tree.
pub fn frames(tree: &Tree, run: &Run) -> Result<Vec<Frame>, usize> {
    let mut machine = match run.period {
        Some(ms) => Machine::with_period(tree, ms),
        None => Machine::new(tree),
    };
    let mut frames = Vec::new();
    for (at, step) in run.steps.iter().enumerate() {
        machine.said.fill(0);
        machine.take_wake();
        let mut stop = machine.tick();
        for &reply in &step.replies {
            match stop {
                Stop::Asked(question) if question.replies.contains(&reply) => {
                    stop = machine.reply(reply);
                }
                _ => return Err(at + 1),
            }
        }
        let status = match stop {
            Stop::Asked(question) if !step.whole => {
                format!(".. {} is asked", tree.shown(question.node))
            }
            Stop::Asked(_) => return Err(at + 1),
            Stop::Answered(answer) => answer.letter().to_string(),
            Stop::Halted => "H".to_owned(),
            Stop::Thrown(thrown) => match thrown.node {
                Some(node) => format!("X@{}: {}", tree.nodes[node].name, thrown.why),
                None => format!("X: {}", thrown.why),
            },
        };
        let events = machine.take_events();
        if events != step.events {
            return Err(at + 1);
        }
        let letters = [Answer::Skipped, Answer::Running, Answer::Failure, Answer::Success];
        let said = machine.said.iter().map(|said| {
            let found = letters.iter().find(|it| said >> **it as u8 & 1 == 1);
            found.map_or('-', |it| it.letter())
        });
        frames.push(Frame {
            events: events.iter().map(|it| it.shown(tree)).collect(),
            status,
            answers: said.collect(),
            statuses: (0..tree.nodes.len()).map(|it| machine.status(it).letter()).collect(),
            blackboard: machine.blackboard(),
            marked: machine.marked().into_iter().map(str::to_owned).collect(),
            wakes: machine.wake,
        });
    }
    Ok(frames)
}

/// Writes a run: one line a tick.
pub fn lines(tree: &Tree, run: &Run) -> Vec<String> {
    let Ok(frames) = frames(tree, run) else { return Vec::new() };
    let mut lines = Vec::new();
    for (at, frame) in frames.iter().enumerate() {
        if run.again_from == Some(at) {
            lines.push("again and again:".to_owned());
        }
        let events = match frame.events.join(" ") {
            it if it.is_empty() => "-".to_owned(),
            it => it,
        };
        lines.push(format!("{:>4}  {events} -> {}", at + 1, frame.status));
    }
    lines
}
