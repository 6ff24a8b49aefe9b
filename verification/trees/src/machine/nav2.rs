//! Control nodes of Nav2.

use super::{Machine, Status, Step, answer, child, choices, fault};
use crate::script::Value;
use crate::tree::{Answer, Kind, Number};

/// Begins the tick of a control node of Nav2; `None` if the node is none.
pub(super) fn enter(m: &mut Machine, node: usize, kind: &Kind) -> Option<Step> {
    Some(match kind {
        Kind::PipelineSequence | Kind::NonblockingSequence => child(0),
        Kind::RecoveryNode { retries } => {
            if m.children(node).len() != 2 {
                return Some(fault("RecoveryNode needs 2 children"));
            }
            // What cannot be read is 1.
            let limit = m.integer(node, retries).filter(|it| *it >= 0).unwrap_or(1);
            if let Number::Entry(_) = retries {
                m.set(node, LIMIT, limit as u32);
            }
            m.put_status(node, Status::Running);
            try_or_recover(m, node, limit)
        }
        Kind::RoundRobin { .. } => {
            m.put_status(node, Status::Running);
            robin_next(m, node)
        }
        Kind::PersistentSequence { index } => {
            let at = match m.needed(node, &Number::Entry(index.clone())) {
                Ok(at) => at,
                Err(fault) => return Some(Err(fault)),
            };
            m.put_status(node, Status::Running);
            persistent_at(m, node, at, index)
        }
        Kind::PauseResumeController => choices::enter_pausing(m, node),
        _ => return None,
    })
}

/// Takes the answer of a child; `None` if the node is no control node of Nav2.
pub(super) fn answered(
    m: &mut Machine,
    node: usize,
    kind: &Kind,
    at: usize,
    it: Answer,
) -> Option<Step> {
    Some(match kind {
        Kind::PipelineSequence => pipeline(m, node, at, it),
        Kind::RecoveryNode { retries } => {
            let limit = match retries {
                Number::Is(it) => *it,
                Number::Entry(_) => m.get(node, LIMIT) as i64,
            };
            recovery(m, node, at, it, limit)
        }
        Kind::RoundRobin { wraps } => round_robin(m, node, it, *wraps),
        Kind::NonblockingSequence => nonblocking(m, node, at, it),
        Kind::PersistentSequence { index } => persistent(m, node, at, it, index),
        Kind::PauseResumeController => choices::pausing(m, node, it),
        _ => return None,
    })
}

/// Cells: furthest child that ran, and within a tick how many were skipped.
fn pipeline(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    let count = m.children(node).len();
    match it {
        Answer::Failure => {
            m.reset_children(node)?;
            m.set(node, 0, 0);
            return answer(it);
        }
        Answer::Skipped => m.set(node, 1, m.get(node, 1) + 1),
        Answer::Running if at >= m.get(node, 0) as usize => {
            m.set(node, 0, at as u32);
            return answer(it);
        }
        Answer::Running | Answer::Success => {}
    }
    if at + 1 < count {
        return child(at + 1);
    }
    let all = m.get(node, 1) as usize == count;
    m.reset_children(node)?;
    m.set(node, 0, 0);
    answer(if all { Answer::Skipped } else { Answer::Success })
}

/// Cells of a recovery: child, recoveries so far, limit that is an entry.
const CHILD: usize = 0;
const COUNT: usize = 1;
const LIMIT: usize = 2;

fn try_or_recover(m: &mut Machine, node: usize, limit: i64) -> Step {
    if m.get(node, COUNT) as i64 <= limit {
        return child(m.get(node, CHILD) as usize);
    }
    over(m, node, Answer::Failure)
}

/// Resets everything and answers.
fn over(m: &mut Machine, node: usize, it: Answer) -> Step {
    m.reset_children(node)?;
    m.put_status(node, Status::Idle);
    m.set(node, 0, 0);
    m.set(node, 1, 0);
    answer(it)
}

