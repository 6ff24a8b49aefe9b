//! The situation in which a report comes: the input of the contextual supervisor.

use crate::cotama::members::members;
use crate::cotama::modules::Health;
use crate::cotama::modules::Resource;
use crate::cotama::modules::{Configuration, Mode};
use crate::cotama::modules::{Module, Modules};
use crate::cotama::supervisors::{local, path_following, teleoperation};

members! {
    /// A permanent loss, as far as the supervisors tell losses apart.
    Loss,
    /// Losses.
    Losses(u8) {
        /// The operator's avoidance.
        Avoidance = "avoidance",
        /// The avoidance of path following, by itself: that of the operator takes its place.
        Smz = "smz",
        /// Monte Carlo localisation.
        Mcl = "mcl",
        /// The sonars.
        Sonar = "sonar",
        /// The camera.
        Camera = "camera",
        /// The link to the operator.
        Wifi = "wifi",
        /// Power, micro-controller or motors.
        Vital = "vital",
    }
}

/// The places of the supervisors, the particles, and what is lost.
///
/// ```
/// use cotama_models::cotama::{Configuration, Losses, Mode, Situation, local, path_following};
/// let following = Situation {
///     local: local::State::Following,
///     following: path_following::State::Odometric,
///     ..Situation::AT_REST
/// };
/// assert_eq!(following.mode(), Mode::Autonomous);
/// assert_eq!(following.configuration(), Some(Configuration::FollowingOdometric));
/// assert!(following.is_consistent());
/// assert!(!Situation { following: path_following::State::Off, ..following }.is_consistent());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Situation {
    /// The place of the local supervisor.
    pub local: local::State,
    /// The place of the adapter of path following.
    pub following: path_following::State,
    /// The place of the adapter of teleoperation.
    pub teleoperation: teleoperation::State,
    /// The particle level of [`path_following`]: 2 full, 1 fewer, 0 the floor.
    pub level: u8,
    /// The losses.
    pub lost: Losses,
}

impl Situation {
    /// No drive, nothing lost.
    pub const AT_REST: Self = Self {
        local: local::State::Idle,
        following: path_following::State::Off,
        teleoperation: teleoperation::State::Off,
        level: 2,
        lost: Losses::NONE,
    };

    /// Whether the places fit together, as they do at the end of every round (invariants AS1, LS1):
    /// an adapter is on exactly where its sub-objective runs, and the particles are fewer than full
    /// in the reduced set, may be with the other avoidance, and are full elsewhere.
    pub const fn is_consistent(self) -> bool {
        use path_following::State as Following;
        let following = !matches!(self.following, Following::Off);
        let teleoperation = !matches!(self.teleoperation, teleoperation::State::Off);
        following == matches!(self.local, local::State::Following)
            && teleoperation == matches!(self.local, local::State::Teleoperated)
            && match self.following {
                Following::Reduced => self.level < 2,
                Following::Reactive => self.level <= 2,
                _ => self.level == 2,
            }
    }

    /// The autonomy mode: a function of the place of the local supervisor.
    pub const fn mode(self) -> Mode {
        match self.local {
            local::State::Idle | local::State::End => Mode::Rest,
            local::State::Planning | local::State::Following => Mode::Autonomous,
            local::State::HandOver => Mode::HandOver,
            local::State::Teleprogrammed => Mode::Teleprogrammed,
            local::State::Teleoperated => Mode::Teleoperated,
        }
    }

    /// The running configuration; none without a drive, in the hand-over, or where the places do
    /// not fit together.
    pub const fn configuration(self) -> Option<Configuration> {
        use path_following::State as Following;
        match (self.local, self.following, self.teleoperation) {
            (local::State::Planning, _, _) => Some(Configuration::Planning),
            (local::State::Following, Following::Optimal, _) => {
                Some(Configuration::FollowingOptimal)
            }
            (local::State::Following, Following::Reduced, _) => {
                Some(Configuration::FollowingReduced)
            }
            (local::State::Following, Following::Odometric, _) => {
                Some(Configuration::FollowingOdometric)
            }
            (local::State::Following, Following::Reactive, _) => Some(Configuration::FollowingDvz),
            (local::State::Following, Following::Degraded, _) => {
                Some(Configuration::FollowingDegraded)
            }
            (local::State::Teleprogrammed, _, _) => Some(Configuration::Teleprogramming),
            (local::State::Teleoperated, _, teleoperation::State::Full) => {
                Some(Configuration::TeleoperationFull)
            }
            (local::State::Teleoperated, _, teleoperation::State::Degraded) => {
                Some(Configuration::TeleoperationDegraded)
            }
            _ => None,
        }
    }
}

impl Losses {
    /// Returns the health that the losses stand for, in modules and resources.
    pub const fn health(self) -> Health {
        let mut health = Health::SOUND;
        if self.has(Loss::Avoidance) {
            health.faulty = health.faulty.with(Module::Dvz);
        }
        if self.has(Loss::Smz) {
            health.faulty = health.faulty.with(Module::Smz);
        }
        if self.has(Loss::Mcl) {
            health.faulty = health.faulty.with(Module::Mcl);
        }
        if self.has(Loss::Sonar) {
            health.lost = health.lost.with(Resource::SonarArrays);
        }
        if self.has(Loss::Camera) {
            health.lost = health.lost.with(Resource::Camera);
        }
        if self.has(Loss::Wifi) {
            health.lost = health.lost.with(Resource::WifiCard);
        }
        if self.has(Loss::Vital) {
            health.lost = health.lost.with(Resource::Electronics);
        }
        health
    }

