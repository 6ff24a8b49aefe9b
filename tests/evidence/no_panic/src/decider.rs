//! The roots of what is asked of a decider and of its level, and how both go on after a restart.
//!
//! Both come as their caller can leave them at worst: with any marking and any time.

use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::{Checked, RestoreError, Snapshot};
use cotama_core::system::Of;
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, DecisionalLevel, DeliveryDecider, Health, Level, Modules, Perceived, Situation, Told,
    delivery,
};

/// The level whose every step is checked, as one that is restored.
type CheckedLevel = Level<
    Checked<delivery::Program>,
    { delivery::SIZE.words },
    { delivery::SIZE.clocks },
    { delivery::SIZE.slots },
>;

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_level_new() -> DecisionalLevel {
    DecisionalLevel::start(delivery::Program)
}

#[unsafe(no_mangle)]
fn root_level_snapshot(level: &DecisionalLevel, bytes: &mut [u8]) -> Option<usize> {
    level.snapshot().write(bytes).map(<[u8]>::len)
}

#[unsafe(no_mangle)]
fn root_level_restore(bytes: &[u8], now: Millis) -> Option<Result<CheckedLevel, RestoreError>> {
    Some(CheckedLevel::restore(Checked::default(), now, &Snapshot::read(bytes)?))
}

#[unsafe(no_mangle)]
fn root_level_player(level: &DecisionalLevel) -> Millis {
    level.player().now()
}

#[unsafe(no_mangle)]
fn root_told_event(told: Told) -> Of<EventId> {
    told.event()
}

#[unsafe(no_mangle)]
fn root_perceived_nothing(works: Modules) -> Perceived {
    Perceived::nothing(works)
}

#[unsafe(no_mangle)]
fn root_decider_restart(decider: &mut DeliveryDecider, level: DecisionalLevel, known: Health) {
    decider.restart(level, known);
}

#[unsafe(no_mangle)]
fn root_decider_idle(decider: &mut DeliveryDecider, now: Millis, body: Body) -> Option<Millis> {
    decider.idle(now, body);
    decider.idle_until()
}

#[unsafe(no_mangle)]
fn root_decider_knows(decider: &DeliveryDecider) -> (Health, [Modules; 3]) {
    (decider.health(), [decider.available(), decider.relied_on(), decider.observing()])
}

#[unsafe(no_mangle)]
fn root_decider_read(decider: &DeliveryDecider) -> (Situation, PlaceId, Millis, u32, [bool; 2]) {
    let asked = [decider.listens(), decider.permit().is_some()];
    let (situation, global) = (decider.situation(), decider.global());
    (situation, global, decider.since(), decider.plannings_failed(), asked)
}

#[unsafe(no_mangle)]
fn root_decider_level(decider: &DeliveryDecider) -> &DecisionalLevel {
    decider.level()
}
