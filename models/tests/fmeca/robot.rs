//! The analysis of a robot from its file.

use cotama_models::fmeca::{Analysis, COLUMNS, Mode, Set, Status};
use cotama_models::robots::Robot;

#[test]
fn the_printed_table_is_the_golden_one_and_is_read_again() {
    let robot = Analysis::shipped("p3dx-delivery").unwrap();
    let printed = robot.to_csv();
    cotama_golden::compare("tests/golden/fmeca.csv", &printed);
    assert_eq!((printed.lines().count(), COLUMNS.split(',').count()), (47, 34));
    let again = Analysis::parse_csv("Pioneer 3-DX of the delivery mission.csv", &printed).unwrap();
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
    let robot = Analysis::shipped("p3dx-delivery").unwrap();
    let all: Vec<_> = robot.functions().into_iter().flat_map(|it| robot.ribs(it)).collect();
    assert_eq!((robot.functions().len(), all.len()), (15, 29));
    assert_eq!(all.iter().map(|rib| rib.modes.len()).sum::<usize>(), 46);
    assert_eq!(robot.ribs("fly"), []);
}

#[test]
fn a_status_after_a_loss_shows_what_working_observers_see() {
    let mut robot = Robot::shipped("p3dx-delivery").unwrap();
    // Sonars are seen by an observer that needs them.
    robot.observers[0].needs.modules =
        1 << robot.modules.iter().position(|it| it.name == "UST").unwrap();
    let analysis = Analysis::try_from(&robot).unwrap();
    let sound = analysis.diagnose(&analysis.sound());
    let unseen = |status: &Status| analysis.ids(analysis.diagnose(status).undetectable).len();
    let before = sound.undetectable.len();
    for loss in 0..robot.losses.losses.len() {
        let after = Status::after(&robot, loss);
        let gone = robot.losses.losses[loss].modules;
        let blind = robot.observers.iter().any(|it| it.needs.modules & gone != 0);
        assert_eq!(unseen(&after) > before, blind, "{}", after.name);
    }
}
