//! Memories when a leaf skips, or a run has ended before: traces show them not. Rows as the second
//! program has them.

use cotama_trees::machine::{Machine, Reply, Status, Stop};
use cotama_trees::reader::read_text;
use cotama_trees::tree::Answer;

/// Ticks a tree with letters for replies; returns what each tick asked, answered and left.
fn played(inner: &str, ticks: &[&str]) -> Vec<String> {
    played_every(None, inner, ticks)
}

/// Ticks it so every so many ms.
fn played_every(period: Option<u32>, inner: &str, ticks: &[&str]) -> Vec<String> {
    let text =
        format!("<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">{inner}</BehaviorTree></root>");
    let tree = read_text(&text).unwrap().tree;
    let mut machine = match period {
        Some(ms) => Machine::with_period(&tree, ms),
        None => Machine::new(&tree),
    };
    let mut said = Vec::new();
    for letters in ticks {
        let mut stop = machine.tick();
        for letter in letters.chars() {
            assert!(matches!(stop, Stop::Asked(_)), "{said:?}: {stop:?}");
            stop = machine.reply(Reply::of_letter(letter).unwrap());
        }
        let Stop::Answered(answer) = stop else { panic!("{said:?}: {stop:?}") };
        let events = machine.take_events();
        let events: Vec<_> = events.iter().map(|it| it.shown(&tree)).collect();
        let board = machine.blackboard();
        let board = if board == "-" { String::new() } else { format!(" {board}") };
        said.push(format!("{} {}{board}", events.join(" "), answer.letter()));
    }
    said
}

#[test]
fn after_a_recovery_that_skips_the_first_child_is_tried() {
    let inner = "<RecoveryNode number_of_retries=\"2\"><A1/><A2/></RecoveryNode>";
    let said = played(inner, &["FR", "K", "S"]);
    assert_eq!(said, ["A1:F A2:R R", "A2~K A2! F", "A1:S S"]);
}

#[test]
fn a_loop_whose_child_skips_goes_on_with_its_queue() {
    let loops = "<LoopInt queue=\"1;2\" value=\"{x}\"><C1/></LoopInt>";
    assert_eq!(played(loops, &["K", "S", ""]), ["C1:K R x=1", "C1:S R x=2", " S x=2"]);
}

#[test]
fn a_try_forgets_what_was_skipped_before_it_caught() {
    let said = played("<TryCatch><C1/><C2/><A3/></TryCatch>", &["KFS", "SK"]);
    assert_eq!(said, ["C1:K C2:F A3:S F", "C1:S C2:K S"]);
}

#[test]
fn a_decorator_whose_child_skips_still_runs_and_is_halted() {
    for tag in ["Inverter", "ForceSuccess", "ForceFailure", "SingleTrigger"] {
        let inner = format!("<Sequence><{tag} _onHalted=\"x := 1\"><C1/></{tag}></Sequence>");
        assert_eq!(played(&inner, &["K"]), ["C1:K K x=1"], "{tag}");
    }
}

#[test]
fn a_rate_runs_until_its_period_is_over() {
    let inner = "<NonblockingSequence><RateController hz=\"10\"><C1/></RateController><A2/>\
                 </NonblockingSequence>";
    let said = played_every(Some(30), inner, &["SR", "R", "R", "R", "SR"]);
    assert_eq!(said, ["C1:S A2:R R", "A2~R R", "A2~R R", "A2~R R", "C1:S A2~R R"]);
}

#[test]
fn a_try_that_has_caught_catches_anew() {
    let said = played("<TryCatch><A1/><A2/></TryCatch>", &["FS", "FF"]);
    assert_eq!(said, ["A1:F A2:S F", "A1:F A2:F F"]);
    // Nor does it leave the child that caught as it was.
    let text = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><TryCatch><A1/><A2/></TryCatch>\
                </BehaviorTree></root>";
    let tree = read_text(text).unwrap().tree;
    let mut machine = Machine::new(&tree);
    machine.tick();
    machine.reply(Reply::Leaf(Answer::Failure));
    machine.reply(Reply::Leaf(Answer::Success));
    assert_eq!([1, 2].map(|it| machine.status(it)), [Status::Idle; 2]);
}

#[test]
fn a_gate_that_stays_closed_runs() {
    let inner = "<NonblockingSequence><DistanceController><C1/></DistanceController><A2/>\
                 </NonblockingSequence>";
    let said = played(inner, &["SR", "NR", "TF"]);
    let wanted = ["C1:S A2:R R", "DistanceController?N A2~R R", "DistanceController?T C1:F A2! F"];
    assert_eq!(said, wanted);
    let longer = "<Sequence><PathLongerOnApproach><A1/></PathLongerOnApproach><A2/></Sequence>";
    assert_eq!(played(longer, &["R"]), ["A2:R R"]);
}

#[test]
fn a_switch_halts_the_case_that_is_so_no_more() {
    let inner = "<Sequence><Script code=\"x := 0\"/><ReactiveSequence><Script code=\"x += 1\"/>\
        <Switch2 variable=\"{x}\" case_1=\"1\" case_2=\"2\"><A1/><A2/><A3/></Switch2>\
        </ReactiveSequence></Sequence>";
    let said = played(inner, &["R", "R", "R", "R"]);
    assert_eq!(said, ["A1:R R x=1", "A1! A2:R R x=2", "A2! A3:R R x=3", "A3~R R x=4"]);
}

#[test]
fn a_switch_says_how_many_children_it_needs() {
    let text = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Switch2><A1/><A2/></Switch2>\
                </BehaviorTree></root>";
    let tree = read_text(text).unwrap().tree;
    let Stop::Thrown(thrown) = Machine::new(&tree).tick() else { panic!("it throws") };
    assert_eq!((thrown.node, thrown.why.as_str()), (Some(0), "Switch2 needs 3 children"));
}

#[test]
fn a_loop_without_rounds_ends_at_once() {
    let none = "<RetryUntilSuccessful num_attempts=\"0\"><A1/></RetryUntilSuccessful>";
    assert_eq!(played(none, &[""]), [" F"]);
    assert_eq!(played("<Repeat num_cycles=\"0\"><A1/></Repeat>", &[""]), [" S"]);
}

#[test]
fn an_exception_leaves_what_runs_above_it_running() {
    let status = |open: &str, more: &str| {
        let tag = open.split(' ').next().unwrap();
        let text = format!(
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><{open}><Script code=\"y = 1\"/>{more}\
             </{tag}></BehaviorTree></root>"
        );
        let tree = read_text(&text).unwrap_or_else(|it| panic!("{it}")).tree;
        let mut machine = Machine::new(&tree);
        let mut stop = machine.tick();
        if let Stop::Asked(_) = stop {
            stop = machine.reply(Reply::Yes);
        }
        assert!(matches!(stop, Stop::Thrown(_)), "{tag}: {stop:?}");
        machine.status(0)
    };
    let running = [
        "Sequence",
        "Fallback",
        "AsyncSequence",
        "SequenceWithMemory",
        "ReactiveSequence",
        "ReactiveFallback",
        "Parallel",
        "ParallelAll",
        "IfThenElse",
        "WhileDoElse",
        "TryCatch",
        "RecoveryNode",
        "RoundRobin",
        "PauseResumeController",
    ];
    for open in running {
        assert_eq!(status(open, "<A1/>"), Status::Running, "{open}");
    }
    for open in ["PipelineSequence", "NonblockingSequence"] {
        assert_eq!(status(open, "<A1/>"), Status::Idle, "{open}");
    }
    let running = [
        "Inverter",
        "ForceSuccess",
        "ForceFailure",
        "KeepRunningUntilFailure",
        "Repeat num_cycles=\"2\"",
        "RetryUntilSuccessful num_attempts=\"2\"",
        "Timeout msec=\"9\"",
        "RunOnce",
        "LoopInt queue=\"1\"",
        "LoopInt queue=\"{q}\"",
        "RateController",
        "SingleTrigger",
    ];
    for open in running {
        assert_eq!(status(open, ""), Status::Running, "{open}");
    }
    assert_eq!(status("Precondition if=\"true\"", ""), Status::Idle);
    assert_eq!(status("GoalUpdater", ""), Status::Idle);
}
