//! Properties in the language of `cotama check`, held against a run while it goes on.
//!
//! A checker looks at every run, a monitor at one, round by round: so what can be watched is what
//! a run can break at some time. That is `AG` of something about one marking, and `AG (asked ->
//! AF<=500ms done)`, an answer in time; and several of these, joined by `&`.

use cotama_core::net::owned::{OwnedNet, OwnedPlace};
use cotama_core::net::{EventId, PlaceId, Role};
use cotama_core::player::{Player, Program};
use cotama_core::system::{Delivery, Of, System};
use cotama_core::units::Millis;
use cotama_models::level::Cause;
use cotama_property::pt::Pt;
use cotama_property::{self as property, Condition, Formula, Marking, PropertyError, Question};
use std::fmt;

/// A property of the supervisors, made to be watched.
///
/// Places are called as in `cotama check delivery`: `ls.Following` is a place of the local
/// supervisor, `gs.global_event.waiting` what waits in a mailbox of the global one. They are looked
/// at when a round has ended.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::robots::{Driven, Script};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let driven = Driven::new(&mission).unwrap();
/// let idle = driven.monitor("AG (gs.Receive -> ls.Idle)").unwrap();
/// // The drive to B follows on, so this one is wrong.
/// let ends = driven.monitor("AG (gs.DriveA -> AF<=60s gs.Done)").unwrap();
/// let run = driven.with_monitors(vec![idle, ends]).run(&Script::default()).unwrap();
/// let violation = run.violated.unwrap();
/// assert_eq!((violation.monitor, violation.at.0), (1, 60_100));
/// ```
#[derive(Clone, Debug)]
pub struct Monitor {
    text: String,
    parts: Vec<Part>,
    slots: Vec<Slot>,
}

#[derive(Clone, Debug)]
enum Part {
    Always(Condition<'static>),
    /// The condition is answered within a time.
    Answer {
        begins: Condition<'static>,
        ends: Condition<'static>,
        within: Millis,
    },
}

/// The location of a place's tokens.
#[derive(Clone, Copy, Debug)]
enum Slot {
    /// Between two rounds.
    Round,
    Place(Of<PlaceId>),
    Mail(Of<EventId>),
}

/// Why a text is no [`Monitor`].
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::robots::{Driven, Unmonitored};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let driven = Driven::new(&mission).unwrap();
/// let refused = |text| driven.monitor(text).unwrap_err();
/// // Whether something can happen is no question to one run.
/// assert_eq!(refused("AG EF gs.Done"), Unmonitored::NotOnLine);
/// let help = "there is no place `gs.Don`\n  help: did you mean `gs.Done`?";
/// assert!(refused("AG !gs.Don").to_string().ends_with(help));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Unmonitored {
    /// The text cannot be read, or names parts that do not exist.
    Unreadable(Box<PropertyError>),
    /// A single run does not break it at some time.
    NotOnLine,
}

impl fmt::Display for Unmonitored {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(error) => error.fmt(f),
            Self::NotOnLine => f.write_str(
                "this cannot be watched while a mission runs: `AG` of what is marked can, `AG (p \
                 -> AF<=500ms q)`, and several of these joined by `&`",
            ),
        }
    }
}

impl std::error::Error for Unmonitored {}

/// A property that a run broke: its witness.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::robots::{Driven, Script};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let driven = Driven::new(&mission).unwrap();
/// let never = driven.monitor("AG !gs.Deliver").unwrap();
/// let run = driven.with_monitors(vec![never]).run(&Script::default()).unwrap();
/// assert!(run.violated.unwrap().fired.contains(&"gs.g4".to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Time of the violation.
    pub at: Millis,
    /// Which of the run's monitors, from 0.
    pub monitor: usize,
    /// The last firings, in one round, as `ls.l5`, in their order.
    pub fired: Vec<String>,
}

impl Monitor {
    /// A property of these supervisors.
    pub(crate) fn new(text: &str, system: &System<'_>) -> Result<Self, Unmonitored> {
        let (names, slots) = places(system);
        let property =
            property::parse(text, &names).map_err(|error| Unmonitored::Unreadable(error.into()))?;
        let Question::Formula(formula) = property.question else {
            return Err(Unmonitored::NotOnLine);
        };
        let parts = parts(&formula).ok_or(Unmonitored::NotOnLine)?;
        Ok(Self { text: property.name, parts, slots })
    }

