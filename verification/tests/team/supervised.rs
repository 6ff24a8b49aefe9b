//! The protocol and the global supervisors of its robots, as one system.

use super::Asked;
use cotama_core::net::owned::{OwnedNet, OwnedTransition};
use cotama_models::team::protocol::{Team, requirements, supervised, supervised_requirements};
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::property;

fn asked(team: &Team, net: OwnedNet) -> Asked {
    assert_eq!(net.view().net().defect(), None);
    let model = Model::from(&net.view().net());
    let mut requirements = requirements(team, &net);
    requirements.extend(supervised_requirements(team));
    Asked { net, model, requirements }
}

#[test]
fn two_supervised_robots_and_their_team_keep_all_requirements() {
    let team = Team::new(2, 1).without_old_messages();
    let asked = asked(&team, supervised(&team));
    let space = asked.space();
    assert_eq!(
        (space.states, space.arcs, space.limit),
        (cotama_golden::figure("team.supervised-2"), 156_999, None)
    );
    assert_eq!(asked.requirements.len(), 16);
    assert_eq!(asked.broken(|it| &it.text), [""; 0]);
    for comes in [
        "EF (r1.Safe & r1.executing.t1 & r2.executing.t1)",
        "EF (r1.Safe & r2.DriveB & t2.executing)",
        "EF (r1.Safe & t1.reported & t2.done)",
        "EF (r1.Security & r1.waiting.t1)",
        "EF (t1.done & t2.done)",
    ] {
        let property = property::parse(comes, asked.model.pt()).unwrap();
        let verdict = check(&asked.model, &property, &Options::default()).verdict;
        assert_eq!(verdict, Verdict::Holds(true), "{comes}");
    }
}

#[test]
#[ignore = "seconds: CI runs it"]
fn three_supervised_robots_and_their_team_keep_all_requirements() {
    let team = Team::new(3, 1).without_old_messages();
    let asked = asked(&team, supervised(&team));
    assert_eq!(asked.space().states, cotama_golden::figure::<u64>("team.supervised-3"));
    assert_eq!(asked.broken(|it| &it.text), [""; 0]);
}

/// Without one of the ties between the protocol and the supervisors a requirement breaks.
#[test]
fn each_tie_is_needed() {
    let team = Team::new(2, 1).without_old_messages();
    // A robot that gives a role up without being safe is still on its mission, and may be so for
    // ever.
    let mut net = supervised(&team);
    for it in net.transitions.iter_mut().filter(|it| it.name.contains(".give_up.")) {
        it.read.clear();
    }
    assert_eq!(asked(&team, net).broken(|it| &it.text), ["L1", "L4", "C1"]);
    // A robot that is safe and sends nothing keeps its role.
    let mut net = supervised(&team);
    let silent =
        |it: &OwnedTransition| it.name.contains(".give_up.") || it.name.contains(".crash.");
    net.transitions.retain(|it| !silent(it));
    assert_eq!(asked(&team, net).broken(|it| &it.text), ["L1", "C2"]);
}
