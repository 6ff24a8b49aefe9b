//! `cotama check`: verdicts, exit codes, files, and what is said of input that cannot be used.

use crate::common::{Ended, Folder, golden};
use serde_json::json;

pub(crate) fn check(folder: &Folder, model: &str, properties: &[&str], more: &[&str]) -> Ended {
    let asked = properties.iter().flat_map(|it| ["--property", it]);
    let arguments: Vec<_> =
        ["check", model].into_iter().chain(asked).chain(more.iter().copied()).collect();
    folder.cotama(&arguments)
}

const CONTEST: &str = "<?xml version=\"1.0\"?>\n<property-set>\n<property><id>never-two</id>\
    <formula>\
    <all-paths><globally><integer-le><tokens-count><place>p0</place></tokens-count>\
    <integer-constant>1</integer-constant></integer-le></globally></all-paths></formula>\
    </property>\n\
    <property><id>most</id><formula><place-bound><place>p0</place></place-bound></formula>\
    </property>\n\
    </property-set>\n";

/// Nobody makes smoke, and the quick test is over before the late one can begin.
const ALARM: &str = "net alarm\ntr ring smoke -> smoke noise\ntr quick [1,2] idle -> tested\n\
    tr late [3,4] idle -> old\ntr again tested -> idle\npl idle (1)\n";

#[test]
fn the_screens_of_a_check() {
    let folder = Folder::new("check_screens");
    golden("check_door.txt", &folder.cotama(&["check", "door"]).stdout);
    golden("check_feast.txt", &check(&folder, "philosophers:3", &["AG !deadlock"], &[]).stdout);
    let asked = ["EF (Closing & obstacle)", "AG EF Open", "bounds(Open + Closed)"];
    golden("check_door_asked.txt", &check(&folder, "door", &asked, &["--untimed"]).stdout);
    golden("check_watchdog.txt", &check(&folder, "watchdog", &["bound(w1 -> Fault)"], &[]).stdout);
}

#[test]
fn the_worst_verdict_decides_how_it_ends() {
    let folder = Folder::new("check_exits");
    let more = ["--untimed", "--engine", "explicit", "--max-states", "4"];
    let code = |properties: &[&str], more: &[&str]| check(&folder, "door", properties, more).code;
    assert_eq!(code(&["AG !(Closing & obstacle)", "EF Open"], &[]), Some(0));
    assert_eq!(code(&["bounds(Open)"], &["--untimed"]), Some(0));
    assert_eq!(code(&["EF Open", "EF (Closing & obstacle)"], &[]), Some(1));
    assert_eq!(code(&["AG !(Closing & obstacle)"], &more), Some(3));
    assert_eq!(code(&["AG !(Closing & obstacle)", "EF !Closed"], &more), Some(3));
    assert_eq!(code(&["AG !(Closing & obstacle)", "AG Closed"], &more), Some(1));
    assert_eq!(code(&["AG !(Closing & obstacle"], &more), Some(2));
}

#[test]
fn an_unknown_verdict_has_a_reason_and_figures() {
    let folder = Folder::new("check_unknown");
    let more = ["--engine", "explicit", "--max-states", "100", "--json"];
    let answer = check(&folder, "kanban:3", &["EF (P1 = 0 & P4 = 0 & Pout4 = 3)"], &more).json(3);
    let row = &answer["results"][0];
    assert_eq!((&row["verdict"], &row["trace"]), (&json!("unknown"), &json!(null)));
    assert_eq!(row["reason"], "the limit of markings was reached");
    assert!((1..=100).contains(&row["states"].as_u64().unwrap()), "{row}");
}

#[test]
fn an_answer_names_the_run_and_the_bound() {
    let folder = Folder::new("check_json");
    let answer = check(&folder, "philosophers:2", &["EF deadlock"], &["--json"]).json(0);
    assert_eq!((&answer["model"], &answer["timed"]), (&json!("philosophers:2"), &json!(false)));
    let row = &answer["results"][0];
    assert_eq!((&row["verdict"], &row["property"]), (&json!("true"), &json!("EF deadlock")));
    let fired: Vec<_> =
        row["trace"].as_array().unwrap().iter().map(|it| it["transition"].clone()).collect();
    assert_eq!(fired.len(), 2, "{row}");
    let played = folder
        .shell(&format!("cotama simulate philosophers:2 {} {} --json", fired[0], fired[1]))
        .json(0);
    assert_eq!((&played["fired"], &played["enabled"]), (&json!(fired), &json!([])));
    let answer =
        check(&folder, "kanban:3", &["bounds(P1 + P2)", "bounds(P1)"], &["--json"]).json(0);
    let bounds: Vec<_> =
        answer["results"].as_array().unwrap().iter().map(|it| &it["bound"]).collect();
    assert_eq!(bounds, [6, 3]);
}

