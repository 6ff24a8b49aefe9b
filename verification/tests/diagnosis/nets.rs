//! Small nets, most of them with a mistake in them.

use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_models::nets::find;

/// A net that is written down: places first, then lines such as `2 a + ?b -> c`, where `?` reads.
pub(crate) struct Sketch(pub(crate) OwnedNet);

impl Sketch {
    pub(crate) fn new(name: &str, doc: &str, places: &[(&str, u32, &str)]) -> Self {
        let mut net = OwnedNet::new(name, doc);
        for (name, tokens, doc) in places {
            net.place(OwnedPlace::new(name, *tokens).doc(doc)).unwrap();
        }
        Self(net)
    }

    fn place(&self, name: &str) -> PlaceId {
        let at = self.0.places.iter().position(|it| it.name == name);
        PlaceId(at.unwrap_or_else(|| panic!("no place {name}")) as u32)
    }

    /// A transition, on an event unless that is empty, that emits an output unless that is empty.
    pub(crate) fn line(mut self, name: &str, arcs: &str, on: &str, emits: &str) -> Self {
        let mut it = OwnedTransition::new(name);
        let (from, to) = arcs.split_once("->").unwrap();
        let arcs = |side: &str| -> Vec<(bool, u32, PlaceId)> {
            let arc = |text: &str| {
                let (read, text) =
                    text.strip_prefix('?').map_or((false, text), |text| (true, text));
                let (weight, place) =
                    text.split_once(' ').map_or((1, text), |it| (it.0.parse().unwrap(), it.1));
                (read, weight, self.place(place))
            };
            side.split('+').map(str::trim).filter(|it| !it.is_empty()).map(arc).collect()
        };
        for (read, weight, place) in arcs(from) {
            it = if read { it.read(place, weight) } else { it.take(place, weight) };
        }
        for (_, weight, place) in arcs(to) {
            it = it.give(place, weight);
        }
        if !on.is_empty() {
            let known = self.0.events.iter().position(|it| it.name == on);
            let known = known.map(|at| cotama_core::net::EventId(at as u32));
            it.on = Some(known.unwrap_or_else(|| self.0.event(on, "").unwrap()));
        }
        if !emits.is_empty() {
            let output = self.0.output(emits, "").unwrap();
            it.emits.push(output);
        }
        self.0.transition(it).unwrap();
        self
    }

    /// The last transition in an interval.
    pub(crate) fn within(mut self, earliest: u32, latest: u32) -> Self {
        let last = self.0.transitions.last_mut().unwrap();
        *last = last.clone().within(earliest, Some(latest));
        self
    }

    /// The documentation of the last transition.
    pub(crate) fn doc(mut self, doc: &str) -> Self {
        doc.clone_into(&mut self.0.transitions.last_mut().unwrap().doc);
        self
    }
}

/// Philosophers who take the left fork first.
pub(crate) fn philosophers() -> OwnedNet {
    let mut places = Vec::new();
    for at in ["a", "b", "c"] {
        places.push((format!("{at}_thinks"), 1, format!("Philosopher {at} holds no fork.")));
        places.push((
            format!("{at}_has_left"),
            0,
            format!("Philosopher {at} holds the left fork."),
        ));
        places.push((format!("{at}_eats"), 0, format!("Philosopher {at} holds both forks.")));
        places.push((
            format!("fork_{at}"),
            1,
            format!("The fork to the left of {at} lies on the table."),
        ));
    }
    let places: Vec<_> = places.iter().map(|it| (it.0.as_str(), it.1, it.2.as_str())).collect();
    let mut net = Sketch::new("philosophers", "Three philosophers and three forks.", &places);
    for (at, next) in [("a", "b"), ("b", "c"), ("c", "a")] {
        let line = |name: &str| format!("{at}_{name}");
        net = net
            .line(
                &line("takes_left"),
                &format!("{at}_thinks + fork_{at} -> {at}_has_left"),
                &line("hungry"),
                "",
            )
            .line(
                &line("takes_right"),
                &format!("{at}_has_left + fork_{next} -> {at}_eats"),
                &line("reaches"),
                "",
            )
            .line(
                &line("puts_back"),
                &format!("{at}_eats -> {at}_thinks + fork_{at} + fork_{next}"),
                &line("full"),
                "",
            );
    }
    net.0
}

/// Two trains and one section of single track. The signal of the east does not look at the section.
pub(crate) fn trains() -> OwnedNet {
    let places = [
        ("west_far", 1, "The western train is not near."),
        ("west_at_signal", 0, "The western train waits at its signal."),
        ("west_in_section", 0, "The western train is in the section."),
        ("east_far", 1, "The eastern train is not near."),
        ("east_at_signal", 0, "The eastern train waits at its signal."),
        ("east_in_section", 0, "The eastern train is in the section."),
        ("section_free", 1, "No train has been let into the section."),
    ];
    Sketch::new("single_track", "Two trains and one section of single track.", &places)
        .line("west_arrives", "west_far -> west_at_signal", "WestSeen", "")
        .line("west_enters", "west_at_signal + section_free -> west_in_section", "WestPasses", "")
        .line("west_leaves", "west_in_section -> west_far + section_free", "WestGone", "")
        .line("east_arrives", "east_far -> east_at_signal", "EastSeen", "")
        .line("east_enters", "east_at_signal -> east_in_section", "EastPasses", "")
        .doc("The signal of the east shows green.")
        .line("east_leaves", "east_in_section -> east_far", "EastGone", "")
        .0
}

