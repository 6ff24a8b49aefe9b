//! The roots of posteriors in fixed point: for any query, and for the two that are linked as
//! firmware.
//!
//! A query comes as its caller can make it at worst: steps that reach anywhere, tables and memory
//! of any size.

#[path = "../../no_std/src/asia.rs"]
mod asia;
#[path = "../../no_std/src/two_ways.rs"]
mod two_ways;

use cotama_inference::{Answer, NoAnswer, Query};

/// States that are asked for, and the answer.
type Found<const STATES: usize> = ([u32; STATES], Result<Answer, NoAnswer>);

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_inference_answer(
    query: &Query<'_>,
    evidence: &[u8],
    scratch: &mut [u64],
    posterior: &mut [u32],
) -> Result<Answer, NoAnswer> {
    query.answer(evidence, scratch, posterior)
}

#[unsafe(no_mangle)]
fn root_inference_read(query: &Query<'_>) -> (usize, u64) {
    (query.states(), query.cut_off())
}

#[unsafe(no_mangle)]
fn root_inference_asia(evidence: [u8; 2]) -> Found<2> {
    found::<{ asia::QUERY.scratch }, 2>(&asia::QUERY, &evidence)
}

#[unsafe(no_mangle)]
fn root_inference_two_ways(evidence: [u8; 4]) -> Found<5> {
    found::<{ two_ways::QUERY.scratch }, 5>(&two_ways::QUERY, &evidence)
}

fn found<const CELLS: usize, const STATES: usize>(
    query: &Query<'_>,
    evidence: &[u8],
) -> Found<STATES> {
    let (mut scratch, mut posterior) = ([0; CELLS], [0; STATES]);
    let answer = query.answer(evidence, &mut scratch, &mut posterior);
    (posterior, answer)
}
