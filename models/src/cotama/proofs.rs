//! The decisional level: what is available, what is decided, who may move the robot, and what a
//! computer can afford.

use super::load::{self, Load, MOST, SPARE};
use super::*;
use cotama_core::executive::{Overruns, TaskSet};
use cotama_core::proofs::few;
use cotama_core::units::Millis;

/// One of a list, whichever.
fn one_of<T: Copy>(all: &[T]) -> T {
    let at = usize::from(few::<5>());
    kani::assume(at < all.len());
    all[at]
}

/// Any two modules are faulty, or one, and any resource is lost, or none.
fn any_health() -> Health {
    let faulty = Modules::NONE.with(one_of(Module::ALL)).with(one_of(Module::ALL));
    let lost = Resources::NONE.with(one_of(Resource::ALL));
    let faulty = if kani::any() { faulty } else { Modules::NONE };
    Health { faulty, lost: if kani::any() { lost } else { Resources::NONE }, ..Health::SOUND }
}

/// The set of available modules is closed under needs, and as large as can be: a module runs
/// exactly when it is sound, its hardware is there, and the modules it needs run.
#[kani::proof]
#[kani::unwind(22)]
pub fn the_available_modules_are_closed_under_needs() {
    let health = any_health();
    let runs = available(health.faulty, health.lost);
    for it in &MODULES {
        let sound = !health.faulty.has(it.module) && it.hardware.common(health.lost).is_empty();
        let one_of = it.needs_one_of.is_empty() || !it.needs_one_of.common(runs).is_empty();
        let needs = runs.covers(it.needs) && one_of;
        let scheduled = it.module == Module::Sch || runs.has(Module::Sch);
        assert!(runs.has(it.module) == (sound && needs && scheduled));
    }
    let lost: Modules = Modules::ALL.without(runs).without(health.faulty);
    kani::cover!(health.lost.is_empty() && lost.len() > 2, "more than the faulty ones");
    kani::cover!(runs.has(Module::Mcl) && !runs.is(Modules::ALL), "some run");
}

/// The more is broken, the less is available, and a suspicion takes away nothing that a fault would
/// leave.
#[kani::proof]
#[kani::unwind(22)]
pub fn more_faults_never_make_more_available() {
    let (suspected, broken) = (Modules::NONE.with(one_of(Module::ALL)), one_of(Module::ALL));
    let known = Health { faulty: Modules::NONE.with(broken), suspected, ..Health::SOUND };
    let status = known.status_vector();
    let worse = available(known.faulty.union(suspected), known.lost);
    assert!(known.available().covers(worse) && Health::SOUND.available().covers(known.available()));
    for &module in Module::ALL {
        let expected = match (worse.has(module), known.available().has(module)) {
            (true, _) => Status::Available,
            (false, true) => Status::Suspect,
            (false, false) => Status::Unavailable,
        };
        assert!(status.of(module) == expected);
    }
    assert!(status.available().is(known.available()));
    kani::cover!(status.suspect().len() > 1, "a suspicion spreads");
    kani::cover!(status.suspect().is_empty(), "what is broken anyway");
}

/// Any place of every supervisor, whether they fit together or not.
fn any_situation() -> Situation {
    use local::State as Local;
    use path_following::State as Following;
    use teleoperation::State as Teleoperation;
    let local = [
        Local::Idle,
        Local::Planning,
        Local::Following,
        Local::HandOver,
        Local::Teleprogrammed,
        Local::Teleoperated,
        Local::End,
    ];
    let following = [
        Following::Off,
        Following::Optimal,
        Following::Reduced,
        Following::Odometric,
        Following::Reactive,
        Following::Degraded,
    ];
    let teleoperation = [Teleoperation::Off, Teleoperation::Full, Teleoperation::Degraded];
    let (one, two) = (usize::from(few::<3>()), usize::from(few::<3>()));
    let (three, level) = (usize::from(few::<2>()), few::<2>());
    kani::assume(one < local.len() && two < following.len());
    kani::assume(three < teleoperation.len() && level < 3);
    let Some(lost) = Losses::from_bits(few::<7>()) else { unreachable!() };
    let (local, following) = (local[one], following[two]);
    Situation { local, following, teleoperation: teleoperation[three], level, lost }
}

fn any_report() -> Report {
    let at = usize::from(few::<4>());
    kani::assume(at < Report::ALL.len());
    Report::ALL[at]
}

