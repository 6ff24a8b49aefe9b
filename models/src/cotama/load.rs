//! The modules of the delivery as tasks of the executive, and how many particles the localisation can afford.
//!
//! | number | value | |
//! | --- | --- | --- |
//! | control loop of each sub-objective | less than 100 ms | stated |
//! | period of the loop: that of the robot's information packets | 100 ms | of the robot's firmware |
//! | deadline of a module; extra time, which ends with the period; misses in a row that are a fault | 80 ms; 20 ms; 3 | assumed |
//! | costs of modules and of a particle | see [`MODULES`], [`PARTICLES`] | assumed |
//! | load of the computer beside the modules | see [`Load`] | assumed |
//!
//! The modules are listed in the order of urgency, which is that of the data but for the localisation: it comes last. That
//! follows from the experiment, in which it alone was late: whatever is less urgent than a module that takes too long is late
//! with it. The others use its last pose, the age of which they see.
//!
//! In the paper's experiment the real-time fault of the localisation is answered with fewer particles. How many is not stated; here
//! it is what the set can afford, exactly ([`most_particles`]), for each [`Load`].
//!
//! ```
//! use cotama_core::executive::{Overruns, TaskSet, Unschedulable};
//! use cotama_models::cotama::load::{self, Load, SPARE};
//!
//! let mut tasks = [SPARE; load::MOST];
//! assert_eq!(load::most_particles(load::OPTIMAL, Load::Quiet, &mut tasks), Ok(Some(500)));
//! assert_eq!(load::most_particles(load::OPTIMAL, Load::Busy, &mut tasks), Ok(Some(200)));
//!
//! let tasks = load::tasks(load::OPTIMAL, Load::Busy, 500, &mut tasks).unwrap();
//! let late = TaskSet::new(tasks).unwrap().schedulable(Overruns::None);
//! assert!(matches!(late, Err(Unschedulable::Late { task, .. }) if task == tasks.len() - 1)); // the localisation
//! ```

use core::fmt;
use cotama_core::executive::{Overruns, Task, TaskError, TaskSet, Unschedulable};
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

/// The localisation: the module with particles.
pub const LOCALISATION: &str = "MCL";

/// A module of the control loop. Which modules make a configuration is for the supervisors to say; a name is what joins the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModuleCost {
    /// Its name.
    pub name: &'static str,
    /// Its worst-case execution time; of the localisation, without particles.
    pub cost: Micros,
}

/// All modules that are scheduled, the most urgent first, with assumed costs. ODO and CTR are parts of NAV.
pub const MODULES: [ModuleCost; 17] = {
    const fn module(name: &'static str, cost_ms: u64) -> ModuleCost {
        ModuleCost { name, cost: ms(cost_ms) }
    }
    [
        module("P3D", 4),
        module("SIM", 6),
        module("UST", 3),
        module("NAV", 3),
        module("DVZ", 5),
        module("SMZ", 7),
        module("GUI", 4),
        module("LAN", 4),
        module("O-SEN", 1),
        module("O-EFF", 2),
        module("O-COM", 1),
        module("O-LOC", 1),
        module("O-PF", 1),
        module("GOM", 1),
        module("CAM", 8),
        module("PPL", 25),
        module(LOCALISATION, 6),
    ]
};

/// The processor time of a particle in each period; assumed.
pub const PARTICLE: Micros = Micros(80);

/// What else the computer of the robot does, more urgent than all modules; assumed. It is a task as well, with a period of 10 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// Nothing.
    Quiet,
    /// It takes 3 ms of every 10: the load that the localisation meets soon after the start of the path following.
    Busy,
    /// It takes 4 ms of every 10: the most for which the floor of particles is meant.
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

/// Modules of the optimal path following, and of the one with fewer particles, with their observers.
pub const OPTIMAL: &[&str] =
    &["P3D", "SIM", "UST", "MCL", "NAV", "SMZ", "LAN", "O-SEN", "O-EFF", "O-COM", "O-LOC", "O-PF", "GOM"];
/// Modules of the path following on odometry.
pub const ODOMETRIC: &[&str] =
    &["P3D", "SIM", "UST", "NAV", "SMZ", "LAN", "O-SEN", "O-EFF", "O-COM", "O-PF", "GOM"];
