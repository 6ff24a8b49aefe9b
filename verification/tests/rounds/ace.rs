//! ACE as one robot: what its nets promise together, with subsystems that die at any time.

use cotama_core::net::owned::OwnedNet;
use cotama_core::system::owned::OwnedSystem;
use cotama_models::nets::ace::robot::SYSTEM;
use cotama_verification::check::{Checker, Model, Options, Verdict};
use cotama_verification::flat::rounds;
use cotama_verification::property::parse;

/// A system that acts in rounds, as a net.
fn net(system: &OwnedSystem) -> OwnedNet {
    system.with(|it| rounds(it).unwrap()).net().unwrap()
}

/// Whether each property holds of a net.
fn hold<const N: usize>(net: &OwnedNet, texts: [&str; N]) -> [bool; N] {
    let model = Model::from(&net.view().net());
    let checker = Checker::new(&model);
    texts.map(|text| {
        let property = parse(text, model.pt()).unwrap();
        match checker.answer(&property, &Options::default()).verdict {
            Verdict::Holds(it) => it,
            other => panic!("{text}: {other:?}"),
        }
    })
}

/// A robot that nobody holds comes to stand.
const STANDS: &str = "AG (selection.Nobody -> AF (behaviour.Idle | !selection.Nobody))";

#[test]
#[ignore = "half a minute: CI runs it"]
fn the_nets_of_ace_keep_their_promises_together() {
    let promises = [
        STANDS,
        "AG !(behaviour.planner & (behaviour.FollowPerson | behaviour.Idle))",
        "AG (selection.Emergency -> AF behaviour.Idle)",
        "AG (selection.Vision -> AF (behaviour.FollowPerson | !selection.Vision))",
        // Who asks is answered.
        "AG (navigation.Pending -> AF !navigation.Pending)",
        "AG (vision.Pending -> AF !vision.Pending)",
        "AG (interaction.Pending -> AF !interaction.Pending)",
        "AG (traversability.Pending -> AF !traversability.Pending)",
        // Who counts as active holds the robot, or is about to hear that another one does.
        "AG (vision.Active -> selection.Vision | vision.Displaced.waiting | vision.Ended.waiting)",
        // A dead holder is missed, and the robot can rest again.
        "AG (selection.Failed.waiting -> AF !selection.Failed.waiting)",
        "AG EF (selection.Nobody & behaviour.Idle)",
        // Within a round two may count as active: who is displaced has not heard of it yet.
        "EF (navigation.Active & vision.Active)",
    ];
    assert_eq!(hold(&net(&OwnedSystem::from(&SYSTEM)), promises), [true; 12]);
}

#[test]
fn a_robot_that_is_not_told_of_the_end_of_a_behaviour_goes_on_with_it() {
    let mut ace = OwnedSystem::from(&SYSTEM);
    let at = |name: &str| SYSTEM.components.iter().position(|it| it.name == name).unwrap() as u16;
    let (from, to) = (at("selection"), at("behaviour"));
    let released = SYSTEM.components[usize::from(to)].net.events.iter();
    let released = released.clone().position(|it| it.name == "Released").unwrap();
    let is_told = |it: &cotama_core::system::Link| {
        (it.from.component, it.to.component, it.to.id.0 as usize) == (from, to, released)
    };
    let links = ace.links.len();
    ace.links.retain(|it| !is_told(it));
    assert_eq!(ace.links.len(), links - 1);
    assert_eq!(hold(&net(&ace), [STANDS]), [false]);
}
