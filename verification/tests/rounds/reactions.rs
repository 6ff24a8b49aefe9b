//! How long it takes at worst from a fault to its reaction, by the report and by where the drive
//! is.
//!
//! A fault shows after the latency of its detection (the FMECA's largest of all rows with that
//! report). A flag can be raised just after a round has looked, so that up to one period passes
//! until the next one; in it the observation module reports and the contextual supervisor decides.
//! The supervisor that is told reads its mailbox in the round after that, one period later. A fault
//! is recorded only where what came before it has moved the drive by the time of the decision, or
//! where nothing needs to react. Here rounds are counted exactly, over every marking in which a
//! fault can come and whatever comes after it; that the longest time is the number of rounds times
//! the period is checked with state classes of the net with time.
//!
//! That a fault is recorded says two things: what was raised and reported has been read in that
//! round (CS3), and nothing comes of it later, however long nothing else comes from outside.

use crate::delivery::explored;
use crate::golden;
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_models::cotama::{Class, RULES, Report, Rule, delivery};
use cotama_verification::explicit::Graph;
use cotama_verification::flat::{Part, rounds};
use cotama_verification::pt::Pt;
use cotama_verification::tpn::{
    Interval, Limits, Response, Time, TimeNet, TimePlace, TimeTransition, bound, from_net,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The executive's loop.
const PERIOD_MS: u32 = 100;

/// From detection to the decision, and to the answer.
const MOST_MS: [u32; 2] = [100, 200];

/// By the event from outside, the report whose rows of the FMECA it stands for. A hard failure
/// without one can be that of any row that is answered by the local supervisor.
const CLASSES: [(&str, Option<Report>); 12] = [
    ("faults.overload", Some(Report::Slow)),
    ("faults.lose_mcl", Some(Report::Mcl)),
    ("faults.lose_sonar", Some(Report::Sonar)),
    ("faults.drift", Some(Report::Ambiguous)),
    ("faults.fail_hard", None),
    ("faults.bump", Some(Report::Collision)),
    ("faults.fail_slightly", Some(Report::Minor)),
    ("faults.no_path", Some(Report::Planner)),
    ("faults.lose_camera", Some(Report::Camera)),
    ("faults.lose_wifi", Some(Report::Wifi)),
    ("faults.lose_vital", Some(Report::Vital)),
    ("operator.gives_up", Some(Report::Refusal)),
];

const MODES: [&str; 5] =
    ["ls.Planning", "ls.Following", "ls.HandOver", "ls.Teleprogrammed", "ls.Teleoperated"];

/// A decision: what waits, in whose turn it is read, and where the reader is afterwards.
type Decision = (&'static str, &'static str, &'static [&'static str]);

const DECISIONS: [Decision; 9] = [
    ("adapter (fewer particles)", "pf.adapt_rt.waiting", &["pf.Reduced", "pf.Reactive", "pf.Off"]),
    ("adapter (odometry)", "pf.adapt_mcl.waiting", &["pf.Odometric", "pf.Degraded", "pf.Off"]),
    ("adapter (no avoidance)", "pf.adapt_sonar.waiting", &["pf.Degraded", "pf.Off"]),
    (
        "adapter (slower)",
        "pf.adapt_bump.waiting",
        &["pf.Optimal", "pf.Reduced", "pf.Odometric", "pf.Reactive", "pf.Off"],
    ),
    (
        "adapter (a setting)",
        "pf.adapt_minor.waiting",
        &["pf.Optimal", "pf.Reduced", "pf.Odometric", "pf.Reactive", "pf.Degraded", "pf.Off"],
    ),
    ("adapter (no avoidance)", "to.adapt_sonar.waiting", &["to.Degraded", "to.Off"]),
    ("adapter (a setting)", "to.adapt_minor.waiting", &["to.Full", "to.Degraded", "to.Off"]),
    ("local", "ls.local_event.waiting", &["ls.HandOver", "gs.Security", "gs.Safe"]),
    ("global", "gs.global_event.waiting", &["gs.Security", "gs.Safe"]),
];

struct Explored {
    pt: Pt,
    graph: Graph,
    /// Transitions in which nothing comes from outside.
    silence: BTreeSet<TransitionId>,
    /// Flags and reports that are raised and not read yet.
    unread: Vec<usize>,
}

impl Explored {
    fn marked(&self, state: u32, name: &str) -> bool {
        self.graph.marking(state)[self.pt.place(name).unwrap().0 as usize] > 0
    }

    /// Returns the state in which all nets have had their turns, from one round on.
    fn to_outside(&self, mut state: u32) -> u32 {
        while !self.marked(state, "turn.outside") {
            state = self.graph.successors(state)[0];
        }
        state
    }

