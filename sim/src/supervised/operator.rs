//! The operator: what he answers, and after how long.

use cotama_core::units::Millis;
use cotama_models::cotama::{local, operator};
use std::collections::VecDeque;

/// What the operator does next when the robot waits for him, or when he drives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// He drives the robot, to look around; then his next answer.
    Look,
    /// He drives the robot to the goal of the drive.
    DriveToGoal,
    /// He edits way-points: a new path is planned through them.
    WayPoints,
    /// He gives a path to follow.
    Path,
    /// He gives up.
    GiveUp,
    /// He does not answer.
    Silence,
}

/// How long he takes to answer a request, to look around, and to edit: assumed.
pub const ANSWERS_AFTER: Millis = Millis(8_000);
/// How long the robot waits for him before it gives up: T_op, assumed (FMECA, row OPR1).
pub const PATIENCE: Millis = Millis(120_000);

/// An operator with a script, and habits where that has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operator {
    script: VecDeque<Answer>,
    doing: Answer,
    since: Millis,
    place: local::Place,
}

/// What the operator knows of the robot.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Where the local supervisor is.
    pub place: local::Place,
    /// The link to him works.
    pub link: bool,
    /// He can see.
    pub camera: bool,
    /// The way to go on autonomously is unknown to the robot: its planner failed.
    pub planner_failed: bool,
    /// The path it has is good: nothing is wrong but what the robot cannot do alone any more.
    pub path_is_good: bool,
    /// The goal of the drive is reached.
    pub at_goal: bool,
}

impl Operator {
    /// An operator who gives these answers first.
    pub fn new(script: impl IntoIterator<Item = Answer>) -> Self {
        Self {
            script: script.into_iter().collect(),
            doing: Answer::Silence,
            since: Millis(0),
            place: local::Place::Idle,
        }
    }

    /// What he says now, if anything.
    pub fn says(&mut self, now: Millis, view: View) -> Option<operator::Event> {
        use local::Place;
        if view.place != self.place {
            (self.place, self.since) = (view.place, now);
            if matches!(view.place, Place::HandOver) {
                self.doing = self.script.pop_front().unwrap_or_else(|| habit(view));
            }
        }
        let waited = now.0.saturating_sub(self.since.0);
        let waiting = matches!(view.place, Place::HandOver | Place::Teleprogrammed | Place::Teleoperated);
        if !waiting {
            return None;
        }
        // That he is silent is noticed on the robot, whether he hears of it or not.
        if waited >= PATIENCE.0 && view.place != Place::Teleoperated {
            return Some(operator::Event::gives_up);
        }
        if !view.link || waited < ANSWERS_AFTER.0 {
            return None;
        }
        match (view.place, self.doing) {
            (_, Answer::Silence) => None,
            (_, Answer::GiveUp) => Some(operator::Event::gives_up),
            (Place::HandOver, Answer::Look | Answer::DriveToGoal) => Some(operator::Event::teleoperate),
            (Place::HandOver, _) => Some(operator::Event::teleprogram),
            (Place::Teleoperated, Answer::DriveToGoal) => view.at_goal.then_some(operator::Event::arrived),
            (Place::Teleoperated, _) => {
                self.doing = self.script.pop_front().unwrap_or(Answer::Path);
                Some(operator::Event::teleprogram)
            }
            (_, Answer::WayPoints) => Some(operator::Event::waypoints),
            (_, _) => Some(operator::Event::new_path),
        }
    }
}

/// What he does without a script.
fn habit(view: View) -> Answer {
    match view {
        View { planner_failed: true, .. } => Answer::WayPoints,
        View { camera: false, .. } => Answer::Path,
        View { path_is_good: true, .. } => Answer::DriveToGoal,
        _ => Answer::Look,
    }
}
