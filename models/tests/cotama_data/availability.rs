//! The status vector is closed and monotone.

use cotama_models::cotama::{
    Configuration, Configurations, Health, MODULES, Module, Modules, Resource, Resources, Status,
    available,
};
use proptest::prelude::*;

fn assert_closed(left: Modules, faulty: Modules, lost: Resources) {
    for it in left.iter().map(Module::facts) {
        assert!(left.covers(it.needs), "{} without what it needs", it.module.name());
        assert!(it.needs_one_of.is_empty() || !it.needs_one_of.common(left).is_empty());
        assert!(!faulty.has(it.module) && it.hardware.common(lost).is_empty());
    }
}

/// A single or double loss: of modules, resources, or one of each.
fn small_losses() -> Vec<(Modules, Resources)> {
    let modules = Module::ALL.iter().map(|&it| (Modules::of(&[it]), Resources::NONE));
    let resources = Resource::ALL.iter().map(|&it| (Modules::NONE, Resources::of(&[it])));
    let singles: Vec<_> = modules.chain(resources).collect();
    singles.iter().flat_map(|a| singles.iter().map(|b| (a.0.union(b.0), a.1.union(b.1)))).collect()
}

/// GM1, GM2 over all single and double losses.
#[test]
fn one_or_two_losses_leave_a_closed_set_that_only_shrinks() {
    let losses = small_losses();
    assert_eq!(losses.len(), (20 + 12) * (20 + 12));
    for &(faulty, lost) in &losses {
        let left = available(faulty, lost);
        assert_closed(left, faulty, lost);
        for more in Resource::ALL {
            assert!(left.covers(available(faulty, lost.with(*more))));
        }
        for more in Module::ALL {
            assert!(left.covers(available(faulty.with(*more), lost)));
        }
    }
}

fn modules() -> impl Strategy<Value = Modules> {
    (0..=Modules::ALL.bits()).prop_map(|bits| Modules::from_bits(bits).unwrap())
}

fn resources() -> impl Strategy<Value = Resources> {
    (0..=Resources::ALL.bits()).prop_map(|bits| Resources::from_bits(bits).unwrap())
}

proptest! {
    /// GM1, GM2 beyond two losses.
    #[test]
    fn any_losses_leave_a_closed_set_that_only_shrinks(
        (faulty, more_faulty) in (modules(), modules()),
        (lost, more_lost) in (resources(), resources()),
    ) {
        let left = available(faulty, lost);
        assert_closed(left, faulty, lost);
        prop_assert!(left.covers(available(faulty.union(more_faulty), lost.union(more_lost))));
    }

    #[test]
    fn every_module_has_one_status(
        faulty in modules(),
        lost in resources(),
        suspected in modules(),
    ) {
        let status = Health { faulty, lost, suspected }.status_vector();
        for &module in Module::ALL {
            let of = status.of(module);
            prop_assert_eq!(of != Status::Unavailable, status.available().has(module));
            prop_assert_eq!(of == Status::Suspect, status.suspect().has(module));
        }
        prop_assert!(status.available().covers(status.suspect()));
    }
}

#[test]
fn a_sound_robot_has_every_module_and_every_configuration() {
    let left = Health::SOUND.available();
    assert_eq!(left, Modules::ALL);
    assert_eq!(Configuration::running_on(left), Configurations::ALL);
    assert_eq!(MODULES.len(), 20);
}

/// The configurations left to run after each single loss.
#[test]
fn configurations_after_one_lost_resource() {
    let after = |lost: Resource| {
        Configuration::running_on(available(Modules::NONE, Resources::of(&[lost]))).to_string()
    };
    assert_eq!(after(Resource::SonarArrays), "PP PF.DEG TP TO.DEG SEC");
    assert_eq!(after(Resource::Map), "PF.ODO PF.DEG TP TO.FULL TO.DEG SEC");
    assert_eq!(after(Resource::Camera), "PP PF.OPT PF.OPTR PF.ODO PF.DEG PF.DVZ TP SEC");
    assert_eq!(after(Resource::WifiCard), "PP PF.OPT PF.OPTR PF.ODO PF.DEG PF.DVZ SEC");
    assert_eq!(after(Resource::AccessPoint), after(Resource::WifiCard));
    assert_eq!(after(Resource::Motors), "SEC");
    assert_eq!(after(Resource::Encoders), "SEC");
    assert_eq!(after(Resource::Bumpers), Configurations::ALL.to_string());
    for vital in
        [Resource::Electronics, Resource::SerialLink, Resource::Battery, Resource::LaptopCpu]
    {
        assert_eq!(after(vital), "-");
    }
}
