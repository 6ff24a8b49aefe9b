//! Asks two networks for posteriors, given all states of their evidence, between marks at which an
//! emulator counts instructions. A line `batch NAME COUNT` is printed for each row of regions, and
//! `stack NAME BYTES` for the deepest call of each.
#![no_std]
#![no_main]

mod depth;

use core::hint::black_box;
use cortex_m_rt::entry;
use depth::depth;
use entries::{Found, QUERIES, robot_asia, robot_two_ways};
use semihosting::println;

/// The emulator looks for this function by its name.
// `no_mangle` counts as unsafe because two equal names would meet at link time: no other
// function is called so.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn icount_mark() {
    black_box(());
}

/// Counts the instructions between two marks.
fn counted<R>(act: impl FnOnce() -> R) -> R {
    icount_mark();
    let answer = black_box(act());
    icount_mark();
    answer
}

/// Asks for all states of the evidence; their probabilities sum to 1, as do those of the query.
fn all<const EVIDENCE: usize, const STATES: usize>(
    name: &str,
    query: usize,
    ask: fn(&[u8; EVIDENCE]) -> Found<STATES>,
) {
    let query = &QUERIES[query];
    let (mut evidence, mut count, mut whole, mut deepest) = ([0; EVIDENCE], 0_u64, 0_u64, 0);
    loop {
        let Ok((posterior, answer)) = counted(|| ask(black_box(&evidence))) else {
            panic!("the evidence is possible")
        };
        let sum = posterior.iter().map(|it| i64::from(*it)).sum::<i64>();
        assert!((sum - (1 << 30)).unsigned_abs() <= STATES as u64, "no distribution");
        whole += answer.evidence;
        count += 1;
        deepest = depth(|| _ = black_box(ask(black_box(&evidence)))).max(deepest);
        // The next states, the last fastest.
        let mut places = evidence.iter_mut().zip(query.evidence).rev();
        let next = places.find_map(|(state, states)| {
            *state = if u16::from(*state) + 1 < *states { *state + 1 } else { 0 };
            (*state > 0).then_some(())
        });
        if next.is_none() {
            break;
        }
    }
    let lost = query.cut_off() * STATES as u64 * count + query.rounded;
    assert!(whole.abs_diff(1 << 60) <= lost, "all evidence has another probability than 1");
    println!("batch {name} {count}");
    println!("stack {name} {deepest}");
}

#[entry]
fn main() -> ! {
    counted(|| ());
    println!("batch empty 1");
    all("asia", 0, robot_asia);
    all("two_ways", 1, robot_two_ways);
    semihosting::process::exit(0)
}
