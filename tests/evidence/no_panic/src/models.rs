//! The roots of the models: every operation of a player, for every net that ships.
//!
//! A generic function can panic with one net and not with another, so each net has its own roots.

use cotama_core::net::TransitionId;
use cotama_core::player::{
    Advanced, Firing, Names, Observer, Outcome, RestoreError, Snapshot, Stepped,
};
use cotama_core::units::Millis;

/// An observer that reads all it is shown.
#[derive(Debug)]
pub struct Heard {
    outputs: usize,
    at: Millis,
}

impl<P: Names> Observer<P> for Heard {
    fn on_fire(&mut self, firing: &Firing<'_, P>) {
        firing.outputs().for_each(|_| self.outputs = self.outputs.wrapping_add(1));
        self.at = firing.at;
    }
}

/// The roots of nets: `machine` has one state at a time and a root for it, `net` does not. A player
/// comes as its caller can leave it at worst: with any marking, any clocks and any time.
macro_rules! roots {
    ($($kind:ident $name:ident: $module:path;)*) => {$(
        mod $name {
            use super::{Advanced, Heard, Millis, Outcome, RestoreError};
            use super::{Snapshot, Stepped, TransitionId};
            use $module as net;
            use net::{Checked, Event, Place, Player, Program, Transition};

            #[unsafe(export_name = concat!("root_", stringify!($name), "_start"))]
            fn start(now: Millis, heard: &mut Heard) -> Player {
                Player::start(Program, now, heard)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_offer"))]
            fn offer(
                player: &mut Player, now: Millis, event: &Event, heard: &mut Heard,
            ) -> Outcome<Transition> {
                player.offer_with(now, event, heard)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_advance"))]
            fn advance(player: &mut Player, now: Millis, heard: &mut Heard) -> Advanced {
                player.advance_with(now, heard)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_went_back"))]
            fn clock_went_back(player: &Player, now: Millis) -> Option<Millis> {
                player.clock_went_back(now)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_wake_at"))]
            fn wake_at(player: &Player) -> Option<Millis> {
                player.wake_at()
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_step"))]
            fn step(
                player: &mut Checked, now: Millis, events: &[Event], heard: &mut Heard,
            ) -> Stepped {
                player.step_with(now, events, heard)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_checked"))]
            fn checked(
                player: &mut Checked, now: Millis, event: &Event, heard: &mut Heard,
            ) -> Outcome<Transition> {
                player.offer_with(now, event, heard)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_snapshot"))]
            fn snapshot(player: &Player, bytes: &mut [u8]) -> Option<usize> {
                player.snapshot().write(bytes).map(<[u8]>::len)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_restore"))]
            fn restore(bytes: &[u8], now: Millis) -> Option<Result<Checked, RestoreError>> {
                Some(Checked::restore(Default::default(), now, &Snapshot::read(bytes)?))
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_tokens"))]
            fn tokens(player: &Player, place: Place) -> u32 {
                player.tokens(place)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_enabled"))]
            fn enabled(player: &Player, transition: TransitionId) -> bool {
                player.enabled(transition)
            }

            roots!(@ $kind $name);
        }
    )*};
    (@ machine $name:ident) => {
        #[unsafe(export_name = concat!("root_", stringify!($name), "_state"))]
        fn state(player: &Player) -> net::State {
            player.state()
        }
    };
    (@ net $name:ident) => {};
}

roots! {
    machine door: cotama_models::nets::door;
    machine watchdog: cotama_models::nets::watchdog;
    machine charger: cotama_models::nets::charger;
    net crossing: cotama_models::nets::crossing;
    machine ace_request: cotama_models::nets::ace::request;
    net ace_selection: cotama_models::nets::ace::selection;
    machine ace_behaviour: cotama_models::nets::ace::behaviour;
    machine ace_accuracy: cotama_models::nets::ace::accuracy;
    machine alive: cotama_models::nets::ace::robot::alive;
    machine goal: cotama_models::nets::ace::robot::goal;
    machine contextual: cotama_models::nets::by_hand::contextual;
    machine faults: cotama_models::nets::by_hand::faults;
    machine global: cotama_models::nets::by_hand::global;
    machine local: cotama_models::nets::by_hand::local;
    machine observation: cotama_models::nets::by_hand::observation;
    machine operator: cotama_models::nets::by_hand::operator;
    machine path_following: cotama_models::nets::by_hand::path_following;
    machine teleoperation: cotama_models::nets::by_hand::teleoperation;
    machine permit: cotama_models::level::permit;
}
