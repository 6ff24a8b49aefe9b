//! The decisional level with names in place of numbers: what the robot tells it, and what it
//! decided.

use super::decisions::{Loss, Losses, Situation};
use super::modules::{Health, Module, Modules};
use super::supervisors::{
    delivery, faults, global, local, operator, path_following, permit, recovering,
    recovering_faults,
};
pub use crate::level::Cause;
use core::marker::PhantomData;
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::player::{
    Checked, Kind, Observer, Outcome, Player, Program, RestoreError, Round, Snapshot,
};
use cotama_core::system::Of;
use cotama_core::units::Millis;

/// The event of a global supervisor made from a mission in which the robot waits, behind those of
/// [`global`].
pub(crate) const WAIT_OVER: EventId = EventId(global::NET.events.len() as u32);

/// A function that returns, as far as the supervisors tell it apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Return {
    /// The sonars.
    Sonar,
    /// The operator's avoidance.
    Avoidance,
    /// Localisation by particles.
    Mcl,
}

impl Return {
    /// All, in the order of the supervisors' events.
    pub const ALL: [Self; 3] = [Self::Sonar, Self::Avoidance, Self::Mcl];

    /// The loss that it ends.
    pub const fn loss(self) -> Loss {
        match self {
            Self::Sonar => Loss::Sonar,
            Self::Avoidance => Loss::Avoidance,
            Self::Mcl => Loss::Mcl,
        }
    }

    const fn event(self) -> recovering_faults::Event {
        match self {
            Self::Sonar => recovering_faults::Event::regain_sonar,
            Self::Avoidance => recovering_faults::Event::regain_avoidance,
            Self::Mcl => recovering_faults::Event::regain_mcl,
        }
    }

    /// Whether it works with these modules.
    ///
    /// ```
    /// use cotama_models::cotama::{Modules, Resource, Resources, Return, available};
    /// let without_sonars = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    /// assert!(Return::ALL.iter().all(|it| it.works(Modules::ALL) && !it.works(without_sonars)));
    /// ```
    pub const fn works(self, available: Modules) -> bool {
        match self {
            Self::Sonar => available.has(Module::Ust),
            Self::Avoidance => available.has(Module::Dvz),
            Self::Mcl => available.has(Module::Mcl),
        }
    }
}

/// An event that the level accepts. Each is an event that no supervisor causes; one a round keeps
/// the runs those that were checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// The mission, or what becomes of it.
    Mission(global::Event),
    /// The time to wait is over: only of missions in which the robot waits, whose global supervisor
    /// is made from their file.
    WaitOver,
    /// News of a drive: a path is there, the goal is reached.
    Drive(local::Event),
    /// A failure was diagnosed.
    Failure(faults::Event),
    /// The operator says something.
    Operator(operator::Event),
    /// A module has returned: only of the supervisors of [`recovering`](recovering::SYSTEM).
    Return(Return),
}

impl Told {
    /// How a loss is told when this is diagnosed. A camera that works as far as is known, and that
    /// nobody watches, is told as the loss of its watch.
    ///
    /// ```
    /// use cotama_models::cotama::{Health, Loss, Module, Modules, Told, faults};
    /// let crashed = |it| Health { faulty: Modules::of(&[it]), ..Health::SOUND };
    /// let told = |it| Told::lost(Loss::Camera, crashed(it));
    /// assert_eq!(told(Module::Cam), Told::Failure(faults::Event::lose_camera));
    /// assert_eq!(told(Module::OSen), Told::Failure(faults::Event::lose_watch));
    /// ```
    pub const fn lost(loss: Loss, known: Health) -> Self {
        Self::Failure(match loss {
            Loss::Avoidance => faults::Event::lose_avoidance,
            Loss::Smz => faults::Event::lose_smz,
            Loss::Mcl => faults::Event::lose_mcl,
            Loss::Sonar => faults::Event::lose_sonar,
            Loss::Camera if known.available().has(Module::Cam) => faults::Event::lose_watch,
            Loss::Camera => faults::Event::lose_camera,
            Loss::Wifi => faults::Event::lose_wifi,
            Loss::Vital => faults::Event::lose_vital,
        })
    }

    /// Returns the event in [`delivery`](delivery::SYSTEM).
    pub fn event(&self) -> Of<EventId> {
        match *self {
            Self::Mission(event) => delivery::Event::gs(event).id(),
            Self::WaitOver => {
                let mission = delivery::Event::gs(global::Event::stopped).id();
                Of { id: WAIT_OVER, ..mission }
            }
            Self::Drive(event) => delivery::Event::ls(event).id(),
            Self::Failure(event) => delivery::Event::faults(event).id(),
            Self::Operator(event) => delivery::Event::operator(event).id(),
            Self::Return(module) => recovering::Event::faults(module.event()).id(),
        }
    }
}

/// The right to move: commands of motion ask for it, and only a level whose activity moves the
/// robot lends it. It cannot outlive the next event, since it borrows the level.
///
/// ```compile_fail,E0502
/// use cotama_core::units::Millis;
/// use cotama_models::cotama::DecisionalLevel;
///
/// let mut level = DecisionalLevel::default();
/// let permit = level.permit();
/// let _ = level.round(Millis(100), &mut ()); // whatever happens now may end the activity
/// drop(permit);
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Permit<'l>(PhantomData<&'l ()>);

/// The supervisors of a mission, running. `P` is the packed system: that of
/// [`delivery`](delivery::SYSTEM), or one with the global supervisor of another mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level<P, const W: usize, const C: usize, const S: usize>(Player<P, W, C, S, Cause>);

