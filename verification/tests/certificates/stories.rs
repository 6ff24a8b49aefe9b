//! The nets that the tests speak of.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_verification::certificate::{Formula, Linear};
use cotama_verification::pt::Pt;

type Arcs<'a> = &'a [(&'a str, u32)];

pub(crate) fn net(name: &str, places: Arcs, transitions: &[(&str, Arcs, Arcs)]) -> Pt {
    let mut net = OwnedNet::new(name, "");
    let ids: Vec<_> = places
        .iter()
        .map(|&(name, tokens)| net.place(OwnedPlace::new(name, tokens)).unwrap())
        .collect();
    let id = |name: &str| ids[places.iter().position(|it| it.0 == name).unwrap()];
    for (name, take, give) in transitions {
        let mut transition = OwnedTransition::new(name);
        for &(place, weight) in *take {
            transition = transition.take(id(place), weight);
        }
        for &(place, weight) in *give {
            transition = transition.give(id(place), weight);
        }
        net.transition(transition).unwrap();
    }
    Pt::from(&net.view().net())
}

/// Two robots and one track: at most one of them is on it.
pub(crate) fn track() -> Pt {
    net(
        "track",
        &[("free", 1), ("wait1", 1), ("on1", 0), ("wait2", 1), ("on2", 0)],
        &[
            ("enter1", &[("free", 1), ("wait1", 1)], &[("on1", 1)]),
            ("leave1", &[("on1", 1)], &[("free", 1), ("wait1", 1)]),
            ("enter2", &[("free", 1), ("wait2", 1)], &[("on2", 1)]),
            ("leave2", &[("on2", 1)], &[("free", 1), ("wait2", 1)]),
        ],
    )
}

/// Two robots that take two tools in opposite order.
pub(crate) fn tools() -> Pt {
    net(
        "tools",
        &[("saw", 1), ("drill", 1), ("idle1", 1), ("half1", 0), ("idle2", 1), ("half2", 0)],
        &[
            ("saw1", &[("idle1", 1), ("saw", 1)], &[("half1", 1)]),
            ("drill1", &[("half1", 1), ("drill", 1)], &[("idle1", 1), ("saw", 1), ("drill", 1)]),
            ("drill2", &[("idle2", 1), ("drill", 1)], &[("half2", 1)]),
            ("saw2", &[("half2", 1), ("saw", 1)], &[("idle2", 1), ("saw", 1), ("drill", 1)]),
        ],
    )
}

/// A battery of two charges: work and charge, until it breaks.
pub(crate) fn battery() -> Pt {
    net(
        "battery",
        &[("full", 2), ("empty", 0), ("broken", 0)],
        &[
            ("work", &[("full", 1)], &[("empty", 1)]),
            ("charge", &[("empty", 1)], &[("full", 1)]),
            ("break", &[("empty", 2)], &[("broken", 1)]),
        ],
    )
}

pub(crate) fn linear(constant: i64, weights: &[(&str, i64)]) -> Linear {
    Linear { constant, weights: weights.iter().map(|it| (it.0.to_owned(), it.1)).collect() }
}

/// `tokens >= least`
pub(crate) fn has(place: &str, least: i64) -> Formula {
    Formula::AtMost(linear(least, &[(place, -1)]))
}

/// `tokens <= most`
pub(crate) fn at_most(place: &str, most: i64) -> Formula {
    Formula::AtMost(linear(-most, &[(place, 1)]))
}

pub(crate) fn fireable(transition: &str) -> Formula {
    Formula::Fireable(vec![transition.to_owned()])
}

pub(crate) fn not(a: Formula) -> Formula {
    Formula::Not(Box::new(a))
}

pub(crate) fn e(a: Formula) -> Formula {
    Formula::Exists(Box::new(a))
}

pub(crate) fn a(a: Formula) -> Formula {
    Formula::All(Box::new(a))
}

pub(crate) fn ex(a: Formula) -> Formula {
    Formula::ExistsNext(Box::new(a))
}

pub(crate) fn ax(a: Formula) -> Formula {
    Formula::AllNext(Box::new(a))
}

pub(crate) fn x(a: Formula) -> Formula {
    Formula::Next(Box::new(a))
}

pub(crate) fn f(a: Formula) -> Formula {
    Formula::Finally(Box::new(a))
}

pub(crate) fn g(a: Formula) -> Formula {
    Formula::Globally(Box::new(a))
}

pub(crate) fn u(a: Formula, b: Formula) -> Formula {
    Formula::Until(Box::new((a, b)))
}
