//! A crash of one software module costs what that module does, and what needs it.

use super::delivery;
use cotama_core::units::Millimetres;
use cotama_models::cotama::Configuration::{
    self, FollowingDegraded, FollowingDvz, FollowingOdometric, FollowingOptimal, TeleoperationFull,
    Teleprogramming,
};
use cotama_models::cotama::{Class, FailureMode, Module};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Injection, Run, Script, Supervised, When};

fn run(crashes: &[(u64, Module)]) -> Run {
    let crash = |&(m, part): &(u64, Module)| {
        let at = When::Place(Millimetres(m * 1_000));
        Injection { part, ..Injection::new(at, FailureMode::Sw1) }
    };
    let script = Script { injections: crashes.iter().map(crash).collect(), answers: Vec::new() };
    Supervised::new(&delivery()).unwrap().run(&script).unwrap()
}

/// The configurations of the first drive, planning left out.
fn first_drive(run: &Run) -> Vec<Configuration> {
    let end = run.fired.iter().find(|it| it.transition == "g2").unwrap().at;
    run.configurations.iter().filter(|it| it.0 < end).filter_map(|it| it.1).skip(1).collect()
}

/// Path following turns to the other avoidance; a crash is hard, so that the operator is asked; he
/// drives with avoidance, and the robot goes on with what is left, localisation among it.
#[test]
fn without_smz_a_sound_robot_avoids_by_dvz() {
    let run = run(&[(10, Module::Smz)]);
    assert_eq!(
        first_drive(&run),
        [FollowingOptimal, FollowingDvz, TeleoperationFull, Teleprogramming, FollowingDvz]
    );
    assert_eq!(run.conduct[0].decided.unwrap().1, Class::Adapter);
    let asked = run.fired.iter().filter(|it| it.transition == "ambiguous3").count();
    assert_eq!((run.outcome, run.operator_requests, asked), (Outcome::Completed, 1, 1));
}

/// Only where the other avoidance, or localisation, is lost as well it does without any.
#[test]
fn without_both_avoidances_it_is_degraded() {
    for second in [Module::Dvz, Module::Mcl] {
        let run = run(&[(5, Module::Smz), (20, second)]);
        assert!(first_drive(&run).contains(&FollowingDegraded), "{}", second.name());
        assert!(run.fired.iter().all(|it| it.transition != "sonar"), "the sonars are sound");
        assert_eq!(run.outcome, Outcome::Completed);
    }
}

/// Localisation costs itself.
#[test]
fn without_localisation_it_goes_by_odometry() {
    let run = run(&[(10, Module::Mcl)]);
    assert_eq!(first_drive(&run)[..2], [FollowingOptimal, FollowingOdometric]);
    assert_eq!(run.outcome, Outcome::Completed);
}
