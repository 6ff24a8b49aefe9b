//! Stories of nets whose lists do not fit together.

use super::Defect;
use super::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use std::string::ToString;

#[test]
fn two_of_one_name_are_refused_also_in_large_nets() {
    let mut net = OwnedNet::new("large", "");
    for at in 0..100_000 {
        net.place(OwnedPlace::new(&at.to_string(), 0)).unwrap();
    }
    for name in ["go", "stop"] {
        net.event(name, "").unwrap();
        net.output(name, "").unwrap(); // an event and an output may be called alike
        net.transition(OwnedTransition::new("same")).unwrap();
    }
    assert_eq!(net.view().net().defect(), None);
    let with = |change: &dyn Fn(&mut OwnedNet)| {
        let mut other = net.clone();
        change(&mut other);
        other.view().net().defect()
    };
    let twice = |list, at| Some(Defect::Twice { list, at });
    assert_eq!(with(&|it| it.places[70_000].name = "3".to_string()), twice("places", 70_000));
    assert_eq!(with(&|it| it.places[3].name = "70000".to_string()), twice("places", 70_000));
    assert_eq!(with(&|it| it.events[1].name = "go".to_string()), twice("events", 1));
    assert_eq!(with(&|it| it.outputs[0].name = "stop".to_string()), twice("outputs", 1));
    let said = twice("outputs", 1).unwrap().to_string();
    assert_eq!(said, "entry 1 of the outputs has the name of an earlier one; give each its own");
}
