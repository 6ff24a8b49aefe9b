//! A tree as data: nodes in the order in which the library makes them.

use crate::diagnostic::Place;
use crate::kinds::LeafKind;
use crate::script::{Script, Value};
use crate::signature::Family;
use crate::supervisor::{Bond, Bonds};
use std::collections::BTreeMap;

/// An answer of a node to a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Answer {
    /// SUCCESS.
    Success,
    /// FAILURE.
    Failure,
    /// RUNNING.
    Running,
    /// SKIPPED.
    Skipped,
}

impl Answer {
    /// Returns the letter of traces.
    pub fn letter(self) -> char {
        match self {
            Answer::Success => 'S',
            Answer::Failure => 'F',
            Answer::Running => 'R',
            Answer::Skipped => 'K',
        }
    }

    /// Returns the library's word.
    pub fn word(self) -> &'static str {
        match self {
            Answer::Success => "SUCCESS",
            Answer::Failure => "FAILURE",
            Answer::Running => "RUNNING",
            Answer::Skipped => "SKIPPED",
        }
    }

    /// Returns whether the node has ended: SUCCESS or FAILURE.
    pub fn is_done(self) -> bool {
        matches!(self, Answer::Success | Answer::Failure)
    }
}

/// Value of a port.
#[derive(Clone, Debug, PartialEq)]
pub enum Port {
    /// A constant.
    Constant(String),
    /// An entry of the blackboard.
    Entry(String),
}

/// An integer at a port.
#[derive(Clone, Debug, PartialEq)]
pub enum Number {
    /// A constant.
    Is(i64),
    /// An entry of the blackboard, read at each tick.
    Entry(String),
}

/// Event that a decorator waits for that looks at the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gate {
    /// A period: so many per second.
    Rate {
        /// Ticks of the child in a second.
        hertz: f64,
    },
    /// A distance driven.
    Distance,
    /// A period that depends on the speed.
    Speed,
    /// A new goal.
    GoalUpdated,
}

/// Items that a loop takes one after the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Queue {
    /// Constants, which each run has anew.
    Items(Vec<Value>),
    /// An entry, with the type of its items. A text there is taken up once, and used up for good;
    /// of what the world puts there it is asked whether an item is left.
    Entry(String, EntryType),
}

/// Type of a node, with its ports.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Kind {
    Sequence { yields: bool },
    Fallback { yields: bool },
    SequenceWithMemory,
    ReactiveSequence,
    ReactiveFallback,
    Parallel { success: Number, failure: Number },
    ParallelAll { failures: Number },
    IfThenElse,
    WhileDoElse,
    Switch { variable: Option<Port>, cases: Vec<Option<Port>> },
    TryCatch { on_halt: bool },
    PipelineSequence,
    RecoveryNode { retries: Number },
    RoundRobin { wraps: bool },
    NonblockingSequence,
    PersistentSequence { index: String },
    ManualSelector { repeats: bool },
    PauseResumeController,
    Inverter,
    ForceSuccess,
    ForceFailure,
    KeepRunningUntilFailure,
    Repeat { cycles: Number },
    RetryUntilSuccessful { attempts: Number },
    Delay { msec: Number },
    Timeout { msec: Number },
    RunOnce { then_skip: bool },
    SubTree { tree: String },
    Precondition { condition: Script, otherwise: Answer },
    SkipUnlessUpdated { entry: String },
    WaitValueUpdate { entry: String },
    Loop { queue: Queue, value: Option<String>, if_empty: Answer },
    Gate(Gate),
    GoalUpdater,
    PathLongerOnApproach,
    SingleTrigger,
    Leaf(LeafKind),
    Always(Answer),
    Script(Option<Script>),
    ScriptCondition(Script),
    SetBlackboard { value: Port, output: Port },
    UnsetBlackboard { key: Port },
    Sleep { msec: Number },
    WasEntryUpdated { entry: String },
}

/// Scripts of a node that are looked at before its tick.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Guards {
    pub failure_if: Option<Script>,
    pub success_if: Option<Script>,
    pub skip_if: Option<Script>,
    pub while_: Option<Script>,
}

/// Scripts of a node that are run afterwards.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Afterwards {
    pub on_halted: Option<Script>,
    pub on_failure: Option<Script>,
    pub on_success: Option<Script>,
    pub post: Option<Script>,
}

