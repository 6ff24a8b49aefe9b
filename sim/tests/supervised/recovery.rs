//! Modules that return: never used again unless the mission asks for it, and then only when the
//! return has lasted.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::Configuration::{
    self, FollowingDegraded, FollowingDvz, FollowingOdometric, FollowingOptimal,
    TeleoperationDegraded, TeleoperationFull, Teleprogramming,
};
use cotama_models::cotama::{FailureMode, Module};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Faults;
use cotama_sim::faults_text::faults_text;
use cotama_sim::options::Options;
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};
use cotama_sim::trace::{Record, Trace, replay};

/// The delivery with these events in place of its own, and with supervisors that use again what
/// returns or do not.
fn text(recovery: bool, events: &str) -> String {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap().text;
    let (mission, _) = delivery.split_once("[run]").unwrap();
    let decides = "decides = \"cotama\"";
    mission.replacen(decides, &format!("{decides}\nrecovery = {recovery}"), 1) + events
}

fn run(recovery: bool, injections: Vec<Injection>) -> Run {
    let mission = Mission::parse("delivery", &text(recovery, "")).unwrap();
    Supervised::new(&mission).unwrap().run(&Script { injections, answers: Vec::new() }).unwrap()
}

/// Returns a failure at a place that ends at another one.
fn fails(mode: FailureMode, from: u64, to: u64) -> Injection {
    let at = |mm| When::Place(Millimetres(mm));
    Injection { until: Some(at(to)), ..Injection::new(at(from), mode) }
}

/// The configurations of the first drive, with the second from which each runs, rounded down.
fn first_drive(run: &Run) -> Vec<(u64, Configuration)> {
    let end = run.fired.iter().find(|it| it.transition == "g2").unwrap().at;
    let known = run.configurations.iter().filter(|it| it.0 < end);
    known.filter_map(|it| Some((it.0.0 / 1_000, it.1?))).skip(1).collect()
}

/// How often the adapter of path following went up.
fn ups(run: &Run) -> usize {
    run.fired.iter().filter(|it| it.net == "pf" && it.transition.starts_with('u')).count()
}

#[test]
fn a_returned_module_is_not_used_without_recovery() {
    let run = run(false, vec![fails(FailureMode::Son2, 10_000, 20_000)]);
    assert_eq!(first_drive(&run), [(2, FollowingOptimal), (37, FollowingDegraded)]);
    assert_eq!((run.outcome, run.plans.len(), ups(&run)), (Outcome::Completed, 2, 0));
}

/// 10 m of path in the degraded set, and what the sonars need to be sound for: 67 s and 10 s; then
/// it is planned with them, and the supervisors are told of avoidance, localisation and sonars, one
/// a round.
#[test]
fn with_recovery_it_is_used_when_it_was_sound_for_ten_seconds() {
    let run = run(true, vec![fails(FailureMode::Son2, 10_000, 20_000)]);
    assert_eq!(
        first_drive(&run),
        [(2, FollowingOptimal), (37, FollowingDegraded), (111, FollowingOptimal)]
    );
    assert_eq!((run.outcome, run.plans.len(), ups(&run)), (Outcome::Completed, 3, 1));
    let since = run.fired.iter().filter(|it| it.at.0 > 100_000 && it.cause.0 == 1);
    let since: Vec<_> =
        since.map(|it| format!("{} {}.{}", it.at.0, it.net, it.transition)).collect();
    let expected = [
        "111500 gom.sonar_back",
        "111500 gom.avoidance_back",
        "111500 gom.mcl_back",
        "111500 cs.better1",
        "111600 pf.u1",
    ];
    assert_eq!(since, expected);
}

#[test]
fn localisation_alone_returns_as_well() {
    let crash = Injection { part: Module::Mcl, ..fails(FailureMode::Sw1, 10_000, 15_000) };
    let run = run(true, vec![crash]);
    let drive: Vec<_> = first_drive(&run).into_iter().map(|it| it.1).collect();
    // A crash is hard: the operator leads past it, and the robot goes on by odometry until
    // localisation has returned.
    let helped = [TeleoperationFull, Teleprogramming];
    assert_eq!(drive[..4], [&[FollowingOptimal, FollowingOdometric], &helped[..]].concat());
    assert_eq!(drive[4..], [FollowingOdometric, FollowingOptimal]);
    assert_eq!((run.outcome, ups(&run)), (Outcome::Completed, 1));
}

