//! The questions that are asked of every tree, and what was found.

use crate::explore::{Assumptions, End, Facts, Limits, Pair, Run, Space};
use crate::kinds::LeafKind;
use crate::machine::catches;
use crate::supervisor::Part;
use crate::tree::{Answer, Kind, Number, Tree};

/// Weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Worth knowing.
    Note,
    /// Most probably not what was meant.
    Warning,
    /// Wrong whatever was meant.
    Error,
}

impl Level {
    /// Returns the word.
    pub fn word(self) -> &'static str {
        match self {
            Level::Note => "note",
            Level::Warning => "warning",
            Level::Error => "error",
        }
    }
}

/// Something found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Name of the question.
    pub question: &'static str,
    /// Weight.
    pub level: Level,
    /// Nodes that it is about.
    pub nodes: Vec<usize>,
    /// In a sentence.
    pub message: String,
    /// Remedy.
    pub help: &'static str,
    /// A run with the fewest ticks that shows it.
    pub run: Option<Run>,
}

/// A question, and whether it is answered well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// Name of the question.
    pub question: &'static str,
    /// Wish, in words.
    pub wish: &'static str,
    /// Whether it is so; `None` where a limit was met.
    pub holds: Option<bool>,
}

/// Questions in their order: name, wish.
pub const QUESTIONS: [(&str, &str); 14] = [
    ("can-succeed", "some run ends with SUCCESS"),
    ("exception", "no exception is thrown"),
    ("halt-exception", "halting the tree throws nothing"),
    ("stuck", "an end can always be reached"),
    ("never-ends", "a run ends when its actions do"),
    ("restarted-forever", "no action is started again and again without an end"),
    ("spins", "tickOnce returns"),
    ("success-lost", "no SUCCESS is turned into FAILURE"),
    ("recovery", "each recovery can be reached and can help"),
    ("never-ticked", "each node can be ticked"),
    ("never-succeeds", "each condition can answer SUCCESS"),
    ("exclusive", "the named actions do not run together"),
    ("running-together", "no two actions run together"),
    ("read-before-written", "no entry is read before it is written"),
];

/// The question that is asked where a supervisor stands beside the tree: name, wish.
pub const OF_SUPERVISORS: (&str, &str) =
    ("refused", "the supervisor accepts what leaves start and halt");

/// Further questions and options.
#[derive(Clone, Debug, Default)]
pub struct Wishes {
    /// Actions of which no two may run or be started together.
    pub exclusive: Vec<usize>,
    /// Entries that are written before the first tick.
    pub given: Vec<String>,
    /// Whether leaves may answer SKIPPED.
    pub skips: bool,
    /// Assumptions on answers.
    pub assumptions: Assumptions,
}

/// All answers about a tree.
#[derive(Clone, Debug)]
pub struct Report {
    /// Each question with its answer.
    pub asked: Vec<Asked>,
    /// Findings, the worst first.
    pub findings: Vec<Finding>,
    /// Facts, for programs.
    pub facts: Facts,
    /// Assumptions that forbade nothing.
    pub unused: Vec<String>,
    /// Whether everything was explored.
    pub complete: bool,
}

/// Asks all questions of a tree.
pub fn check(tree: &Tree, wishes: &Wishes, limits: Limits) -> Report {
    let mut space = Space::explore(tree, wishes.skips, wishes.assumptions.clone(), limits);
    let facts = space.facts(&wishes.given);
    let complete = space.is_complete();
    let mut found = Found { tree, space: &mut space, facts: &facts, list: Vec::new() };
    found.ends(complete);
    found.endless();
    found.lost();
    found.reached(complete);
    found.together(&wishes.exclusive);
    found.refused();
    let mut findings = found.list;
    findings.extend(halting(&mut space));
    findings.sort_by_key(|it| std::cmp::Reverse(it.level));
    // A limit leaves open what was not found; what needs all runs was not looked for.
    let of_supervisors = tree.bonds.as_ref().map(|_| &OF_SUPERVISORS);
    let asked = QUESTIONS.iter().chain(of_supervisors).map(|&(question, wish)| {
        let found = findings.iter().any(|it| it.question == question);
        let holds = if found { Some(false) } else { complete.then_some(true) };
        Asked { question, wish, holds }
    });
    let unused = space.assumptions().list.iter().filter(|it| complete && !it.used);
    let unused = unused.map(|it| it.text.clone()).collect();
    Report { asked: asked.collect(), findings, facts: facts.clone(), unused, complete }
}

/// Returns how long each `Timeout` lets its child run, where ticks come every so many ms: ticks
/// after that of its start, and ms. What an entry says has no bound.
pub fn timeouts(tree: &Tree, period: u32) -> Vec<(usize, Option<(i64, i64)>)> {
    let nodes = tree.nodes.iter().enumerate();
    let all = nodes.filter_map(|(node, it)| match it.kind {
        Kind::Timeout { msec: Number::Is(msec) } if msec > 0 => {
            let ticks = (msec as u64).div_ceil(period.max(1) as u64) as i64;
            Some((node, Some((ticks, ticks * period as i64))))
        }
        Kind::Timeout { .. } => Some((node, None)),
        _ => None,
    });
    all.collect()
}

