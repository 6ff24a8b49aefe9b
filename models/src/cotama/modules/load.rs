//! The modules of the delivery as tasks of the executive, and how many particles the localisation
//! can afford.
//!
//! | number | value | |
//! | --- | --- | --- |
//! | control loop of each sub-objective | less than 100 ms | stated |
//! | period of the loop: that of the robot's packets | 100 ms | of the robot's firmware |
//! | deadline of a module | 80 ms | assumed |
//! | extra time, which ends with the period | 20 ms | assumed |
//! | misses in a row that are a fault | 3 | assumed |
//! | costs of modules and of a particle | see [`COSTS`], [`PARTICLES`] | assumed |
//! | load of the computer beside the modules | see [`Load`] | assumed |
//!
//! The modules are listed in the order of urgency, which is that of the data but for the
//! localisation: it comes last. That follows from the experiment, in which it alone was late:
//! whatever is less urgent than a module that takes too long is late with it. The others use its
//! last pose, the age of which they see.
//!
//! In the paper's experiment the real-time fault of the localisation is answered with fewer
//! particles. How many is not stated; here it is what the set can afford, exactly
//! ([`most_particles`]), for each [`Load`].
//!
//! ```
//! use cotama_core::executive::{Overruns, TaskSet, ScheduleError};
//! use cotama_models::cotama::Configuration::FollowingOptimal;
//! use cotama_models::cotama::load::{self, Load, SPARE};
//!
//! let mut tasks = [SPARE; load::MOST];
//! assert_eq!(load::most_particles(FollowingOptimal, Load::Quiet, &mut tasks), Ok(Some(500)));
//! assert_eq!(load::most_particles(FollowingOptimal, Load::Busy, &mut tasks), Ok(Some(200)));
//!
//! let tasks = load::tasks(FollowingOptimal, Load::Busy, 500, &mut tasks);
//! let late = TaskSet::new(tasks).unwrap().schedulable(Overruns::None);
//! let localisation = tasks.len() - 1;
//! assert!(matches!(late, Err(ScheduleError::Late { task, .. }) if task == localisation));
//! ```

use super::configurations::Configuration;
use super::module::Module::{self, Mcl};
use core::fmt;
use cotama_core::executive::{Overruns, ScheduleError, Task, TaskError, TaskSet};
use cotama_core::units::Micros;

const fn ms(ms: u64) -> Micros {
    Micros(ms * 1_000)
}

/// From one release of the control loop to the next.
pub const PERIOD: Micros = ms(100);
/// From its release until a module must be done.
pub const DEADLINE: Micros = ms(80);
/// How long a late module may go on.
pub const EXTRA: Micros = ms(20);

/// The cost of a job of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModuleCost {
    /// The module.
    pub module: Module,
    /// Worst-case execution time; of the localisation, without particles.
    pub cost: Micros,
}

/// All modules that are scheduled, the most urgent first, with assumed costs. ODO and CTR are parts
/// of NAV, and the scheduler is no job of its own.
pub const COSTS: [ModuleCost; 17] = {
    use Module as M;
    const fn costs(module: Module, cost_ms: u64) -> ModuleCost {
        ModuleCost { module, cost: ms(cost_ms) }
    }
    [
        costs(M::P3d, 4),
        costs(M::Sim, 6),
        costs(M::Ust, 3),
        costs(M::Nav, 3),
        costs(M::Dvz, 5),
        costs(M::Smz, 7),
        costs(M::Gui, 4),
        costs(M::Lan, 4),
        costs(M::OSen, 1),
        costs(M::OEff, 2),
        costs(M::OCom, 1),
        costs(M::OLoc, 1),
        costs(M::OPf, 1),
        costs(M::Gom, 1),
        costs(M::Cam, 8),
        costs(M::Ppl, 25),
        LOCALISATION,
    ]
};

/// The module with particles, which comes last.
const LOCALISATION: ModuleCost = ModuleCost { module: Mcl, cost: ms(6) };

/// The processor time of a particle in each period; assumed.
pub const PARTICLE: Micros = Micros(80);

