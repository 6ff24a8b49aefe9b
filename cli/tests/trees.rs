//! Behaviour trees through the commands on models.

use crate::common::Folder;
use crate::schemas::validate;
use serde_json::Value;

const TREE: &str = r#"<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <RecoveryNode number_of_retries="2">
      <FollowPath path="{path}"/>
      <RoundRobin><Spin/><BackUp/></RoundRobin>
    </RecoveryNode>
  </BehaviorTree>
</root>
"#;

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("tree.xml", TREE);
    folder
}

fn row<'a>(answer: &'a Value, name: &str) -> &'a Value {
    answer["results"].as_array().unwrap().iter().find(|it| it["name"] == name).unwrap()
}

#[test]
fn a_lost_success_is_found_with_its_run_and_its_line() {
    let folder = folder("trees_check");
    let answer = folder.cotama(&["check", "tree.xml", "--json"]).json(0);
    validate("check-tree", &answer);
    let lost = row(&answer, "success-lost");
    assert_eq!((&lost["verdict"], &lost["level"]), (&"false".into(), &"warning".into()));
    assert_eq!(lost["nodes"], serde_json::json!(["BackUp", "RoundRobin@3"]));
    assert_eq!((&lost["line"], &lost["column"]), (&5.into(), &26.into()));
    let tick = &lost["trace"][0];
    assert_eq!(tick["events"], serde_json::json!(["FollowPath:F", "Spin:F", "BackUp:S"]));
    assert_eq!(tick["status"], "F");
    assert_eq!(row(&answer, "exception")["verdict"], "true");
    assert_eq!(folder.cotama(&["check", "tree.xml", "--deny", "warnings"]).code, Some(1));
}

#[test]
fn own_properties_assumptions_and_exclusive_actions_decide_the_exit_code() {
    let folder = folder("trees_own");
    let code = |more: &[&str]| {
        let ended = folder.cotama(&[&["check", "tree.xml"], more].concat());
        ended.code
    };
    assert_eq!(code(&["--property", "AG !(Spin.running & BackUp.running)"]), Some(0));
    assert_eq!(code(&["--property", "AF root.success"]), Some(1));
    assert_eq!(
        code(&["--property", "AF root.success", "--assume", "FollowPath succeeds"]),
        Some(0)
    );
    assert_eq!(code(&["--exclusive", "Spin,BackUp"]), Some(0));
    assert_eq!(code(&["--max-states", "2"]), Some(3));
    for (more, said) in [
        (["--property", "AG Spn.running"], "no node Spn; did you mean Spin?"),
        (["--assume", "Spn succeeds"], "no leaf Spn; did you mean Spin?"),
        (["--exclusive", "Spn"], "--exclusive: no action Spn"),
        (["--engine", "explicit"], "--engine is not for behaviour trees"),
    ] {
        let ended = folder.cotama(&[&["check", "tree.xml"], &more[..]].concat());
        assert_eq!(ended.code, Some(2), "{more:?}");
        assert!(ended.stderr.contains(said), "{}", ended.stderr);
    }
    let ended = folder.cotama(&["check", "door", "--assume", "a succeeds"]);
    assert!(ended.stderr.contains("--assume is for behaviour trees"), "{}", ended.stderr);
}

#[test]
fn a_page_and_a_report_are_written() {
    let folder = folder("trees_files");
    let line = ["check", "tree.xml", "--html", "pages", "--sarif", "it.sarif"];
    assert_eq!(folder.cotama(&line).code, Some(0));
    let page = folder.read("pages/index.html");
    assert!(page.contains("SUCCESS of BackUp is lost") && page.contains("data-frames"));
    assert!(!page.contains("src=") && !page.contains("http"), "nothing comes from elsewhere");
    let log: Value = serde_json::from_str(&folder.read("it.sarif")).unwrap();
    let lost = &log["runs"][0]["results"][0];
    assert_eq!(lost["ruleId"], "success-lost");
    assert_eq!(lost["locations"][0]["physicalLocation"]["region"]["startLine"], 5);
}

#[test]
fn a_trace_is_accepted_or_departs_in_a_row() {
    let folder = folder("trees_conform");
    let rows =
        "1\t1\ttick\t0\t-\tFollowPath:R\tR\tpath=?\n1\t2\ttick\t0\t-\tFollowPath~S\tS\tpath=?\n";
    folder.write("run.tsv", rows);
    let answer = folder.cotama(&["conform", "tree.xml", "run.tsv", "--json"]).json(0);
    validate("conform-tree", &answer);
    assert_eq!((&answer["runs"], &answer["rows"]), (&1.into(), &2.into()));
    folder.write("wrong.tsv", rows.replace("~S\tS", "~S\tF"));
    let answer = folder.cotama(&["conform", "tree.xml", "wrong.tsv", "--json"]).json(1);
    let departs = &answer["departs"];
    assert_eq!((&departs["line"], &departs["column"]), (&2.into(), &"status".into()));
    assert_eq!(departs["allowed"], "S");
}

