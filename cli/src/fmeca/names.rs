//! Sets, as lists of names.

use cotama_models::cotama::{
    FailureMode, FailureModes, Flag, Flags, Module, Modules, Probe, Probes,
};

/// The names of failure modes.
pub(crate) fn modes(set: FailureModes) -> Vec<&'static str> {
    set.iter().map(FailureMode::name).collect()
}

/// The names of flags.
pub(crate) fn flags(set: Flags) -> Vec<&'static str> {
    set.iter().map(Flag::name).collect()
}

/// The names of modules.
pub(crate) fn modules(set: Modules) -> Vec<&'static str> {
    set.iter().map(Module::name).collect()
}

/// The names of probes.
pub(crate) fn probes(set: Probes) -> Vec<&'static str> {
    set.iter().map(Probe::name).collect()
}
