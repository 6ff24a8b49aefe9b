//! The supervisors that a robot's file makes, as one system.
//!
//! | net | is made of |
//! | --- | --- |
//! | `gs`, global supervisor: objectives in their order, or security | the mission |
//! | `ls`, local supervisor | sub-objectives, in their order; or a net of one's own |
//! | adapters, named after the sub-objectives that have several configurations | ranks, losses |
//! | `permit`, the permit to move | nothing: [`permit`] |
//! | `gom`, observation: known losses, restarts, settings | failures |
//! | `cs`, contextual supervisor | [`decide`](super::decide) |
//! | `faults`, `operator`: the surroundings, for the checker | failures, sub-objectives |
//!
//! (Durand et al., TAROS 2010, Section V.) Places of configurations and sub-objectives have their
//! names, with `_` in place of all but letters and digits; adapters are in lower case, as all nets.

mod cubes;
mod draft;
mod global;
mod joined;
mod nets;
mod observing;
mod own;
mod rust_source;

pub use cotama_core::system::owned::OwnedSystem;
pub(super) use global::begins;
pub(crate) use global::global;
pub use global::{MAX_STEPS, RESERVED, Step};
pub use own::ReadNet;
pub(super) use own::defects;
pub use rust_source::to_rust;

use super::{Mode, Robot, SubObjective};
use crate::level::permit;
use cotama_core::net::owned::OwnedNet;
use joined::Joined;
pub(super) use nets::lost;
use nets::{configuration, has_adapter, parts};
pub(super) use observing::asks_now;

/// Returns a name as nets have it: letters, digits and `_`.
pub(crate) fn word(name: &str) -> String {
    name.chars().map(|it| if it.is_ascii_alphanumeric() { it } else { '_' }).collect()
}

/// Returns the name of a sub-objective's adapter in the system: a reader of the file has seen that
/// no other net has it.
pub(super) fn adapter(it: &SubObjective) -> String {
    word(&it.name).to_lowercase()
}

/// Returns the place that is marked where a configuration runs, as properties name it.
pub(super) fn place_of(robot: &Robot, it: usize) -> String {
    let of = robot.configurations.get(it).and_then(|it| robot.sub_objectives.get(it.sub_objective));
    let Some(of) = of else { return String::new() };
    if has_adapter(of) {
        format!("{}.{}", adapter(of), configuration(robot, it))
    } else {
        format!("ls.{}", word(&of.name))
    }
}

/// The event of the contextual supervisor by which it is told a report.
fn told_as(robot: &Robot, report: usize) -> String {
    let told = robot.losses.reports.get(robot.losses.told_as(report));
    told.map_or_else(String::new, |it| word(&it.name))
}

/// The reports, by number, that are told as themselves, each with all failures that are told so.
fn told_alone(robot: &Robot) -> impl Iterator<Item = (usize, Vec<usize>)> {
    let alone = 0..robot.losses.reports.len();
    alone.filter(|it| robot.losses.told_as(*it) == *it).map(move |number| {
        let all = robot.losses.reports.iter().enumerate();
        let same = all.filter(|it| robot.losses.told_as(it.0) == number);
        (number, same.flat_map(|it| it.1.failures.iter().copied()).collect())
    })
}

/// The failures of a report, in words.
fn told(robot: &Robot, failures: &[usize]) -> String {
    let all = failures.iter().filter_map(|it| robot.failures.get(*it));
    let all: Vec<_> = all.map(|it| format!("{}: {}", it.id, it.mode)).collect();
    all.join("; ")
}

/// Returns the condition under which a configuration cannot run, as far as is known, in the
/// language of properties; `None` if it always can.
pub(super) fn cannot_run(robot: &Robot, it: usize) -> Option<String> {
    cannot(robot, |lost| robot.running(lost) >> it & 1 == 1)
}

/// Returns the condition under which something cannot be done, as far as losses are known.
pub(super) fn cannot(robot: &Robot, can: impl Fn(u32) -> bool) -> Option<String> {
    let cases = cubes::cubes(robot.losses.all(), 0, &|lost| !can(lost));
    let cases = cases.into_iter().filter(|it| it.1).map(|(cube, _)| {
        let all = 0..robot.losses.losses.len();
        let all = all.filter_map(|loss| match (cube.lost >> loss & 1, cube.kept >> loss & 1) {
            (1, _) => Some(format!("gom.{}", lost(robot, loss))),
            (_, 1) => Some(format!("!gom.{}", lost(robot, loss))),
            _ => None,
        });
        format!("({})", all.collect::<Vec<_>>().join(" & "))
    });
    let cases: Vec<_> = cases.collect();
    (!cases.is_empty()).then(|| cases.join(" | "))
}

/// Makes the supervisors of a robot, with the surroundings in which they are checked.
///
/// ```
/// use cotama_models::robots::{Robot, supervisors};
/// let robot = Robot::shipped("transport").unwrap();
/// let system = supervisors::system(&robot);
/// let names: Vec<_> = system.nets.iter().map(|it| it.0.as_str()).collect();
/// assert_eq!(names[..5], ["gs", "ls", "follow", "manual", "permit"]);
/// system.with(|system| assert_eq!(system.defect(), None));
/// ```
pub fn system(robot: &Robot) -> OwnedSystem {
    of_mission(robot, &[])
}

