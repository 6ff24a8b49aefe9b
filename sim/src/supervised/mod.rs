//! Missions under COTAMA's supervisors (Durand et al., TAROS 2010), at mission fidelity: travel,
//! energy, failures, observers with their latencies, an operator; no rays.
//!
//! ```
//! use cotama_models::missions::{Mission, embedded};
//! use cotama_sim::supervised::{Script, Supervised};
//! use cotama_sim::run::Outcome;
//! let delivery = embedded::mission("delivery").unwrap();
//! let mission = Mission::parse(delivery.name, delivery.text).unwrap();
//! let run = Supervised::new(&mission).unwrap().run(&Script::default()).unwrap();
//! assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 0));
//! ```

mod conduct;
mod monitor;
pub mod operator;
mod planted;
mod rung;
mod script;
pub mod story;
mod summary;
mod world;

pub use crate::body::{PERIOD, Planted};
pub use conduct::{Conduct, Fired};
pub use cotama_models::cotama::Judged;
pub(crate) use monitor::Watching;
pub use monitor::{Monitor, Unmonitored, Violation};
pub use operator::Answers;
pub use script::{Injection, Script, When};

use crate::options::Planner;
use crate::record::{Recorder, Silent};
use crate::run::{NoPlan, Outcome, PlanMade};
use cotama_core::net::Net;
use cotama_core::net::owned::OwnedNet;
use cotama_core::player::{Packed, Program};
use cotama_core::system::{Component, System, SystemError};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Configuration, Told, delivery, global, recovering};
use cotama_models::missions::{Does, Mission};
use world::{CLOCKS, World};

/// The result of a supervised run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended: completed, safe (the global supervisor gave up and the robot stands), or
    /// failed.
    pub outcome: Outcome,
    /// Time at the end.
    pub time: Millis,
    /// Position at the end.
    pub x: Millimetres,
    /// Duration and energy used, in ms and mJ.
    pub used: [u64; 2],
    /// The quality of what was driven: that of each configuration per 100 mm, as it was adjusted.
    pub quality: u64,
    /// How often the operator was asked by the supervisors.
    pub operator_requests: u64,
    /// Events that the supervisors accepted, each with the number of the round before it.
    pub told: Vec<(u64, Told)>,
    /// How many rounds there were.
    pub rounds: u64,
    /// The firings.
    pub fired: Vec<Fired>,
    /// The conduct on each failure, in the order of their happening.
    pub conduct: Vec<Conduct>,
    /// Which configuration ran from when on; none while none did.
    pub configurations: Vec<(Millis, Option<Configuration>)>,
    /// The plans of PANORAMA.
    pub plans: Vec<PlanMade>,
    /// The longest time that the robot moved while a module was broken that its configuration
    /// requires.
    pub exposed: Millis,
    /// The age of the oldest pose of localisation that a configuration with localisation moved by.
    pub oldest_pose: Millis,
    /// The longest way that it went on after the permit to move was gone.
    pub braked: Millimetres,
    /// Whether it moved after the global supervisor had made it safe, for as long as it was
    /// watched: never, or something is wrong.
    pub moved_when_safe: bool,
    /// The longest time that an observer at work left a failure unseen beyond the latency of its
    /// row.
    pub unseen: Millis,
    /// Whether a plan was made with modules that were known not to be available.
    pub planned_with_lost: bool,
    /// The property that it broke, which ended it.
    pub violated: Option<Violation>,
    /// When, and where, the supervisors did something else than those that are shipped: looked for
    /// by [`Supervised::compared`] only. It ends the run.
    pub departed: Option<(Millis, String)>,
}

/// A supervised mission, ready to be run.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::run::Outcome;
/// use cotama_sim::supervised::{Fired, Script, Supervised};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let run = Supervised::new(&mission).unwrap().run(&Script::default()).unwrap();
/// assert_eq!((run.outcome, run.operator_requests), (Outcome::Completed, 0));
/// let received = |it: &Fired| (it.net, it.transition.as_str()) == ("gs", "g3");
/// assert!(run.fired.iter().any(received));
/// ```
#[derive(Clone, Debug)]
pub struct Supervised<'m> {
    mission: &'m Mission,
    supervisors: Supervisors,
    planner: Planner,
    planted: Vec<Planted>,
    monitors: Vec<Monitor>,
    compared: bool,
}

