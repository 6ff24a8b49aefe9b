//! Temporal logic on small time nets: what is answered is what clock regions say.

use super::timed::net;
use crate::check::named;
use crate::properties::oracle::{Space, lasso};
use crate::properties::random::{Random, branching, path, state};
use crate::tpn::regions::{Instants, regions};
use cotama_core::net::{PlaceId, TransitionId};
use cotama_verification::check::{Answer, Model, Options, Reason, Verdict, check, check_all};
use cotama_verification::explicit::{Limit, Limits};
use cotama_verification::property::{Assumptions, Atom, Formula, Linear, Question};
use cotama_verification::pt::Pt;
use cotama_verification::temporal::Rest;
use cotama_verification::tpn::{self, TimeNet};
use cotama_verification::{assert_holds, tina};

/// The states just after a firing; behind the places of the net a place for each transition that
/// says that it fired last.
pub(super) fn space<'n>(pt: &'n Pt, instants: &Instants) -> Space<'n> {
    let tokens = |(tokens, fired): &(Vec<u32>, Option<usize>)| {
        let last = (0..pt.transitions.len()).map(|it| u32::from(*fired == Some(it)));
        tokens.iter().copied().chain(last).collect()
    };
    let markings = instants.states.iter().map(tokens).collect();
    Space::of(pt, markings, instants.next.clone())
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
    let dated = schedule.steps.iter().map(|it| it.transition);
    assert!(dated.eq(run.stem.iter().chain(&cycle).copied()), "{run:?}");
    let thrice = [&run.stem[..], &cycle, &cycle, &cycle].concat();
    tpn::schedule(net, &thrice).unwrap_or_else(|error| panic!("{error}: {}", tina::write(net)));
    let mut markings = vec![pt.initial.clone()];
    let fired = run.stem.iter().chain(&cycle);
    fired.for_each(|it| markings.push(pt.fire(markings.last().unwrap(), it.0).unwrap()));
    if !cycle.is_empty() {
        assert_eq!(markings.pop().as_ref(), Some(&markings[run.stem.len()]));
    }
    let all: Vec<usize> = (0..markings.len()).collect();
    let successors = vec![Vec::new(); markings.len()];
    let space = Space::of(&pt, markings, successors);
    assert!(lasso(&space, &all, run.stem.len(), path), "{run:?} does not show it");
    true
}

fn answered(net: &TimeNet, question: Question) -> Answer {
    answers(net, &[question]).remove(0)
}

pub(super) fn answers(net: &TimeNet, questions: &[Question]) -> Vec<Answer> {
    let model = Model::from(net.clone());
    let properties: Vec<_> = questions.iter().map(|it| named(it.clone(), model.pt())).collect();
    // Enough for all of these nets; a wrong class can be one of infinitely many.
    let limits = Limits { states: 1_000, ..Limits::default() };
    check_all(&model, &properties, &Options { limits, ..Options::default() })
}

/// Returns the claim that a state is reachable that leads to others in some way, told by so many
/// steps.
pub(super) fn reachable(random: &mut Random, pt: &Pt, steps: usize) -> Formula {
    fn leads(random: &mut Random, pt: &Pt, depth: usize) -> Formula {
        if depth == 0 {
            return state(random, pt, 0);
        }
        let parts = (0..2).map(|_| {
            let next = Box::new(Formula::Next(leads(random, pt, depth - 1).into()));
            if random.below(2) == 0 { Formula::Exists(next) } else { Formula::All(next) }
        });
        Formula::And(parts.collect())
    }
    Formula::Exists(Formula::Finally(leads(random, pt, steps).into()).into())
}

/// Compares formulas of CTL, and liveness, on so many nets; how many formulas hold.
fn compare_branching(seed: u64, nets: usize) -> usize {
    let (mut random, mut compared, mut hold) = (Random(seed), 0, 0);
    let mut others = Random(seed + 1);
    while compared < nets {
        let (net, pt, instants) = small(&mut random, compared % 2 == 1, 60);
        let space = space(&pt, &instants);
        let mut asked = vec![Question::Liveness];
        let mut expected = vec![is_live(&space, &instants)];
        for number in 0..6 {
            let said = match number {
                0..4 => branching(&mut random, &pt, 3),
                // Whether states are told apart by what they lead to.
                _ => reachable(&mut others, &pt, 3),
            };
            if !said.is_state() {
                expected.push(space.satisfying(&said)[0]);
                asked.push(Question::Formula(said));
            }
        }
        let found = answers(&net, &asked);
        for ((question, expected), found) in asked.iter().zip(expected).zip(found) {
            let text = || format!("{}\n{}", question.display(&pt), tina::write(&net));
            assert_eq!(found.verdict, Verdict::Holds(expected), "{}", text());
            hold += usize::from(expected);
        }
        compared += 1;
    }
    hold
}

/// Whether from each state each transition can fire.
fn is_live(space: &Space<'_>, instants: &Instants) -> bool {
    (0..space.net.transitions.len()).all(|transition| {
        let did = |at: &usize| instants.states[*at].1 == Some(transition);
        space.reaching(&|at| space.successors[at].iter().any(did)).into_iter().all(|it| it)
    })
}

/// Returns the claim that a transition is treated fairly, in the words of the oracle.
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

