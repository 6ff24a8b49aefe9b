//! Control nodes of the library.

use super::parallel::{enter_parallel, enter_parallel_all, parallel, parallel_all};
use super::{Machine, Move, Status, Step, answer, child, choices, fault};
use crate::script::same;
use crate::tree::{Answer, Kind, Port};

/// Begins the tick of a control node; `None` if the node is none of the library.
pub(super) fn enter(m: &mut Machine, node: usize, kind: &Kind) -> Option<Step> {
    Some(match kind {
        Kind::Sequence { yields } | Kind::Fallback { yields } => {
            if !m.is_active(node) {
                m.set(node, SKIPPED, 0);
            }
            m.put_status(node, Status::Running);
            next(m, node, *yields)
        }
        Kind::SequenceWithMemory => {
            if !m.is_active(node) {
                m.set(node, SKIPPED, 0);
            }
            m.put_status(node, Status::Running);
            next(m, node, true)
        }
        Kind::ReactiveSequence | Kind::ReactiveFallback => {
            m.put_status(node, Status::Running);
            child(0)
        }
        Kind::Parallel { success, failure } => enter_parallel(m, node, success, failure),
        Kind::ParallelAll { failures } => enter_parallel_all(m, node, failures),
        Kind::IfThenElse => {
            if !(2..=3).contains(&m.children(node).len()) {
                return Some(fault("IfThenElse needs 2 or 3 children"));
            }
            m.put_status(node, Status::Running);
            child(m.get(node, 0) as usize)
        }
        Kind::WhileDoElse => {
            if !(2..=3).contains(&m.children(node).len()) {
                return Some(fault("WhileDoElse needs 2 or 3 children"));
            }
            m.put_status(node, Status::Running);
            child(0)
        }
        Kind::Switch { variable, cases } => enter_switch(m, node, variable.as_ref(), cases),
        Kind::TryCatch { .. } => {
            if !m.is_active(node) {
                m.set(node, SKIPPED, 0);
                m.set(node, CATCHING, 0);
            }
            m.put_status(node, Status::Running);
            try_next(m, node)
        }
        Kind::ManualSelector { repeats } => choices::enter_manual(m, node, *repeats),
        _ => return None,
    })
}

/// Takes the answer of a child of a control node; `None` if the node is none of the library.
pub(super) fn answered(
    m: &mut Machine,
    node: usize,
    kind: &Kind,
    at: usize,
    it: Answer,
) -> Option<Step> {
    Some(match kind {
        Kind::Sequence { yields } => sequence(m, node, it, *yields, Answer::Failure),
        Kind::Fallback { yields } => sequence(m, node, it, *yields, Answer::Success),
        Kind::SequenceWithMemory => sequence_with_memory(m, node, it),
        Kind::ReactiveSequence => reactive(m, node, at, it, Answer::Failure),
        Kind::ReactiveFallback => reactive(m, node, at, it, Answer::Success),
        Kind::Parallel { success, failure } => parallel(m, node, at, it, success, failure),
        Kind::ParallelAll { failures } => parallel_all(m, node, at, it, failures),
        Kind::IfThenElse => if_then_else(m, node, at, it),
        Kind::WhileDoElse => while_do_else(m, node, at, it),
        Kind::Switch { .. } => switch(m, node, at, it),
        Kind::TryCatch { .. } => try_catch(m, node, it),
        Kind::ManualSelector { .. } => choices::manual(m, node, at, it),
        _ => return None,
    })
}

/// Cells of a sequence: next child, how many were skipped, whether the child was idle.
const INDEX: usize = 0;
const SKIPPED: usize = 1;
const WAS_IDLE: usize = 2;

fn next(m: &mut Machine, node: usize, yields: bool) -> Step {
    let at = m.get(node, INDEX) as usize;
    if yields {
        let idle = !m.is_active(m.child(node, at));
        m.set(node, WAS_IDLE, idle as u32);
    }
    child(at)
}

fn sequence(m: &mut Machine, node: usize, it: Answer, yields: bool, stop: Answer) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    if it == stop {
        m.reset_children(node)?;
        m.set(node, INDEX, 0);
        return answer(it);
    }
    let go = if stop == Answer::Failure { Answer::Success } else { Answer::Failure };
    advance(m, node, it, yields, go)
}

/// Counts a child that was skipped. A node that failed and was not reset keeps its count, which
/// then grows without end; only whether it equals the number of children matters, so one more than
/// that stands for all larger ones.
fn skip(m: &mut Machine, node: usize, all: usize) {
    let count = (m.get(node, SKIPPED) + 1).min(all as u32 + 1);
    m.set(node, SKIPPED, count);
}

/// Goes to the next child, yields, or ends with `go`.
fn advance(m: &mut Machine, node: usize, it: Answer, yields: bool, go: Answer) -> Step {
    let count = m.children(node).len();
    let at = m.get(node, INDEX) + 1;
    m.set(node, INDEX, at);
    if it == Answer::Skipped {
        skip(m, node, count);
    } else if yields && m.get(node, WAS_IDLE) == 1 && (at as usize) < count {
        m.wake = true;
        return answer(Answer::Running);
    }
    if (at as usize) < count {
        return next(m, node, yields);
    }
    let all = m.get(node, SKIPPED) as usize == count;
    m.reset_children(node)?;
    m.set(node, INDEX, 0);
    m.set(node, SKIPPED, 0);
    answer(if all { Answer::Skipped } else { go })
}

