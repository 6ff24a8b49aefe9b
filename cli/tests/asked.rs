//! Runs whose operator is a person: answers come from standard input.

use crate::common::Folder;

/// The delivery with the answers of a person.
fn run(folder: &Folder, answers: &str, more: &str) -> crate::common::Ended {
    let run = format!("cotama run delivery --no-report --fidelity plane --operator ask {more}");
    folder.shell(&format!("printf '{answers}' | {run}"))
}

#[test]
fn a_person_is_shown_the_floor_and_answers_each_request() {
    let folder = Folder::new("asked");
    let choice = "Teleoperation Teleprogramming done\\nTeleoperation, done\\n";
    let ended = run(&folder, choice, "--trace t.jsonl");
    assert_eq!(ended.code, Some(0), "{ended:?}");
    let said = &ended.stderr;
    assert!(
        said.contains("request 1 after 217.3 s, at 52.0 m: LOC2;")
            && said.contains("request 2 after"),
        "{said}"
    );
    // A corridor of 4 m, the robot on its path between the walls.
    assert!(said.contains(&format!("{}>{}", ".".repeat(30), ".".repeat(29))), "{said}");
    assert!(said.lines().filter(|it| it.trim() == "#".repeat(60)).count() >= 2, "{said}");
    assert!(ended.stdout.contains("completed: "), "{}", ended.stdout);
    let again = folder.cotama(&["replay", "t.jsonl"]);
    assert!(again.stdout.contains("identical"), "{again:?}");
}

#[test]
fn an_answer_that_is_none_is_asked_again_and_the_rest_may_be_left_out() {
    let folder = Folder::new("asked_again");
    let ended = run(&folder, "Teleoperaton done\\ndone\\nTeleprogramming done\\n", "");
    let said = &ended.stderr;
    for it in [
        "`Teleoperaton` is no answer; did you mean `Teleoperation`?",
        "answers begin with what you choose, and end with `done` or `give_up`",
        "no more answers: the rest is left to the simulated operator",
    ] {
        assert!(said.contains(it), "{said}");
    }
    assert_eq!(ended.code, Some(0));
    let ended = run(&folder, "give_up\\n", "");
    assert_eq!((ended.code, ended.stdout.contains("safe")), (Some(1), true), "{ended:?}");
}

#[test]
fn a_run_without_an_operator_asks_nobody() {
    let folder = Folder::new("asked_nobody");
    for (arguments, why) in [
        (["run", "patrol"], "--operator ask is for missions whose supervisors ask an operator"),
        (["run", "fleet"], "--operator is for missions, and this is a team"),
        (["run", "-"], "--operator ask reads answers from standard input, where the mission is"),
    ] {
        let ended = folder.cotama(&[&arguments[..], &["--operator", "ask"]].concat());
        assert_eq!(ended.code, Some(2));
        assert!(ended.stderr.contains(why), "{}", ended.stderr);
    }
}
