//! Boundedness.

use super::search::{Order, Search};
use super::word::Growth;
use super::{FIRINGS, Limit, Limits, Unfinished};
use crate::bounds::bounds;
use cotama_property::pt::Pt;

/// How many markings are met one after the other before another order is tried.
pub(super) const FIRST: u64 = 1_000;

/// Whether a net is bounded: whether it has finitely many reachable markings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bounded {
    /// The net is bounded.
    Yes,
    /// The net is unbounded, with a sequence that adds tokens.
    No(Growth),
    /// A limit was reached before either was shown.
    Unknown(Unfinished),
}

/// Whether a net is bounded. Sums of tokens that never grow, see [`bounds`](crate::bounds::bounds),
/// prove it for most bounded nets; otherwise markings are passed through. Of a net that [is not
/// plain](Pt::is_plain), where more tokens can disable, only the former is asked.
///
/// ```
/// use cotama_verification::coverability::{Bounded, Limits, bounded};
/// use cotama_verification::tina;
/// let belt = tina::read("belt.net", b"tr put on -> on full  pl on (1)").unwrap().untimed();
/// let Bounded::No(growth) = bounded(&belt, &Limits::default()) else { panic!("it fills") };
/// assert_eq!(growth.grows, [(belt.place("full").unwrap(), 1)]);
/// ```
pub fn bounded(pt: &Pt, limits: &Limits) -> Bounded {
    if !pt.is_plain() {
        return if bounds(pt).iter().all(Option::is_some) {
            Bounded::Yes
        } else {
            Bounded::Unknown(Unfinished::UNSUITED)
        };
    }
    let few = Limits { states: limits.states.min(FIRST), ..*limits };
    for order in [Order::First, Order::Greatest] {
        match search(pt, &few, order) {
            Bounded::Unknown(Unfinished { limit: Limit::States, .. }) if limits.states > FIRST => {}
            answer => return answer,
        }
    }
    if bounds(pt).iter().all(Option::is_some) {
        return Bounded::Yes;
    }
    search(pt, limits, Order::Greatest)
}

fn search(pt: &Pt, limits: &Limits, order: Order) -> Bounded {
    let mut search = Search::new(pt, order);
    let is_raised = &mut |marking: &[super::Tokens]| marking.iter().any(|it| it.is_omega());
    match search.run(limits, is_raised) {
        Ok(None) => Bounded::Yes,
        Ok(Some(id)) => match search.pumping(id, FIRINGS) {
            Some(growth) => Bounded::No(growth),
            None => Bounded::Unknown(Unfinished { limit: Limit::Tokens, nodes: search.nodes() }),
        },
        Err(unfinished) => Bounded::Unknown(unfinished),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_core::net::PlaceId;
    use cotama_formats::tina;

    #[test]
    fn a_stem_and_a_pump_are_counted_one_by_one() {
        let net = b"tr put a -> b*3  tr turn b*3 -> a c  pl a (1)";
        let pt = tina::read("long.net", net).unwrap().untimed();
        let mut search = Search::new(&pt, Order::First);
        let found = search.run(&Limits::default(), &mut |it| it.iter().any(|it| it.is_omega()));
        let growth = search.pumping(found.unwrap().unwrap(), 1).unwrap();
        assert_eq!(
            (growth.stem.firings, growth.pump.length, growth.pump.firings),
            (Some(vec![]), 2, None)
        );
        assert_eq!(growth.grows, [(PlaceId(2), 1)]);
    }
}
