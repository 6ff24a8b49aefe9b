//! The assignment of robots to tasks, and its proof.

use super::{Instance, Kind};
use crate::team::thesis;
use cotama_core::allocation::MemoryError;
use cotama_core::team::Cost;

/// The verdict on an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The assignment costs least.
    Optimal {
        /// Cost of the assignment, in parts.
        cost: u64,
    },
    /// Some tasks that must be done cannot be staffed together.
    Infeasible(Reason),
    /// A limit was reached.
    Unknown {
        /// Cost of the assignment, in parts; `None` where none was found.
        cost: Option<u64>,
        /// No assignment costs less, in parts.
        bound: u64,
    },
}

/// Why there is no assignment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reason {
    /// Tasks that must be done and cannot be staffed together.
    pub tasks: Vec<usize>,
    /// The robots that they compete for, each of which is capable of a role in one of them.
    pub robots: Vec<usize>,
}

/// A task that is done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Done {
    /// The task.
    pub task: usize,
    /// The plan.
    pub plan: usize,
    /// The robot of each role.
    pub robots: Vec<usize>,
}

/// A proof that anyone can add up again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Proof {
    /// A price for each robot, in units. Each task pays at least the less of what it costs to leave
    /// it undone and what its cheapest robot costs with its price; all together less the prices of
    /// all robots are the least cost (duality of linear programming).
    Prices(Vec<u64>),
    /// Why each plan of the only task costs no less than said.
    Plans(Vec<PlanProof>),
    /// Some tasks need more robots than are capable of any of them (P. Hall, 1935).
    Hall,
    /// A search left nothing that is better, or as much as the bound says.
    Search {
        /// The steps that it took.
        steps: u64,
        /// The nodes that it visited.
        nodes: u64,
    },
    /// The instance is too large for a proof of the least cost: each task alone costs so much at
    /// least.
    TooLarge {
        /// In words.
        limit: String,
    },
}

/// Why a plan costs no less than this.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlanProof {
    /// At these prices of robots, in units, each role pays at least so much.
    Prices {
        /// Cost of the task by this plan, in parts.
        cost: u64,
        /// One for each robot.
        prices: Vec<u64>,
    },
    /// Below this cost, these roles have fewer robots than they are.
    Threshold {
        /// Cost of the task by this plan, in parts.
        cost: u64,
        /// The largest cost of its roles, in units.
        largest: u32,
        /// The roles.
        roles: Vec<usize>,
        /// All robots that cost less in one of them.
        robots: Vec<usize>,
    },
    /// These roles have fewer robots than they are.
    Impossible {
        /// The roles.
        roles: Vec<usize>,
        /// All robots that are capable of one of them.
        robots: Vec<usize>,
    },
}

/// An answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The verdict.
    pub verdict: Verdict,
    /// The tasks that are done, in their order.
    pub done: Vec<Done>,
    /// The proof of the verdict.
    pub proof: Proof,
}

impl Assignment {
    /// Returns the cost of the assignment, in parts; `None` where there is none.
    pub const fn cost(&self) -> Option<u64> {
        match self.verdict {
            Verdict::Optimal { cost } => Some(cost),
            Verdict::Unknown { cost, .. } => cost,
            Verdict::Infeasible(_) => None,
        }
    }

    /// No assignment costs less, in parts; none where there is no assignment.
    pub const fn bound(&self) -> Option<u64> {
        match self.verdict {
            Verdict::Optimal { cost } => Some(cost),
            Verdict::Unknown { bound, .. } => Some(bound),
            Verdict::Infeasible(_) => None,
        }
    }
}

/// The outcome of greedy rounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Greedy {
    /// Cost of the tasks that are done, and of those that are left undone and may be, in parts.
    pub cost: u64,
    /// How many tasks are left undone that must be done.
    pub unserved: usize,
    /// How many rounds there were.
    pub rounds: usize,
}

impl Instance {
    /// Says who does what at the least cost. Where tasks of several robots are done at once, at
    /// most so many steps are taken; about a million take a second.
    ///
    /// # Errors
    /// [`MemoryError`] where memory lacks, which is made large enough here.
    pub fn solve(&self, steps: u64) -> Result<Assignment, MemoryError> {
        if self.robots.is_empty() {
            return Ok(self.without_robots());
        }
        match self.kind {
            Kind::Single => self.solve_single(),
            Kind::CoalitionMean | Kind::CoalitionMax => self.solve_coalition(),
            Kind::Simultaneous => match self.understaffed() {
                Some(reason) => Ok(Assignment {
                    verdict: Verdict::Infeasible(reason),
                    done: vec![],
                    proof: Proof::Hall,
                }),
                None => self.solve_joint(steps),
            },
        }
    }

    /// Returns the outcome of greedy rounds, as the thesis forms teams (Rohrmueller, 3.4.4 and
    /// Algorithm 3.1): for comparison. None for more than 128 robots, or costs too large for all
    /// tasks at once.
    pub fn greedy(&self) -> Option<Greedy> {
        let (tasks, robots) = (self.tasks.len(), self.robots.len());
        let roles = self.tasks.iter().flat_map(|it| &it.plans).map(|it| it.roles.len()).max();
        let (rows, columns) = (tasks.max(roles.unwrap_or(0)), robots.checked_add(tasks)?);
        let room = rows.checked_mul(columns).filter(|it| *it <= super::MAX_INSTANCE_ENTRIES)?;
        let mut room = super::single::Room::<i64>::new(rows, columns, room);
        let mut states = vec![thesis::State::Open; tasks];
        let rounds = self.with_team(|team| {
            let (entries, mut memory) = room.parts().ok()?;
            thesis::greedy(team, &mut states, entries, &mut memory).ok()
        });
        let rounds = rounds.ok()??;
        Some(Greedy { cost: rounds.cost, unserved: rounds.unserved, rounds: rounds.rounds })
    }

    /// Nobody does anything.
    fn without_robots(&self) -> Assignment {
        let must = self.tasks.iter().enumerate().filter(|it| it.1.skip.is_none());
        let tasks: Vec<_> = must.map(|it| it.0).collect();
        let skipped = self.tasks.iter().map(|it| u64::from(it.skip.map_or(0, Cost::get)));
        let cost = skipped.sum::<u64>().saturating_mul(self.denominator.into());
        let (verdict, proof) = if tasks.is_empty() {
            (Verdict::Optimal { cost }, Proof::Prices(vec![]))
        } else {
            (Verdict::Infeasible(Reason { tasks, robots: vec![] }), Proof::Hall)
        };
        Assignment { verdict, done: vec![], proof }
    }
}