struct Found<'a, 't> {
    tree: &'t Tree,
    space: &'a mut Space<'t>,
    facts: &'a Facts,
    list: Vec<Finding>,
}

impl Found<'_, '_> {
    fn add(
        &mut self,
        question: &'static str,
        level: Level,
        nodes: &[usize],
        message: String,
        help: &'static str,
        run: Option<Run>,
    ) {
        let nodes = nodes.to_vec();
        self.list.push(Finding { question, level, nodes, message, help, run });
    }

    fn ends(&mut self, complete: bool) {
        let ends = &self.facts.ends;
        if complete && !ends.contains_key(&End::Answered(Answer::Success)) {
            let level = if ends.is_empty() { Level::Note } else { Level::Warning };
            let all: Vec<_> = ends.keys().map(|it| it.shown(self.tree)).collect();
            let message = match all.len() {
                0 => "no run ends".to_owned(),
                _ => format!("no run ends with SUCCESS, only with {}", all.join(", ")),
            };
            let help = "nothing is wrong if the tree is to run until it fails or is cancelled";
            self.add("can-succeed", level, &[0], message, help, None);
        }
        let thrown = ends.keys().filter_map(|it| match it {
            End::Thrown(node) => Some(*node),
            End::Answered(_) | End::Halted => None,
        });
        for node in thrown.collect::<Vec<_>>() {
            let end = End::Thrown(node);
            let run = self.space.run_to_end(end);
            let why = self.space.cause(end).unwrap_or_default();
            let of = node.map(|it| format!(" in {}", self.tree.shown(it))).unwrap_or_default();
            let message = format!("an exception is thrown{of}: {why}");
            let help = "the run ends there; Nav2 reports that navigation failed";
            let nodes: Vec<_> = node.into_iter().collect();
            self.add("exception", Level::Error, &nodes, message, help, run);
        }
    }

    fn endless(&mut self) {
        let (facts, tree) = (self.facts, self.tree);
        // Where nothing ends on purpose, this says nothing new.
        if facts.stuck > 0 && !facts.ends.is_empty() {
            let run = self.space.run_of_stuck(facts);
            let message = format!("from {} of {} states no end can be reached", facts.stuck, {
                facts.states
            });
            let help = "look at what waits there: its condition can never change";
            self.add("stuck", Level::Error, &[], message, help, run);
        }
        if facts.forever {
            let run = self.space.run_forever(facts);
            let message = "a run never ends although every action ends or is halted".to_owned();
            let help = "nothing is wrong if conditions or gates end it in life; else bound retries";
            self.add("never-ends", Level::Note, &[], message, help, run);
        }
        for (at, &node) in facts.restarted.iter().enumerate() {
            let run = self.space.run_restarted(facts, at);
            let label = tree.shown(node);
            let message = format!("{label} can be started again and again and never ends");
            let help = "a Reactive node halts it each time an earlier child runs: put the earlier \
                        child into a condition, or use a Sequence";
            self.add("restarted-forever", Level::Warning, &[node], message, help, run);
        }
        if facts.spins {
            let run = self.space.run_spinning(facts);
            let message = "tickOnce may not return: each tick wakes the next".to_owned();
            let help = "a loop without bound over children that end at once; no cancel is heard \
                        while it spins: bound it, or put a Delay into it";
            self.add("spins", Level::Warning, &[], message, help, run);
        }
    }

    fn lost(&mut self) {
        for pair in &self.facts.success_lost {
            let (child, node) = pair.nodes;
            let run = Some(self.space.run_of(pair));
            let (of, by) = (self.tree.shown(child), self.tree.shown(node));
            let (level, help) = match self.tree.nodes[node].kind {
                Kind::RoundRobin { .. } => (
                    Level::Warning,
                    "RoundRobin answers FAILURE after its last child, whatever that said: write \
                     wrap_around=\"true\"",
                ),
                _ => (Level::Note, "the node has failed for another reason at that moment"),
            };
            let message = format!("SUCCESS of {of} is lost: {by} answers FAILURE");
            self.add("success-lost", level, &[child, node], message, help, run);
        }
    }

