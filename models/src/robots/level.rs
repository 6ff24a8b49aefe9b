//! The supervisors of a robot at work: what they are told, and where they are.

use super::supervisors::{Step, begins, lost, place_of, word};
use super::{Mode, Robot, Where, members};
use crate::cotama::Cause;
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::{Observer, Player, Program};
use cotama_core::system::{Of, System};
use cotama_core::units::Millis;

/// Something that the supervisors are told from outside; one in a round keeps the runs those that
/// were checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Told {
    /// The mission begins; of a robot without one, a drive.
    Begins,
    /// The task for which the robot stands in an objective, by its number, is done.
    Over(usize),
    /// The robot stands, after the mission was ended.
    Stopped,
    /// A sub-objective, by its number, is reached.
    Reached(usize),
    /// A [report](super::Report), by its number.
    Report(usize),
    /// Parts that a [loss](super::Loss), by its number, took work again.
    Back(usize),
    /// The operator chooses one of his sub-objectives, by its number.
    Chooses(usize),
    /// The operator is done with one of his sub-objectives, by its number.
    Done(usize),
    /// The operator gives up, or is silent for too long.
    GivesUp,
}

/// The place of the global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Global {
    /// No mission yet, or no drive.
    Waits,
    /// An objective, by its number, is under way; the drive of a robot without a mission is 0.
    Does(usize),
    /// The mission is accomplished.
    Done,
    /// The mission is ended, the robot still moves.
    Secures,
    /// The mission is ended, the robot stands.
    Safe,
}

/// Numbers of the parts of the supervisors, found by their names once.
#[derive(Clone, Debug)]
struct Numbers {
    global: Vec<(Of<PlaceId>, Global)>,
    waits: Option<Of<PlaceId>>,
    sub_objectives: Vec<Option<Of<PlaceId>>>,
    configurations: Vec<Option<Of<PlaceId>>>,
    losses: Vec<Option<Of<PlaceId>>>,
    granted: Option<Of<PlaceId>>,
    destroyed: Option<Of<PlaceId>>,
}

/// The supervisors of a robot in a mission, running: a player of
/// [`of_mission`](super::supervisors::of_mission).
#[derive(Clone, Debug)]
pub struct Level<'r, P, const W: usize, const C: usize, const S: usize> {
    robot: &'r Robot,
    steps: Vec<Step>,
    numbers: Numbers,
    player: Player<P, W, C, S, Cause>,
}

impl<'r, P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>
    Level<'r, P, W, C, S>
{
    /// The supervisors of a robot at rest, with the objectives of its mission.
    pub fn start(robot: &'r Robot, steps: Vec<Step>, program: P) -> Self {
        let numbers = Numbers::of(robot, &steps, &program.system());
        Self { robot, steps, numbers, player: Player::start(program, Millis(0), &mut ()) }
    }

    /// One round: each supervisor takes its turn.
    pub fn round(&mut self, now: Millis, observer: &mut impl Observer<P, Cause>) {
        let _ = self.player.round_with(now, observer);
    }

    /// Tells the supervisors something; whether it was accepted.
    pub fn tell(
        &mut self,
        now: Millis,
        told: Told,
        cause: Cause,
        observer: &mut impl Observer<P, Cause>,
    ) -> bool {
        let Some(event) = self.event(told) else { return false };
        self.player.offer_id(now, event, cause, observer).fired()
    }

    /// Returns the name of an event as traces have it, for example `faults.fail_LID1`.
    pub fn name_of(&self, told: Told) -> String {
        let (net, event) = named(self.robot, &self.steps, told);
        format!("{net}.{event}")
    }

    fn event(&self, told: Told) -> Option<Of<EventId>> {
        let (net, event) = named(self.robot, &self.steps, told);
        let system = self.player.program().system();
        let component = system.components.iter().position(|it| it.name == net)?;
        let events = system.components.get(component)?.net.events;
        let id = events.iter().position(|it| it.name == event)?;
        Some(Of { component: component as u16, id: EventId(id as u32) })
    }

    /// Returns the place of the robot in its drive.
    pub fn place(&self) -> Where {
        if self.is_marked(self.numbers.waits) {
            return Where::Waits;
        }
        let all = self.numbers.sub_objectives.iter();
        let Some(sub_objective) = all.clone().position(|it| self.is_marked(*it)) else {
            return Where::Rests;
        };
        let of = self.robot.sub_objectives.get(sub_objective);
        let mut runs = of.into_iter().flat_map(|it| it.configurations.iter().copied());
        let marked = |it: &usize| {
            let place = self.numbers.configurations.get(*it).copied().flatten();
            place.is_none_or(|_| self.is_marked(place))
        };
        match runs.find(marked) {
            Some(configuration) => Where::Runs { sub_objective, configuration },
            None => Where::Rests,
        }
    }

    /// Returns the place of the global supervisor.
    pub fn global(&self) -> Global {
        let mut all = self.numbers.global.iter();
        all.find(|it| self.is_marked(Some(it.0))).map_or(Global::Waits, |it| it.1)
    }

    /// Returns the losses that the supervisors know, a bit each.
    pub fn lost(&self) -> u32 {
        let all = self.numbers.losses.iter().enumerate();
        all.filter(|it| self.is_marked(*it.1)).fold(0, |set, it| set | 1 << it.0)
    }

    /// Whether the robot may move.
    pub fn permits(&self) -> bool {
        self.is_marked(self.numbers.granted)
    }

    /// Whether motion has ended for good.
    pub fn is_halted(&self) -> bool {
        self.is_marked(self.numbers.destroyed)
    }

    /// Returns the names of a net and of one of its transitions, with the state it leads to and
    /// its outputs.
    pub fn fired(&self, id: Of<TransitionId>) -> Option<Fired<'_>> {
        let system = self.player.program().system();
        let component = system.components.get(usize::from(id.component))?;
        let net = component.net;
        let transition = net.transitions.get(id.id.0 as usize)?;
        let mut given = transition.give.iter().filter_map(|it| net.places.get(it.place.0 as usize));
        let is_state = |it: &&cotama_core::net::Place<'_>| it.role == cotama_core::net::Role::State;
        let place = given.find(is_state).map_or("", |it| it.name);
        let outputs = transition.emits.iter().filter_map(|it| net.outputs.get(it.0 as usize));
        let outputs: Vec<_> = outputs.map(|it| it.name).collect();
        let restarted = outputs.iter().find_map(|it| it.strip_prefix("restart_"));
        let named = |it: &super::Module| Some(word(&it.name).as_str()) == restarted;
        let restarts = restarted.and_then(|_| self.robot.modules.iter().position(named));
        let set = outputs.iter().find_map(|it| it.strip_prefix("set_"));
        let reports = || self.robot.losses.reports.iter();
        let sets = set.and_then(|set| reports().position(|it| word(&it.name) == set));
        let tells = outputs.iter().any(|out| reports().any(|it| word(&it.name) == *out));
        let (net, transition) = (component.name, transition.name);
        Some(Fired { net, transition, place, outputs, restarts, sets, tells })
    }

    /// The player under the names.
    pub const fn player(&self) -> &Player<P, W, C, S, Cause> {
        &self.player
    }

    fn is_marked(&self, place: Option<Of<PlaceId>>) -> bool {
        place.is_some_and(|it| self.player.tokens(it) > 0)
    }
}

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
    /// Whether a report is told to the contextual supervisor.
    pub tells: bool,
}