/// The supervisors of the embedded mission.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::cotama::{Cause, DecisionalLevel, Losses, Told, global, local};
///
/// let mut level = DecisionalLevel::default();
/// assert!(level.permit().is_none());
/// let mission = Told::Mission(global::Event::mission_received);
/// let _ = level.tell(Millis(0), mission, Cause(0), &mut ());
/// let _ = level.round(Millis(100), &mut ()); // the drive starts: a path is planned
/// let _ = level.tell(Millis(100), Told::Drive(local::Event::path_ready), Cause(0), &mut ());
/// assert_eq!(level.situation(Losses::NONE).local, local::State::Following);
/// assert!(level.permit().is_some());
/// ```
pub type DecisionalLevel = Level<
    delivery::Program,
    { delivery::SIZE.words },
    { delivery::SIZE.clocks },
    { delivery::SIZE.slots },
>;

impl Default for DecisionalLevel {
    fn default() -> Self {
        Self(delivery::Carrying::new())
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Level<P, W, C, S> {
    /// The supervisors of a packed system whose components are those of
    /// [`delivery`](delivery::SYSTEM) or [`recovering`](recovering::SYSTEM), in their order.
    pub fn start(program: P) -> Self {
        Self(Player::start(program, Millis(0), &mut ()))
    }

    /// Tells it something.
    pub fn tell(
        &mut self,
        now: Millis,
        told: Told,
        cause: Cause,
        observer: &mut impl Observer<P, Cause>,
    ) -> Outcome<Of<TransitionId>> {
        self.0.offer_id(now, told.event(), cause, observer)
    }

    /// One round: each supervisor takes its turn.
    pub fn round(&mut self, now: Millis, observer: &mut impl Observer<P, Cause>) -> Round {
        self.0.round_with(now, observer)
    }

    /// The right to move, if an activity runs that moves the robot.
    pub fn permit(&self) -> Option<Permit<'_>> {
        let granted = self.0.tokens(delivery::Place::permit(permit::Place::Granted)) > 0;
        granted.then_some(Permit(PhantomData))
    }

    /// Whether motion has ended for good.
    pub fn halted(&self) -> bool {
        self.0.tokens(delivery::Place::permit(permit::Place::Destroyed)) > 0
    }

    /// The place of the global supervisor, by its number in that net.
    pub fn global(&self) -> PlaceId {
        let first = Of::<PlaceId>::from(delivery::Place::gs(global::Place::Wait));
        let places = (0..u32::from(u8::MAX)).map(PlaceId);
        let mut marked = places.filter(|&id| self.0.tokens(Of { id, ..first }) > 0);
        marked.next().unwrap_or(PlaceId(0))
    }

    /// Returns the situation of the supervisors of a drive, with these losses.
    pub fn situation(&self, lost: Losses) -> Situation {
        let local = delivery::state::ls(&self.0);
        let following = delivery::state::pf(&self.0);
        let teleoperation = delivery::state::to(&self.0);
        let level = self.0.tokens(delivery::Place::pf(path_following::Place::level)) as u8;
        Situation { local, following, teleoperation, level, lost }
    }

    /// The names of a net of its system and of one of that net's transitions.
    ///
    /// ```
    /// use cotama_core::{net::TransitionId, system::Of, units::Millis};
    /// use cotama_models::cotama::{DecisionalLevel, Level, recovering};
    /// let first = |component| Of { component, id: TransitionId(0) };
    /// let level = DecisionalLevel::default();
    /// assert_eq!(level.named(first(0)), Some(("gs", "g1")));
    /// assert_eq!(level.named(first(99)), None);
    /// // Each level knows its own system: that of recovery has other transitions.
    /// let recovers = Level::start(recovering::Program);
    /// for (component, it) in (0..).zip(recovering::SYSTEM.components) {
    ///     for (id, transition) in (0..).zip(it.net.transitions) {
    ///         let at = Of { component, id: TransitionId(id) };
    ///         assert_eq!(recovers.named(at), Some((it.name, transition.name)));
    ///     }
    /// }
    /// ```
    pub fn named(&self, transition: Of<TransitionId>) -> Option<(&str, &str)> {
        let system = self.0.program().system();
        let component = system.components.get(usize::from(transition.component))?;
        let transition = component.net.transitions.get(transition.id.0 as usize)?;
        Some((component.name, transition.name))
    }

    /// The player under the names.
    pub fn player(&self) -> &Player<P, W, C, S, Cause> {
        &self.0
    }

    /// Returns the state of the supervisors, to be stored before the power goes.
    pub fn snapshot(&self) -> Snapshot<W, C, S, Cause> {
        self.0.snapshot()
    }
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>
    Level<Checked<P>, W, C, S>
{
    /// Supervisors that go on at `now` where stored ones were.
    ///
    /// ```
    /// use cotama_core::{player::Checked, units::Millis};
    /// use cotama_models::cotama::{Cause, Level, Told, delivery, global};
    /// let start = || Level::start(Checked(delivery::Program));
    /// let mut level = start();
    /// let mission = Told::Mission(global::Event::mission_received);
    /// assert!(level.tell(Millis(0), mission, Cause(0), &mut ()).fired());
    /// let stored = level.snapshot();
    /// // The power was away.
    /// let restored = Level::restore(Checked(delivery::Program), Millis(0), &stored).unwrap();
    /// assert_eq!(restored, level);
    /// assert_ne!(restored, start());
    /// ```
    ///
    /// # Errors
    /// As [`Player::restore`]: what is stored is of other supervisors, or cannot be.
    pub fn restore(
        program: Checked<P>,
        now: Millis,
        from: &Snapshot<W, C, S, Cause>,
    ) -> Result<Self, RestoreError> {
        Player::restore(program, now, from).map(Self)
    }
}
