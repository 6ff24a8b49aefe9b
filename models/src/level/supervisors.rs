//! The supervisors of a robot at work: what they are told, and where they are.

use super::sets::losses_of;
use super::tables::{MAX_LOSSES, Tables};
use super::told::{Cause, Global, Told, Where};
use cotama_core::net::PlaceId;
use cotama_core::player::{Checked, Observer, Player, Program, RestoreError, Snapshot};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// The supervisors of a robot in a mission, running: a player of the system that its file makes,
/// with the tables that name its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level<'t, P, const W: usize, const C: usize, const S: usize> {
    tables: &'t Tables<'t>,
    player: Player<P, W, C, S, Cause>,
}

impl<'t, P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>
    Level<'t, P, W, C, S>
{
    /// The supervisors of a robot at rest. The tables are those of the program's system.
    pub fn start(tables: &'t Tables<'t>, program: P) -> Self {
        Self { tables, player: Player::start(program, Millis(0), &mut ()) }
    }

    /// One round: each supervisor takes its turn.
    pub fn round(&mut self, now: Millis, observer: &mut impl Observer<P, Cause>) {
        let _ = self.player.round_with(now, observer);
    }

    /// Tells the supervisors something; whether it was accepted.
    pub fn tell(
        &mut self,
        now: Millis,
        told: Told,
        cause: Cause,
        observer: &mut impl Observer<P, Cause>,
    ) -> bool {
        let Some(event) = self.tables.event(told) else { return false };
        self.player.offer_id(now, event, cause, observer).fired()
    }

    /// Returns the place of the robot in its drive.
    pub fn place(&self) -> Where {
        if self.is_marked(self.tables.waits) {
            return Where::Waits;
        }
        let mut all = self.tables.sub_objectives.iter();
        let Some(sub_objective) = all.position(|it| self.is_marked(it.place)) else {
            return Where::Rests;
        };
        let mut all = self.tables.configurations.iter();
        let runs = all.position(|it| {
            usize::from(it.sub_objective) == sub_objective
                && it.place.is_none_or(|it| self.is_marked(it))
        });
        runs.map_or(Where::Rests, |configuration| Where::Runs { sub_objective, configuration })
    }

    /// Returns the place of the global supervisor.
    pub fn global(&self) -> Global {
        let Tables { before, done, secures, safe, steps, .. } = self.tables;
        if self.is_marked(*before) {
            return Global::Waits;
        }
        if done.is_some_and(|it| self.is_marked(it)) {
            return Global::Done;
        }
        if self.is_marked(*secures) {
            return Global::Secures;
        }
        if self.is_marked(*safe) {
            return Global::Safe;
        }
        steps.iter().position(|it| self.is_marked(it.place)).map_or(Global::Waits, Global::Does)
    }

    /// Returns the losses that the supervisors know, a bit each.
    pub fn lost(&self) -> u32 {
        let losses = self.tables.losses;
        let is = |it: &usize| losses.get(*it).is_some_and(|it| self.is_marked(it.place));
        losses_of((0..MAX_LOSSES).filter(is))
    }

    /// Whether the robot may move.
    pub fn permits(&self) -> bool {
        self.is_marked(self.tables.granted)
    }

    /// Whether motion has ended for good.
    pub fn is_halted(&self) -> bool {
        self.is_marked(self.tables.destroyed)
    }

    /// The tables.
    pub const fn tables(&self) -> &'t Tables<'t> {
        self.tables
    }

    /// The player under the names.
    pub const fn player(&self) -> &Player<P, W, C, S, Cause> {
        &self.player
    }

    /// Returns the state of the supervisors, to be stored before the power goes.
    pub fn snapshot(&self) -> Snapshot<W, C, S, Cause> {
        self.player.snapshot()
    }

    fn is_marked(&self, place: Of<PlaceId>) -> bool {
        self.player.tokens(place) > 0
    }
}

impl<'t, P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>
    Level<'t, Checked<P>, W, C, S>
{
    /// Supervisors that go on at `now` where stored ones were.
    ///
    /// # Errors
    /// As [`Player::restore`]: what is stored is of other supervisors, or cannot be.
    pub fn restore(
        tables: &'t Tables<'t>,
        program: Checked<P>,
        now: Millis,
        from: &Snapshot<W, C, S, Cause>,
    ) -> Result<Self, RestoreError> {
        Player::restore(program, now, from).map(|player| Self { tables, player })
    }
}
