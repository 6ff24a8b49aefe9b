//! The roots of the systems: every operation of a player, for every system of nets that ships, and
//! for one on time.

use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::{
    Advanced, Firing, Names, Observer, Outcome, RestoreError, Round, Snapshot,
};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// The payload of events.
type Message = u32;

/// An observer that reads all it is shown.
#[derive(Debug)]
pub struct Seen {
    outputs: usize,
    last: Option<(Of<EventId>, Message)>,
    at: Millis,
}

impl<P: Names> Observer<P, Message> for Seen {
    fn on_fire(&mut self, firing: &Firing<'_, P, Message>) {
        firing.outputs().for_each(|_| self.outputs = self.outputs.wrapping_add(1));
        self.last = firing.on.map(|it| (it, firing.carries));
        self.at = firing.at;
    }

    fn on_ignore(&mut self, event: Of<EventId>, carries: Message) {
        self.last = Some((event, carries));
    }

    fn on_mail(&mut self, to: Of<EventId>, carries: Message) {
        self.last = Some((to, carries));
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, carries: Message) {
        self.last = Some((mailbox, carries));
    }
}

/// The roots of systems, and of the state of each of its nets, but for those behind `;`, which have
/// several; see those of nets.
macro_rules! roots {
    (
        $($name:ident: $module:path { $($component:ident)+ $(; $stateless:ident)* })*
    ) => {$(
        mod $name {
            use super::{
                Advanced, EventId, Message, Millis, Of, Outcome, PlaceId, RestoreError, Round, Seen,
                Snapshot,
            };
            use $module as system;
            use system::{Event, Program, Transition};
            type Player = system::Carrying<Message>;
            type Checked = system::Checked<Message>;

            #[unsafe(export_name = concat!("root_", stringify!($name), "_start"))]
            fn start(now: Millis, seen: &mut Seen) -> Player {
                Player::start(Program, now, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_offer"))]
            fn offer(
                player: &mut Player, now: Millis, event: &Event, message: Message, seen: &mut Seen,
            ) -> Outcome<Transition> {
                player.offer_carrying(now, event, message, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_checked"))]
            fn checked(
                player: &mut Checked, now: Millis, event: Of<EventId>, message: Message,
                seen: &mut Seen,
            ) -> bool {
                let fired = player.offer_id(now, event, message, seen).fired();
                let round = player.round_with(now, seen);
                fired & !round.behind & !player.advance_with(now, seen).behind
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_round"))]
            fn round(player: &mut Player, now: Millis, seen: &mut Seen) -> Round {
                player.round_with(now, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_snapshot"))]
            fn snapshot(player: &Player, bytes: &mut [u8]) -> Option<usize> {
                player.snapshot().write(bytes).map(<[u8]>::len)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_restore"))]
            fn restore(bytes: &[u8], now: Millis) -> Option<Result<Checked, RestoreError>> {
                Some(Checked::restore(Default::default(), now, &Snapshot::read(bytes)?))
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_advance"))]
            fn advance(player: &mut Player, now: Millis, seen: &mut Seen) -> Advanced {
                player.advance_with(now, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_went_back"))]
            fn clock_went_back(player: &Player, now: Millis) -> Option<Millis> {
                player.clock_went_back(now)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_wake_at"))]
            fn wake_at(player: &Player) -> Option<Millis> {
                player.wake_at()
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_tokens"))]
            fn tokens(player: &Player, place: Of<PlaceId>) -> u32 {
                player.tokens(place)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_waiting"))]
            fn waiting(player: &Player, event: Of<EventId>) -> u32 {
                player.waiting(&event)
            }

            mod state {
                use super::{Player, system};

                $(
                    #[unsafe(export_name = concat!(
                        "root_", stringify!($name), "_state_", stringify!($component)
                    ))]
                    fn $component(player: &Player) -> usize {
                        system::state::$component(player) as usize
                    }
                )+

                const _: () = assert!(
                    [$(stringify!($component),)+ $(stringify!($stateless)),*].len()
                        == system::SYSTEM.components.len(),
                    "a net of this system has no root that reads its state"
                );
            }
        }
    )*};
}

roots! {
    ace_robot: cotama_models::nets::ace::robot {
        navigation vision interaction traversability goal behaviour accuracy alive; selection
    }
    delivery: cotama_models::nets::by_hand::delivery { cs faults gom gs ls operator permit pf to }
    supervision: cotama_models::nets::by_hand::supervision { cs gom gs ls pf to }
    p3dx_delivery: cotama_printed::system {
        gs ls following teleoperation permit gom cs faults operator
    }
    watched: crate::on_time::watched { watchdog charger }
}
