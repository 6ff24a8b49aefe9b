//! Stories of systems that fit together, or do not.

use super::{
    Binding, Clear, Component, Culprit, Delivery, Link, Of, Step, System, SystemError, Target,
    judge,
};
use crate::net::owned::{
    OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition,
};
use crate::net::{Arc, EventId, Net, OutputId, PlaceId, Role, TransitionId};
use crate::player::{Packed, words};
use crate::{net, system};
use std::string::ToString;
use std::vec::Vec;

net! {
    /// Passes ten signals on.
    mod relay {
        places { On: 1 }
        events { e0, e1, e2, e3, e4, e5, e6, e7, e8, e9 }
        outputs { o0, o1, o2, o3, o4, o5, o6, o7, o8, o9 }
        transitions {
            t0 on e0: On => On emit o0;
            t1 on e1: On => On emit o1;
            t2 on e2: On => On emit o2;
            t3 on e3: On => On emit o3;
            t4 on e4: On => On emit o4;
            t5 on e5: On => On emit o5;
            t6 on e6: On => On emit o6;
            t7 on e7: On => On emit o7;
            t8 on e8: On => On emit o8;
            t9 on e9: On => On emit o9;
        }
    }
}

// Six nets in a chain: as many paths as 10^5.
system! {
    /// Six relays, ten rendezvous from each to the next.
    mod chain {
        nets { a: relay, b: relay, c: relay, d: relay, e: relay, f: relay }
        links {
            a.o0 => b.e0 now; a.o1 => b.e1 now; a.o2 => b.e2 now; a.o3 => b.e3 now;
            a.o4 => b.e4 now; a.o5 => b.e5 now; a.o6 => b.e6 now;
            a.o7 => b.e7 now; a.o8 => b.e8 now; a.o9 => b.e9 now;
            b.o0 => c.e0 now; b.o1 => c.e1 now; b.o2 => c.e2 now; b.o3 => c.e3 now;
            b.o4 => c.e4 now; b.o5 => c.e5 now; b.o6 => c.e6 now;
            b.o7 => c.e7 now; b.o8 => c.e8 now; b.o9 => c.e9 now;
            c.o0 => d.e0 now; c.o1 => d.e1 now; c.o2 => d.e2 now; c.o3 => d.e3 now;
            c.o4 => d.e4 now; c.o5 => d.e5 now; c.o6 => d.e6 now;
            c.o7 => d.e7 now; c.o8 => d.e8 now; c.o9 => d.e9 now;
            d.o0 => e.e0 now; d.o1 => e.e1 now; d.o2 => e.e2 now; d.o3 => e.e3 now;
            d.o4 => e.e4 now; d.o5 => e.e5 now; d.o6 => e.e6 now;
            d.o7 => e.e7 now; d.o8 => e.e8 now; d.o9 => e.e9 now;
            e.o0 => f.e0 now; e.o1 => f.e1 now; e.o2 => f.e2 now; e.o3 => f.e3 now;
            e.o4 => f.e4 now; e.o5 => f.e5 now; e.o6 => f.e6 now;
            e.o7 => f.e7 now; e.o8 => f.e8 now; e.o9 => f.e9 now;
        }
    }
}

#[test]
fn parallel_rendezvous_are_followed_once() {
    assert_eq!(chain::SYSTEM.links.len(), 50);
    assert_eq!(chain::SYSTEM.defect(), None);
}

const fn of<T>(component: u16, id: T) -> Of<T> {
    Of { component, id }
}

fn link(from: u16, to: u16, signal: u32, delivery: Delivery) -> Link {
    Link { from: of(from, OutputId(signal)), to: of(to, EventId(signal)), delivery }
}

fn relays(count: usize) -> Vec<Component<'static>> {
    std::vec![Component { name: "relay", net: &relay::NET }; count]
}

fn linked<'s>(components: &'s [Component<'s>], links: &'s [Link]) -> System<'s> {
    System { name: "linked", doc: "", components, links, bindings: &[], clears: &[] }
}

/// Nothing is looked for in a net that is not there.
#[test]
fn a_link_from_a_net_that_is_not_there_is_said() {
    let components = relays(2);
    for from in [2, 3, u16::MAX] {
        let links = [link(0, 1, 0, Delivery::Now), link(from, 1, 1, Delivery::Now)];
        let defect = linked(&components, &links).defect();
        assert_eq!(defect, Some(SystemError::UnknownId { list: "links", at: 1 }));
    }
}