    /// Returns the text.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// The places of a system by their names, as a net without transitions, and where each is.
fn places(system: &System<'_>) -> (Pt, Vec<Slot>) {
    let mut net = OwnedNet::new(system.name, "");
    let mut slots = Vec::new();
    let mut add = |name: &str, slot: Slot| {
        // No two places of a system have one name.
        if net.place(OwnedPlace::new(name, 0)).is_ok() {
            slots.push(slot);
        }
    };
    add("round", Slot::Round);
    for (it, component) in system.components.iter().zip(0..) {
        let own = |role: Role| matches!(role, Role::Complement(_) | Role::Shared);
        for (place, id) in it.net.places.iter().zip(0..).filter(|it| !own(it.0.role)) {
            let of = Of { component, id: PlaceId(id) };
            add(&format!("{}.{}", it.name, place.name), Slot::Place(of));
        }
        for (event, id) in it.net.events.iter().zip(0..) {
            let of = Of { component, id: EventId(id) };
            if matches!(system.delivery(of), Some(Delivery::Mail { .. })) {
                add(&format!("{}.{}.waiting", it.name, event.name), Slot::Mail(of));
            }
        }
    }
    (Pt::from(&net.view().net()), slots)
}

/// Returns the parts to be watched for a formula; `None` if they are not all of it.
fn parts(formula: &Formula) -> Option<Vec<Part>> {
    match formula {
        Formula::And(all) => {
            let all: Option<Vec<_>> = all.iter().map(parts).collect();
            Some(all?.into_iter().flatten().collect())
        }
        Formula::All(path) => match &**path {
            Formula::Globally(always) => always_parts(always),
            _ => None,
        },
        _ => None,
    }
}

/// The same for what is always to hold.
fn always_parts(formula: &Formula) -> Option<Vec<Part>> {
    if let Some(it) = Condition::of_tokens(formula) {
        return Some(vec![Part::Always(it)]);
    }
    match formula {
        Formula::And(all) => {
            let all: Option<Vec<_>> = all.iter().map(always_parts).collect();
            Some(all?.into_iter().flatten().collect())
        }
        Formula::Or(all) => {
            let (states, answers): (Vec<_>, Vec<_>) =
                all.iter().cloned().partition(Formula::is_state);
            let [Formula::All(answer)] = answers.as_slice() else { return None };
            let Formula::Within(ms, goal) = &**answer else { return None };
            let begins = Condition::of_tokens(&Formula::Not(Formula::Or(states).into()))?;
            let ends = Condition::of_tokens(goal)?;
            Some(vec![Part::Answer { begins, ends, within: Millis(*ms) }])
        }
        Formula::All(path) => match &**path {
            Formula::Within(..) => always_parts(&Formula::Or(vec![formula.clone()])),
            _ => None,
        },
        _ => None,
    }
}

/// The marking of supervisors, by the names of a monitor.
struct Seen<'s, P, const W: usize, const C: usize, const S: usize> {
    player: &'s Player<P, W, C, S, Cause>,
    slots: &'s [Slot],
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Marking
    for Seen<'_, P, W, C, S>
{
    fn tokens(&self, place: PlaceId) -> u64 {
        match self.slots.get(place.0 as usize) {
            Some(Slot::Place(it)) => u64::from(self.player.tokens(*it)),
            Some(Slot::Mail(it)) => u64::from(self.player.waiting(it)),
            Some(Slot::Round) => 1,
            None => 0,
        }
    }
}

/// Monitors at work: since when the answers that each of them waits for are due.
#[derive(Clone, Debug)]
pub(crate) struct Watching<'m> {
    monitors: &'m [Monitor],
    since: Vec<Option<Millis>>,
}

impl<'m> Watching<'m> {
    pub(crate) fn new(monitors: &'m [Monitor]) -> Self {
        let parts = monitors.iter().map(|it| it.parts.len()).sum();
        Self { monitors, since: vec![None; parts] }
    }

    /// A round has ended: the first monitor that is broken, if one is.
    pub(crate) fn look<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
        &mut self,
        now: Millis,
        player: &Player<P, W, C, S, Cause>,
    ) -> Option<usize> {
        let mut since = self.since.iter_mut();
        let mut broken = None;
        for (number, monitor) in self.monitors.iter().enumerate() {
            let seen = Seen { player, slots: &monitor.slots };
            for (part, since) in monitor.parts.iter().zip(&mut since) {
                let holds = match part {
                    Part::Always(it) => it.holds(&seen),
                    Part::Answer { begins, ends, within } => {
                        if ends.holds(&seen) {
                            *since = None;
                        } else if since.is_none() && begins.holds(&seen) {
                            *since = Some(now);
                        }
                        since.is_none_or(|it| now.0 - it.0 <= within.0)
                    }
                };
                if !holds {
                    broken = broken.or(Some(number));
                }
            }
        }
        broken
    }

    /// From when on an answer is late, if nothing changes.
    pub(crate) fn late_at(&self) -> Option<Millis> {
        let parts = self.monitors.iter().flat_map(|it| &it.parts);
        let late = parts.zip(&self.since).filter_map(|(part, since)| match part {
            Part::Answer { within, .. } => Some(Millis((*since)?.0 + within.0 + 1)),
            Part::Always(_) => None,
        });
        late.min()
    }
}
