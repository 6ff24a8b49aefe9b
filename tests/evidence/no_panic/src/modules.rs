//! The roots of what is known of modules and configurations: facts, health and load; and of what
//! requirements ask of a system of nets.
//!
//! A system comes as its caller can make it at worst: with any lists, and numbers of nothing.

use cotama_core::executive::Task;
use cotama_core::system::System;
use cotama_models::cotama::load::{self, Load, MOST};
use cotama_models::cotama::{
    Configuration, ConfigurationFacts, Guarded, Health, Module, ModuleFacts, Modules, Said, Status,
    StatusVector,
};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_module_facts(module: Module) -> &'static ModuleFacts {
    module.facts()
}

#[unsafe(no_mangle)]
fn root_configuration_facts(of: Configuration) -> &'static ConfigurationFacts {
    of.facts()
}

#[unsafe(no_mangle)]
fn root_configuration_runs_on(of: Configuration, available: Modules) -> bool {
    of.runs_on(available)
}

#[unsafe(no_mangle)]
fn root_configuration_scheduled(of: Configuration) -> Modules {
    of.scheduled()
}

#[unsafe(no_mangle)]
fn root_health_joined(one: Health, other: Health) -> (Health, Modules) {
    (one.union(other), one.available())
}

#[unsafe(no_mangle)]
fn root_status_vector(of: StatusVector, module: Module) -> (Status, Modules, Modules) {
    (of.of(module), of.available(), of.suspect())
}

#[unsafe(no_mangle)]
fn root_load_tasks(
    configuration: Configuration,
    load: Load,
    particles: u32,
    memory: &mut [Task; MOST],
) -> &[Task] {
    load::tasks(configuration, load, particles, memory)
}

#[unsafe(no_mangle)]
fn root_requirement_guarded<'s>(of: Guarded, system: &System<'s>) -> Option<&'s str> {
    of.unguarded(system).last()
}

#[unsafe(no_mangle)]
fn root_requirement_said<'s>(of: Said, system: &System<'s>) -> Option<&'s str> {
    of.unsaid(system).last()
}
