//! One entry point for each supervisor: linked alone, it keeps its own code and tables only.
#![no_std]

use core::panic::PanicInfo;
use statig::blocking::InitializedStateMachine;
use supervisor::{
    Event, Line, Outcome, Supervisor, by_hand, by_net, by_smlang, by_statig, by_timed_net,
};

macro_rules! entries {
    ($($(#[$doc:meta])* $name:ident: $supervisor:ty;)*) => {$(
        $(#[$doc])*
        pub type $name = $supervisor;
    )*};
}
entries! {
    /// With `net!`.
    Net: by_net::drive::Player;
    /// With `net!`, with four transitions on time.
    TimedNet: by_timed_net::drive::Player;
    /// With `statig`.
    Statig: InitializedStateMachine<by_statig::Drive>;
    /// With `smlang`.
    Smlang: by_smlang::StateMachine<by_smlang::Flags>;
    /// By hand.
    Hand: by_hand::Drive;
}

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `offer_`, which nothing else does, and the linker starts at one of them to measure it alone.
macro_rules! offers {
    ($($(#[$doc:meta])* $name:ident: $supervisor:ty;)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        #[inline(never)]
        pub fn $name(supervisor: &mut $supervisor, now: u64, event: Event) -> Outcome {
            Supervisor::offer(supervisor, now, event)
        }
    )*};
}
offers! {
    /// Offers an event.
    offer_net: Net;
    /// Offers an event.
    offer_timed_net: TimedNet;
    /// Offers an event.
    offer_statig: Statig;
    /// Offers an event.
    offer_smlang: Smlang;
    /// Offers an event.
    offer_hand: Hand;
}

/// An answer without a supervisor: what the call costs.
// The name begins as those do; see above about `no_mangle`.
#[unsafe(no_mangle)]
#[inline(never)]
pub fn offer_nothing(fires: &mut bool, _: u64, _: Event) -> Outcome {
    fires.then_some((Line::Start, 0))
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    semihosting::process::exit(101)
}