    /// After how many rounds of silence something is decided, where all nets have had their turns,
    /// and what; none where nothing ever is, since the rounds repeat themselves.
    fn decided(&self, after: u32) -> Option<(u32, u32, &'static Decision)> {
        let (mut state, mut before) = (self.to_outside(after), BTreeSet::new());
        while before.insert(state) {
            if let Some(decision) = DECISIONS.iter().find(|it| self.marked(state, it.1)) {
                return Some((before.len() as u32, state, decision));
            }
            let mut next = self.graph.transitions(state).into_iter();
            let silent = next.position(|it| self.silence.contains(&it)).unwrap();
            state = self.to_outside(self.graph.successors(state)[silent]);
        }
        None
    }

    /// After every event from outside, all nets have had their turns again.
    fn next(&self, states: &BTreeSet<u32>) -> BTreeSet<u32> {
        let after = states.iter().flat_map(|&it| self.graph.successors(it));
        after.map(|&it| self.to_outside(it)).collect()
    }

    /// After how many rounds, at least one, one of these places is marked, whatever comes from
    /// outside.
    fn rounds_until(&self, from: u32, places: &[&str]) -> u32 {
        let mut states = BTreeSet::from([from]);
        for rounds in 1..=5 {
            states = self.next(&states);
            states.retain(|&it| !places.iter().any(|place| self.marked(it, place)));
            if states.is_empty() {
                return rounds;
            }
        }
        panic!("{places:?}");
    }
}

fn latency(report: Option<Report>) -> u32 {
    let is_hard = |it: &Rule| it.class == Class::Local && it.report != Some(Report::Refusal);
    let is_meant = |it: &&Rule| if report.is_some() { it.report == report } else { is_hard(it) };
    RULES.iter().filter(is_meant).map(|it| it.latency_ms).max().unwrap_or(0)
}

#[test]
#[ignore = "a minute: CI runs it"]
fn every_fault_in_every_mode_has_its_worst_reaction() {
    let rounds = rounds(&delivery::SYSTEM).unwrap();
    let net = rounds.net().unwrap();
    let (pt, graph) = explored(&rounds);
    let is_silent = |id: &TransitionId| {
        rounds.part(*id) == Some(Part::Outside) && net.transitions[id.0 as usize].on.is_none()
    };
    let silence = (0..net.transitions.len() as u32).map(TransitionId).filter(is_silent).collect();
    let is_unread = |name: &str| {
        name.ends_with(".waiting") && (name.starts_with("cs.") || name.contains("_flag."))
    };
    let unread: Vec<_> = (0..pt.places.len()).filter(|&it| is_unread(&pt.places[it])).collect();
    assert_eq!(unread.len(), 27);
    let it = Explored { pt, graph, silence, unread };
    let event = |transition: TransitionId| {
        net.transitions[transition.0 as usize].on.map(|on| net.events[on.0 as usize].name.as_str())
    };
    // By class and mode: each decision, with rounds until it is made and until it is obeyed.
    let mut cells: BTreeMap<(usize, usize), BTreeMap<&str, (u32, u32)>> = BTreeMap::new();
    for state in 0..it.graph.states() as u32 {
        if !it.marked(state, "turn.outside") {
            continue;
        }
        let Some(mode) = MODES.iter().position(|mode| it.marked(state, mode)) else { continue };
        for (transition, &after) in
            it.graph.transitions(state).into_iter().zip(it.graph.successors(state))
        {
            let Some(class) = CLASSES.iter().position(|class| Some(class.0) == event(transition))
            else {
                continue;
            };
            let marking = it.graph.marking(it.to_outside(after));
            assert!(
                it.unread.iter().all(|&of| marking[of] == 0),
                "{} is not read",
                CLASSES[class].0
            );
            let cell = cells.entry((class, mode)).or_default();
            // A recorded report has been read, and has no consequence.
            let (name, decided, told) = it
                .decided(after)
                .map_or(("recorded", 1, 0), |of| (of.2.0, of.0, it.rounds_until(of.1, of.2.2)));
            let worst = cell.entry(name).or_default();
            *worst = (decided.max(worst.0), told.max(worst.1));
        }
    }
    let mut table =
        String::from("fault in mode: decision; worst detection, decision, reaction in ms\n");
    for ((class, mode), cell) in cells {
        let (event, report) = CLASSES[class];
        let (fault, mode) =
            (event.split('.').nth(1).unwrap(), MODES[mode].split('.').nth(1).unwrap());
        for (decision, (decided, told)) in cell {
            let [decision_ms, answer_ms] = [decided, decided + told].map(|it| it * PERIOD_MS);
            let in_time = decision_ms <= MOST_MS[0] && answer_ms <= MOST_MS[1];
            assert!(in_time, "{fault} in {mode}: {decision} after {decided} and {told} rounds");
            let detected = latency(report);
            let decided = detected + decided * PERIOD_MS;
            let reaction = if decision == "recorded" {
                "-".to_owned()
            } else {
                (decided + told * PERIOD_MS).to_string()
            };
            let _ =
                writeln!(table, "{fault} in {mode}: {decision}; {detected} {decided} {reaction}");
        }
    }
    golden("reactions.txt", &table);
}

