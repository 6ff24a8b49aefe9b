//! The modules of the executive level, and which of them are available after faults (Durand et al.,
//! TAROS 2010, Section III, Figs. 1 and 2; what is not stated there carries its label in
//! [`MODULES`]).

use super::members::{differ, members};
use super::ports::{Data, ModuleEvents, Parameter};
use super::resources::Resources;
use super::{Label, module_table::MODULES};

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

/// What a module is, in the terms of the architecture.
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

/// What is known of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModuleFacts {
    /// The module.
    pub module: Module,
    /// What it is.
    pub kind: Kind,
    /// What it does.
    pub function: &'static str,
    /// Data it consumes (inferred).
    pub inputs: Data,
    /// Data it produces (inferred).
    pub outputs: Data,
    /// Events it sends to the decisional level (inferred).
    pub events: ModuleEvents,
    /// Settings.
    pub parameters: &'static [Parameter],
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

impl Module {
    /// What is known of it.
    pub const fn facts(self) -> &'static ModuleFacts {
        &MODULES[self as usize]
    }
}

/// The modules that are available: not faulty themselves, all their resources sound, all modules
/// they need available (rule of closure, inferred). Without the scheduler none is, since it runs
/// them all (inferred).
///
/// ```
/// use cotama_models::cotama::{Module::{Dvz, Mcl, Sim, Smz, Ust}, Modules, Resource::SonarArrays, Resources, available};
/// // Stated: with the sonars go UST, MCL and SMZ, and SIM is useless. Inferred: DVZ goes too. The observers O-SEN and
/// // O-LOC lose what they observe.
/// let left = available(Modules::NONE, Resources::of(&[SonarArrays]));
/// assert!(left.common(Modules::of(&[Sim, Ust, Mcl, Smz, Dvz])).is_empty());
/// assert_eq!(Modules::ALL.without(left).to_string(), "SIM UST MCL SMZ DVZ O-SEN O-LOC");
/// ```
#[must_use]
pub const fn available(faulty: Modules, lost: Resources) -> Modules {
    let (mut available, mut at) = (Modules::NONE, 0);
    while at < MODULES.len() {
        let it = &MODULES[at];
        let runs = matches!(it.module, Module::Sch) || available.has(Module::Sch);
        let one_of = it.needs_one_of.is_empty() || !it.needs_one_of.common(available).is_empty();
        let sound = !faulty.has(it.module) && it.hardware.common(lost).is_empty();
        if runs && sound && one_of && available.covers(it.needs) {
            available = available.with(it.module);
        }
        at += 1;
    }
    available
}

// The table is in the order of the enum, and the order is topological, so that one pass closes;
// hence no cycle of needs.
const _: () = {
    assert!(MODULES.len() == Module::ALL.len(), "each module needs one row of MODULES");
    let (mut before, mut at) = (Modules::NONE, 0);
    let (mut made, mut wanted) = (Data::NONE, Data::NONE);
    while at < MODULES.len() {
        let it = &MODULES[at];
        assert!(it.module as usize == at, "MODULES must be in the order of the enum Module");
        assert!(
            before.covers(it.needs) && before.covers(it.needs_one_of),
            "a module needs itself or a later one: a cycle, or Module is not in topological order"
        );
        assert!(it.needs_one_of.len() != 1, "one alternative is a plain need");
        let mut names = [""; 8];
        let mut parameter = 0;
        while parameter < it.parameters.len() {
            let set = &it.parameters[parameter];
            assert!(
                set.low <= set.initial && set.initial <= set.high,
                "the initial value of a parameter is not in its range"
            );
            names[parameter] = set.name;
            assert!(
                differ(names.split_at(parameter + 1).0),
                "two parameters of one module have the same name"
            );
            parameter += 1;
        }
        before = before.with(it.module);
        made = made.union(it.outputs);
        wanted = wanted.union(it.inputs);
        at += 1;
    }
    assert!(made.covers(wanted), "a module consumes data that none produces");
    assert!(made.is(Data::ALL), "a kind of data is produced by no module");
};
