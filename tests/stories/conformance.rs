//! Every run of a mission under supervisors is a run of the system that is checked.
//!
//! What the supervisors were told is told again, a round each, to the net of rounds, by a token
//! game of this file: the simulator's player takes no part. The net must be able to hear each event
//! where it was told, must fire the same transitions in the same rounds, and must end where the
//! simulator says that the mission ended.

use cotama_core::net::TransitionId;
use cotama_core::net::owned::OwnedNet;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::robots::Moment;
use cotama_models::robots::supervisors::of_mission;
use cotama_sim::robots::{Driven, Injection, Script};
use cotama_sim::run::Outcome;
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::trace::Record;
use cotama_verification::flat::{Rounds, rounds};
use std::collections::HashMap;
use std::fmt::Write as _;

/// The tokens of each place.
type Marking = Vec<u32>;

/// The net of rounds, played.
struct Game {
    rounds: Rounds,
    net: OwnedNet,
    /// The transitions that take the token of the round from a place, by place.
    from: Vec<Vec<TransitionId>>,
    /// The turns of all supervisors, by the marking before them.
    turns: HashMap<Marking, (Marking, Vec<TransitionId>)>,
}

/// A run, as far as its supervisors show it.
#[derive(Clone)]
struct Shown {
    /// Each event with the number of its round.
    told: Vec<(u64, String)>,
    fired: Vec<(u64, String)>,
    rounds: u64,
    outcome: Outcome,
    /// Whether the computer was up to the end.
    thinks: bool,
    at_end: bool,
    records: Vec<Record>,
}

impl Shown {
    fn of(mission: &Mission, script: &Script) -> Self {
        let period = mission.robot().unwrap().robot().body.as_ref().unwrap().period;
        let mut records = Vec::new();
        let driven = Driven::new(mission).unwrap();
        let run = driven.run_recorded(script, Millis(1_000), &mut records).unwrap();
        let (mut told, mut fired) = (Vec::new(), Vec::new());
        for record in &records {
            match record {
                Record::Told(it) => told.push((it.round, it.event.clone())),
                Record::Fired(it) => {
                    let round = it.t_us / 1_000 / period.0 + 1;
                    fired.push((round, format!("{}.{}", it.net, it.transition)));
                }
                _ => {}
            }
        }
        let thinks = run.rounds * period.0 == run.time.0;
        let at_end = run.x == mission.path_length;
        Self { told, fired, rounds: run.rounds, outcome: run.outcome, thinks, at_end, records }
    }
}

impl Game {
    fn new(mission: &Mission) -> Self {
        let robot = mission.robot().unwrap().robot();
        let rounds = of_mission(robot, &mission.steps()).with(|it| rounds(it).unwrap());
        let net = rounds.net().unwrap();
        let mut from = vec![Vec::new(); net.places.len()];
        let is_phase =
            |name: &str| name == "round" || name.starts_with("turn.") || name.starts_with("after.");
        for (it, id) in net.transitions.iter().zip(0..) {
            let mut phases =
                it.take.iter().filter(|arc| is_phase(&net.places[arc.place.0 as usize].name));
            let phase = phases.next().expect("every transition takes the token of the round");
            assert!(phases.next().is_none(), "and no other");
            from[phase.place.0 as usize].push(TransitionId(id));
        }
        Self { rounds, net, from, turns: HashMap::new() }
    }

    fn enabled(&self, marking: &Marking) -> Vec<TransitionId> {
        let phases = self.from.iter().zip(marking).filter(|it| *it.1 > 0);
        let candidates = phases.flat_map(|it| it.0).copied();
        let can = |id: &TransitionId| {
            let it = &self.net.transitions[id.0 as usize];
            it.take.iter().chain(&it.read).all(|arc| marking[arc.place.0 as usize] >= arc.weight)
        };
        candidates.filter(can).collect()
    }

    fn fire(&self, marking: &mut Marking, id: TransitionId) {
        let it = &self.net.transitions[id.0 as usize];
        it.take.iter().for_each(|arc| marking[arc.place.0 as usize] -= arc.weight);
        it.give.iter().for_each(|arc| marking[arc.place.0 as usize] += arc.weight);
        for arc in &it.give {
            let place = &self.net.places[arc.place.0 as usize];
            assert!(marking[arc.place.0 as usize] <= place.bound, "{} holds too much", place.name);
        }
    }

    fn tokens(&self, marking: &Marking, place: &str) -> u32 {
        marking[self.net.places.iter().position(|it| it.name == place).unwrap()]
    }

