//! Nodes that somebody steers, that take from a queue of the blackboard, or that tick when they are
//! halted. No trace has them: rows as the source of the library and of Nav2 says.

use cotama_trees::conform::{conform, read};
use cotama_trees::explore::{Assumptions, Limits, Property, Space, check_property, parse_property};
use cotama_trees::findings::{Report, Wishes, check};
use cotama_trees::machine::{Machine, Reply, Stop};
use cotama_trees::page::{Section, html};
use cotama_trees::reader::read_text;
use cotama_trees::replay::frames;
use cotama_trees::tree::Tree;

fn tree(inner: &str) -> Tree {
    let text =
        format!("<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">{inner}</BehaviorTree></root>");
    read_text(&text).unwrap_or_else(|it| panic!("{it}")).tree
}

/// Ticks a tree with letters for replies, or halts it where they begin with `!`; returns what each
/// asked, answered and left. The same rows conform to the tree.
fn played(inner: &str, steps: &[&str]) -> Vec<String> {
    let tree = tree(inner);
    let mut machine = Machine::new(&tree);
    let (mut said, mut rows) = (Vec::new(), String::new());
    for (at, letters) in steps.iter().enumerate() {
        let halts = letters.starts_with('!');
        let mut stop = if halts { machine.halt_tree() } else { machine.tick() };
        for letter in letters.trim_start_matches('!').chars() {
            assert!(matches!(stop, Stop::Asked(_)), "{said:?}: {stop:?}");
            stop = machine.reply(Reply::of_letter(letter).unwrap());
        }
        let status = match stop {
            Stop::Answered(answer) => answer.letter().to_string(),
            Stop::Halted => "H".to_owned(),
            Stop::Thrown(it) => {
                let node = it.node.map(|it| format!("@{}", tree.nodes[it].name));
                format!("X{}", node.unwrap_or_default())
            }
            Stop::Asked(it) => panic!("{said:?}: {} asks", tree.shown(it.node)),
        };
        let events = machine.take_events();
        let events: Vec<_> = events.iter().map(|it| it.shown(&tree)).collect();
        let events = if events.is_empty() { "-".to_owned() } else { events.join(" ") };
        let (op, board) = (if halts { "halt" } else { "tick" }, machine.blackboard());
        rows += &format!("1\t{at}\t{op}\t0\t-\t{events}\t{status}\t{board}\n");
        let board = if board == "-" { String::new() } else { format!(" {board}") };
        said.push(format!("{events} {status}{board}"));
    }
    let accepted = conform(&tree, &read(&rows).unwrap(), false);
    assert_eq!(accepted.map(|it| it.rows), Ok(steps.len()));
    said
}

/// Returns the report about a tree; each run of it is repeated and drawn.
fn report(tree: &Tree) -> Report {
    let report = check(tree, &Wishes::default(), Limits::default());
    for it in &report.findings {
        let Some(run) = &it.run else { continue };
        assert_eq!(frames(tree, run).map(|it| it.len()), Ok(run.steps.len()), "{}", it.message);
        let (title, help) = (it.message.clone(), it.help.to_owned());
        let section = Section { class: it.level.word(), title, help, run: Some(run) };
        assert!(html(tree, "T", &[section]).contains("data-frames"));
    }
    report
}

fn asked(report: &Report, question: &str) -> bool {
    report.asked.iter().find(|it| it.question == question).unwrap().holds.unwrap()
}

fn holds(tree: &Tree, text: &str) -> bool {
    let property: Property = parse_property(tree, text).unwrap();
    let found = check_property(tree, &property, false, Assumptions::default(), Limits::default());
    let Some(run) = &found.run else { return found.holds.unwrap() };
    assert_eq!(frames(tree, run).map(|it| it.len()), Ok(run.steps.len()), "{text}");
    found.holds.unwrap()
}

const CLEANS: &str = "<ReactiveSequence><C1/><TryCatch catch_on_halt=\"true\"><A1/>\
    <Sequence><A2/><S3/></Sequence></TryCatch></ReactiveSequence>";

#[test]
fn a_try_that_is_halted_ticks_its_last_child_once() {
    let said = played(CLEANS, &["SR", "FSS", "SR", "FSF", "SR", "FR", "SR", "FF"]);
    let wanted = [
        "C1:S A1:R R",
        "C1:F A1! A2:S S3:S F",
        "C1:S A1:R R",
        "C1:F A1! A2:S S3:F F",
        "C1:S A1:R R",
        "C1:F A1! A2:R A2! F",
        "C1:S A1:R R",
        "C1:F A1! A2:F F",
    ];
    assert_eq!(said, wanted);
}

#[test]
fn a_try_that_catches_already_does_not_catch_once_more() {
    let said = played(CLEANS, &["SFR", "F", "SR", "!SS", "!", "SFR", "!"]);
    let wanted = [
        "C1:S A1:F A2:R R",
        "C1:F A2! F",
        "C1:S A1:R R",
        "A1! A2:S S3:S H",
        "- H",
        "C1:S A1:F A2:R R",
        "A2! H",
    ];
    assert_eq!(said, wanted);
}

#[test]
fn a_root_that_is_halted_catches_once_and_begins_anew() {
    let inner = "<TryCatch catch_on_halt=\"true\"><A1/><S2/></TryCatch>";
    assert_eq!(played(inner, &["R", "!S", "!", "R"]), ["A1:R R", "A1! S2:S H", "- H", "A1:R R"]);
}

#[test]
fn a_timer_that_halts_a_try_lets_it_catch_before_the_next_tick() {
    let inner = "<Timeout msec=\"50\"><TryCatch catch_on_halt=\"true\"><A1/><S2/></TryCatch>\
                 </Timeout>";
    let said = played(inner, &["R", "TS", "R", "TF"]);
    assert_eq!(said, ["A1:R R", "Timeout?T A1! S2:S F", "A1:R R", "Timeout?T A1! S2:F F"]);
}

#[test]
fn a_try_within_what_catches_catches_too() {
    let inner = "<ReactiveSequence><C1/><TryCatch catch_on_halt=\"true\"><A1/>\
        <TryCatch catch_on_halt=\"true\"><A2/><S3/></TryCatch></TryCatch></ReactiveSequence>";
    assert_eq!(played(inner, &["SR", "FRS"]), ["C1:S A1:R R", "C1:F A1! A2:R A2! S3:S F"]);
}

#[test]
fn an_exception_within_halting_names_the_node_that_throws() {
    let inner = "<ReactiveSequence><C1/><TryCatch catch_on_halt=\"true\"><A1/>\
        <Sequence><S2/><Script code=\"x = 1\"/></Sequence></TryCatch></ReactiveSequence>";
    assert_eq!(played(inner, &["SR", "FS"]), ["C1:S A1:R R", "C1:F A1! S2:S X@Script"]);
    let tree = tree(inner);
    let report = report(&tree);
    assert!(!asked(&report, "halt-exception"));
    assert!(!asked(&report, "exception"));
    assert!(!holds(&tree, "AG !S2.ticked"));
}

#[test]
fn runs_of_a_try_that_cleans_up_are_found_merged_and_bounded() {
    let tree = tree(CLEANS);
    let report = report(&tree);
    assert!(asked(&report, "never-ends") && asked(&report, "halt-exception"));
    assert!(holds(&tree, "AG !(A1.running & A2.running)"));
    assert!(holds(&tree, "EF (C1.failure & S3.success)"));
    assert!(holds(&tree, "AG !(done & A2.running)"));
    let mut space = Space::explore(&tree, false, Assumptions::default(), Limits::default());
    assert_eq!((space.size(), space.minimal()), ((3, 10, 28), 3));
}

#[test]
fn a_text_on_the_blackboard_is_a_queue_that_is_used_up_for_good() {
    let inner = "<Sequence><Script code=\"q := '7;8;'\"/><LoopInt queue=\"{q}\" value=\"{v}\">\
                 <A1/></LoopInt></Sequence>";
    let said = played(inner, &["R", "S", "R", "!", "", ""]);
    let wanted = [
        "A1:R R q='7;8;';v=7",
        "A1~S R q='7;8;';v=7",
        "A1:R R q='7;8;';v=8",
        "A1! H q='7;8;';v=8",
        "- S q='7;8;';v=8",
        "- S q='7;8;';v=8",
    ];
    assert_eq!(said, wanted);
    let wrong = "<Sequence><Script code=\"q := '7;b'\"/><LoopInt queue=\"{q}\"><A1/></LoopInt>\
                 </Sequence>";
    assert_eq!(played(wrong, &[""]), ["- X@LoopInt q='7;b'"]);
    let number = wrong.replace("'7;b'", "7");
    assert_eq!(played(&number, &[""]), ["- X@LoopInt q=7"]);
}

#[test]
fn a_queue_that_the_tree_does_not_write_has_items_as_long_as_the_world_says() {
    let inner = "<LoopString queue=\"{q}\" value=\"{v}\" if_empty=\"FAILURE\"><A1/></LoopString>";
    let said = played(inner, &["TR", "S", "TS", "N", "TF"]);
    let wanted = [
        "LoopString?T A1:R R q=?;v=?",
        "A1~S R q=?;v=?",
        "LoopString?T A1:S R q=?;v=?",
        "LoopString?N F q=?;v=?",
        "LoopString?T A1:F F q=?;v=?",
    ];
    assert_eq!(said, wanted);
    let tree = tree(inner);
    let report = report(&tree);
    // A queue is empty at last.
    assert!(asked(&report, "never-ends"));
    assert!(holds(&tree, "AF done"));
    assert!(!holds(&tree, "AF A1.ticked"));
}

#[test]
fn the_value_of_a_loop_counts_as_written() {
    let inner = "<Sequence><LoopString queue=\"{q}\" value=\"{v}\"><WasEntryUpdated \
                 entry=\"{v}\"/></LoopString></Sequence>";
    assert_eq!(played(inner, &["T", "N"]), ["LoopString?T R q=?;v=?", "LoopString?N S q=?;v=?"]);
}

#[test]
fn a_menu_ticks_the_child_that_somebody_chooses_and_resets_none() {
    let inner = "<ManualSelector><A1/><A2/></ManualSelector>";
    let said = played(inner, &["1R", "2R", "R", "1S", "1", "S", "F", "!"]);
    let wanted = [
        "ManualSelector?1 A1:R R",
        "ManualSelector?2 A2:R R",
        "ManualSelector?R R",
        "ManualSelector?1 A1~S S",
        "ManualSelector?1 S",
        "ManualSelector?S S",
        "ManualSelector?F F",
        "A2! H",
    ];
    assert_eq!(said, wanted);
    let last = played(inner, &["1R", "2R", "1R", "!"]);
    assert_eq!(last[3], "A1! A2! H");
    let last = played(inner, &["1R", "2R", "!"]);
    assert_eq!(last[2], "A2! A1! H");
    let tree = tree(inner);
    let report = report(&tree);
    assert!(asked(&report, "never-ends") && asked(&report, "can-succeed"));
    assert!(!holds(&tree, "AG !(A1.running & A2.running)"));
}

#[test]
fn a_menu_that_repeats_ticks_the_same_child_and_fails_upon_a_status() {
    let inner = "<ManualSelector repeat_last_selection=\"true\"><C1/><C2/></ManualSelector>";
    let said = played(inner, &["2S", "F"]);
    assert_eq!(said, ["ManualSelector?2 C2:S S", "C2:F F"]);
    let said = played(inner, &["S", ""]);
    assert_eq!(said, ["ManualSelector?S S", "- X@ManualSelector"]);
}

const PAUSES: &str = "<PauseResumeController><A1/><A2/><A3/><A4/></PauseResumeController>";

#[test]
fn a_controller_pauses_and_resumes_through_its_four_children() {
    let said = played(PAUSES, &["TR", "NR", "TS", "NR", "TTS", "TR", "TS", "T"]);
    let wanted = [
        "PauseResumeController?T A1:R R",
        "PauseResumeController?N A1! A3:R R",
        "PauseResumeController?T A3~S R",
        "PauseResumeController?N A2:R R",
        "PauseResumeController?T PauseResumeController?T A2! A4:S R",
        "PauseResumeController?T A1:R R",
        "PauseResumeController?T A1~S S",
        // Nobody has reset the child.
        "PauseResumeController?T S",
    ];
    assert_eq!(said, wanted);
}

#[test]
fn a_controller_can_be_paused_anew_at_once_and_fails_with_any_child() {
    let said = played(PAUSES, &["NS", "NR", "TNS", "NF", "TR", "!"]);
    let wanted = [
        "PauseResumeController?N A3:S R",
        "PauseResumeController?N A2:R R",
        "PauseResumeController?T PauseResumeController?N A2! A3:S R",
        "PauseResumeController?N A2:F F",
        // It begins anew, resumed.
        "PauseResumeController?T A1:R R",
        "A1! H",
    ];
    assert_eq!(said, wanted);
    let two = "<PauseResumeController><A1/><C2/></PauseResumeController>";
    let said = played(two, &["N", "NS", "TT", "TR", "!"]);
    let wanted = [
        "PauseResumeController?N R",
        "PauseResumeController?N C2:S R",
        "PauseResumeController?T PauseResumeController?T R",
        "PauseResumeController?T A1:R R",
        "A1! H",
    ];
    assert_eq!(said, wanted);
}

#[test]
fn a_controller_is_resumed_at_last_and_need_not_be_paused() {
    let tree = tree(PAUSES);
    let report = report(&tree);
    assert!(asked(&report, "never-ends") && asked(&report, "stuck"));
    assert!(holds(&tree, "AF done") && !holds(&tree, "AF A3.ticked"));
    assert!(holds(&tree, "AG !(A1.running & A3.running)"));
    let runs = "<PauseResumeController><KeepRunningUntilFailure><A1/></KeepRunningUntilFailure>\
                </PauseResumeController>";
    assert!(!asked(&self::report(&self::tree(runs)), "never-ends"));
}

#[test]
fn a_menu_of_ten_children_and_a_controller_of_five_are_told() {
    let refused = |inner: &str| {
        let text = format!(
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">{inner}\
                            </BehaviorTree></root>"
        );
        match read_text(&text) {
            Err(it) => it.to_string(),
            Ok(it) => it.notes.iter().map(|it| format!("{it:?}")).collect(),
        }
    };
    let ten = format!("<ManualSelector>{}</ManualSelector>", "<C1/>".repeat(10));
    assert!(refused(&ten).contains("ManualSelector has 10 children"));
    let five = format!("<PauseResumeController>{}</PauseResumeController>", "<C1/>".repeat(5));
    assert!(refused(&five).contains("has 5 children, and takes at most 4"));
}
