//! Trees and subtrees become one list of nodes, in the order in which the library makes them.

use super::Options;
use super::kind::{Given, kind_of};
use super::sources::Sources;
use super::text::{constant, entry_type, named, pointer, script};
use crate::diagnostic::{Findings, Place, nearest};
use crate::kinds::{LeafKind, generic};
use crate::script::Value;
use crate::signature::{self, Family, OLD_NAMES};
use crate::tree::{Afterwards, Board, EntryType, Guards, Kind, Node, Tree};
use crate::xml::Element;
use std::collections::BTreeMap;

/// Nodes of a tree with its subtrees.
pub(super) const MAX_NODES: usize = 20_000;
/// Levels of a tree with its subtrees.
const MAX_LEVELS: usize = 512;

const EXPLICIT: [&str; 4] = ["Action", "Condition", "Control", "Decorator"];
const SCRIPTS: [&str; 8] = [
    "_failureIf",
    "_successIf",
    "_skipIf",
    "_while",
    "_onHalted",
    "_onFailure",
    "_onSuccess",
    "_post",
];
/// Attributes of editors, which mean nothing.
const SILENT: [&str; 7] =
    ["_description", "_uid", "_fullpath", "_collapsed", "_favorite", "_hardcoded", "_autoremap"];

/// Makes the tree of this name.
pub(super) fn expand(
    sources: &Sources,
    options: &Options,
    main: &str,
    findings: &mut Findings,
) -> Option<Tree> {
    let tree = Tree {
        name: main.to_owned(),
        nodes: Vec::new(),
        boards: vec![Board::default()],
        types: BTreeMap::new(),
        files: Vec::new(),
        bonds: None,
    };
    let mut at = Expander { sources, options, findings, tree, open: Vec::new(), full: false };
    let root = sources.tree_of(main)?;
    at.open.push(main.to_owned());
    at.create(root, None, 0, 1);
    let Expander { mut tree, findings, .. } = at;
    label(&mut tree);
    super::kind::counts(&tree, findings);
    Some(tree)
}

fn label(tree: &mut Tree) {
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    for node in &tree.nodes {
        *uses.entry(&node.name).or_default() += 1;
    }
    let labels: Vec<_> = tree
        .nodes
        .iter()
        .enumerate()
        .map(|(at, node)| match uses[node.name.as_str()] {
            1 => node.name.clone(),
            _ => format!("{}@{}", node.name, at + 1),
        })
        .collect();
    for (node, label) in tree.nodes.iter_mut().zip(labels) {
        node.label = label;
    }
}

struct Expander<'a> {
    sources: &'a Sources,
    options: &'a Options,
    findings: &'a mut Findings,
    tree: Tree,
    /// Trees that are being expanded.
    open: Vec<String>,
    full: bool,
}

fn given<'e>(element: &'e Element, tag: &'e str, leaf: Option<LeafKind>) -> Given<'e> {
    let all = element.attributes.iter().filter(|it| is_port(&it.name));
    let ports = all.map(|it| (it.name.as_str(), it.value.as_str(), it.value_at)).collect();
    let is_subtree = element.name == "SubTree";
    Given { tag, is_subtree, leaf, ports, place: element.place, children: element.children.len() }
}

fn is_port(name: &str) -> bool {
    name.starts_with(char::is_alphabetic) && name != "name" && name != "ID"
}