#[test]
fn a_chain_of_eight_rendezvous_is_too_long_and_one_of_seven_is_not() {
    let components = relays(9);
    let chain = |count| (0..count).map(|at| link(at, at + 1, 0, Delivery::Now)).collect::<Vec<_>>();
    assert_eq!(linked(&components, &chain(7)).defect(), None);
    assert_eq!(linked(&components, &chain(8)).defect(), Some(SystemError::Circle { component: 0 }));
    let mut back = chain(7);
    back.push(link(3, 2, 1, Delivery::Now));
    let defect = linked(&components, &back).defect();
    assert_eq!(defect, Some(SystemError::Circle { component: 0 }));
    back[0].delivery = Delivery::Mail { capacity: 1 };
    let defect = linked(&components, &back).defect();
    assert_eq!(defect, Some(SystemError::Circle { component: 1 }));
    assert!(defect.unwrap().to_string().starts_with("rendezvous lead from net 1 back to it"));
}

#[test]
fn more_than_65_534_parts_of_a_kind_are_too_many() {
    let pair = relays(2);
    let links = |count| std::vec![link(0, 1, 0, Delivery::Now); count];
    // So many are looked at, and one link is there twice.
    let twice = linked(&pair, &links(65_534)).defect();
    assert_eq!(twice, linked(&pair, &links(2)).defect());
    assert_eq!(linked(&pair, &links(65_535)).defect(), Some(SystemError::TooLong));
    assert_eq!(linked(&relays(65_535), &[]).defect(), Some(SystemError::TooLong));
    let bound = Binding { shared: of(0, PlaceId(0)), target: Target::Place(of(1, PlaceId(0))) };
    let bindings = std::vec![bound; 65_535];
    let bound = System { bindings: &bindings, ..linked(&pair, &[]) };
    assert_eq!(bound.defect(), Some(SystemError::TooLong));
}

/// A system of 65,000 links and as many places is looked through in less than a minute, which a
/// look at every pair is not.
#[test]
fn large_systems_are_looked_through_at_once() {
    let mut net = OwnedNet::new("large", "");
    let mut owner = OwnedNet::new("owner", "");
    for at in 0..65_000_u32 {
        let name = at.to_string();
        let place = OwnedPlace::new(&name, 0).at_most(1);
        owner.place(place.clone()).unwrap();
        net.place(OwnedPlace { role: Role::Shared, ..place }).unwrap();
        net.event(&name, "").unwrap();
        owner.output(&name, "").unwrap();
        net.transition(OwnedTransition::new(&name).take(PlaceId(at), 1)).unwrap();
    }
    let (net, owner) = (net.view(), owner.view());
    let (net, owner): (Net<'_>, Net<'_>) = (net.net(), owner.net());
    let components =
        [Component { name: "net", net: &net }, Component { name: "owner", net: &owner }];
    let mail = Delivery::Mail { capacity: 1 };
    let links: Vec<Link> = (0..65_000).rev().map(|at| link(1, 0, at, mail)).collect();
    let bound =
        |at| Binding { shared: of(0, PlaceId(at)), target: Target::Place(of(1, PlaceId(at))) };
    let bindings: Vec<Binding> = (0..65_000).rev().map(bound).collect();
    let clears = [Clear { on: of(0, EventId(1)), mailbox: EventId(2) }];
    let whole = System {
        name: "large",
        doc: "",
        components: &components,
        links: &links,
        bindings: &bindings,
        clears: &clears,
    };
    assert_eq!(whole.defect(), None);
    let unbound = System { bindings: &bindings[1..], ..whole };
    assert_eq!(unbound.defect(), Some(SystemError::Unbound(of(0, PlaceId(64_999)))));
    let unsent = System { links: &links[..64_000], ..whole };
    assert_eq!(unsent.defect(), Some(SystemError::UnknownId { list: "clears", at: 0 }));

    let mut other = links.clone();
    (other[3].to, other[3].delivery) = (links[2].to, Delivery::Now);
    let differ = System { links: &other, ..whole };
    assert_eq!(differ.defect(), Some(SystemError::Delivery { at: 3 }));
    let mut other = bindings.clone();
    other[7].shared = bindings[6].shared;
    let twice = System { bindings: &other, ..whole };
    assert_eq!(twice.defect(), Some(SystemError::Binding { at: 7 }));
    other[7] = bindings[7];
    other[5].target = Target::Mailbox(of(0, EventId(64_994)));
    let changed = System { bindings: &other, ..whole };
    let transition = of(0, TransitionId(64_994));
    assert_eq!(changed.defect(), Some(SystemError::ChangesMailbox(transition)));
}

