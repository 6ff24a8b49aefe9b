//! Leaves: those of the user, which the world answers for, and those of the library.

use super::{Event, Fault, How, Machine, Move, Question, Reply, Status, fault};
use crate::kinds::LeafKind;
use crate::tree::{Answer, Kind};

const ENDS: [Reply; 2] = [Reply::Leaf(Answer::Success), Reply::Leaf(Answer::Failure)];
const ENDS_OR_SKIPS: [Reply; 3] = [ENDS[0], ENDS[1], Reply::Leaf(Answer::Skipped)];
const ALL: [Reply; 4] =
    [ENDS[0], ENDS[1], Reply::Leaf(Answer::Running), Reply::Leaf(Answer::Skipped)];

/// Returns the question of a leaf.
pub(super) fn question(m: &Machine, node: usize, kind: LeafKind) -> Question {
    let runs = kind.runs() && m.status(node) == Status::Running;
    let replies: &[Reply] = match kind {
        LeafKind::Condition | LeafKind::Sync => &ENDS_OR_SKIPS,
        LeafKind::Stateful | LeafKind::Service => &ALL,
        LeafKind::Latch | LeafKind::FirstSuccess | LeafKind::FirstFailure => &ENDS,
    };
    Question { node, how: if runs { How::Goes } else { How::Starts }, replies }
}

/// Ticks a leaf of the user.
pub(super) fn enter(m: &mut Machine, node: usize, kind: LeafKind) -> Move {
    let itself = |m: &mut Machine, answer| {
        m.events.push(Event::Itself(node as u32, answer));
        Move::Answer(answer)
    };
    match (kind, m.status(node)) {
        (LeafKind::Stateful, Status::Success) => Move::Answer(Answer::Success),
        (LeafKind::Stateful, Status::Failure) => Move::Answer(Answer::Failure),
        (LeafKind::Latch, Status::Idle) => itself(m, Answer::Failure),
        (LeafKind::FirstSuccess | LeafKind::FirstFailure, _) if m.get(node, 0) == 0 => {
            m.set(node, 0, 1);
            let success = kind == LeafKind::FirstSuccess;
            itself(m, if success { Answer::Success } else { Answer::Failure })
        }
        _ => match m.tree.bond(node) {
            Some(bond) => m.enter_bound(node, bond),
            None => Move::Ask,
        },
    }
}

/// Halts a leaf that has something to stop; returns whether it was one.
pub(super) fn halted(m: &mut Machine, node: usize) -> bool {
    let running = m.status(node) == Status::Running;
    match &m.tree.nodes[node].kind {
        Kind::Leaf(kind) if kind.runs() => {
            if running {
                m.events.push(Event::Halted(node as u32));
                m.halt_bound(node);
            }
        }
        Kind::Sleep { .. } => {
            if running {
                m.set(node, 0, 0);
                m.set(node, 1, 1);
            }
        }
        _ => return false,
    }
    m.put_status(node, Status::Idle);
    true
}

/// Ticks a leaf of the library.
pub(super) fn built_in(m: &mut Machine, node: usize, kind: &Kind) -> Result<Move, Fault> {
    let said = |success: bool| if success { Answer::Success } else { Answer::Failure };
    Ok(Move::Answer(match kind {
        Kind::Always(answer) => *answer,
        Kind::Script(code) => {
            if let Some(code) = code {
                m.script(node, code)?;
            }
            Answer::Success
        }
        Kind::ScriptCondition(code) => said(m.holds(node, code)?),
        Kind::SetBlackboard { value, output } => said(m.set_blackboard(node, value, output)?),
        Kind::UnsetBlackboard { key } => {
            m.unset(node, key);
            Answer::Success
        }
        Kind::WasEntryUpdated { .. } => {
            let fresh = m.get(node, 0) == 1;
            m.set(node, 0, 0);
            said(fresh)
        }
        Kind::Sleep { msec } => match m.status(node) {
            Status::Idle => {
                let msec = m.needed(node, msec)?;
                if msec <= 0 {
                    Answer::Success
                } else {
                    m.arm(node, msec);
                    m.set(node, 1, 0);
                    Answer::Running
                }
            }
            Status::Running if m.get(node, 1) == 1 => Answer::Success,
            Status::Running => Answer::Running,
            Status::Success => Answer::Success,
            Status::Failure => Answer::Failure,
        },
        _ => return fault("no tick is known for this node"),
    }))
}
