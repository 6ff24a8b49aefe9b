//! Drawings of a network as DOT, with the strengths of its arcs.

use crate::coherence::coherence;
use crate::infer::NoAnswer;
use crate::network::Network;
use std::fmt::Write;

impl Network {
    /// Writes the graph as DOT. Each arc has the coherence of its ends as label, and is the wider
    /// the more coherent they are.
    ///
    /// # Errors
    /// When the network is too wide for its marginals.
    pub fn to_dot(&self) -> Result<String, NoAnswer> {
        let all = coherence(self)?;
        let mut text = format!("digraph {} {{\n", quoted(self.name()));
        for node in self.nodes() {
            let _ = writeln!(text, "  {};", quoted(&node.variable.name));
        }
        for (to, node) in self.nodes().iter().enumerate() {
            for from in &node.parents {
                let ends = (to.min(*from), to.max(*from));
                let pair = all.iter().find(|it| (it.x, it.y) == ends);
                let eta = pair.map_or(0.0, |it| it.eta);
                let (from, to) = (&self.nodes()[*from].variable.name, &node.variable.name);
                let (from, to, width) = (quoted(from), quoted(to), 1.0 + 4.0 * eta);
                let _ =
                    writeln!(text, "  {from} -> {to} [label=\"{eta:.3}\", penwidth={width:.2}];");
            }
        }
        text.push_str("}\n");
        Ok(text)
    }
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}
