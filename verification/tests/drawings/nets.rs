//! The nets that are drawn.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, EventId, OutputId, PlaceId, Role};

/// A net under construction: signals are declared where they are first used.
pub(crate) struct Sketch {
    pub(crate) net: OwnedNet,
}

impl Sketch {
    pub(crate) fn new(name: &str, doc: &str) -> Self {
        Self { net: OwnedNet::new(name, doc) }
    }

    pub(crate) fn state(&mut self, name: &str, initial: u32, doc: &str) -> PlaceId {
        self.net.place(OwnedPlace::new(name, initial).at_most(1).doc(doc)).unwrap()
    }

    /// A flag and its complement.
    pub(crate) fn flag(&mut self, name: &str, role: Role, is_set: bool) -> (PlaceId, PlaceId) {
        let place = |name: &str, set: bool, role| OwnedPlace {
            role,
            ..OwnedPlace::new(name, u32::from(set)).at_most(1).doc("A flag.")
        };
        let set = self.net.place(place(name, is_set, role)).unwrap();
        let clear =
            self.net.place(place(&format!("no_{name}"), !is_set, Role::Complement(set))).unwrap();
        (set, clear)
    }

    fn event(&mut self, name: &str) -> EventId {
        let known = self.net.events.iter().position(|it| it.name == name);
        known.map_or_else(|| self.net.event(name, "").unwrap(), |at| EventId(at as u32))
    }

    fn output(&mut self, name: &str) -> OutputId {
        let known = self.net.outputs.iter().position(|it| it.name == name);
        known.map_or_else(|| self.net.output(name, "").unwrap(), |at| OutputId(at as u32))
    }

    /// A transition between two states, `on` an event unless that is empty.
    pub(crate) fn step(
        &mut self,
        from: PlaceId,
        to: PlaceId,
        on: &str,
        emits: &[&str],
    ) -> &mut OwnedTransition {
        let name =
            format!("{}_{}", if on.is_empty() { "t" } else { on }, self.net.transitions.len());
        let mut it = OwnedTransition::new(&name).take(from, 1).give(to, 1);
        it.on = (!on.is_empty()).then(|| self.event(on));
        it.emits = emits.iter().map(|name| self.output(name)).collect();
        let id = self.net.transition(it).unwrap();
        &mut self.net.transitions[id.0 as usize]
    }

    /// One line of the definition: from each of these states to one.
    pub(crate) fn one_line(
        &mut self,
        states: &[PlaceId],
        to: PlaceId,
        on: &str,
        emits: &[&str],
        doc: &str,
    ) {
        let line = self.net.transitions.len() as u32;
        for &from in states {
            let it = self.step(from, to, on, emits);
            it.line = line;
            doc.clone_into(&mut it.doc);
        }
    }
}

fn one(place: PlaceId) -> Arc {
    Arc { place, weight: 1 }
}

/// A sliding door: a flag, intervals, a stop from every state.
pub(crate) fn door() -> OwnedNet {
    let mut it = Sketch::new("door", "A sliding door with a light barrier.");
    let closed = it.state("Closed", 1, "The door is shut and locked.");
    let opening = it.state("Opening", 0, "The motor opens the door.");
    let open = it.state("Open", 0, "The door stands open.");
    let closing = it.state("Closing", 0, "The motor closes the door.");
    let fault = it.state("Fault", 0, "Nothing moves until someone resets the door.");
    let (blocked, free) = it.flag("blocked", Role::Data, false);
    "Someone wants to pass."
        .clone_into(&mut it.step(closed, opening, "button", &["motor_open"]).doc);
    it.step(opening, open, "end_reached", &["motor_off"]);
    it.step(open, closing, "", &["motor_close"]).read.push(one(free));
    it.net.transitions[2].within =
        Some(cotama_core::net::Within { earliest: 5000, latest: Some(5000) });
    it.step(closing, closed, "end_reached", &["motor_off", "lock"]);
    it.step(closing, opening, "barrier_broken", &["motor_open"]);
    for (state, line) in [(open, 5), (closing, 6)] {
        let set = it.step(state, state, "barrier", &[]);
        (set.line, set.take, set.give) =
            (line, [set.take[0], one(free)].into(), [set.give[0], one(blocked)].into());
        let cleared = it.step(state, state, "clear", &[]);
        cleared.take.push(one(blocked));
        cleared.give.push(one(free));
    }
    let stopped = [closed, opening, open, closing];
    it.one_line(
        &stopped,
        fault,
        "emergency_stop",
        &["motor_off", "alarm"],
        "Whatever the door does, it stops.",
    );
    it.step(fault, opening, "reset", &["motor_open"]);
    it.net
}

