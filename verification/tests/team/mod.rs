//! The protocol by which a team allocates its tasks: the repaired one keeps all requirements, the
//! thesis's text breaks them as foreseen (P1 to P5), and each seeded defect breaks one.

mod files;
mod mutants;
mod supervised;
mod text;

use cotama_core::net::Arc;
use cotama_core::net::owned::OwnedNet;
use cotama_models::team::protocol::{Requirement, TEXT, Team, net, requirements};
use cotama_verification::check::{Checker, Model, Options, Verdict, check};
use cotama_verification::explicit::{Limits, StateSpace, statespace};
use cotama_verification::property;
use std::collections::{BTreeMap, BTreeSet};

/// A team's net, and what is asked of it.
struct Asked {
    net: OwnedNet,
    model: Model,
    requirements: Vec<Requirement>,
}

impl Asked {
    fn new(team: &Team) -> Self {
        let net = net(team);
        assert_eq!(net.view().net().defect(), None);
        let model = Model::from(&net.view().net());
        let requirements = requirements(team, &net);
        Self { net, model, requirements }
    }

    /// The requirements of these that do not hold.
    fn broken(&self, text: fn(&Requirement) -> &str) -> Vec<&'static str> {
        let checker = Checker::new(&self.model);
        let broken = self.requirements.iter().filter(|it| {
            let asked = property::parse(text(it), self.model.pt()).unwrap();
            match checker.answer(&asked, &Options::default()).verdict {
                Verdict::Holds(holds) => !holds,
                other => panic!("{}: {other:?}", it.id),
            }
        });
        broken.map(|it| it.id).collect()
    }

    fn space(&self) -> StateSpace {
        statespace(self.model.pt(), &Limits::default(), 1, &|_| ())
    }
}

/// All requirements hold; so many states and arcs.
fn holds(team: &Team, states: u64, arcs: u64) {
    let asked = Asked::new(team);
    let space = asked.space();
    assert_eq!((space.states, space.arcs, space.limit), (states, arcs, None));
    assert_eq!(asked.broken(|it| &it.text), [""; 0]);
}

#[test]
fn two_robots_keep_all_requirements() {
    holds(&Team::new(2, 1), 126_302, 483_708);
}

#[test]
fn three_robots_keep_all_requirements() {
    holds(&Team::new(3, 1).without_old_messages(), 36_056, 150_235);
}

#[test]
fn two_auctioneers_that_want_the_same_robots_keep_all_requirements() {
    holds(&Team::rivals(), 46_352, 169_832);
}

#[test]
#[ignore = "half a minute: 1.7 million states"]
fn three_robots_keep_all_requirements_with_every_old_message() {
    let asked = Asked::new(&Team::new(3, 1));
    let space = asked.space();
    assert_eq!(
        (space.states, space.arcs, space.limit),
        (cotama_golden::figure("team.old-messages"), 7_158_631, None)
    );
    // One question, as one graph answers it.
    let each = asked.requirements.iter().map(|it| it.text.split(" assuming").next().unwrap());
    let text = each.collect::<Vec<_>>().join(" & ") + " assuming weak(network.settles)";
    let all = property::parse(&text, asked.model.pt()).unwrap();
    let answer = check(&asked.model, &all, &Options::default());
    assert_eq!((answer.verdict, answer.states), (Verdict::Holds(true), space.states));
}

#[test]
#[ignore = "ten seconds"]
fn four_robots_with_two_failures_keep_all_requirements() {
    holds(
        &Team::new(4, 2).without_old_messages(),
        cotama_golden::figure("team.two-failures"),
        3_290_556,
    );
}

/// The requirements speak of what happens.
#[test]
fn the_premises_of_requirements_come_about() {
    let asked = Asked::new(&Team::new(3, 1).without_old_messages());
    for comes in [
        "EF (t1.done & t2.done)",
        "EF t2.reported",
        "EF (t1.vacant & r3.executing.t1)",
        "EF (r1.waiting.t1 & r2.down & t1.named.r2)",
        "EF (r1.waiting.t1 & r2.down & t1.acked.r2)",
        "EF (r1.executing.t1 & r2.down & t1.acked.r2)",
        "EF (r1.executing.t1 & t1.left.r2)",
        "EF (t1.withdrawn & t1.completed)",
        "EF (t1.refused.r3 & r1.waiting.t1 & r3.executing.t2)",
        "EF (t1.executing & !untimely & failures > 0)",
    ] {
        let property = property::parse(comes, asked.model.pt()).unwrap();
        let verdict = check(&asked.model, &property, &Options::default()).verdict;
        assert_eq!(verdict, Verdict::Holds(true), "{comes}");
    }
}

/// The transitions of a net by the names of their places, old messages left out, each once.
fn present(net: &OwnedNet) -> BTreeSet<[Vec<&str>; 3]> {
    let names = |arcs: &[Arc]| -> Vec<&str> {
        let names = arcs.iter().map(|it| net.places[it.place.0 as usize].name.as_str());
        let mut names: Vec<_> = names.filter(|it| !it.contains(".old_")).collect();
        names.sort_unstable();
        names
    };
    net.transitions.iter().map(|it| [&it.take, &it.read, &it.give].map(|it| names(it))).collect()
}

/// So a net without them does the same: each step that looks at them has one form for each of the
/// three things that may be in the air, and is possible in one of them.
#[test]
fn old_messages_decide_nothing_in_the_repaired_protocol() {
    for team in [Team::new(2, 1), Team::new(3, 1), Team::new(4, 2), Team::rivals()] {
        let (with, without) = (net(&team), net(&team.clone().without_old_messages()));
        assert_eq!(present(&with), present(&without));
        let mut forms = BTreeMap::<_, BTreeSet<_>>::new();
        for it in &with.transitions {
            let old = it.take.iter().chain(&it.read).map(|arc| &with.places[arc.place.0 as usize]);
            for place in old.filter(|it| it.name.contains(".old_")) {
                let step = it.name.rsplit_once('.').unwrap().0;
                forms.entry(step).or_default().insert(place.name.as_str());
            }
        }
        assert!(forms.values().all(|it| it.len() == 3));
    }
    let text = Team::new(3, 1).with(TEXT);
    assert_ne!(present(&net(&text)), present(&net(&text.clone().without_old_messages())));
}
