//! Every run of the supervised simulator is a run of the system that is checked.
//!
//! What the supervisors were told is told again, a round each, to the net of rounds, by a token
//! game of this file: the simulator's player takes no part. The net must be able to hear each event
//! where it was told, must fire the same transitions in the same rounds, and must end where the
//! simulator says that the mission ended.

use cotama_core::net::TransitionId;
use cotama_core::net::owned::OwnedNet;
use cotama_core::system::System;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{
    Configuration, FailureMode, Module, Told, delivery, faults, local, recovering,
};
use cotama_models::missions::Mission;
use cotama_sim::run::Outcome;
use cotama_sim::streams::{Stream, Streams};
use cotama_sim::supervised::{Injection, PERIOD, Run, Script, Supervised, When};
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::flat::{Rounds, rounds};
use cotama_verification::property;
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

impl Game {
    fn new(system: &System<'_>) -> Self {
        let rounds = rounds(system).unwrap();
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
        told: &[(u64, Told)],
        rounds: u64,
    ) -> Result<(Marking, Vec<(u64, String)>), u64> {
        let mut marking: Marking = self.net.places.iter().map(|it| it.initial).collect();
        let mut fired = Vec::new();
        let mut told = told.iter().peekable();
        for round in 1..=rounds {
            let (after, mut run) = self.turns(&marking);
            marking = after;
            let event = told.next_if(|it| it.0 == round).map(|it| name(it.1));
            run.push(self.outside(&mut marking, event.as_deref()).ok_or(round)?);
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

    /// The configuration that the places of a marking say.
    fn configuration(&self, marking: &Marking) -> Option<Configuration> {
        let configurations = [
            ("ls.Planning", Configuration::Planning),
            ("pf.Optimal", Configuration::FollowingOptimal),
            ("pf.Reduced", Configuration::FollowingReduced),
            ("pf.Reactive", Configuration::FollowingDvz),
            ("pf.Odometric", Configuration::FollowingOdometric),
            ("pf.Degraded", Configuration::FollowingDegraded),
            ("ls.Teleprogrammed", Configuration::Teleprogramming),
            ("to.Full", Configuration::TeleoperationFull),
            ("to.Degraded", Configuration::TeleoperationDegraded),
        ];
        let mut marked = configurations.into_iter().filter(|it| self.tokens(marking, it.0) > 0);
        let one = marked.next().map(|it| it.1);
        assert_eq!(marked.next(), None, "two configurations run");
        one
    }

    /// Why a run is none of the checked system, if it is none.
    fn refusal(&mut self, run: &Run) -> Option<String> {
        let (marking, fired) = match self.replay(&run.told, run.rounds) {
            Ok(replayed) => replayed,
            Err(round) => return Some(format!("what was told in round {round} cannot come there")),
        };
        let simulated = run.fired.iter().map(|it| {
            let round = it.at.0 / PERIOD.0 + 1;
            (round, format!("{}.{}", it.net, it.transition))
        });
        let simulated: Vec<_> = simulated.collect();
        if let Some(at) =
            (0..fired.len().max(simulated.len())).find(|&at| fired.get(at) != simulated.get(at))
        {
            return Some(format!("{:?} fired, not {:?}", simulated.get(at), fired.get(at)));
        }
        let last = run.configurations.last().and_then(|it| it.1);
        if self.configuration(&marking) != last {
            return Some(format!("the last configuration is {last:?}"));
        }
        // A laptop that hangs takes no rounds any more; then the micro-controller ends the mission.
        let thinks = run.rounds * PERIOD.0 == run.time.0;
        let ended = ["gs.Done", "gs.Safe"].map(|place| self.tokens(&marking, place) == 1);
        let expected = match run.outcome {
            _ if !thinks => [false, false],
            Outcome::Completed => [true, false],
            Outcome::Safe => [false, true],
            Outcome::Failed => [run.x == Millimetres(80_000), false], // done, beyond a limit
        };
        (ended != expected).then(|| format!("it ends as {:?}", run.outcome))
    }
}

/// An event as the net of rounds calls it.
fn name(told: Told) -> String {
    let event = told.event();
    // and those of delivery before
    let component = &recovering::SYSTEM.components[usize::from(event.component)];
    format!("{}.{}", component.name, component.net.events[event.id.0 as usize].name)
}

fn mission() -> Mission {
    let embedded = cotama_models::missions::embedded::mission("delivery").unwrap();
    Mission::parse(embedded.name, embedded.text).unwrap()
}

#[test]
fn the_seven_points_are_a_run_of_the_checked_system() {
    let mission = mission();
    let script = Script::from(&mission.run.faults);
    let run = Supervised::new(&mission).unwrap().run(&script).unwrap();
    let mut game = Game::new(&delivery::SYSTEM);
    assert_eq!(game.refusal(&run), None);
    // And one that was told less, or later, is not.
    for altered in 0..run.told.len() {
        let (mut less, mut later) = (run.clone(), run.clone());
        less.told.remove(altered);
        later.told[altered].0 += 1;
        let refused = [less, later].map(|it| game.refusal(&it).is_some());
        // With the sonars localisation and avoidance are gone already, so nobody answers that they
        // are lost.
        let known = [faults::Event::lose_mcl, faults::Event::lose_avoidance].map(Told::Failure);
        let is_known = known.contains(&run.told[altered].1);
        assert_eq!(refused[0], !is_known, "{:?}", run.told[altered]);
        assert!(refused[1] || is_known, "{:?}", run.told[altered]);
    }
}

const PAGE: &str = include_str!("../../docs/delivery.md");

/// The rows of the story: what was told when, what fired until something else was told, and what
/// ran then.
fn rows(run: &Run) -> String {
    let time = |round: u64| Millis((round - 1) * PERIOD.0);
    let mut rows = String::new();
    // Events of rounds that follow each other belong together.
    for told in run.told.chunk_by(|a, b| a.0 + 1 == b.0) {
        let (from, last) = (time(told[0].0), told[told.len() - 1].0);
        let to = run.told.iter().find(|it| it.0 > last).map_or(run.time, |it| time(it.0));
        let fired = run.fired.iter().filter(|it| (from..to).contains(&it.at));
        let fired: Vec<_> = fired.map(|it| format!("{}.{}", it.net, it.transition)).collect();
        let runs = run.configurations.iter().rfind(|it| it.0 < to).and_then(|it| it.1);
        let told: Vec<_> = told.iter().map(|it| name(it.1)).collect();
        let _ = writeln!(
            rows,
            "| {}.{} | {} | {} | {} |",
            from.0 / 1_000,
            from.0 % 1_000 / 100,
            told.join(", "),
            fired.join(", "),
            runs.map_or("none", Configuration::name)
        );
    }
    rows
}

#[test]
fn the_page_of_the_delivery_tells_the_run() {
    let mission = mission();
    let run = Supervised::new(&mission).unwrap().run(&Script::from(&mission.run.faults)).unwrap();
    let rows = rows(&run);
    assert!(PAGE.contains(&rows), "docs/delivery.md must have these rows:\n{rows}");
}

#[test]
fn the_claims_of_the_delivery_page_hold() {
    let net = rounds(&delivery::SYSTEM).unwrap().net().unwrap();
    let model = Model::from(&net.view().net());
    let claims: Vec<_> = PAGE.split('`').filter(|it| it.starts_with("AG ")).collect();
    assert_eq!(claims.len(), 6);
    for claim in claims {
        let formula = property::parse(claim, model.pt()).unwrap();
        assert_eq!(
            check(&model, &formula, &Options::default()).verdict,
            Verdict::Holds(true),
            "{claim}"
        );
    }
}

const PLACES: [local::State; 5] = [
    local::State::Planning,
    local::State::Following,
    local::State::HandOver,
    local::State::Teleoperated,
    local::State::Teleprogrammed,
];

/// The runs of the simulator's matrix and more: each row of the FMECA in each place, those of any
/// module for each module.
#[test]
fn every_row_in_every_place_is_a_run_of_the_checked_system() {
    let mission = mission();
    let supervised = Supervised::new(&mission).unwrap();
    let mut game = Game::new(&delivery::SYSTEM);
    let mut runs = 0;
    for &mode in FailureMode::ALL {
        let parts = if mode.rule().one_module { Module::ALL } else { &[Module::Smz] };
        for (&part, place) in parts.iter().flat_map(|part| PLACES.map(|place| (part, place))) {
            let row = Injection { part, ..Injection::new(When::During(place, Millis(500)), mode) };
            let asked = !matches!(place, local::State::Planning | local::State::Following);
            let obstacle = Injection::new(When::Place(Millimetres(6_000)), FailureMode::Loc2);
            let injections = if asked { vec![obstacle, row] } else { vec![row] };
            let run = supervised.run(&Script { injections, answers: Vec::new() }).unwrap();
            assert_eq!(game.refusal(&run), None, "{mode:?} of {part:?} during {place:?}");
            runs += 1;
        }
    }
    assert_eq!(runs, 485);
}

fn one<T: Copy>(stream: &mut Stream, of: &[T]) -> T {
    of[stream.below(of.len() as u64) as usize]
}

#[test]
fn two_hundred_triples_of_failures_are_runs_of_the_checked_system() {
    let mission = mission();
    let supervised = Supervised::new(&mission).unwrap();
    let mut game = Game::new(&delivery::SYSTEM);
    for seed in 0..200 {
        let mut stream = Streams::new(seed).stream("triple");
        let injections = (0..3).map(|_| {
            let when = match stream.below(3) {
                0 => When::At(Millis(stream.below(400_000))),
                1 => When::Place(Millimetres(stream.below(80_000))),
                _ => When::During(one(&mut stream, &PLACES), Millis(stream.below(20_000))),
            };
            let mode = one(&mut stream, FailureMode::ALL);
            Injection { part: one(&mut stream, Module::ALL), ..Injection::new(when, mode) }
        });
        let script = Script { injections: injections.collect(), answers: Vec::new() };
        let run = supervised.run(&script).unwrap();
        assert_eq!(game.refusal(&run), None, "{script:?}");
    }
}

/// Missions in which modules return: one failure after another, each for a while.
#[test]
fn two_hundred_missions_with_returns_are_runs_of_the_checked_system() {
    let embedded = cotama_models::missions::embedded::mission("delivery").unwrap();
    let decides = "decides = \"cotama\"";
    let text = embedded.text.replacen(decides, &format!("{decides}\nrecovery = true"), 1);
    let mission = Mission::parse(embedded.name, &text).unwrap();
    let supervised = Supervised::new(&mission).unwrap();
    let mut game = Game::new(&recovering::SYSTEM);
    let mut returns = 0;
    for seed in 0..200 {
        let mut stream = Streams::new(seed).stream("returns");
        let mut place = |least: u64, more: u64| least + stream.below(more);
        let lengths = [(); 4].map(|()| (place(1_000, 12_000), place(1_000, 8_000)));
        let mut x = 0;
        let injections = lengths.map(|(before, during)| {
            let from = x + before;
            x = from + during;
            let mode = one(
                &mut stream,
                &[
                    FailureMode::Son1,
                    FailureMode::Son2,
                    FailureMode::Sw1,
                    FailureMode::Rt1,
                    FailureMode::Loc3,
                ],
            );
            let [from, until] = [from, x].map(|it| When::Place(Millimetres(it)));
            let part = one(&mut stream, &[Module::Mcl, Module::Ust, Module::Dvz, Module::Smz]);
            Injection { part, until: Some(until), ..Injection::new(from, mode) }
        });
        let script = Script { injections: injections.to_vec(), answers: Vec::new() };
        let run = supervised.run(&script).unwrap();
        assert_eq!(game.refusal(&run), None, "{script:?}");
        returns += run.told.iter().filter(|it| matches!(it.1, Told::Return(_))).count();
    }
    assert_eq!(returns, cotama_golden::figure::<usize>("recovering.returns"));
}
