//! The operator: what he answers, and after how long.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{local, operator};
use cotama_models::missions::faults::Answer;
use std::collections::VecDeque;

/// How long he takes to answer a request, to look around, and to edit: assumed.
pub const ANSWERS_AFTER: Millis = Millis(8_000);

/// The answers of the operator to a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answers {
    /// To the first request from there on.
    pub x: Millimetres,
    /// The answers, one after the other.
    pub answers: Vec<Answer>,
    /// After how long each.
    pub delay: Millis,
}

/// An operator with a script, and habits where it says nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Operator {
    script: VecDeque<Answers>,
    next: VecDeque<Answer>,
    delay: Millis,
    since: Millis,
    place: local::State,
}

/// The operator's knowledge of the robot.
#[allow(clippy::struct_excessive_bools, reason = "each is a thing he sees or not")]
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Place of the local supervisor, and position of the robot on its path.
    pub(super) place: local::State,
    pub(super) x: Millimetres,
    /// The link to him works.
    pub(super) link: bool,
    /// He can see.
    pub(super) camera: bool,
    /// The robot found no path.
    pub(super) planner_failed: bool,
    /// The robot can go on alone once the way is clear.
    pub(super) can_go_on: bool,
    /// The goal of the drive is reached.
    pub(super) at_goal: bool,
}

impl Operator {
    /// An operator who gives these answers, in their order.
    pub(super) fn new(script: impl IntoIterator<Item = Answers>) -> Self {
        let place = local::State::Idle;
        let script = script.into_iter().collect();
        Self { script, next: VecDeque::new(), delay: ANSWERS_AFTER, since: Millis(0), place }
    }

    /// Returns the word of the operator now, if any.
    pub(super) fn says(&mut self, now: Millis, view: View) -> Option<operator::Event> {
        use local::State as Place;
        if view.place != self.place {
            (self.place, self.since) = (view.place, now);
            if view.place == Place::HandOver {
                self.hear(view);
            }
        }
        let waited = now.0.saturating_sub(self.since.0);
        let goes = view.place == Place::Teleoperated && self.next.front() == Some(&Answer::Goal);
        if !view.link || waited < self.delay.0 || (goes && !view.at_goal) {
            return None;
        }
        Some(match self.next.pop_front()? {
            Answer::Teleoperate => operator::Event::teleoperate,
            Answer::Teleprogram => operator::Event::teleprogram,
            Answer::Waypoints => operator::Event::waypoints,
            Answer::Path => operator::Event::new_path,
            Answer::Goal => operator::Event::arrived,
            Answer::GiveUp => operator::Event::gives_up,
        })
    }

    /// Until when he says nothing new while all stays as it is, but for the goal of the drive.
    pub(super) fn waits_until(&self, now: Millis) -> Option<Millis> {
        let end = Millis(self.since.0.saturating_add(self.delay.0));
        match self.next.front() {
            _ if end > now => Some(end),
            None | Some(Answer::Goal) => Some(Millis(u64::MAX)),
            Some(_) => None,
        }
    }

    /// A request reaches him.
    fn hear(&mut self, view: View) {
        let scripted = self.script.front().is_some_and(|it| it.x <= view.x);
        let script = if scripted { self.script.pop_front() } else { None };
        self.delay = script.as_ref().map_or(ANSWERS_AFTER, |it| it.delay);
        self.next = script.map_or_else(|| habit(view), |it| it.answers.into());
    }
}

/// Returns the answers of the operator without a script.
fn habit(view: View) -> VecDeque<Answer> {
    use Answer::{Goal, Path, Teleoperate, Teleprogram, Waypoints};
    VecDeque::from(match view {
        View { planner_failed: true, .. } => vec![Teleprogram, Waypoints],
        View { camera: false, .. } => vec![Teleprogram, Path],
        View { can_go_on: false, .. } => vec![Teleoperate, Goal],
        _ => vec![Teleoperate, Teleprogram, Path],
    })
}
