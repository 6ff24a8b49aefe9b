//! Temporal logic: CTL, LTL and fairness, compared with the evaluation by the book.

mod branching;
mod fairness;
mod linear;
mod public;
mod sets;

pub(crate) use linear::side_by_side;

use crate::properties::oracle::Space;
use cotama_core::net::TransitionId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::property::{Formula, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Rest, Run};

/// The formula of a text.
fn formula(pt: &Pt, text: &str) -> Formula {
    match parse(text, pt).unwrap().question {
        Question::Formula(formula) => formula,
        other => panic!("{other:?}"),
    }
}

/// A lamp: press, release, and it may fail when it is on.
fn lamp() -> Pt {
    let mut lamp = OwnedNet::new("lamp", "A lamp that may fail.");
    let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
    let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
    lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
    lamp.transition(OwnedTransition::new("release").take(on, 1).give(off, 1)).unwrap();
    lamp.transition(OwnedTransition::new("fail").take(on, 1)).unwrap();
    Pt::from(&lamp.view().net())
}

/// The positions in the space of the markings of a run, and that to which the last one goes back;
/// fails when a transition cannot fire, or the end is not as the run says.
fn replayed(space: &Space<'_>, run: &Run) -> (Vec<usize>, usize) {
    let run = run.clone().closed(space.net);
    let mut marking = space.net.initial.clone();
    let at = |marking: &Vec<u32>| space.markings.iter().position(|it| it == marking).unwrap();
    let mut positions = vec![at(&marking)];
    let mut fire = |positions: &mut Vec<usize>, transitions: &[TransitionId]| {
        for it in transitions {
            assert!(space.net.enabled(&marking, it.0), "{it:?} is not enabled in {marking:?}");
            marking = space.net.fire(&marking, it.0).unwrap();
            positions.push(at(&marking));
        }
    };
    fire(&mut positions, &run.stem);
    let back = positions.len() - 1;
    match &run.rest {
        Rest::Any => panic!("a small net has a loop or a deadlock near"),
        Rest::Stays => assert!(space.successors[positions[back]].is_empty(), "{run:?} can go on"),
        Rest::Cycle(cycle) => {
            assert!(!cycle.is_empty());
            fire(&mut positions, cycle);
            assert_eq!(positions.pop(), Some(positions[back]), "{run:?} does not close");
        }
    }
    (positions, back)
}
