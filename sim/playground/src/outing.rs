//! A mission under a plan of faults, as its page needs it: the world of its courses, and the plan
//! as items that can be moved and written again.

use super::course::{self, Leg, Moment, Objective, Row, Runs, World};
use super::letters::base64;
use alloc::string::String;
use alloc::vec::Vec;
use cotama_core::units::Millis;
use cotama_models::robots::{self, Motion, Robot};
use cotama_models::severity::Persistence;
use serde_json::{Value, json};

/// A mission under a plan of faults.
#[derive(Clone, Debug, Default)]
pub struct Outing {
    /// The robot and its mission.
    pub world: World,
    /// All that happens to the supervisors, in the order of the plan.
    pub items: Vec<Item>,
    /// Other parts of the plan, in words: no flag shows them.
    pub unshown: Vec<String>,
    /// The text of a file of faults with that alone.
    pub rest: String,
    /// The command that runs a file of faults, up to the name of that.
    pub command: String,
    /// The limit on the duration of the mission, in ms.
    pub limit_ms: u64,
    /// Source of the plan, in words.
    pub from: String,
    /// The mission on its floor as markup, with the style that it needs.
    pub floor: Option<[String; 2]>,
}

/// A part of a plan.
#[derive(Clone, Debug)]
pub struct Item {
    /// The kind of it.
    pub kind: Kind,
    /// When it happens.
    pub when: robots::Moment,
    /// The lines of its event in a file of faults, without those of its moment.
    pub text: String,
    /// True if it belongs to the run and not to the plan: it stays where it is.
    pub is_fixed: bool,
}

/// The kind of an item.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A row of the FMECA, by its number, and when it ends.
    Failure(usize, Option<robots::Moment>),
    /// A row that failed works again.
    Repair(usize),
    /// The operator's answers, with the time before each.
    Operator(Vec<robots::Answer>, u64),
}

impl Outing {
    pub(super) fn data(&self) -> Value {
        json!({
            "world": base64(&self.world.encode()),
            "items": self.items.iter().map(Item::data).collect::<Vec<_>>(),
            "unshown": self.unshown,
            "rest": self.rest,
            "command": self.command,
            "limit_ms": self.limit_ms,
            "from": self.from,
            "length_mm": self.world.objectives.last().map_or(0, |it| it.end_mm),
            "floor": self.floor.is_some(),
        })
    }
}

impl Item {
    fn data(&self) -> Value {
        let numbers = |it: robots::Moment| course::numbers(Some(moment(it)));
        let (kind, row, until, answers) = match &self.kind {
            Kind::Failure(row, until) => ("failure", *row, *until, Value::Null),
            Kind::Repair(row) => ("repair", *row, None, Value::Null),
            Kind::Operator(all, delay_ms) => {
                let all: Vec<u32> = all.iter().map(number).collect();
                ("operator", 0, None, json!([delay_ms, all]))
            }
        };
        json!({
            "kind": kind,
            "row": row,
            "when": numbers(self.when),
            "until": until.map(numbers),
            "answers": answers,
            "text": self.text,
            "fixed": self.is_fixed,
        })
    }
}

fn moment(it: robots::Moment) -> Moment {
    match it {
        robots::Moment::Place(x) => Moment::Place(x.0),
        robots::Moment::At(at) => Moment::At(at),
        robots::Moment::During(place, after) => Moment::During(place, after),
        robots::Moment::Waiting(after) => Moment::Waiting(after),
    }
}

/// An answer as a course takes it.
fn number(it: &robots::Answer) -> u32 {
    match it {
        robots::Answer::Done => 0,
        robots::Answer::GivesUp => 1,
        robots::Answer::Chooses(it) => 2 + *it as u32,
    }
}

/// A part of a plan as the courses of a page take it: failures and answers, with the ends that
/// repairs make.
pub fn plan(items: &[Item]) -> course::Plan {
    let mut plan = course::Plan::default();
    for it in items {
        match &it.kind {
            Kind::Failure(row, until) => {
                let (when, until) = (moment(it.when), until.map(moment));
                let is_told = it.is_fixed;
                plan.faults.push(course::Fault { row: *row, is_told, when, until });
            }
            Kind::Repair(row) => {
                let open = |it: &&mut course::Fault| it.row == *row && it.until.is_none();
                if let Some(fault) = plan.faults.iter_mut().rfind(open) {
                    fault.until = Some(moment(it.when));
                }
            }
            Kind::Operator(answers, delay) => {
                let robots::Moment::Place(x) = it.when else { continue };
                plan.answers.push(course::Answers {
                    x: x.0,
                    delay: Millis(*delay),
                    answers: answers.iter().map(number).collect(),
                });
            }
        }
    }
    plan
}

/// The world of a robot in a mission of these objectives, with the speeds that are planned; none
/// for a robot without a body.
pub fn world(robot: &Robot, objectives: Vec<Objective>, legs: Vec<Leg>) -> Option<World> {
    let body = robot.body.as_ref()?;
    let modules = robot.modules.iter().map(|it| course::Module {
        hardware: it.needs.hardware,
        modules: it.needs.modules,
        one_of: it.one_of,
    });
    let observers = robot.observers.iter().enumerate().map(|(at, it)| {
        let own = robot.flags().enumerate().filter(|flag| flag.1.0 == at);
        let flags = own.fold(0, |set, it| set | 1_u64 << (it.0 % 64));
        course::Watch { hardware: it.needs.hardware, modules: it.needs.modules, flags }
    });
    let configurations = robot.configurations.iter();
    let configurations =
        configurations.map(|it| Runs { takes: it.takes, required: it.required }).collect();
    Some(World {
        acceleration: body.acceleration,
        fastest: body.speed_max.0,
        operator: robot.operator,
        modules: modules.collect(),
        observers: observers.collect(),
        configurations,
        rows: robot.failures.iter().map(row).collect(),
        objectives,
        legs,
    })
}

fn row(it: &robots::Failure) -> Row {
    let (motion, share) = match it.motion {
        Motion::Free => (0, 0),
        Motion::Blocked => (1, 0),
        Motion::Slowed(share) => (2, share),
        Motion::Runaway => (3, 0),
        Motion::Dead => (4, 0),
        Motion::Silent => (5, 0),
        Motion::Mindless => (6, 0),
    };
    let restarts = it
        .restarts
        .map(|of| (of.module as u8, of.mends || it.persistence != Persistence::Permanent));
    Row {
        latency: it.latency,
        is_seen: it.unseen.is_none() && !it.flags.is_empty(),
        motion,
        share,
        ends: it.ends,
        helped: it.helped,
        unanswered: it.unanswered,
        restarts,
        is_tried: it.sets.as_ref().is_some_and(|it| it.times.is_some()),
        hardware: it.loses.hardware,
        modules: it.loses.modules,
    }
}