/// The decision table is total, and asks nobody who cannot answer: a vital loss ends the mission, a
/// question needs the link and a drive, and an adapter is told only what it can do.
#[kani::proof]
#[kani::unwind(8)]
pub fn a_decision_is_made_in_every_situation() {
    let (report, situation) = (any_report(), any_situation());
    let decision = decide(report, situation);
    let place = situation.local;
    let at_rest = situation.mode() == Mode::Rest;
    assert!(report != Report::Vital || decision == Decision::Global);
    match decision {
        Decision::Local => assert!(!situation.lost.has(Loss::Wifi)),
        Decision::AdaptMinor | Decision::AdaptBump | Decision::AdaptSmz | Decision::AdaptSonar => {
            assert!(place == local::State::Following);
        }
        Decision::AdaptMinorTeleoperation => assert!(place == local::State::Teleoperated),
        Decision::AdaptSonarTeleoperation => {
            assert!(situation.teleoperation == teleoperation::State::Full);
        }
        Decision::AdaptRt => assert!(report == Report::Slow && situation.level > 0),
        Decision::AdaptMcl => assert!(matches!(report, Report::Slow | Report::Mcl)),
        Decision::AdaptAvoidance => assert!(report == Report::Avoidance),
        Decision::Record | Decision::Global => {}
    }
    // If the places fit together, only a vital loss disturbs a robot at rest.
    let disturbs = decision != Decision::Record && report != Report::Vital;
    assert!(!(situation.is_consistent() && at_rest && disturbs));
    kani::cover!(decision == Decision::AdaptRt, "fewer particles");
    kani::cover!(decision == Decision::Global && report == Report::Hard, "nobody can be asked");
}

/// The table decides as the two rules of severity and availability do, but for the seven cells that
/// it names, if the places fit together and earlier losses are answered.
#[kani::proof]
#[kani::unwind(22)]
pub fn the_table_follows_from_the_rules() {
    use local::State::{Following, HandOver, Planning, Teleprogrammed};
    let (report, situation) = (any_report(), any_situation());
    kani::assume(situation.is_consistent() && is_settled(report, situation));
    let named = match report {
        Report::Planner => situation.local == Following,
        Report::Refusal => matches!(situation.local, Planning | Following),
        Report::Camera | Report::Hard => {
            matches!(situation.local, HandOver | Teleprogrammed)
        }
        _ => false,
    };
    let (table, rules) = (decide(report, situation), by_rules(report, situation));
    assert!(table == rules || named && table == Decision::Record);
    kani::cover!(table != rules, "a named cell");
    kani::cover!(table == rules && table.class() == Class::Adapter, "an adaptation");
}

/// Draws an event that the level accepts, as the scenarios of a drive have it.
fn any_told() -> Told {
    let told = [
        Told::Drive(local::Event::goal_reached),
        Told::Failure(faults::Event::lose_sonar),
        Told::Failure(faults::Event::lose_wifi),
        Told::Failure(faults::Event::lose_vital),
        Told::Failure(faults::Event::drift),
        Told::Failure(faults::Event::overload),
        Told::Operator(operator::Event::teleoperate),
        Told::Operator(operator::Event::arrived),
    ];
    told[usize::from(few::<3>())]
}

/// The robot may be moved exactly where an activity moves it, whatever the level is told, and never
/// again once motion has ended for good.
#[kani::proof]
#[kani::unwind(12)]
pub fn only_an_activity_that_moves_has_the_permit() {
    let mut level = DecisionalLevel::default();
    let mission = Told::Mission(global::Event::mission_received);
    let _ = level.tell(Millis(0), mission, Cause(0), &mut ());
    let _ = level.round(Millis(0), &mut ());
    let _ = level.tell(Millis(0), Told::Drive(local::Event::path_ready), Cause(0), &mut ());
    assert!(level.permit().is_some());
    let mut halted = false;
    for _ in 0..4 {
        let _ = level.tell(Millis(0), any_told(), Cause(0), &mut ());
        for _ in 0..2 {
            let place = level.situation(Losses::NONE).local;
            let moves = matches!(place, local::State::Following | local::State::Teleoperated);
            assert!(level.permit().is_some() == moves);
            assert!(!halted || level.halted());
            assert!(!level.halted() || level.permit().is_none());
            halted = level.halted();
            kani::cover!(moves && place == local::State::Teleoperated, "the operator drives");
            let _ = level.round(Millis(0), &mut ());
        }
    }
    kani::cover!(halted, "halted");
}

/// As many particles as a computer is said to afford keep all modules in time, and one more does
/// not.
#[kani::proof]
#[kani::unwind(20)]
pub fn the_most_particles_are_exact() {
    let configuration = one_of(Configuration::ALL);
    let load = match few::<2>() {
        0 => Load::Quiet,
        1 => Load::Busy,
        _ => Load::Heavy,
    };
    let mut memory = [SPARE; MOST];
    let Ok(most) = load::most_particles(configuration, load, &mut memory) else { unreachable!() };
    let mut in_time = |particles| {
        let tasks = load::tasks(configuration, load, particles, &mut memory);
        TaskSet::new(tasks).is_ok_and(|it| it.schedulable(Overruns::None).is_ok())
    };
    match most {
        Some(most) => assert!(in_time(most) && !in_time(most + 1)),
        None => assert!(!configuration.scheduled().has(Module::Mcl) || !in_time(0)),
    }
    kani::cover!(most == Some(200), "200");
    kani::cover!(most.is_none(), "none");
}
