//! The common parts of tests and benchmarks across the crates: seeded problem instances, and the
//! patrol as one; the token game by the book. Parts that core's own tests need too stand there.

#[path = "../core/tests/common/draw.rs"]
pub mod draw;
#[path = "../verification/tests/rounds/drawn.rs"]
pub mod drawn;
pub mod families;
#[path = "../core/allocation/tests/allocators/instances.rs"]
pub mod instances;
#[path = "../core/allocation/tests/allocators/solve.rs"]
pub mod solve;
pub mod textbook;

use cotama_core::problem::{Candidate, Problem};
use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
use cotama_models::missions::tables::{EMPTY, buffer_sizes, remaining};

/// Runs `story` on the allocation problem of the patrol, from its compiled tables.
///
/// # Panics
/// When the compiled tables are not those of a mission.
pub fn with_patrol<R>(story: impl FnOnce(&Problem<'_, 2>) -> R) -> R {
    let (candidates, lists) = buffer_sizes(&ACTIVITIES);
    let mut candidates: Vec<Candidate<2>> = vec![EMPTY; candidates];
    let mut lists: Vec<&[Candidate<2>]> = vec![&[]; lists];
    let first = ACTIVITIES[0].whole(&ACTIVITIES[0].alternatives[0]);
    let activities = remaining(&ACTIVITIES, Some(first), AVAILABLE, &mut candidates, &mut lists)
        .expect("every activity of the patrol has candidates");
    story(&Problem::new(activities, LIMITS, ORDER).expect("the patrol is a problem"))
}
