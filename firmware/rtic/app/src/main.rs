//! A supervisor in a task of RTIC 2.
//!
//! The task owns the player. It sleeps until an event is in its channel or `wake_at` has come,
//! which it hands to the timer queue of the monotonic. Interrupts say what was seen and when, and
//! nothing else. Here a task of its own plays the board: it sets the interrupts pending.
#![no_std]
#![no_main]

use core::fmt;

/// The console of the emulator.
struct Console;

impl fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        semihosting::print!("{text}");
        Ok(())
    }
}

#[rtic::app(device = lm3s6965, dispatchers = [SSI0, QEI0])]
mod app {
    use super::Console;
    use cotama_core::units::Millis;
    use cotama_rtic_link::{END, SCRIPT, Told, link};
    use lm3s6965::Interrupt;
    use rtic_monotonics::systick::prelude::*;
    use rtic_sync::channel::{Receiver, Sender};
    use rtic_sync::make_channel;

    // A tick of SysTick is a millisecond, as those of the player are. 32 bits of them last 49 days.
    systick_monotonic!(Mono, 1_000);
    type Instant = <Mono as Monotonic>::Instant;

    /// A message of an interrupt.
    type Event = (Millis, link::Event);
    /// As many events can wait as there are interrupts between two turns of the task.
    const WAITING: usize = 4;

    fn now() -> Millis {
        Millis(Mono::now().ticks().into())
    }

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        player: link::Player,
        radio: Sender<'static, Event, WAITING>,
        button: Sender<'static, Event, WAITING>,
    }

    #[init]
    fn init(cx: init::Context) -> (Shared, Local) {
        Mono::start(cx.core.SYST, 12_000_000);
        let (sender, receiver) = make_channel!(Event, WAITING);
        let spawned = supervise::spawn(receiver).is_ok() && board::spawn().is_ok();
        assert!(spawned, "each task is spawned once");
        let player = link::Player::new();
        (Shared {}, Local { player, radio: sender.clone(), button: sender })
    }

    /// The supervisor's task.
    #[task(local = [player], priority = 1)]
    async fn supervise(cx: supervise::Context, mut events: Receiver<'static, Event, WAITING>) {
        let player = cx.local.player;
        let mut told = Told { to: Console, now: Millis(0) };
        loop {
            let due = player.wake_at().and_then(|it| u32::try_from(it.0).ok());
            let seen = match due {
                Some(due) => Mono::timeout_at(Instant::from_ticks(due), events.recv()).await,
                None => Ok(events.recv().await),
            };
            told.now = now();
            match seen {
                Ok(Ok((_, link::Event::reset))) if told.now.0 >= u64::from(END) => break,
                Ok(Ok((at, event))) => told.offer(player, at, event),
                Ok(Err(_)) => break,
                Err(_) => {
                    // The time has come: the player cannot be behind, as few transitions are due at
                    // once.
                    let _ = player.advance_with(told.now, &mut told);
                }
            }
        }
        let _ = player.advance_with(Millis(END.into()), &mut told);
        told.end(player);
        semihosting::process::exit(0)
    }

    /// The receiver has a byte.
    #[task(binds = UART0, local = [radio], priority = 2)]
    fn radio(cx: radio::Context) {
        // Full, it would lose the event; then more is heard than a task can ever be told.
        let sent = cx.local.radio.try_send((now(), link::Event::heard));
        assert!(sent.is_ok(), "the supervisor's channel is full");
    }

    /// The button is pressed.
    #[task(binds = GPIOA, local = [button], priority = 2)]
    fn button(cx: button::Context) {
        let sent = cx.local.button.try_send((now(), link::Event::reset));
        assert!(sent.is_ok(), "the supervisor's channel is full");
    }

    /// Plays the board.
    #[task(priority = 1)]
    async fn board(_: board::Context) {
        for (at, event) in SCRIPT.into_iter().chain([(END, link::Event::reset)]) {
            Mono::delay_until(Instant::from_ticks(at)).await;
            rtic::pend(match event {
                link::Event::heard => Interrupt::UART0,
                link::Event::reset => Interrupt::GPIOA,
            });
        }
    }
}