#[test]
fn a_tree_is_played_counted_and_written() {
    let folder = folder("trees_rest");
    let answer = folder.cotama(&["simulate", "tree.xml", "F", "Spin=S", "R", "--json"]).json(0);
    validate("simulate-tree", &answer);
    assert_eq!(answer["ticks"][0]["status"], "R");
    assert_eq!(answer["asked"], "FollowPath~ S F R K");
    let answer = folder.cotama(&["statespace", "tree.xml", "--json"]).json(0);
    validate("statespace-tree", &answer);
    assert_eq!((&answer["states"], &answer["minimal"]), (&6.into(), &5.into()));
    for format in ["svg", "dot", "mermaid", "btcpp", "json"] {
        let ended = folder.cotama(&["export", "tree.xml", "--format", format]);
        assert_eq!(ended.code, Some(0), "{format}: {}", ended.stderr);
        assert!(ended.stdout.contains("BackUp"), "{format}");
    }
    assert_eq!(folder.cotama(&["export", "tree.xml", "--format", "scxml"]).code, Some(2));
    assert_eq!(folder.cotama(&["export", "door", "--format", "btcpp"]).code, Some(2));
}

#[test]
fn a_wrong_tree_is_refused_at_its_place() {
    let folder = folder("trees_wrong");
    folder.write("wrong.xml", TREE.replace("<Spin/>", "<Spinn/>"));
    let answer = folder.cotama(&["check", "wrong.xml", "--json"]).json(2);
    assert_eq!(answer["message"], "unknown node Spinn: neither built in nor described");
    assert_eq!((&answer["line"], &answer["column"]), (&5.into(), &19.into()));
    folder.write("leaves.tsv", "Spinn\tstateful\n");
    let line = ["check", "wrong.xml", "--leaves", "leaves.tsv"];
    assert_eq!(folder.cotama(&line).code, Some(0));
    folder.write("throws.xml", TREE.replace("<BackUp/></RoundRobin>", "</RoundRobin><BackUp/>"));
    let ended = folder.cotama(&["check", "throws.xml"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("RecoveryNode has 3 children, and needs 2"), "{}", ended.stderr);
}

#[test]
fn a_certificate_is_verified_and_a_changed_one_is_refused() {
    let folder = folder("trees_certificate");
    let property = ["--property", "AG !(Spin.running & BackUp.running)"];
    let line = ["check", "tree.xml", "--certificate", "it.json", "--exclusive", "Spin,BackUp"];
    assert_eq!(folder.cotama(&[&line[..], &property].concat()).code, Some(0));
    let answer = folder.cotama(&["verify", "it.json", "--json"]).json(0);
    validate("verify", &answer);
    assert_eq!(answer["tree"], "Main (5 nodes)");
    let shown = answer["question"].as_str().unwrap();
    assert!(shown.contains("exclusive") && shown.ends_with(property[1]), "{shown}");
    let other = folder.read("it.json").replace("RoundRobin>", "ParallelAll>");
    folder.write("other.json", &other);
    let ended = folder.cotama(&["verify", "other.json"]);
    assert_eq!(ended.code, Some(1));
    assert!(ended.stdout.contains("is not shown"), "{}", ended.stdout);
}

#[test]
fn a_tree_is_a_net_with_the_same_verdicts() {
    let folder = folder("trees_net");
    for format in ["pnml", "jani"] {
        let file = format!("tree.{format}");
        let line = ["export", "tree.xml", "--format", format, "--output", &file];
        assert_eq!(folder.cotama(&line).code, Some(0));
    }
    // As the tree: S and F end it, an end can always be reached, nothing is thrown.
    for (property, code) in [
        ("EF end_S", 0),
        ("EF end_F", 0),
        ("AG EF ended", 0),
        ("AG !(end_S & end_F)", 0),
        ("AG !end_F", 1),
    ] {
        let ended = folder.cotama(&["check", "tree.pnml", "--property", property]);
        assert_eq!(ended.code, Some(code), "{property}: {}", ended.stdout);
    }
    let jani: Value = serde_json::from_str(&folder.read("tree.jani")).unwrap();
    let states = folder.cotama(&["statespace", "tree.xml", "--json"]).json(0);
    let points = jani["variables"].as_array().unwrap().len() as u64;
    let (states, asks) = (states["states"].as_u64(), states["questions"].as_u64());
    assert_eq!(points, states.unwrap() + asks.unwrap() + 2 + 1);
}

#[test]
fn a_tree_beside_a_supervisor_is_a_net_with_the_same_verdicts() {
    let folder = Folder::new("trees_supervised_net");
    let tree = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
      <Sequence><Drive name="ToA"/><Stands/><Drive name="ToB"/></Sequence>
      </BehaviorTree></root>"#;
    folder.write("tree.xml", tree);
    for (ends, can_end) in [("upon ended", true), ("at End", false)] {
        let drive = format!("Drive starts start_drive succeeds {ends} halts gs_abort");
        folder.write("drive.txt", format!("{drive}\nStands succeeds at Idle\n"));
        let with = |more: &[&str]| {
            folder.cotama(&[more, &["--with", "local", "--bind", "drive.txt"]].concat())
        };
        let code = i32::from(!can_end);
        let answer = with(&["check", "tree.xml", "--json"]).json(code);
        assert_eq!(row(&answer, "stuck")["verdict"], can_end.to_string());
        let line = ["export", "tree.xml", "--format", "pnml", "--output", "tree.pnml"];
        assert_eq!(with(&line).code, Some(0));
        let ended = folder.cotama(&["check", "tree.pnml", "--property", "AG EF ended"]);
        assert_eq!(ended.code, Some(code), "{}", ended.stdout);
    }
}

#[test]
fn at_a_period_timers_count_and_differences_are_told() {
    let folder = Folder::new("trees_period");
    let tree = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
      <Timeout msec="65"><RetryUntilSuccessful num_attempts="-1"><Delay delay_msec="100"><Spin/>
      </Delay></RetryUntilSuccessful></Timeout></BehaviorTree></root>"#;
    folder.write("tree.xml", tree);
    let free = folder.cotama(&["check", "tree.xml", "--json"]).json(0);
    let timed = folder.cotama(&["check", "tree.xml", "--period", "10", "--json"]).json(0);
    assert_eq!(row(&free, "can-succeed")["verdict"], "true");
    // The delay is longer than the timeout.
    assert_eq!(row(&timed, "can-succeed")["verdict"], "false");
    let notes = timed["notes"].to_string();
    let bound = "Timeout@1 halts its child at most 7 ticks, 70 ms, after its start";
    assert!(notes.contains(bound), "{notes}");
    assert!(notes.contains("can-succeed: false, with free timers true"), "{notes}");
}

#[test]
fn a_supervisor_beside_a_tree_refuses_a_start_and_is_seen_in_each_tick() {
    let folder = folder("trees_supervised");
    let tree = TREE.replace("FollowPath path=\"{path}\"", "Drive name=\"ToA\"");
    folder.write("tree.xml", tree.replace("Spin", "Drive name=\"ToB\""));
    let drive = "Drive starts start_drive succeeds upon ended fails at HandOver or after abort\n";
    folder.write("drive.txt", drive);
    let beside = ["--with", "local", "--bind", "drive.txt"];
    let with = |more: &[&str]| folder.cotama(&[more, &beside].concat());
    let answer = with(&["check", "tree.xml", "--json"]).json(0);
    validate("check-tree", &answer);
    let refused = row(&answer, "refused");
    assert_eq!((&refused["level"], &refused["nodes"][0]), (&"warning".into(), &"ToA".into()));
    let ticks = refused["trace"].as_array().unwrap();
    assert_eq!(ticks[0]["events"], serde_json::json!(["ToA>start_drive", "ToA=R"]));
    assert_eq!(ticks[0]["marked"], serde_json::json!(["Planning", "camera", "wifi"]));
    assert_eq!(with(&["check", "tree.xml", "--deny", "warnings"]).code, Some(1));
    let played = with(&["simulate", "tree.xml", "--json", "path_ready", "-"]).json(0);
    validate("simulate-tree", &played);
    assert_eq!(played["ticks"][0]["marked"][0], "Planning");
    assert_eq!(played["ticks"][1]["events"][0], "(path_ready)");
    let space = with(&["statespace", "tree.xml", "--json"]).json(0);
    assert_eq!(space["complete"], true);
    let more = ["--property", "AG !net.Idel"];
    let ended = with(&[&["check", "tree.xml"], more.as_slice()].concat());
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("no place Idel; did you mean Idle?"), "{}", ended.stderr);
    let finally = ["--property", "AG (net.Planning -> AF (done | ToB.ticked))"];
    let line = ["check", "tree.xml", "--certificate", "c.json"];
    with(&[&line[..], &finally].concat());
    let shown = folder.cotama(&["verify", "c.json", "--json"]).json(0);
    let shown = shown["question"].as_str().unwrap().to_owned();
    assert!(shown.contains("never-ends") && !shown.contains("refused"), "{shown}");
    let forged = folder.read("c.json").replace("\"stuck\"", "\"refused\"");
    folder.write("forged.json", &forged);
    assert_eq!(folder.cotama(&["verify", "forged.json"]).code, Some(1));
    let other = folder.read("c.json").replace("starts start_drive", "starts gs_abort");
    folder.write("forged.json", &other);
    assert_eq!(folder.cotama(&["verify", "forged.json"]).code, Some(1));
    folder.write("drive.txt", "Drive starts strat_drive succeeds at End\n");
    let ended = with(&["check", "tree.xml"]);
    assert!(ended.stderr.contains("no event strat_drive; did you mean start_drive?"));
    assert!(ended.stderr.contains("drive.txt:1:14"), "{}", ended.stderr);
    assert_eq!(folder.cotama(&["check", "tree.xml", "--with", "local"]).code, Some(2));
}
