//! Graphviz DOT.

use crate::figure::{Figure, Flow, Kind, Label, Node, Style};
use cotama_core::net::Net;
use cotama_core::text::marked;
use std::fmt::{self, Write as _};

/// Writes a net as a directed graph for Graphviz.
///
/// Nodes are called `p0`, `p1`, ... for places and `t0`, `t1`, ... for transitions, by position.
/// Read arcs are dashed and end in a dot; the documentation is the tooltip.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{drawing::figure::Style, formats::dot};
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1).within(0, Some(20)))
///     .unwrap();
/// let graph = dot::write(&net.view().net(), Style::Auto);
/// assert!(graph.contains(r#"p0 -> p1 [label="0..20 ms"];"#));
/// ```
pub fn write(net: &Net<'_>, style: Style) -> String {
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = graph(&mut out, net, &Figure::of(net, style));
    out
}

fn graph(out: &mut String, net: &Net<'_>, figure: &Figure<'_>) -> fmt::Result {
    writeln!(out, "digraph {} {{", quoted(figure.name))?;
    writeln!(
        out,
        "  graph [fontname=\"Helvetica\", forcelabels=true, tooltip={}];",
        quoted(figure.doc)
    )?;
    writeln!(out, "  node [fontname=\"Helvetica\", fontsize=11];")?;
    writeln!(out, "  edge [fontname=\"Helvetica\", fontsize=10, arrowsize=0.7];")?;
    let mut pseudo = 0..;
    for node in &figure.nodes {
        let id = id(node);
        match node.kind {
            Kind::State(place) => {
                let look = "shape=box, style=\"rounded,filled\", fillcolor=\"#eef3f9\"";
                writeln!(
                    out,
                    "  {id} [{look}, label={}, tooltip={}];",
                    quoted(node.name),
                    quoted(node.doc)
                )?;
                if net.places[place].initial > 0 {
                    writeln!(out, "  start [shape=point, width=0.12];\n  start -> {id};")?;
                }
                for (entry, at) in node.entries.iter().zip(&mut pseudo) {
                    writeln!(
                        out,
                        "  any{at} [shape=plaintext, fontcolor=\"#57606a\", label={}];",
                        quoted(&entry.sources)
                    )?;
                    writeln!(
                        out,
                        "  any{at} -> {id} [label={}];",
                        quoted(&entry.label.to_string())
                    )?;
                }
            }
            Kind::Place { place, shared } => {
                let look = if shared { ", style=dashed" } else { "" };
                let tokens = quoted(&tokens(net.places[place].initial));
                let (name, doc) = (quoted(node.name), quoted(node.doc));
                let size = "shape=circle, fixedsize=true, width=0.45";
                writeln!(
                    out,
                    "  {id} [{size}{look}, label={tokens}, xlabel={name}, tooltip={doc}];"
                )?;
            }
            Kind::Transition(_) => {
                let label =
                    node.label.as_ref().map(Label::to_string).filter(|label| !label.is_empty());
                let mut text =
                    label.map_or(node.name.to_owned(), |label| format!("{}\n{label}", node.name));
                for (name, label) in &node.also {
                    write!(text, "\n{name}\n{label}")?;
                }
                let look = "shape=box, height=0.25, style=filled, fillcolor=\"#e4e7eb\"";
                writeln!(
                    out,
                    "  {id} [{look}, label={}, tooltip={}];",
                    quoted(&text),
                    quoted(node.doc)
                )?;
            }
        }
    }
    for edge in &figure.edges {
        let mut text: Vec<String> = edge.labels.iter().map(Label::to_string).collect();
        text.extend((edge.weight > 1).then(|| edge.weight.to_string()));
        let label = Some(text.join("\n"))
            .filter(|text| !text.is_empty())
            .map(|text| format!("label={}", quoted(&text)));
        let look = match edge.flow {
            Flow::Move => None,
            Flow::Borrow => Some("dir=both".to_owned()),
            Flow::Read => Some("style=dashed, arrowhead=dot".to_owned()),
        };
        let attributes: Vec<String> = label.into_iter().chain(look).collect();
        let attributes = if attributes.is_empty() {
            String::new()
        } else {
            format!(" [{}]", attributes.join(", "))
        };
        let (from, to) = (id(&figure.nodes[edge.from]), id(&figure.nodes[edge.to]));
        writeln!(out, "  {from} -> {to}{attributes};")?;
    }
    writeln!(out, "}}")
}

/// The identifier of a node, in DOT and in Mermaid.
pub(super) fn id(node: &Node<'_>) -> String {
    match node.kind {
        Kind::State(place) | Kind::Place { place, .. } => format!("p{place}"),
        Kind::Transition(at) => format!("t{at}"),
    }
}

/// Tokens as dots, from five on as a number.
pub(super) fn tokens(tokens: u32) -> String {
    if tokens < 5 { "●".repeat(tokens as usize) } else { tokens.to_string() }
}

/// A quoted string. Graphviz also reads escapes such as `\N`, and HTML entities, inside of quotes.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for (c, hidden) in marked(text) {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '&' => out.push_str("&amp;"),
            '\n' => out.push_str("\\n"),
            c if hidden => {
                out.push('\\'); // of two, which are one
                out.extend(c.escape_unicode());
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::{quoted, tokens};

    #[test]
    fn quotes_escapes_and_entities_are_said_literally() {
        assert_eq!(
            quoted("a \"b\" \\N &lt;\n\0\u{202e}"),
            r#""a \"b\" \\N &amp;lt;\n\\u{0}\\u{202e}""#
        );
    }

    #[test]
    fn five_tokens_are_a_number() {
        assert_eq!([0, 1, 4, 5].map(tokens), ["", "●", "●●●●", "5"]);
    }
}
