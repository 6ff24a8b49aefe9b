//! Types of nodes with their ports: what is missing, misnamed, or no number.

use super::text::{pointer, port, script_of};
use crate::diagnostic::{Findings, Place, Severity, nearest};
use crate::kinds::LeafKind;
use crate::machine::{MOST_CHOICES, item, items};
use crate::signature::{self, Default, OLD_PORTS, PortSpec, PortType, Signature};
use crate::tree::{Answer, EntryType, Gate, Kind, Number, Port, Queue, Tree};

/// A node as it stands in the file.
pub(super) struct Given<'e> {
    pub(super) tag: &'e str,
    pub(super) is_subtree: bool,
    pub(super) leaf: Option<LeafKind>,
    /// Name, text, place.
    pub(super) ports: Vec<(&'e str, &'e str, Place)>,
    pub(super) place: Place,
    pub(super) children: usize,
}

impl<'e> Given<'e> {
    fn get(&self, name: &str) -> Option<(&'e str, Place)> {
        self.ports.iter().find(|it| it.0 == name).map(|it| (it.1, it.2))
    }
}

/// Returns the type of a node, if its ports make one.
pub(super) fn kind_of(given: &Given, findings: &mut Findings) -> Option<Kind> {
    if given.is_subtree {
        return Some(Kind::SubTree { tree: given.tag.to_owned() });
    }
    if let Some(kind) = given.leaf {
        return Some(Kind::Leaf(kind));
    }
    let signature = signature::of(given.tag)?;
    let known = unknown_ports(given, signature, findings);
    let missing = missing_ports(given, signature, findings);
    if !known || missing {
        return None;
    }
    let mut it = Ports { given, signature, findings, is_sound: true };
    let kind = it.kind();
    let is_sound = it.is_sound;
    kind.filter(|_| is_sound)
}

fn unknown_ports(given: &Given, signature: &Signature, findings: &mut Findings) -> bool {
    let mut all = true;
    for (name, _, place) in &given.ports {
        if signature.ports.iter().any(|it| it.name == *name) {
            continue;
        }
        all = false;
        if let Some(it) = OLD_PORTS.iter().find(|it| it.0 == *name) {
            let message = format!("port {name} of {} is one of format 3", given.tag);
            findings.error(*place, message, &format!("write {} instead", it.1));
            continue;
        }
        let names = signature.ports.iter().map(|it| it.name);
        let help = match nearest(name, names.clone()) {
            Some(near) => format!("did you mean {near}?"),
            None if signature.ports.is_empty() => "it has no ports".to_owned(),
            None => format!("it has {}", names.collect::<Vec<_>>().join(", ")),
        };
        findings.error(*place, format!("{} has no port {name}", given.tag), &help);
    }
    all
}

fn missing_ports(given: &Given, signature: &Signature, findings: &mut Findings) -> bool {
    let required = signature.ports.iter().filter(|it| it.default == Default::Required);
    let mut missing = false;
    for spec in required.filter(|it| given.get(it.name).is_none()) {
        missing = true;
        let message = format!("{} needs the port {}", given.tag, spec.name);
        let help = format!("add {}=\"..\"; without it the first tick throws", spec.name);
        findings.error(given.place, message, &help);
    }
    missing
}

struct Ports<'g, 'e> {
    given: &'g Given<'e>,
    signature: &'static Signature,
    findings: &'g mut Findings,
    is_sound: bool,
}

