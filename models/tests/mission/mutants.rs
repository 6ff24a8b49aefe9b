//! 100,000 mutants of the mission files: none makes the reader or the scenario panic, and each that
//! is accepted has the invariants of a mission. A failure prints the number of its mutant, which
//! makes it again.
#![cfg(feature = "std")]

use cotama_fuzz::split_mix;
use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};
use cotama_models::missions::{Constraint, Mission, embedded};
use cotama_models::robots::RobotFile;
use cotama_models::robots::supervisors::{MAX_STEPS, RESERVED, Step};
use std::collections::BTreeSet;

const MUTANTS: u64 = 100_000;

/// `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Texts that a blind mutation finds too seldom.
const PIECES: [&str; 16] = [
    "-1",
    "0",
    "9999999999",
    "18446744073709551616",
    "nan",
    "1e3",
    "\"\"",
    "[]",
    "{}",
    "[[zone]]",
    "[[tio]]\n",
    "\u{1F916}",
    "\\u001b",
    "187000",
    "\"sonar\"",
    "x_end_mm = ",
];

fn mutate(text: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(text.len());
    let slice = at..(at + random.below(200)).min(text.len());
    match random.below(7) {
        0 => text[at] ^= 1 << random.below(8),
        1 => drop(text.remove(at)),
        2 => text.insert(at, (random.next() % 128) as u8),
        3 => drop(text.drain(slice)),
        4 => {
            let copy = text[slice].to_vec();
            let to = random.below(text.len());
            text.splice(to..to, copy);
        }
        // A digit for a digit keeps the file readable, so that the checks behind the syntax are
        // reached.
        5 => {
            let digits: Vec<_> = (0..text.len()).filter(|&at| text[at].is_ascii_digit()).collect();
            if let Some(&at) = digits.get(random.below(digits.len())) {
                text[at] = b'0' + random.below(10) as u8;
            }
        }
        _ => drop(text.splice(at..at, PIECES[random.below(PIECES.len())].bytes())),
    }
}

/// Checks the properties of every accepted mission.
fn check(mission: &Mission) {
    let scenario = mission.scenario();
    let activities = scenario.activities();
    let mut candidates = vec![EMPTY; buffer_sizes(&activities).0];
    let mut lists = vec![&[][..]; activities.len()];
    let first = activities[0].whole(&activities[0].alternatives[0]);
    let lists =
        remaining(&activities, Some(first), scenario.available(), &mut candidates, &mut lists);
    assert_eq!(lists.map(<[_]>::len), Ok(activities.len()), "all hardware covers all alternatives");
    let named = Mission::robot_of(mission.text());
    assert_eq!(mission.robot().map(|it| it.robot().name.clone()), named);
    assert_eq!(mission.is_supervised(), named.is_some());
    let places: BTreeSet<_> = mission.steps().iter().map(Step::place).collect();
    let is_own = |place: &str| !RESERVED.contains(&place) && places.len() <= MAX_STEPS;
    let distinct = places.len() == mission.objectives.len() && places.iter().all(|it| is_own(it));
    assert!(distinct || !mission.is_supervised(), "{places:?}");
    let length: u64 = activities.iter().map(|activity| activity.length().0).sum();
    assert_eq!(length, mission.path_length.0);
    for activity in &activities {
        for alternative in activity.alternatives {
            let _ =
                alternative.candidate(Rest::Travel(cotama_core::units::Millimetres(u64::MAX)), 0);
            assert!(scenario.available().covers(alternative.needs));
        }
    }
    for zone in 0..mission.zones.len() {
        for constraint in [Constraint::Hardware, Constraint::Tio] {
            let has = match constraint {
                Constraint::Hardware => mission.zones[zone].require_hardware.is_some(),
                Constraint::Tio => mission.zones[zone].require_tio.is_some(),
            };
            assert_eq!(mission.without_zone_constraint(zone, constraint).is_some(), has);
        }
    }
}

#[test]
fn no_mutant_makes_the_reader_panic() {
    are_read(MUTANTS / 10);
}

#[test]
#[ignore = "a minute: CI runs it"]
fn no_mutant_of_100_000_makes_the_reader_panic() {
    are_read(MUTANTS);
}

fn are_read(mutants: u64) {
    // Half of the mutants are of files without their comments, where every byte matters.
    let bare = |text: &str| -> String {
        text.lines()
            .map(|line| line.split('#').next().unwrap_or("").trim_end().to_owned() + "\n")
            .collect()
    };
    let whole = ["patrol", "delivery"].map(|name| embedded::mission(name).unwrap().text);
    let texts = [whole[0].to_owned(), bare(whole[0]), whole[1].to_owned(), bare(whole[1])];
    assert!(texts.iter().all(|text| Mission::parse("bare", text).is_ok()));
    // The robot of the delivery is read once.
    let robot = RobotFile::shipped("p3dx-delivery").unwrap();
    let read = |text: &str| {
        let named = Mission::robot_of(text).filter(|it| it == robot.source());
        Mission::parse_under("mutant", text, named.map(|_| robot.clone()))
    };
    let run = |numbers: std::ops::Range<u64>| {
        let mut accepted = 0;
        for number in numbers {
            let mut random = Random(number);
            let mut text = texts[(number % 4) as usize].as_bytes().to_vec();
            for _ in 0..=random.below(3) {
                mutate(&mut text, &mut random);
            }
            let text = String::from_utf8_lossy(&text).into_owned();
            let outcome = std::panic::catch_unwind(|| match read(&text) {
                Ok(mission) => {
                    check(&mission);
                    true
                }
                Err(errors) => {
                    for diagnostic in errors.diagnostics() {
                        assert!(errors.text().get(diagnostic.span.clone()).is_some());
                    }
                    errors.to_string().is_empty()
                }
            });
            accepted += u64::from(outcome.unwrap_or_else(|_| panic!("mutant {number}")));
        }
        accepted
    };
    let accepted = std::thread::scope(|scope| {
        let half = scope.spawn(|| run(0..mutants / 2));
        run(mutants / 2..mutants) + half.join().unwrap()
    });
    // Both sides of the border are tried.
    assert!(accepted > mutants / 20 && accepted < mutants * 19 / 20, "{accepted} accepted");
}