/// Modules of the most degraded path following: no avoidance, no localisation.
pub const DEGRADED: &[&str] = &["P3D", "NAV", "GUI", "LAN", "O-EFF", "O-COM", "O-PF", "GOM"];
/// Modules of the path planning.
pub const PLANNING: &[&str] = &["P3D", "NAV", "PPL", "LAN", "O-EFF", "O-COM", "GOM"];
/// Modules of the teleoperation with avoidance.
pub const TELEOPERATION: &[&str] =
    &["P3D", "SIM", "UST", "DVZ", "NAV", "CAM", "LAN", "O-SEN", "O-EFF", "O-COM", "GOM"];

/// Particles of the levels of the adapter supervisor, from the floor up: what [`OPTIMAL`] affords under heavy load, when busy
/// and when quiet.
pub const PARTICLES: [u32; 3] = [100, 200, 500];

/// The most tasks that there are: every module, and the load.
pub const MOST: usize = MODULES.len() + 1;

/// What memory for tasks is filled with.
pub const SPARE: Task = Task::new(Micros::ZERO, Micros::ZERO);

/// Why modules cannot be made tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadError<'n> {
    /// No module is called so.
    NoSuchModule(&'n str),
    /// There is memory for so many tasks only; [`MOST`] always suffice.
    Memory(usize),
    /// A task makes no sense: with so many particles no job would ever be done.
    Task(TaskError),
    /// The limit of iterations was reached.
    Iterations(Unschedulable),
}

impl fmt::Display for LoadError<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchModule(name) => write!(f, "no module is called {name}; `MODULES` lists them"),
            Self::Memory(length) => write!(f, "there is memory for {length} tasks; give {MOST}"),
            Self::Task(error) => error.fmt(f),
            Self::Iterations(unknown) => unknown.fmt(f),
        }
    }
}

impl core::error::Error for LoadError<'_> {}

/// The tasks of modules under a load, the most urgent first: the load if there is one, the modules in the order of [`MODULES`],
/// so the localisation last if it is among them, with so many particles.
///
/// # Errors
/// [`LoadError::NoSuchModule`], [`LoadError::Memory`].
pub fn tasks<'n, 't>(
    modules: &[&'n str],
    load: Load,
    particles: u32,
    memory: &'t mut [Task],
) -> Result<&'t [Task], LoadError<'n>> {
    if let Some(name) = modules.iter().find(|name| MODULES.iter().all(|it| it.name != **name)) {
        return Err(LoadError::NoSuchModule(name));
    }
    let members = MODULES.iter().filter(|it| modules.contains(&it.name)).map(|it| {
        let particles = if it.name == LOCALISATION { u64::from(particles) } else { 0 };
        // A cost of a known module and of 2^32 particles of microseconds fits 64 bits.
        let cost = Micros(it.cost.0.saturating_add(PARTICLE.0.saturating_mul(particles)));
        Task { deadline: DEADLINE, extra: EXTRA, ..Task::new(PERIOD, cost) }
    });
    let mut length = 0;
    for task in load.task().into_iter().chain(members) {
        let Some(slot) = memory.get_mut(length) else { return Err(LoadError::Memory(length)) };
        *slot = task;
        length += 1;
    }
    Ok(memory.get(..length).unwrap_or(&[]))
}

/// The most particles with which all modules are in time under a load, no module overrunning; `None` when they are not even
/// without any, or the localisation is not among them.
///
/// # Errors
/// [`LoadError`].
pub fn most_particles<'n>(
    modules: &[&'n str],
    load: Load,
    memory: &mut [Task],
) -> Result<Option<u32>, LoadError<'n>> {
    let Some(localisation) = MODULES.iter().find(|it| it.name == LOCALISATION && modules.contains(&it.name))
    else {
        return Ok(None);
    };
    let tasks = tasks(modules, load, 0, memory)?;
    let set = TaskSet::new(tasks).map_err(LoadError::Task)?;
    let most = set.most_cost(tasks.len().saturating_sub(1), Overruns::None).map_err(LoadError::Iterations)?;
    let left = most.and_then(|most| most.checked_sub(localisation.cost));
    Ok(left.and_then(|left| u32::try_from(left.0 / PARTICLE.0).ok()))
}

crate::watchdog! {
    /// The watchdog of every module of the control loop.
    pub mod loop_watchdog { misses: 3, deadline: 80 ms, extra: 20 ms }
}
