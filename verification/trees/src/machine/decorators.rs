//! Decorators of the library and of Nav2.

use super::{Fault, Machine, Move, Status, Step, answer, fault, queues};
use crate::tree::{Answer, Gate, Kind, Number};

const CHILD: Step = Ok(Move::Child(0));

/// Begins the tick of a decorator; `None` if the node is none.
pub(super) fn enter(m: &mut Machine, node: usize, kind: &Kind) -> Option<Step> {
    Some(match kind {
        Kind::Inverter
        | Kind::ForceSuccess
        | Kind::ForceFailure
        | Kind::KeepRunningUntilFailure => {
            m.put_status(node, Status::Running);
            CHILD
        }
        Kind::SubTree { .. } => {
            if m.status(node) == Status::Idle {
                m.put_status(node, Status::Running);
            }
            CHILD
        }
        Kind::GoalUpdater => CHILD,
        Kind::Repeat { cycles } => begin(m, node, cycles, Answer::Success),
        Kind::RetryUntilSuccessful { attempts } => begin(m, node, attempts, Answer::Failure),
        Kind::Delay { msec } => delay(m, node, msec),
        Kind::Timeout { msec } => timeout(m, node, msec),
        Kind::RunOnce { then_skip } => match m.get(node, 0) {
            0 => {
                m.put_status(node, Status::Running);
                CHILD
            }
            _ if *then_skip => answer(Answer::Skipped),
            1 => answer(Answer::Success),
            _ => answer(Answer::Failure),
        },
        Kind::Precondition { condition, otherwise } => {
            if m.get(node, 0) == 0 {
                match m.holds(node, condition) {
                    Err(fault) => return Some(Err(fault)),
                    Ok(true) => m.set(node, 0, 1),
                    Ok(false) => return Some(answer(*otherwise)),
                }
            }
            CHILD
        }
        Kind::SkipUnlessUpdated { .. } => updated(m, node, Answer::Skipped),
        Kind::WaitValueUpdate { .. } => updated(m, node, Answer::Running),
        Kind::Loop { queue, value, if_empty } => {
            queues::enter(m, node, queue, value.as_deref(), *if_empty)
        }
        Kind::Gate(gate) => enter_gate(m, node, *gate),
        Kind::PathLongerOnApproach => {
            m.put_status(node, Status::Running);
            if m.get(node, 0) == 0 { Ok(Move::Ask) } else { not_longer(m, node) }
        }
        Kind::SingleTrigger => {
            if !m.is_active(node) {
                m.set(node, 0, 1);
            }
            m.put_status(node, Status::Running);
            if m.get(node, 0) == 1 { CHILD } else { answer(Answer::Failure) }
        }
        _ => return None,
    })
}

fn updated(m: &mut Machine, node: usize, otherwise: Answer) -> Step {
    if m.get(node, 1) == 0 {
        let fresh = m.get(node, 0) == 1;
        m.set(node, 0, 0);
        if !fresh {
            return answer(otherwise);
        }
    }
    CHILD
}

fn delay(m: &mut Machine, node: usize, msec: &Number) -> Step {
    let msec = m.needed(node, msec)?;
    if m.get(node, 0) == 0 {
        m.set(node, 0, 1);
        m.set(node, 2, 0);
        m.arm(node, msec);
        m.put_status(node, Status::Running);
    }
    if m.get(node, 2) == 0 { answer(Answer::Running) } else { CHILD }
}

fn timeout(m: &mut Machine, node: usize, msec: &Number) -> Step {
    let msec = m.needed(node, msec)?;
    if m.get(node, 0) == 0 {
        m.set(node, 0, 1);
        m.set(node, 1, 0);
        m.set(node, 2, 0);
        if msec > 0 {
            m.arm(node, msec);
        }
        m.put_status(node, Status::Running);
    }
    if m.get(node, 2) == 1 {
        m.set(node, 0, 0);
        return answer(Answer::Failure);
    }
    CHILD
}

/// Cells of the counting decorators: count, child was idle, limit read from an entry.
const COUNT: usize = 0;
const WAS_IDLE: usize = 1;
const LIMIT: usize = 2;

fn read_limit(m: &mut Machine, node: usize, number: &Number) -> Result<i64, Fault> {
    let limit = m.needed(node, number)?;
    if let Number::Entry(_) = number {
        m.set(node, LIMIT, limit as i32 as u32);
    }
    Ok(limit)
}

fn limit(m: &Machine, node: usize, number: &Number) -> i64 {
    match number {
        Number::Is(it) => *it,
        Number::Entry(_) => m.get(node, LIMIT) as i32 as i64,
    }
}

fn begin(m: &mut Machine, node: usize, number: &Number, last: Answer) -> Step {
    let limit = read_limit(m, node, number)?;
    m.put_status(node, Status::Running);
    again(m, node, limit, last)
}

