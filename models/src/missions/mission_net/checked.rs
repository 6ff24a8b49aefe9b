//! Whether a global supervisor does its mission: every marking looked at, in well under a
//! millisecond, before the robot moves.

use super::{
    DONE, GLOBAL_EVENT, HALT, MISSION_RECEIVED, MissionNetError, SAFE, SECURITY, START_DRIVE,
    STOPPED, WAIT, WARN, ends_with, kinds,
};
use crate::missions::definition::{Does, Objective};
use cotama_core::net::{Arc, EventId, Ignored, Net, NetError, OutputId, PlaceId, Transition};
use cotama_core::player::code::plus;
use cotama_core::player::{Packed, words};
use cotama_core::system::{Component, System};
use std::fmt;

/// The size of what was explored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Explored {
    /// Reachable markings: with one token, as many as places.
    pub markings: usize,
    /// Firings between them.
    pub firings: usize,
}

/// A defect of a global supervisor. Places and transitions are named as in the net; the place of an
/// objective has its id.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The net is no supervisor of these objectives at all.
    Objectives(MissionNetError),
    /// The lists of the net do not fit together, or it is too large.
    Defect(NetError),
    /// An objective, or one of the places of every supervisor, has no place.
    Missing(String),
    /// There is not exactly one token.
    Tokens {
        /// After this transition; `None`: at the start.
        after: Option<String>,
        /// Tokens at the start, or after the firing.
        tokens: u32,
    },
    /// The robot never comes here.
    Unreached(String),
    /// From here, the end is out of reach; of several such places, the last one on the way.
    Blocks {
        /// The place.
        at: String,
        /// The end.
        end: &'static str,
    },
    /// Nothing can happen here, which is no end.
    Deadlock(String),
    /// An event has several answers here.
    Ambiguous {
        /// The place.
        at: String,
        /// The event.
        event: String,
    },
    /// An event is not answered here as the mission demands.
    Answer {
        /// The place.
        at: String,
        /// The event.
        event: String,
        /// The place it leads to; `None`: it is not answered.
        found: Option<String>,
        /// The place it has to lead to; `None`: it has to be ignored.
        expected: Option<String>,
    },
    /// A transition does not say what it has to.
    Says {
        /// The transition.
        transition: String,
        /// The outputs expected, by name.
        expected: Vec<String>,
    },
    /// A transition fires by itself, in a time, or needs a token that it leaves.
    NotPlain(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Objectives(error) => write!(f, "{error}"),
            Self::Defect(defect) => {
                write!(f, "the lists of the supervisor do not fit together: {defect:?}")
            }
            Self::Missing(name) => write!(f, "the supervisor has no place `{name}`"),
            Self::Tokens { after: None, tokens } => {
                write!(f, "{tokens} tokens at the start, not one")
            }
            Self::Tokens { after: Some(after), tokens } => {
                write!(f, "{tokens} tokens after `{after}`, not one")
            }
            Self::Unreached(place) => write!(f, "`{place}` is never reached"),
            Self::Blocks { at, end } => {
                write!(f, "`{at}` could block: from there `{end}` is out of reach")
            }
            Self::Deadlock(at) => write!(f, "`{at}` could block: nothing leads away from it"),
            Self::Ambiguous { at, event } => {
                write!(f, "in `{at}` the event `{event}` has several answers")
            }
            Self::Answer { at, event, found, expected } => {
                let place = |name: &Option<String>| {
                    name.as_ref().map_or("nowhere".into(), |name| format!("to `{name}`"))
                };
                write!(
                    f,
                    "in `{at}` the event `{event}` leads {}, not {}",
                    place(found),
                    place(expected)
                )
            }
            Self::Says { transition, expected } => {
                write!(
                    f,
                    "`{transition}` has to say: {}",
                    if expected.is_empty() { "nothing".into() } else { expected.join(", ") }
                )
            }
            Self::NotPlain(transition) => {
                write!(f, "`{transition}` does not just wait for an event and move the token")
            }
        }
    }
}

impl std::error::Error for Fault {}

