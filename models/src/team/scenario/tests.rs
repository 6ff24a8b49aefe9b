//! Files of teams: read as they were written, and refused with the place of each mistake.

mod made;

use super::{
    Crowd, FailureRates, Fault, FaultKind, FaultTime, Formation, Give, Method, Needs, Place,
    PlanSpec, RobotSpec, RoleSpec, Row, Scenario, Seat, Stage, Stay, Supply, Take, TaskSpec,
    Travel, Trust, service, usual,
};
use crate::team::service::{BRING, FETCH, ORDER};
use crate::team::{Capability, CapabilitySet, Reliability, Role, Skill};
use cotama_core::team::Combine;
use proptest::prelude::*;

const FILE: &str = include_str!("../../../teams/service.toml");

#[test]
fn the_service_is_that_of_the_thesis() {
    let service = service().unwrap();
    let capabilities: Vec<_> = service.robots.iter().map(RobotSpec::capabilities).collect();
    let theirs = crate::team::service::ROBOTS.map(|it| it.capabilities());
    assert_eq!(capabilities, theirs);
    // A service with words yields twice as much as one without (3.6.1.2).
    let order: &[(&str, u32, &[Role<'_>])] = &[("order", 0, &[ORDER])];
    let serve: &[(&str, u32, &[Role<'_>])] = &[
        ("fetch", 300_000, &[FETCH]),
        ("bring", 0, &[BRING]),
        ("fetch-and-bring", 0, &[FETCH, BRING]),
    ];
    assert_eq!(service.tasks.len(), 2);
    for (task, theirs) in service.tasks.iter().zip([order, serve]) {
        assert_eq!((task.utility_ms, task.plans.len()), (600_000, theirs.len()));
        for (plan, &(name, extra, roles)) in task.plans.iter().zip(theirs) {
            assert_eq!((plan.name.as_str(), plan.extra_ms), (name, extra));
            for bits in 0..1 << 6 {
                let set = CapabilitySet::from_bits(bits);
                let able = plan.roles.iter().map(|it| it.possible(set)).collect::<Vec<_>>();
                let theirs = roles.iter().map(|it| it.possible(set)).collect::<Vec<_>>();
                assert_eq!(able, theirs, "{} {bits}", plan.name);
            }
        }
    }
}

/// The first message of the file of the service with one text in place of another.
fn message(text: &str, other: &str) -> String {
    assert!(FILE.contains(text), "{text}");
    let errors = Scenario::parse("s.toml", &FILE.replacen(text, other, 1)).unwrap_err();
    let message = errors.to_string();
    let message = message.lines().next().unwrap_or_default();
    message.split_once(": ").map_or(message, |it| it.1).to_owned()
}

#[test]
fn a_mistake_in_the_file_of_a_team_is_told_with_its_cure() {
    for (text, other, expected) in [
        ("at = \"hall\"", "at = \"hal\"", "unknown place `hal`; did you mean `hall`?"),
        ("after = \"order\"", "after = \"serve\"", "unknown task before this one `serve`"),
        ("length_mm = 4000", "length_mm = 0", "`length_mm` must be 1 to 10000000, not `0`"),
        (
            "length_mm",
            "length_m",
            "unknown key `length_m` in this `way`; did you mean `length_mm`?",
        ),
        ("[\"desk\", \"hall\"]", "[\"desk\"]", "a way leads from one place to another"),
        ("\"dialogue\"]]", "\"dialog\"]]", "unknown skill `dialog`; did you mean `dialogue`?"),
        ("name = \"Jimmy\"", "name = \"Eddie\"", "the robot `Eddie` names two of them"),
        ("combine = \"mean\"", "combine = \"min\"", "unknown way to combine costs `min`"),
        ("take = \"object\"", "take = \"objct\"", "unknown word here `objct`; did you mean"),
        (
            "give = { partner_at = \"desk\" }",
            "give = \"goal\"",
            "the role `fetch` has no partner for what it gives or takes",
        ),
        ("mode = \"EST1\"", "mode = \"EST9\"", "unknown failure mode `EST9`; did you mean"),
        ("shifts = \"serve\"", "", "a fault is of one robot, or of the object of one task"),
        ("\"grasp-3f\"]", "\"grasp-3f 7\"]", "`grasp-3f 7` says no reliability"),
        ("skip_ms = 600000", "", "missing key `skip_ms` in this `task`"),
        ("cotama-team/1", "cotama-team/9", "unknown format `cotama-team/9`"),
    ] {
        let found = message(text, other);
        assert!(found.starts_with(expected), "{other}: {found}");
    }
}

fn set() -> impl Strategy<Value = CapabilitySet> {
    (1_u32..8).prop_map(CapabilitySet::from_bits)
}

fn role(take: Take, give: Give) -> impl Strategy<Value = RoleSpec> {
    let actions = prop::collection::vec(prop::collection::vec(set(), 1..3).prop_map(Needs), 1..4);
    (actions, 0_u64..9_000, 0_u64..9_000).prop_map(move |(actions, take_ms, give_ms)| RoleSpec {
        name: "part \"a\"\\".into(),
        actions,
        take,
        give,
        take_ms,
        give_ms,
    })
}

fn plan() -> impl Strategy<Value = PlanSpec> {
    let alone = role(Take::Object, Give::Goal).prop_map(|it| vec![it]);
    let words = role(Take::Words(Place(2)), Give::Nobody).prop_map(|it| vec![it]);
    let (gives, takes) = (Give::Partner(Place(1)), Take::Partner(Place(1)));
    let pair = (role(Take::Object, gives), role(takes, Give::Goal)).prop_map(|it| vec![it.0, it.1]);
    (prop_oneof![alone, words, pair], 0_u32..5_000).prop_map(|(roles, extra_ms)| PlanSpec {
        name: "p".into(),
        extra_ms,
        roles,
    })
}

fn task(number: usize) -> impl Strategy<Value = TaskSpec> {
    let combine = prop::sample::select(vec![Combine::Sum, Combine::Mean, Combine::Max]);
    let plans = prop::collection::vec(plan(), 1..3);
    let ends = (0_usize..4, 0_usize..4);
    let after = prop::option::of(0..number.max(1)).prop_map(move |it| it.filter(|_| number > 0));
    (0_u64..90_000, after, ends, 0_u32..900_000, combine, plans).prop_map(
        move |(arrival_ms, after, (start, goal), utility_ms, combine, plans)| TaskSpec {
            name: format!("task {number}, ä\n"),
            arrival_ms,
            after,
            start: Place(start),
            goal: Place(goal),
            utility_ms,
            combine,
            plans,
        },
    )
}

fn fault() -> impl Strategy<Value = Fault> {
    let stage = prop::sample::select(Stage::ALL.to_vec());
    let during = (0_usize..2, 0_usize..2, stage, 1_u32..4, 0_u64..9_000);
    let during = during.prop_map(|(robot, task, stage, time, after_ms)| FaultTime::During {
        robot,
        task,
        stage,
        time,
        after_ms,
    });
    let modes = prop::sample::select(Row::all(usual().robot()).collect::<Vec<_>>());
    let rows = modes.clone();
    let what = prop_oneof![
        rows.prop_map(FaultKind::Auctioneer),
        (0_usize..2, modes).prop_map(|(robot, mode)| FaultKind::Robot(robot, mode)),
        (0_usize..2).prop_map(FaultKind::Shifted),
        (0_usize..2, set()).prop_map(|(task, hides)| FaultKind::Turned(task, hides)),
    ];
    (prop_oneof![during, (0_u64..99_000).prop_map(FaultTime::At)], what)
        .prop_map(|(when, what)| Fault { when, what })
}

/// The rates of the skills that a robot has.
fn fails(skills: &[Skill], rates: &[u16]) -> FailureRates {
    let rated = skills.iter().map(|it| it.capability).zip(rates.iter().cycle());
    rated.fold(FailureRates::NONE, |all, it| all.with(it.0, *it.1))
}

fn scenario() -> impl Strategy<Value = Scenario> {
    let reliability = prop_oneof![
        Just(Reliability::CERTAIN),
        (0_u16..1_000).prop_map(Reliability::Permille),
        (0_u32..50, 0_u32..50)
            .prop_map(|(succeeded, failed)| Reliability::Uses { succeeded, failed }),
    ];
    let skill = (0_u8..3, reliability).prop_map(|(number, reliability)| Skill {
        capability: Capability::new(number).unwrap(),
        reliability,
    });
    let rates = prop::collection::vec(prop_oneof![Just(0_u16), 0..=1_000_u16], 3);
    let skills = (prop::collection::vec(skill, 0..4), rates);
    let skills = prop::collection::vec(skills, 2..=4);
    let tasks = (task(0), task(1));
    let faults = prop::collection::vec(fault(), 0..4);
    let auction = (
        prop::sample::select(Method::ALL.to_vec()),
        prop::sample::select(Formation::ALL.to_vec()),
        (0_usize..2, 0_u8..3).prop_map(|(robot, kind)| match kind {
            0 => Seat::Desk,
            1 => Seat::Robot(robot),
            _ => Seat::Queue(robot),
        }),
        0_u32..3_000,
        any::<bool>(),
        prop::sample::select(Trust::ALL.to_vec()),
        prop_oneof![
            Just(Travel::Plain),
            Just(Travel::Mean),
            (1_u16..=1_000).prop_map(Travel::Quantile),
        ],
    );
    let stay = (0_u64..90, prop::option::of(1_u64..90))
        .prop_map(|(joins_ms, more)| Stay { joins_ms, leaves_ms: more.map(|it| joins_ms + it) });
    let delays = || prop::collection::vec(0_u64..90_000, 1..4);
    let crowd = prop::option::of((delays(), prop::option::of(delays())));
    let supply = (1_u16..=1_000, 0_u16..=500, 0_usize..4, 20_u32..500);
    let supply = prop::option::of(supply.prop_map(|it| Supply {
        charge_permille: it.0,
        reserve_permille: it.1,
        home: Place(it.2),
        charger_w: it.3,
    }));
    let ways = (
        prop::collection::vec(1_u64..90_000, 3),
        prop::collection::vec(stay, 4),
        prop::collection::vec(crowd, 3),
        prop::collection::vec(supply, 4),
    );
    (skills, tasks, faults, auction, ways).prop_map(|(skills, tasks, faults, auction, more)| {
        let (ways, stays, crowds, supplies) = more;
        let (method, formation, auctioneer, slack_permille, second_best, trust, travel) = auction;
        let ends = [(0, 1), (1, 2), (1, 3)];
        let crowds = ends.iter().zip(crowds).filter_map(|(between, it)| {
            let (delays_ms, seen_ms) = it?;
            Some(Crowd { between: *between, delays_ms, seen_ms })
        });
        let crowds = crowds.collect();
        let ways: Vec<_> = ends.iter().zip(ways).map(|(it, mm)| (it.0, it.1, mm)).collect();
        Scenario {
            name: "a \"team\"".into(),
            skills: ["move", "hand", "claw"].map(str::to_owned).to_vec(),
            floor: super::Floor::new(&["a", "b b", "c", "ü"], &ways),
            crowds,
            robots: (skills.into_iter().enumerate())
                .map(|(number, (skills, rates))| RobotSpec {
                    name: format!("r{number}"),
                    file: usual(),
                    fails: fails(&skills, &rates),
                    skills,
                    start: Place(number),
                    stay: stays[number],
                    supply: supplies[number],
                })
                .collect(),
            tasks: vec![tasks.0, tasks.1],
            faults,
            network: super::Quality::OFFICE,
            method,
            formation,
            auctioneer,
            slack_permille,
            second_best,
            trust,
            travel,
            seed: 0,
        }
    })
}

proptest! {
    #[test]
    fn a_team_is_read_as_it_was_written(scenario in scenario()) {
        let text = scenario.to_toml();
        let read = Scenario::parse("t.toml", &text);
        prop_assert_eq!(read.map_err(|it| format!("{it}\n{text}")), Ok(scenario));
    }

    #[test]
    fn no_bytes_of_a_team_make_its_reader_panic(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..40, ".{0,6}"), 1..4),
    ) {
        let mut text: Vec<char> = FILE.chars().collect();
        for (at, length, new) in cuts {
            let at = at.index(text.len());
            let end = (at + length).min(text.len());
            text.splice(at..end, new.chars());
        }
        let text: String = text.into_iter().collect();
        if let Ok(scenario) = Scenario::parse("t.toml", &text) {
            prop_assert_eq!(Scenario::parse("t.toml", &scenario.to_toml()), Ok(scenario));
        }
    }
}