#[test]
fn a_loose_contact_moves_nothing() {
    let flicker = (10_000..80_000).step_by(600).map(|x| fails(FailureMode::Son2, x, x + 450));
    let run = run(true, flicker.collect());
    assert_eq!(first_drive(&run), [(2, FollowingOptimal), (37, FollowingDegraded)]);
    assert_eq!((run.outcome, run.plans.len(), ups(&run)), (Outcome::Completed, 2, 0));
}

#[test]
fn a_module_returned_twice_is_lost_for_good_the_third_time() {
    let thrice = [5_000, 15_000, 25_000].map(|x| fails(FailureMode::Son2, x, x + 3_000));
    let run = run(true, thrice.to_vec());
    let drive: Vec<_> = first_drive(&run).into_iter().map(|it| it.1).collect();
    let up_and_down = [FollowingOptimal, FollowingDegraded, FollowingOptimal, FollowingDegraded];
    assert_eq!(drive[..4], up_and_down);
    assert_eq!(drive[4..], [FollowingOptimal, FollowingDegraded]);
    assert_eq!((run.outcome, ups(&run)), (Outcome::Completed, 2));
    assert_eq!(
        run.configurations.iter().filter_map(|it| it.1).next_back(),
        Some(FollowingDegraded)
    );
}

/// The operator drives when the sonars return: his avoidance goes up, and the next path is followed
/// with everything.
#[test]
fn an_idle_adapter_does_not_go_up_and_starts_with_all_modules() {
    let mut son2 = fails(FailureMode::Son2, 10_000, 0);
    son2.until = Some(When::During(cotama_models::cotama::local::State::HandOver, Millis(0)));
    let bump = Injection::new(When::Place(Millimetres(12_000)), FailureMode::Loc3);
    let run = run(true, vec![son2, bump]);
    assert_eq!((run.outcome, ups(&run)), (Outcome::Completed, 0));
    let after: Vec<_> = first_drive(&run).into_iter().map(|it| it.1).skip(2).collect();
    assert_eq!(
        after,
        [TeleoperationDegraded, TeleoperationFull, Teleprogramming, FollowingOptimal]
    );
}

const EVENTS: &str = r#"
[run]
[[run.event]]
x_mm = 10000
kind = "failure"
mode = "SON2"
[[run.event]]
x_mm = 20000
kind = "repair"
mode = "SON2"
"#;

#[test]
fn a_mission_file_gives_the_end_of_a_failure_and_its_trace_the_consequences() {
    let text = text(true, EVENTS);
    let mission = Mission::parse("delivery", &text).unwrap();
    let script = Script::from(&mission.run.faults);
    assert_eq!(script.injections, [fails(FailureMode::Son2, 10_000, 20_000)]);
    let faults = faults_text(&mission.run.faults, &mission);
    assert_eq!(Faults::parse("faults", &faults, &mission).unwrap(), mission.run.faults);

    let options = Options::default();
    let (trace, _) = Trace::record(&mission, &options).unwrap();
    assert!(replay(&Trace::parse("trace", &trace.to_json_lines()).unwrap()).unwrap().identical);
    let plans = trace
        .records
        .iter()
        .filter_map(|it| if let Record::Plan(it) = it { Some(&it.cause) } else { None });
    assert_eq!(plans.collect::<Vec<_>>(), ["start", "sonar arrays lost", "sonar arrays back"]);
    let told = trace
        .records
        .iter()
        .filter_map(|it| if let Record::Told(it) = it { Some(&it.event) } else { None });
    let told: Vec<_> = told.filter(|it| it.starts_with("faults.regain")).collect();
    assert_eq!(told, ["faults.regain_mcl", "faults.regain_avoidance", "faults.regain_sonar"]);
    let up = trace.records.iter().find_map(|it| match it {
        Record::Fired(it) if it.transition == "u1" => Some((it.place.as_str(), it.cause)),
        _ => None,
    });
    assert_eq!(up, Some(("Optimal", Some(1))));
}

/// Sonars and avoidance fail at once; the sonars return, and the next drive has the other
/// avoidance.
#[test]
fn an_avoidance_that_lost_sonars_hid_is_not_used_when_they_return() {
    let at = When::At(Millis(36_800));
    let crash = Injection { part: Module::Smz, ..Injection::new(at, FailureMode::Sw1) };
    let run = run(true, vec![fails(FailureMode::Son2, 10_000, 20_000), crash]);
    assert!(run.conduct.iter().all(|it| it.detected.unwrap().0 == Millis(37_000)));
    let later = run.configurations.iter().filter(|it| it.0 > Millis(37_000));
    let later: Vec<_> = later.filter_map(|it| it.1).collect();
    assert!(later.contains(&FollowingDvz) && !later.contains(&FollowingOptimal), "{later:?}");
}
