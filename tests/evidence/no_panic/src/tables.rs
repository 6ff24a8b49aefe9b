//! The roots of missions as tables: what alternatives cost, and what is left of a mission.
//!
//! Tables come as their caller can make them at worst: of any length, with any numbers.

use cotama_core::hardware::Equipment;
use cotama_core::problem::Candidate;
use cotama_core::units::Millimetres;
use cotama_models::missions::tables::{
    Activity, Alternative, RemainingError, Rest, buffer_sizes, remaining,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_alternative_new(a: u64, b: u64, needs: Equipment, quality: u32) -> [Alternative; 2] {
    [Alternative::travelling(a, b, needs, quality), Alternative::standing(a, b, needs, quality)]
}

#[unsafe(no_mangle)]
fn root_alternative_cost(of: &Alternative, rest: Rest) -> (Option<[u32; 2]>, Option<u32>) {
    (of.cost(rest), of.quality_of(rest))
}

#[unsafe(no_mangle)]
fn root_alternative_candidate(of: &Alternative, rest: Rest, id: u16) -> Option<Candidate<2>> {
    of.candidate(rest, id)
}

#[unsafe(no_mangle)]
fn root_activity_read(of: &Activity<'_>, by: &Alternative) -> (bool, Millimetres, Rest) {
    (of.travels(), of.length(), of.whole(by))
}

#[unsafe(no_mangle)]
fn root_buffer_sizes(activities: &[Activity<'_>]) -> (usize, usize) {
    buffer_sizes(activities)
}

#[unsafe(no_mangle)]
fn root_remaining<'c, 'l>(
    activities: &[Activity<'_>],
    first: Option<Rest>,
    available: Equipment,
    candidates: &'c mut [Candidate<2>],
    lists: &'l mut [&'c [Candidate<2>]],
) -> Result<&'l [&'c [Candidate<2>]], RemainingError> {
    remaining(activities, first, available, candidates, lists)
}