/// Other load of the robot's computer, more urgent than all modules; assumed. The load is a task as
/// well, with a period of 10 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// No other load.
    Quiet,
    /// 3 ms of every 10: the load that the localisation meets soon after the start of the path
    /// following.
    Busy,
    /// 4 ms of every 10: the most for which the floor of particles is meant.
    Heavy,
}

impl Load {
    /// As a task; `None` when there is nothing.
    const fn task(self) -> Option<Task> {
        match self {
            Self::Quiet => None,
            Self::Busy => Some(Task::new(ms(10), ms(3))),
            Self::Heavy => Some(Task::new(ms(10), ms(4))),
        }
    }
}

/// Particles of the levels of the adapter supervisor, from the floor up: what the optimal path
/// following affords under heavy load, when busy and when quiet.
pub const PARTICLES: [u32; 3] = [100, 200, 500];

/// The most tasks that there are: every module, and the load.
pub const MOST: usize = COSTS.len() + 1;

/// A task that fills unused memory.
pub const SPARE: Task = Task::new(Micros::ZERO, Micros::ZERO);

/// Why nothing can be said of a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadError {
    /// A task makes no sense.
    Task(TaskError),
    /// The limit of iterations was reached.
    Iterations(ScheduleError),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Task(error) => error.fmt(f),
            Self::Iterations(unknown) => unknown.fmt(f),
        }
    }
}

impl core::error::Error for LoadError {}

/// The tasks of a configuration under a load, the most urgent first: the load if there is one, the
/// modules that are scheduled for it in the order of [`COSTS`], so the localisation last if it is
/// among them, with so many particles.
pub fn tasks(
    configuration: Configuration,
    load: Load,
    particles: u32,
    memory: &mut [Task; MOST],
) -> &[Task] {
    let scheduled = configuration.scheduled();
    let members = COSTS.iter().filter(|it| scheduled.has(it.module)).map(|it| {
        let particles = if matches!(it.module, Mcl) { u64::from(particles) } else { 0 };
        // A cost of a known module and of 2^32 particles of microseconds fits 64 bits.
        let cost = Micros(it.cost.0.saturating_add(PARTICLE.0.saturating_mul(particles)));
        Task { deadline: DEADLINE, extra: EXTRA, ..Task::new(PERIOD, cost) }
    });
    let mut length = 0;
    for (slot, task) in memory.iter_mut().zip(load.task().into_iter().chain(members)) {
        *slot = task;
        length += 1;
    }
    memory.get(..length).unwrap_or(&[])
}

/// The most particles with which all modules of a configuration are in time under a load, no module
/// overrunning; `None` when they are not even without any, or it does not localise with particles.
///
/// # Errors
/// [`LoadError`].
///
/// ```
/// use cotama_models::cotama::Configuration::{FollowingOdometric, FollowingOptimal};
/// use cotama_models::cotama::load::{Load, MOST, SPARE, most_particles};
/// let mut memory = [SPARE; MOST];
/// let heavy = most_particles(FollowingOptimal, Load::Heavy, &mut memory).unwrap();
/// assert_eq!(heavy, Some(100));
/// assert_eq!(most_particles(FollowingOdometric, Load::Quiet, &mut memory), Ok(None));
/// ```
pub fn most_particles(
    configuration: Configuration,
    load: Load,
    memory: &mut [Task; MOST],
) -> Result<Option<u32>, LoadError> {
    if !configuration.scheduled().has(Mcl) {
        return Ok(None);
    }
    let tasks = tasks(configuration, load, 0, memory);
    let set = TaskSet::new(tasks).map_err(LoadError::Task)?;
    let most = set
        .most_cost(tasks.len().saturating_sub(1), Overruns::None)
        .map_err(LoadError::Iterations)?;
    let left = most.and_then(|most| most.checked_sub(LOCALISATION.cost));
    Ok(left.and_then(|left| u32::try_from(left.0 / PARTICLE.0).ok()))
}

cotama_core::net! {
    /// The watchdog of every module of the control loop.
    pub mod loop_watchdog extends crate::nets::watchdog { constants { DEADLINE: 80 } }
}
