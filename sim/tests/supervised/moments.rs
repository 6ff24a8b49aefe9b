//! Faults that wait for what the supervisors do, from a file and back to one.

use super::delivery;
use cotama_core::units::Millis;
use cotama_models::missions::faults::{Act, Faults};
use cotama_sim::faults_text::faults_text;
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Run, Script, Supervised};

/// The run of a file with this failure, and the file as it is printed again.
fn run(failure: &str) -> Run {
    let mission = delivery();
    let text = format!("format = \"panorama-faults/1\"\nevent = [{{ {failure} }}]\n");
    let faults = Faults::parse("faults.toml", &text, &mission).unwrap();
    let printed = faults_text(&faults, &mission);
    assert_eq!(Faults::parse("again.toml", &printed, &mission).unwrap(), faults, "{printed}");
    Supervised::new(&mission).unwrap().run(&Script::from(&faults)).unwrap()
}

fn first(run: &Run, act: &str) -> Millis {
    let act = Act::named(act).unwrap();
    let is = |it: &&cotama_sim::supervised::Fired| {
        (it.net, it.transition.as_str()) == (act.net, act.transition)
    };
    run.fired.iter().find(is).unwrap().at
}

#[test]
fn a_failure_follows_the_first_firing_of_a_transition() {
    // The periods of the robot in between are passed over when nothing happens in them.
    for after in [0_u64, 40, 700, 50_000] {
        let run = run(&format!(
            "fired = \"ls.l3\", after_ms = {after}, kind = \"failure\", mode = \"SON2\""
        ));
        let due = (first(&run, "ls.l3").0 + after).next_multiple_of(100);
        // A firing in one round is seen by a failure in the next one.
        let injected = run.conduct[0].injected.0;
        assert!((due..=due + 100).contains(&injected), "{after}: {due} and {injected}");
    }
}

/// A motor has less torque until the first drive is done: the second is not slow.
#[test]
fn a_failure_ends_when_a_transition_fires() {
    let late =
        |ends: &str| run(&format!("t_ms = 20_000{ends}, kind = \"failure\", mode = \"MOT2\""));
    let (stays, ends) = (late(""), late(", until_fired = \"ls.l3\""));
    assert_eq!(first(&stays, "ls.l3"), first(&ends, "ls.l3"));
    assert_eq!([&stays, &ends].map(|it| it.outcome), [Outcome::Completed; 2]);
    assert!(ends.used[0] < stays.used[0], "{} and {}", ends.used[0], stays.used[0]);
}

#[test]
fn a_failure_that_waits_for_a_dead_transition_never_comes() {
    let run = run("fired = \"ls.l9\", kind = \"failure\", mode = \"BAT2\"");
    assert!(run.conduct.is_empty());
    let act = Act::named("ls.l9").unwrap();
    assert!(run.fired.iter().all(|it| it.transition != act.transition || it.net != act.net));
}