/// The decisional level, packed.
#[derive(Clone, Debug)]
enum Supervisors {
    /// The global supervisor of the embedded mission.
    Delivery,
    /// The same where modules may return.
    Recovering,
    /// One of both with a global supervisor that was made from the mission.
    Made(OwnedNet, Box<Packed<WORDS, CLOCKS, SLOTS>>),
    /// The caller's.
    Given(System<'static>, Box<Packed<WORDS, CLOCKS, SLOTS>>),
}

/// Words of a marking that suffice for the most objectives of a mission.
const WORDS: usize = 16;

/// The most events that can wait in the mailboxes of the supervisors, whatever the objectives.
const SLOTS: usize = recovering::SIZE.slots;

/// Why a mission has no supervisors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsupervised {
    /// The mission's file says nothing of supervisors.
    Plain,
    /// The global supervisor does not fit the others.
    Unfit(SystemError),
}

impl std::fmt::Display for Unsupervised {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Plain => {
                f.write_str("the mission is not supervised: it has no [supervision] table")
            }
            Self::Unfit(defect) => {
                write!(f, "its global supervisor does not fit the others: {defect}")
            }
        }
    }
}

impl std::error::Error for Unsupervised {}

impl<'m> Supervised<'m> {
    /// Makes a mission ready: the supervisors of the embedded one, with a global supervisor of its
    /// own where its objectives are others, and those that use again what returns where it asks for
    /// them; [the planner of the mission](Planner::of) plans.
    ///
    /// # Errors
    /// When its file names no supervision.
    pub fn new(mission: &'m Mission) -> Result<Self, Unsupervised> {
        let made = mission.supervisor().ok_or(Unsupervised::Plain)?;
        let supervisors = if is_delivery(mission) {
            if mission.recovery { Supervisors::Recovering } else { Supervisors::Delivery }
        } else {
            let view = made.view();
            let net = view.net();
            let components = components(mission, &net);
            let system = System { components: &components, ..shipped(mission) };
            let packed = Packed::of(&system).map_err(Unsupervised::Unfit)?;
            Supervisors::Made(made.clone(), Box::new(packed))
        };
        Ok(Self::with(mission, supervisors))
    }

    fn with(mission: &'m Mission, supervisors: Supervisors) -> Self {
        let (planted, monitors) = (Vec::new(), Vec::new());
        let planner = Planner::of(mission);
        Self { mission, supervisors, planner, planted, monitors, compared: false }
    }

    /// A property of its supervisors, to be watched: see [`Monitor`].
    ///
    /// # Errors
    /// When the text is no property of these supervisors, or none that can be watched.
    pub fn monitor(&self, text: &str) -> Result<Monitor, Unmonitored> {
        match &self.supervisors {
            Supervisors::Delivery => Monitor::new(text, &delivery::SYSTEM),
            Supervisors::Recovering => Monitor::new(text, &recovering::SYSTEM),
            Supervisors::Given(system, _) => Monitor::new(text, system),
            Supervisors::Made(net, _) => {
                let view = net.view();
                let net = view.net();
                let components = components(self.mission, &net);
                Monitor::new(text, &System { components: &components, ..shipped(self.mission) })
            }
        }
    }

    /// A run ends where it breaks one of these.
    #[must_use]
    pub fn with_monitors(self, monitors: Vec<Monitor>) -> Self {
        Self { monitors, ..self }
    }

    /// Supervisors of the caller's ([`of_supervisors`](Self::of_supervisors)) are held against
    /// those that are shipped, which are told the same: a run ends where their markings differ.
    /// None of supervisors that are shipped.
    #[must_use]
    pub fn compared(self) -> Option<Self> {
        let given = matches!(self.supervisors, Supervisors::Given(..));
        given.then_some(Self { compared: true, ..self })
    }

    /// Supervisors of the caller's are not held against those that are shipped.
    #[must_use]
    pub fn uncompared(self) -> Self {
        Self { compared: false, ..self }
    }

    /// Returns the planner.
    pub const fn planner(&self) -> Planner {
        self.planner
    }

    /// Plans are made by this planner.
    #[must_use]
    pub fn with_planner(self, planner: Planner) -> Self {
        Self { planner, ..self }
    }

    /// Runs it.
    ///
    /// # Errors
    /// When there is no plan at the start; nothing is run then.
    pub fn run(&self, script: &Script) -> Result<Run, NoPlan> {
        self.run_recorded(script, Millis(1_000), &mut Silent)
    }

