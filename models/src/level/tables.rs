//! A robot as its decisional level needs it at work: numbers of its supervisors' parts, and facts.

use super::told::Mode;
use crate::severity::{Persistence, Severity};
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::system::Of;
use cotama_core::units::{MillimetresPerSecond, Millis};

/// The most configurations.
pub const MAX_CONFIGURATIONS: usize = 32;
/// The most failures.
pub const MAX_FAILURES: usize = 256;
/// The most flags of all observers together.
pub const MAX_FLAGS: usize = 64;
/// The most losses that make a difference: the supervisors remember each.
pub const MAX_LOSSES: usize = 10;
/// The most reports that differ.
pub const MAX_REPORTS: usize = 64;
/// The most reports that mask flags.
pub const MAX_MASKS: usize = 8;

/// A robot with the objectives of its mission. All is numbered as in the robot's file; events,
/// places and transitions are those of its system of supervisors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tables<'t> {
    /// The event with which the mission begins.
    pub begins: Of<EventId>,
    /// The event that says that the robot stands after the mission was ended.
    pub stopped: Of<EventId>,
    /// The event by which the operator gives up; `None` without an operator.
    pub gives_up: Option<Of<EventId>>,
    /// The place of the global supervisor before the mission.
    pub before: Of<PlaceId>,
    /// Place of the global supervisor when all is done; `None` without a mission.
    pub done: Option<Of<PlaceId>>,
    /// Place of the global supervisor while the robot is made safe.
    pub secures: Of<PlaceId>,
    /// Place of the global supervisor when the robot is safe.
    pub safe: Of<PlaceId>,
    /// The place of the local supervisor in which it waits for the operator.
    pub waits: Of<PlaceId>,
    /// The place of a permit to move.
    pub granted: Of<PlaceId>,
    /// The place after which there is no permit any more.
    pub destroyed: Of<PlaceId>,
    /// The objectives in their order; of a robot without a mission its one drive.
    pub steps: &'t [Step],
    /// The sub-objectives.
    pub sub_objectives: &'t [SubObjective],
    /// The configurations.
    pub configurations: &'t [Configuration],
    /// The losses that differ.
    pub losses: &'t [Loss],
    /// The reports that differ.
    pub reports: &'t [Report],
    /// The failures.
    pub failures: &'t [Failure],
    /// The masks.
    pub masks: &'t [Mask],
    /// The transitions that ask for a reaction outside of the supervisors, in the order of their
    /// nets and numbers; one may ask for several.
    pub acting: &'t [Acting],
}

/// An objective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The place of the global supervisor.
    pub place: Of<PlaceId>,
    /// The event that ends it where the robot stands for it; `None` for a drive.
    pub over: Option<Of<EventId>>,
}

/// A sub-objective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubObjective {
    /// The place of the local supervisor.
    pub place: Of<PlaceId>,
    /// Decider of motion in it.
    pub mode: Mode,
    /// Whether the robot may move in it.
    pub moves: bool,
    /// The event that says that it is reached.
    pub reached: Of<EventId>,
    /// The events by which the operator chooses it and is done with it; `None` where it is not his.
    pub operator: Option<[Of<EventId>; 2]>,
}

/// A configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Configuration {
    /// The place of its adapter; `None` where its sub-objective has no other one.
    pub place: Option<Of<PlaceId>>,
    /// The sub-objective that it serves.
    pub sub_objective: u8,
    /// The fastest that the robot may go with it.
    pub speed: MillimetresPerSecond,
}

/// A loss that stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loss {
    /// The place that is marked where it is known.
    pub place: Of<PlaceId>,
    /// The modules that cannot be used any more, a bit each.
    pub modules: u64,
    /// The event that ends it; `None` where it does not come back.
    pub back: Option<Of<EventId>>,
}

/// A report of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Report {
    /// The event by which it is told.
    pub event: Of<EventId>,
    /// The setting that answers it.
    pub sets: Option<Setting>,
}

/// A setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The part of the speed that it leaves, in thousandths.
    pub speed: u16,
    /// The mode in which it leaves less of the speed; `None` for both.
    pub mode: Option<Mode>,
    /// The time by which it outlasts the failure.
    pub holds: Millis,
    /// Whether the failure is over by it.
    pub mends: bool,
}

