//! Small nets, written by hand.

use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, OutputId, PlaceId, Role};

/// Adds to a net; the ids are those of the new entries.
struct Build(OwnedNet);

impl Build {
    fn state(&mut self, name: &str, doc: &str, initial: u32) -> PlaceId {
        self.0.place(OwnedPlace::new(name, initial).at_most(1).doc(doc)).unwrap()
    }

    fn data(&mut self, name: &str, doc: &str, initial: u32, bound: u32) -> PlaceId {
        let place = OwnedPlace::new(name, initial).at_most(bound).doc(doc);
        self.0.place(OwnedPlace { role: Role::Data, ..place }).unwrap()
    }

    fn complement(&mut self, name: &str, of: PlaceId) -> PlaceId {
        let it = &self.0.places[of.0 as usize];
        let place = OwnedPlace::new(name, it.bound - it.initial).at_most(it.bound);
        self.0.place(OwnedPlace { role: Role::Complement(of), ..place }).unwrap()
    }

    fn event(&mut self, name: &str) -> EventId {
        self.0.event(name, "").unwrap()
    }

    fn output(&mut self, name: &str) -> OutputId {
        self.0.output(name, "").unwrap()
    }

    fn add(&mut self, transition: OwnedTransition) {
        self.0.transition(transition).unwrap();
    }
}

fn emitting(output: OutputId, transition: OwnedTransition) -> OwnedTransition {
    OwnedTransition { emits: vec![output], ..transition }
}

fn move_(name: &str, from: PlaceId, to: PlaceId) -> OwnedTransition {
    OwnedTransition::new(name).take(from, 1).give(to, 1)
}

fn stay(name: &str, state: PlaceId) -> OwnedTransition {
    OwnedTransition::new(name).read(state, 1)
}

/// A state machine with a flag, a counter and a group of states that one event aborts.
pub(crate) fn door() -> OwnedNet {
    let mut net = Build(OwnedNet::new(
        "cell door",
        "The door of a cell -- it counts its openings & wears out.",
    ));
    let closed = net.state("closed", "Shut.", 1);
    let moving = net.state("moving", "", 0);
    let open = net.state("open", "", 0);
    let worn = net.state("worn out", "Needs service.", 0);
    let aborted = net.state("aborted", "", 0);
    let locked = net.data("locked", "The key was turned.", 0, 1);
    let unlocked = net.complement("not locked", locked);
    let cycles = net.data("cycles", "Openings so far.", 0, 3);
    let left = net.complement("cycles left", cycles);
    let (press, limit, key) = (net.event("press"), net.event("limit.reached"), net.event("key"));
    let (abort, reset) = (net.event("abort"), net.event("reset"));
    let motor = net.output("motor on");
    let alarm = net.output("alarm");
    net.add(
        emitting(motor, move_("start", closed, moving))
            .on(press)
            .read(unlocked, 1)
            .doc("Starts <motor>."),
    );
    net.add(move_("opened", moving, open).on(limit).take(left, 1).give(cycles, 1));
    net.add(move_("wear", moving, worn).on(limit).read(cycles, 3));
    net.add(move_("close", open, closed).on(press));
    net.add(stay("lock", closed).on(key).take(unlocked, 1).give(locked, 1));
    net.add(stay("unlock", closed).on(key).take(locked, 1).give(unlocked, 1));
    for (place, name) in [(closed, "abort closed"), (moving, "abort moving"), (open, "abort open")]
    {
        let transition = emitting(alarm, move_(name, place, aborted).on(abort));
        net.add(OwnedTransition { priority: 10, ..transition });
    }
    let transition = move_("reset", aborted, closed).on(reset).take(cycles, 2).give(left, 2);
    net.add(transition);
    net.add(OwnedTransition {
        priority: -1,
        ..move_("reset early", aborted, closed).on(reset).read(left, 2)
    });
    net.0.ignored.push(OwnedIgnored::new(key, open));
    net.0.ignored.push(OwnedIgnored::new(reset, open).guard(locked, 1).guard(left, 2));
    let one = |place| Arc { place, weight: 1 };
    let states = [closed, moving, open, worn, aborted].map(one).to_vec();
    net.0.laws.push(OwnedLaw::Invariant { sum: states, equals: 1 });
    net.0.laws.push(OwnedLaw::NeverBoth(locked, moving));
    net.0.laws.push(OwnedLaw::Reachable(worn));
    net.0.laws.push(OwnedLaw::DeadlockFree { end: Some(worn) });
    net.0.laws.push(OwnedLaw::HandlesAll);
    net.0.laws.push(OwnedLaw::Deterministic);
    net.0
}

