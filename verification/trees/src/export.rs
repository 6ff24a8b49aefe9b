//! A tree as a file: compact XML, JSON, DOT, Mermaid.

use crate::tree::{Kind, Node, Tree};
use std::fmt::Write as _;

/// Escapes a text for a value in double quotes.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for it in text.chars() {
        match it {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            it => out.push(it),
        }
    }
    out
}

/// Returns the scripts of a node with their attributes.
pub fn scripts(node: &Node) -> Vec<(&'static str, &str)> {
    let (before, after) = (&node.guards, &node.afterwards);
    let all = [
        ("_failureIf", &before.failure_if),
        ("_successIf", &before.success_if),
        ("_skipIf", &before.skip_if),
        ("_while", &before.while_),
        ("_onHalted", &after.on_halted),
        ("_onFailure", &after.on_failure),
        ("_onSuccess", &after.on_success),
        ("_post", &after.post),
    ];
    all.into_iter().filter_map(|(name, it)| Some((name, it.as_ref()?.text.as_str()))).collect()
}

/// Writes the tree as compact XML of format 4, each subtree once.
pub fn btcpp(tree: &Tree) -> String {
    let mut out =
        format!("<root BTCPP_format=\"4\" main_tree_to_execute=\"{}\">\n", escaped(&tree.name));
    let mut done: Vec<&str> = Vec::new();
    let mut waiting: Vec<(&str, usize)> = vec![(&tree.name, 0)];
    while let Some((name, root)) = waiting.pop() {
        if done.contains(&name) {
            continue;
        }
        done.push(name);
        let _ = writeln!(out, "  <BehaviorTree ID=\"{}\">", escaped(name));
        let mut subtrees = Vec::new();
        element(tree, root, 2, &mut out, &mut subtrees);
        out.push_str("  </BehaviorTree>\n");
        waiting.extend(subtrees.into_iter().rev());
    }
    out.push_str("</root>\n");
    out
}

fn element<'t>(
    tree: &'t Tree,
    at: usize,
    level: usize,
    out: &mut String,
    subtrees: &mut Vec<(&'t str, usize)>,
) {
    let node = &tree.nodes[at];
    let indent = "  ".repeat(level);
    let mut attributes = Vec::new();
    let is_subtree = matches!(node.kind, Kind::SubTree { .. });
    // A name that is no name of an element needs the explicit form.
    let plain = |it: &str| it.chars().all(|it| it.is_alphanumeric() || "_-.".contains(it));
    let tag = match &node.kind {
        Kind::SubTree { .. } => "SubTree",
        Kind::Leaf(_) if !plain(&node.tag) => "Action",
        _ => &node.tag,
    };
    if tag != node.tag {
        attributes.push(("ID", node.tag.clone()));
    }
    if node.name != node.tag {
        attributes.push(("name", node.name.clone()));
    }
    for (port, text) in &node.ports {
        attributes.push((port, text.clone()));
    }
    if let (Kind::SubTree { tree: name }, Some(&root)) = (&node.kind, node.children.first()) {
        subtrees.push((name, root));
        let board = &tree.boards[tree.nodes[root].board];
        if board.autoremap {
            attributes.push(("_autoremap", "true".to_owned()));
        }
        // Defaults of the subtree's model, which this file does without.
        let has = |port: &str| node.ports.iter().any(|it| it.0 == port);
        for (port, key) in board.remaps.iter().filter(|it| !has(it.0)) {
            attributes.push((port, format!("{{{key}}}")));
        }
        let values = board.initial.iter().filter_map(|it| Some((it.0, it.1.as_ref()?)));
        for (port, value) in values.filter(|it| !has(it.0)) {
            attributes.push((port, value.shown()));
        }
    }
    attributes.extend(scripts(node).into_iter().map(|(name, text)| (name, text.to_owned())));
    let _ = write!(out, "{indent}<{tag}");
    for (name, text) in &attributes {
        let _ = write!(out, " {name}=\"{}\"", escaped(text));
    }
    if node.children.is_empty() || is_subtree {
        out.push_str("/>\n");
        return;
    }
    out.push_str(">\n");
    for &child in &node.children {
        element(tree, child, level + 1, out, subtrees);
    }
    let _ = writeln!(out, "{indent}</{tag}>");
}

