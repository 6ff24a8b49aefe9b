//! Which modules run together for a sub-objective, from the best set to the most degraded.

use super::module::Module::{self, Cam, Dvz, Gui, Lan, Mcl, Nav, P3d, Ppl, Sim, Smz, Ust};
use super::module::{Kind, ModuleFacts, Modules};
use super::resources::Resources;
use super::table::available;
use crate::cotama::label::Label::{self, Assumed, Inferred, Stated};
use crate::cotama::members::members;
use cotama_core::units::MillimetresPerSecond;

members! {
    /// A set of modules that serves one sub-objective in one autonomy mode.
    Configuration,
    /// Configurations.
    Configurations(u16) {
        /// Path planning.
        Planning = "PP",
        /// Path following, optimal.
        FollowingOptimal = "PF.OPT",
        /// The same with fewer particles.
        FollowingReduced = "PF.OPTR",
        /// Path following by odometry, with avoidance.
        FollowingOdometric = "PF.ODO",
        /// Path following without avoidance and localisation, slower.
        FollowingDegraded = "PF.DEG",
        /// Path following with the other avoidance.
        FollowingDvz = "PF.DVZ",
        /// The robot stands; the operator edits way-points or a path.
        Teleprogramming = "TP",
        /// Teleoperation with avoidance.
        TeleoperationFull = "TO.FULL",
        /// Teleoperation without.
        TeleoperationDegraded = "TO.DEG",
        /// Stop, alarm, warning.
        Security = "SEC",
    }
}

/// The purpose of a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SubObjective {
    /// A path is wanted.
    Planning,
    /// A path is followed.
    Following,
    /// The operator edits.
    Teleprogramming,
    /// The operator drives.
    Teleoperation,
    /// The robot is made safe.
    Security,
}

/// The autonomy mode: the decider of the robot's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// Nobody: there is no drive.
    Rest,
    /// The robot.
    Autonomous,
    /// Nobody yet: the robot stands and has asked.
    HandOver,
    /// The operator, by way-points; the robot stands.
    Teleprogrammed,
    /// The operator, by hand.
    Teleoperated,
}

impl Mode {
    /// All modes.
    pub const ALL: [Self; 5] =
        [Self::Rest, Self::Autonomous, Self::HandOver, Self::Teleprogrammed, Self::Teleoperated];

    /// Returns the name in traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Autonomous => "autonomous",
            Self::HandOver => "hand-over",
            Self::Teleprogrammed => "teleprogrammed",
            Self::Teleoperated => "teleoperated",
        }
    }
}

/// The facts of a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConfigurationFacts {
    /// The configuration.
    pub configuration: Configuration,
    /// Purpose of the configuration.
    pub sub_objective: SubObjective,
    /// Autonomy mode.
    pub mode: Mode,
    /// Modules without which it cannot run.
    pub required: Modules,
    /// Modules that it uses when they are there.
    pub optional: Modules,
    /// How degraded it is among those of its sub-objective: 0 is the best.
    pub rank: u8,
    /// The fastest it may go.
    pub speed: MillimetresPerSecond,
    /// How well its modules are known.
    pub label: Label,
    /// How well its speed is known.
    pub speed_label: Label,
}

/// The speed of the experiment (stated, Durand et al., TAROS 2010, Section VI).
pub const FULL_SPEED: MillimetresPerSecond = MillimetresPerSecond(300);
/// The speed without avoidance; that it is lower is stated, the number is assumed.
pub const DEGRADED_SPEED: MillimetresPerSecond = MillimetresPerSecond(150);
const NO_SPEED: MillimetresPerSecond = MillimetresPerSecond(0);

/// The facts of each configuration, in the order of [`Configuration`].
///
/// Stated are PF.OPT and PF.DEG as sets, the reduction of particles, and in words teleoperation
/// without avoidance and security. LAN is optional where nobody is asked (inferred). PF.DVZ is
/// ranked behind the set with fewer particles (assumed).
#[rustfmt::skip]
pub const CONFIGURATIONS: [ConfigurationFacts; Configuration::ALL.len()] = {
    use Configuration as C;
    use Mode::{Autonomous, Rest, Teleoperated, Teleprogrammed};
    use SubObjective as S;
    [
        row(C::Planning, S::Planning, Autonomous, 0)
            .modules(&[P3d, Nav, Ppl], &[Lan], Inferred)
            .speed(NO_SPEED, Inferred),
        row(C::FollowingOptimal, S::Following, Autonomous, 0)
            .modules(&[P3d, Sim, Ust, Mcl, Nav, Smz], &[Lan], Stated)
            .speed(FULL_SPEED, Stated),
        row(C::FollowingReduced, S::Following, Autonomous, 1)
            .modules(&[P3d, Sim, Ust, Mcl, Nav, Smz], &[Lan], Stated)
            .speed(FULL_SPEED, Stated),
        row(C::FollowingOdometric, S::Following, Autonomous, 3)
            .modules(&[P3d, Sim, Ust, Nav, Smz], &[Lan], Inferred)
            .speed(FULL_SPEED, Assumed),
        row(C::FollowingDegraded, S::Following, Autonomous, 4)
            .modules(&[P3d, Nav, Gui], &[Lan], Stated)
            .speed(DEGRADED_SPEED, Assumed),
        row(C::FollowingDvz, S::Following, Autonomous, 2)
            .modules(&[P3d, Sim, Ust, Mcl, Nav, Dvz, Gui], &[Lan], Inferred)
            .speed(FULL_SPEED, Assumed),
        row(C::Teleprogramming, S::Teleprogramming, Teleprogrammed, 0)
            .modules(&[P3d, Nav, Lan], &[Cam, Ppl], Inferred)
            .speed(NO_SPEED, Inferred),
        row(C::TeleoperationFull, S::Teleoperation, Teleoperated, 0)
            .modules(&[P3d, Sim, Ust, Dvz, Nav, Cam, Lan], &[], Inferred)
            .speed(FULL_SPEED, Assumed),
        row(C::TeleoperationDegraded, S::Teleoperation, Teleoperated, 1)
            .modules(&[P3d, Nav, Cam, Lan], &[], Inferred)
            .speed(DEGRADED_SPEED, Assumed),
        row(C::Security, S::Security, Rest, 0)
            .modules(&[P3d], &[Lan], Stated)
            .speed(NO_SPEED, Stated),
    ]
};

