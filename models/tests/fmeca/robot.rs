//! The robot's analysis says what its typed rows say.

use cotama_models::cotama::{
    FailureMode, FailureModes, Module, Modules, Probes, Resource, Resources, ambiguity_groups,
    available, confusable_pairs, is_detectable, undetectable,
};
use cotama_models::fmeca::{Analysis, COLUMNS, Mode, Set, Status};
use proptest::prelude::*;

#[test]
fn the_printed_table_is_the_golden_one_and_is_read_again() {
    let robot = Analysis::of_the_robot();
    let printed = robot.to_csv();
    cotama_golden::compare("tests/golden/fmeca.csv", &printed);
    assert_eq!((printed.lines().count(), COLUMNS.split(',').count()), (41, 30));
    let again = Analysis::parse_csv("the delivery robot.csv", &printed).unwrap();
    assert_eq!(again.to_csv(), printed);
    assert_eq!((again.title(), again.period_h()), (robot.title(), robot.period_h()));
    // The contents of the table are the same; flags come in the order in which rows name them.
    let rows = |it: &Analysis| -> Vec<_> {
        let row = |mode: &Mode| {
            let mut flags = [it.names(&mode.flags), it.names(&mode.sometimes)]
                .map(|it| it.into_iter().map(str::to_owned).collect::<Vec<_>>());
            flags.iter_mut().for_each(|it| it.sort());
            let mut mode = mode.clone();
            (mode.flags, mode.sometimes) = (Set::none(0), Set::none(0));
            (mode, flags)
        };
        it.modes().iter().map(row).collect()
    };
    assert_eq!(rows(&again), rows(&robot));
    let ids = |it: &Analysis| -> Vec<Vec<String>> {
        let told = it.diagnose(&it.sound()).groups.list.into_iter();
        told.map(|group| it.ids(group).into_iter().map(str::to_owned).collect()).collect()
    };
    assert_eq!(ids(&again), ids(&robot));
}

#[test]
fn every_failure_mode_is_on_one_rib() {
    let robot = Analysis::of_the_robot();
    let all: Vec<_> = robot.functions().into_iter().flat_map(|it| robot.ribs(it)).collect();
    assert_eq!((robot.functions().len(), all.len()), (15, 29));
    assert_eq!(all.iter().map(|rib| rib.modes.len()).sum::<usize>(), 40);
    assert_eq!(robot.ribs("fly"), []);
}

fn same(status: Modules) {
    let robot = Analysis::of_the_robot();
    let told = robot.diagnose(&Status::of_the_robot("", status));
    let mode = |it: FailureMode| it as usize;
    let set = |set: FailureModes| set.iter().map(mode).collect::<Vec<_>>();
    let all = FailureMode::ALL.iter().copied();
    let detectable: Vec<_> = all.filter(|&it| is_detectable(it, status)).map(mode).collect();
    assert_eq!(told.detectable, detectable);
    assert_eq!(told.undetectable, set(undetectable(status)));
    let mut groups: Vec<_> = ambiguity_groups(status).map(set).collect();
    groups.sort_unstable();
    assert_eq!(told.groups.list, groups, "{status}");
    assert!(told.groups.complete);
    let pairs: Vec<_> = told.pairs.iter().map(|it| (it.modes, it.probes.clone())).collect();
    let probes = |it: Probes| it.iter().map(|it| it as usize).collect::<Vec<_>>();
    let typed: Vec<_> = confusable_pairs(status)
        .map(|(a, b)| ([mode(a), mode(b)], probes(Probes::that_separate(a, b, status))))
        .collect();
    assert_eq!(pairs, typed);
    assert_eq!(told.least_probes, probes(Probes::least_that_help(status)));
    assert_eq!(told.separable, Probes::least(status).is_some());
}

#[test]
fn each_loss_leaves_the_same_as_the_typed_rows() {
    same(Modules::ALL);
    for &lost in Resource::ALL {
        same(available(Modules::NONE, Resources::of(&[lost])));
    }
}

/// A tenth of the usual number, which `PROPTEST_CASES` sets: a case takes a tenth of a second.
fn cases() -> ProptestConfig {
    let usual = ProptestConfig::default();
    ProptestConfig { cases: usual.cases / 10, ..usual }
}

proptest! {
    #![proptest_config(cases())]

    /// Whatever modules are available, even none that could be so together.
    #[test]
    fn groups_are_those_of_the_typed_rows(bits: u64) {
        let all = Module::ALL.iter().enumerate();
        let left = all.filter(|(at, _)| bits & (1 << at) != 0);
        same(left.fold(Modules::NONE, |set, (_, &module)| set.with(module)));
    }
}
