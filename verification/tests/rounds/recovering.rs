//! The decisional level where modules may return, at any time and any number of times: what it is
//! still required to do, and that it does not go up and down by itself.

use crate::delivery::{explored, watched};
use cotama_core::net::{Arc, Net, PlaceId, Role, Transition};
use cotama_core::system::{Component, System};
use cotama_models::cotama::{
    Asked, RECOVERY_REQUIREMENTS, REPLACED, REQUIREMENTS, Requirement, Watch, recovering,
};
use cotama_verification::explicit::Graph;
use cotama_verification::flat::{Looks, Observer, Rounds, Size, rounds};
use cotama_verification::property::{Ctl, Question, parse};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::{Fairness, ctl};

fn holds(text: &str, pt: &Pt, graph: &Graph) -> bool {
    let Question::Formula(formula) = parse(text, pt).unwrap().question else { panic!("{text}") };
    ctl(graph, &Ctl::new(&formula.simplified()).unwrap(), &Fairness::default(), u64::MAX, 2)
        .unwrap()
        .verdict
}

/// Returns the requirements that do not hold, of those that need no memory.
fn broken(requirements: &[Requirement]) -> Vec<&'static str> {
    let (pt, graph) = explored(&rounds(&recovering::SYSTEM).unwrap());
    let asked = requirements.iter().filter_map(|it| Some((it.id, it.asked?)));
    let simple = asked.filter(|it| it.1.watches.is_empty());
    simple.filter(|it| !holds(it.1.text, &pt, &graph)).map(|it| it.0).collect()
}

#[test]
#[ignore = "seconds: CI runs it"]
fn there_are_182588_states_between_rounds() {
    let rounds = rounds(&recovering::SYSTEM).unwrap();
    assert_eq!(rounds.net().unwrap().view().net().defect(), None);
    let (_, graph) = explored(&rounds);
    assert_eq!((graph.states(), graph.arcs()), (574_022, 757_638));
    assert_eq!(
        rounds.size(&graph),
        Size {
            states: cotama_golden::figure("recovering.states"),
            edges: cotama_golden::figure("recovering.steps")
        }
    );
}

