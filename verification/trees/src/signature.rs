//! The nodes that the library and Nav2 bring: their ports and numbers of children.

/// Number of children of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// One or more children.
    Control,
    /// Exactly one child.
    Decorator,
    /// No child.
    Leaf,
}

/// Type of a constant at a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PortType {
    Integer,
    Unsigned,
    Real,
    Truth,
    Text,
    Status,
    /// Choice of the caller.
    Any,
}

impl PortType {
    /// Returns the word for messages.
    pub(crate) fn word(self) -> &'static str {
        match self {
            PortType::Integer => "an integer",
            PortType::Unsigned => "an integer from 0",
            PortType::Real => "a number",
            PortType::Truth => "true or false",
            PortType::Text | PortType::Any => "a text",
            PortType::Status => "SUCCESS, FAILURE, RUNNING or SKIPPED",
        }
    }
}

/// A port: its name, type, and default.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PortSpec {
    pub(crate) name: &'static str,
    pub(crate) kind: PortType,
    pub(crate) default: Default,
}

/// Default of a port that is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Default {
    Is(&'static str),
    /// The node does without.
    Optional,
    /// The node throws at its first tick.
    Required,
}

/// A node that is built in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signature {
    pub(crate) tag: &'static str,
    pub(crate) family: Family,
    pub(crate) ports: &'static [PortSpec],
}

const fn given(name: &'static str, kind: PortType) -> PortSpec {
    PortSpec { name, kind, default: Default::Required }
}

const fn may(name: &'static str, kind: PortType) -> PortSpec {
    PortSpec { name, kind, default: Default::Optional }
}

const fn or(name: &'static str, kind: PortType, it: &'static str) -> PortSpec {
    PortSpec { name, kind, default: Default::Is(it) }
}

use Family::{Control, Decorator, Leaf};
use PortType::{Any, Integer, Real, Status, Text, Truth, Unsigned};

const fn node(tag: &'static str, family: Family, ports: &'static [PortSpec]) -> Signature {
    Signature { tag, family, ports }
}

const fn queue(value: PortType) -> [PortSpec; 3] {
    [given("queue", Any), or("if_empty", Status, "SUCCESS"), may("value", value)]
}

const CASES: [PortSpec; 7] = [
    may("variable", Text),
    may("case_1", Any),
    may("case_2", Any),
    may("case_3", Any),
    may("case_4", Any),
    may("case_5", Any),
    may("case_6", Any),
];

const fn cases(count: usize) -> &'static [PortSpec] {
    CASES.split_at(count + 1).0
}

