//! The protocol of a team at work, from its file.

use super::team::{Job, Team};
use crate::team::scenario::{Fault, FaultKind, RobotSpec, RoleSpec, Scenario};

/// A net with more transitions than so many is not made.
pub const MOST_STEPS: u64 = 100_000;

/// A task with more capable robots is not looked at in more detail: its awards alone are too many.
const MOST_CAPABLE: usize = 16;

impl From<&Scenario> for Team {
    /// The robots and tasks of a team at work. Who can fill a role is who has the skills for it. A
    /// task is received by the robot of the auctioneer; where that is at a desk of its own, the
    /// robots receive tasks in turn. There are as many failures as the team's faults of robots, one
    /// a robot at most.
    ///
    /// Left out are times, ways and costs, as in every net of the protocol, and the order of tasks:
    /// all are there from the beginning, in whatever order they are announced.
    ///
    /// ```
    /// use cotama_models::team::{protocol::Team, scenario};
    /// let service = scenario::service().unwrap();
    /// let team = Team::from(&service);
    /// assert_eq!((team.robots(), team.tasks(), team.failures()), (4, 2, 1));
    /// ```
    fn from(scenario: &Scenario) -> Self {
        let robots = scenario.robots.len();
        let able: Vec<_> = scenario.robots.iter().map(RobotSpec::capabilities).collect();
        let tasks = scenario.tasks.iter().enumerate().map(|(number, it)| {
            let capable =
                |role: &RoleSpec| (0..robots).filter(|r| role.possible(able[*r])).collect();
            let plans = it.plans.iter().map(|it| it.roles.iter().map(capable).collect());
            let in_turn = number.checked_rem(robots).unwrap_or(0);
            Job { received: scenario.auctioneer.robot().unwrap_or(in_turn), plans: plans.collect() }
        });
        let fails = |it: &Fault| matches!(it.what, FaultKind::Robot(..) | FaultKind::Auctioneer(_));
        let failures = scenario.faults.iter().filter(|it| fails(it)).count().min(robots);
        let tasks = tasks.collect();
        Self::of(robots, failures as u32, tasks).without_old_messages()
    }
}

impl Team {
    /// Returns a number of transitions that the net of the repaired protocol does not exceed;
    /// `None` where that is more than [`MOST_STEPS`].
    ///
    /// ```
    /// use cotama_models::team::protocol::{Team, net};
    /// let team = Team::new(6, 4).without_old_messages();
    /// let most = team.steps().unwrap();
    /// assert!(net(&team).transitions.len() as u64 <= most && most < 4_000);
    /// ```
    pub fn steps(&self) -> Option<u64> {
        let power = |base: u64, of: usize| base.saturating_pow(of.try_into().unwrap_or(u32::MAX));
        let (robots, tasks) = (self.robots as u64, self.tasks.len());
        // A robot breaks down in each of its states, with any of the tasks that it leads.
        let (mut states, mut sum) = (robots, 2_u64);
        if power(2, tasks) > MOST_STEPS {
            return None;
        }
        for job in &self.tasks {
            let capable = job.capable();
            if capable.len() > MOST_CAPABLE {
                return None;
            }
            let members = capable.len() as u64;
            states = states.saturating_add(2 * members);
            // All sets of robots at most are those without which nobody can do it.
            let mut own = power(2, capable.len());
            for size in job.coalitions().iter().map(Vec::len) {
                let (outbid, reopens) = (power(2, capable.len() - size), power(4, size));
                // Each member says yes, or no for each state in which it is busy; and it starts.
                let heard = power(2, size.saturating_sub(1)).saturating_mul(size as u64);
                let answers = heard.saturating_mul(2 * tasks as u64);
                for more in [outbid, reopens, answers, 3] {
                    own = own.saturating_add(more);
                }
            }
            let fixed = 6 + 8 * robots + 12 * members + 3 * members * members;
            sum = sum.saturating_add(own).saturating_add(fixed);
        }
        sum = sum.saturating_add(states.saturating_mul(power(2, tasks)));
        (sum <= MOST_STEPS).then_some(sum)
    }
}