    /// The modules that are left.
    #[must_use]
    pub const fn available(self) -> Modules {
        self.health().available()
    }
}

impl Losses {
    /// Returns the losses reported to the shipped supervisors when only these modules are left,
    /// closed under the needs of modules: the functions of the others, and those that need them.
    /// The avoidance of path following is told apart only where the sonars are left. When no path
    /// following runs, nothing vital is left (inferred: the robot does not wait for an operator who
    /// would have to drive it all the way).
    ///
    /// ```
    /// use cotama_models::cotama::Module::{Dvz, Gui, Mcl, Smz, Ust};
    /// use cotama_models::cotama::{Losses, Modules, Resources, available};
    /// let left = |crashed: &[_]| available(Modules::of(crashed), Resources::NONE);
    /// let lacking = |crashed: &[_]| Losses::lacking(left(crashed)).to_string();
    /// assert_eq!(lacking(&[Mcl]), "mcl");
    /// assert_eq!(lacking(&[Smz]), "smz"); // neither the sonars nor localisation
    /// assert_eq!(lacking(&[Gui]), "-"); // it guides in PF.DVZ and PF.DEG
    /// assert_eq!(lacking(&[Ust]), "avoidance mcl sonar");
    /// assert_eq!(lacking(&[Gui, Smz]), "smz vital");
    /// assert_eq!(lacking(&[Dvz]), "avoidance"); // the operator's; path following has its own
    /// ```
    #[must_use]
    pub const fn lacking(left: Modules) -> Self {
        let mut lost = Self::NONE;
        let follows = Configuration::FollowingOptimal.runs_on(left)
            || Configuration::FollowingOdometric.runs_on(left)
            || Configuration::FollowingDvz.runs_on(left)
            || Configuration::FollowingDegraded.runs_on(left);
        if !left.has(Module::Dvz) {
            lost = lost.with(Loss::Avoidance);
        }
        if left.has(Module::Ust) && !left.has(Module::Smz) {
            lost = lost.with(Loss::Smz);
        }
        if !left.has(Module::Mcl) {
            lost = lost.with(Loss::Mcl);
        }
        if !left.has(Module::Ust) {
            lost = lost.with(Loss::Sonar);
        }
        if !left.has(Module::Cam) {
            lost = lost.with(Loss::Camera);
        }
        if !left.has(Module::Lan) {
            lost = lost.with(Loss::Wifi);
        }
        if !follows {
            lost = lost.with(Loss::Vital);
        }
        lost
    }

    /// Which path following the adapter starts with (the transitions of [`path_following`]).
    pub const fn following(self) -> Configuration {
        let (mcl, smz) = (!self.has(Loss::Mcl), !self.has(Loss::Smz));
        match (self.has(Loss::Sonar), smz) {
            (false, true) if mcl => Configuration::FollowingOptimal,
            (false, true) => Configuration::FollowingOdometric,
            (false, false) if mcl && !self.has(Loss::Avoidance) => Configuration::FollowingDvz,
            _ => Configuration::FollowingDegraded,
        }
    }

    /// Returns the losses to be withdrawn beside these, so that the adapter comes to the path
    /// following that a plan has chosen.
    ///
    /// ```
    /// use cotama_models::cotama::Configuration::{FollowingDegraded, FollowingDvz};
    /// use cotama_models::cotama::{Loss, Losses};
    /// let smz = Losses::of(&[Loss::Smz]);
    /// assert_eq!(Losses::NONE.beside(FollowingDvz), smz);
    /// assert_eq!(Losses::NONE.beside(FollowingDegraded), smz.with(Loss::Mcl));
    /// assert_eq!(smz.with(Loss::Avoidance).beside(FollowingDegraded), Losses::NONE);
    /// ```
    #[must_use]
    pub const fn beside(self, planned: Configuration) -> Self {
        if self.following() as u8 == planned as u8 {
            return Self::NONE;
        }
        match planned {
            Configuration::FollowingOdometric => Self::of(&[Loss::Mcl]),
            Configuration::FollowingDvz => Self::of(&[Loss::Smz]),
            Configuration::FollowingDegraded => Self::of(&[Loss::Smz, Loss::Mcl]),
            _ => Self::NONE,
        }
    }
}

impl From<Health> for Losses {
    /// Returns the losses that the supervisors see in a state of health. Losses are independent:
    /// lost sonars are no lost localisation.
    fn from(health: Health) -> Self {
        let Health { faulty, lost, .. } = health;
        let following = Configuration::FollowingDegraded.facts().required;
        let gone = [
            (Loss::Avoidance, faulty.has(Module::Dvz)),
            (Loss::Smz, faulty.has(Module::Smz)),
            (Loss::Mcl, faulty.has(Module::Mcl) || lost.has(Resource::Map)),
            (
                Loss::Sonar,
                lost.has(Resource::SonarArrays)
                    || faulty.has(Module::Ust)
                    || faulty.has(Module::Sim),
            ),
            (Loss::Camera, faulty.has(Module::Cam) || lost.has(Resource::Camera)),
            (Loss::Wifi, !health.available().has(Module::Lan)),
            (Loss::Vital, !health.available().covers(following)),
        ];
        gone.into_iter().filter(|it| it.1).fold(Self::NONE, |set, it| set.with(it.0))
    }
}
