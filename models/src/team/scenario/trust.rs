//! Reliability in a team at work: what is true of a robot, and what bids take to be true.

use super::RobotSpec;
use crate::team::capability::{Capability, Skill};
use crate::team::reliability::Reliability;

/// What bids take the reliability of capabilities to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trust {
    /// Each capability never fails.
    Certain,
    /// What the file states, for the whole of a run.
    Stated,
    /// What the file states, and each use since (def. 3.5): what is counted goes on counting.
    #[default]
    Learned,
    /// What is true of the simulated robots, which nobody knows: for comparison.
    Known,
}

impl Trust {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Certain, Self::Stated, Self::Learned, Self::Known];

    /// Returns the name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Certain => "certain",
            Self::Stated => "stated",
            Self::Learned => "learned",
            Self::Known => "known",
        }
    }
}

/// How often a use of each capability of a robot fails, in thousandths. No bid knows it.
///
/// ```
/// use cotama_models::team::scenario::FailureRates;
/// use cotama_models::team::service::{GRASP_2F, MOVE};
/// let rates = FailureRates::NONE.with(GRASP_2F, 200);
/// assert_eq!([rates.of(GRASP_2F), rates.of(MOVE)], [200, 0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FailureRates([u16; Capability::COUNT as usize]);

impl FailureRates {
    /// Nothing ever fails.
    pub const NONE: Self = Self([0; Capability::COUNT as usize]);

    /// Returns the rate of a capability: 0 to 1,000.
    pub fn of(&self, capability: Capability) -> u16 {
        self.0.get(usize::from(capability.number())).copied().unwrap_or(0)
    }

    /// Returns these with another rate of one capability; more than 1,000 are 1,000.
    #[must_use]
    pub fn with(mut self, capability: Capability, permille: u16) -> Self {
        if let Some(rate) = self.0.get_mut(usize::from(capability.number())) {
            *rate = permille.min(1_000);
        }
        self
    }
}

impl RobotSpec {
    /// Returns the skills of the robot as its first bids take them to be. What it lacks by its file
    /// (def. 3.6) it lacks for all.
    ///
    /// ```
    /// use cotama_models::team::{Reliability, scenario::{Trust, service}};
    /// let mut eddie = service().unwrap().robots.remove(0);
    /// eddie.skills[2].reliability = Reliability::Uses { succeeded: 9, failed: 1 };
    /// eddie.fails = eddie.fails.with(eddie.skills[2].capability, 200);
    /// let grasps = |trust| eddie.trusted(trust)[2].reliability;
    /// assert_eq!(grasps(Trust::Certain), Reliability::CERTAIN);
    /// assert_eq!(grasps(Trust::Learned), Reliability::Uses { succeeded: 9, failed: 1 });
    /// assert_eq!(grasps(Trust::Known), Reliability::Permille(800));
    /// ```
    pub fn trusted(&self, trust: Trust) -> Vec<Skill> {
        let trusted = |it: &Skill| match trust {
            _ if !it.reliability.is_there() => *it,
            Trust::Certain => Skill::certain(it.capability),
            Trust::Stated | Trust::Learned => *it,
            Trust::Known => {
                let works = 1_000_u16.saturating_sub(self.fails.of(it.capability));
                Skill { reliability: Reliability::Permille(works), ..*it }
            }
        };
        self.skills.iter().map(trusted).collect()
    }
}
