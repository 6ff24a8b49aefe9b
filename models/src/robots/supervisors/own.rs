//! A net of one's own in place of the local supervisor: the interface that it must have.

use super::nets;
use crate::names::quoted;
use crate::robots::Robot;
use cotama_core::net::Role;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};

/// Reads the net that a robot's file names: its path as the file says it, or why there is none.
pub type ReadNet<'r> = dyn FnMut(&str) -> Result<OwnedNet, String> + 'r;

/// Returns what keeps a net from being the local supervisor of a robot, a sentence each: what the
/// generated one has, and the others need, and what nobody would tell it.
pub(in crate::robots) fn defects(robot: &Robot, net: &OwnedNet) -> Vec<String> {
    if let Some(it) = net.view().net().defect() {
        return vec![format!("it is not sound: {it:?}")];
    }
    let made = nets::local(robot);
    let lacks = |what: &str, name: &str| format!("it lacks the {what} {}", quoted(name));
    let mut defects = Vec::new();
    for it in made.events.iter().filter(|it| !net.events.iter().any(|own| own.name == it.name)) {
        defects.push(lacks("event", &it.name));
    }
    // Nobody hears `op_request`.
    let heard = made.outputs.iter().filter(|it| it.name != "op_request");
    for it in heard.filter(|it| !net.outputs.iter().any(|own| own.name == it.name)) {
        defects.push(lacks("output", &it.name));
    }
    let is_state = |it: &&OwnedPlace| !matches!(it.role, Role::Shared | Role::Complement(_));
    let start = |name: &str| net.places.iter().find(|it| it.name == name).filter(is_state);
    for it in made.places.iter().filter(is_state) {
        match start(&it.name) {
            None => defects.push(lacks("place", &it.name)),
            Some(own) if own.initial != it.initial => defects.push(format!(
                "{} holds {} tokens at the start, not {}",
                quoted(&it.name),
                own.initial,
                it.initial
            )),
            Some(_) => {}
        }
    }
    let is_timed = |it: &&OwnedTransition| it.within.is_some();
    for it in net.transitions.iter().filter(is_timed) {
        let name = quoted(&it.name);
        defects.push(format!("rounds have no time, and {name} has an interval"));
    }
    for it in net.events.iter().filter(|it| !made.events.iter().any(|of| of.name == it.name)) {
        defects.push(format!("nobody tells it {}", quoted(&it.name)));
    }
    let is_shared = |it: &&OwnedPlace| it.role == Role::Shared;
    let known = |name: &str| made.places.iter().filter(is_shared).any(|it| it.name == name);
    for it in net.places.iter().filter(is_shared).filter(|it| !known(&it.name)) {
        defects.push(format!("no net has the shared place {}", quoted(&it.name)));
    }
    defects
}