fn sequence_with_memory(m: &mut Machine, node: usize, it: Answer) -> Step {
    match it {
        Answer::Running => answer(it),
        Answer::Failure => {
            for at in m.get(node, INDEX) as usize..m.children(node).len() {
                m.reset(m.child(node, at))?;
            }
            answer(it)
        }
        _ => advance(m, node, it, true, Answer::Success),
    }
}

/// Cell of a reactive node: a child was not skipped.
const SOME: usize = 0;

fn reactive(m: &mut Machine, node: usize, at: usize, it: Answer, stop: Answer) -> Step {
    if it != Answer::Skipped {
        m.set(node, SOME, 1);
    }
    if it == Answer::Running {
        // The new child has started; only now the old one is halted.
        for other in (0..m.children(node).len()).filter(|other| *other != at) {
            m.reset(m.child(node, other))?;
        }
        return answer(it);
    }
    if it == stop {
        m.reset_children(node)?;
        return answer(it);
    }
    if it == Answer::Skipped {
        m.reset(m.child(node, at))?;
    }
    if at + 1 < m.children(node).len() {
        return child(at + 1);
    }
    m.reset_children(node)?;
    let go = if stop == Answer::Failure { Answer::Success } else { Answer::Failure };
    answer(if m.get(node, SOME) == 0 { Answer::Skipped } else { go })
}

fn if_then_else(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    if at == 0 {
        let branch = match it {
            Answer::Success => 1,
            // The condition keeps its status.
            Answer::Failure if m.children(node).len() == 2 => return answer(it),
            Answer::Failure => 2,
            _ => return fault("the condition of IfThenElse was skipped"),
        };
        m.set(node, 0, branch);
        return child(branch as usize);
    }
    m.reset_children(node)?;
    m.set(node, 0, 0);
    answer(it)
}

fn while_do_else(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    let three = m.children(node).len() == 3;
    if at == 0 {
        match it {
            // A branch that runs is left running.
            Answer::Running => return answer(it),
            Answer::Success => {
                if three {
                    m.reset(m.child(node, 2))?;
                }
                return child(1);
            }
            Answer::Failure if three => {
                m.reset(m.child(node, 1))?;
                return child(2);
            }
            Answer::Failure => {}
            Answer::Skipped => {
                m.reset_children(node)?;
                return Ok(Move::Idle);
            }
        }
    } else if it == Answer::Running {
        return answer(it);
    }
    m.reset_children(node)?;
    answer(it)
}

/// Cell of a switch: the child that runs, from 1.
fn enter_switch(
    m: &mut Machine,
    node: usize,
    variable: Option<&Port>,
    cases: &[Option<Port>],
) -> Step {
    if m.children(node).len() != cases.len() + 1 {
        return fault(format!("Switch{} needs {} children", cases.len(), cases.len() + 1));
    }
    let mut found = cases.len();
    if let Some(value) = variable.and_then(|it| m.port(node, it)) {
        for (at, case) in cases.iter().enumerate() {
            let case = case.as_ref().and_then(|it| m.port(node, it));
            if case.is_some_and(|it| same(&value, &it)) {
                found = at;
                break;
            }
        }
    }
    let running = m.get(node, 0) as usize;
    if running != 0 && running != found + 1 {
        m.reset(m.child(node, running - 1))?;
    }
    child(found)
}

fn switch(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    m.set(node, 0, if it == Answer::Running { at as u32 + 1 } else { 0 });
    if it.is_done() {
        m.reset_children(node)?;
    }
    answer(it)
}

/// Third cell of a try: whether the last child catches.
pub(super) const CATCHING: usize = 2;

fn try_next(m: &mut Machine, node: usize) -> Step {
    let last = m.children(node).len() - 1;
    if m.get(node, CATCHING) == 1 {
        return child(last);
    }
    let at = m.get(node, INDEX) as usize;
    if at < last {
        return child(at);
    }
    let all = m.get(node, SKIPPED) as usize == last;
    m.reset_children(node)?;
    m.set(node, INDEX, 0);
    m.set(node, SKIPPED, 0);
    answer(if all { Answer::Skipped } else { Answer::Success })
}

fn try_catch(m: &mut Machine, node: usize, it: Answer) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    if m.get(node, CATCHING) == 1 {
        m.reset_children(node)?;
        m.set(node, INDEX, 0);
        m.set(node, CATCHING, 0);
        return answer(Answer::Failure);
    }
    if it == Answer::Failure {
        m.reset_children(node)?;
        m.set(node, INDEX, 0);
        m.set(node, CATCHING, 1);
    } else {
        m.set(node, INDEX, m.get(node, INDEX) + 1);
        if it == Answer::Skipped {
            skip(m, node, m.children(node).len() - 1);
        }
    }
    try_next(m, node)
}
