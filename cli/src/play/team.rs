//! The protocol of a team, as its page plays it: that of a part of a team that is too large.

use crate::render::numbers::count;
use crate::team::Protocol;
use cotama_models::team::scenario::{Fault, FaultKind, RobotSpec, RoleSpec, Scenario, Seat};

/// The most robots of a part.
const ROBOTS: usize = 3;

/// All that is not in a net of the protocol.
const LEFT_OUT: &str = "What a bid is worth, robots on their way, objects, the floor, and messages \
    that are late or lost are not simulated here: `cotama run` does that. Each transition is an \
    event, so you are all robots and the radio at once.";

/// The protocol of a team as it is played.
pub(super) struct Played {
    pub(super) protocol: Protocol,
    /// Sentences for its page.
    pub(super) note: String,
    /// True if it is that of a part of the team, which no other command knows.
    pub(super) is_part: bool,
}

/// The protocol of a team; of one that is too large for a net, that of its first task, and of the
/// first robots that can fill a role of it.
pub(super) fn protocol(scenario: &Scenario) -> Option<Played> {
    if let Some(it) = Protocol::of(scenario) {
        let note = format!("This is {}. {LEFT_OUT}", it.notes.join("; "));
        return Some(Played { protocol: it, note, is_part: false });
    }
    let (robots, tasks) = (scenario.robots.len() as u64, scenario.tasks.len() as u64);
    let it = Protocol::of(&part(scenario))?;
    let note = format!(
        "Of {} and {} this is the first task, with the first {} that can fill a role of it: all of \
         them are more than a net can hold. It is {}. {LEFT_OUT}",
        count(robots, "robot"),
        count(tasks, "task"),
        ROBOTS,
        it.notes.join("; ")
    );
    Some(Played { protocol: it, note, is_part: true })
}

/// The first task of a team, and the first robots that can fill a role of it.
fn part(scenario: &Scenario) -> Scenario {
    let mut part = scenario.clone();
    part.tasks.truncate(1);
    let roles: Vec<&RoleSpec> =
        part.tasks.iter().flat_map(|it| &it.plans).flat_map(|it| &it.roles).collect();
    let is_capable = |at: &usize| {
        let robot = scenario.robots.get(*at).map(RobotSpec::capabilities);
        robot.is_some_and(|able| roles.iter().any(|role| role.possible(able)))
    };
    let kept: Vec<usize> = (0..scenario.robots.len()).filter(is_capable).take(ROBOTS).collect();
    part.robots = kept.iter().filter_map(|it| scenario.robots.get(*it)).cloned().collect();
    part.auctioneer = Seat::Desk;
    // One of them fails at most, if a robot of the team does.
    let fails = |it: &&Fault| matches!(it.what, FaultKind::Robot(..));
    part.faults = scenario.faults.iter().filter(fails).take(1).copied().collect();
    part
}
