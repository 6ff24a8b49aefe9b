//! Small time nets: what is answered is what integer clocks that tick together say.

use crate::properties::random::Random;
use crate::tpn::discrete::{self, State, States};
use crate::tpn::replay as schedule;
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_verification::certificate::verify;
use cotama_verification::check::{Answer, Extent, Model, Options, Verdict, check_all};
use cotama_verification::property::{self, Property};
use cotama_verification::temporal::Rest;
use cotama_verification::tina;
use cotama_verification::tpn::{Interval, TimeNet, TimePlace, TimeTransition};
use std::collections::{BTreeMap, HashMap};

/// Two or three tokens that go round and look at each other; some get lost, some meet.
pub(super) fn net(random: &mut Random, open: bool) -> TimeNet {
    let (mut places, mut transitions) = (Vec::new(), Vec::new());
    for ring in 0..2 + random.below(2) {
        let (first, length) = (places.len(), 2 + random.below(3));
        for at in 0..length {
            let initial = u32::from(at == 0);
            places.push(TimePlace { name: format!("r{ring}p{at}"), label: None, initial });
            for twin in 0..=usize::from(random.below(3) == 0) {
                let arc =
                    |at: usize| Arc { place: PlaceId((first + at % length) as u32), weight: 1 };
                let other = Arc { place: PlaceId(random.below(first + 1) as u32), weight: 1 };
                let lower = random.below(4) as u64;
                let upper = (random.below(10) > 0).then_some(lower + random.below(4) as u64);
                let mut give = vec![arc(at + 1 + twin)];
                match random.below(16) {
                    0 => give.clear(),
                    1 => give.push(other),
                    _ => {}
                }
                let mut strict = || open && random.below(2) == 0;
                let (lower_strict, upper_strict) = (strict(), strict());
                let interval = Interval { lower, lower_strict, upper, upper_strict };
                let closed = Interval { lower_strict: false, upper_strict: false, ..interval };
                transitions.push(TimeTransition {
                    interval: if interval.is_empty() { closed } else { interval },
                    take: vec![arc(at)],
                    read: if random.below(8) == 0 { vec![other] } else { Vec::new() },
                    give,
                    ..TimeTransition::new(&format!("t{}", transitions.len()))
                });
            }
        }
    }
    TimeNet::new(String::new(), places, transitions).unwrap()
}

/// The most ticks until a place is marked, from each state; `None` without a limit.
fn longest(
    states: &States,
    state: usize,
    to: usize,
    known: &mut HashMap<usize, Option<u64>>,
) -> Option<u64> {
    if states.list[state].tokens[to] > 0 {
        return Some(0);
    }
    if let Some(known) = known.get(&state) {
        return *known;
    }
    // To come back to a state that is still looked at is to go round for ever.
    known.insert(state, None);
    let mut most = Some(0);
    for &(fired, next) in &states.edges[state] {
        let after = longest(states, next, to, known).map(|it| it + u64::from(fired.is_none()));
        most = most.zip(after).map(|(a, b)| a.max(b));
    }
    known.insert(state, most);
    most
}

/// Whether, whenever one place is marked, another one is at most so many ticks later.
fn responds(states: &States, from: usize, limit: u64, to: usize) -> bool {
    let mut known = HashMap::new();
    (0..states.list.len())
        .filter(|&it| states.list[it].tokens[from] > 0)
        .all(|it| longest(states, it, to, &mut known).is_some_and(|most| most <= limit))
}

