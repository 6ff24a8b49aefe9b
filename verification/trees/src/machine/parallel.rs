//! Parallel nodes: thresholds over children that end at different ticks.

use super::{Fault, Machine, Status, Step, answer, child, fault};
use crate::tree::{Answer, Number};

/// Returns a threshold: below 0 it counts from the end.
fn threshold(limit: i64, children: usize) -> i64 {
    if limit < 0 { (children as i64 + limit + 1).max(0) } else { limit }
}

fn keep(m: &mut Machine, node: usize, cell: usize, number: &Number) -> Result<i64, Fault> {
    let limit = m.needed(node, number)?;
    if let Number::Entry(_) = number {
        m.set(node, cell, limit as i32 as u32);
    }
    Ok(limit)
}

fn kept(m: &Machine, node: usize, cell: usize, number: &Number) -> i64 {
    match number {
        Number::Is(it) => *it,
        Number::Entry(_) => m.get(node, cell) as i32 as i64,
    }
}

/// Cells of a parallel node: one for each child that is complete, then successes, failures; within
/// a tick how many were skipped, and the thresholds that are entries.
pub(super) fn enter_parallel(
    m: &mut Machine,
    node: usize,
    success: &Number,
    failure: &Number,
) -> Step {
    let count = m.children(node).len();
    let wanted = keep(m, node, count + 3, success)?;
    let fatal = keep(m, node, count + 4, failure)?;
    if threshold(wanted, count).max(threshold(fatal, count)) > count as i64 {
        return fault("a threshold is larger than the number of children");
    }
    m.put_status(node, Status::Running);
    parallel_from(m, node, 0, success, failure)
}

/// Goes on at a child; those that are complete only have their thresholds looked at.
fn parallel_from(
    m: &mut Machine,
    node: usize,
    from: usize,
    success: &Number,
    failure: &Number,
) -> Step {
    let count = m.children(node).len();
    for at in from..count {
        if m.get(node, at) == 0 {
            return child(at);
        }
        if let Some(it) = parallel_ends(m, node, success, failure)? {
            return answer(it);
        }
    }
    let all = m.get(node, count + 2) as usize == count;
    answer(if all { Answer::Skipped } else { Answer::Running })
}

fn parallel_ends(
    m: &mut Machine,
    node: usize,
    success: &Number,
    failure: &Number,
) -> Result<Option<Answer>, Fault> {
    let count = m.children(node).len();
    let wanted = kept(m, node, count + 3, success);
    let need = threshold(wanted, count);
    let limit = threshold(kept(m, node, count + 4, failure), count);
    let [successes, failures, skipped] = [0, 1, 2].map(|it| m.get(node, count + it) as i64);
    let end = if successes >= need || (wanted < 0 && successes + skipped >= need) {
        Answer::Success
    } else if (count as i64) - failures < need || failures == limit {
        Answer::Failure
    } else {
        return Ok(None);
    };
    for cell in 0..count + 2 {
        m.set(node, cell, 0);
    }
    m.reset_children(node)?;
    Ok(Some(end))
}

pub(super) fn parallel(
    m: &mut Machine,
    node: usize,
    at: usize,
    it: Answer,
    success: &Number,
    failure: &Number,
) -> Step {
    let count = m.children(node).len();
    let cell = match it {
        Answer::Skipped => Some(count + 2),
        Answer::Success => Some(count),
        Answer::Failure => Some(count + 1),
        Answer::Running => None,
    };
    if let Some(cell) = cell {
        m.set(node, cell, m.get(node, cell) + 1);
    }
    if it.is_done() {
        m.set(node, at, 1);
    }
    match parallel_ends(m, node, success, failure)? {
        Some(end) => answer(end),
        None => parallel_from(m, node, at + 1, success, failure),
    }
}

/// Cells: one for each child that is complete, then failures; within a tick how many were skipped,
/// and a threshold that is an entry.
pub(super) fn enter_parallel_all(m: &mut Machine, node: usize, failures: &Number) -> Step {
    let count = m.children(node).len();
    let limit = keep(m, node, count + 2, failures)?;
    if threshold(limit, count) > count as i64 {
        return fault("a threshold is larger than the number of children");
    }
    m.put_status(node, Status::Running);
    all_from(m, node, 0, failures)
}

fn all_from(m: &mut Machine, node: usize, from: usize, failures: &Number) -> Step {
    let count = m.children(node).len();
    if let Some(at) = (from..count).find(|at| m.get(node, *at) == 0) {
        return child(at);
    }
    let skipped = m.get(node, count + 1) as usize;
    if skipped == count {
        return answer(Answer::Skipped);
    }
    let complete = (0..count).filter(|at| m.get(node, *at) == 1).count();
    if skipped + complete < count {
        return answer(Answer::Running);
    }
    m.reset_children(node)?;
    let limit = threshold(kept(m, node, count + 2, failures), count);
    let failed = m.get(node, count) as i64 >= limit;
    for cell in 0..=count {
        m.set(node, cell, 0);
    }
    answer(if failed { Answer::Failure } else { Answer::Success })
}

pub(super) fn parallel_all(
    m: &mut Machine,
    node: usize,
    at: usize,
    it: Answer,
    failures: &Number,
) -> Step {
    let count = m.children(node).len();
    match it {
        Answer::Skipped => m.set(node, count + 1, m.get(node, count + 1) + 1),
        Answer::Running => {}
        Answer::Success | Answer::Failure => {
            m.set(node, at, 1);
            if it == Answer::Failure {
                m.set(node, count, m.get(node, count) + 1);
            }
        }
    }
    all_from(m, node, at + 1, failures)
}
