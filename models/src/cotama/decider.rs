//! From flags to requests: the whole decisional level as one component, which the simulator and a
//! microcontroller run alike.
//!
//! Data goes in (flags, what works, where the robot is, what it is told, time) and requests come
//! out. In each period, in this order:
//!
//! 1. [`Decider::perceive`]: flags are diagnosed (Durand et al., TAROS 2010, Section V.A), a
//!    diagnosis is judged (Sections III.C and V.B), what is lost is planned around, margins are
//!    watched (Lambert et al. 2024, Section 7.3), and what has returned is used again;
//! 2. [`Decider::round`]: the supervisors take a round and are then told *one* thing, the oldest
//!    report first, else what the mission or the operator has to say. So a run is a run of the
//!    system that was checked: [`Told`] is its alphabet;
//! 3. [`Decider::requests`]: what the scheduler and the robot are to do now.
//!
//! It sees flags alone, never what has failed. It has no heap, and what waits in it is bounded.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::cotama::{
//!     Body, Configuration, Decider, Flag, Flags, Modules, NoPlans, Perceived, Word, delivery,
//! };
//!
//! let mut decider = Decider::start(delivery::Program, 4, None);
//! let (body, sound) = (Body { at_goal: false, stands: true }, Perceived::nothing(Modules::ALL));
//! let mut step = |now: u64, seen: Perceived, said: Option<Word>| {
//!     let found = decider.perceive(Millis(now), seen, &mut NoPlans);
//!     let _ = decider.round(Millis(now), said, body, &mut ());
//!     (found, decider.requests())
//! };
//! step(0, sound, Some(Word::MissionReceived));
//! step(100, sound, None);
//! step(200, sound, Some(Word::PathReady));
//! // A sonar shows its largest range for too long: without sonars, no avoidance.
//! let (found, _) = step(300, Perceived { raised: Flags::of(&[Flag::SonarFar]), ..sound }, None);
//! assert!(found.is_some());
//! for now in [400, 500, 600] {
//!     step(now, sound, None);
//! }
//! let (_, requests) = step(700, sound, None);
//! assert_eq!(requests.configuration, Some(Configuration::FollowingDegraded));
//! assert!(requests.drive && !requests.halt);
//! ```

use super::decisions::{Losses, Situation};
use super::dependability::{Adjusted, FailureMode, FailureModes, Flags};
use super::level::{Cause, Level, Permit, Told};
use super::modules::{Configuration, Health, Modules};
use super::supervisors::{delivery, faults, global, local, operator};
use cotama_core::net::PlaceId;
use cotama_core::player::{Observer, Program};
use cotama_core::units::{MillimetresPerSecond, Millis};
pub use findings::{Finding, Judged};
use pending::Pending;
pub use plans::{NoPlanLeft, NoPlans, Plans, Why};
use returns::Returns;
use settings::{Acting, Settings};

mod findings;
mod idle;
mod pending;
mod plans;
mod restart;
mod returns;
mod settings;

/// How long the robot waits for the operator before it gives up: assumed (FMECA, row OPR1).
pub const PATIENCE: Millis = Millis(120_000);
/// How long the planner may take: five seconds (FMECA, row PPL1) beyond the two that it usually
/// takes (assumed).
pub const PATIENCE_WITH_PLANNER: Millis = Millis(7_000);

/// The news of observers and the scheduler in a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perceived {
    /// Flags that are raised now.
    pub raised: Flags,
    /// Flags that were raised and have gone back: what they showed has passed, or was set right.
    pub lowered: Flags,
    /// The module that raised flags are about, where they are about one whichever it is: one that
    /// is late, silent, or gives values out of their interval.
    pub part: Modules,
    /// The modules that say that they work, in use or not: what was lost may return with them.
    pub works: Modules,
}

impl Perceived {
    /// No news.
    pub const fn nothing(works: Modules) -> Self {
        Self { raised: Flags::NONE, lowered: Flags::NONE, part: Modules::NONE, works }
    }
}

/// State of the drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Body {
    /// The goal of the drive is reached.
    pub at_goal: bool,
    /// The robot does not move.
    pub stands: bool,
}

/// A word of the mission, of the planner of paths, or of the operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Word {
    /// A mission is given.
    MissionReceived,
    /// The object is on board.
    ObjectReceived,
    /// The object was handed over.
    ObjectDelivered,
    /// The time to wait is over: only of missions in which the robot waits.
    WaitOver,
    /// A path is planned.
    PathReady,
    /// The operator says something.
    Operator(operator::Event),
}

impl Word {
    const fn told(self) -> Told {
        match self {
            Self::MissionReceived => Told::Mission(global::Event::mission_received),
            Self::ObjectReceived => Told::Mission(global::Event::object_received),
            Self::ObjectDelivered => Told::Mission(global::Event::object_delivered),
            Self::WaitOver => Told::WaitOver,
            Self::PathReady => Told::Drive(local::Event::path_ready),
            Self::Operator(it) => Told::Operator(it),
        }
    }
}