/// A mailbox of three messages that nobody guards.
pub(crate) fn mailbox() -> OwnedNet {
    let places = [
        ("planner_idle", 1, "The planner waits for a message."),
        ("planner_busy", 0, "The planner works on a message."),
        (
            "mailbox",
            0,
            "Messages from the sensor that wait for the planner; there is room for three.",
        ),
    ];
    Sketch::new("mailbox", "A sensor that writes to a planner.", &places)
        .line("post", "-> mailbox", "Measured", "")
        .line("fetch", "planner_idle + mailbox -> planner_busy", "Poll", "")
        .line("finish", "planner_busy -> planner_idle", "Planned", "Plan")
        .0
}

/// Two belts that one robot fills and one empties.
pub(crate) fn belts() -> OwnedNet {
    let places = [
        ("crates", 5, "Crates that wait in front of the robot."),
        ("belt_a", 0, "Crates on belt A."),
        ("belt_b", 0, "Crates on belt B."),
        ("shipped", 0, "Crates that have left."),
    ];
    Sketch::new("belts", "Two belts whose motors share a fuse for three crates.", &places)
        .line("load_pair", "2 crates -> 2 belt_a", "PairReady", "")
        .line("load_one", "crates -> belt_b", "CrateReady", "")
        .line("unload_a", "belt_a -> shipped", "EndA", "")
        .line("unload_b", "belt_b -> shipped", "EndB", "")
        .0
}

/// A server that may poll for ever and never serve.
pub(crate) fn server() -> OwnedNet {
    let places = [
        ("idle", 1, "The server has nothing in hand."),
        ("polling", 0, "The server looks after the sensors."),
        ("request", 0, "Somebody waits for an answer."),
        ("quiet", 1, "Nobody waits for an answer."),
        ("served", 0, "The answer was given."),
    ];
    Sketch::new("server", "A server with two duties.", &places)
        .line("ask", "quiet -> request", "Asked", "")
        .line("poll", "idle -> polling", "Tick", "")
        .line("polled", "polling -> idle", "Read", "")
        .line("serve", "?idle + request -> served", "Turn", "Answer")
        .line("thank", "served -> quiet", "Thanked", "")
        .0
}

/// A watchdog whose timer starts anew when the log is rotated, not only when the module says that
/// it is alive.
pub(crate) fn watchdog() -> OwnedNet {
    let places = [
        ("alive", 1, "The module works."),
        ("hung", 0, "The module hangs, and nobody knows."),
        ("overdue", 0, "The module has been hanging for 300 ms, and nobody knows."),
        ("stopped", 0, "The robot was stopped."),
        ("watching", 1, "The watchdog waits for the next beat."),
        ("expired", 0, "No beat came in time."),
    ];
    Sketch::new("heartbeat", "A module that hangs is to be noticed within 300 ms.", &places)
        .line("limit", "hung -> overdue", "", "")
        .within(300, 300)
        .doc("The module has been hanging for 300 ms.")
        .line("hang", "alive -> hung", "Crash", "")
        .line("beat", "?alive + watching -> watching", "", "")
        .within(100, 100)
        .doc("The module says that it is alive.")
        .line("rotate", "watching -> watching", "LogFull", "NewLog")
        .doc("The watchdog starts a new log.")
        .line("timeout", "watching -> expired", "", "Alarm")
        .within(250, 250)
        .line("stop", "expired + hung -> stopped", "", "MotorsOff")
        .0
}

/// The shipped crossing, where pedestrians do not wait for the red of the cars.
pub(crate) fn crossing() -> OwnedNet {
    let mut net = find("crossing").unwrap();
    let red = net.places.iter().position(|it| it.name == "Red").unwrap() as u32;
    let walk = net.transitions.iter_mut().find(|it| it.name == "walk").unwrap();
    walk.read.retain(|it| it.place.0 != red);
    net.laws.clear();
    net
}

/// The shipped charger, where heat in the phase of constant current does not switch off.
pub(crate) fn charger() -> OwnedNet {
    let mut net = find("charger").unwrap();
    let place = |name: &str| net.places.iter().position(|it| it.name == name).unwrap() as u32;
    let (current, on) = (place("Current"), place("on"));
    let mistake = |it: &&mut OwnedTransition| {
        it.name.starts_with("overheat") && it.take.iter().any(|it| it.place.0 == current)
    };
    let overheat = net.transitions.iter_mut().find(mistake).unwrap();
    let switch = overheat.take.iter().position(|it| it.place.0 == on).unwrap();
    let switch = overheat.take.remove(switch);
    overheat.read.push(switch);
    let off =
        net.places.iter().position(|it| it.role == cotama_core::net::Role::Complement(PlaceId(on)));
    overheat.give.retain(|it| Some(it.place.0 as usize) != off);
    net.laws.clear();
    net
}

/// An alarm that nothing can raise: the sensor's line is not connected.
pub(crate) fn alarm() -> OwnedNet {
    let places = [
        ("driving", 1, "The robot drives."),
        ("standing", 0, "The robot stands."),
        ("hard_fault", 0, "A motor driver has reported a fault."),
        ("soft_fault", 0, "A motor is too warm."),
        ("logged", 0, "The fault stands in the log."),
    ];
    Sketch::new("faults", "What faults of the motors do.", &places)
        .line("warm_up", "?driving -> soft_fault", "Warm", "")
        .line("cool_down", "soft_fault ->", "Cool", "")
        .line(
            "emergency_stop",
            "driving + hard_fault -> standing + hard_fault",
            "Fault",
            "MotorsOff",
        )
        .line("log", "hard_fault + standing -> logged", "", "")
        .line("halt", "driving -> standing", "Stop", "")
        .line("go", "standing -> driving", "Start", "")
        .0
}
