//! A team and all its tasks.

use super::cost::Costs;
use super::task::{Combine, Task};

/// A set of robots: bit *r* stands for robot *r*.
pub type RobotSet = u128;

/// A team with its tasks, of which all that must be done are done, with no robot in two roles, at
/// the least cost.
#[derive(Clone, Copy, Debug)]
pub struct Team<'a> {
    robots: usize,
    denominator: u32,
    tasks: &'a [Task<'a>],
    most: u64,
}

/// Why the parts make no team.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TeamError {
    /// There are more robots than [`Team::MAX_ROBOTS`].
    TooManyRobots,
    /// There are more tasks, or plans of a task, than [`Team::MAX_TASKS`].
    TooManyTasks,
    /// A plan has no role, or its table does not have one column a robot.
    Robots {
        /// The task.
        task: usize,
        /// The plan.
        plan: usize,
    },
    /// The number of roles of a plan whose mean counts does not divide the denominator.
    Denominator {
        /// The task.
        task: usize,
        /// The plan.
        plan: usize,
    },
    /// All tasks together may cost more than [`Team::MAX_COST`].
    TooLarge,
}

impl core::fmt::Display for TeamError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooManyRobots => write!(f, "there are more than {} robots", Team::MAX_ROBOTS),
            Self::TooManyTasks => {
                write!(f, "there are more than {} tasks, or plans of one", Team::MAX_TASKS)
            }
            Self::Robots { task, plan } => {
                write!(f, "plan {plan} of task {task} has no role, or not one cost a robot")
            }
            Self::Denominator { task, plan } => {
                write!(f, "the roles of plan {plan} of task {task} do not divide the denominator")
            }
            Self::TooLarge => write!(f, "the tasks may cost more than {} parts", Team::MAX_COST),
        }
    }
}

impl core::error::Error for TeamError {}

impl<'a> Team<'a> {
    /// The most robots of a team.
    pub const MAX_ROBOTS: usize = 128;
    /// The most tasks of a team, and plans of a task.
    pub const MAX_TASKS: usize = u16::MAX as usize;
    /// The most that all tasks together may cost, in parts of a unit.
    pub const MAX_COST: u64 = 1 << 49;

    /// A team of so many robots with its tasks, whose costs are counted in parts, `denominator` of
    /// which make a unit.
    ///
    /// # Errors
    /// [`TeamError`].
    pub fn new(robots: usize, denominator: u32, tasks: &'a [Task<'a>]) -> Result<Self, TeamError> {
        if robots > Self::MAX_ROBOTS {
            return Err(TeamError::TooManyRobots);
        }
        let mut most = 0_u64;
        let many = |it: &Task<'_>| it.plans.len() > Self::MAX_TASKS;
        if tasks.len() > Self::MAX_TASKS || tasks.iter().any(many) {
            return Err(TeamError::TooManyTasks);
        }
        for (number, task) in tasks.iter().enumerate() {
            let skip = task.skip.map_or(0, |it| u64::from(it.get()));
            let mut dearest = skip.saturating_mul(u64::from(denominator));
            for (plan, it) in task.plans.iter().enumerate() {
                let roles = it.roles.rows();
                if roles == 0 || it.roles.columns() != robots {
                    return Err(TeamError::Robots { task: number, plan });
                }
                let rest = u64::from(denominator).checked_rem(roles as u64);
                if task.combine == Combine::Mean && rest != Some(0) {
                    return Err(TeamError::Denominator { task: number, plan });
                }
                dearest = dearest.max(most_of(task, &it.roles, it.extra, denominator));
            }
            most = most.saturating_add(dearest);
        }
        let fits = most <= Self::MAX_COST;
        if fits { Ok(Self { robots, denominator, tasks, most }) } else { Err(TeamError::TooLarge) }
    }

    /// How many robots there are.
    pub const fn robots(&self) -> usize {
        self.robots
    }

    /// How many parts make a unit of cost.
    pub const fn denominator(&self) -> u32 {
        self.denominator
    }

    /// The tasks.
    pub const fn tasks(&self) -> &'a [Task<'a>] {
        self.tasks
    }

    /// All tasks together cost at most this, in parts.
    pub const fn most(&self) -> u64 {
        self.most
    }

    /// How many plans there are.
    pub fn plans(&self) -> usize {
        self.tasks.iter().fold(0, |sum, it| sum.saturating_add(it.plans.len()))
    }

    /// How many roles there are, in all plans.
    pub fn roles(&self) -> usize {
        let roles = |it: &Task<'_>| {
            it.plans.iter().map(|it| it.roles.rows()).fold(0, usize::saturating_add)
        };
        self.tasks.iter().fold(0, |sum, it| sum.saturating_add(roles(it)))
    }
}

/// A plan costs at most this, in parts.
fn most_of(task: &Task<'_>, roles: &Costs<'_>, extra: u32, denominator: u32) -> u64 {
    let count = if task.combine == Combine::Sum { roles.rows() as u64 } else { 1 };
    let largest = u64::from(roles.most()).saturating_mul(count);
    largest.saturating_add(u64::from(extra)).saturating_mul(u64::from(denominator))
}