impl<'e> Ports<'_, 'e> {
    fn spec(&self, name: &str) -> Option<&'static PortSpec> {
        self.signature.ports.iter().find(|it| it.name == name)
    }

    /// Returns the text of a port, or its default.
    fn text(&self, name: &str) -> Option<(&'e str, Place)> {
        self.given.get(name).or_else(|| match self.spec(name)?.default {
            Default::Is(text) => Some((text, self.given.place)),
            _ => None,
        })
    }

    fn refuse(&mut self, place: Place, message: String, help: &str) {
        self.is_sound = false;
        self.findings.error(place, message, help);
    }

    fn number(&mut self, name: &str) -> Number {
        let Some((text, place)) = self.text(name) else { return Number::Is(0) };
        if let Port::Entry(key) = port(name, text) {
            return Number::Entry(key);
        }
        let unsigned = self.spec(name).is_some_and(|it| it.kind == PortType::Unsigned);
        match text.trim().parse::<i64>() {
            Ok(it) if (!unsigned || it >= 0) && it.abs() < 1 << 31 => Number::Is(it),
            _ => {
                let kind = if unsigned { PortType::Unsigned } else { PortType::Integer };
                let message = format!(
                    "port {name} of {} is `{text}`, and takes {}",
                    self.given.tag,
                    kind.word()
                );
                self.refuse(place, message, "");
                Number::Is(0)
            }
        }
    }

    fn flag(&mut self, name: &str) -> bool {
        let Some((text, place)) = self.text(name) else { return false };
        match text.to_ascii_lowercase().as_str() {
            "true" | "1" => true,
            "false" | "0" => false,
            _ => {
                let message =
                    format!("port {name} of {} is `{text}`: true or false", self.given.tag);
                self.refuse(place, message, "");
                false
            }
        }
    }

    fn status(&mut self, name: &str) -> Answer {
        let Some((text, place)) = self.text(name) else { return Answer::Success };
        match text {
            "SUCCESS" => Answer::Success,
            "FAILURE" => Answer::Failure,
            "RUNNING" => Answer::Running,
            "SKIPPED" => Answer::Skipped,
            _ => {
                let words = PortType::Status.word();
                let message = format!("port {name} of {} is `{text}`: {words}", self.given.tag);
                self.refuse(place, message, "");
                Answer::Success
            }
        }
    }

    fn entry(&mut self, name: &str) -> String {
        let text = self.text(name).map_or("", |it| it.0);
        match port(name, text) {
            Port::Entry(key) | Port::Constant(key) => key,
        }
    }

    fn optional(&self, name: &str) -> Option<Port> {
        self.text(name).map(|it| port(name, it.0))
    }

    fn reals(&mut self) {
        for (name, text, place) in &self.given.ports {
            let real = self.spec(name).is_some_and(|it| it.kind == PortType::Real);
            if real && pointer(text).is_none() && text.trim().parse::<f64>().is_err() {
                let message =
                    format!("port {name} of {} is `{text}`, and takes a number", self.given.tag);
                self.refuse(*place, message, "");
            }
        }
    }

    fn script(&mut self, name: &str) -> Option<crate::script::Script> {
        let (text, place) = self.text(name)?;
        let script = script_of(name, text, place, self.findings);
        self.is_sound &= script.is_some();
        script
    }

    fn kind(&mut self) -> Option<Kind> {
        self.reals();
        Some(match self.given.tag {
            "Sequence" => Kind::Sequence { yields: false },
            "AsyncSequence" => Kind::Sequence { yields: true },
            "Fallback" => Kind::Fallback { yields: false },
            "AsyncFallback" => Kind::Fallback { yields: true },
            "SequenceWithMemory" => Kind::SequenceWithMemory,
            "ReactiveSequence" => Kind::ReactiveSequence,
            "ReactiveFallback" => Kind::ReactiveFallback,
            "Parallel" => Kind::Parallel {
                success: self.number("success_count"),
                failure: self.number("failure_count"),
            },
            "ParallelAll" => Kind::ParallelAll { failures: self.number("max_failures") },
            "IfThenElse" => Kind::IfThenElse,
            "WhileDoElse" => Kind::WhileDoElse,
            "TryCatch" => self.try_catch(),
            "ManualSelector" => self.menu(),
            "PauseResumeController" => Kind::PauseResumeController,
            "PipelineSequence" => Kind::PipelineSequence,
            "RecoveryNode" => self.recovery(),
            "RoundRobin" => Kind::RoundRobin { wraps: self.flag("wrap_around") },
            "NonblockingSequence" => Kind::NonblockingSequence,
            "PersistentSequence" => {
                Kind::PersistentSequence { index: self.entry("current_child_idx") }
            }
            "Inverter" => Kind::Inverter,
            "ForceSuccess" => Kind::ForceSuccess,
            "ForceFailure" => Kind::ForceFailure,
            "KeepRunningUntilFailure" => Kind::KeepRunningUntilFailure,
            "Repeat" => Kind::Repeat { cycles: self.number("num_cycles") },
            "RetryUntilSuccessful" => {
                Kind::RetryUntilSuccessful { attempts: self.number("num_attempts") }
            }
            "Delay" => Kind::Delay { msec: self.number("delay_msec") },
            "Timeout" => Kind::Timeout { msec: self.number("msec") },
            "RunOnce" => Kind::RunOnce { then_skip: self.flag("then_skip") },
            "Precondition" => {
                Kind::Precondition { otherwise: self.status("else"), condition: self.script("if")? }
            }
            "SkipUnlessUpdated" => Kind::SkipUnlessUpdated { entry: self.entry("entry") },
            "WaitValueUpdate" => Kind::WaitValueUpdate { entry: self.entry("entry") },
            "WasEntryUpdated" => Kind::WasEntryUpdated { entry: self.entry("entry") },
            "LoopInt" | "LoopDouble" | "LoopString" | "LoopBool" => self.queue()?,
            "RateController" => {
                let hertz = self.text("hz").and_then(|it| it.0.trim().parse().ok());
                Kind::Gate(Gate::Rate { hertz: hertz.unwrap_or(10.0) })
            }
            "DistanceController" => Kind::Gate(Gate::Distance),
            "SpeedController" => Kind::Gate(Gate::Speed),
            "GoalUpdatedController" => Kind::Gate(Gate::GoalUpdated),
            "GoalUpdater" => Kind::GoalUpdater,
            "PathLongerOnApproach" => Kind::PathLongerOnApproach,
            "SingleTrigger" => Kind::SingleTrigger,
            "AlwaysSuccess" => Kind::Always(Answer::Success),
            "AlwaysFailure" => Kind::Always(Answer::Failure),
            "Script" => match self.text("code") {
                Some(("", _)) => Kind::Script(None),
                _ => Kind::Script(Some(self.script("code")?)),
            },
            "ScriptCondition" => Kind::ScriptCondition(self.script("code")?),
            "SetBlackboard" => Kind::SetBlackboard {
                value: self.optional("value")?,
                output: self.optional("output_key")?,
            },
            "UnsetBlackboard" => Kind::UnsetBlackboard { key: self.optional("key")? },
            "Sleep" => Kind::Sleep { msec: self.number("msec") },
            switch => {
                let cases = switch.strip_prefix("Switch")?.parse().ok()?;
                Kind::Switch {
                    variable: self.optional("variable"),
                    cases: (1..=cases).map(|it| self.optional(&format!("case_{it}"))).collect(),
                }
            }
        })
    }

    fn try_catch(&mut self) -> Kind {
        if self.given.children == 1 {
            let message = "TryCatch has one child, and needs two or more".to_owned();
            self.refuse(self.given.place, message, "the last child is the one that catches");
        }
        Kind::TryCatch { on_halt: self.flag("catch_on_halt") }
    }

    fn recovery(&mut self) -> Kind {
        let retries = self.number("number_of_retries");
        if let Number::Is(below @ ..0) = retries {
            let place = self.given.get("number_of_retries").map_or(self.given.place, |it| it.1);
            let message = format!("number_of_retries {below} cannot be read: 1 stays");
            let help = "there are no endless retries: write a large number";
            self.findings.warning(place, message, help);
            return Kind::RecoveryNode { retries: Number::Is(1) };
        }
        Kind::RecoveryNode { retries }
    }

    fn menu(&mut self) -> Kind {
        if self.given.children > MOST_CHOICES {
            let message = format!("ManualSelector has {} children", self.given.children);
            let help = format!("a choice among at most {MOST_CHOICES} is modelled");
            self.refuse(self.given.place, message, &help);
        }
        Kind::ManualSelector { repeats: self.flag("repeat_last_selection") }
    }

    fn queue(&mut self) -> Option<Kind> {
        let (text, place) = self.text("queue")?;
        let kind = match self.given.tag {
            "LoopString" => EntryType::Text,
            "LoopInt" => EntryType::Integer,
            "LoopBool" => EntryType::Truth,
            _ => EntryType::Real,
        };
        let queue = match port("queue", text) {
            Port::Entry(key) => Queue::Entry(key, kind),
            Port::Constant(text) => {
                let mut queue = Vec::new();
                for text in items(&text) {
                    let Some(value) = item(text, kind) else {
                        let tag = self.given.tag;
                        let message = format!("`{text}` in the queue of {tag} is no value");
                        self.refuse(place, message, "");
                        return None;
                    };
                    queue.push(value);
                }
                Queue::Items(queue)
            }
        };
        let value = self.text("value").map(|it| it.0).filter(|it| !it.is_empty());
        let value = value.map(|_| self.entry("value"));
        Some(Kind::Loop { queue, value, if_empty: self.status("if_empty") })
    }
}