/// The net and the event that something is told by.
fn named(robot: &Robot, steps: &[Step], told: Told) -> (&'static str, String) {
    let of = |it: usize| robot.sub_objectives.get(it).map_or_else(String::new, |it| word(&it.name));
    match told {
        Told::Begins => ("gs", begins(steps).to_owned()),
        Told::Over(it) => {
            let ends = steps.get(it).and_then(|it| it.ends.clone());
            ("gs", ends.unwrap_or_default())
        }
        Told::Stopped => ("gs", "stopped".to_owned()),
        Told::Reached(it) => ("ls", format!("{}_done", of(it))),
        Told::Report(it) => {
            let name = robot.losses.reports.get(it).map_or_else(String::new, |it| word(&it.name));
            ("faults", format!("fail_{name}"))
        }
        Told::Back(it) => {
            let name = robot.losses.losses.get(it).map_or_else(String::new, |it| word(&it.name));
            ("faults", format!("works_{name}"))
        }
        Told::Chooses(it) => ("operator", format!("choose_{}", of(it))),
        Told::Done(it) => ("operator", format!("finish_{}", of(it))),
        Told::GivesUp => ("operator", "gives_up".to_owned()),
    }
}

impl Numbers {
    fn of(robot: &Robot, steps: &[Step], system: &System<'_>) -> Self {
        let place = |name: &str| {
            let (net, place) = name.split_once('.')?;
            let component = system.components.iter().position(|it| it.name == net)?;
            let places = system.components.get(component)?.net.places;
            let id = places.iter().position(|it| it.name == place)?;
            Some(Of { component: component as u16, id: PlaceId(id as u32) })
        };
        let fixed = [
            ("gs.Wait", Global::Waits),
            ("gs.Done", Global::Done),
            ("gs.Security", Global::Secures),
            ("gs.Safe", Global::Safe),
        ];
        let fixed = fixed.map(|it| (it.0.to_owned(), it.1));
        let drive = steps.is_empty().then(|| ("gs.Drive".to_owned(), Global::Does(0)));
        let does = steps.iter().enumerate();
        let does = does.map(|(at, it)| (format!("gs.{}", it.place()), Global::Does(at)));
        let has_adapter = |it: usize| {
            let of = robot.configurations.get(it).map(|it| it.sub_objective);
            let of = of.and_then(|it| robot.sub_objectives.get(it));
            of.is_some_and(|it| it.configurations.len() > 1)
        };
        let all = 0..robot.configurations.len();
        Self {
            global: { fixed.into_iter().chain(drive).chain(does) }
                .filter_map(|it| Some((place(&it.0)?, it.1)))
                .collect(),
            waits: place("ls.Waits"),
            sub_objectives: { robot.sub_objectives.iter() }
                .map(|it| place(&format!("ls.{}", word(&it.name))))
                .collect(),
            configurations: all
                .map(|it| if has_adapter(it) { place(&place_of(robot, it)) } else { None })
                .collect(),
            losses: { 0..robot.losses.losses.len() }
                .map(|it| place(&format!("gom.{}", lost(robot, it))))
                .collect(),
            granted: place("permit.Granted"),
            destroyed: place("permit.Destroyed"),
        }
    }
}

impl Robot {
    /// The sub-objectives of a mode that can be served after these losses, by number.
    pub fn served(&self, mode: Mode, lost: u32) -> impl Iterator<Item = usize> {
        let all = self.sub_objectives.iter().enumerate();
        let all = all.filter(move |it| it.1.mode == mode && self.best(it.0, lost).is_some());
        all.map(|it| it.0)
    }

    /// Returns the losses that these lost parts come to, a bit each.
    pub fn lost(&self, parts: super::Parts) -> u32 {
        let gone = !self.available(parts);
        let all = self.losses.losses.iter().enumerate();
        let all = all.filter(|it| members(it.1.modules).all(|module| gone >> module & 1 == 1));
        all.fold(0, |set, it| set | 1 << it.0)
    }
}