/// A failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The flags that always show it, a bit each.
    pub flags: u64,
    /// The flags that show it at times, a bit each.
    pub sometimes: u64,
    /// The report of it.
    pub report: u8,
    /// Severity at worst.
    pub worst: Severity,
    /// Duration.
    pub persistence: Persistence,
}

/// A mask: flags that are not diagnosed while it holds, since what they show is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mask {
    /// The report that makes it.
    pub report: u8,
    /// The loss that comes with it, which does not come back while the mask holds: nobody would
    /// see it go again.
    pub loss: Option<u8>,
    /// The flags, a bit each.
    pub flags: u64,
    /// How long it holds; `None` to the end.
    pub lasts: Option<Millis>,
    /// Whether it is made when the operator, who was asked, chooses to go on.
    pub on_order: bool,
}

/// A transition that asks for a reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Acting {
    /// The transition.
    pub transition: Of<TransitionId>,
    /// The reaction.
    pub act: Act,
}

/// A reaction outside of the supervisors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// A module, by its number, is started anew.
    Restart(u8),
    /// The setting of a report, by its number, is made.
    Set(u8),
    /// The operator is asked first for a report, by its number.
    Ask(u8),
    /// A mask, by its number, is made, or waits for the operator's order.
    Hide(u8),
}

/// Returns an event of a net by its numbers.
pub const fn event(component: u16, id: u32) -> Of<EventId> {
    Of { component, id: EventId(id) }
}

/// Returns a place of a net by its numbers.
pub const fn place(component: u16, id: u32) -> Of<PlaceId> {
    Of { component, id: PlaceId(id) }
}

/// Returns a transition of a net by its numbers.
pub const fn transition(component: u16, id: u32) -> Of<TransitionId> {
    Of { component, id: TransitionId(id) }
}

impl Tables<'_> {
    /// Returns the decider of motion where the robot is; `None` where nothing runs.
    pub fn mode(&self, at: super::Where) -> Option<Mode> {
        self.sub_objectives.get(at.sub_objective()?).map(|it| it.mode)
    }

    /// Returns the reactions that a transition asks for.
    pub fn acts(&self, transition: Of<TransitionId>) -> impl Iterator<Item = Act> {
        let key = |it: Of<TransitionId>| (it.component, it.id.0);
        let first = self.acting.partition_point(|it| key(it.transition) < key(transition));
        let all = self.acting.get(first..).unwrap_or_default().iter();
        all.take_while(move |it| it.transition == transition).map(|it| it.act)
    }

    /// Returns the losses of which a module does not work, a bit each.
    pub fn broken(&self, works: u64) -> u32 {
        let is = |it: &usize| self.losses.get(*it).is_some_and(|it| it.modules & !works != 0);
        super::sets::losses_of((0..MAX_LOSSES).filter(is))
    }

    /// Returns the reports, a bit each, of failures all of whose flags are up.
    pub fn shown(&self, up: u64) -> u64 {
        let is = |it: &&Failure| usize::from(it.report) < MAX_REPORTS && it.flags & !up == 0;
        let all = self.failures.iter().filter(|it| it.flags != 0).filter(is);
        all.fold(0, |set, it| set | 1 << it.report)
    }

    /// Returns the event by which something is told; `None` for something that this robot has not.
    pub fn event(&self, told: super::Told) -> Option<Of<EventId>> {
        use super::Told::{Back, Begins, Chooses, Done, GivesUp, Over, Reached, Report, Stopped};
        let operator = |it: usize| self.sub_objectives.get(it)?.operator;
        match told {
            Begins => Some(self.begins),
            Stopped => Some(self.stopped),
            GivesUp => self.gives_up,
            Over(it) => self.steps.get(it)?.over,
            Reached(it) => self.sub_objectives.get(it).map(|it| it.reached),
            Report(it) => self.reports.get(it).map(|it| it.event),
            Back(it) => self.losses.get(it)?.back,
            Chooses(it) => operator(it).map(|[chooses, _]| chooses),
            Done(it) => operator(it).map(|[_, done]| done),
        }
    }
}
