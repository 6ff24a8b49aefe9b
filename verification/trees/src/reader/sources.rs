//! All files of a tree, put together: trees by name, models, the main tree.

use super::{Files, Options};
use crate::diagnostic::{Findings, Place, nearest};
use crate::kinds::{Leaf, LeafKind, nav2};
use crate::xml::{self, Element};
use std::collections::BTreeMap;

/// Files of one tree.
const MAX_FILES: usize = 10_000;

/// A port of a model.
#[derive(Clone, Debug, Default)]
pub(super) struct ModelPort {
    pub(super) reads: bool,
    pub(super) writes: bool,
    pub(super) default: Option<String>,
}

type Ports = BTreeMap<String, ModelPort>;

/// All files of a tree.
#[derive(Default)]
pub(super) struct Sources {
    /// Trees by name: the one element, or why there is none.
    pub(super) trees: BTreeMap<String, Element>,
    /// Trees of the folders that are searched.
    spare: BTreeMap<String, Element>,
    /// Names of the trees of the first file, in its order.
    first: Vec<String>,
    /// The tree that the first file names.
    named: Option<(String, Place)>,
    /// Kinds of leaves.
    pub(super) kinds: BTreeMap<String, LeafKind>,
    /// Ports of leaves.
    pub(super) ports: BTreeMap<String, Ports>,
    /// Ports of subtrees.
    pub(super) subtrees: BTreeMap<String, Ports>,
}

/// Which part of a file counts.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    First,
    Included,
    Models,
    Search,
}

/// Reads the first file and all that it includes.
pub(super) fn read(
    name: &str,
    files: &mut dyn Files,
    options: &Options,
    findings: &mut Findings,
) -> Option<Sources> {
    let mut sources = Sources::default();
    for it in options.leaves.iter().chain(&nav2()) {
        sources.describe(it);
    }
    let mut waiting = vec![(name.to_owned(), Place::default(), Role::First)];
    let later = |path: &String, role| (path.clone(), Place::default(), role);
    waiting.splice(0..0, options.search.iter().rev().map(|it| later(it, Role::Search)));
    waiting.splice(0..0, options.models.iter().rev().map(|it| later(it, Role::Models)));
    let mut seen: Vec<String> = Vec::new();
    while let Some((path, from, role)) = waiting.pop() {
        let path = normal(&path);
        if seen.contains(&path) {
            continue;
        }
        if seen.len() == MAX_FILES {
            findings.error(from, format!("more than {MAX_FILES} files"), "");
            return None;
        }
        seen.push(path.clone());
        let file = findings.files.len() as u32;
        findings.files.push(path.clone());
        let nowhere = Place { file, ..Place::default() };
        let bytes = match files.read(&path) {
            Ok(bytes) => bytes,
            Err(why) if role == Role::Included => {
                let help = "the path of an include is relative to the file that includes";
                findings.error(from, format!("cannot read {path}: {why}"), help);
                continue;
            }
            Err(why) => {
                findings.error(nowhere, format!("cannot be read: {why}"), "");
                continue;
            }
        };
        let root = match xml::read(file, &bytes) {
            Ok(root) => root,
            // A file of a searched folder that is no tree concerns nobody.
            Err(_) if role == Role::Search => continue,
            Err((place, message, help)) => {
                findings.error(place, message, help.as_deref().unwrap_or(""));
                continue;
            }
        };
        if root.name != "root" {
            if role != Role::Search {
                let message = format!("the first element is <{}>, not <root>", root.name);
                findings.error(root.place, message, "a file of trees has one element <root>");
            }
            continue;
        }
        let included = sources.take(&path, &root, role, findings);
        waiting.extend(included.into_iter().rev());
    }
    (!findings.has_errors()).then_some(sources)
}

/// Returns the path without `.` and `..`, so that one file has one name.
fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|it| !it.is_empty() && *it != "..") => {
                parts.pop();
            }
            "" if !parts.is_empty() => {}
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

fn beside(path: &str, other: &str) -> String {
    match path.rsplit_once('/') {
        Some((folder, _)) if !other.starts_with('/') => format!("{folder}/{other}"),
        _ => other.to_owned(),
    }
}

impl Sources {
    fn describe(&mut self, leaf: &Leaf) {
        self.kinds.entry(leaf.tag.clone()).or_insert(leaf.kind);
        let ports = self.ports.entry(leaf.tag.clone()).or_default();
        for port in &leaf.writes {
            let it = ModelPort { reads: false, writes: true, default: None };
            ports.entry(port.clone()).or_insert(it);
        }
    }

    /// Takes what a file defines, and returns what it includes.
    fn take(
        &mut self,
        path: &str,
        root: &Element,
        role: Role,
        findings: &mut Findings,
    ) -> Vec<(String, Place, Role)> {
        let mut included = Vec::new();
        if role == Role::First {
            format(root, findings);
            let main = root.attribute("main_tree_to_execute");
            self.named = main.map(|it| (it.value.clone(), it.value_at));
        }
        let trees = root.children.iter().filter(|it| it.name == "BehaviorTree").count();
        let mut number = 0;
        for element in &root.children {
            match element.name.as_str() {
                "include" if role != Role::Models => {
                    let role = if role == Role::Search { role } else { Role::Included };
                    included.extend(include(path, element, role, findings));
                }
                "TreeNodesModel" => self.models(element, findings),
                "BehaviorTree" if role == Role::Models => {}
                "BehaviorTree" => {
                    let id = element.attribute("ID");
                    if id.is_none() && trees > 1 && role != Role::Search {
                        let message = "<BehaviorTree> without ID in a file of several";
                        findings.error(element.place, message, "give each tree an ID");
                    }
                    let name =
                        id.map_or_else(|| format!("BehaviorTree_{number}"), |it| it.value.clone());
                    number += 1;
                    self.tree(name, element, role, findings);
                }
                "include" => {}
                other => {
                    let message = format!("<{other}> is ignored here");
                    findings.warning(element.place, message, "trees stand in <BehaviorTree>");
                }
            }
        }
        included
    }

