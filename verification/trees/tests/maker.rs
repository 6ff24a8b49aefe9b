//! Random trees.

use cotama_streams::{Stream, Streams};
use std::fmt::Write as _;

const CONTROLS: [&str; 14] = [
    "Sequence",
    "Fallback",
    "AsyncSequence",
    "AsyncFallback",
    "SequenceWithMemory",
    "ReactiveSequence",
    "ReactiveFallback",
    "Parallel",
    "ParallelAll",
    "PipelineSequence",
    "RoundRobin",
    "RecoveryNode",
    "IfThenElse",
    "WhileDoElse",
];
const DECORATORS: [(&str, &str); 16] = [
    ("Inverter", ""),
    ("ForceSuccess", ""),
    ("ForceFailure", ""),
    ("KeepRunningUntilFailure", ""),
    ("Repeat", " num_cycles=\"2\""),
    ("RetryUntilSuccessful", " num_attempts=\"3\""),
    ("RunOnce", ""),
    ("SingleTrigger", ""),
    ("RateController", ""),
    ("PathLongerOnApproach", ""),
    ("GoalUpdater", ""),
    ("Delay", " delay_msec=\"50\""),
    ("Timeout", " msec=\"70\""),
    ("Precondition", " if=\"x == 1\" else=\"SKIPPED\""),
    ("SkipUnlessUpdated", " entry=\"{x}\""),
    ("LoopInt", " queue=\"1;2\" value=\"{x}\""),
];
const GUARDS: [&str; 6] = [
    " _skipIf=\"x == 1\"",
    " _while=\"x != 2\"",
    " _failureIf=\"x == 3\"",
    " _onSuccess=\"x = 1\"",
    " _onHalted=\"x = 2\"",
    " _post=\"x += 1\"",
];

const STEERED: [(&str, &str, usize); 7] = [
    ("TryCatch", " catch_on_halt=\"true\"", 2),
    ("TryCatch", " catch_on_halt=\"true\"", 3),
    ("ManualSelector", "", 2),
    ("ManualSelector", " repeat_last_selection=\"true\"", 1),
    ("PauseResumeController", "", 3),
    ("LoopInt", " queue=\"{text}\" value=\"{x}\"", 1),
    ("LoopInt", " queue=\"{world}\" value=\"{item}\"", 1),
];

pub(crate) struct Maker {
    pub(crate) stream: Stream,
    leaves: usize,
    /// Nodes too that the second program does not know.
    steered: bool,
}

impl Maker {
    pub(crate) fn new(stream: &str) -> Maker {
        Maker { stream: Streams::new(46).stream(stream), leaves: 0, steered: false }
    }

    /// Makes trees with nodes that somebody steers, that take from a queue, or tick when halted.
    pub(crate) fn steered(stream: &str) -> Maker {
        Maker { steered: true, ..Maker::new(stream) }
    }

    pub(crate) fn below(&mut self, most: usize) -> usize {
        self.stream.below(most as u64) as usize
    }

    fn node(&mut self, level: usize, out: &mut String) {
        let guard = if self.below(6) == 0 { GUARDS[self.below(GUARDS.len())] } else { "" };
        if level == 0 || self.below(4) == 0 {
            self.leaves += 1;
            let number = self.leaves;
            let leaf = match self.below(12) {
                0..=4 => format!("A{number}"),
                5 => format!("B{number}"),
                6 | 7 => format!("C{number}"),
                8 => format!("S{number}"),
                9 => format!("L{number}"),
                10 => "Script code=\"x = x + 1\"".to_owned(),
                _ => "Sleep msec=\"30\"".to_owned(),
            };
            let _ = write!(out, "<{leaf}{guard}/>");
            return;
        }
        if self.steered && self.below(3) == 0 {
            let (tag, ports, count) = STEERED[self.below(STEERED.len())];
            let _ = write!(out, "<{tag}{ports}{guard}>");
            (0..count).for_each(|_| self.node(level - 1, out));
            let _ = write!(out, "</{tag}>");
            return;
        }
        if self.below(3) == 0 {
            let (tag, ports) = DECORATORS[self.below(DECORATORS.len())];
            let _ = write!(out, "<{tag}{ports}{guard}>");
            self.node(level - 1, out);
            let _ = write!(out, "</{tag}>");
            return;
        }
        let tag = CONTROLS[self.below(CONTROLS.len())];
        let count = match tag {
            "RecoveryNode" => 2,
            "IfThenElse" | "WhileDoElse" => 2 + self.below(2),
            _ => 1 + self.below(3),
        };
        let ports = match tag {
            "Parallel" => format!(" success_count=\"{}\"", 1 + self.below(count)),
            "RoundRobin" if self.below(2) == 0 => " wrap_around=\"true\"".to_owned(),
            _ => String::new(),
        };
        let _ = write!(out, "<{tag}{ports}{guard}>");
        for _ in 0..count {
            self.node(level - 1, out);
        }
        let _ = write!(out, "</{tag}>");
    }

    pub(crate) fn tree(&mut self) -> String {
        self.tree_of(3)
    }

    pub(crate) fn tree_of(&mut self, levels: usize) -> String {
        self.leaves = 0;
        let mut out = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence>".to_owned();
        out += "<Script code=\"x := 0\"/>";
        if self.steered {
            out += "<Script code=\"text := '1;2'\"/>";
        }
        self.node(levels, &mut out);
        out + "</Sequence></BehaviorTree></root>\n"
    }
}
