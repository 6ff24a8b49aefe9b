//! The flags that observers raise: one for each detection of the FMECA.

use crate::cotama::members::members;
use crate::cotama::modules::{Module, Modules};

members! {
    /// Something an observer saw.
    Flag,
    /// Flags.
    Flags(u64) {
        /// O-SEN: a sonar at its largest range for long while the robot moves.
        SonarFar = "sonar far",
        /// O-SEN: no fresh range.
        SonarSilent = "sonar silent",
        /// O-SEN: a sonar at one short range while the robot moves.
        SonarNear = "sonar near",
        /// O-SEN: many readings rejected.
        SonarOutliers = "sonar outliers",
        /// O-SEN: the sonars see free space where the bumper is closed.
        FreeAhead = "free ahead",
        /// O-SEN: no camera frame.
        NoFrame = "no frame",
        /// O-COM or O-SEN: camera frames come late.
        OldFrame = "old frame",
        /// O-SEN, O-LOC or O-PF, for any module: a value out of its interval.
        ValueOutside = "value outside",
        /// O-EFF: the filter's residual says that wheel and encoder disagree.
        WheelResidual = "wheel residual",
        /// O-EFF: a residual that went back to normal.
        WheelPeak = "wheel peak",
        /// O-EFF: a wheel does not follow its command.
        WheelDisobeys = "wheel disobeys",
        /// O-EFF: the estimated gain of an actuator is low.
        WheelGain = "wheel gain",
        /// O-EFF or P3D: speed above the limit, or against the command.
        Runaway = "runaway",
        /// O-LOC: odometric and MCL pose are far apart.
        PoseDistance = "pose distance",
        /// O-LOC: odometric and MCL pose move apart quickly.
        PoseGrowth = "pose growth",
        /// O-LOC: odometric and MCL pose moved apart for a moment.
        PosePeak = "pose peak",
        /// O-LOC: odometric and MCL pose move apart slowly, always the same way.
        SlowDrift = "slow drift",
        /// O-LOC: a pose jumped.
        PoseJump = "pose jump",
        /// O-LOC: the particles are spread wide.
        Spread = "spread",
        /// O-PF: backward for too long.
        Backward = "backward",
        /// O-PF: the path error does not converge.
        NoConvergence = "no convergence",
        /// O-PF: hardly any progress.
        NoProgress = "no progress",
        /// O-COM: no link, no heartbeat.
        LinkDown = "link down",
        /// O-COM: level or noise out of its interval.
        LinkPoor = "link poor",
        /// P3D: a bumper is closed.
        Bumper = "bumper",
        /// P3D: the motors stall.
        Stall = "stall",
        /// P3D: the emergency button.
        EmergencyStop = "emergency stop",
        /// P3D: low voltage.
        BatteryLow = "battery low",
        /// P3D: critical voltage.
        BatteryCritical = "battery critical",
        /// P3D: no packet from the robot.
        PacketSilence = "packet silence",
        /// P3D: many checksum errors.
        PacketErrors = "packet errors",
        /// P3D: the packet sequence starts anew.
        SequenceRestart = "sequence restart",
        /// SCH: MCL missed several deadlines in a row.
        MclLate = "MCL late",
        /// SCH: one job was late, inside its extra time.
        OneLate = "one late",
        /// SCH: another module missed several deadlines in a row.
        ModuleLate = "module late",
        /// SCH: a module completes nothing any more.
        ModuleSilent = "module silent",
        /// PPL: the planner failed or timed out.
        PlanFailed = "plan failed",
        /// The contextual supervisor's timer: the operator does not answer.
        OperatorSilent = "operator silent",
        /// On the operator's side: no heartbeat from the robot.
        RobotSilent = "robot silent",
    }
}

impl Flag {
    /// The modules of which each one can raise it (stated for the observers, Durand et al., TAROS
    /// 2010, Section IV.B.3; who raises which flag is inferred); none for what a supervisor's timer
    /// or the operator's side sees.
    #[must_use]
    pub const fn observers(self) -> Modules {
        Modules::of(match self {
            Self::SonarFar
            | Self::SonarSilent
            | Self::SonarNear
            | Self::SonarOutliers
            | Self::FreeAhead
            | Self::NoFrame => &[Module::OSen],
            Self::OldFrame => &[Module::OCom, Module::OSen],
            Self::ValueOutside => &[Module::OSen, Module::OLoc, Module::OPf],
            Self::WheelResidual | Self::WheelPeak | Self::WheelDisobeys | Self::WheelGain => {
                &[Module::OEff]
            }
            Self::Runaway => &[Module::OEff, Module::P3d],
            Self::PoseDistance
            | Self::PoseGrowth
            | Self::PosePeak
            | Self::SlowDrift
            | Self::PoseJump
            | Self::Spread => &[Module::OLoc],
            Self::Backward | Self::NoConvergence | Self::NoProgress => &[Module::OPf],
            Self::LinkDown | Self::LinkPoor => &[Module::OCom],
            Self::Bumper
            | Self::Stall
            | Self::EmergencyStop
            | Self::BatteryLow
            | Self::BatteryCritical
            | Self::PacketSilence
            | Self::PacketErrors
            | Self::SequenceRestart => &[Module::P3d],
            Self::MclLate | Self::OneLate | Self::ModuleLate | Self::ModuleSilent => &[Module::Sch],
            Self::PlanFailed => &[Module::Ppl],
            Self::OperatorSilent | Self::RobotSilent => &[],
        })
    }
}

impl Flag {
    /// The modules whose data the check looks at, all of them: without one there is nothing to
    /// check, and the other checks of its observer go on (inferred; Durand et al., TAROS 2010,
    /// Section IV.B.3, name what each observer checks, and the timing checks apart).
    ///
    /// ```
    /// use cotama_models::cotama::{Flag, Flags, Resource, Resources, Modules, available};
    /// // Sonars are lost: nobody checks them, and the camera is watched as before.
    /// let left = available(Modules::NONE, Resources::of(&[Resource::SonarArrays]));
    /// let seen = Flags::seen_by(left);
    /// assert!(!seen.has(Flag::SonarFar) && seen.has(Flag::NoFrame));
    /// ```
    #[must_use]
    pub const fn observed(self) -> Modules {
        Modules::of(match self {
            Self::SonarFar
            | Self::SonarSilent
            | Self::SonarNear
            | Self::SonarOutliers
            | Self::FreeAhead => &[Module::Ust],
            Self::PoseDistance
            | Self::PoseGrowth
            | Self::PosePeak
            | Self::SlowDrift
            | Self::Spread => &[Module::Mcl],
            _ => &[],
        })
    }

    /// Whether it can be raised while these modules are available.
    #[must_use]
    pub const fn is_seen_by(self, available: Modules) -> bool {
        let observers = self.observers();
        available.covers(self.observed())
            && (observers.is_empty() || !observers.common(available).is_empty())
    }
}

impl Flags {
    /// Returns the flags that can be raised while these modules are available.
    #[must_use]
    pub const fn seen_by(available: Modules) -> Self {
        let (mut seen, mut at) = (Self::NONE, 0);
        while at < Flag::ALL.len() {
            if Flag::ALL[at].is_seen_by(available) {
                seen = seen.with(Flag::ALL[at]);
            }
            at += 1;
        }
        seen
    }
}
