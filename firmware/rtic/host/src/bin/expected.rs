//! The script on the host: what the board must print.

use cotama_core::units::Millis;
use cotama_rtic_link::{END, SCRIPT, Told, link};

fn main() {
    let mut player = link::Player::new();
    let mut told = Told { to: String::new(), now: Millis(0) };
    let script = SCRIPT.map(|(at, event)| (at, Some(event)));
    for (at, event) in script.into_iter().chain([(END, None)]) {
        let at = Millis(at.into());
        while let Some(due) = player.wake_at().filter(|due| *due <= at) {
            told.now = due;
            assert!(!player.advance_with(due, &mut told).behind, "little is due at once");
        }
        told.now = at;
        if let Some(event) = event {
            told.offer(&mut player, at, event);
        }
    }
    let _ = player.advance_with(Millis(END.into()), &mut told);
    told.end(&player);
    print!("{}", told.to);
}