/// The requirements of the shipped level hold, except that nothing returns.
#[test]
#[ignore = "a minute: CI runs it"]
fn all_requirements_without_returns_still_hold_but_two() {
    assert_eq!(broken(REQUIREMENTS), REPLACED);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn the_requirements_of_returns_hold() {
    assert_eq!(broken(RECOVERY_REQUIREMENTS), [] as [&str; 0]);
    for it in REQUIREMENTS.iter().chain(RECOVERY_REQUIREMENTS) {
        assert!(
            it.said.iter().all(|said| said.unsaid(&recovering::SYSTEM).next().is_none()),
            "{}",
            it.id
        );
    }
}

/// The most that a watch counts when it may count further.
fn worst(rounds: &Rounds, watch: &str) -> u32 {
    let (pt, graph) = explored(rounds);
    graph.tokens(pt.place(watch).unwrap()).max().unwrap()
}

/// The worst cases of the duties in a requirement, in rounds; a watch that counts in how many
/// rounds another one did is beside it.
fn duties(id: &str) -> Vec<u32> {
    const MANY: u32 = 6;
    let mut all = REQUIREMENTS.iter().chain(RECOVERY_REQUIREMENTS);
    let Asked { watches, text } = all.find(|it| it.id == id).unwrap().asked.unwrap();
    let asked = watches.iter().filter(|it| text.contains(it.name));
    let plain = rounds(&recovering::SYSTEM).unwrap();
    let of = |it: &Watch| {
        let uses = |of: &&Watch| it.begins.split_whitespace().any(|word| word == of.name);
        let mut needed: Vec<_> = watches.iter().filter(uses).copied().collect();
        needed.push(Watch { most: MANY, ..*it });
        worst(&watched(&plain, &needed).unwrap(), it.name)
    };
    asked.map(of).collect()
}

#[test]
#[ignore = "a minute: CI runs it"]
fn no_duty_takes_longer_when_modules_return() {
    assert_eq!(["GS3", "LS3"].map(duties), [[1], [1]]);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn the_longer_duties_do_not_either() {
    assert_eq!(["LS4", "CS5"].map(duties), [[2], [2]]);
    assert_eq!(duties("AS2"), [2; 7]);
}

/// RC9: sonars, localisation, the operator's avoidance.
#[test]
#[ignore = "a minute: CI runs it"]
fn a_returned_module_is_used_after_two_rounds() {
    assert_eq!(duties("RC9"), [2, 2, 2]);
}

/// The configurations that an adapter runs, from nothing to all modules.
const RANKS: [(&str, &[&str]); 2] = [
    (
        "following",
        &["pf.Off", "pf.Degraded", "pf.Odometric | pf.Reactive", "pf.Optimal | pf.Reduced"],
    ),
    ("teleoperation", &["to.Off", "to.Degraded", "to.Full"]),
];

/// The events that wait at the end of a round in which something returned, and then only.
const RETURNED: &str =
    "(gom.sonar_sound.waiting | gom.mcl_sound.waiting | gom.avoidance_sound.waiting)";

/// An observer of the running configuration, and whether something had returned in the round
/// before. It comes to its largest state when an adapter goes up to which nothing returned two
/// rounds before. As what is outside does one thing a round, no two of those answer the same
/// return. A stop and a start in one round have the turn of what is outside between them.
fn rising(rounds: &Rounds, (name, ranks): (&str, &[&str])) -> Observer {
    let state = |rank: usize, returned: usize| (2 * rank + returned) as u32;
    let most = state(ranks.len(), 0);
    let mut steps = Vec::new();
    for (from, before) in (0..ranks.len()).flat_map(|from| [(from, 0), (from, 1)]) {
        for (to, runs) in ranks.iter().enumerate() {
            let unasked = from > 0 && to > from && before == 0;
            for (returned, when) in
                [format!("({runs}) & returned = 0"), (*runs).to_owned()].iter().enumerate()
            {
                let after = if unasked { most } else { state(to, returned) };
                steps.push((state(from, before), rounds.condition(when).unwrap(), after));
            }
        }
    }
    Observer { name: name.to_owned(), looks: Looks::BeforeOutside, most, steps }
}

fn goes_up_unasked(system: &System<'_>, ranks: (&str, &[&str])) -> bool {
    let mut rounds = rounds(system).unwrap();
    rounds.watch("returned", Looks::AtEnd, (RETURNED, &format!("!{RETURNED}")), 1).unwrap();
    let observer = rising(&rounds, ranks);
    rounds.observe(&observer).unwrap();
    worst(&rounds, ranks.0) == observer.most
}

/// RC1.
#[test]
#[ignore = "a minute: CI runs it"]
fn an_adapter_goes_up_at_most_once_for_each_return() {
    assert_eq!(RANKS.map(|ranks| goes_up_unasked(&recovering::SYSTEM, ranks)), [false, false]);
}

/// The system with one transition changed; test data, which lives to the end.
fn with(name: &str, change: impl Fn(&Net<'_>, &mut Transition<'static>)) -> System<'static> {
    let (net, transition) = name.split_once('.').unwrap();
    let mut components = recovering::SYSTEM.components.to_vec();
    let it = components.iter_mut().find(|it| it.name == net).unwrap();
    let mut transitions = it.net.transitions.to_vec();
    let named = transitions.iter_mut().filter(|it| it.name.split('.').next() == Some(transition));
    assert_ne!(named.map(|of| change(it.net, of)).count(), 0, "{name}");
    let net = Box::leak(Box::new(Net { transitions: transitions.leak(), ..*it.net }));
    *it = Component { name: it.name, net };
    System { components: components.leak(), ..recovering::SYSTEM }
}

fn place(net: &Net<'_>, name: &str) -> PlaceId {
    PlaceId(net.places.iter().position(|it| it.name == name).unwrap() as u32)
}

/// Returns the system with a transition that does not read this flag.
fn without(name: &str, flag: &str) -> System<'static> {
    with(name, |net, it| {
        let flag = place(net, flag);
        let is_it = |arc: &Arc| {
            arc.place == flag || net.places[arc.place.0 as usize].role == Role::Complement(flag)
        };
        it.read = it.read.iter().copied().filter(|arc| !is_it(arc)).collect::<Vec<_>>().leak();
    })
}

/// Returns the system with a transition that leaves or reaches other places.
fn moved(name: &str, from: &str, to: &str) -> System<'static> {
    let one = |net: &Net<'_>, name| -> &'static [Arc] {
        vec![Arc { place: place(net, name), weight: 1 }].leak()
    };
    with(name, |net, it| (it.take, it.give) = (one(net, from), one(net, to)))
}

fn breaks(system: &System<'_>, id: &str) -> bool {
    let mut all = REQUIREMENTS.iter().chain(RECOVERY_REQUIREMENTS);
    let asked = all.find(|it| it.id == id).unwrap().asked.unwrap();
    let (pt, graph) = explored(&watched(&rounds(system).unwrap(), asked.watches).unwrap());
    !holds(asked.text, &pt, &graph)
}

#[test]
#[ignore = "a minute: CI runs it"]
fn wrong_ways_up_are_found() {
    let mutants = [
        ("up to localisation that is lost", without("pf.u1", "mcl"), "RC4"),
        ("up from the hand-over", moved("pf.u1", "Off", "Optimal"), "RC5"),
        ("the adapter is told, wherever it is", without("cs.better1", "degraded"), "RC8"),
        (
            "the operator's adapter is told, whoever drives",
            without("cs.better2", "teleoperated"),
            "RC5",
        ),
        (
            "localisation is there again though it was given up",
            without("gom.mcl_back", "given_up"),
            "RC7",
        ),
        (
            "nothing is done about what is there again",
            moved("pf.u3", "Odometric", "Odometric"),
            "RC9",
        ),
    ];
    let unfound = mutants.iter().filter(|(_, mutant, id)| !breaks(mutant, id));
    assert_eq!(unfound.map(|it| (it.0, it.2)).collect::<Vec<_>>(), []);
    let raised_by_a_loss = moved("pf.a10", "Odometric", "Optimal");
    assert!(goes_up_unasked(&raised_by_a_loss, RANKS[0]), "RC1");
}
