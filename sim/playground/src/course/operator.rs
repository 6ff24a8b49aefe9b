//! The operator of a course: what he answers, and after how long.

use super::plan::Answers;
use super::world::World;
use crate::pilot::Pilot;
use alloc::vec::Vec;
use cotama_core::units::Millis;
use cotama_models::level::{Mode, PATIENCE, Told, Where};

/// The time that he takes to answer a request, to look around, and to edit (assumed, as simulated).
const ANSWERS_AFTER: Millis = Millis(8_000);

const DONE: u32 = 0;
const GIVES_UP: u32 = 1;
/// A sub-objective that he chooses has its number after this one.
const CHOOSES: u32 = 2;

/// An operator with answers of a plan, and habits where it has none.
pub(super) struct Operator<'c> {
    plan: &'c [Answers],
    /// The answers to come, the last one first.
    next: Vec<u32>,
    delay: Millis,
    since: Millis,
    place: Where,
}

/// The state that he sees.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub(super) place: Where,
    pub(super) x: u64,
    pub(super) lost: u32,
    pub(super) link: bool,
    pub(super) at_goal: bool,
    pub(super) listens: bool,
}

impl<'c> Operator<'c> {
    pub(super) fn new(plan: &'c [Answers]) -> Self {
        let (next, delay, since) = (Vec::new(), ANSWERS_AFTER, Millis(0));
        Self { plan, next, delay, since, place: Where::Rests }
    }

    /// Returns his word now, if any.
    pub(super) fn says(
        &mut self,
        pilot: &Pilot,
        world: &World,
        now: Millis,
        view: View,
    ) -> Option<Told> {
        if view.place != self.place {
            (self.place, self.since) = (view.place, now);
            if view.place == Where::Waits {
                self.hear(pilot, world, &view);
            }
        }
        if view.place != Where::Waits && pilot.mode(view.place) != Some(Mode::Operator) {
            return None;
        }
        let leads = pilot.moves(view.place) && self.next.last() == Some(&DONE);
        let waited = now.0 - self.since.0;
        if waited > PATIENCE.0 && !leads {
            self.since = now;
            return Some(Told::GivesUp);
        }
        let is_early = waited < self.delay.0 || leads && !view.at_goal;
        if !view.link || is_early || !view.listens {
            return None;
        }
        Some(match (self.next.pop()?, view.place) {
            (DONE, Where::Runs { sub_objective, .. }) => Told::Done(sub_objective),
            (DONE | GIVES_UP, _) => Told::GivesUp,
            (it, _) => Told::Chooses((it - CHOOSES) as usize),
        })
    }

    /// A request reaches him.
    fn hear(&mut self, pilot: &Pilot, world: &World, view: &View) {
        if let Some((it, rest)) = self.plan.split_first().filter(|it| it.0.x <= view.x) {
            self.plan = rest;
            (self.next, self.delay) = (it.answers.clone(), it.delay);
        } else {
            (self.next, self.delay) = (habit(pilot, world, view.lost), ANSWERS_AFTER);
        }
        self.next.reverse();
    }
}

/// Returns his answers without a plan, as simulated: where the robot can go on alone, he leads it
/// on for a while, where he can, and lets it go on; else he leads it to its goal, or gives up.
fn habit(pilot: &Pilot, world: &World, lost: u32) -> Vec<u32> {
    let tables = pilot.tables();
    let losses = tables.losses.iter().enumerate().filter(|it| lost >> it.0 & 1 == 1);
    let gone = losses.fold(0, |set, it| set | it.1.modules);
    let is_served = |sub: usize| {
        let all = tables.configurations.iter().zip(&world.configurations);
        all.into_iter()
            .any(|it| usize::from(it.0.sub_objective) == sub && it.1.required & gone == 0)
    };
    let of = |mode: Mode| {
        let all = tables.sub_objectives.iter().enumerate();
        all.filter(move |it| it.1.mode == mode).map(|it| (it.0, it.1.moves))
    };
    let alone = of(Mode::Autonomous).all(|it| is_served(it.0));
    let his = |moves: bool| {
        let mut all = of(Mode::Operator).filter(|it| it.1 == moves && is_served(it.0));
        all.next().map(|it| it.0 as u32 + CHOOSES)
    };
    let answers = match (his(true), his(false)) {
        (leads, Some(stands)) if alone => [leads, Some(stands), Some(DONE)],
        (Some(leads), _) => [Some(leads), Some(DONE), None],
        _ => [Some(GIVES_UP), None, None],
    };
    answers.into_iter().flatten().collect()
}
