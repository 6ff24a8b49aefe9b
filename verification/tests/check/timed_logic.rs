//! Temporal logic on small time nets: what is answered is what clock regions say.

use super::timed::net;
use crate::check::named;
use crate::properties::oracle::{Space, lasso};
use crate::properties::random::{Random, branching, path, state};
use crate::tpn::regions::{Instants, regions};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::check::{Answer, Model, Options, Verdict, check};
use cotama_verification::property::{Assumptions, Atom, Formula, Linear, Question};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::Rest;
use cotama_verification::tpn::{self, TimeNet};
use cotama_verification::{assert_holds, tina};

/// The states just after a firing; behind the places of the net a place for each transition that
/// says that it fired last.
fn space<'n>(pt: &'n Pt, instants: &Instants) -> Space<'n> {
    let tokens = |(tokens, fired): &(Vec<u32>, Option<usize>)| {
        let last = (0..pt.transitions.len()).map(|it| u32::from(*fired == Some(it)));
        tokens.iter().copied().chain(last).collect()
    };
    let markings = instants.states.iter().map(tokens).collect();
    Space { net: pt, markings, successors: instants.next.clone() }
}

/// A small net with its states, of which there are at most so many.
fn small(random: &mut Random, open: bool, most: usize) -> (TimeNet, Pt, Instants) {
    loop {
        let net = net(random, open);
        let Some(regions) = regions(&net, 300, 3) else { continue };
        let instants = regions.instants();
        if (2..=most).contains(&instants.states.len()) {
            let pt = net.untimed();
            return (net, pt, instants);
        }
    }
}

/// Fails unless the run of an answer can go on for ever and is as a path says.
fn shows(net: &TimeNet, answer: &Answer, path: &Formula) -> bool {
    let (Some(run), Some(schedule)) = (&answer.run, &answer.schedule) else { return false };
    crate::tpn::replay::replay(net, schedule).unwrap_or_else(|error| panic!("{error}"));
    let pt = net.untimed();
    let cycle = match &run.rest {
        Rest::Any => return false,
        Rest::Stays => Vec::new(),
        Rest::Cycle(cycle) => cycle.clone(),
    };
    let thrice = [&run.stem[..], &cycle, &cycle, &cycle].concat();
    tpn::schedule(net, &thrice).unwrap_or_else(|error| panic!("{error}: {}", tina::write(net)));
    let mut markings = vec![pt.initial.clone()];
    let fired = run.stem.iter().chain(&cycle);
    fired.for_each(|it| markings.push(pt.fire(markings.last().unwrap(), it.0).unwrap()));
    if !cycle.is_empty() {
        assert_eq!(markings.pop().as_ref(), Some(&markings[run.stem.len()]));
    }
    let all: Vec<usize> = (0..markings.len()).collect();
    let space = Space { net: &pt, successors: vec![Vec::new(); markings.len()], markings };
    assert!(lasso(&space, &all, run.stem.len(), path), "{run:?} does not show it");
    true
}

fn answered(net: &TimeNet, question: Question) -> Answer {
    let model = Model::from(net.clone());
    check(&model, &named(question, model.pt()), &Options::default())
}

/// Compares formulas of CTL on so many nets; how many hold.
fn compare_branching(seed: u64, nets: usize) -> usize {
    let (mut random, mut compared, mut hold) = (Random(seed), 0, 0);
    while compared < nets {
        let (net, pt, instants) = small(&mut random, compared % 2 == 1, 60);
        let space = space(&pt, &instants);
        for _ in 0..4 {
            let said = branching(&mut random, &pt, 3);
            if said.is_state() {
                continue;
            }
            let expected = space.satisfying(&said)[0];
            let found = answered(&net, Question::Formula(said.clone())).verdict;
            let text = || format!("{}\n{}", said.display(&pt), tina::write(&net));
            assert_eq!(found, Verdict::Holds(expected), "{}", text());
            hold += usize::from(expected);
        }
        compared += 1;
    }
    hold
}

/// That a transition is treated fairly, in the words of the oracle.
fn fair(pt: &Pt, transition: TransitionId, is_strong: bool) -> Formula {
    let place = PlaceId(pt.places.len() as u32 + transition.0);
    let fires = Formula::Atom(Atom::AtMost(Linear::marked(place)));
    let rests = Formula::Not(Formula::Atom(Atom::Fireable(vec![transition])).into());
    let often = |it: Formula| Formula::Globally(Formula::Finally(it.into()).into());
    if is_strong {
        let at_last = Formula::Finally(Formula::Globally(rests.into()).into());
        Formula::Or(vec![at_last, often(fires)])
    } else {
        often(Formula::Or(vec![rests, fires]))
    }
}

