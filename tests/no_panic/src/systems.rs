//! The roots of the systems: every operation of a player, for every system of nets that ships, and
//! for one on time.

use cotama_core::net::{EventId, PlaceId};
use cotama_core::player::Advanced;
use cotama_core::system::{Happening, Of, Offered, Turned, Witness};
use cotama_core::units::Millis;

/// What events carry along.
type Message = u32;

/// A witness that reads all it is shown.
#[derive(Debug)]
pub struct Seen {
    last: Option<Happening<Message>>,
}

impl Witness<Message> for Seen {
    fn see(&mut self, happening: &Happening<Message>) {
        self.last = Some(*happening);
    }
}

/// The roots of systems; see those of nets.
macro_rules! roots {
    ($($name:ident: $module:path;)*) => {$(
        mod $name {
            use super::{Advanced, EventId, Message, Millis, Of, Offered, PlaceId, Seen, Turned};
            use $module as system;
            use system::Program;
            type Player = system::Player<Message>;

            #[unsafe(export_name = concat!("root_", stringify!($name), "_start"))]
            fn start(now: Millis, seen: &mut Seen) -> Player {
                Player::start(Program, now, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_offer"))]
            fn offer(player: &mut Player, now: Millis, event: Of<EventId>, message: Message, seen: &mut Seen) -> Offered {
                player.offer(now, event, message, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_round"))]
            fn round(player: &mut Player, now: Millis, seen: &mut Seen) -> Turned {
                player.round(now, seen)
            }

            #[unsafe(export_name = concat!("root_", stringify!($name), "_advance"))]
            fn advance(player: &mut Player, now: Millis, seen: &mut Seen) -> Advanced {
                player.advance(now, seen)
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
                player.waiting(event)
            }
        }
    )*};
}

roots! {
    decision: cotama_models::cotama::decision;
    delivery: cotama_models::cotama::delivery;
    recovering: cotama_models::cotama::recovering;
    watched: crate::on_time::watched;
}