/// A state machine with every kind of interval.
pub(crate) fn traffic_light() -> OwnedNet {
    let mut net = Build(OwnedNet::new("light", "A traffic light at a crossing for walkers."));
    let red = net.state("red", "", 1);
    let green = net.state("green", "", 0);
    let amber = net.state("amber", "", 0);
    let waiting = net.data("waiting", "Somebody wants to walk.", 0, 1);
    let nobody = net.complement("nobody", waiting);
    let (button, extend) = (net.event("button"), net.event("extend"));
    let beep = net.output("beep");
    net.add(move_("go", red, green).within(30_000, Some(30_000)));
    net.add(stay("ask", green).on(button).take(nobody, 1).give(waiting, 1));
    net.add(move_("stop", green, amber).within(20_000, Some(25_000)));
    net.add(
        move_("stop early", green, amber)
            .take(waiting, 1)
            .give(nobody, 1)
            .within(5_000, Some(6_000)),
    );
    net.add(move_("extend", green, green).on(extend).within(0, Some(10_000)));
    net.add(emitting(beep, stay("tick", amber).within(1_000, Some(1_000))));
    net.add(move_("rest", amber, red).within(3_000, None));
    net.0.laws.push(OwnedLaw::AlwaysCan(green));
    net.0
}

/// Philosophers who take the left fork first.
pub(crate) fn philosophers(count: usize) -> OwnedNet {
    let mut net = Build(OwnedNet::new("philosophers", ""));
    let forks: Vec<PlaceId> = (0..count).map(|i| net.state(&format!("fork_{i}"), "", 1)).collect();
    for i in 0..count {
        let (left, right) = (forks[i], forks[(i + 1) % count]);
        let thinks = net.state(&format!("thinks_{i}"), "", 1);
        let waits = net.state(&format!("waits_{i}"), "", 0);
        let eats = net.state(&format!("eats_{i}"), "", 0);
        net.add(move_(&format!("take_left_{i}"), thinks, waits).take(left, 1));
        net.add(move_(&format!("take_right_{i}"), waits, eats).take(right, 1));
        net.add(move_(&format!("put_{i}"), eats, thinks).give(left, 1).give(right, 1));
        net.0.laws.push(OwnedLaw::Reachable(eats));
    }
    net.0.laws.push(OwnedLaw::DeadlockFree { end: None });
    net.0
}

/// Weights, reads and a place without a bound.
pub(crate) fn producer_consumer() -> OwnedNet {
    let mut net = Build(OwnedNet::new("producer and consumer", ""));
    let working = net.state("working", "", 1);
    let paused = net.state("paused", "", 0);
    let buffer = net.data("buffer", "Parts between the two.", 0, 7);
    let room = net.complement("room", buffer);
    let packed = net.0.place(OwnedPlace::new("packed", 0).doc("Boxes so far.")).unwrap();
    let pause = net.event("pause");
    let (make, pack) = (OwnedTransition::new("make"), OwnedTransition::new("pack"));
    net.add(make.read(working, 1).take(room, 2).give(buffer, 2));
    net.add(pack.take(buffer, 3).give(room, 3).give(packed, 1));
    net.add(move_("pause", working, paused).on(pause));
    net.add(move_("resume", paused, working).read(room, 5));
    let sum = vec![Arc { place: buffer, weight: 1 }, Arc { place: room, weight: 1 }];
    net.0.laws.push(OwnedLaw::Invariant { sum, equals: 7 });
    net.0.laws.push(OwnedLaw::Invariant {
        sum: vec![Arc { place: working, weight: 2 }, Arc { place: paused, weight: 2 }],
        equals: 2,
    });
    net.0.laws.push(OwnedLaw::Settles);
    net.0
}

/// A plain net: no events and no time. From a state one can go two ways, look, and come back.
pub(crate) fn choice() -> OwnedNet {
    let mut net = Build(OwnedNet::new("choice", "Two ways, and back."));
    let idle = net.state("idle", "", 1);
    let left = net.state("left", "", 0);
    let right = net.state("right hand", "", 0);
    net.add(move_("go left", idle, left));
    net.add(move_("go right", idle, right));
    net.add(stay("look", idle));
    net.add(move_("back from left", left, idle));
    net.add(move_("back", right, idle));
    net.0
}
