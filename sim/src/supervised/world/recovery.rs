//! What returns, where a mission asks for it: held back until it was sound for long enough, then
//! planned with and told.

use super::{CLOCKS, Failure, World};
use crate::run::PlanCause;
use crate::supervised::Conduct;
use cotama_core::player::Program;
use cotama_models::cotama::recovery::{Event, Player, State};
use cotama_models::cotama::{
    Cause, Diagnosis, Health, Loss, Losses, Module, Modules, Return, Told,
};

/// The hysteresis of each [`Return`]. Its observer is assumed to see at once whether it works, in
/// use or not.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Recovery([Player; Return::ALL.len()]);

impl Recovery {
    fn is_available(&self, it: Return) -> bool {
        self.0[it as usize].state() == State::Available
    }
}

/// What a failure is known to break.
fn found(failure: &Failure, conduct: &Conduct) -> Option<Health> {
    conduct.detected.map(|(_, diagnosis)| match diagnosis {
        Diagnosis::Unexplained => failure.mode.health(failure.part),
        _ => diagnosis.health(failure.part),
    })
}

impl<P: Program<W, CLOCKS, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    /// What is known to be lost is watched; what has been sound for long enough is used again.
    pub(super) fn recover(&mut self) {
        let (known, now, sound) = (self.known.relied_on(), self.now, self.broken().relied_on());
        let Some(Recovery(players)) = &mut self.recovery else { return };
        let mut restored = false;
        for (player, it) in players.iter_mut().zip(Return::ALL) {
            restored |= player.advance(now).fired > 0;
            // What needs the sonars is lost and returns with them, and has its own returns left.
            let by_itself = it == Return::Sonar || Return::Sonar.works(known);
            if by_itself && !it.works(known) {
                let _ =
                    player.offer(now, if it.works(sound) { &Event::sound } else { &Event::lost });
            }
        }
        if restored {
            self.restore();
        }
    }

    /// Failures that are over, and whose modules have returned, are known to be over. The rest of
    /// the mission is planned again, and the supervisors hear of what the plan uses: the sonars
    /// last, since only with them can the others be used.
    fn restore(&mut self) {
        let Some(recovery) = self.recovery else { return };
        let has_returned = |health: Health| {
            let left = health.relied_on();
            let mut lost = Return::ALL.into_iter().filter(|it| !it.works(left));
            let for_good =
                Losses::lacking(left).without(Losses::of(&Return::ALL.map(Return::loss)));
            let returned = match lost.next() {
                None => false,
                Some(Return::Sonar) => recovery.is_available(Return::Sonar),
                Some(first) => {
                    recovery.is_available(first) && lost.all(|it| recovery.is_available(it))
                }
            };
            returned && for_good.is_empty()
        };
        let (mut over, mut known, mut cause) = (Health::SOUND, Health::SOUND, None);
        for ((failure, conduct), number) in self.failures.iter().zip(&self.run.conduct).zip(1..) {
            let Some(health) = found(failure, conduct) else { continue };
            if failure.over && has_returned(health) {
                over = over.union(health);
                cause = Some(Cause(number));
            } else {
                known = known.union(health);
            }
        }
        let before = self.known.relied_on();
        self.known.faulty = self.known.faulty.without(over.faulty).union(known.faulty);
        self.known.lost = self.known.lost.without(over.lost).union(known.lost);
        let left = self.known.relied_on();
        if let Some(cause) = cause.filter(|_| left != before) {
            self.use_again(before, left, cause);
        }
    }

    /// Plans with what has returned, and tells the supervisors what the plan uses of it.
    fn use_again(&mut self, before: Modules, left: Modules, cause: Cause) {
        let at = self.progress();
        if self.lost.has(Loss::Vital) || at.activity >= self.mission.scenario().activities.len() {
            return; // nothing is left to be planned
        }
        let named =
            |it: Module| self.mission.hardware.iter().position(|kind| kind.name == it.name());
        let hardware = left.without(before).iter().find_map(named);
        let again = hardware.map(|hardware| PlanCause::Returned { hardware });
        if again.is_some_and(|again| self.planning.plan(again, at, left).is_err()) {
            return; // the plan in force goes on
        }
        // What the sonars hid is lost before they return.
        self.lose(Losses::lacking(left), cause);
        let lost = self.lost.common(Losses::lacking(left).union(self.unused()));
        let back = |it: &Return| self.lost.without(lost).has(it.loss());
        let told = Return::ALL.into_iter().rev().filter(back).map(|it| (Told::Return(it), cause));
        self.untold.extend(told);
        self.lost = lost;
        self.do_without(cause);
    }
}