/// A traffic light in two phases; pedestrians ask for theirs with a button.
pub(crate) fn crossing() -> OwnedNet {
    let mut it = Sketch::new("crossing", "A traffic light with a button for pedestrians.");
    let cars = it.state("Cars", 1, "Green for cars.");
    let amber = it.state("Amber", 0, "Amber for cars.");
    let walk = it.state("Walk", 0, "Green for pedestrians.");
    let clear = it.state("Clear", 0, "Red for all.");
    let (wanted, unwanted) = it.flag("wanted", Role::Data, false);
    let press = it.step(cars, cars, "button", &["lamp_on"]);
    press.take.push(one(unwanted));
    press.give.push(one(wanted));
    let mut phase = |from, to, emits: &[&str], earliest, latest| {
        it.step(from, to, "", emits).within =
            Some(cotama_core::net::Within { earliest, latest: Some(latest) });
    };
    phase(cars, amber, &["amber"], 10_000, 20_000);
    phase(amber, walk, &["red", "walk"], 3000, 3000);
    phase(walk, clear, &["stop"], 8000, 8000);
    phase(clear, cars, &["green"], 2000, 2500);
    it.net.transitions[1].read.push(one(wanted));
    it.net.transitions[2].take.push(one(wanted));
    it.net.transitions[2].give.push(one(unwanted));
    it.net
}

/// Three philosophers who take both forks at once.
pub(crate) fn philosophers() -> OwnedNet {
    let mut it = Sketch::new("philosophers", "Three philosophers and three forks.");
    let forks: Vec<PlaceId> =
        (0..3).map(|at| it.state(&format!("fork{at}"), 1, "A fork on the table.")).collect();
    for at in 0..3 {
        let thinks = it.state(&format!("thinks{at}"), 1, "No fork in hand.");
        let eats = it.state(&format!("eats{at}"), 0, "Both forks in hand.");
        let (left, right) = (forks[at], forks[(at + 1) % 3]);
        let take =
            OwnedTransition::new(&format!("take{at}")).take(thinks, 1).take(left, 1).take(right, 1);
        it.net.transition(take.give(eats, 1)).unwrap();
        let put =
            OwnedTransition::new(&format!("put{at}")).take(eats, 1).give(left, 1).give(right, 1);
        it.net.transition(put.give(thinks, 1)).unwrap();
    }
    it.net
}

/// A producer and a consumer of crates of six.
pub(crate) fn crates() -> OwnedNet {
    let mut net = OwnedNet::new("crates", "Bottles are filled one by one and taken by the crate.");
    let mut place = |name: &str, initial, bound, role| {
        net.place(OwnedPlace { role, ..OwnedPlace::new(name, initial).at_most(bound) }).unwrap()
    };
    let ready = place("ready", 1, 1, Role::State);
    let filled = place("filled", 0, 1, Role::State);
    let belt = place("belt", 0, 12, Role::Data);
    let room = place("room", 12, 12, Role::Complement(belt));
    let waiting = place("waiting", 2, 2, Role::State);
    let packing = place("packing", 0, 2, Role::State);
    let power = place("power", 1, 1, Role::Shared);
    let stock = place("stock", 9, u32::MAX, Role::State);
    let empty = net.event("bottle_full", "The scale says so.").unwrap();
    let mut add = |it: OwnedTransition| net.transition(it).unwrap();
    add(OwnedTransition::new("fill")
        .on(empty)
        .take(ready, 1)
        .read(power, 1)
        .take(stock, 1)
        .give(filled, 1));
    add(OwnedTransition::new("put")
        .take(filled, 1)
        .take(room, 1)
        .give(belt, 1)
        .give(ready, 1)
        .within(200, None));
    add(OwnedTransition::new("collect")
        .take(waiting, 1)
        .take(belt, 6)
        .give(room, 6)
        .read(power, 1)
        .give(packing, 1));
    add(OwnedTransition::new("deliver")
        .take(packing, 1)
        .give(waiting, 1)
        .give(stock, 6)
        .within(3000, Some(4000)));
    let overfull = OwnedTransition::new("warn")
        .read(belt, 10)
        .read(room, 1)
        .doc("Between ten and eleven bottles.");
    add(overfull.take(power, 1).give(power, 1));
    net
}

