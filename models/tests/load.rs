//! The modules of the delivery in time: response times, particles, and the second point of the
//! experiment.

use cotama_core::executive::{Executive, Happening, Overruns, Task, TaskSet, Watchdog, What};
use cotama_core::units::Micros;
use cotama_models::cotama::Configuration::{
    self, FollowingDegraded, FollowingOdometric, FollowingOptimal, Planning, TeleoperationFull,
};
use cotama_models::cotama::load::{
    self, COSTS, DEADLINE, EXTRA, Load, MOST, PARTICLES, PERIOD, SPARE, most_particles,
};
use cotama_models::cotama::{Module, Modules};
use std::fmt::Write as _;
use std::time::Duration;

fn tasks(configuration: Configuration, load: Load, particles: u32) -> Vec<Task> {
    load::tasks(configuration, load, particles, &mut [SPARE; MOST]).to_vec()
}

/// Each module with its response time, what is left to its deadline, and its response time when
/// another one overruns; in ms.
fn table(configuration: Configuration, load: Load, particles: u32) -> String {
    let tasks = tasks(configuration, load, particles);
    let set = TaskSet::new(&tasks).unwrap();
    let names = (load != Load::Quiet).then_some("load").into_iter();
    let scheduled = configuration.scheduled();
    let names = names
        .chain(COSTS.iter().map(|it| it.module).filter(|it| scheduled.has(*it)).map(Module::name));
    let ms = |time: Micros| Duration::from_micros(time.0).as_secs_f64() * 1_000.0;
    let mut table = format!(
        "{load:?}, {particles} particles\nmodule  period   cost  response  slack  one overruns\n"
    );
    let responses = set.response_times(Overruns::None).zip(set.response_times(Overruns::One));
    for ((name, task), (plain, one)) in names.zip(&tasks).zip(responses) {
        let shown = |time: Result<Micros, _>| {
            time.map_or("late".to_owned(), |time| format!("{:.1}", ms(time)))
        };
        let slack =
            plain.map_or(String::new(), |plain| format!("{:.1}", ms(task.deadline) - ms(plain)));
        let (period, cost) = (ms(task.period), ms(task.cost));
        writeln!(
            table,
            "{name:<6} {period:>7.1} {cost:>6.1} {:>9} {slack:>6} {:>13}",
            shown(plain),
            shown(one)
        )
        .unwrap();
    }
    table
}

#[test]
fn response_times_of_the_optimal_path_following() {
    let tables = [(Load::Quiet, 500), (Load::Busy, 500), (Load::Busy, 200)];
    let shown = tables.map(|(load, particles)| table(FollowingOptimal, load, particles)).join("\n");
    println!("{shown}");
    cotama_golden::compare("tests/golden/load.txt", &shown);
}

#[test]
fn particles_are_as_many_as_the_processor_affords() {
    let most = |configuration, load| most_particles(configuration, load, &mut [SPARE; MOST]);
    assert_eq!(
        [Load::Heavy, Load::Busy, Load::Quiet].map(|load| most(FollowingOptimal, load)),
        PARTICLES.map(|it| Ok(Some(it)))
    );
    // The odometric configuration does not localise with particles.
    assert_eq!(most(FollowingOdometric, Load::Quiet), Ok(None));
    for (load, particles) in [(Load::Heavy, 100), (Load::Busy, 200), (Load::Quiet, 500)] {
        let is_in_time = |particles| {
            let tasks = tasks(FollowingOptimal, load, particles);
            TaskSet::new(&tasks).unwrap().schedulable(Overruns::None).is_ok()
        };
        assert!(is_in_time(particles) && !is_in_time(particles + 1));
    }
}