fn recovery(m: &mut Machine, node: usize, at: usize, it: Answer, limit: i64) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    if at == 0 {
        if it == Answer::Failure && (m.get(node, COUNT) as i64) < limit {
            m.reset(m.child(node, 0))?;
            m.set(node, CHILD, 1);
            return try_or_recover(m, node, limit);
        }
        if it == Answer::Success {
            m.reset(m.child(node, 1))?;
        }
        return over(m, node, it);
    }
    match it {
        // The number of recoveries is kept.
        Answer::Skipped => {
            m.set(node, CHILD, 0);
            m.reset(m.child(node, 1))?;
            answer(Answer::Failure)
        }
        Answer::Success => {
            m.reset(m.child(node, 1))?;
            m.set(node, CHILD, 0);
            m.set(node, COUNT, m.get(node, COUNT) + 1);
            try_or_recover(m, node, limit)
        }
        _ => over(m, node, Answer::Failure),
    }
}

/// Cells of a round: next child, failures; within a tick how many were skipped.
const NEXT: usize = 0;
const FAILURES: usize = 1;
const SKIPPED: usize = 2;

fn robin_next(m: &mut Machine, node: usize) -> Step {
    let count = m.children(node).len();
    if (m.get(node, FAILURES) + m.get(node, SKIPPED)) as usize >= count {
        return robin_over(m, node);
    }
    let at = m.get(node, NEXT) as usize;
    if at >= count { fault("RoundRobin has no next child") } else { child(at) }
}

fn robin_over(m: &mut Machine, node: usize) -> Step {
    let all = m.get(node, SKIPPED) as usize == m.children(node).len();
    over(m, node, if all { Answer::Skipped } else { Answer::Failure })
}

fn round_robin(m: &mut Machine, node: usize, it: Answer, wraps: bool) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    let next = m.get(node, NEXT) + 1;
    let last = next as usize == m.children(node).len();
    m.set(node, NEXT, if last && wraps { 0 } else { next });
    match it {
        // Without wrap_around the SUCCESS of the last child is lost.
        Answer::Success if !last || wraps => {
            m.set(node, FAILURES, 0);
            m.reset_children(node)?;
            return answer(it);
        }
        Answer::Failure => m.set(node, FAILURES, m.get(node, FAILURES) + 1),
        Answer::Skipped => m.set(node, SKIPPED, m.get(node, SKIPPED) + 1),
        _ => {}
    }
    if last && !wraps { robin_over(m, node) } else { robin_next(m, node) }
}

/// Cell within a tick: a child runs.
fn nonblocking(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    match it {
        Answer::Failure => {
            m.reset_children(node)?;
            return answer(it);
        }
        Answer::Skipped => return fault("a child of NonblockingSequence was skipped"),
        Answer::Running => m.set(node, 0, 1),
        Answer::Success => {}
    }
    if at + 1 < m.children(node).len() {
        return child(at + 1);
    }
    if m.get(node, 0) == 1 {
        return answer(Answer::Running);
    }
    m.reset_children(node)?;
    answer(Answer::Success)
}

fn write_index(m: &mut Machine, node: usize, index: &str, at: usize) {
    m.put(m.tree.nodes[node].board, index, &Value::Integer(at as i64));
}

fn persistent_at(m: &mut Machine, node: usize, at: i64, index: &str) -> Step {
    if at < 0 {
        return fault(format!("entry {index} is {at}, below 0"));
    }
    if (at as usize) < m.children(node).len() {
        return child(at as usize);
    }
    m.reset_children(node)?;
    write_index(m, node, index, 0);
    answer(Answer::Success)
}

fn persistent(m: &mut Machine, node: usize, at: usize, it: Answer, index: &str) -> Step {
    match it {
        Answer::Running => answer(it),
        Answer::Failure => {
            m.reset_children(node)?;
            write_index(m, node, index, 0);
            answer(it)
        }
        Answer::Success | Answer::Skipped => {
            write_index(m, node, index, at + 1);
            persistent_at(m, node, at as i64 + 1, index)
        }
    }
}
