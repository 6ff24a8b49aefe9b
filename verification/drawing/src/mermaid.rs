//! Mermaid diagrams.

use super::dot::{id, tokens};
use crate::figure::{Figure, Flow, Kind, Label, Style};
use cotama_core::net::Net;
use cotama_core::text::marked;
use std::fmt::{self, Write as _};

/// Writes a net as a `stateDiagram-v2` when it is drawn as states, otherwise as a `flowchart`.
///
/// Nodes are called `p0`, `p1`, ... for places and `t0`, `t1`, ... for transitions, by position.
/// What Mermaid could take for syntax is written as its character codes, such as `#58;` for a
/// colon.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{drawing::figure::Style, formats::mermaid};
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1).within(0, Some(20)))
///     .unwrap();
/// let diagram = mermaid::write(&net.view().net(), Style::Auto);
/// assert!(diagram.contains("p0 --> p1 : 0..20 ms"));
/// ```
pub fn write(net: &Net<'_>, style: Style) -> String {
    let figure = Figure::of(net, style);
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = if figure.is_states {
        states(&mut out, net, &figure)
    } else {
        flowchart(&mut out, net, &figure)
    };
    out
}

fn states(out: &mut String, net: &Net<'_>, figure: &Figure<'_>) -> fmt::Result {
    writeln!(out, "stateDiagram-v2")?;
    let mut pseudo = 0..;
    for node in &figure.nodes {
        writeln!(out, "  state \"{}\" as {}", visible(node.name), id(node))?;
        for (entry, at) in node.entries.iter().zip(&mut pseudo) {
            writeln!(out, "  state \"{}\" as any{at}", visible(&entry.sources))?;
            writeln!(
                out,
                "  any{at} --> {}{}",
                id(node),
                description(std::slice::from_ref(&entry.label))
            )?;
        }
        if matches!(node.kind, Kind::State(place) if net.places[place].initial > 0) {
            writeln!(out, "  [*] --> {}", id(node))?;
        }
    }
    for edge in &figure.edges {
        let (from, to) = (id(&figure.nodes[edge.from]), id(&figure.nodes[edge.to]));
        writeln!(out, "  {from} --> {to}{}", description(&edge.labels))?;
    }
    Ok(())
}

fn flowchart(out: &mut String, net: &Net<'_>, figure: &Figure<'_>) -> fmt::Result {
    writeln!(out, "flowchart TB")?;
    let mut shared_ids = Vec::new();
    for node in &figure.nodes {
        let id = id(node);
        let mut lines = vec![visible(node.name)];
        match node.kind {
            Kind::State(place) | Kind::Place { place, .. } => {
                lines.push(tokens(net.places[place].initial));
                lines.retain(|line| !line.is_empty());
                writeln!(out, "  {id}((\"{}\"))", lines.join("<br/>"))?;
                shared_ids
                    .extend(matches!(node.kind, Kind::Place { shared: true, .. }).then_some(id));
            }
            Kind::Transition(_) => {
                lines.extend(node.label.iter().map(|label| escape(&label.to_string())));
                for (name, label) in &node.also {
                    lines.extend([visible(name), escape(&label.to_string())]);
                }
                lines.retain(|line| !line.is_empty());
                writeln!(out, "  {id}[\"{}\"]", lines.join("<br/>"))?;
            }
        }
    }
    for edge in &figure.edges {
        let (from, to) = (id(&figure.nodes[edge.from]), id(&figure.nodes[edge.to]));
        let arrow = match edge.flow {
            Flow::Move => "-->",
            Flow::Borrow => "<-->",
            Flow::Read => "-.-o",
        };
        let weight = if edge.weight > 1 { format!("|\"{}\"|", edge.weight) } else { String::new() };
        writeln!(out, "  {from} {arrow}{weight} {to}")?;
    }
    if !shared_ids.is_empty() {
        writeln!(
            out,
            "  classDef shared stroke-dasharray: 4 3\n  class {} shared",
            shared_ids.join(",")
        )?;
    }
    Ok(())
}

/// Returns the description behind a transition of a state diagram.
fn description(labels: &[Label<'_>]) -> String {
    let lines: Vec<String> =
        labels.iter().map(|label| escape(&label.to_string())).filter(|it| !it.is_empty()).collect();
    if lines.is_empty() { String::new() } else { format!(" : {}", lines.join("<br/>")) }
}

/// A name; one that is empty or blank becomes a space that Mermaid does not trim.
fn visible(name: &str) -> String {
    if name.trim().is_empty() { "#160;".to_owned() } else { escape(name) }
}

/// Letters, digits and the signs of labels stay; the rest becomes character codes, line ends
/// spaces, and what is obeyed or hidden its code in letters.
fn escape(text: &str) -> String {
    let mut out = String::new();
    for (c, hidden) in marked(text) {
        match c {
            ' ' | '_' | ',' | '.' | '!' | '/' | '+' | '=' | '[' | ']' | '(' | ')' | '≤' | '≥'
            | '●' => {
                out.push(c);
            }
            c if c.is_alphanumeric() => out.push(c),
            '\n' | '\r' | '\t' => out.push(' '),
            c if hidden => {
                let _ = write!(out, "#92;u#123;{:x}#125;", c as u32);
            }
            c => {
                // Writing into a string cannot fail.
                let _ = write!(out, "#{};", c as u32);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{escape, visible};

    #[test]
    fn characters_of_the_syntax_become_codes() {
        assert_eq!(escape("x := y; -->"), "x #58;= y#59; #45;#45;#62;");
        assert_eq!(escape("event [!a & n ≥ 2] / b\n"), "event [!a #38; n ≥ 2] / b ");
        assert_eq!(escape("\u{202e}a\u{1b}"), "#92;u#123;202e#125;a#92;u#123;1b#125;");
        assert_eq!(visible(" "), "#160;");
    }
}