    fn tree(&mut self, name: String, element: &Element, role: Role, findings: &mut Findings) {
        if role == Role::Search {
            if element.children.len() == 1 {
                self.spare.entry(name).or_insert_with(|| element.children[0].clone());
            }
            return;
        }
        let signs = |it: char| it.is_whitespace() || "<>&\"'/\\:*?|.".contains(it);
        if name.contains(signs) || name == "Root" {
            let message = format!("tree `{name}`: the library refuses this name since 4.8.4");
            let help = "a name has no blanks and none of <>&\"'/\\:*?|. and is not Root";
            findings.warning(element.place, message, help);
        }
        if element.children.len() != 1 {
            let found = element.children.len();
            let message = format!("tree {name} has {found} children, not one");
            let help = if found == 0 {
                "put a node into it"
            } else {
                "put them below one control node, such as <Sequence>"
            };
            return findings.error(element.place, message, help);
        }
        if role == Role::First {
            self.first.push(name.clone());
        }
        let again = self.trees.insert(name.clone(), element.children[0].clone());
        if let Some(before) = again {
            let line = before.place.line;
            let message = format!("tree {name} is defined again; this one counts");
            let help = format!("the other one, near line {line}, is never used: remove one");
            findings.warning(element.place, message, &help);
        }
    }

    fn models(&mut self, block: &Element, findings: &mut Findings) {
        for model in &block.children {
            let Some(id) = model.get("ID") else {
                let message = format!("<{}> without ID", model.name);
                findings.error(model.place, message, "a model names its node by ID");
                continue;
            };
            let ports = model.children.iter().filter_map(|it| {
                let (reads, writes) = match it.name.as_str() {
                    "input_port" => (true, false),
                    "output_port" => (false, true),
                    "inout_port" | "bidirectional_port" => (true, true),
                    _ => return None,
                };
                let default = it.get("default").map(str::to_owned);
                Some((it.get("name")?.to_owned(), ModelPort { reads, writes, default }))
            });
            if model.name == "SubTree" {
                self.subtrees.insert(id.to_owned(), ports.collect());
                continue;
            }
            self.ports.insert(id.to_owned(), ports.collect());
            let kind = match model.name.as_str() {
                "Action" => LeafKind::Stateful,
                "Condition" => LeafKind::Condition,
                _ => continue,
            };
            self.kinds.entry(id.to_owned()).or_insert(kind);
        }
    }

    /// Returns the tree of this name.
    pub(super) fn tree_of(&self, name: &str) -> Option<&Element> {
        self.trees.get(name).or_else(|| self.spare.get(name))
    }

    /// Returns the name of the tree to execute.
    pub(super) fn main(&self, options: &Options, findings: &mut Findings) -> Option<String> {
        let names = || self.first.iter().map(String::as_str);
        let (name, place) = match (&options.main, &self.named) {
            (Some(name), _) => (name.clone(), Place::default()),
            (None, Some((name, place))) => (name.clone(), *place),
            (None, None) => {
                let mut distinct: Vec<_> = names().collect();
                distinct.dedup();
                match distinct[..] {
                    [one] => return Some(one.to_owned()),
                    [] => {
                        let place = Place { line: 1, column: 1, ..Place::default() };
                        findings.error(place, "no tree in the file", "add a <BehaviorTree>");
                    }
                    _ => {
                        let place = Place { line: 1, column: 1, ..Place::default() };
                        let list = distinct.join(", ");
                        let message = format!("several trees, and none is to be executed: {list}");
                        let help = "write main_tree_to_execute, or give --tree";
                        findings.error(place, message, help);
                    }
                }
                return None;
            }
        };
        if self.tree_of(&name).is_some() {
            return Some(name);
        }
        let help = match nearest(&name, self.trees.keys().map(String::as_str)) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("there are {}", names().collect::<Vec<_>>().join(", ")),
        };
        findings.error(place, format!("no tree {name}"), &help);
        None
    }
}

fn format(root: &Element, findings: &mut Findings) {
    match root.get("BTCPP_format") {
        None => {
            let message = "BTCPP_format is missing; the file is read as format 4";
            findings.warning(root.place, message, "write <root BTCPP_format=\"4\">");
        }
        Some("4") => {}
        Some(other) => {
            let message =
                format!("format {other} is read with the rules of 4, as the library does");
            let help = "names of nodes and ports have changed; write BTCPP_format=\"4\"";
            findings.warning(root.place, message, help);
        }
    }
}

fn include(
    path: &str,
    element: &Element,
    role: Role,
    findings: &mut Findings,
) -> Option<(String, Place, Role)> {
    let Some(to) = element.attribute("path") else {
        findings.error(element.place, "<include> without path", "");
        return None;
    };
    if let Some(package) = element.get("ros_pkg") {
        let message = format!("an include of the ROS package {package} needs ROS");
        let help = "give the folder of its trees with --search; the include is skipped";
        findings.warning(element.place, message, help);
        return None;
    }
    Some((beside(path, &to.value), to.value_at, role))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_one_name() {
        assert_eq!(normal("a/./b/../c.xml"), "a/c.xml");
        assert_eq!(normal("../a.xml"), "../a.xml");
        assert_eq!(normal("/a//b"), "/a/b");
        assert_eq!(beside("x/y.xml", "z.xml"), "x/z.xml");
    }
}
