//! The instance and the protocol that are made of a team, and the team that is read from JSON.

use super::{FILE, PlanSpec, Scenario, Take, scenario, service};
use crate::team::instance::{Instance, Kind, Verdict};
use crate::team::protocol::{self, Team};
use cotama_core::team::Combine;
use proptest::prelude::*;
use std::fmt::Write;

/// All ways to fill the roles of a plan with robots that are free: who, and what the task costs.
fn ways(team: &Scenario, task: usize, plan: &PlanSpec, free: &[bool]) -> Vec<(Vec<usize>, u64)> {
    let mut ways = vec![(vec![], vec![])];
    for role in &plan.roles {
        let longer = |(robots, costs): &(Vec<usize>, Vec<u64>)| {
            let other = |it: &usize| free[*it] && !robots.contains(it);
            let bids = (0..free.len()).filter(other).filter_map(|it| {
                let bid = u64::from(team.bid(it, task, role)?);
                Some(([&robots[..], &[it]].concat(), [&costs[..], &[bid]].concat()))
            });
            bids.collect::<Vec<_>>()
        };
        ways = ways.iter().flat_map(longer).collect();
    }
    let cost = |costs: &[u64]| {
        // In halves: plans have one role, or two.
        let joint = match team.tasks[task].combine {
            Combine::Sum => 2 * costs.iter().sum::<u64>(),
            Combine::Mean => 2 / costs.len() as u64 * costs.iter().sum::<u64>(),
            Combine::Max => 2 * costs.iter().max().unwrap(),
        };
        joint + 2 * u64::from(plan.extra_ms)
    };
    ways.into_iter().map(|(robots, costs)| (robots, cost(&costs))).collect()
}

/// The least cost of these tasks and all behind them, in halves, by trying everything.
fn least(team: &Scenario, task: usize, free: &[bool]) -> u64 {
    let Some(it) = team.tasks.get(task) else { return 0 };
    let mut best = 2 * u64::from(it.utility_ms) + least(team, task + 1, free);
    for (robots, cost) in it.plans.iter().flat_map(|plan| ways(team, task, plan, free)) {
        let mut rest = free.to_vec();
        robots.iter().for_each(|it| rest[*it] = false);
        best = best.min(cost + least(team, task + 1, &rest));
    }
    best
}

/// A document of TOML as one of JSON.
fn json(value: &toml::Value) -> String {
    let list = |all: Vec<String>| all.join(", ");
    match value {
        toml::Value::Table(table) => {
            let entry = |(key, value): (&String, _)| format!("{}: {}", text(key), json(value));
            format!("{{{}}}", list(table.iter().map(entry).collect()))
        }
        toml::Value::Array(all) => format!("[{}]", list(all.iter().map(json).collect())),
        toml::Value::String(it) => text(it),
        toml::Value::Integer(it) => it.to_string(),
        toml::Value::Float(it) => format!("{it:?}"),
        toml::Value::Boolean(it) => it.to_string(),
        toml::Value::Datetime(_) => unreachable!("no key is a time"),
    }
}

fn text(text: &str) -> String {
    let mut quoted = String::from('"');
    for it in text.chars() {
        match it {
            '"' | '\\' => quoted.extend(['\\', it]),
            it if it.is_control() => write!(quoted, "\\u{:04x}", it as u32).unwrap(),
            it => quoted.push(it),
        }
    }
    quoted + "\""
}

fn as_json(toml: &str) -> String {
    json(&toml::Value::Table(toml.parse().unwrap()))
}

proptest! {
    #[test]
    fn an_assignment_costs_what_trying_everything_finds(team in scenario()) {
        let instance = Instance::from(&team);
        let found = instance.solve(1_000_000).unwrap();
        let Verdict::Optimal { cost } = found.verdict else { panic!("{found:?}") };
        let least = least(&team, 0, &vec![true; team.robots.len()]);
        prop_assert_eq!(cost * 2, least * u64::from(instance.denominator));
    }

    #[test]
    fn a_protocol_is_of_the_robots_and_tasks_of_its_team(team in scenario()) {
        let made = Team::from(&team);
        prop_assert_eq!((made.robots(), made.tasks()), (team.robots.len(), team.tasks.len()));
        let net = protocol::net(&made);
        prop_assert_eq!(net.view().net().defect(), None);
        prop_assert!(net.transitions.len() as u64 <= made.steps().unwrap());
        // A robot bids for a task if it can fill a role of it.
        for (t, task) in team.tasks.iter().enumerate() {
            for (r, robot) in team.robots.iter().enumerate() {
                let mut roles = task.plans.iter().flat_map(|it| &it.roles);
                let name = format!("t{}.bid.r{}", t + 1, r + 1);
                let bids = net.transitions.iter().any(|it| it.name == name);
                prop_assert_eq!(bids, roles.any(|it| it.possible(robot.capabilities())));
            }
        }
    }

    #[test]
    fn a_team_in_json_is_the_same_as_in_toml(team in scenario()) {
        let text = as_json(&team.to_toml());
        let read = Scenario::parse("t.json", &text);
        prop_assert_eq!(read.map_err(|it| format!("{it}\n{text}")), Ok(team));
    }

    #[test]
    fn no_bytes_of_a_team_in_json_make_its_reader_panic(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..40, ".{0,6}"), 1..4),
    ) {
        let mut text: Vec<char> = as_json(FILE).chars().collect();
        for (at, length, new) in cuts {
            let at = at.index(text.len());
            let end = (at + length).min(text.len());
            text.splice(at..end, new.chars());
        }
        let text: String = text.into_iter().collect();
        if let Err(errors) = Scenario::parse("t.json", &text) {
            prop_assert!(!errors.to_string().is_empty());
        }
    }
}

