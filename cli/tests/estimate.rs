//! `cotama estimate`: what random runs show, and what they do not.

use crate::common::{Folder, golden};

#[test]
fn the_screens_of_estimates() {
    let folder = Folder::new("estimate_screens");
    let watchdog = ["--untimed", "--steps", "20", "--within", "0.02"];
    let never = [&["estimate", "watchdog", "--property", "AG !Fault"], &watchdog[..]].concat();
    let said = folder.cotama(&never);
    assert_eq!(said.code, Some(1));
    golden("estimate_watchdog.txt", &said.stdout);
    let rounds = "cotama estimate delivery --property 'EF ls.Planning' --property 'AG !ls.End' \
                  --steps 20 --runs 200 --seed 4";
    let said = folder.shell(rounds);
    assert_eq!(said.code, Some(3));
    golden("estimate_delivery.txt", &said.stdout);
}

#[test]
fn only_a_run_that_shows_it_makes_a_verdict() {
    let folder = Folder::new("estimate_verdicts");
    let ends = |property: &str, steps: &str| {
        let line = ["estimate", "philosophers:3", "--property", property, "--steps", steps];
        folder.cotama(&[&line[..], &["--runs", "300"]].concat()).code
    };
    // A deadlock takes three steps, one a philosopher.
    assert_eq!([2, 3].map(|it| ends("EF deadlock", &it.to_string())), [Some(3), Some(0)]);
    assert_eq!([2, 3].map(|it| ends("deadlock_free", &it.to_string())), [Some(3), Some(1)]);
    assert_eq!(ends("AG !(eat_1 & eat_2)", "30"), Some(3));
}

#[test]
fn the_answer_is_the_same_on_any_number_of_threads() {
    let folder = Folder::new("estimate_jobs");
    let answers = ["1", "2", "5"].map(|jobs| {
        let line = "estimate philosophers:4 --runs 501 --steps 40 --seed 9 --json --jobs";
        let mut words: Vec<_> = line.split(' ').chain([jobs]).collect();
        words.extend(["--property", "EF deadlock", "--property", "AG !(eat_1 & eat_3)"]);
        let mut answer = folder.cotama(&words).json(1);
        answer.as_object_mut().unwrap().remove("seconds");
        answer
    });
    assert_eq!(answers[0], answers[1]);
    assert_eq!(answers[0], answers[2]);
    let [deadlock, both] = [0, 1].map(|it| &answers[0]["results"][it]);
    assert_eq!((&deadlock["verdict"], &both["verdict"]), (&"true".into(), &"false".into()));
    assert_eq!(deadlock["trace"].as_array().unwrap().len(), 4);
    assert_eq!(deadlock["rest"], "deadlock");
    let holding = deadlock["holding"].as_f64().unwrap();
    assert_eq!(deadlock["probability"]["estimate"], holding / 501.0);
}

#[test]
fn questions_beyond_single_runs_are_refused() {
    let folder = Folder::new("estimate_refused");
    for (line, message) in [
        ("watchdog --property EF~Fault", "--untimed leaves the intervals out"),
        ("door --untimed --property AG~EF~Closed", "a single run cannot be held against it"),
        ("door --untimed --property live", "a single run cannot be held against it"),
        ("door --untimed --property AF~Open~assuming~weak(call)", "what is assumed of runs"),
        ("door --untimed --property AF<=200ms~Open", "it speaks of time"),
        ("door --untimed --property EF~Opne", "did you mean `Open`?"),
        ("door --untimed", "--property"),
        ("door --untimed --property EF~Open --runs 0", "a whole number from 1"),
        ("door --untimed --property EF~Open --within 0.000001", "at most 1000000000 are drawn"),
    ] {
        let words: Vec<_> = line.split(' ').map(|it| it.replace('~', " ")).collect();
        let words: Vec<_> = ["estimate"].into_iter().chain(words.iter().map(|it| &**it)).collect();
        let said = folder.cotama(&words);
        assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""), "{line}");
        assert!(said.stderr.contains(message), "{line}:\n{}", said.stderr);
    }
}
