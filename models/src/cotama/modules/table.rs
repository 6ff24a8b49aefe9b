//! The table of modules, one row each, and which modules are available after faults.

use super::module::Kind::{Control, Diagnosis, Functional, Observer};
use super::module::Module::{self, Gui, Lan, Nav, P3d, Sim, Smz, Ust};
use super::module::{Kind, ModuleFacts, Modules};
use super::resources::Resource::{
    AccessPoint, Battery, Camera, Electronics, Encoders, LaptopCpu, Map, Motors, SerialLink,
    SonarArrays, WifiCard,
};
use super::resources::{Resource, Resources};
use crate::cotama::label::Label::{self, Inferred, Stated};

/// The facts of each module, in the order of [`Module`].
///
/// Stated is what Durand et al., TAROS 2010, say in their text, their Table I and their two module
/// sets. NAV is in both sets and is nowhere defined; ODO and CTR are defined and are in no set:
/// they are taken as parts of NAV (inferred). The rows are those of the experiment, with hardware
/// in the loop: SIM stands for the sonars, and goes with them.
pub const MODULES: [ModuleFacts; Module::ALL.len()] = [
    module(
        Module::Sch,
        Functional,
        "runs the modules in their periods and watches their deadlines",
        Stated,
    )
    .stands_on(&[LaptopCpu], &[], Stated),
    module(
        Module::Gom,
        Diagnosis,
        "collects flags, diagnoses, keeps the module status vector",
        Stated,
    ),
    module(
        Module::P3d,
        Functional,
        "sensor values in, motor commands out; sees bumpers, battery, stall",
        Stated,
    )
    .stands_on(&[Electronics, SerialLink, Battery], &[], Stated),
    module(
        Module::Sim,
        Functional,
        "makes the sonar values; odometry and bumpers are real",
        Stated,
    )
    .stands_on(&[SonarArrays], &[P3d], Inferred),
    module(Module::Ust, Functional, "makes raw sonar values usable by the algorithms", Stated)
        .stands_on(&[SonarArrays], &[P3d, Sim], Stated),
    module(Module::Mcl, Control, "Monte Carlo localisation", Stated).stands_on(
        &[Map],
        &[Ust, P3d],
        Stated,
    ),
    module(Module::Odo, Control, "odometric pose", Stated)
        .stands_on(&[Encoders], &[P3d], Stated)
        .part_of(Nav),
    module(
        Module::Nav,
        Control,
        "selects the pose, and holds odometry and the control law",
        Inferred,
    )
    .stands_on(&[Encoders, Motors], &[P3d], Inferred),
    module(Module::Ctr, Control, "asymptotic control law with saturation of the actuators", Stated)
        .stands_on(&[], &[Nav], Inferred)
        .part_of(Nav),
    module(Module::Ppl, Control, "path planning (Lazy PRM)", Stated).stands_on(
        &[Map],
        &[Nav],
        Inferred,
    ),
    module(Module::Gui, Control, "guidance: path following alone", Stated).stands_on(
        &[],
        &[Nav],
        Stated,
    ),
    module(Module::Smz, Control, "safe manoeuvring zone: avoidance and guidance in one", Stated)
        .stands_on(&[], &[Ust, Nav], Stated),
    module(Module::Dvz, Control, "deformable virtual zone: reactive avoidance", Stated).stands_on(
        &[],
        &[Ust],
        Inferred,
    ),
    module(Module::Lan, Functional, "WiFi to the operator's computer", Stated).stands_on(
        &[WifiCard, AccessPoint],
        &[],
        Stated,
    ),
    module(Module::Cam, Functional, "camera stream for the operator", Inferred).stands_on(
        &[Camera],
        &[Lan],
        Stated,
    ),
    module(
        Module::OSen,
        Observer,
        "interval checks on sensor data, timing checks on the sonars",
        Stated,
    )
    .stands_on(&[], &[P3d], Inferred),
    module(Module::OEff, Observer, "multiple-model Kalman filter on motors and wheels", Stated)
        .stands_on(&[Encoders], &[P3d], Stated),
    module(Module::OCom, Observer, "interval checks on link, level and noise of the WiFi", Stated)
        .stands_on(&[WifiCard], &[Lan], Stated),
    module(
        Module::OLoc,
        Observer,
        "distance of odometric and MCL pose and its growth, interval checks",
        Stated,
    )
    .stands_on(&[], &[Nav], Inferred),
    module(
        Module::OPf,
        Observer,
        "coherence of path following: backward too long, no convergence",
        Stated,
    )
    .stands_on(&[], &[Nav], Stated)
    .needs_one_of(&[Gui, Smz]),
];

const fn module(module: Module, kind: Kind, function: &'static str, label: Label) -> ModuleFacts {
    ModuleFacts {
        module,
        kind,
        function,
        hardware: Resources::NONE,
        needs: Modules::NONE,
        needs_one_of: Modules::NONE,
        part_of: None,
        label,
        needs_label: Stated,
    }
}

impl ModuleFacts {
    const fn stands_on(mut self, hardware: &[Resource], needs: &[Module], label: Label) -> Self {
        (self.hardware, self.needs) = (Resources::of(hardware), Modules::of(needs));
        self.needs_label = label;
        self
    }

    const fn needs_one_of(mut self, alternatives: &[Module]) -> Self {
        self.needs_one_of = Modules::of(alternatives);
        self
    }

    const fn part_of(mut self, whole: Module) -> Self {
        self.part_of = Some(whole);
        self
    }
}

impl Module {
    /// Returns the facts of the module.
    pub const fn facts(self) -> &'static ModuleFacts {
        &MODULES[self as usize]
    }
}

/// The modules that are available: not faulty themselves, all their resources sound, all modules
/// they need available (rule of closure, inferred). Without the scheduler none is, since it runs
/// them all (inferred).
///
/// ```
/// use cotama_models::cotama::Resource::SonarArrays;
/// use cotama_models::cotama::{Modules, Resources, available};
/// // Stated: with the sonars go UST, MCL and SMZ, and SIM is useless. Inferred: DVZ goes too. The
/// // observers O-SEN and O-LOC go on with what is left to observe.
/// let left = available(Modules::NONE, Resources::of(&[SonarArrays]));
/// assert_eq!(Modules::ALL.without(left).to_string(), "SIM UST MCL SMZ DVZ");
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
    while at < MODULES.len() {
        let it = &MODULES[at];
        assert!(it.module as usize == at, "MODULES must be in the order of the enum Module");
        assert!(
            before.covers(it.needs) && before.covers(it.needs_one_of),
            "a module needs itself or a later one: a cycle, or Module is not in topological order"
        );
        assert!(it.needs_one_of.len() != 1, "one alternative is a plain need");
        before = before.with(it.module);
        at += 1;
    }
};