    /// From the start of a round to where something from outside may happen.
    fn turns(&mut self, marking: &Marking) -> (Marking, Vec<TransitionId>) {
        if let Some(known) = self.turns.get(marking) {
            return known.clone();
        }
        assert_eq!(marking[self.rounds.round().0 as usize], 1);
        let (mut after, mut fired) = (marking.clone(), Vec::new());
        while after[self.rounds.outside().0 as usize] == 0 {
            let [one] = self.enabled(&after)[..] else {
                panic!("in a turn one transition is enabled")
            };
            self.fire(&mut after, one);
            fired.push(one);
        }
        self.turns.insert(marking.clone(), (after.clone(), fired.clone()));
        (after, fired)
    }

    /// Fires the transition of the environment for this event, or none; `None` when it cannot.
    fn outside(&self, marking: &mut Marking, told: Option<&str>) -> Option<TransitionId> {
        let on = |id: &TransitionId| self.net.transitions[id.0 as usize].on;
        let name =
            |id: &TransitionId| on(id).map(|on| self.net.events[on.0 as usize].name.as_str());
        let ways: Vec<_> =
            self.enabled(marking).into_iter().filter(|it| name(it) == told).collect();
        let one = *ways.first()?;
        assert_eq!(ways.len(), 1, "one event does one thing");
        self.fire(marking, one);
        Some(one)
    }

    /// Tells all of it again: the last marking and what fired, with the number of the round; or in
    /// which round an event was told that cannot come there.
    fn replay(
        &mut self,
        told: &[(u64, String)],
        rounds: u64,
    ) -> Result<(Marking, Vec<(u64, String)>), u64> {
        let mut marking: Marking = self.net.places.iter().map(|it| it.initial).collect();
        let mut fired = Vec::new();
        let mut told = told.iter().peekable();
        for round in 1..=rounds {
            let (after, mut run) = self.turns(&marking);
            marking = after;
            let event = told.next_if(|it| it.0 == round).map(|it| it.1.as_str());
            run.push(self.outside(&mut marking, event).ok_or(round)?);
            let [happened] = &self.rounds.told(&run)[..] else { panic!("one round") };
            let (_, outside) = happened.outside.as_ref().unwrap();
            let steps = happened.turns.iter().chain([outside]).flat_map(|it| it.split(" + "));
            let noted = |it: &&str| {
                let is_theirs = it.starts_with("faults.") || it.starts_with("operator.");
                *it != "idle"
                    && !it.ends_with(" ignored")
                    && !it.ends_with(" goes on")
                    && !is_theirs
            };
            fired.extend(steps.filter(noted).map(|it| (round, it.to_owned())));
        }
        // Two things in one round, or after the last one.
        told.next().map_or(Ok((marking, fired)), |it| Err(it.0))
    }

    /// Why a run is none of the checked system, if it is none.
    fn refusal(&mut self, run: &Shown) -> Option<String> {
        let (marking, fired) = match self.replay(&run.told, run.rounds) {
            Ok(replayed) => replayed,
            Err(round) => return Some(format!("what was told in round {round} cannot come there")),
        };
        let most = fired.len().max(run.fired.len());
        if let Some(at) = (0..most).find(|&at| fired.get(at) != run.fired.get(at)) {
            return Some(format!("{:?} fired, not {:?}", run.fired.get(at), fired.get(at)));
        }
        // A computer that hangs takes no rounds any more; then the micro-controller ends the
        // mission.
        let ended = ["gs.Done", "gs.Safe"].map(|place| self.tokens(&marking, place) == 1);
        let expected = match run.outcome {
            _ if !run.thinks => [false, false],
            Outcome::Completed => [true, false],
            Outcome::Safe => [false, true],
            Outcome::Failed => [run.at_end && ended[0], false], // done, beyond a limit
        };
        (ended != expected).then(|| format!("it ends as {:?}", run.outcome))
    }
}

fn mission(name: &str) -> Mission {
    let embedded = cotama_models::missions::embedded::mission(name).unwrap();
    Mission::parse(embedded.name, embedded.text).unwrap()
}

#[test]
fn the_seven_points_are_a_run_of_the_checked_system() {
    let mission = mission("delivery");
    let run = Shown::of(&mission, &Script::of(&mission.run.faults, &mission));
    let mut game = Game::new(&mission);
    assert_eq!(game.refusal(&run), None);
    // And one that was told less, or later, is not.
    for altered in 0..run.told.len() {
        let (mut less, mut later) = (run.clone(), run.clone());
        less.told.remove(altered);
        later.told[altered].0 += 1;
        for it in [less, later] {
            assert!(game.refusal(&it).is_some(), "{:?}", run.told[altered]);
        }
    }
}