/// A node of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Type and ports.
    pub kind: Kind,
    /// Tag, or ID of the explicit form.
    pub tag: String,
    /// Whether it may have children.
    pub family: Family,
    /// Attribute `name`, else the tag.
    pub name: String,
    /// The name, with `@uid` if another node has it too.
    pub label: String,
    /// Number of the parent; `None` at the root.
    pub parent: Option<usize>,
    /// Place among the parent's children, from 0.
    pub position: usize,
    /// Numbers of the children.
    pub children: Vec<usize>,
    /// Number of its blackboard.
    pub board: usize,
    /// Scripts before its tick.
    pub guards: Guards,
    /// Scripts afterwards.
    pub afterwards: Afterwards,
    /// Entries that its ports read: board, key.
    pub reads: Vec<(usize, String)>,
    /// Entries that its ports write.
    pub writes: Vec<(usize, String)>,
    /// Ports as they are written, in the order of the file.
    pub ports: Vec<(String, String)>,
    /// Place in its file.
    pub place: Place,
}

impl Node {
    /// Returns whether the library or Nav2 defines the node's own behaviour.
    pub fn is_built_in(&self) -> bool {
        !matches!(self.kind, Kind::Leaf(_))
    }

    /// Returns whether the node is a leaf that may answer RUNNING.
    pub fn is_action(&self) -> bool {
        matches!(self.kind, Kind::Leaf(kind) if kind.runs())
    }
}

/// The blackboard of a tree or of one of its subtrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Board {
    /// Number of the parent's; `None` at the root.
    pub parent: Option<usize>,
    /// Own names of entries that live in the parent.
    pub remaps: BTreeMap<String, String>,
    /// Whether all that is not private is looked up in the parent.
    pub autoremap: bool,
    /// Entries that exist from the beginning, with their values.
    pub initial: BTreeMap<String, Option<Value>>,
}

/// A tree with its subtrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Name of the main tree.
    pub name: String,
    /// Nodes in preorder; a subtree's follow its node.
    pub nodes: Vec<Node>,
    /// Blackboards; the root's is the first.
    pub boards: Vec<Board>,
    /// Entries whose first typed port is a number or a text: what a text written there becomes.
    pub types: BTreeMap<(usize, String), EntryType>,
    /// Names of the files.
    pub files: Vec<String>,
    /// The supervisor beside it, and which leaves act on it.
    pub bonds: Option<Box<Bonds>>,
}

/// Type of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryType {
    /// An integer.
    Integer,
    /// A real number.
    Real,
    /// A text.
    Text,
    /// A truth value.
    Truth,
}

/// Name of the supervisor beside a tree, in questions and properties.
pub const NET: &str = "net";

impl Tree {
    /// Returns what binds a leaf to the supervisor.
    pub fn bond(&self, node: usize) -> Option<&Bond> {
        self.bonds.as_deref()?.of.get(node)?.as_ref()
    }

    /// Returns the name that tells a node from all others.
    pub fn shown(&self, node: usize) -> String {
        let Some(it) = self.nodes.get(node) else { return NET.to_owned() };
        let is_named = matches!(it.kind, Kind::Leaf(_) | Kind::SubTree { .. });
        if !is_named && it.label == it.tag {
            format!("{}@{}", it.label, node + 1)
        } else {
            it.label.clone()
        }
    }

    /// Returns the node of a label, as `shown` or traces have it.
    pub fn find(&self, label: &str) -> Option<usize> {
        let exact = self.nodes.iter().position(|it| it.label == label);
        exact.or_else(|| (0..self.nodes.len()).find(|&it| self.shown(it) == label))
    }

    /// Returns the first place of an entry before anything has run: board, key.
    pub fn home(&self, board: usize, key: &str) -> (usize, String) {
        let (mut board, mut key) = match key.strip_prefix('@') {
            Some(rest) => (0, rest),
            None => (board, key),
        };
        loop {
            let it = &self.boards[board];
            let Some(parent) = it.parent.filter(|_| !it.initial.contains_key(key)) else {
                return (board, key.to_owned());
            };
            if let Some(renamed) = it.remaps.get(key) {
                (board, key) = (parent, renamed);
            } else if it.autoremap && !key.starts_with('_') {
                board = parent;
            } else {
                return (board, key.to_owned());
            }
            if let Some(rest) = key.strip_prefix('@') {
                (board, key) = (0, rest);
            }
        }
    }
}