#[test]
fn a_property_that_holds_for_no_good_reason_is_named() {
    let folder = Folder::new("check_vacuous");
    let asked = ["AG ((Closing & Open) -> AF Closed)", "AG (Closing -> !obstacle)"];
    let answer = check(&folder, "door", &asked, &["--untimed", "--json"]).json(0);
    let said = [0, 1].map(|it| answer["results"][it]["vacuous"].as_str().unwrap_or("").to_owned());
    assert!(said[0].contains("holds vacuously") && said[1].is_empty(), "{said:?}");
}

#[test]
fn vacuity_that_is_not_found_out_is_said() {
    let folder = Folder::new("check_vacuous_parts");
    let who = |it| format!("(think_{it} | with_left_{it} | with_right_{it} | eat_{it})");
    let said = |number: usize| {
        let all: Vec<_> = (1..=number).map(who).collect();
        let ended = check(&folder, "philosophers:3", &[&format!("AG ({})", all.join(" & "))], &[]);
        assert_eq!(ended.code, Some(0));
        ended.stderr
    };
    assert_eq!(said(2), "", "eight parts");
    assert!(said(3).contains("whether it holds vacuously was tried for some of its parts only"));
}

#[test]
fn time_is_measured_where_there_are_intervals() {
    let folder = Folder::new("check_time");
    folder.write("race.net", "tr fast [1,2] idle -> won  tr late [5,7] won -> done  pl idle (1)");
    let answer =
        check(&folder, "race.net", &["bound(fast -> done)", "bound(late -> idle)"], &["--json"])
            .json(0);
    let [first, second] = [0, 1].map(|it| &answer["results"][it]);
    assert_eq!((&first["min"], &first["max"]), (&json!(5), &json!(7)));
    assert_eq!(first["states"], 3);
    assert_eq!((&second["min"], &second["max"]), (&json!("inf"), &json!("inf")));
    let answer = check(&folder, "race.net", &["EF done"], &["--json"]).json(0);
    assert_eq!(answer["results"][0]["trace"][1]["time"], "6");
    assert_eq!(check(&folder, "race.net", &["bound(fast -> done)"], &["--untimed"]).code, Some(3));
}

#[test]
fn the_laws_of_a_model_are_checked_when_nothing_is_asked() {
    let folder = Folder::new("check_laws");
    let answer = folder.cotama(&["check", "door", "--json"]).json(0);
    let names: Vec<_> =
        answer["results"].as_array().unwrap().iter().map(|it| it["name"].clone()).collect();
    assert_eq!(names.len(), 6);
    assert_eq!(names[1], "never_both(Closing, obstacle)");
    assert_eq!(answer["left_out"], json!(["handles(all)", "deterministic"]));
}

#[test]
fn a_file_without_laws_is_asked_the_usual_questions() {
    let folder = Folder::new("check_usual");
    folder.write("lamp.net", "tr on off -> lit  tr out lit -> off  pl off (1)");
    folder.write("pump.net", "tr in -> tank  tr out tank*2 ->");
    let usual = |model: &str, code| {
        let answer = folder.cotama(&["check", model, "--untimed", "--json"]).json(code);
        let row =
            |it: &serde_json::Value| format!("{} {} {}", it["name"], it["verdict"], it["bound"]);
        answer["results"]
            .as_array()
            .unwrap()
            .iter()
            .map(row)
            .collect::<Vec<_>>()
            .join("; ")
            .replace('"', "")
    };
    assert_eq!(
        usual("lamp.net", 0),
        "deadlock_free true null; one_safe true null; quasi_live true null"
    );
    assert_eq!(
        usual("pump.net", 0),
        "deadlock_free true null; bounds true inf; quasi_live true null"
    );
}

#[test]
fn a_run_leads_to_a_marking_that_loses_a_lasting_possibility() {
    let folder = Folder::new("check_lost");
    folder.write(
        "fuse.net",
        "net fuse\ntr on off -> lit\ntr out lit -> off\ntr burn lit -> dark\npl off (1)\n",
    );
    let answer =
        check(&folder, "fuse.net", &["AG EF lit"], &["--untimed", "--json", "--trace", "it.svg"])
            .json(1);
    let row = &answer["results"][0];
    let fired: Vec<_> =
        row["trace"].as_array().unwrap().iter().map(|it| &it["transition"]).collect();
    assert_eq!(fired, ["on", "burn"]);
    assert!(folder.read("it.svg").starts_with("<svg xmlns="));
}

