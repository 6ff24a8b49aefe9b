//! The operator of a robot: what he answers, and after how long.

use super::Answers;
use super::failing::mode;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::robots::{Answer, Mode, Robot, Told, Where};
use std::collections::VecDeque;

/// How long he takes to answer a request, to look around, and to edit (assumed).
pub(super) const ANSWERS_AFTER: Millis = Millis(8_000);
/// How long a request may stay without an answer before the operator counts as silent (assumed).
pub(crate) const PATIENCE: Millis = cotama_models::level::PATIENCE;

/// An operator with a script, and habits where it says nothing.
#[derive(Clone, Debug)]
pub(super) struct Operator {
    script: VecDeque<Answers>,
    next: VecDeque<Answer>,
    delay: Millis,
    since: Millis,
    place: Where,
}

/// The operator's knowledge of the robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) place: Where,
    pub(super) x: Millimetres,
    /// The losses that are known.
    pub(super) lost: u32,
    /// The link to him works.
    pub(super) link: bool,
    /// The goal of the drive is reached.
    pub(super) at_goal: bool,
}

impl Operator {
    /// An operator who gives these answers, in their order.
    pub(super) fn new(script: &[Answers]) -> Self {
        let script = script.iter().cloned().collect();
        let (next, delay, since) = (VecDeque::new(), ANSWERS_AFTER, Millis(0));
        Self { script, next, delay, since, place: Where::Rests }
    }

    /// Returns the word of the operator now, if any.
    pub(super) fn says(&mut self, robot: &Robot, now: Millis, view: View) -> Option<Told> {
        if view.place != self.place {
            (self.place, self.since) = (view.place, now);
            if view.place == Where::Waits {
                self.hear(robot, view);
            }
        }
        let his = mode(robot, view.place) == Some(Mode::Operator);
        if view.place != Where::Waits && !his {
            return None;
        }
        if now.0.saturating_sub(self.since.0) > PATIENCE.0 && !self.goes_on(robot, view) {
            self.since = now;
            return Some(Told::GivesUp);
        }
        let waited = now.0.saturating_sub(self.since.0);
        if !view.link || waited < self.delay.0 || (self.goes_on(robot, view) && !view.at_goal) {
            return None;
        }
        Some(match (self.next.pop_front()?, view.place) {
            (Answer::Chooses(it), _) => Told::Chooses(it),
            (Answer::Done, Where::Runs { sub_objective, .. }) => Told::Done(sub_objective),
            (Answer::Done | Answer::GivesUp, _) => Told::GivesUp,
        })
    }

    /// Whether he leads the robot to its goal.
    fn goes_on(&self, robot: &Robot, view: View) -> bool {
        super::failing::moves(robot, view.place) && self.next.front() == Some(&Answer::Done)
    }

    /// Until when he says nothing new while all stays as it is, but for the goal of the drive.
    pub(super) fn waits_until(&self) -> Millis {
        let silent = Millis(self.since.0.saturating_add(PATIENCE.0));
        let answer = Millis(self.since.0.saturating_add(self.delay.0));
        if self.next.is_empty() { silent } else { answer }
    }

    /// A request reaches him.
    fn hear(&mut self, robot: &Robot, view: View) {
        let scripted = self.script.front().is_some_and(|it| it.x <= view.x);
        let script = if scripted { self.script.pop_front() } else { None };
        self.delay = script.as_ref().map_or(ANSWERS_AFTER, |it| it.delay);
        self.next = script.map_or_else(|| habit(robot, view.lost), |it| it.answers);
    }
}

/// Returns the answers of the operator without a script: where the robot can go on alone, he leads
/// it on for a while, where he can, and lets it go on; else he leads it to its goal, or gives up.
fn habit(robot: &Robot, lost: u32) -> VecDeque<Answer> {
    let moves = |it: &usize| robot.sub_objectives.get(*it).is_some_and(|it| it.moves);
    let own = |it: &&cotama_models::robots::SubObjective| it.mode == Mode::Autonomous;
    let alone = robot.served(Mode::Autonomous, lost).count()
        == robot.sub_objectives.iter().filter(own).count();
    let leads = robot.served(Mode::Operator, lost).find(moves).map(Answer::Chooses);
    let stands = robot.served(Mode::Operator, lost).find(|it| !moves(it)).map(Answer::Chooses);
    let answers = match (leads, stands) {
        (leads, Some(stands)) if alone => [leads, Some(stands), Some(Answer::Done)],
        (Some(leads), _) => [Some(leads), Some(Answer::Done), None],
        _ => [Some(Answer::GivesUp), None, None],
    };
    answers.into_iter().flatten().collect()
}
