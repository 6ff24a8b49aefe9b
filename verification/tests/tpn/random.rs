//! Small nets by chance, with answers by two or three independent ways.

use crate::tpn::{discrete, regions, replay, shown, textbook};
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_verification::tpn::{self, Interval, Limits, Reach, TimeNet, TimePlace, TimeTransition};
use std::collections::BTreeSet;

/// Numbers that only look random.
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }

    fn one_in(&mut self, many: u64) -> bool {
        self.below(many) == 0
    }

    fn arcs(&mut self, places: u64, most: u64) -> Vec<Arc> {
        let count = self.below(most + 1);
        (0..count)
            .map(|_| Arc {
                place: PlaceId(self.below(places) as u32),
                weight: 1 + u32::from(self.one_in(6)),
            })
            .collect()
    }

    fn interval(&mut self, open: bool) -> Interval {
        loop {
            let lower = self.below(4);
            let strict = |it: &mut Self| open && it.one_in(2);
            let interval = Interval {
                lower,
                lower_strict: strict(self),
                upper: (!self.one_in(6)).then_some(lower + self.below(4)),
                upper_strict: strict(self),
            };
            if !interval.is_empty() {
                return interval;
            }
        }
    }

    fn net(&mut self, open: bool) -> TimeNet {
        let places = 2 + self.below(4);
        let transitions = 2 + self.below(4);
        let list = (0..places).map(|at| TimePlace {
            name: format!("p{at}"),
            label: None,
            initial: self.below(3).saturating_sub(u64::from(self.one_in(2))) as u32,
        });
        let list = list.collect();
        let transitions = (0..transitions).map(|at| {
            let take = loop {
                let take = self.arcs(places, 2);
                if !take.is_empty() || self.one_in(10) {
                    break take;
                }
            };
            TimeTransition {
                interval: self.interval(open),
                read: if self.one_in(4) { self.arcs(places, 1) } else { Vec::new() },
                give: self.arcs(places, 2),
                take,
                ..TimeTransition::new(&format!("t{at}"))
            }
        });
        let transitions = transitions.collect();
        TimeNet::new(String::new(), list, transitions).unwrap()
    }
}

impl Random {
    /// Two or three tokens that go round, and look at each other: what fires once mostly fires
    /// again.
    fn rings(&mut self, open: bool) -> TimeNet {
        let (mut places, mut transitions) = (Vec::new(), Vec::new());
        for ring in 0..2 + self.below(2) {
            let (first, length) = (places.len() as u64, 2 + self.below(3));
            for at in 0..length {
                let initial = u32::from(at == 0);
                places.push(TimePlace { name: format!("r{ring}p{at}"), label: None, initial });
                for twin in 0..=u64::from(self.one_in(3)) {
                    let arc = |at: u64| {
                        vec![Arc { place: PlaceId((first + at % length) as u32), weight: 1 }]
                    };
                    let interval = self.interval(open);
                    // without end no response has one
                    let upper = interval.upper.or(Some(interval.lower + 2));
                    transitions.push(TimeTransition {
                        interval: Interval { upper, ..interval },
                        take: arc(at),
                        read: if self.one_in(8) { self.arcs(first + 1, 1) } else { Vec::new() },
                        give: arc(at + 1 + twin),
                        ..TimeTransition::new(&format!("t{}", transitions.len()))
                    });
                }
            }
        }
        TimeNet::new(String::new(), places, transitions).unwrap()
    }
}

/// Whatever can be asked about reachable markings agrees with these.
fn agrees_on_markings(net: &TimeNet, markings: &BTreeSet<Vec<u32>>, dead: &BTreeSet<Vec<u32>>) {
    let limits = Limits::default();
    let classes = tpn::classes(net, &limits);
    let text = cotama_verification::tina::write(net);
    assert_eq!(classes.bounded(), Some(true), "{text}");
    let found: BTreeSet<_> =
        (0..classes.classes() as u32).map(|it| classes.marking(it).to_vec()).collect();
    assert_eq!(&found, markings, "{text}");
    assert_eq!(
        (classes.markings(), classes.dead_markings()),
        (markings.len(), dead.len()),
        "{text}"
    );
    match tpn::deadlock(net, &limits) {
        Reach::Reached(run) => {
            let last = replay::replay(net, &run).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert!(dead.contains(&last), "{text}");
        }
        Reach::Unreachable { classes: all } => {
            assert!(dead.is_empty(), "{text}");
            assert_eq!(all, classes.classes());
        }
        Reach::Unknown { limit, .. } => panic!("{limit:?}: {text}"),
    }
    let last = markings.iter().max_by_key(|it| it.iter().sum::<u32>()).unwrap();
    let Reach::Reached(run) = tpn::reach(net, |tokens| tokens == last, &limits) else {
        panic!("{text}")
    };
    assert_eq!(replay::replay(net, &run).as_ref(), Ok(last), "{text}");
}

