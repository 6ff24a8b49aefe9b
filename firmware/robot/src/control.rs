//! The decisional level of a robot, a period at a time: the component that the simulator drives
//! ([`Decider`]), its trace, and what of it survives a power cut.

use crate::message::{self, Period};
use crate::trace::{Sink, Trace};
use cotama_core::player::{Checked, Firing, Names, Observer, Program, Snapshot};
use cotama_core::units::Millis;
use cotama_models::level::{Cause, Decider, Level, Requests, Round};

/// So long is a period, in milliseconds.
pub const PERIOD_MS: u64 = 100;

/// The decisional level, between two periods.
#[derive(Clone, Debug)]
pub struct Control<P, const W: usize, const C: usize, const S: usize> {
    decider: Decider<'static, P, W, C, S>,
    told: Option<Requests>,
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Control<P, W, C, S> {
    /// With these supervisors.
    pub fn new(supervisors: Level<'static, P, W, C, S>) -> Self {
        Self { decider: Decider::new(supervisors), told: None }
    }

    /// Returns the state that has to survive a power cut, in the start of these bytes: the
    /// supervisors with their checksum; `None` where there is no room.
    pub fn store<'b>(&self, bytes: &'b mut [u8]) -> Option<&'b [u8]> {
        self.decider.level().snapshot().write(bytes)
    }

    /// A period: what is seen is diagnosed, the supervisors take a round, and what is to be done
    /// comes out, with the modules that are to be started anew, a bit each.
    #[inline(never)]
    pub fn period(
        &mut self,
        now: Millis,
        given: &Period,
        trace: &mut Trace<'_, impl Sink>,
    ) -> (Requests, u64) {
        let found = self.decider.perceive(now, given.seen);
        if given.seen.raised != 0 {
            let failures = self.decider.level().tables().failures;
            trace.diagnosed(now, given.seen.raised, found.count(), found.worst_first(failures));
        }
        let Round { told, restarts } =
            self.decider.period(now, given.said, given.drive, &mut Recorder(trace));
        if let Some(event) = told.and_then(|it| self.decider.level().tables().event(it)) {
            trace.told(now, event);
        }
        let requests = self.decider.requests(now);
        if self.told != Some(requests) || restarts != 0 {
            self.told = Some(requests);
            trace.requests(now, &message::requests_to_bytes(&requests, restarts));
        }
        (requests, restarts)
    }

    /// The decider, to be looked at.
    pub const fn decider(&self) -> &Decider<'static, P, W, C, S> {
        &self.decider
    }
}

impl<P: Program<W, C, S> + Copy, const W: usize, const C: usize, const S: usize>
    Control<Checked<P>, W, C, S>
{
    /// Goes on where a stored one was. False, and nothing changes, when the bytes are damaged, of
    /// other supervisors, or cannot be.
    #[inline(never)]
    pub fn restore(&mut self, bytes: &[u8], now: Millis) -> bool {
        let level = self.decider.level();
        let (tables, program) = (level.tables(), *level.player().program());
        let Some(stored) = Snapshot::<W, C, S, Cause>::read(bytes) else { return false };
        let Ok(level) = Level::restore(tables, program, now, &stored) else { return false };
        self.decider.restart(level);
        self.told = None;
        true
    }
}

/// Writes down what fires.
struct Recorder<'t, 's, S>(&'t mut Trace<'s, S>);

impl<P: Names, S: Sink> Observer<P, Cause> for Recorder<'_, '_, S> {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.0.fired(firing.at, firing.id, firing.carries.0);
    }
}