/// The same with the global supervisor of a mission, made from its objectives.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_models::robots::supervisors;
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let robot = mission.robot().unwrap().robot();
/// let system = supervisors::of_mission(robot, &mission.steps());
/// let places: Vec<_> = system.nets[0].1.places.iter().map(|it| it.name.as_str()).collect();
/// assert_eq!(places[..6], ["Wait", "DriveA", "Receive", "DriveB", "Deliver", "Done"]);
/// ```
pub fn of_mission(robot: &Robot, steps: &[Step]) -> OwnedSystem {
    let (own, operator) = (parts(robot, Mode::Autonomous), parts(robot, Mode::Operator));
    let all: Vec<_> = own.iter().chain(&operator).collect();
    let doc = format!("The supervisors of {}, made from its file.", robot.name);
    let mut system = Joined::new(&word(&robot.name), &doc);
    system.net("gs", global::global(steps));
    system.net("ls", robot.local.clone().unwrap_or_else(|| nets::local(robot)));
    for it in all.iter().filter(|it| has_adapter(it.is)) {
        system.net(&adapter(it.is), nets::adapter(robot, it));
    }
    system.net("permit", OwnedNet::from(&permit::NET));
    system.net("gom", observing::observation(robot));
    system.net("cs", nets::contextual(robot));
    system.net("faults", observing::faults(robot));
    if robot.operator.is_some() {
        system.net("operator", nets::operator(robot));
    }

    system.mail(("gs", "start_drive"), ("ls", "start_drive"));
    system.now(("gs", "gs_abort"), ("ls", "gs_abort"));
    system.now(("gs", "halt"), ("permit", "halt"));
    system.mail(("ls", "ended"), ("ls", "tick"));
    system.mail(("ls", "drive_done"), ("gs", "drive_done"));
    system.mail(("ls", "no_way"), ("gs", "no_way"));
    system.mail(("cs", "global_event"), ("gs", "global_event"));
    system.mail(("cs", "local_event"), ("ls", "local_event"));
    for it in &all {
        let (start, stop) = (format!("start_{}", it.name), format!("stop_{}", it.name));
        if has_adapter(it.is) {
            let adapter = adapter(it.is);
            system.now(("ls", &start), (&adapter, "start"));
            system.now(("ls", &stop), (&adapter, "stop"));
            system.mail(("cs", &format!("adapt_{}", it.name)), (&adapter, "adapt"));
        }
        if it.is.moves {
            system.now(("ls", &start), ("permit", "grant"));
            system.now(("ls", &stop), ("permit", "revoke"));
        }
    }
    for (number, report) in robot.losses.reports.iter().enumerate() {
        let (flag, told) = (format!("flag_{}", word(&report.name)), told_as(robot, number));
        if robot.losses.told_as(number) == number {
            system.mail(("gom", &told), ("cs", &told));
        }
        system.mail(("faults", &flag), ("gom", &flag));
        if report.asks.is_some() {
            let asks = format!("ask_{}", word(&report.name));
            system.mail(("gom", &asks), ("cs", &asks));
        }
    }
    for it in robot.losses.losses.iter().filter(|it| it.returns) {
        let back = format!("back_{}", word(&it.name));
        system.mail(("faults", &back), ("gom", &back));
    }
    if robot.operator.is_some() {
        system.mail(("operator", "refusal"), ("cs", "refusal"));
        for it in &operator {
            let done = format!("{}_done", it.name);
            let choice = format!("op_{}", it.name);
            system.now(("operator", &choice), ("ls", &choice));
            system.now(("operator", &done), ("ls", &done));
        }
    }
    shares(robot, &mut system, &all.iter().map(|it| it.name.as_str()).collect::<Vec<_>>());
    system.done()
}

/// Binds what nets see of one another.
fn shares(robot: &Robot, system: &mut Joined, all: &[&str]) {
    // A local supervisor of the user's looks at what it likes.
    let sees = |place: &str| {
        robot.local.as_ref().is_none_or(|net| net.places.iter().any(|it| it.name == place))
    };
    let has_operator = robot.operator.is_some();
    let watching = if has_operator { &["cs", "operator"][..] } else { &["cs"] };
    for by in watching {
        system.share((by, "waits"), ("ls", "Waits"));
    }
    let operator = parts(robot, Mode::Operator);
    for name in all {
        let place = format!("in_{name}");
        system.share(("cs", &place), ("ls", name));
        if has_operator && operator.iter().any(|it| it.name == *name) {
            system.share(("operator", &place), ("ls", name));
        }
    }
    let adapters = robot.sub_objectives.iter().filter(|it| has_adapter(it));
    let adapters: Vec<_> = adapters.map(|it| (adapter(it), &it.configurations)).collect();
    for (name, configurations) in &adapters {
        for it in configurations.iter().map(|it| configuration(robot, *it)) {
            system.share(("cs", &format!("runs_{it}")), (name, &it));
        }
    }
    for flag in (0..robot.losses.losses.len()).map(|it| lost(robot, it)) {
        let adapters = adapters.iter().map(|it| it.0.as_str());
        for by in watching.iter().copied().chain(["ls"]).chain(adapters) {
            if by != "ls" || sees(&flag) {
                system.share((by, &flag), ("gom", &flag));
            }
        }
    }
    for (pending, event) in [("local_pending", "ls"), ("global_pending", "gs")] {
        if sees(pending) {
            let event = (event, pending.replace("pending", "event"));
            system.pending(("ls", pending), (event.0, &event.1));
        }
    }
    system.clear(("ls", "gs_abort"), "local_event");
    system.clear(("ls", "gs_abort"), "start_drive");
}