/// Looks at every marking of the global supervisor of these objectives.
///
/// What is checked: there is one token, always; from every objective `Done` can be reached, and
/// from everywhere `Safe`; only `Done` and `Safe` may be without a way out; every place is reached;
/// a global event leads from everywhere to `Security`, and is ignored on purpose there and in
/// `Safe`; every objective is left by its own event to the next one, and by no other event; nothing
/// is ambiguous; and what starts drives, halts and warns is said, where it has to be and nowhere
/// else.
///
/// # Errors
/// Everything that is wrong, in this order; of tokens only the first.
///
/// ```
/// use cotama_models::missions::mission_net::check;
/// use cotama_models::missions::{Mission, embedded};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let mut net = mission.supervisor().unwrap().clone();
/// assert_eq!(check(&net.view().net(), &mission.objectives).unwrap().markings, 8);
/// net.transitions.pop();
/// assert!(check(&net.view().net(), &mission.objectives).is_err());
/// ```
pub fn check(net: &Net<'_>, objectives: &[Objective]) -> Result<Explored, Vec<Fault>> {
    let kinds = kinds(objectives).map_err(|error| vec![Fault::Objectives(error)])?;
    let one = |fault| vec![fault];
    let (graph, walk) = match words(&System::alone(&[Component::alone(net)])) {
        Some(0..=1) => explore::<1>(net),
        _ => explore::<8>(net),
    }
    .and_then(|graph| Ok((graph, walk(net, objectives)?)))
    .map_err(one)?;
    let check = Check { net, graph: &graph, walk: &walk };
    let mut faults = check.blocks();
    faults.extend(check.reached());
    for at in 0..net.places.len() {
        check.answers(at, &kinds, &mut faults);
    }
    check.plain(&mut faults);
    if faults.is_empty() {
        let markings = graph.reached.iter().filter(|reached| **reached).count();
        Ok(Explored { markings, firings: graph.firings.len() })
    } else {
        Err(faults)
    }
}

/// The moves of one token. As there is one, a marking is the place that it marks.
struct Graph {
    reached: Vec<bool>,
    /// From, to, and the position of the transition.
    firings: Vec<(usize, usize, usize)>,
}

/// Every marking, from the start; at the first with other than one token it ends.
fn explore<const W: usize>(net: &Net<'_>) -> Result<Graph, Fault> {
    let packed = Packed::<W>::alone(net).map_err(Fault::Defect)?;
    let code = packed.code();
    let tokens = net.places.iter().map(|place| place.initial).fold(0, u32::saturating_add);
    if tokens != 1 {
        return Err(Fault::Tokens { after: None, tokens });
    }
    let places = || 0..net.places.len();
    let marked = |marking: &[u64; W]| {
        places().find(|&place| code.tokens(marking, PlaceId(place as u32)) > 0).unwrap_or(0)
    };
    let weight = |arcs: &[Arc]| arcs.iter().map(|arc| arc.weight).fold(0, u32::saturating_add);
    let mut graph = Graph { reached: vec![false; net.places.len()], firings: Vec::new() };
    let mut queue = vec![code.initial];
    graph.reached[marked(&code.initial)] = true;
    let mut next = 0;
    while let Some(&marking) = queue.get(next) {
        next += 1;
        for entry in code.entries.iter().filter(|entry| code.holds(&marking, &entry.need)) {
            let number = usize::from(entry.transition);
            let transition = &net.transitions[number];
            // An enabled transition has one token to take, so it takes one at most.
            let tokens = (1 - weight(transition.take)).saturating_add(weight(transition.give));
            if tokens != 1 {
                return Err(Fault::Tokens { after: Some(transition.name.to_owned()), tokens });
            }
            let after = plus(&marking, &entry.delta);
            let (from, to) = (marked(&marking), marked(&after));
            graph.firings.push((from, to, number));
            if !std::mem::replace(&mut graph.reached[to], true) {
                queue.push(after);
            }
        }
    }
    Ok(graph)
}

/// Returns the path of the mission, as positions of places: `Wait`, the objectives, `Done`; then
/// `Security` and `Safe`.
fn walk(net: &Net<'_>, objectives: &[Objective]) -> Result<Vec<usize>, Fault> {
    let ids = objectives.iter().map(|it| it.id.as_str());
    let names = [WAIT].into_iter().chain(ids).chain([DONE, SECURITY, SAFE]);
    let find = |name: &str| {
        net.places
            .iter()
            .position(|place| place.name == name)
            .ok_or_else(|| Fault::Missing(name.to_owned()))
    };
    names.map(find).collect()
}

struct Check<'c> {
    net: &'c Net<'c>,
    graph: &'c Graph,
    walk: &'c [usize],
}