/// Names that every format has to escape.
pub(crate) fn odd() -> OwnedNet {
    let mut it = Sketch::new("<odd> & \"names\"", "]]> --> \\N; %% #35; \u{1}");
    let names = [
        "a \"b\" <c> & d",
        "end",
        "日本語の状態",
        "one\ntwo",
        "",
        "state: x; y | z {w} \\ `t` [*]",
    ];
    let states: Vec<PlaceId> =
        names.iter().map(|name| it.state(name, u32::from(name.starts_with('a')), name)).collect();
    let (flag, clear) = it.flag("is <5> & \"ok\"", Role::Data, false);
    for at in 0..states.len() {
        let next = states[(at + 1) % states.len()];
        it.step(
            states[at],
            next,
            ["go --> \"there\"", "x:=y;", "#quot;", "&amp;"][at % 4],
            &["say \u{7}\"hi\"", "é"],
        );
    }
    it.net.transitions[0].read.push(one(flag));
    it.net.transitions[1].read.push(one(clear));
    it.step(states[1], states[1], &"very_long_".repeat(12), &[]);
    it.net
}

/// The local supervisor of a mobile robot under a ground station.
pub(crate) fn supervisor() -> OwnedNet {
    let mut it = Sketch::new(
        "local_supervisor",
        "Drives a robot from its start to its goal, with an operator's help.",
    );
    let idle = it.state("L_IDLE", 1, "Waits for an order to drive.");
    let plan = it.state("L_PP", 0, "The path planner runs.");
    let follow = it.state("L_PF", 0, "The path follower runs.");
    let help = it.state("L_HRI", 0, "An operator has been asked.");
    let program = it.state("L_TP", 0, "The operator draws a path or sets way points.");
    let remote = it.state("L_TO", 0, "The operator drives.");
    let end = it.state("L_END", 0, "The goal is reached.");
    let (_, settled) = it.flag("pending", Role::Data, false);
    let (camera, _) = it.flag("camera", Role::Shared, true);
    let (wifi, _) = it.flag("wifi", Role::Shared, true);
    it.step(idle, plan, "start_drive", &["run_PP"]);
    it.step(plan, follow, "path_ready", &["stop_PP", "pf_start"]);
    it.step(follow, end, "goal_reached", &["pf_stop"]).read.push(one(settled));
    it.step(plan, help, "local_event", &["stop_PP", "stop_robot", "op_request"]);
    it.step(follow, help, "local_event", &["pf_stop", "stop_robot", "op_request"]);
    it.step(help, program, "op_teleprogram", &[]);
    it.step(help, remote, "op_teleoperate", &["to_start"]).read = [one(camera), one(wifi)].into();
    it.step(program, plan, "op_waypoints", &["run_PP"]);
    it.step(program, follow, "op_path", &["pf_start"]);
    it.step(remote, program, "op_teleprogram", &["to_stop", "stop_robot"]);
    it.step(remote, end, "op_goal_reached", &["to_stop"]).read.push(one(settled));
    it.step(remote, help, "local_event", &["to_stop", "stop_robot", "op_request"]);
    it.step(program, help, "local_event", &["op_request"]);
    it.step(end, idle, "tick", &["drive_done"]);
    it.one_line(
        &[plan, follow, help, program, remote, end],
        idle,
        "gs_abort",
        &[],
        "The ground station gives up.",
    );
    it.net
}