/// The requests to the robot now; they hold until the next round.
#[allow(clippy::struct_excessive_bools, reason = "each goes to another part of the robot")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requests {
    /// The modules that are to run; none where nothing does.
    pub configuration: Option<Configuration>,
    /// Motion may be commanded.
    pub drive: bool,
    /// The fastest it may go.
    pub speed: MillimetresPerSecond,
    /// The factors that adapted settings leave of speed and quality.
    pub adjusted: Adjusted,
    /// Motor power is to be cut for good.
    pub halt: bool,
    /// The operator is asked.
    pub ask: bool,
    /// The mission was given up and the robot stands: alarm.
    pub alarm: bool,
}

/// The decisional level of a mission, from flags to requests. `P` is the packed system of its
/// supervisors, as for [`Level`].
#[derive(Clone, Copy, Debug)]
pub struct Decider<P, const W: usize, const C: usize, const S: usize> {
    level: Level<P, W, C, S>,
    /// How many objectives the mission has.
    objectives: u32,
    now: Millis,
    /// The situation at the end of the last round.
    situation: Situation,
    global: PlaceId,
    /// Since when the local supervisor is where it is, or the planner was started again.
    since: Millis,
    /// Since when the robot stands.
    stands_since: Millis,
    /// Flags that are raised.
    up: Flags,
    /// The failure modes diagnosed, and of each row the first finding and the module.
    found: FailureModes,
    origin: [Origin; FailureMode::ALL.len()],
    findings: u16,
    /// The parts diagnosed to be broken.
    known: Known,
    settings: Settings,
    returns: Option<Returns>,
    /// The losses that the supervisors reckon with: those diagnosed, and those that the plan
    /// chooses.
    lost: Losses,
    untold: Pending<Told, Cause>,
    plannings_failed: u32,
    /// A limit cannot be kept, and the operator knows.
    resigned: bool,
}

/// The decisional level of the delivery, from flags to requests.
pub type DeliveryDecider = Decider<
    delivery::Program,
    { delivery::SIZE.words },
    { delivery::SIZE.clocks },
    { delivery::SIZE.slots },
>;

/// The parts known to be broken, and the consequences; both change rarely.
#[derive(Clone, Copy, Debug)]
struct Known {
    health: Health,
    available: Modules,
    relied_on: Modules,
}

impl From<Health> for Known {
    fn from(health: Health) -> Self {
        Self { health, available: health.available(), relied_on: health.relied_on() }
    }
}

/// The origin of a diagnosis.
#[derive(Clone, Copy, Debug, Default)]
struct Origin {
    cause: Cause,
    part: Modules,
}

impl<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize> Decider<P, W, C, S> {
    /// A robot at rest, all of which works. `objectives` is how many the global supervisor has;
    /// the configuration is that of the plan at the start, for the first drive, if there is one.
    pub fn start(program: P, objectives: u32, planned: Option<Configuration>) -> Self {
        let mut decider = Self::resume(Level::start(program), objectives, Health::SOUND);
        decider.do_without(planned, Cause(0));
        decider
    }

    /// Goes on from where these supervisors are, with what is known to be broken.
    pub fn resume(level: Level<P, W, C, S>, objectives: u32, known: Health) -> Self {
        let known = Known::from(known);
        let lost = Losses::lacking(known.relied_on);
        Self {
            situation: level.situation(lost),
            global: level.global(),
            level,
            objectives,
            now: Millis(0),
            since: Millis(0),
            stands_since: Millis(0),
            up: Flags::NONE,
            found: FailureModes::NONE,
            origin: [Origin::default(); FailureMode::ALL.len()],
            findings: 0,
            known,
            settings: Settings::default(),
            returns: None,
            lost,
            untold: Pending::default(),
            plannings_failed: 0,
            resigned: false,
        }
    }

    /// Lets modules that return be used again: only with the supervisors of
    /// [`recovering`](crate::cotama::recovering).
    #[must_use]
    pub fn with_returns(self) -> Self {
        Self { returns: Some(Returns::default()), ..self }
    }

    /// Observers tell what they see. At most one finding comes of it, whose number is the
    /// [`Cause`] of all that follows from it.
    pub fn perceive(
        &mut self,
        now: Millis,
        seen: Perceived,
        plans: &mut impl Plans,
    ) -> Option<Finding> {
        let second_ended = now.0 / 1_000 != self.now.0 / 1_000;
        self.now = now;
        self.up = self.up.union(seen.raised).without(seen.lowered);
        let finding =
            (!seen.raised.is_empty()).then(|| self.diagnose(seen.raised, seen.part, plans));
        self.settings.see(now, self.up);
        self.use_what_returns(seen.works, plans);
        if second_ended {
            self.watch_margins(plans);
        }
        finding
    }