impl Expander<'_> {
    fn create(&mut self, element: &Element, parent: Option<usize>, board: usize, level: usize) {
        if self.full {
            return;
        }
        if self.tree.nodes.len() == MAX_NODES || level > MAX_LEVELS {
            self.full = true;
            let message = if level > MAX_LEVELS {
                format!("more than {MAX_LEVELS} levels, with those of subtrees")
            } else {
                format!("more than {MAX_NODES} nodes, with those of subtrees")
            };
            return self.findings.error(element.place, message, "make the tree smaller");
        }
        let Some((tag, family, leaf)) = self.tag(element) else { return };
        let index = self.tree.nodes.len();
        let given = given(element, &tag, leaf);
        let kind = kind_of(&given, self.findings);
        let (guards, afterwards) = self.scripts(element);
        self.unknown_attributes(element);
        self.explicit_in_reactive(element, parent);
        let position = parent.map_or(0, |it| self.tree.nodes[it].children.len());
        let name = element.get("name").unwrap_or(&tag).to_owned();
        if let Some(parent) = parent {
            self.tree.nodes[parent].children.push(index);
        }
        let ports: Vec<_> =
            given.ports.iter().map(|it| (it.0.to_owned(), it.1.to_owned())).collect();
        self.tree.nodes.push(Node {
            kind: kind.unwrap_or(Kind::GoalUpdater),
            tag: tag.clone(),
            family,
            label: name.clone(),
            name,
            parent,
            position,
            children: Vec::new(),
            board,
            guards,
            afterwards,
            reads: Vec::new(),
            writes: Vec::new(),
            ports,
            place: element.place,
        });
        if element.name == "SubTree" {
            return self.subtree(element, &tag, index, board, level);
        }
        self.entries(index, element.place);
        let found = element.children.len();
        let wrong = match family {
            Family::Control => found == 0,
            Family::Decorator => found != 1,
            Family::Leaf => found > 0,
        };
        if wrong {
            let (message, help) = match family {
                Family::Control => (format!("{tag} has no children"), "put a node into it"),
                Family::Decorator => (
                    format!("{tag} is a decorator and has {found} children, not one"),
                    "put them below one control node, such as <Sequence>",
                ),
                Family::Leaf => (
                    format!("{tag} is a leaf and has {found} children"),
                    "a leaf has none; move them beside it",
                ),
            };
            self.findings.error(element.place, message, help);
        }
        self.same_subtree_names(element);
        for child in &element.children {
            self.create(child, Some(index), board, level + 1);
        }
    }

    /// Returns the name of the node's type, its family, and its kind if it is a leaf of the user.
    fn tag(&mut self, element: &Element) -> Option<(String, Family, Option<LeafKind>)> {
        let name = element.name.as_str();
        let is_explicit = EXPLICIT.contains(&name);
        let tag = match element.get("ID") {
            Some(id) if is_explicit || name == "SubTree" => id,
            None if is_explicit || name == "SubTree" => {
                self.findings.error(element.place, format!("<{name}> without ID"), "add ID=\"..\"");
                return None;
            }
            Some(_) => {
                let message = format!("<{name}> has an ID");
                let help = format!("write name=\"..\", or <Action ID=\"{name}\">");
                self.findings.error(element.place, message, &help);
                return None;
            }
            None => name,
        };
        if name == "SubTree" {
            return Some((tag.to_owned(), Family::Decorator, None));
        }
        if self.sources.trees.contains_key(tag) {
            let message = format!("<{tag}> is a tree, not a node");
            let help = format!("write <SubTree ID=\"{tag}\"/>");
            self.findings.error(element.place, message, &help);
            return None;
        }
        if let Some(it) = signature::of(tag) {
            return Some((tag.to_owned(), it.family, None));
        }
        let by_form = match name {
            "Condition" => Some(LeafKind::Condition),
            "Action" => Some(LeafKind::Stateful),
            _ => None,
        };
        let fallback = self.options.unknown.filter(|_| element.children.is_empty());
        let kinds = &self.sources.kinds;
        let known = kinds.get(tag).copied().or_else(|| generic(tag)).or(by_form);
        // A name of an older format, or one that differs by case alone, is no leaf of the user.
        let is_meant = OLD_NAMES.iter().all(|it| it.0 != tag)
            && signature::ALL.iter().all(|it| !it.tag.eq_ignore_ascii_case(tag));
        if let Some(kind) = known.or(fallback.filter(|_| is_meant)) {
            return Some((tag.to_owned(), Family::Leaf, Some(kind)));
        }
        self.unknown(element.place, tag);
        None
    }

    fn unknown(&mut self, place: Place, tag: &str) {
        if let Some(it) = OLD_NAMES.iter().find(|it| it.0 == tag) {
            let message = format!("{tag} is a name of format 3");
            return self.findings.error(place, message, &format!("write {} instead", it.1));
        }
        let built_in = signature::ALL.iter().map(|it| it.tag);
        let names = built_in.chain(self.sources.kinds.keys().map(String::as_str));
        let describe = "describe it in a file given with --leaves, or give --unknown stateful";
        let help = match nearest(tag, names) {
            Some(near) => format!("did you mean {near}? Or {describe}"),
            None => describe.to_owned(),
        };
        let message = format!("unknown node {tag}: neither built in nor described");
        self.findings.error(place, message, &help);
    }

    fn scripts(&mut self, element: &Element) -> (Guards, Afterwards) {
        let mut read = |name: &str| {
            let attribute = element.attribute(name)?;
            script(attribute, self.findings)
        };
        let guards = Guards {
            failure_if: read("_failureIf"),
            success_if: read("_successIf"),
            skip_if: read("_skipIf"),
            while_: read("_while"),
        };
        let afterwards = Afterwards {
            on_halted: read("_onHalted"),
            on_failure: read("_onFailure"),
            on_success: read("_onSuccess"),
            post: read("_post"),
        };
        (guards, afterwards)
    }

    fn unknown_attributes(&mut self, element: &Element) {
        let private = element.attributes.iter().filter(|it| it.name.starts_with('_'));
        for it in private {
            let name = it.name.as_str();
            if SCRIPTS.contains(&name) || SILENT.contains(&name) {
                continue;
            }
            let message = format!("{name} means nothing to the library: it is ignored");
            let near = nearest(name, SCRIPTS);
            let help = near.map(|it| format!("did you mean {it}?")).unwrap_or_default();
            self.findings.warning(it.at, message, &help);
        }
    }

    fn explicit_in_reactive(&mut self, element: &Element, parent: Option<usize>) {
        let below = parent.map(|it| &self.tree.nodes[it].kind);
        if below == Some(&Kind::ReactiveSequence) && EXPLICIT.contains(&element.name.as_str()) {
            let id = element.get("ID").unwrap_or("");
            let message = format!(
                "<{}> as a child of ReactiveSequence: version 4.10 refuses the file",
                element.name
            );
            self.findings.warning(element.place, message, &format!("write <{id}/>"));
        }
    }

    fn same_subtree_names(&mut self, element: &Element) {
        let mut seen: Vec<&str> = Vec::new();
        for child in element.children.iter().filter(|it| it.name == "SubTree") {
            let Some(name) = child.get("name") else { continue };
            if seen.contains(&name) {
                let message = format!("two subtrees below one parent have the name {name}");
                self.findings.error(child.place, message, "give each a name of its own");
            }
            seen.push(name);
        }
    }

    fn subtree(&mut self, element: &Element, id: &str, index: usize, board: usize, level: usize) {
        if !element.children.is_empty() {
            let message = "<SubTree> has children";
            return self.findings.error(element.place, message, "its content is the tree it names");
        }
        let Some(root) = self.sources.tree_of(id) else {
            let names = self.sources.trees.keys().map(String::as_str);
            let help = match nearest(id, names) {
                Some(near) => format!("did you mean {near}?"),
                None => "include the file that defines it, or give --search its folder".to_owned(),
            };
            let message = format!("no tree {id} for this subtree");
            return self.findings.error(element.place, message, &help);
        };
        if let Some(at) = self.open.iter().position(|it| it == id) {
            let mut circle = self.open[at..].to_vec();
            circle.push(id.to_owned());
            let message = format!("a tree contains itself: {}", circle.join(" > "));
            let help = "repeat with <Repeat> or <RetryUntilSuccessful> instead";
            return self.findings.error(element.place, message, help);
        }
        let Some(new) = self.board(element, id, board) else { return };
        self.open.push(id.to_owned());
        self.create(root, Some(index), new, level + 1);
        self.open.pop();
    }

    /// Makes the blackboard of a subtree.
    fn board(&mut self, element: &Element, id: &str, parent: usize) -> Option<usize> {
        let autoremap = match element.get("_autoremap") {
            None | Some("false" | "False" | "FALSE" | "0") => false,
            Some("true" | "True" | "TRUE" | "1") => true,
            Some(other) => {
                let message = format!("_autoremap is `{other}`");
                self.findings.error(element.place, message, "write true or false");
                false
            }
        };
        let mut board = Board { parent: Some(parent), autoremap, ..Board::default() };
        let number = self.tree.boards.len();
        let given = element.attributes.iter().filter(|it| is_port(&it.name));
        let mut ports: Vec<_> = given.map(|it| (it.name.as_str(), it.value.as_str())).collect();
        for (port, model) in self.sources.subtrees.get(id).into_iter().flatten() {
            if autoremap || ports.iter().any(|it| it.0 == port) {
                continue;
            }
            let Some(default) = &model.default else {
                let message = format!("subtree {id} needs the port {port}");
                let help = format!("add {port}=\"..\", or a default to its model");
                self.findings.error(element.place, message, &help);
                return None;
            };
            ports.push((port, default));
        }
        for (port, text) in ports {
            let key = if text == "{=}" { Some(port) } else { pointer(text) };
            if let Some(key) = key {
                board.remaps.insert(port.to_owned(), key.to_owned());
                continue;
            }
            let value = constant(text);
            let kind = match value {
                Value::Integer(_) => Some(EntryType::Integer),
                Value::Real(_) => Some(EntryType::Real),
                Value::Text(_) => None,
            };
            if let Some(kind) = kind {
                self.tree.types.insert((number, port.to_owned()), kind);
            }
            board.initial.insert(port.to_owned(), Some(value));
        }
        self.tree.boards.push(board);
        Some(number)
    }

    /// Makes the entries that ports name, and checks their types.
    fn entries(&mut self, index: usize, place: Place) {
        let node = &self.tree.nodes[index];
        let (board, tag, ports) = (node.board, node.tag.clone(), node.ports.clone());
        let parsed = ["Script", "ScriptCondition", "Precondition"].contains(&tag.as_str());
        for (port, text) in &ports {
            let key =
                if text == "{=}" || text == "=" { Some(port.as_str()) } else { pointer(text) };
            let Some(key) = key.filter(|_| !parsed) else { continue };
            let home = self.tree.home(board, key);
            let exists = self.tree.boards[home.0].initial.contains_key(&home.1);
            let asked = signature::of(&tag)
                .and_then(|it| it.ports.iter().find(|it| it.name == port))
                .and_then(|it| entry_type(it.kind));
            if tag == "SetBlackboard" {
            } else if exists {
                let kept = self.tree.types.get(&home).copied();
                if let (Some(kept), Some(asked)) = (kept, asked)
                    && kept != asked
                    && kept != EntryType::Text
                {
                    let message = format!(
                        "entry {key} is {}, and port {port} of {tag} takes {}",
                        named(kept),
                        named(asked)
                    );
                    let help = "the library refuses the file: use another entry";
                    self.findings.error(place, message, help);
                }
            } else {
                self.tree.boards[home.0].initial.insert(home.1.clone(), None);
                if let Some(asked) = asked {
                    self.tree.types.insert(home.clone(), asked);
                }
            }
            let (reads, writes) = self.direction(&tag, port);
            let node = &mut self.tree.nodes[index];
            if reads && !node.reads.contains(&home) {
                node.reads.push(home.clone());
            }
            if writes && !node.writes.contains(&home) {
                node.writes.push(home);
            }
        }
    }

    fn direction(&self, tag: &str, port: &str) -> (bool, bool) {
        let described = self.sources.ports.get(tag).and_then(|it| it.get(port));
        if let Some(it) = described {
            return (it.reads, it.writes);
        }
        let written = signature::WRITTEN.iter().find(|it| it.0 == tag && it.1 == port);
        written.map_or((true, false), |it| (it.2, true))
    }
}