/// Checks numbers of children and thresholds, by which a node throws whenever it is ticked.
pub(super) fn counts(tree: &Tree, findings: &mut Findings) {
    for node in &tree.nodes {
        let found = node.children.len();
        let (tag, throws) = (&node.tag, "the library loads the file and throws at the first tick");
        let message = match &node.kind {
            Kind::IfThenElse | Kind::WhileDoElse if !(2..=3).contains(&found) => {
                format!("{tag} has {found} children, and needs 2 or 3")
            }
            Kind::RecoveryNode { .. } if found != 2 => {
                format!("{tag} has {found} children, and needs 2")
            }
            Kind::PauseResumeController if found > 4 => {
                format!("{tag} has {found} children, and takes at most 4")
            }
            Kind::Switch { cases, .. } if found != cases.len() + 1 => {
                format!("{tag} has {found} children, and needs {}", cases.len() + 1)
            }
            Kind::Parallel { success, failure } => {
                let ports = [("success_count", success), ("failure_count", failure)];
                let large = ports.iter().find_map(|(name, number)| match number {
                    Number::Is(it) if *it > found as i64 => Some((name, *it)),
                    _ => None,
                });
                let Some((name, it)) = large else { continue };
                format!("{name} {it} is larger than the number of children, {found}")
            }
            Kind::ParallelAll { failures: Number::Is(it) } if *it > found as i64 => {
                format!("max_failures {it} is larger than the number of children, {found}")
            }
            _ => continue,
        };
        findings.add(Severity::Throws, node.place, message, Some(throws.to_owned()));
    }
}
