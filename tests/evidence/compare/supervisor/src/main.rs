//! Offers the same ten million events to one of the supervisors: `supervisor
//! net|statig|smlang|hand|nothing`. Prints how many fired, how many settled, and a checksum over
//! every answer and every state.

use core::hint::black_box;
use statig::blocking::InitializedStateMachine;
use std::process::ExitCode;
use supervisor::stream::Stream;
use supervisor::{Nothing, Supervisor, by_hand, by_net, by_smlang, by_statig};

const EVENTS: u32 = 10_000_000;

#[inline]
fn play<S: Supervisor>() -> (u32, u32, u64) {
    let mut supervisor = black_box(S::new());
    let (mut stream, mut fired, mut settled, mut sum) = (Stream::new(), 0, 0, 0_u64);
    let mut state = supervisor.state();
    for now in 0..EVENTS {
        let answer = match supervisor.offer(u64::from(now), stream.next(state)) {
            Some((line, after)) => {
                fired += 1;
                settled += after;
                (line as u64) << 8 | u64::from(after)
            }
            None => 0xffff,
        };
        state = supervisor.state();
        sum = sum.rotate_left(5) ^ (answer << 8 | state as u64);
    }
    (fired, settled, sum)
}

/// One function each, by whose name instructions are counted.
macro_rules! streams {
    ($($name:ident: $supervisor:ty;)*) => {$(
        #[inline(never)]
        fn $name() -> (u32, u32, u64) {
            play::<$supervisor>()
        }
    )*};
}
streams! {
    stream_net: by_net::drive::Player;
    stream_statig: InitializedStateMachine<by_statig::Drive>;
    stream_smlang: by_smlang::StateMachine<by_smlang::Flags>;
    stream_hand: by_hand::Drive;
    stream_nothing: Nothing;
}

fn main() -> ExitCode {
    let (fired, settled, sum) = match std::env::args().nth(1).as_deref() {
        Some("net") => stream_net(),
        Some("statig") => stream_statig(),
        Some("smlang") => stream_smlang(),
        Some("hand") => stream_hand(),
        Some("nothing") => stream_nothing(),
        _ => {
            eprintln!("usage: supervisor net|statig|smlang|hand|nothing");
            return ExitCode::FAILURE;
        }
    };
    println!("{EVENTS} events, {fired} fired, {settled} settled, checksum {sum:016x}");
    ExitCode::SUCCESS
}
