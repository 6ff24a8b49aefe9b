//! The roots of the decisional level as one component, from flags to requests, on the supervisors
//! that the robot's file prints.
//!
//! A decider comes as its caller can leave it at worst: with any marking, any tables and any time.

use cotama_core::player::{Firing, Observer};
use cotama_core::system::Of;
use cotama_core::{net::EventId, net::TransitionId, units::Millis};
use cotama_models::level::{
    Adapted, Cause, Drive, Failure, Hidden, Perceived, Requests, Round, Rows, Told,
};
use cotama_printed::{Careful, Decider, Level, system};

/// The last that fired, or was ignored, and why.
#[derive(Debug)]
pub struct Seen {
    fired: Option<(Of<TransitionId>, Cause)>,
    ignored: Option<(Of<EventId>, Cause)>,
}

/// Implemented for the program whose every step is checked, and for the one that trusts.
macro_rules! seen {
    ($($program:ty)+) => {$(
        impl Observer<$program, Cause> for Seen {
            fn on_fire(&mut self, firing: &Firing<'_, $program, Cause>) {
                self.fired = Some((firing.id, firing.carries));
            }

            fn on_ignore(&mut self, event: Of<EventId>, cause: Cause) {
                self.ignored = Some((event, cause));
            }
        }
    )+};
}
seen! { Careful system::Program }

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_decider_new(level: Level<Careful>) -> Decider<Careful> {
    Decider::new(level)
}

#[unsafe(no_mangle)]
fn root_decider_restart(decider: &mut Decider<Careful>, level: Level<Careful>) {
    decider.restart(level);
}

#[unsafe(no_mangle)]
fn root_decider_perceive(decider: &mut Decider<Careful>, now: Millis, seen: Perceived) -> Rows {
    decider.perceive(now, seen)
}

#[unsafe(no_mangle)]
fn root_decider_period(
    decider: &mut Decider<Careful>,
    now: Millis,
    said: Option<Told>,
    drive: Drive,
    seen: &mut Seen,
) -> Round {
    decider.period(now, said, drive, seen)
}

#[unsafe(no_mangle)]
fn root_decider_trusting_period(
    decider: &mut Decider<system::Program>,
    now: Millis,
    said: Option<Told>,
    drive: Drive,
    seen: &mut Seen,
) -> Round {
    decider.period(now, said, drive, seen)
}

#[unsafe(no_mangle)]
fn root_decider_requests(decider: &Decider<Careful>, now: Millis) -> Requests {
    decider.requests(now)
}

#[unsafe(no_mangle)]
fn root_decider_report(decider: &mut Decider<Careful>, row: usize, cause: Cause) {
    decider.report(row, cause);
}

#[unsafe(no_mangle)]
fn root_decider_see(decider: &mut Decider<Careful>, now: Millis, shown: u64, broken: u32) {
    decider.see(now, shown, broken);
}

#[unsafe(no_mangle)]
fn root_decider_round(decider: &mut Decider<Careful>, now: Millis, seen: &mut Seen) -> u64 {
    decider.round(now, seen)
}

#[unsafe(no_mangle)]
fn root_decider_next(decider: &mut Decider<Careful>) -> Option<(Told, Cause)> {
    decider.next_untold()
}

#[unsafe(no_mangle)]
fn root_decider_tell(
    decider: &mut Decider<Careful>,
    now: Millis,
    told: Told,
    cause: Cause,
    seen: &mut Seen,
) -> (bool, u64) {
    decider.tell(now, told, cause, seen)
}

#[unsafe(no_mangle)]
fn root_decider_read(decider: &Decider<Careful>) -> (&Level<Careful>, &Adapted, u64, bool) {
    (decider.level(), decider.adapted(), decider.up(), decider.listens())
}

#[unsafe(no_mangle)]
fn root_decider_hidden(
    decider: &mut Decider<Careful>,
    now: Millis,
) -> (Hidden, u64, Option<Millis>) {
    (decider.hidden(now), decider.unmasked(now), decider.unmasks_at(now))
}

#[unsafe(no_mangle)]
fn root_hidden_diagnose(of: Hidden, failures: &[Failure], up: u64, raised: u64) -> Rows {
    of.diagnose(failures, up, raised)
}