/// Compares formulas of LTL on so many nets, with assumptions or without; how many hold, and how
/// many runs were shown.
fn compare_linear(seed: u64, nets: usize, assumes: bool) -> [usize; 2] {
    let (mut random, mut compared, mut count) = (Random(seed), 0, [0; 2]);
    while compared < nets {
        let most = if assumes { 8 } else { 14 };
        let (net, pt, instants) = small(&mut random, compared % 2 == 1, most);
        let space = space(&pt, &instants);
        let mut said = path(&mut random, &pt, if assumes { 1 } else { 2 }, false);
        if assumes && random.below(2) == 0 {
            said = Formula::Globally(Formula::Finally(state(&mut random, &pt, 1).into()).into());
        }
        if !said.needs_run() || matches!(&said, Formula::Next(it) if !it.needs_run()) {
            continue;
        }
        let mut assumed = Assumptions::default();
        let mut parts = Vec::new();
        if assumes {
            let transition = TransitionId(random.below(pt.transitions.len()) as u32);
            let is_strong = random.below(2) == 0;
            parts.push(fair(&pt, transition, is_strong));
            let list = if is_strong { &mut assumed.strong } else { &mut assumed.weak };
            list.push(transition);
        }
        compared += 1;
        let some = |path: Formula| {
            let all = parts.iter().cloned().chain([path, Formula::TRUE]).collect();
            space.satisfying(&Formula::Exists(Formula::And(all).into()))[0]
        };
        let not = Formula::Not(said.clone().into());
        for (formula, expected, shown) in [
            (Formula::Exists(said.clone().into()), some(said.clone()), &said),
            (Formula::All(said.clone().into()), !some(not.clone()), &not),
        ] {
            let text = || format!("{} {assumed:?}\n{}", formula.display(&pt), tina::write(&net));
            let question = if assumes {
                Question::Fair(formula.clone(), assumed.clone())
            } else {
                Question::Formula(formula.clone())
            };
            let answer = answered(&net, question);
            assert_eq!(answer.verdict, Verdict::Holds(expected), "{}", text());
            count[0] += usize::from(expected);
            count[1] += usize::from(shows(&net, &answer, shown));
        }
    }
    count
}

#[test]
fn formulas_of_ctl_are_what_regions_say() {
    let hold = compare_branching(71, 400);
    assert!((400..1_200).contains(&hold), "{hold}");
}

#[test]
fn formulas_of_ltl_are_what_regions_say_and_their_runs_have_dates() {
    let [hold, shown] = compare_linear(72, 100, false);
    assert!(hold > 50 && shown > 15, "{hold} {shown}");
}

#[test]
fn formulas_of_ltl_on_fair_runs_are_what_regions_say() {
    let [hold, shown] = compare_linear(73, 50, true);
    assert!(hold > 25 && shown > 8, "{hold} {shown}");
}

#[test]
#[ignore = "a minute: CI runs it"]
fn formulas_of_ltl_are_what_regions_say_of_900_nets() {
    let [hold, shown] = compare_linear(72, 600, false);
    assert!((400..1_000).contains(&hold) && shown > 100, "{hold} {shown}");
    let [hold, shown] = compare_linear(73, 300, true);
    assert!((150..550).contains(&hold) && shown > 50, "{hold} {shown}");
}

#[test]
#[ignore = "takes minutes"]
fn twenty_thousand_time_nets_are_what_regions_say() {
    compare_branching(81, 8_000);
    compare_linear(82, 8_000, false);
    compare_linear(83, 4_000, true);
}

#[test]
fn the_shipped_door_opens_again_unless_something_always_is_in_its_way() {
    use cotama_models::nets::door;
    assert_holds!(door::NET, "AG EF Open", "AG EF Closed", "A (G F Open | F G !Open)");
    let never = std::panic::catch_unwind(|| assert_holds!(door::NET, "A (G F Open)"));
    let said = *never.expect_err("it does not hold").downcast::<String>().unwrap();
    assert!(said.contains("repeat for ever") && !said.contains("unknown"), "{said}");
}

#[test]
fn a_transition_that_is_treated_fairly_fires_in_a_time_net_too() {
    let net = tina::read(
        "lamp.net",
        b"pl off (1)  tr blink [1,2] off -> off  tr light [1,w[ off -> lit\n\
          tr again [1,1] lit -> lit",
    )
    .unwrap();
    assert_holds!(net, "A (F lit) assuming weak(light)", "A (G F lit) assuming strong(light)");
    let unfair = std::panic::catch_unwind(|| assert_holds!(net, "A (F lit)"));
    assert!(unfair.is_err());
}