    fn reached(&mut self, complete: bool) {
        if !complete {
            return;
        }
        let (facts, tree) = (self.facts, self.tree);
        // A subtree below a node that is never ticked says nothing new.
        // Nor does a node in whose tick an exception is thrown.
        let thrown = facts.ends.keys().filter_map(|it| match it {
            End::Thrown(node) => Some(node.unwrap_or(0)),
            End::Answered(_) | End::Halted => None,
        });
        let mut entered = Vec::new();
        for node in thrown {
            let mut at = Some(node);
            while let Some(it) = at {
                entered.push(it);
                at = tree.nodes[it].parent;
            }
        }
        let never = |node: usize| facts.never_ticked.contains(&node) && !entered.contains(&node);
        for &node in facts.never_ticked.iter().filter(|it| never(**it)) {
            if tree.nodes[node].parent.is_some_and(never) {
                continue;
            }
            let message = format!("{} is never ticked", tree.shown(node));
            let help = "what stands before it never lets it begin";
            self.add("never-ticked", Level::Warning, &[node], message, help, None);
        }
        for &node in &facts.never_success {
            let Kind::Leaf(kind) = tree.nodes[node].kind else { continue };
            let message = format!("{} never answers SUCCESS", tree.shown(node));
            let help = match kind {
                LeafKind::Latch => {
                    "it answers FAILURE whenever it begins, and a Reactive parent resets it while \
                     a sibling runs: put it below a Sequence or PipelineSequence, or use \
                     GlobalUpdatedGoal"
                }
                _ if tree.bond(node).is_some() => {
                    "no run of the supervisor leads there: look at what the leaf `succeeds` by, \
                     or `reads`"
                }
                _ => "an assumption or a guard forbids it",
            };
            self.add("never-succeeds", Level::Warning, &[node], message, help, None);
        }
        for (node, it) in tree.nodes.iter().enumerate() {
            let (Kind::RecoveryNode { .. }, [_, recovery]) = (&it.kind, it.children.as_slice())
            else {
                continue;
            };
            let message = if never(*recovery) {
                format!("the recovery of {} is never reached", tree.shown(node))
            } else if facts.never_success.contains(recovery) {
                format!("the recovery of {} never succeeds", tree.shown(node))
            } else {
                continue;
            };
            let help = "without a recovery that succeeds the node only delays its failure";
            self.add("recovery", Level::Warning, &[node, *recovery], message, help, None);
        }
    }

    /// Tells which leaves offer an event in vain.
    fn refused(&mut self) {
        let Some(bonds) = self.tree.bonds.as_deref() else { return };
        for it in &self.facts.refused {
            let (node, part) = (it.vain.node, it.vain.part);
            let label = self.tree.shown(node);
            let event = bonds.offered(node, part).unwrap_or_default();
            let places = bonds.net.marked(it.vain.state);
            let at = match places.len() {
                0 => "where no place is marked".to_owned(),
                1..=6 => format!("at {}", places.join(", ")),
                more => format!("at {} and {} more", places[..5].join(", "), more - 5),
            };
            let (verb, help) = match part {
                Part::Starts => (
                    "started by",
                    "the leaf answers FAILURE there: wait until the supervisor is ready, halt what \
                     still runs by its event, or write `tries` if this is meant",
                ),
                Part::Halts => (
                    "halted by",
                    "the supervisor goes on although the tree has halted the leaf: give it an \
                     event that stops it there",
                ),
            };
            let message = format!("{label} is {verb} {event}, which the supervisor ignores {at}");
            let run = Some(self.space.run_of_in_vain(it));
            self.add("refused", Level::Warning, &[node], message, help, run);
        }
    }

    fn together(&mut self, exclusive: &[usize]) {
        let tree = self.tree;
        let asks =
            |pair: &Pair| [pair.nodes.0, pair.nodes.1].iter().all(|it| exclusive.contains(it));
        for (pairs, verb) in [
            (&self.facts.both_running, "runs beside"),
            (&self.facts.started_while_running, "is started before the halt of"),
        ] {
            for pair in pairs {
                let run = Some(self.space.run_of(pair));
                let (a, b) = (tree.shown(pair.nodes.0), tree.shown(pair.nodes.1));
                let message = format!("{a} {verb} {b}");
                let nodes = [pair.nodes.0, pair.nodes.1];
                if asks(pair) {
                    let help = "--exclusive forbids it";
                    self.add("exclusive", Level::Error, &nodes, message, help, run);
                } else {
                    let help = "with --exclusive A,B this is an error";
                    self.add("running-together", Level::Note, &nodes, message, help, run);
                }
            }
        }
        for early in &self.facts.read_before_written {
            let run = Some(self.space.run_of_early(early));
            let message = format!(
                "{} reads entry {} before a leaf has written it",
                tree.shown(early.node),
                early.entry
            );
            let help = "give --given ENTRY if the program writes it, or assume when the leaf fails";
            self.add("read-before-written", Level::Note, &[early.node], message, help, run);
        }
    }
}

/// Returns where a script on halting throws: `haltTree` and the destructor run them all.
fn halting(space: &mut Space) -> Option<Finding> {
    let (run, why) = space.halting()?;
    Some(Finding {
        question: "halt-exception",
        level: Level::Error,
        nodes: Vec::new(),
        message: format!("halting the tree throws: {why}"),
        help: if catches(space.tree) {
            "haltTree and the destructor run every _onHalted, and what a TryCatch with \
             catch_on_halt=\"true\" ticks then; thrown in the destructor it aborts the process: \
             create the entry first, with :="
        } else {
            "haltTree and the destructor run every _onHalted, of nodes that never ran too; \
               thrown in the destructor it aborts the process: create the entry first, with :="
        },
        run: Some(run),
    })
}