impl Check<'_> {
    fn name(&self, place: usize) -> String {
        self.net.places[place].name.to_owned()
    }

    fn reached(&self) -> Vec<Fault> {
        let never = self.graph.reached.iter().enumerate().filter(|(_, reached)| !**reached);
        never.map(|(place, _)| Fault::Unreached(self.name(place))).collect()
    }

    /// From where this place can be reached.
    fn can_reach(&self, goal: usize) -> Vec<bool> {
        let mut can = vec![false; self.graph.reached.len()];
        let mut queue = vec![goal];
        can[goal] = true;
        while let Some(at) = queue.pop() {
            for &(from, ..) in self.graph.firings.iter().filter(|(_, to, _)| *to == at) {
                if !std::mem::replace(&mut can[from], true) {
                    queue.push(from);
                }
            }
        }
        can
    }

    fn blocks(&self) -> Vec<Fault> {
        let [before @ .., _, safe] = self.walk else { return Vec::new() };
        let Some(&done) = before.last() else { return Vec::new() };
        let (accomplished, stopped) = (self.can_reach(done), self.can_reach(*safe));
        let out_of_reach = |can: &[bool], at: &usize| self.graph.reached[*at] && !can[*at];
        let last = |mut ways: std::slice::Iter<'_, usize>, can: &[bool], end| {
            let blocking = ways.rfind(|at| out_of_reach(can, at));
            blocking.map(|&at| Fault::Blocks { at: self.name(at), end })
        };
        let late = last(before.iter(), &accomplished, DONE);
        let unsafe_at = last(self.walk.iter(), &stopped, SAFE);
        let left =
            |at: usize| self.graph.firings.iter().any(|&(from, to, _)| from == at && to != at);
        let ends = [done, *safe];
        let stuck = |at: &usize| self.graph.reached[*at] && !ends.contains(at) && !left(*at);
        let stuck =
            (0..self.graph.reached.len()).filter(stuck).map(|at| Fault::Deadlock(self.name(at)));
        late.into_iter().chain(unsafe_at).chain(stuck).collect()
    }

    /// The answer that the mission demands to an event in a place: where to, and what is said.
    fn demanded(
        &self,
        at: usize,
        event: EventId,
        kinds: &[Does],
    ) -> Option<(usize, Vec<OutputId>)> {
        let [before @ .., security, safe] = self.walk else { return None };
        if at == *security {
            return (event == STOPPED).then(|| (*safe, WARN.to_vec()));
        }
        let step = before.iter().position(|&place| place == at)?;
        if event == GLOBAL_EVENT {
            return Some((*security, HALT.to_vec()));
        }
        let next = *before.get(step + 1)?;
        let own =
            step.checked_sub(1).map_or(MISSION_RECEIVED, |objective| ends_with(kinds[objective]));
        let drives = kinds.get(step) == Some(&Does::Drive);
        (event == own).then(|| (next, drives.then_some(START_DRIVE).into_iter().collect()))
    }

    fn answers(&self, at: usize, kinds: &[Does], faults: &mut Vec<Fault>) {
        let here: Vec<_> = self.graph.firings.iter().filter(|(from, ..)| *from == at).collect();
        for (event, signal) in self.net.events.iter().enumerate().filter(|_| self.graph.reached[at])
        {
            let event_id = EventId(event as u32);
            let on = |transition: &Transition<'_>| transition.on == Some(event_id);
            let mut found = here.iter().filter(|firing| on(&self.net.transitions[firing.2]));
            let (first, second) = (found.next(), found.next());
            let (at_name, event_name) = (self.name(at), signal.name.to_owned());
            if second.is_some() {
                faults.push(Fault::Ambiguous { at: at_name, event: event_name });
                continue;
            }
            let demanded = self.demanded(at, event_id, kinds);
            let (leads, should) = (first.map(|firing| firing.1), demanded.as_ref().map(|it| it.0));
            let purpose = |it: &Ignored<'_>| {
                it.event == event_id && it.place.0 as usize == at && it.guard.is_empty()
            };
            let forgotten = event_id == GLOBAL_EVENT
                && should.is_none()
                && !self.net.ignored.iter().any(purpose);
            if leads != should || forgotten {
                let [found, expected] =
                    [leads, should].map(|place| place.map(|place| self.name(place)));
                faults.push(Fault::Answer { at: at_name, event: event_name, found, expected });
            } else if let (Some(&&(_, _, transition)), Some((_, says))) = (first, demanded)
                && self.net.transitions[transition].emits != says
            {
                let name = |output: OutputId| {
                    self.net.outputs.get(output.0 as usize).map(|it| it.name.to_owned())
                };
                let expected = says.into_iter().filter_map(name).collect();
                let transition = self.net.transitions[transition].name.to_owned();
                faults.push(Fault::Says { transition, expected });
            }
        }
    }

    /// Every transition waits for an event and moves one token, at any time.
    fn plain(&self, faults: &mut Vec<Fault>) {
        let single = |arcs: &[Arc]| matches!(arcs, [Arc { weight: 1, .. }]);
        let plain = |it: &Transition<'_>| {
            it.on.is_some()
                && single(it.take)
                && single(it.give)
                && it.read.is_empty()
                && it.within.is_none()
        };
        let others = self.net.transitions.iter().filter(|it| !plain(it));
        faults.extend(others.map(|it| Fault::NotPlain(it.name.to_owned())));
    }
}
