//! Unbounded nets: minimal coverability sets, pumps and coverability of textbook, random and public
//! nets.

mod limits;
mod oracle;
mod pruned;
mod public;
mod questions;
mod random;
mod textbook;

use crate::numbered::net;
use cotama_core::net::TransitionId;
use cotama_verification::coverability::{CoverabilitySet, Growth, Limits, Sequence};
use cotama_verification::pt::Pt;

fn set(pt: &Pt) -> CoverabilitySet<'_> {
    CoverabilitySet::new(pt, &Limits::default()).unwrap()
}

/// The maximal markings, one a line.
fn shown(set: &CoverabilitySet<'_>) -> Vec<String> {
    let line =
        |marking: &[_]| marking.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    set.markings().map(line).collect()
}

/// Fires transitions; each must be enabled.
fn fired(pt: &Pt, marking: Vec<u32>, way: &[TransitionId]) -> Vec<u32> {
    way.iter().fold(marking, |marking, it| {
        assert!(pt.enabled(&marking, it.0), "{it:?} is not enabled in {marking:?}");
        pt.fire(&marking, it.0).unwrap()
    })
}

/// The marking to which a sequence leads from the start.
fn end(pt: &Pt, way: &Sequence) -> Vec<u32> {
    let firings = way.firings.as_ref().expect("it is written out");
    assert_eq!(firings.len() as u128, way.length);
    fired(pt, pt.initial.clone(), firings)
}

/// Fires the pump ten times after its stem: each time the places that are said to grow do, and no
/// other changes.
fn pumps_ten_times(pt: &Pt, growth: &Growth) {
    assert!(!growth.grows.is_empty());
    let mut marking = end(pt, &growth.stem);
    for _ in 0..10 {
        let mut expected = marking.clone();
        for &(place, by) in &growth.grows {
            assert!(by > 0);
            expected[place.0 as usize] += u32::try_from(by).unwrap();
        }
        marking = fired(pt, marking, growth.pump.firings.as_ref().unwrap());
        assert_eq!(marking, expected);
    }
}