const PAGE: &str = include_str!("../../docs/delivery.md");

/// The rows of the story: what was told when, what fired until something else was told, and what
/// ran then.
fn rows(run: &Shown) -> String {
    let time = |round: u64| (round - 1) * 100;
    let ran: Vec<(u64, Option<&str>)> = { run.records.iter() }
        .filter_map(|it| match it {
            Record::Configuration(it) => Some((it.t_us / 1_000, it.configuration.as_deref())),
            _ => None,
        })
        .collect();
    let mut rows = String::new();
    // Events of rounds that follow each other belong together.
    for told in run.told.chunk_by(|a, b| a.0 + 1 == b.0) {
        let (from, last) = (told[0].0, told[told.len() - 1].0);
        let to = run.told.iter().find(|it| it.0 > last).map_or(run.rounds + 1, |it| it.0);
        let fired = run.fired.iter().filter(|it| (from..to).contains(&it.0));
        let fired: Vec<_> = fired.map(|it| it.1.as_str()).collect();
        let runs = ran.iter().rfind(|it| it.0 < time(to)).and_then(|it| it.1);
        let told: Vec<_> = told.iter().map(|it| it.1.as_str()).collect();
        let _ = writeln!(
            rows,
            "| {}.{} | {} | {} | {} |",
            time(from) / 1_000,
            time(from) % 1_000 / 100,
            told.join(", "),
            fired.join(", "),
            runs.unwrap_or("none")
        );
    }
    rows
}

#[test]
fn the_page_of_the_delivery_tells_the_run() {
    let mission = mission("delivery");
    let rows = rows(&Shown::of(&mission, &Script::of(&mission.run.faults, &mission)));
    assert!(PAGE.contains(&rows), "docs/delivery.md must have these rows:\n{rows}");
}

/// Each row of each robot's file in each place of its drive.
#[test]
fn every_row_in_every_place_is_a_run_of_the_checked_system() {
    for (name, asks) in [("delivery", "LOC2"), ("shift", "WHL1")] {
        let mission = mission(name);
        let robot = mission.robot().unwrap().robot();
        let mut game = Game::new(&mission);
        let obstacle = robot.failure(asks).unwrap();
        let obstacle = Injection::new(Moment::Place(Millimetres(6_000)), obstacle);
        let parts = 0..robot.sub_objectives.len();
        let places = parts.map(|it| Moment::During(it, Millis(500)));
        for place in places.chain([Moment::Waiting(Millis(500))]) {
            for failure in 0..robot.failures.len() {
                let injections = vec![obstacle, Injection::new(place, failure)];
                let run = Shown::of(&mission, &Script { injections, ..Script::default() });
                let id = &robot.failures[failure].id;
                assert_eq!(game.refusal(&run), None, "{id} during {place:?}");
            }
        }
    }
}

fn moment(stream: &mut Stream, mission: &Mission) -> Moment {
    let parts = mission.robot().unwrap().robot().sub_objectives.len() as u64;
    match stream.below(4) {
        0 => Moment::At(Millis(stream.below(400_000))),
        1 => Moment::Place(Millimetres(stream.below(mission.path_length.0))),
        2 => Moment::Waiting(Millis(stream.below(20_000))),
        _ => Moment::During(stream.below(parts) as usize, Millis(stream.below(20_000))),
    }
}

/// Three failures, some of which end, so that what was lost comes back.
#[test]
fn two_hundred_triples_of_failures_are_runs_of_the_checked_system() {
    let mission = mission("delivery");
    let failures = mission.robot().unwrap().robot().failures.len() as u64;
    let (mut game, mut returns) = (Game::new(&mission), 0);
    for seed in 0..200 {
        let mut stream = Streams::new(seed).stream("triple");
        let injections = (0..3).map(|_| {
            let (when, until) = (moment(&mut stream, &mission), moment(&mut stream, &mission));
            let until = (stream.below(2) == 0).then_some(until);
            Injection { when, failure: stream.below(failures) as usize, until }
        });
        let script = Script { injections: injections.collect(), ..Script::default() };
        let run = Shown::of(&mission, &script);
        assert_eq!(game.refusal(&run), None, "{script:?}");
        returns += run.told.iter().filter(|it| it.1.starts_with("faults.works_")).count();
    }
    assert!(returns > 20, "{returns}");
}
