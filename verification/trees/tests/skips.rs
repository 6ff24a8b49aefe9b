//! Memories when a leaf skips, or a run has ended before: traces show them not. Rows as the second
//! program has them.

use cotama_trees::machine::{Machine, Reply, Stop};
use cotama_trees::reader::read_text;

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