    /// Whether it hears what is said in the coming round: reports go first.
    pub const fn listens(&self) -> bool {
        self.untold.is_empty()
    }

    /// A round: the supervisors take their turns and are told one thing. What is said is not heard
    /// unless it [listens](Self::listens). A finding comes of the silence of the operator.
    pub fn round(
        &mut self,
        now: Millis,
        said: Option<Word>,
        body: Body,
        observer: &mut impl Observer<P, Cause>,
    ) -> Round {
        self.now = now;
        if !body.stands {
            self.stands_since = now;
        }
        let mut round = Round { told: None, finding: None };
        let mut word = None;
        if self.listens() {
            (word, round.finding) = self.word(said, body);
        }
        let mut acting = Acting::new(observer);
        let _ = self.level.round(now, &mut acting);
        while let Some((told, cause)) = self.untold.pop().or_else(|| word.take()) {
            if self.level.tell(now, told, cause, &mut acting).fired() {
                round.told = Some(told);
                break;
            }
        }
        let before = self.situation;
        self.situation = self.level.situation(self.lost);
        let starts = self.situation.configuration() != before.configuration();
        self.settings.change(acting.acted(), starts, self.up);
        self.global = self.level.global();
        if self.situation.local != before.local {
            (self.since, self.stands_since) = (now, now);
            self.found = self.found.without(FailureModes::of(&[FailureMode::Opr1]));
        }
        round
    }

    /// Returns the requests to the robot now.
    pub fn requests(&self) -> Requests {
        let drive = self.level.permit().is_some();
        let configuration = self.situation.configuration();
        let speed = configuration.filter(|_| drive).map(|it| it.facts().speed);
        Requests {
            configuration,
            drive,
            speed: speed.unwrap_or(MillimetresPerSecond(0)),
            adjusted: self.settings.effect(self.now, self.situation.mode()),
            halt: self.level.halted(),
            ask: self.situation.local == local::State::HandOver,
            alarm: self.global.0 == self.objectives.saturating_add(3),
        }
    }

    /// Returns the event for the supervisors when no failure waits to be reported.
    fn word(&mut self, said: Option<Word>, body: Body) -> (Option<(Told, Cause)>, Option<Finding>) {
        use local::State::{Following, HandOver, Planning, Teleoperated, Teleprogrammed};
        let passed = |since: Millis| self.now.0.saturating_sub(since.0);
        let waited = passed(self.since);
        let word = match self.situation.local {
            _ if self.global.0 > self.objectives => {
                let security = self.global.0 == self.objectives.saturating_add(2);
                (security && body.stands).then_some(Told::Mission(global::Event::stopped))
            }
            Planning if said != Some(Word::PathReady) && waited >= PATIENCE_WITH_PLANNER.0 => {
                self.since = self.now;
                self.plannings_failed = self.plannings_failed.saturating_add(1);
                Some(Told::Failure(faults::Event::no_path))
            }
            Following if body.at_goal => Some(Told::Drive(local::Event::goal_reached)),
            HandOver | Teleprogrammed | Teleoperated
                if waited > PATIENCE.0 && passed(self.stands_since) >= PATIENCE.0 =>
            {
                let finding = self.finding_of_silence();
                let cause = self.origin[FailureMode::Opr1 as usize].cause;
                return (Some((Told::Operator(operator::Event::gives_up), cause)), finding);
            }
            _ => said.map(Word::told),
        };
        (word.map(|it| (it, Cause(0))), None)
    }

    /// The supervisors, to be looked at or stored.
    pub const fn level(&self) -> &Level<P, W, C, S> {
        &self.level
    }

    /// The right to move, if an activity runs that moves the robot.
    pub fn permit(&self) -> Option<Permit<'_>> {
        self.level.permit()
    }

    /// The place of the global supervisor at the end of the last round, by its number in that net.
    pub const fn global(&self) -> PlaceId {
        self.global
    }

    /// Returns the situation of the supervisors of a drive at the end of the last round.
    pub const fn situation(&self) -> Situation {
        self.situation
    }

    /// Since when the local supervisor is where it is, or the planner of paths was started again.
    pub const fn since(&self) -> Millis {
        self.since
    }

    /// How often the planner of paths gave no answer in time.
    pub const fn plannings_failed(&self) -> u32 {
        self.plannings_failed
    }

    /// Returns the health known so far; the next mission [resumes](Self::resume) with it.
    #[must_use]
    pub const fn health(&self) -> Health {
        self.known.health
    }

    /// The modules that can be used, as far as is known.
    #[must_use]
    pub const fn available(&self) -> Modules {
        self.known.available
    }

    /// Returns the available modules that can be relied on: an observer would see them fail.
    #[must_use]
    pub const fn relied_on(&self) -> Modules {
        self.known.relied_on
    }
}

/// The outcome of a round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// The event that the supervisors accepted.
    pub told: Option<Told>,
    /// The operator is silent for too long.
    pub finding: Option<Finding>,
}
