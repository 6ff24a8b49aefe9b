//! Laws, evaluated on the textbook's graph.

use crate::textbook::{Graph, Marking, enabled, immediate, settled};
use cotama_core::net::{EventId, Law, Net, PlaceId, Role, Transition};

/// The first law that does not hold, by its name. What roles say and that the net settles belongs
/// to the laws.
pub(crate) fn broken(net: &Net<'_>, graph: &Graph) -> Option<&'static str> {
    if roles_are_broken(net, graph) {
        return Some("complement");
    }
    if !net.events.is_empty() && graph.longest_settling(net).is_none() {
        return Some("settles");
    }
    net.laws.iter().find(|law| !holds(net, graph, law)).map(name)
}

/// Whether some complement is none.
pub(crate) fn roles_are_broken(net: &Net<'_>, graph: &Graph) -> bool {
    let roles = |marking: &Marking| {
        net.places.iter().zip(marking).all(|(place, tokens)| match place.role {
            Role::Complement(of) => marking[of.0 as usize] + tokens == place.bound,
            _ => true,
        })
    };
    !graph.markings.iter().all(roles)
}

/// Returns the name of a law.
pub(crate) fn name(law: &Law<'_>) -> &'static str {
    match law {
        Law::Invariant { .. } => "invariant",
        Law::NeverBoth(..) => "never_both",
        Law::Reachable(_) => "reachable",
        Law::AlwaysCan(_) => "always_can",
        Law::HandlesAll => "handles(all)",
        Law::Settles => "settles",
        Law::DeadlockFree { .. } => "deadlock_free",
        Law::Deterministic => "deterministic",
    }
}

fn holds(net: &Net<'_>, graph: &Graph, law: &Law<'_>) -> bool {
    let marked = |place: PlaceId| move |marking: &Marking| marking[place.0 as usize] > 0;
    let mut all = graph.markings.iter();
    match *law {
        Law::Invariant { sum, equals } => all.all(|marking| {
            sum.iter().map(|arc| arc.weight * marking[arc.place.0 as usize]).sum::<u32>() == equals
        }),
        Law::NeverBoth(a, b) => !all.any(|marking| marked(a)(marking) && marked(b)(marking)),
        Law::Reachable(place) => all.any(marked(place)),
        Law::AlwaysCan(place) => graph.leading_to(marked(place)).into_iter().all(|leads| leads),
        Law::HandlesAll => all.filter(|marking| settled(net, marking)).all(|marking| {
            (0..net.events.len()).all(|event| {
                let uses =
                    net.transitions.iter().any(|it| is_on(it.on, event) && enabled(it, marking));
                uses || net
                    .ignored
                    .iter()
                    .any(|it| is_on(Some(it.event), event) && it.holds(|at| marking[at.0 as usize]))
            })
        }),
        Law::Settles => graph.longest_settling(net).is_some(),
        Law::DeadlockFree { end } => {
            let mut each = all.zip(&graph.firings);
            each.all(|(marking, firings)| {
                !firings.is_empty() || end.is_some_and(|end| marked(end)(marking))
            })
        }
        Law::Deterministic => all.all(|marking| {
            let on = |event| move |it: &&Transition<'_>| is_on(it.on, event);
            let able = || net.transitions.iter().filter(|it| enabled(it, marking));
            let urgent = able().filter(|it| immediate(it)).count();
            urgent == 1
                || urgent == 0
                    && (0..net.events.len()).all(|event| able().filter(on(event)).count() < 2)
        }),
    }
}

fn is_on(on: Option<EventId>, event: usize) -> bool {
    on.is_some_and(|it| it.0 as usize == event)
}