    /// Runs it and records what happens, with a sample after every `period`, rounded up to whole
    /// rounds.
    ///
    /// Records of one round are in this order: what failed, what was found, plans, what fired and
    /// what was decided, what was told, requests, configurations, activities, samples.
    ///
    /// # Errors
    /// When there is no plan at the start; nothing is run or recorded then.
    pub fn run_recorded<R: Recorder>(
        &self,
        script: &Script,
        period: Millis,
        recorder: &mut R,
    ) -> Result<Run, NoPlan> {
        self.started(script, period, Millis(0), recorder).map(|it| it.0)
    }

    /// Runs it, and watches the robot for so long after the end: how far it still goes. The
    /// supervisors stay as they are at the end, failures go on, and nobody gives a new mission.
    ///
    /// ```
    /// use cotama_core::units::{Millimetres, Millis};
    /// use cotama_models::cotama::FailureMode::Bat2;
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_sim::run::Outcome;
    /// use cotama_sim::supervised::{Injection, Script, Supervised, When};
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let injections = vec![Injection::new(When::Place(Millimetres(5_000)), Bat2)];
    /// let script = Script { injections, ..Script::default() };
    /// let supervised = Supervised::new(&mission).unwrap();
    /// let (run, way) = supervised.run_and_watch(&script, Millis(60_000)).unwrap();
    /// assert_eq!((run.outcome, way), (Outcome::Safe, Millimetres(0)));
    /// ```
    ///
    /// # Errors
    /// When there is no plan at the start; nothing is run then.
    pub fn run_and_watch(
        &self,
        script: &Script,
        after: Millis,
    ) -> Result<(Run, Millimetres), NoPlan> {
        self.started(script, Millis(1_000), after, &mut Silent)
    }

    /// A run, and how far the robot still goes after its end.
    fn started<R: Recorder>(
        &self,
        script: &Script,
        period: Millis,
        after: Millis,
        recorder: &mut R,
    ) -> Result<(Run, Millimetres), NoPlan> {
        let (mission, planner) = (self.mission, self.planner);
        match &self.supervisors {
            Supervisors::Delivery => {
                let world = World::start(mission, global::NET, delivery::Program, script, planner)?;
                Ok(finish(world.with(self), period, after, recorder))
            }
            Supervisors::Given(system, packed) => {
                let (global, program) = (*system.components[0].net, packed.load(system));
                let world = World::start(mission, global, program, script, planner)?;
                Ok(finish(world.under(*system).with(self), period, after, recorder))
            }
            Supervisors::Recovering => {
                let world =
                    World::start(mission, global::NET, recovering::Program, script, planner)?;
                Ok(finish(world.with(self), period, after, recorder))
            }
            Supervisors::Made(net, packed) => {
                let view = net.view();
                let net = view.net();
                let components = components(mission, &net);
                let system = System { components: &components, ..shipped(mission) };
                let program = packed.load(&system);
                let world = World::start(mission, net, program, script, planner)?;
                Ok(finish(world.with(self), period, after, recorder))
            }
        }
    }
}

/// The supervisors that a mission asks for, with the global supervisor of the embedded one.
fn shipped(mission: &Mission) -> System<'static> {
    if mission.recovery { recovering::SYSTEM } else { delivery::SYSTEM }
}

/// The same nets with another global supervisor.
fn components<'n>(mission: &Mission, global: &'n Net<'n>) -> Vec<Component<'n>> {
    let mut components = shipped(mission).components.to_vec();
    components[0].net = global;
    components
}

/// Whether the objectives are those of the embedded mission, in their order.
fn is_delivery(mission: &Mission) -> bool {
    use Does::{Deliver, Drive, Receive};
    let does = mission.objectives.iter().map(|it| it.does.as_ref().map(|it| it.value));
    does.eq([Drive, Receive, Drive, Deliver].map(Some))
}

fn finish<P: Program<W, CLOCKS, S> + Clone, const W: usize, const S: usize, R: Recorder>(
    mut world: World<'_, P, W, S>,
    period: Millis,
    after: Millis,
    recorder: &mut R,
) -> (Run, Millimetres) {
    let mut recorded = world::Recorded::default();
    loop {
        if R::WANTED {
            world.record(&mut recorded, period, recorder);
        }
        if world.period() {
            break;
        }
        if !R::WANTED {
            world.pass_over();
        }
    }
    if R::WANTED {
        world.record(&mut recorded, period, recorder);
        world.record_end(&mut recorded, recorder);
    }
    let before = (Millimetres(0), false);
    let (way, moved) = if after > Millis(0) { world.clone().way_in(after) } else { before };
    let mut run = world.into_run();
    run.moved_when_safe |= moved;
    (run, way)
}