/// The table, that is: detection, decision and answer, the last but for what is recorded.
#[test]
fn the_table_says_that_every_decision_takes_100_ms_and_every_answer_200_ms() {
    let table = include_str!("../golden/rounds/reactions.txt");
    let (mut decided, mut recorded) = (0, 0);
    for line in table.lines().skip(1) {
        let (what, times) = line.rsplit_once("; ").unwrap();
        let times: Vec<_> = times.split(' ').map(|it| it.parse::<u32>().ok()).collect();
        let [Some(detected), Some(decision), answer] = times[..] else { panic!("{line}") };
        let after = [Some(decision), answer].map(|it| it.map(|it| it - detected));
        if what.ends_with(": recorded") {
            assert_eq!(after, [Some(MOST_MS[0]), None], "{line}");
            recorded += 1;
        } else {
            assert_eq!(after, MOST_MS.map(Some), "{line}");
            decided += 1;
        }
    }
    assert_eq!((decided, recorded), (37, 53));
}

/// The net of rounds with time: a round begins each period and takes none, what is outside acts
/// within the period, and of it only one event and nothing; from the first marking between rounds
/// in which this place is marked and nothing waits.
fn timed(event: &str, mode: &str) -> TimeNet {
    let rounds = rounds(&delivery::SYSTEM).unwrap();
    let net = rounds.net().unwrap();
    let (pt, graph) = explored(&rounds);
    let waits = |marking: &[u32]| {
        pt.places.iter().zip(marking).any(|(name, &it)| name.ends_with(".waiting") && it > 0)
    };
    let at = |name: &str| pt.place(name).unwrap().0 as usize;
    let mut markings = (0..graph.states() as u32).map(|state| graph.marking(state));
    let start = markings.find(|it| it[at(mode)] > 0 && it[at("round")] > 0 && !waits(it)).unwrap();
    let untimed = from_net(&net.view().net()).unwrap().net;
    let mut places = untimed.places().to_vec();
    places.iter_mut().zip(&start).for_each(|(place, &tokens)| place.initial = tokens);
    let mut place = |name: &str, initial| {
        places.push(TimePlace { name: name.to_owned(), label: None, initial });
        Arc { place: PlaceId(places.len() as u32 - 1), weight: 1 }
    };
    let (clock, due) = (place("clock", 1), place("due", 0));
    let round = rounds.round();
    let mut transitions = Vec::new();
    for (it, id) in untimed.transitions().iter().zip((0..).map(TransitionId)) {
        let on =
            net.transitions[id.0 as usize].on.map(|on| net.events[on.0 as usize].name.as_str());
        let mut it = it.clone();
        if rounds.part(id) == Some(Part::Outside) {
            if on.is_some_and(|on| on != event) {
                continue;
            }
            it.interval = Interval::closed(0, u64::from(PERIOD_MS));
        } else {
            it.interval = Interval::NOW;
            if it.take.iter().any(|arc| arc.place == round) {
                it.take.push(due);
            }
        }
        transitions.push(it);
    }
    let tick = TimeTransition {
        interval: Interval::closed(u64::from(PERIOD_MS), u64::from(PERIOD_MS)),
        take: vec![clock],
        give: vec![clock, due],
        ..TimeTransition::new("tick")
    };
    transitions.push(tick);
    TimeNet::new("rounds".to_owned(), places, transitions).unwrap()
}

/// The longest time from the event, wherever in the period it comes.
fn longest(event: &str, mode: &str, reaction: &str) -> Time {
    let net = timed(&format!("faults.{event}"), mode);
    let from = net.transitions().iter().position(|it| it.name.starts_with("faults.")).unwrap();
    let to = net.place(reaction).unwrap();
    match bound(&net, TransitionId(from as u32), to, &Limits::default()) {
        Response::Between { max, .. } => max,
        other => panic!("{other:?}"),
    }
}

#[test]
#[ignore = "a minute: CI runs it"]
fn state_classes_find_the_same_times_of_reaction() {
    assert_eq!(longest("drift", "ls.Following", "gs.global_event.waiting"), Time::Infinite);
    assert_eq!(longest("drift", "ls.Following", "ls.HandOver"), Time::Finite(200));
    assert_eq!(longest("lose_vital", "ls.Following", "permit.Destroyed"), Time::Finite(200));
    assert_eq!(longest("lose_sonar", "ls.Following", "pf.adapt_sonar.waiting"), Time::Finite(100));
    assert_eq!(longest("lose_sonar", "ls.Following", "pf.Degraded"), Time::Finite(200));
}
