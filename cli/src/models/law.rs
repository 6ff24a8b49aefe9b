//! Laws in words of the net language.

use cotama_core::net::{Law, Net, PlaceId};

/// A law as the net language writes it; sums have weights where they are not one.
pub(crate) fn text(net: &Net<'_>, law: &Law<'_>) -> String {
    let name = |PlaceId(id): PlaceId| net.places.get(id as usize).map_or("?", |place| place.name);
    match *law {
        Law::Invariant { sum, equals } => {
            let term = |arc: &cotama_core::net::Arc| match arc.weight {
                1 => name(arc.place).to_owned(),
                weight => format!("{weight} {}", name(arc.place)),
            };
            let sum: Vec<_> = sum.iter().map(term).collect();
            format!("invariant({} = {equals})", sum.join(" & "))
        }
        Law::NeverBoth(a, b) => format!("never_both({}, {})", name(a), name(b)),
        Law::Reachable(place) => format!("reachable({})", name(place)),
        Law::AlwaysCan(place) => format!("always_can({})", name(place)),
        Law::HandlesAll => "handles(all)".to_owned(),
        Law::Settles => "settles".to_owned(),
        Law::DeadlockFree { end: None } => "deadlock_free".to_owned(),
        Law::DeadlockFree { end: Some(end) } => format!("deadlock_free_except({})", name(end)),
        Law::Deterministic => "deterministic".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::nets::{door, find};

    #[test]
    fn laws_read_as_they_were_written() {
        let net = &door::NET;
        let said: Vec<_> = net.laws.iter().map(|law| text(net, law)).collect();
        let written = [
            "invariant(Closed & Opening & Open & Closing & Blocked = 1)",
            "never_both(Closing, obstacle)",
            "handles(all)",
            "deterministic",
            "deadlock_free",
            "always_can(Closed)",
            "always_can(Open)",
            "always_can(Blocked)",
        ];
        assert_eq!(said, written);
    }

    #[test]
    fn weights_are_said_where_they_are_not_one() {
        let mut net = find("kanban:1").unwrap();
        let arc = |place, weight| cotama_core::net::Arc { place: PlaceId(place), weight };
        let sum = vec![arc(0, 1), arc(1, 3)];
        net.laws = vec![cotama_core::net::owned::OwnedLaw::Invariant { sum, equals: 4 }];
        let view = net.view();
        let net = view.net();
        let [first, second] = [0, 1].map(|place| net.places[place].name);
        assert_eq!(text(&net, &net.laws[0]), format!("invariant({first} & 3 {second} = 4)"));
    }
}
