//! A robot as its page needs it: tables of its decider, and its words.

use super::letters::base64;
use super::tables::encode_tables;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use cotama_core::net::EventId;
use cotama_core::net::owned::OwnedTransition;
use cotama_core::system::owned::OwnedSystem;
use cotama_models::level::{MAX_REPORTS, Tables, Told};
use cotama_models::robots::supervisors::Step;
use cotama_models::robots::{Failure, Mode, OwnedTables, Parts, Robot, members, supervisors};
use cotama_models::severity::Class;
use cotama_play::Numbered;
use serde_json::{Value, json};

/// The data of a robot with the objectives of its mission.
pub(super) fn data(robot: &Robot, steps: &[Step], numbered: &Numbered) -> Value {
    let system = supervisors::of_mission(robot, steps);
    let tables = OwnedTables::of(robot, steps, &system);
    let tables = tables.view();
    let names = |set: u64| -> Vec<&str> {
        members(set).filter_map(|it| robot.modules.get(it)).map(|it| it.name.as_str()).collect()
    };
    let configurations = robot.configurations.iter().map(|it| {
        let speed = it.speed.0;
        let (required, sub) = (names(it.required), it.sub_objective);
        json!({ "name": it.name, "required": required, "speed_mm_s": speed, "sub_objective": sub })
    });
    let objectives: Vec<String> = if steps.is_empty() {
        Vec::from([String::from("the drive")])
    } else {
        steps.iter().map(Step::place).collect()
    };
    json!({
        "name": robot.name,
        "tables": base64(&encode_tables(&tables)),
        "objectives": objectives,
        "sub_objectives": robot.sub_objectives.iter().map(|it| json!([
            it.name, it.mode == Mode::Operator
        ])).collect::<Vec<_>>(),
        "configurations": configurations.collect::<Vec<_>>(),
        "losses": robot.losses.losses.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(),
        "reports": robot.losses.reports.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(),
        "modules": robot.modules.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(),
        "flags": robot.flags().map(|(observer, flag)| {
            json!([flag, robot.observers.get(observer).map(|it| it.title.as_str())])
        }).collect::<Vec<_>>(),
        "failures": robot.failures.iter().map(|it| failure(robot, it)).collect::<Vec<_>>(),
        "decisions": decisions(&system, numbered),
        "says": says(robot, &tables, &objectives, numbered),
    })
}

/// The first transition of the contextual supervisor, and the class of what each decides, a digit
/// each.
fn decisions(system: &OwnedSystem, numbered: &Numbered) -> Option<(u32, String)> {
    let at = system.nets.iter().position(|it| it.0 == "cs")?;
    let net = &system.nets.get(at)?.1;
    let class = |it: &OwnedTransition| {
        let outputs = it.emits.iter().filter_map(|it| net.outputs.get(it.0 as usize));
        let strongest = outputs.map(|it| Class::of_output(&it.name)).max();
        char::from(b'0' + strongest.unwrap_or(Class::Record) as u8)
    };
    let first = numbered.first_transition(at)?.0;
    Some((first, net.transitions.iter().map(class).collect()))
}

fn failure(robot: &Robot, it: &Failure) -> Value {
    let works = robot.available(it.loses);
    json!({
        "id": it.id,
        "what": format!("{}{}{}", it.item, if it.item.is_empty() { "" } else { ": " }, it.mode),
        "effect": it.effect,
        "severity": [it.autonomous.name(), it.operator.name()],
        "flags": it.flags,
        "sometimes": it.sometimes,
        "unseen": it.unseen,
        "latency_ms": it.latency.0,
        "loses": names_of(robot, it.loses),
        "works": [works as u32, (works >> 32) as u32],
    })
}

fn names_of(robot: &Robot, parts: Parts) -> Vec<&str> {
    if parts == Parts::NONE { Vec::new() } else { robot.names_of(parts) }
}

/// All that can be said to the supervisors: event, kind and number, words; and which reports they
/// are told by flags alone.
fn says(
    robot: &Robot,
    tables: &Tables<'_>,
    objectives: &[String],
    numbered: &Numbered,
) -> Vec<Value> {
    let sub_objective = |it: usize| robot.sub_objectives.get(it).map_or("?", |it| it.name.as_str());
    let mut all: Vec<(Told, String)> = Vec::from([(Told::Begins, "the mission begins".into())]);
    all.extend(
        objectives
            .iter()
            .enumerate()
            .map(|(at, it)| (Told::Over(at), format!("the task of {it} is done"))),
    );
    let subs = 0..robot.sub_objectives.len();
    all.extend(
        subs.clone().map(|it| (Told::Reached(it), format!("{} is at its end", sub_objective(it)))),
    );
    all.extend(
        subs.clone()
            .map(|it| (Told::Chooses(it), format!("operator: {}, please", sub_objective(it)))),
    );
    all.extend(
        subs.map(|it| (Told::Done(it), format!("operator: I am done with {}", sub_objective(it)))),
    );
    all.push((Told::GivesUp, "operator: I give up".into()));
    all.push((Told::Stopped, "the robot stands, after the end".into()));
    let reports = robot.losses.reports.iter().enumerate().take(MAX_REPORTS);
    all.extend(reports.map(|(at, it)| (Told::Report(at), format!("report {}", it.name))));
    let losses = robot.losses.losses.iter().enumerate();
    all.extend(losses.map(|(at, it)| (Told::Back(at), format!("{} works again", it.name))));
    let said = all.into_iter().filter_map(|(told, words)| {
        let EventId(event) = numbered.event(tables.event(told)?)?;
        let (kind, number) = told.to_numbers();
        Some(json!([event, kind, number, words]))
    });
    said.collect()
}