#[test]
fn transitions_that_never_fire_and_places_never_marked_are_named() {
    let folder = Folder::new("check_unused");
    folder.write("alarm.net", ALARM);
    golden("check_unused.txt", &folder.cotama(&["check", "alarm.net"]).stdout);
    let more = ["--json", "--trace", "it.html"];
    let answer = check(&folder, "alarm.net", &["quasi_live"], &more).json(1);
    let unused = &answer["results"][0]["unused"];
    let ring = json!({"name": "ring", "why": "needs `smoke`, which is never marked"});
    assert_eq!((&unused["transitions"][0], &unused["is_complete"]), (&ring, &json!(true)));
    assert_eq!(unused["places"][0], json!({"name": "smoke", "why": "no transition marks it"}));
    let page = folder.read("it.html");
    assert!(
        page.starts_with("<!DOCTYPE html>")
            && page.contains("<code>ring</code>")
            && page.contains("<svg")
    );
    let more = ["--untimed", "--trace", "it.json"];
    assert_eq!(check(&folder, "alarm.net", &["live"], &more).code, Some(1));
    let written: serde_json::Value = serde_json::from_str(&folder.read("it.json")).unwrap();
    assert_eq!((&written["net"], &written["transitions"][0]), (&json!("alarm"), &ring));
}