/// A formula of CTL on runs that are as a formula says, in the words of the oracle.
fn on_fair_runs(formula: &Formula, fair: &Formula) -> Formula {
    let of = |it: &Formula| Box::new(on_fair_runs(it, fair));
    let all = |parts: &[Formula]| parts.iter().map(|it| on_fair_runs(it, fair)).collect();
    let some = || Formula::Exists(Formula::And(vec![fair.clone(), Formula::TRUE]).into());
    let not = |it| Formula::Not(Box::new(it));
    let path = |path: &Formula| match path {
        Formula::Finally(a) => Formula::Finally(of(a)),
        Formula::Globally(a) => Formula::Globally(of(a)),
        Formula::Until(a, b) => Formula::Until(of(a), of(b)),
        other => panic!("{other:?} is not of CTL"),
    };
    match formula {
        Formula::Not(a) => not(*of(a)),
        Formula::And(parts) => Formula::And(all(parts)),
        Formula::Or(parts) => Formula::Or(all(parts)),
        Formula::Exists(it) => Formula::Exists(Box::new(match &**it {
            Formula::Next(a) => Formula::Next(Formula::And(vec![*of(a), some()]).into()),
            it => Formula::And(vec![fair.clone(), path(it)]),
        })),
        Formula::All(it) => Formula::All(Box::new(match &**it {
            Formula::Next(a) => Formula::Next(Formula::Or(vec![*of(a), not(some())]).into()),
            it => Formula::Or(vec![not(fair.clone()), path(it)]),
        })),
        state => state.clone(),
    }
}

/// Assumptions about one or two transitions, and the same in the words of the oracle, which takes
/// the longer the more these are.
pub(super) fn assumptions(random: &mut Random, pt: &Pt) -> (Assumptions, Vec<Formula>) {
    let (mut assumed, mut parts) = (Assumptions::default(), Vec::new());
    let is_strong = random.below(2) == 0;
    for _ in 0..if is_strong { 1 } else { 2 } {
        let transition = TransitionId(random.below(pt.transitions.len()) as u32);
        parts.push(fair(pt, transition, is_strong));
        if is_strong { &mut assumed.strong } else { &mut assumed.weak }.push(transition);
    }
    (assumed, parts)
}

/// Compares formulas of LTL on so many nets, with assumptions or without, and of CTL with
/// assumptions; how many of the former hold, and how many runs were shown.
fn compare_linear(seed: u64, nets: usize, assumes: bool) -> [usize; 2] {
    let (mut random, mut compared, mut count) = (Random(seed), 0, [0; 2]);
    let mut others = Random(seed + 1);
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
        let said_of_states = branching(&mut others, &pt, 2);
        if assumes && compared % 2 == 0 && !said_of_states.is_state() {
            let fair = Formula::And(parts.clone());
            let expected = space.satisfying(&on_fair_runs(&said_of_states, &fair))[0];
            let question = Question::Fair(said_of_states.clone(), assumed.clone());
            let text = || format!("{} {}", question.display(&pt), tina::write(&net));
            let found = answered(&net, question.clone()).verdict;
            assert_eq!(found, Verdict::Holds(expected), "{}", text());
        }
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
fn formulas_of_ctl_agree_with_regions() {
    let hold = compare_branching(71, 400);
    assert!((400..1_200).contains(&hold), "{hold}");
}

#[test]
fn formulas_of_ltl_agree_with_regions_and_their_runs_have_dates() {
    let [hold, shown] = compare_linear(72, 100, false);
    assert!(hold > 50 && shown > 15, "{hold} {shown}");
}

#[test]
fn formulas_on_fair_runs_agree_with_regions() {
    let [hold, shown] = compare_linear(73, 50, true);
    assert!(hold > 25 && shown > 8, "{hold} {shown}");
}

#[test]
fn atomic_classes_keep_the_limit_of_classes() {
    let (mut random, mut compared) = (Random(76), 0);
    while compared < 10 {
        let (net, ..) = small(&mut random, false, 60);
        let model = Model::from(net.clone());
        let property = named(Question::Liveness, model.pt());
        let within = |states| {
            let limits = Limits { states, ..Limits::default() };
            check(&model, &property, &Options { limits, ..Options::default() })
        };
        let all = within(u64::MAX).states;
        if all <= tpn::classes(&net, &tpn::Limits::default()).classes() as u64 {
            continue;
        }
        compared += 1;
        assert!(matches!(within(all).verdict, Verdict::Holds(_)));
        assert_eq!(within(all - 1).verdict, Verdict::Unknown(Reason::Limit(Limit::States)));
    }
}

#[test]
fn a_net_without_places_has_one_marking_of_which_formulas_speak() {
    let net = tina::read("clock.net", b"tr tick [1,1]").unwrap();
    assert_holds!(net, "E (G F fireable(tick))", "AG EX fireable(tick)");
}

#[test]
#[ignore = "a minute: CI runs it"]
fn formulas_of_ltl_agree_with_regions_on_900_nets() {
    let [hold, shown] = compare_linear(72, 600, false);
    assert!((400..1_000).contains(&hold) && shown > 100, "{hold} {shown}");
    let [hold, shown] = compare_linear(73, 300, true);
    assert!((150..550).contains(&hold) && shown > 50, "{hold} {shown}");
}

#[test]
#[ignore = "takes minutes"]
fn twenty_thousand_time_nets_agree_with_regions() {
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