/// A question with its answer by the book.
fn questions(
    random: &mut Random,
    net: &TimeNet,
    states: &States,
) -> Vec<(&'static str, Property, String)> {
    let untimed = net.untimed();
    let mut all = Vec::new();
    let a = random.below(net.places().len());
    // Another one: no place stands twice in a sum.
    let b = (a + 1 + random.below(net.places().len() - 1)) % net.places().len();
    let (one, other) = (&net.places()[a].name, &net.places()[b].name);
    let transition = random.below(net.transitions().len());
    let tokens = 1 + random.below(2) as u32;
    let limit = random.below(12) as u64;
    let some = |goal: &dyn Fn(&State) -> bool| states.list.iter().any(goal);
    let parse =
        |text: &str| property::parse(text, &untimed).unwrap_or_else(|error| panic!("{error}"));
    let mut ask = |kind, text: String, expected: String| all.push((kind, parse(&text), expected));
    let both = states.markings().iter().any(|it| it[a] >= tokens && it[b] > 0);
    ask("reachable", format!("EF ({one} >= {tokens} & {other})"), both.to_string());
    ask("always", format!("AG !({one} >= {tokens} & {other})"), (!both).to_string());
    ask("deadlock", "EF deadlock".into(), (!states.dead().is_empty()).to_string());
    ask(
        "one safe",
        "one_safe".into(),
        (!some(&|it| it.tokens.iter().any(|&it| it > 1))).to_string(),
    );
    let text = format!("AG {one} + {other} <= 1 | EF ({one} >= {tokens} & {other})");
    let one_of_them = !some(&|it| it.tokens[a] + it.tokens[b] > 1);
    ask("either", text, (one_of_them || both).to_string());
    let most = states.list.iter().map(|it| it.tokens[a] + it.tokens[b]).max().unwrap();
    ask("bounds", format!("bounds({one} + {other})"), most.to_string());
    let fires = |it: usize| states.edges.iter().flatten().any(|edge| edge.0 == Some(it));
    ask("quasi live", "quasi_live".into(), (0..net.transitions().len()).all(fires).to_string());
    let name = &net.transitions()[transition].name;
    ask("response", format!("bound({name} -> {other})"), states.bound(transition, b));
    let within = responds(states, a, limit, b);
    ask("in time", format!("AG ({one} -> AF<={limit}ms {other})"), within.to_string());
    all
}

fn shown(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Holds(holds) => holds.to_string(),
        Verdict::Bound(Extent::Finite(most)) => most.to_string(),
        Verdict::Response(Some((min, max))) => format!("{min}..{max}"),
        Verdict::Response(None) => "never fires".to_owned(),
        other => format!("{other:?}"),
    }
}

/// Plays the schedule of an answer; the run is the same without dates. Whether there is one.
fn plays(net: &TimeNet, answer: &Answer) -> bool {
    let Some(schedule) = &answer.schedule else {
        assert_eq!(answer.run, None);
        return false;
    };
    let firings: Vec<TransitionId> = schedule.steps.iter().map(|it| it.transition).collect();
    let run = answer.run.as_ref().unwrap();
    let cycle = if let Rest::Cycle(cycle) = &run.rest { &cycle[..] } else { &[] };
    assert_eq!([&run.stem[..], cycle].concat(), firings);
    schedule::replay(net, schedule).unwrap_or_else(|error| panic!("{error}"));
    true
}

#[test]
fn five_hundred_time_nets_agree_with_integer_clocks() {
    time_nets_are_what_integer_clocks_say(5, 500);
}

#[test]
#[ignore = "seconds: CI runs it"]
fn two_thousand_time_nets_agree_with_integer_clocks() {
    time_nets_are_what_integer_clocks_say(4, 2_000);
}

fn time_nets_are_what_integer_clocks_say(seed: u64, nets: usize) {
    let mut random = Random(seed);
    // Counts by kind: no or a number, yes or a time, unknown.
    let mut counts = BTreeMap::<&str, [usize; 3]>::new();
    let (mut schedules, mut certified, mut compared) = (0, 0, 0);
    while compared < nets {
        let net = net(&mut random, false);
        let Some(states) = discrete::states(&net, 600, 4) else { continue };
        let asked = questions(&mut random, &net, &states);
        let properties: Vec<Property> = asked.iter().map(|it| it.1.clone()).collect();
        let model = Model::from(net.clone());
        let answers = check_all(&model, &properties, &Options::default());
        for ((kind, property, expected), answer) in asked.iter().zip(&answers) {
            let count = counts.entry(kind).or_default();
            if matches!(answer.verdict, Verdict::Unknown(_)) {
                count[2] += 1;
                continue;
            }
            assert_eq!(
                &shown(&answer.verdict),
                expected,
                "{}\n{}",
                property.name,
                tina::write(&net)
            );
            count[usize::from(expected == "true" || expected.contains(".."))] += 1;
            schedules += usize::from(plays(&net, answer));
            if let Ok(certificate) = answer.certificate(model.pt(), property) {
                verify(&certificate.text())
                    .unwrap_or_else(|error| panic!("{}: {error}", property.name));
                certified += 1;
            }
        }
        compared += 1;
    }
    assert!(counts.values().all(|it| it[2] == 0), "{counts:?}");
    for (kind, noes, yeses) in [
        ("always", 450, 1_400),
        ("deadlock", 1_700, 200),
        ("response", 500, 1_400),
        ("in time", 1_100, 500),
    ] {
        let [noes, yeses] = [noes, yeses].map(|of_2000| of_2000 * nets / 2_000);
        assert!(counts[kind][0] >= noes && counts[kind][1] >= yeses, "{kind}: {counts:?}");
    }
    assert!(schedules > nets / 2 && certified > nets * 5 / 2, "{schedules} {certified}");
}
