//! The return of lost modules, where the mission asks for it: held back until they were sound for
//! long enough, then planned with and reported.

use super::{Cause, Decider, Plans, Why};
use crate::cotama::decisions::{Loss, Losses};
use crate::cotama::dependability::FailureModes;
use crate::cotama::level::{Return, Told};
use crate::cotama::modules::{Health, Modules};
use crate::cotama::supervisors::recovery::{Event, Player, State};
use cotama_core::player::Program;

/// The hysteresis of each [`Return`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Returns([Player; Return::ALL.len()]);

impl Returns {
    fn is_available(&self, it: Return) -> bool {
        self.0[it as usize].state() == State::Available
    }

    /// Whether all that is lost with this has returned.
    fn have(&self, health: Health) -> bool {
        let left = health.relied_on();
        let mut lost = Return::ALL.into_iter().filter(|it| !it.works(left));
        let for_good = Losses::lacking(left).without(Losses::of(&Return::ALL.map(Return::loss)));
        let returned = match lost.next() {
            None => false,
            Some(Return::Sonar) => self.is_available(Return::Sonar),
            Some(first) => self.is_available(first) && lost.all(|it| self.is_available(it)),
        };
        returned && for_good.is_empty()
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// Watches the modules known to be lost, and uses again those that have been sound for long
    /// enough. A module is sound when it reports so and no flag of its loss is raised any more:
    /// else a flag that is lowered after its module had settled would never be heard, and one that
    /// goes up and down would not be held back.
    pub(super) fn use_what_returns(&mut self, works: Modules, plans: &mut impl Plans) {
        if self.returns.is_none() {
            return;
        }
        let sound = works.common(self.observing());
        let (known, now) = (self.known.relied_on, self.now);
        let Some(Returns(players)) = &mut self.returns else { return };
        let mut restored = false;
        for (player, it) in players.iter_mut().zip(Return::ALL) {
            restored |= player.advance(now).fired > 0;
            // Modules that need the sonars return with them, and still have their own returns to go
            // through.
            let by_itself = it == Return::Sonar || Return::Sonar.works(known);
            if by_itself && !it.works(known) {
                let _ =
                    player.offer(now, if it.works(sound) { &Event::sound } else { &Event::lost });
            }
        }
        if restored {
            self.restore(plans);
        }
    }

    /// Failures that are over, and whose modules have returned, are known to be over. The rest of
    /// the mission is planned again, and the supervisors hear of what the plan uses: the sonars
    /// last, since only with them can the others be used.
    fn restore(&mut self, plans: &mut impl Plans) {
        let Some(returns) = self.returns else { return };
        let before = self.known.relied_on;
        let (mut over, mut known, mut cause) = (Health::SOUND, Health::SOUND, None);
        for mode in self.found.iter() {
            let origin = self.origin[mode as usize];
            let health = mode.health(origin.part);
            let passed = mode.rule().signature.always.common(self.up).is_empty();
            if passed && returns.have(health) {
                over = over.union(health);
                cause = cause.max(Some(origin.cause.0));
                self.found = self.found.without(FailureModes::of(&[mode]));
            } else {
                known = known.union(health);
            }
        }
        let Health { faulty, lost, suspected } = self.known.health;
        let faulty = faulty.without(over.faulty).union(known.faulty);
        let lost = lost.without(over.lost).union(known.lost);
        self.known = Health { faulty, lost, suspected }.into();
        let left = self.known.relied_on;
        if let Some(cause) = cause.filter(|_| left != before) {
            let why = Why::Returned { modules: left.without(before), broken: over };
            self.use_again(why, left, Cause(cause), plans);
        }
    }

    /// Plans with what has returned, and tells the supervisors what the plan uses of it.
    fn use_again(&mut self, why: Why, left: Modules, cause: Cause, plans: &mut impl Plans) {
        let over = self.lost.has(Loss::Vital) || plans.is_over();
        if over || plans.plan(why, left).is_err() {
            return; // the plan in force goes on
        }
        // Losses that the sonars hid are reported before the sonars return.
        self.lose(Losses::lacking(left), cause);
        let planned = plans.configuration();
        let lost = self.lost.common(Losses::lacking(left).union(self.unused(planned)));
        let back = |it: &Return| self.lost.without(lost).has(it.loss());
        for it in Return::ALL.into_iter().rev().filter(back) {
            self.untold.push(Told::Return(it), cause);
        }
        self.lost = lost;
        self.do_without(planned, cause);
    }
}
