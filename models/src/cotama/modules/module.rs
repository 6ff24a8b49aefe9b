//! The modules of the executive level (Durand et al., TAROS 2010, Sections II.B and IV.B, Figs. 1
//! and 2; what is not stated there carries its label in [`MODULES`](crate::cotama::MODULES)).

use super::resources::Resources;
use crate::cotama::label::Label;
use crate::cotama::members::members;

members! {
    /// A module. The order is topological: each one after those that it needs.
    Module,
    /// Modules.
    Modules(u32) {
        /// Scheduler, and observer of real-time faults.
        Sch = "SCH",
        /// Global observation module: collects flags, diagnoses, keeps the status vector.
        Gom = "GOM",
        /// Link to the robot's micro-controller.
        P3d = "P3D",
        /// Hardware in the loop: makes the sonar values.
        Sim = "SIM",
        /// Sonar values made usable.
        Ust = "UST",
        /// Monte Carlo localisation.
        Mcl = "MCL",
        /// Odometric pose.
        Odo = "ODO",
        /// Navigation: selection of the pose, control law.
        Nav = "NAV",
        /// The asymptotic control law with saturation of the actuators.
        Ctr = "CTR",
        /// Path planning.
        Ppl = "PPL",
        /// Guidance: path following alone.
        Gui = "GUI",
        /// Safe manoeuvring zone: avoidance and guidance in one.
        Smz = "SMZ",
        /// Deformable virtual zone: reactive avoidance.
        Dvz = "DVZ",
        /// The wireless link to the operator.
        Lan = "LAN",
        /// Camera stream for the operator.
        Cam = "CAM",
        /// Observer of sensor data.
        OSen = "O-SEN",
        /// Observer of motors and wheels.
        OEff = "O-EFF",
        /// Observer of the link to the operator.
        OCom = "O-COM",
        /// Observer of localisation.
        OLoc = "O-LOC",
        /// Observer of path following.
        OPf = "O-PF",
    }
}

/// The kind of a module, in the terms of the architecture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Handles data or hardware.
    Functional,
    /// Computes poses, paths or commands.
    Control,
    /// Raises flags.
    Observer,
    /// Turns flags into a diagnosis for the decisional level.
    Diagnosis,
}

/// The facts of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModuleFacts {
    /// The module.
    pub module: Module,
    /// Kind of the module.
    pub kind: Kind,
    /// Function of the module, in words.
    pub function: &'static str,
    /// Resources it needs, all of them.
    pub hardware: Resources,
    /// Modules it needs, all of them.
    pub needs: Modules,
    /// Modules of which it needs one; none when empty.
    pub needs_one_of: Modules,
    /// The module of which it is a part in the published module sets (inferred).
    pub part_of: Option<Module>,
    /// How well its existence and function are known.
    pub label: Label,
    /// How well its needs are known.
    pub needs_label: Label,
}