const fn row(
    configuration: Configuration,
    sub_objective: SubObjective,
    mode: Mode,
    rank: u8,
) -> ConfigurationFacts {
    ConfigurationFacts {
        configuration,
        sub_objective,
        mode,
        required: Modules::NONE,
        optional: Modules::NONE,
        rank,
        speed: NO_SPEED,
        label: Inferred,
        speed_label: Inferred,
    }
}

impl ConfigurationFacts {
    const fn modules(mut self, required: &[Module], optional: &[Module], label: Label) -> Self {
        (self.required, self.optional) = (Modules::of(required), Modules::of(optional));
        self.label = label;
        self
    }

    const fn speed(mut self, speed: MillimetresPerSecond, label: Label) -> Self {
        (self.speed, self.speed_label) = (speed, label);
        self
    }
}

impl Configuration {
    /// Returns the facts of the configuration.
    pub const fn facts(self) -> &'static ConfigurationFacts {
        &CONFIGURATIONS[self as usize]
    }

    /// Whether the modules that it requires are available.
    ///
    /// ```
    /// use cotama_models::cotama::Resource::SonarArrays;
    /// use cotama_models::cotama::{Configuration, Modules, Resources, available};
    /// let left = available(Modules::NONE, Resources::of(&[SonarArrays]));
    /// assert!(!Configuration::FollowingOdometric.runs_on(left));
    /// assert!(Configuration::FollowingDegraded.runs_on(left));
    /// ```
    pub const fn runs_on(self, available: Modules) -> bool {
        available.covers(self.facts().required)
    }

    /// The modules that the scheduler runs under it: those that it requires or may use, the GOM,
    /// and every observer that has what it observes (inferred).
    ///
    /// ```
    /// use cotama_models::cotama::Configuration::{FollowingDegraded, FollowingOptimal};
    /// assert_eq!(
    ///     FollowingOptimal.scheduled().to_string(),
    ///     "GOM P3D SIM UST MCL NAV SMZ LAN O-SEN O-EFF O-COM O-LOC O-PF"
    /// );
    /// assert_eq!(
    ///     FollowingDegraded.scheduled().to_string(),
    ///     "GOM P3D NAV GUI LAN O-SEN O-EFF O-COM O-LOC O-PF"
    /// );
    /// ```
    pub const fn scheduled(self) -> Modules {
        let facts = self.facts();
        let (set, mut at) = (facts.required.union(facts.optional), 0);
        let mut scheduled = set.with(Module::Gom);
        while at < Module::ALL.len() {
            let it = Module::ALL[at].facts();
            if matches!(it.kind, Kind::Observer) && lacks(it, set).is_empty() {
                scheduled = scheduled.with(it.module);
            }
            at += 1;
        }
        scheduled
    }

    /// Returns the configurations that run on the available modules.
    pub const fn running_on(available: Modules) -> Configurations {
        let (mut set, mut at) = (Configurations::NONE, 0);
        while at < Self::ALL.len() {
            if Self::ALL[at].runs_on(available) {
                set = set.with(Self::ALL[at]);
            }
            at += 1;
        }
        set
    }
}

/// Returns the modules that a module needs and a set does not hold.
const fn lacks(it: &ModuleFacts, set: Modules) -> Modules {
    let all = it.needs.without(set);
    if it.needs_one_of.common(set).is_empty() { all.union(it.needs_one_of) } else { all }
}

/// The modules that a set needs and does not hold. The scheduler and the GOM run under every set
/// and are listed in none.
const fn missing(set: Modules) -> Modules {
    let (mut missing, mut at) = (Modules::NONE, 0);
    while at < Module::ALL.len() {
        let it = Module::ALL[at].facts();
        if set.has(it.module) {
            missing = missing.union(lacks(it, set));
        }
        at += 1;
    }
    missing
}

const _: () = {
    let mut at = 0;
    while at < CONFIGURATIONS.len() {
        let it = &CONFIGURATIONS[at];
        assert!(
            it.configuration as usize == at,
            "CONFIGURATIONS must be in the order of the enum Configuration"
        );
        assert!(
            it.required.common(it.optional).is_empty(),
            "a module is required and optional in one configuration"
        );
        assert!(
            missing(it.required).is_empty(),
            "a configuration requires a module, but not the modules that it needs"
        );
        assert!(
            missing(it.required.union(it.optional)).is_empty(),
            "an optional module of a configuration needs one that is in neither list"
        );
        assert!(
            it.configuration.runs_on(available(Modules::NONE, Resources::NONE)),
            "a configuration cannot run on a sound robot"
        );
        let mut other = 0;
        while other < at {
            let before = &CONFIGURATIONS[other];
            assert!(
                before.sub_objective as u8 != it.sub_objective as u8 || before.rank != it.rank,
                "two configurations of one sub-objective have the same rank"
            );
            other += 1;
        }
        at += 1;
    }
};