/// Begins a round, or ends after the last one.
fn again(m: &mut Machine, node: usize, limit: i64, last: Answer) -> Step {
    if limit == -1 || (m.get(node, COUNT) as i64) < limit {
        let idle = !m.is_active(m.child(node, 0));
        m.set(node, WAS_IDLE, idle as u32);
        return CHILD;
    }
    m.set(node, COUNT, 0);
    answer(last)
}

fn counted(m: &mut Machine, node: usize, number: &Number, more: Answer, it: Answer) -> Step {
    if it == Answer::Running {
        return answer(it);
    }
    m.reset(m.child(node, 0))?;
    if it == Answer::Skipped {
        return answer(it);
    }
    if it != more {
        m.set(node, COUNT, 0);
        return answer(it);
    }
    let mut most = limit(m, node, number);
    let count = if most == -1 { 0 } else { m.get(node, COUNT) + 1 };
    m.set(node, COUNT, count);
    if more == Answer::Failure {
        most = read_limit(m, node, number)?;
    }
    if m.get(node, WAS_IDLE) == 1 && (most == -1 || (count as i64) < most) {
        m.wake = true;
        return answer(Answer::Running);
    }
    again(m, node, most, more)
}

/// Cells of a gate: first tick.
fn enter_gate(m: &mut Machine, node: usize, gate: Gate) -> Step {
    if !m.is_active(node) {
        m.set(node, 0, 1);
        m.begin_period(node);
    }
    m.put_status(node, Status::Running);
    let running = m.status(m.child(node, 0)) == Status::Running;
    if m.get(node, 0) == 0 && !running {
        let Gate::Rate { hertz } = gate else { return Ok(Move::Ask) };
        match m.over(node, hertz) {
            None => return Ok(Move::Ask),
            Some(false) => return answer(Answer::Running),
            Some(true) => {}
        }
    }
    m.set(node, 0, 0);
    CHILD
}

fn not_longer(m: &mut Machine, node: usize) -> Step {
    m.set(node, 0, 0);
    answer(Answer::Success)
}

/// Goes on after a decorator has looked at the world.
pub(super) fn looked(m: &mut Machine, node: usize, yes: bool) -> Step {
    match &m.tree.nodes[node].kind {
        Kind::Loop { value, if_empty, .. } => {
            queues::looked(m, node, value.as_deref(), *if_empty, yes)
        }
        _ if yes => CHILD,
        Kind::PathLongerOnApproach => answer(Answer::Success),
        _ => answer(Answer::Running),
    }
}

/// Takes the answer of the child.
pub(super) fn answered(m: &mut Machine, node: usize, kind: &Kind, it: Answer) -> Step {
    let child = m.child(node, 0);
    match kind {
        Kind::Inverter | Kind::ForceSuccess | Kind::ForceFailure => {
            if !it.is_done() {
                return answer(it);
            }
            m.reset(child)?;
            answer(match (kind, it) {
                (Kind::ForceSuccess, _) | (Kind::Inverter, Answer::Failure) => Answer::Success,
                _ => Answer::Failure,
            })
        }
        Kind::KeepRunningUntilFailure => {
            if it.is_done() {
                m.reset(child)?;
            }
            answer(if it == Answer::Failure { it } else { Answer::Running })
        }
        Kind::Repeat { cycles } => counted(m, node, cycles, Answer::Success, it),
        Kind::RetryUntilSuccessful { attempts } => counted(m, node, attempts, Answer::Failure, it),
        Kind::Delay { .. } | Kind::Timeout { .. } => {
            if it.is_done() {
                m.set(node, 0, 0);
                if let Kind::Timeout { .. } = kind {
                    m.set(node, 1, 0);
                }
                m.reset(child)?;
            }
            answer(it)
        }
        Kind::RunOnce { .. } => {
            if it.is_done() {
                m.set(node, 0, if it == Answer::Success { 1 } else { 2 });
                m.reset(child)?;
            }
            answer(it)
        }
        Kind::Precondition { .. } => {
            if it.is_done() {
                m.reset(child)?;
                m.set(node, 0, 0);
            }
            answer(it)
        }
        Kind::SkipUnlessUpdated { .. } | Kind::WaitValueUpdate { .. } => {
            m.set(node, 1, (it == Answer::Running) as u32);
            answer(it)
        }
        Kind::Loop { .. } => queues::answered(m, node, it),
        Kind::Gate(_) => {
            m.set(node, 0, 0);
            if it == Answer::Success {
                m.begin_period(node);
            }
            answer(it)
        }
        Kind::GoalUpdater => answer(it),
        Kind::SubTree { .. } | Kind::PathLongerOnApproach => {
            if it.is_done() {
                m.reset(child)?;
            }
            answer(it)
        }
        Kind::SingleTrigger => {
            if it.is_done() {
                m.set(node, 0, 0);
            }
            answer(it)
        }
        _ => fault("no tick is known for this node"),
    }
}
