//! Names of what supervisors were told and of what fired.

use super::supervisors::word;
use super::{Module, Robot};
use cotama_core::net::{EventId, Place, Role, TransitionId};
use cotama_core::system::{Of, System};

/// A transition that fired, by its names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fired<'s> {
    /// The net.
    pub net: &'s str,
    /// The transition.
    pub transition: &'s str,
    /// The state that is marked after it; may be empty.
    pub place: &'s str,
    /// The outputs that it emits.
    pub outputs: Vec<&'s str>,
    /// The module that is started anew, by its number.
    pub restarts: Option<usize>,
    /// The report, by its number, whose setting is made.
    pub sets: Option<usize>,
    /// The report, by its number, whose mask is made or waits for the operator's order.
    pub masks: Option<usize>,
    /// The report, by its number, for which the operator is asked first.
    pub asks: Option<usize>,
    /// Whether a report is told to the contextual supervisor, also to ask the operator first.
    pub tells: bool,
}

/// Returns the names of a transition of a robot's supervisors; `None` where they have none such.
pub fn fired<'s>(robot: &Robot, system: &System<'s>, id: Of<TransitionId>) -> Option<Fired<'s>> {
    let component = system.components.get(usize::from(id.component))?;
    let net = component.net;
    let transition = net.transitions.get(id.id.0 as usize)?;
    let mut given = transition.give.iter().filter_map(|it| net.places.get(it.place.0 as usize));
    let is_state = |it: &&Place<'_>| it.role == Role::State;
    let place = given.find(is_state).map_or("", |it| it.name);
    let outputs = transition.emits.iter().filter_map(|it| net.outputs.get(it.0 as usize));
    let outputs: Vec<_> = outputs.map(|it| it.name).collect();
    let restarted = outputs.iter().find_map(|it| it.strip_prefix("restart_"));
    let named = |it: &Module| Some(word(&it.name).as_str()) == restarted;
    let restarts = restarted.and_then(|_| robot.modules.iter().position(named));
    let reports = || robot.losses.reports.iter();
    let report = |prefix: &str| {
        let of = outputs.iter().find_map(|it| it.strip_prefix(prefix))?;
        reports().position(|it| word(&it.name) == of)
    };
    let (sets, masks, asks) = (report("set_"), report("mask_"), report("ask_"));
    let tells = outputs.iter().any(|out| reports().any(|it| word(&it.name) == *out));
    let tells = tells || asks.is_some();
    let (net, transition) = (component.name, transition.name);
    Some(Fired { net, transition, place, outputs, restarts, sets, masks, asks, tells })
}

/// Returns the name of an event as traces have it, for example `faults.fail_LID1`.
pub fn name_of(system: &System<'_>, event: Of<EventId>) -> String {
    let net = system.components.get(usize::from(event.component));
    let name = net.and_then(|it| it.net.events.get(event.id.0 as usize)).map_or("", |it| it.name);
    format!("{}.{name}", net.map_or("", |it| it.name))
}