#[test]
fn results_of_the_structure_are_named_at_a_limit() {
    let folder = Folder::new("check_unused_limit");
    folder.write("alarm.net", ALARM);
    let more = ["--untimed", "--max-states", "1", "--json"];
    let answer = check(&folder, "alarm.net", &["quasi_live"], &more).json(1);
    let unused = &answer["results"][0]["unused"];
    let names = |it: &serde_json::Value| {
        it.as_array().unwrap().iter().map(|it| it["name"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(
        (names(&unused["transitions"]), names(&unused["places"])),
        (vec![json!("ring")], vec![json!("smoke"), json!("noise")])
    );
    assert_eq!(unused["is_complete"], false);
}

#[test]
#[ignore = "seconds: CI runs it"]
fn a_system_can_be_checked_in_every_interleaving() {
    let folder = Folder::new("check_system");
    let more = ["--json", "--max-states", "100000", "--semantics", "interleaving"];
    let answer = check(&folder, "delivery", &["AG gs.Wait + gs.Wait.absent = 1"], &more).json(0);
    assert!(answer["notes"][0].as_str().unwrap().contains("every interleaving"), "{answer}");
}

/// Their truth is tested beside the checker.
#[test]
fn the_requirements_of_a_system_are_asked_by_their_numbers() {
    let folder = Folder::new("check_requirements_few");
    // Any limit will do. This one spares the work before the first marking of each question.
    let few = ["--max-seconds", "0", "--json"];
    let answer = check(&folder, "delivery", &[], &few).json(3);
    let rows = answer["results"].as_array().unwrap();
    assert_eq!((&rows[0]["id"], &rows[0]["name"]), (&json!("GS1"), &json!("GS1")));
    let first = "A global event is answered in the next round: the mission ends.";
    assert_eq!(rows[0]["sentence"], first);
    assert!(rows.iter().all(|it| it["verdict"] != "false"), "{answer}");
    assert_eq!(rows.len(), 31);
}

#[test]
fn files_hold_one_property_a_line_or_those_of_the_contest() {
    let folder = Folder::new("check_files");
    folder.write(
        "wanted.txt",
        "# of the door\n\nnever: AG !(Closing & obstacle)\n  EF Open\nlive\nEF deadlock\n",
    );
    let answer = folder
        .cotama(&["check", "door", "--untimed", "--properties", "wanted.txt", "--json"])
        .json(1);
    let rows = answer["results"].as_array().unwrap();
    let named: Vec<_> = rows
        .iter()
        .map(|it| (it["name"].as_str().unwrap(), it["verdict"].as_str().unwrap()))
        .collect();
    assert_eq!(
        named,
        [("never", "true"), ("EF Open", "true"), ("live", "true"), ("EF deadlock", "false")]
    );
    assert_eq!(folder.cotama(&["export", "door", "--output", "door.pnml"]).code, Some(0));
    folder.write("wanted.xml", CONTEST);
    let mcc =
        folder.cotama(&["check", "door.pnml", "--untimed", "--properties", "wanted.xml", "--mcc"]);
    assert_eq!(mcc.code, Some(0), "{mcc:?}");
    let lines: Vec<_> =
        mcc.stdout.lines().map(|it| it.split(" TECHNIQUES ").next().unwrap()).collect();
    assert_eq!(lines, ["FORMULA never-two TRUE", "FORMULA most 1"]);
}

#[test]
fn the_contest_is_told_when_nothing_is_known() {
    let folder = Folder::new("check_contest");
    let asked = ["ReachabilityDeadlock", "OneSafe"];
    let ended = check(&folder, "philosophers:3", &asked, &["--mcc"]);
    let lines: Vec<_> =
        ended.stdout.lines().map(|it| it.split(" TECHNIQUES ").next().unwrap()).collect();
    assert_eq!(lines, ["FORMULA ReachabilityDeadlock TRUE", "FORMULA OneSafe TRUE"]);
    let more = ["--mcc", "--engine", "explicit", "--max-states", "5"];
    let ended = check(&folder, "philosophers:3", &["ReachabilityDeadlock"], &more);
    assert_eq!(
        (ended.code, ended.stdout.as_str()),
        (Some(3), "FORMULA ReachabilityDeadlock CANNOT_COMPUTE\n")
    );
    let ended = check(&folder, "watchdog", &["bound(w1 -> Fault)"], &["--mcc"]);
    assert_eq!(ended.code, Some(2), "{ended:?}");
}

#[test]
fn an_error_in_a_property_is_shown_at_its_place() {
    let folder = Folder::new("check_wrong");
    let said = |properties: &[&str]| {
        let ended = check(&folder, "door", properties, &[]);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
        ended.stderr
    };
    golden("bad_property_place.txt", &said(&["AG !(Closng & obstacle)"]));
    golden("bad_property_syntax.txt", &said(&["AG (Closing &"]));
    folder.write("wanted.txt", "# two are wrong\nfirst: EF Opn\nEF Open\nthird: AG bounds(\n");
    golden(
        "bad_property_file.txt",
        &folder.cotama(&["check", "door", "--properties", "wanted.txt"]).stderr,
    );
    folder.write("wanted.xml", CONTEST.replace("p0", "nowhere"));
    golden(
        "bad_property_contest.txt",
        &folder.cotama(&["check", "door", "--properties", "wanted.xml"]).stderr,
    );
    folder.write("cut.xml", &CONTEST[..200]);
    let ended = folder.cotama(&["check", "door", "--properties", "cut.xml"]);
    assert!(ended.code == Some(2) && ended.stderr.contains("cut.xml:"), "{ended:?}");
    folder.write("empty.txt", "# nothing\n");
    assert_eq!(folder.cotama(&["check", "door", "--properties", "empty.txt"]).code, Some(2));
    folder.write("bad.net", "tr a [3,2] p -> q\n");
    let ended = folder.cotama(&["check", "bad.net"]);
    assert!(ended.code == Some(2) && ended.stderr.contains("bad.net:1:"), "{ended:?}");
}

#[test]
fn an_engine_of_another_version_and_a_trace_of_no_form_are_refused() {
    let folder = Folder::new("check_refused");
    for more in [
        ["--engine", "symbolic"],
        ["--engine", "sat"],
        ["--trace", "run.txt"],
        ["--max-seconds", "-1"],
    ] {
        let ended = check(&folder, "door", &["EF Open"], &more);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{more:?}");
    }
    assert_eq!(folder.files(""), [""; 0]);
}

/// A net that stops, as a test case that fails and a finding with the way there.
#[test]
fn build_servers_and_editors_read_the_verdicts() {
    let folder = Folder::new("check_reports");
    folder.write("alarm.net", ALARM);
    let more = ["--untimed", "--junit", "a.xml", "--sarif", "a.sarif", "--max-states", "3"];
    let ended = check(&folder, "alarm.net", &["AG !old", "AG EF idle", "EF noise"], &more);
    assert_eq!(ended.code, Some(1), "{ended:?}");
    let text = folder.read("a.xml");
    let without_times = text.lines().map(|it| match it.rsplit_once(" time=") {
        Some((before, after)) => {
            before.to_owned() + after.trim_start_matches(|it: char| it != '>' && it != '/')
        }
        None => it.to_owned(),
    });
    golden("check_junit.xml", &(without_times.collect::<Vec<_>>().join("\n") + "\n"));
    let sarif = serde_json::from_str(&folder.read("a.sarif")).unwrap();
    golden("check_sarif.json", &cotama_golden::json_lines(&sarif));
}

#[test]
fn a_file_is_checked_again_when_it_changes() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};
    let folder = Folder::new("check_watch");
    folder.write("alarm.net", ALARM);
    let ended = folder.cotama(&["check", "door", "--watch"]);
    assert_eq!(ended.code, Some(2), "{ended:?}");
    assert!(ended.stderr.contains("there is no file to watch"), "{ended:?}");

    let mut program = Command::new(env!("CARGO_BIN_EXE_cotama"))
        .args(["check", "alarm.net", "--untimed", "--property", "EF old", "--watch"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(program.stdout.take().unwrap()).lines();
    let mut verdict =
        || lines.by_ref().map(Result::unwrap).find(|it| it.ends_with("  EF old")).unwrap();
    assert!(verdict().starts_with("  true"));
    folder.write("alarm.net", ALARM.replace("late [3,4] idle", "late [3,4] smoke"));
    assert!(verdict().starts_with("  false"));
    program.kill().unwrap();
    program.wait().unwrap();
}