/// All of them.
pub(crate) const ALL: &[Signature] = &[
    node("Sequence", Control, &[]),
    node("AsyncSequence", Control, &[]),
    node("SequenceWithMemory", Control, &[]),
    node("Fallback", Control, &[]),
    node("AsyncFallback", Control, &[]),
    node("ReactiveSequence", Control, &[]),
    node("ReactiveFallback", Control, &[]),
    node("Parallel", Control, {
        &[or("success_count", Integer, "-1"), or("failure_count", Integer, "1")]
    }),
    node("ParallelAll", Control, &[or("max_failures", Integer, "1")]),
    node("IfThenElse", Control, &[]),
    node("WhileDoElse", Control, &[]),
    node("TryCatch", Control, &[or("catch_on_halt", Truth, "false")]),
    node("Switch2", Control, cases(2)),
    node("Switch3", Control, cases(3)),
    node("Switch4", Control, cases(4)),
    node("Switch5", Control, cases(5)),
    node("Switch6", Control, cases(6)),
    node("PipelineSequence", Control, &[]),
    node("RecoveryNode", Control, &[or("number_of_retries", Integer, "1")]),
    node("RoundRobin", Control, &[or("wrap_around", Truth, "false")]),
    node("NonblockingSequence", Control, &[]),
    node("PersistentSequence", Control, &[given("current_child_idx", Integer)]),
    node("ManualSelector", Control, &[or("repeat_last_selection", Truth, "false")]),
    node("PauseResumeController", Control, {
        &[may("pause_service_name", Text), may("resume_service_name", Text)]
    }),
    node("Inverter", Decorator, &[]),
    node("ForceSuccess", Decorator, &[]),
    node("ForceFailure", Decorator, &[]),
    node("KeepRunningUntilFailure", Decorator, &[]),
    node("Repeat", Decorator, &[given("num_cycles", Integer)]),
    node("RetryUntilSuccessful", Decorator, &[given("num_attempts", Integer)]),
    node("Delay", Decorator, &[given("delay_msec", Unsigned)]),
    node("Timeout", Decorator, &[given("msec", Unsigned)]),
    node("RunOnce", Decorator, &[or("then_skip", Truth, "true")]),
    node("Precondition", Decorator, &[given("if", Any), or("else", Status, "FAILURE")]),
    node("SkipUnlessUpdated", Decorator, &[given("entry", Any)]),
    node("WaitValueUpdate", Decorator, &[given("entry", Any)]),
    node("LoopInt", Decorator, &queue(Integer)),
    node("LoopDouble", Decorator, &queue(Real)),
    node("LoopString", Decorator, &queue(Text)),
    node("LoopBool", Decorator, &queue(Truth)),
    node("RateController", Decorator, &[or("hz", Real, "10")]),
    node("DistanceController", Decorator, {
        &[may("distance", Real), may("global_frame", Any), may("robot_base_frame", Any)]
    }),
    node("SpeedController", Decorator, {
        &[
            may("min_rate", Real),
            may("max_rate", Real),
            may("min_speed", Real),
            may("max_speed", Real),
            may("filter_duration", Real),
            may("goal", Any),
            may("goals", Any),
        ]
    }),
    node("GoalUpdatedController", Decorator, &[may("goal", Any), may("goals", Any)]),
    node("GoalUpdater", Decorator, {
        &[
            may("input_goal", Any),
            may("input_goals", Any),
            may("output_goal", Any),
            may("output_goals", Any),
        ]
    }),
    node("PathLongerOnApproach", Decorator, {
        &[may("path", Any), may("prox_len", Real), may("length_factor", Real)]
    }),
    node("SingleTrigger", Decorator, &[]),
    node("AlwaysSuccess", Leaf, &[]),
    node("AlwaysFailure", Leaf, &[]),
    node("Script", Leaf, &[given("code", Any)]),
    node("ScriptCondition", Leaf, &[given("code", Any)]),
    node("SetBlackboard", Leaf, &[given("value", Any), given("output_key", Any)]),
    node("UnsetBlackboard", Leaf, &[given("key", Any)]),
    node("Sleep", Leaf, &[given("msec", Unsigned)]),
    node("WasEntryUpdated", Leaf, &[given("entry", Any)]),
];

/// Ports of built-in nodes that are written: node, port, whether they are read too.
pub(crate) const WRITTEN: [(&str, &str, bool); 3] = [
    ("GoalUpdater", "output_goal", false),
    ("GoalUpdater", "output_goals", false),
    ("PersistentSequence", "current_child_idx", true),
];

/// Names of format 3, with those of format 4.
pub(crate) const OLD_NAMES: [(&str, &str); 6] = [
    ("SequenceStar", "SequenceWithMemory"),
    ("FallbackStar", "Fallback"),
    ("SubTreePlus", "SubTree"),
    ("RetryUntilSuccesful", "RetryUntilSuccessful"),
    ("BlackboardCheckInt", "Precondition"),
    ("BlackboardCheckString", "Precondition"),
];

/// Ports of format 3, with those of format 4.
pub(crate) const OLD_PORTS: [(&str, &str); 2] =
    [("success_threshold", "success_count"), ("failure_threshold", "failure_count")];

/// Returns the node of this tag.
pub(crate) fn of(tag: &str) -> Option<&'static Signature> {
    ALL.iter().find(|it| it.tag == tag)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_has_a_port_for_each_case() {
        let switch = of("Switch3").unwrap();
        let names: Vec<_> = switch.ports.iter().map(|it| it.name).collect();
        assert_eq!(names, ["variable", "case_1", "case_2", "case_3"]);
        assert!(of("Switch7").is_none());
    }
}