#[test]
fn every_set_but_the_optimal_one_is_in_time_when_the_computer_is_busy() {
    for set in [FollowingOdometric, FollowingDegraded, Planning, TeleoperationFull] {
        for load in [Load::Quiet, Load::Busy] {
            let tasks = tasks(set, load, 0);
            assert_eq!(
                TaskSet::new(&tasks).unwrap().schedulable(Overruns::None),
                Ok(()),
                "{set:?} {load:?}"
            );
        }
    }
    // Whatever one module does, and whatever the localisation takes, the others are in time.
    let full = tasks(FollowingOptimal, Load::Busy, PARTICLES[2]);
    assert_eq!(TaskSet::new(&full[..13]).unwrap().schedulable(Overruns::One), Ok(()));
    // With fewer particles any one module may overrun when the computer is quiet.
    let reduced = tasks(FollowingOptimal, Load::Quiet, PARTICLES[1]);
    assert_eq!(TaskSet::new(&reduced).unwrap().schedulable(Overruns::One), Ok(()));
}

/// Returns the troubles up to an instant, with their times in ms.
fn troubles(executive: &mut Executive<14>, until: Micros) -> Vec<(u64, usize, What)> {
    let needs = executive.tasks().map(|task| task.cost);
    let happenings = std::iter::from_fn(|| executive.simulate(until, &needs));
    let trouble = |it: &Happening| !matches!(it.what, What::Released | What::Done);
    happenings.filter(trouble).map(|it| (it.at.0 / 1_000, it.task, it.what)).collect()
}

/// The second point of the experiment: under load the localisation alone misses its deadlines; the
/// watchdog says so after three periods, and with fewer particles all is in time.
#[test]
fn the_localisation_alone_is_found_too_slow_and_fewer_particles_cure_it() {
    let under_load = |particles| tasks(FollowingOptimal, Load::Busy, particles).try_into().unwrap();
    let mut full = Executive::<14>::new(under_load(PARTICLES[2])).unwrap();
    let late = |period: u64| {
        let skipped = What::Skipped { rt_fault: period == 3 };
        [(100 * period - 20, 13, What::DeadlineMissed), (100 * period, 13, skipped)]
    };
    let refused = (300, 13, What::Refused);
    assert_eq!(
        troubles(&mut full, Micros(300_000)),
        [&late(1)[..], &late(2), &late(3), &[refused]].concat()
    );
    assert_eq!(full.watchdog(13), Some(Watchdog::Fault));

    let mut reduced = Executive::<14>::new(under_load(PARTICLES[1])).unwrap();
    assert_eq!(troubles(&mut reduced, Micros(10_000_000)), []);
}

#[test]
fn the_watchdog_of_the_loop_has_the_numbers_of_its_tasks() {
    let net = load::loop_watchdog::NET;
    let within =
        |name: &str| net.transitions.iter().find(|it| it.name == name).unwrap().within.unwrap();
    let ms = |within: cotama_core::net::Within| {
        (u64::from(within.earliest), within.latest.map(u64::from))
    };
    assert_eq!(ms(within("w3")), (DEADLINE.0 / 1_000, Some(DEADLINE.0 / 1_000)));
    assert_eq!(ms(within("w5")), (EXTRA.0 / 1_000, Some(EXTRA.0 / 1_000)));
    assert_eq!(DEADLINE.0 + EXTRA.0, PERIOD.0); // a fault is raised before the next release
    assert!(tasks(FollowingOptimal, Load::Quiet, 500).iter().all(|task| task.patience == 3));
}

#[test]
fn every_module_is_scheduled_in_some_configuration_but_the_parts_of_another() {
    let scheduled =
        Configuration::ALL.iter().fold(Modules::NONE, |all, it| all.union(it.scheduled()));
    assert_eq!(Modules::ALL.without(scheduled).to_string(), "SCH ODO CTR");
    let costed = COSTS.iter().fold(Modules::NONE, |all, it| all.with(it.module));
    assert_eq!(costed, scheduled);
    assert_eq!(COSTS[COSTS.len() - 1].module, Module::Mcl);
}
