//! Offers the first events of the stream to each supervisor, between marks at which an emulator
//! counts instructions, and prints what each of them did. The first region is empty, those after it
//! time a call without a supervisor.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m_rt::entry;
use entries::{Hand, Net, Smlang, Statig, TimedNet};
use entries::{offer_hand, offer_net, offer_nothing, offer_smlang, offer_statig, offer_timed_net};
use semihosting::println;
use supervisor::stream::Stream;
use supervisor::{Outcome, Supervisor};

const EVENTS: u32 = 2_000;

/// The emulator looks for this function by its name.
// `no_mangle` counts as unsafe because two equal names would meet at link time: no other
// function is called so.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn icount_mark() {
    black_box(());
}

/// Counts the instructions of an event between two marks.
macro_rules! counted {
    ($offer:expr) => {{
        icount_mark();
        let answer = $offer;
        icount_mark();
        black_box(answer)
    }};
}

fn class(answer: Outcome) -> &'static str {
    match answer {
        None => "ignored",
        Some((_, 0)) => "fired",
        Some(_) => "settled",
    }
}

macro_rules! play {
    ($name:literal, $offer:ident, $supervisor:ty) => {{
        let mut supervisor = <$supervisor as Supervisor>::new();
        let mut stream = Stream::new();
        for now in 0..EVENTS {
            let event = black_box(stream.next(Supervisor::state(&supervisor)));
            let answer = counted!($offer(&mut supervisor, u64::from(now), event));
            println!("{} {}", $name, class(answer));
        }
    }};
}

#[entry]
fn main() -> ! {
    icount_mark();
    icount_mark();
    println!("empty region");
    let event = black_box(supervisor::Event::StartDrive);
    println!("call {}", class(counted!(offer_nothing(&mut black_box(false), 0, event))));
    println!("call {}", class(counted!(offer_nothing(&mut black_box(true), 0, event))));
    play!("hand", offer_hand, Hand);
    play!("net", offer_net, Net);
    play!("timed_net", offer_timed_net, TimedNet);
    play!("smlang", offer_smlang, Smlang);
    play!("statig", offer_statig, Statig);
    println!("bytes hand {}", size_of::<Hand>());
    println!("bytes net {}", size_of::<Net>());
    println!("bytes timed_net {}", size_of::<TimedNet>());
    println!("bytes smlang {}", size_of::<Smlang>());
    println!("bytes statig {}", size_of::<Statig>());
    semihosting::process::exit(0)
}