/// Two at once fit into a mailbox of two, not into one of one.
#[test]
fn a_transition_that_mails_more_than_fits_is_a_defect() {
    let mut net = OwnedNet::new("twice", "");
    let (a, b) = (net.output("a", "").unwrap(), net.output("b", "").unwrap());
    for (name, emits) in [("one", std::vec![a]), ("both", std::vec![a, b])] {
        net.transition(OwnedTransition { emits, ..OwnedTransition::new(name) }).unwrap();
    }
    let net = net.view();
    let net = net.net();
    let components =
        [Component { name: "relay", net: &relay::NET }, Component { name: "twice", net: &net }];
    let links = |capacity| {
        let delivery = Delivery::Mail { capacity };
        [a, b].map(|from| Link { from: of(1, from), to: of(0, EventId(0)), delivery })
    };
    assert_eq!(linked(&components, &links(2)).defect(), None);
    let defect = linked(&components, &links(1)).defect();
    assert_eq!(defect, Some(SystemError::Overfills(of(1, TransitionId(1)))));
}

/// A net of so many places, transitions, events, and events ignored.
fn sized(places: usize, transitions: usize, events: usize, ignored: usize) -> OwnedNet {
    let mut net = OwnedNet::new("sized", "");
    net.places = std::vec![OwnedPlace::new("place", 0).at_most(1); places];
    net.events = std::vec![OwnedSignal::default(); events];
    net.transitions = std::vec![OwnedTransition::new("transition"); transitions];
    net.ignored = std::vec![OwnedIgnored::new(EventId(0), PlaceId(0)); ignored];
    net
}

/// Whether the net can be packed alone.
fn fits(net: &OwnedNet) -> bool {
    let view = net.view();
    words(&System::alone(&[Component::alone(&view.net())])).is_some()
}

/// Each list of a packed system has up to 65,534 entries.
#[test]
fn a_packed_system_holds_its_limits_and_not_one_more() {
    assert!(fits(&sized(65_534, 0, 1, 0)) && !fits(&sized(65_535, 0, 1, 0)));
    assert!(fits(&sized(1, 65_534, 1, 0)) && !fits(&sized(1, 65_535, 1, 0)));
    assert!(fits(&sized(1, 0, 1, 65_534)) && !fits(&sized(1, 0, 1, 65_535)));
    // Two rows for each event, for what fires at once by itself, and for what waits.
    assert!(fits(&sized(1, 0, 32_765, 0)) && !fits(&sized(1, 0, 32_766, 0)));
    // Summands of all laws together.
    let summed = |more: u32| {
        let mut net = sized(40_000, 0, 1, 0);
        let sum = |count| (0..count).map(|at| Arc { place: PlaceId(at), weight: 1 }).collect();
        for count in [40_000, more] {
            net.laws.push(OwnedLaw::Invariant { sum: sum(count), equals: 0 });
        }
        fits(&net)
    };
    assert!(summed(25_534) && !summed(25_535));
    // The most events that wait in all mailboxes together, and the destinations of outputs.
    let pair = relays(2);
    let mails = |capacities: &[u16]| {
        let mail = |(signal, &capacity)| link(0, 1, signal, Delivery::Mail { capacity });
        let links: Vec<_> = (0..).zip(capacities).map(mail).collect();
        words(&linked(&pair, &links)).is_some()
    };
    assert!(mails(&[65_534]) && !mails(&[65_535]));
    assert!(mails(&[65_000, 534]) && !mails(&[65_000, 535]));
    let routes = |count| {
        let links = std::vec![link(0, 1, 0, Delivery::Now); count];
        words(&linked(&pair, &links)).is_some()
    };
    assert!(routes(65_534) && !routes(65_535));
}

/// An event that goes on by rendezvous over five nets is forgotten by the sixth.
#[test]
fn an_event_is_followed_over_six_nets() {
    let mut end = OwnedNet::new("end", "");
    end.places.push(OwnedPlace::new("end", 1).at_most(1));
    let forgotten = end.event("e0", "").unwrap();
    let view = end.view();
    let end = view.net();
    let mut components = relays(5);
    components.push(Component { name: "end", net: &end });
    let links: Vec<_> = (0..5).map(|at| link(at, at + 1, 0, Delivery::Now)).collect();
    let system = linked(&components, &links);
    let packed = Packed::<1>::of(&system).unwrap();
    let violation = judge(&system, &packed.code()).unwrap_err();
    assert_eq!(violation.culprit, Culprit::Unanswered(of(5, forgotten)));
    assert_eq!(violation.steps(), [Step::Offered(of(0, EventId(0)))]);
    let mut text = std::string::String::new();
    violation.write(&system, &packed.code(), &mut text).unwrap();
    assert!(text.contains("add a transition on it to `end`"), "{text}");
}