/// Returns the sign by which a type of node is drawn.
pub fn sign(kind: &Kind) -> &'static str {
    match kind {
        Kind::Sequence { .. } | Kind::SequenceWithMemory | Kind::PersistentSequence { .. } => "→",
        Kind::PipelineSequence | Kind::NonblockingSequence => "⇉",
        Kind::ReactiveSequence => "⟳→",
        Kind::Fallback { .. } => "?",
        Kind::ReactiveFallback => "⟳?",
        Kind::Parallel { .. } | Kind::ParallelAll { .. } => "∥",
        Kind::IfThenElse
        | Kind::WhileDoElse
        | Kind::Switch { .. }
        | Kind::ManualSelector { .. }
        | Kind::PauseResumeController => "⋔",
        Kind::TryCatch { .. } | Kind::RecoveryNode { .. } | Kind::RoundRobin { .. } => "↻",
        Kind::SubTree { .. } => "▣",
        Kind::Leaf(kind) if kind.runs() => "■",
        Kind::Leaf(_) => "●",
        Kind::Always(_)
        | Kind::Script(_)
        | Kind::ScriptCondition(_)
        | Kind::SetBlackboard { .. }
        | Kind::UnsetBlackboard { .. }
        | Kind::Sleep { .. }
        | Kind::WasEntryUpdated { .. } => "□",
        _ => "◇",
    }
}

/// Returns the words of a node in a drawing: its name, and its type where that says more.
pub(crate) fn words(node: &Node) -> String {
    if node.name == node.tag { node.name.clone() } else { format!("{}: {}", node.tag, node.name) }
}

/// Writes the tree in the language of Graphviz.
pub fn dot(tree: &Tree) -> String {
    let quoted = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
    let mut out = format!("digraph \"{}\" {{\n  ordering=out;\n", quoted(&tree.name));
    out.push_str("  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n");
    for (at, node) in tree.nodes.iter().enumerate() {
        let label = format!("{} {}", sign(&node.kind), words(node));
        let _ = writeln!(out, "  n{} [label=\"{}\"];", at + 1, quoted(&label));
    }
    for (at, node) in tree.nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            let _ = writeln!(out, "  n{} -> n{};", parent + 1, at + 1);
        }
    }
    out.push_str("}\n");
    out
}

/// Writes the tree as a flowchart of Mermaid.
pub fn mermaid(tree: &Tree) -> String {
    let mut out = "flowchart TD\n".to_owned();
    for (at, node) in tree.nodes.iter().enumerate() {
        let label = escaped(&format!("{} {}", sign(&node.kind), words(node)));
        let _ = writeln!(out, "  n{}[\"{label}\"]", at + 1);
    }
    for (at, node) in tree.nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            let _ = writeln!(out, "  n{} --> n{}", parent + 1, at + 1);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reader::read_text;

    #[test]
    fn the_xml_of_a_tree_is_read_as_the_same_tree() {
        let text = r#"<root BTCPP_format="4" main_tree_to_execute="Main">
          <BehaviorTree ID="Main"><Sequence name="all">
            <Script code="x := 1; y := 'a &amp; b'"/>
            <SubTree ID="Sub" a="{x}" b="2" _autoremap="true"/>
            <Fallback><A1 _skipIf="x &lt; 1" goal="{g}"/><Action ID="Fly to"/></Fallback>
            <SubTree ID="Sub" a="{y}" b="three" name="again"/>
          </Sequence></BehaviorTree>
          <BehaviorTree ID="Sub"><Inverter><C1/></Inverter></BehaviorTree></root>"#;
        let before = read_text(text).unwrap().tree;
        let after = read_text(&btcpp(&before)).unwrap_or_else(|it| panic!("{it}")).tree;
        let bare = |tree: &Tree| {
            let mut tree = tree.clone();
            tree.nodes.iter_mut().for_each(|it| it.place = Default::default());
            tree
        };
        assert_eq!(bare(&before), bare(&after));
        assert_eq!(btcpp(&before), btcpp(&after));
    }

    #[test]
    fn drawings_have_all_nodes_and_edges() {
        let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
          <Sequence name="say &quot;a&quot;"><A1/><C1/></Sequence></BehaviorTree></root>"#;
        let tree = read_text(text).unwrap().tree;
        assert_eq!(dot(&tree).matches("->").count(), 2);
        assert!(dot(&tree).contains("say \\\"a\\\""));
        assert_eq!(mermaid(&tree).matches("-->").count(), 2);
    }
}