fn has_a_time(response: &str) -> bool {
    response.starts_with(|it: char| it.is_ascii_digit()) && !response.ends_with("..0")
}

fn has_two_times(response: &str) -> bool {
    response.split_once("..").is_some_and(|(min, max)| min != max && max != "inf")
}

#[test]
fn a_thousand_closed_nets_agree_with_integer_clocks() {
    closed_nets_are_what_integer_clocks_say(1_000);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn twenty_thousand_closed_nets_agree_with_integer_clocks() {
    closed_nets_are_what_integer_clocks_say(20_000);
}

fn closed_nets_are_what_integer_clocks_say(nets: usize) {
    let mut random = Random(1);
    let (mut compared, mut responses, mut finite, mut unequal) = (0, 0, 0, 0);
    while compared < nets {
        let net = if compared % 2 == 0 { random.net(false) } else { random.rings(false) };
        let Some(states) = discrete::states(&net, 800, 4) else { continue };
        agrees_on_markings(&net, &states.markings(), &states.dead());
        let (from, to) =
            (random.below(net.transitions().len() as u64), random.below(net.places().len() as u64));
        for (from, to) in [(from, to), (from, 0), (0, to)] {
            let found =
                tpn::bound(&net, TransitionId(from as u32), PlaceId(to as u32), &Limits::default());
            let known = states.bound(from as usize, to as usize);
            let text = cotama_verification::tina::write(&net);
            assert_eq!(shown(found), known, "bound(t{from} -> p{to})\n{text}");
            responses += 1;
            finite += usize::from(has_a_time(&known));
            unequal += usize::from(has_two_times(&known));
        }
        compared += 1;
    }
    assert_eq!(responses, 3 * nets);
    // Answers that are none, zero or infinite prove less.
    assert!(
        finite > nets && unequal > nets * 2 / 5,
        "{finite} with a time, {unequal} of them with two"
    );
}

#[test]
fn two_hundred_open_nets_agree_with_clock_regions() {
    open_nets_are_what_clock_regions_say(200);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn two_thousand_open_nets_agree_with_clock_regions() {
    open_nets_are_what_clock_regions_say(2_000);
}

fn open_nets_are_what_clock_regions_say(nets: usize) {
    let mut random = Random(2);
    let (mut compared, mut finite, mut unequal) = (0, 0, 0);
    while compared < nets {
        let net = if compared % 2 == 0 { random.net(true) } else { random.rings(true) };
        let Some(regions) = regions::regions(&net, 500, 4) else { continue };
        agrees_on_markings(&net, &regions.markings(), &regions.dead());
        let (from, to) =
            (random.below(net.transitions().len() as u64), random.below(net.places().len() as u64));
        let found =
            tpn::bound(&net, TransitionId(from as u32), PlaceId(to as u32), &Limits::default());
        let Some(known) = regions.bound(from as usize, to as usize, 30) else { continue };
        assert_eq!(
            shown(found),
            known,
            "bound(t{from} -> p{to})\n{}",
            cotama_verification::tina::write(&net)
        );
        finite += usize::from(has_a_time(&known));
        unequal += usize::from(has_two_times(&known));
        compared += 1;
    }
    assert!(
        finite > nets / 5 && unequal > nets / 10,
        "{finite} with a time, {unequal} of them with two"
    );
}

#[test]
fn a_thousand_nets_have_the_classes_of_the_textbook() {
    let mut random = Random(3);
    let mut compared = 0;
    while compared < 1_000 {
        let net = random.net(compared % 2 == 1);
        if regions::regions(&net, 500, 4).is_none() {
            continue;
        }
        let Some((classes, edges)) = textbook::classes(&net, 500) else { continue };
        let found = tpn::classes(&net, &Limits::default());
        assert_eq!(
            (found.classes(), found.edges()),
            (classes, edges),
            "{}",
            cotama_verification::tina::write(&net)
        );
        compared += 1;
    }
}