/// The first message of the service in JSON with one text in place of another, and its help.
fn told(from: &str, to: &str) -> (String, String) {
    let whole = as_json(FILE);
    assert!(whole.contains(from), "{from}: {whole}");
    let errors = Scenario::parse("s.json", &whole.replacen(from, to, 1)).unwrap_err();
    let first = &errors.diagnostics()[0];
    assert_eq!(errors.diagnostics().len(), 1, "{errors}");
    (first.message.clone(), first.help.clone().unwrap_or_default())
}

#[test]
fn a_mistake_in_json_is_told_in_the_words_of_json() {
    for (from, to, message, help) in [
        (
            "\"length_mm\": 4000",
            "\"length_m\": 4",
            "unknown key `length_m` in this `way`; did you mean `length_mm`?",
            "write `\"length_mm\": 4000`",
        ),
        (
            "\"length_mm\": 4000",
            "\"length_mm\": \"4 m\"",
            "`length_mm` must be an integer, not a text",
            "write a whole number, without quotes and without a unit",
        ),
        ("\"length_mm\": 4000", "\"length_mm\": null", "`null` says nothing here", "leave the key"),
        ("\"length_mm\": 4000", "\"length_mm\": NaN", "this is no number of JSON", "one object"),
        (
            "\"length_mm\": 4000",
            "\"length_mm\": 1, \"length_mm\": 2",
            "`length_mm` is there twice",
            "leave out one of them",
        ),
        ("\"fault\": [{", "\"fault\": [[], {", "`fault` must be an object, not a list", "change"),
        (
            "cotama-team/1",
            "cotama-team/9",
            "unknown format `cotama-team/9`",
            "this program reads `\"format\": \"cotama-team/1\"` here",
        ),
        (
            "\"format\": \"cotama-team/1\", ",
            "",
            "missing key `format` in the file",
            "add `\"format\": \"cotama-team/1\"`",
        ),
        (
            "\"second_best\": true",
            "\"second_best\": true,",
            "a key in quotation marks",
            "one object",
        ),
    ] {
        let (said, cure) = told(from, to);
        assert!(said.starts_with(message), "{to}: {said}");
        assert!(cure.contains(help), "{to}: {cure}");
    }
    let whole = FILE.replace("length_mm = 6000", "length_mm = 6000.0");
    let service = Scenario::parse("s.json", &as_json(&whole));
    assert_eq!(service, super::service(), "6000.0 is whole in JSON");
}

#[test]
fn the_service_has_its_bids_at_the_start() {
    let service = service().unwrap();
    let instance = Instance::from(&service);
    assert_eq!((instance.kind, instance.denominator), (Kind::Simultaneous, 2));
    let serve = &instance.tasks[1];
    let costs = |plan: usize| {
        let each = serve.plans[plan].costs.iter().map(|it| it.map(cotama_core::team::Cost::get));
        each.collect::<Vec<_>>()
    };
    assert_eq!(serve.plans.iter().map(|it| it.extra).collect::<Vec<_>>(), [300_000, 0, 0]);
    // Tommy has no hand; Eddie alone speaks.
    assert!(costs(0)[..3].iter().all(Option::is_some) && costs(0)[3].is_none());
    assert!(costs(1)[0].is_some() && costs(1)[1..].iter().all(Option::is_none));
    assert_eq!(costs(2)[0], costs(0)[0]);
    // Nobody is fit for a task whose object no way leads to.
    let mut far = service;
    let names = ["desk", "hall", "kitchen", "billiards", "lounge"];
    far.floor = super::super::Floor::new(&names, &[(0, 1, 4_000), (1, 3, 9_000), (1, 4, 40_000)]);
    let takes = |it: &crate::team::scenario::RoleSpec| it.take == Take::Object;
    let roles = far.tasks.iter().enumerate().flat_map(|it| {
        it.1.plans
            .iter()
            .flat_map(|it| &it.roles)
            .filter(|it| takes(it))
            .map(move |role| (it.0, role))
    });
    for (task, role) in roles {
        assert!((0..4).all(|it| far.bid(it, task, role).is_none()), "{}", role.name);
    }
}

#[test]
fn a_team_too_large_for_a_net_is_known_before_it_is_made() {
    let mut team = service().unwrap();
    assert!(Team::from(&team).steps().is_some());
    let robot = team.robots[0].clone();
    team.robots = vec![robot; crate::team::scenario::MAX_ROBOTS];
    assert_eq!(Team::from(&team).steps(), None);
    let mut team = service().unwrap();
    team.tasks = vec![team.tasks[0].clone(); 10_000];
    assert_eq!(Team::from(&team).steps(), None);
}
