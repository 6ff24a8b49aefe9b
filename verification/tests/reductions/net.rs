//! Small nets as text: places with their tokens, then transitions, `a:1 b | t: a ?c -> b*2; u: b
//! ->`.

use cotama_checker::reductions::{Effort, Goal, Keep, Limits, Reduced, Rule, reduce_within};
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::pt::Pt;

pub(crate) fn net(text: &str) -> Pt {
    let (places, transitions) = text.split_once('|').unwrap_or((text, ""));
    let mut net = OwnedNet::new("net", "");
    let mut ids = std::collections::BTreeMap::new();
    for place in places.split_whitespace() {
        let (name, tokens) = place.split_once(':').unwrap_or((place, "0"));
        ids.insert(name, net.place(OwnedPlace::new(name, tokens.parse().unwrap())).unwrap());
    }
    let arc = |arc: &str| {
        let (name, weight) =
            arc.split_once('*').map_or((arc, 1), |it| (it.0, it.1.parse().unwrap()));
        (ids[name], weight)
    };
    for transition in transitions.split(';').filter(|it| !it.trim().is_empty()) {
        let (name, arcs) = transition.split_once(':').unwrap();
        let (inputs, outputs) = arcs.split_once("->").unwrap();
        let mut it = OwnedTransition::new(name.trim());
        for input in inputs.split_whitespace() {
            it = match input.strip_prefix('?') {
                Some(read) => it.read(arc(read).0, arc(read).1),
                None => it.take(arc(input).0, arc(input).1),
            };
        }
        for output in outputs.split_whitespace() {
            it = it.give(arc(output).0, arc(output).1);
        }
        net.transition(it).unwrap();
    }
    Pt::from(&net.view().net())
}

pub(crate) fn text(pt: &Pt) -> String {
    let weighted = |read: &str, place: u32, weight: i64| {
        let weight = if weight == 1 { String::new() } else { format!("*{weight}") };
        format!(" {read}{}{weight}", pt.places[place as usize])
    };
    let place = |(name, tokens): (&String, &u32)| match tokens {
        0 => name.clone(),
        _ => format!("{name}:{tokens}"),
    };
    let transition = |(at, name): (u32, &String)| {
        let effect =
            |place: u32| pt.effects.of(at).iter().find(|it| it.0 == place).map_or(0, |it| it.1);
        let need = |place: u32| {
            pt.needs.of(at).iter().find(|it| it.0 == place).map_or(0, |it| it.1.into())
        };
        let input = |&(place, tokens): &(u32, u32)| {
            weighted(if effect(place) == 0 { "?" } else { "" }, place, tokens.into())
        };
        let inputs: String = pt.needs.of(at).iter().map(input).collect();
        let outputs = pt.effects.of(at).iter().filter(|it| need(it.0) + it.1 > 0);
        let outputs: String = outputs.map(|it| weighted("", it.0, need(it.0) + it.1)).collect();
        format!(" {name}:{inputs} ->{outputs}")
    };
    let places: Vec<_> = pt.places.iter().zip(&pt.initial).map(place).collect();
    let transitions: Vec<_> = (0..).zip(&pt.transitions).map(transition).collect();
    let space = if places.is_empty() { "" } else { " " };
    format!("{}{space}|{}", places.join(" "), transitions.join(";"))
}

pub(crate) fn keep(pt: &Pt, goal: Goal, visible: &[&str]) -> Keep {
    Keep { places: visible.iter().map(|it| pt.place(it).unwrap()).collect(), ..Keep::new(goal) }
}

/// Reduced by these rules alone.
pub(crate) fn reduced(pt: &Pt, rules: &[Rule], keep: &Keep) -> Reduced {
    let effort = Effort { rules: rules.to_vec(), ..Effort::default() };
    reduce_within(pt, keep, &Limits::default(), &effort)
}
