//! Stubborn sets: deadlocks and reachability, compared with the evaluation by the book.

mod public;
mod searches;

use cotama_core::net::TransitionId;
use cotama_verification::property::{Condition, Formula};
use cotama_verification::pt::Pt;

/// Fires transitions from the initial marking; each must be enabled.
fn fired(pt: &Pt, way: &[TransitionId]) -> Vec<u32> {
    way.iter().fold(pt.initial.clone(), |marking, it| {
        assert!(pt.enabled(&marking, it.0), "{it:?} is not enabled in {marking:?}");
        pt.fire(&marking, it.0).unwrap()
    })
}

/// Whether a formula about one marking holds where transitions lead.
fn ends_in(pt: &Pt, way: &[TransitionId], goal: &Formula) -> bool {
    Condition::new(goal, pt).unwrap().holds(fired(pt, way).as_slice())
}
