//! Nodes that somebody steers from outside: a menu of children, and services that pause a tree.

use super::{Fault, Machine, Move, Question, Reply, Status, Step, fault, words};
use crate::machine::How;
use crate::tree::Answer;

/// Cells of a menu: the child that ran last, and what was chosen last, from 1; after the children
/// come SUCCESS, FAILURE, RUNNING.
const RAN: usize = 0;
const CHOSEN: usize = 1;

/// Returns the question of a menu.
pub(super) fn question(m: &Machine, node: usize) -> Question {
    Question { node, how: How::Looks, replies: words::choices(m.children(node).len()) }
}

pub(super) fn enter_manual(m: &mut Machine, node: usize, repeats: bool) -> Step {
    let chosen = m.get(node, CHOSEN) as usize;
    if repeats && chosen > 0 {
        if chosen > m.children(node).len() {
            return fault("a status is repeated as if it were a child: undefined behaviour");
        }
        return Ok(Move::Child(chosen - 1));
    }
    m.put_status(node, Status::Running);
    Ok(Move::Ask)
}

/// Goes on when somebody has chosen.
pub(super) fn chosen(m: &mut Machine, node: usize, reply: Reply) -> Step {
    let count = m.children(node).len() as u32;
    let (chosen, step) = match reply {
        Reply::Child(at) => (at as u32 + 1, Move::Child(at as usize)),
        Reply::Leaf(answer) => (count + 1 + answer as u32, Move::Answer(answer)),
        _ => return fault("nobody chooses so"),
    };
    m.set(node, CHOSEN, chosen);
    Ok(step)
}

/// Takes the answer of the child that was chosen, which is not reset.
pub(super) fn manual(m: &mut Machine, node: usize, at: usize, it: Answer) -> Step {
    if it == Answer::Running {
        m.set(node, RAN, at as u32 + 1);
    }
    Ok(Move::Answer(it))
}

/// Halts the child of a menu that ran last; all others follow.
pub(super) fn halt_manual(m: &mut Machine, node: usize) -> Result<(), Fault> {
    match m.get(node, RAN) as usize {
        0 => Ok(()),
        ran => m.reset(m.child(node, ran - 1)),
    }
}

/// Cells of a controller: its state, which is the number of the child; whether it was asked once
/// more within this tick.
const STATE: usize = 0;
const AGAIN: usize = 1;

const RESUMED: u32 = 0;
const PAUSED: u32 = 1;
const ON_PAUSE: u32 = 2;
const ON_RESUME: u32 = 3;

pub(super) fn enter_pausing(m: &mut Machine, node: usize) -> Step {
    if m.children(node).len() > 4 {
        return fault("PauseResumeController has at most 4 children");
    }
    if m.status(node) == Status::Idle {
        m.set(node, STATE, RESUMED);
    }
    m.put_status(node, Status::Running);
    Ok(Move::Ask)
}

/// Goes on when the services were called or not. `yes` says that the tree is to run: nobody pauses
/// it, or it is resumed; then it may be paused again before this tick.
pub(super) fn served(m: &mut Machine, node: usize, yes: bool) -> Step {
    let is_paused = m.get(node, STATE) == PAUSED;
    if is_paused && yes && m.get(node, AGAIN) == 0 {
        m.set(node, AGAIN, 1);
        return Ok(Move::Ask);
    }
    let state = match (is_paused, yes) {
        (true, true) => Some(ON_RESUME),
        (true, false) if m.get(node, AGAIN) == 0 => None,
        (false, true) => None,
        (_, false) => Some(ON_PAUSE),
    };
    if let Some(state) = state {
        m.reset_children(node)?;
        m.set(node, STATE, state);
    }
    let at = m.get(node, STATE) as usize;
    if at < m.children(node).len() {
        return Ok(Move::Child(at));
    }
    switch(m, node);
    Ok(Move::Answer(Answer::Running))
}

fn switch(m: &mut Machine, node: usize) {
    match m.get(node, STATE) {
        ON_PAUSE => m.set(node, STATE, PAUSED),
        ON_RESUME => m.set(node, STATE, RESUMED),
        _ => {}
    }
}

/// Takes the answer of a child of the controller, which is not reset.
pub(super) fn pausing(m: &mut Machine, node: usize, it: Answer) -> Step {
    let is_resumed = m.get(node, STATE) == RESUMED;
    Ok(Move::Answer(match it {
        Answer::Success | Answer::Skipped if is_resumed => Answer::Success,
        Answer::Success | Answer::Skipped => {
            switch(m, node);
            Answer::Running
        }
        Answer::Running | Answer::Failure => it,
    }))
}
