//! Drawings of a network: DOT, and SVG with the coherence of all pairs.

use crate::coherence::{Coherence, coherence};
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

    /// Draws the variables on a circle, and a line for each pair of these coherences, the wider
    /// and darker the more coherent it is.
    pub fn to_svg(&self, pairs: &[Coherence]) -> String {
        const SIZE: f64 = 640.0;
        const RADIUS: f64 = 230.0;
        let count = self.nodes().len() as f64;
        let place = |at: usize| {
            let angle = std::f64::consts::TAU * at as f64 / count;
            let middle = SIZE / 2.0;
            (middle + RADIUS * libm::sin(angle), middle - RADIUS * libm::cos(angle))
        };
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" \
             font-family=\"sans-serif\" font-size=\"13\">\n<title>{}</title>\n",
            escaped(self.name())
        );
        for pair in pairs.iter().filter(|it| it.eta >= 0.0005) {
            let ((x1, y1), (x2, y2)) = (place(pair.x), place(pair.y));
            let strength = libm::sqrt(pair.eta);
            let (x, y) = (&self.nodes()[pair.x].variable.name, &self.nodes()[pair.y].variable.name);
            let _ = writeln!(
                text,
                "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" \
                 stroke=\"#14548c\" stroke-width=\"{:.2}\" stroke-opacity=\"{:.2}\"><title>{} - \
                 {}: {:.4}</title></line>",
                0.5 + 7.5 * strength,
                0.15 + 0.85 * strength,
                escaped(x),
                escaped(y),
                pair.eta
            );
        }
        for (at, node) in self.nodes().iter().enumerate() {
            let (x, y) = place(at);
            let side = if x < SIZE / 2.0 - 1.0 { "end" } else { "start" };
            let beside = if side == "end" { x - 12.0 } else { x + 12.0 };
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#14548c\"/><text \
                 x=\"{beside:.1}\" y=\"{:.1}\" text-anchor=\"{side}\">{}</text>",
                y + 4.5,
                escaped(&node.variable.name)
            );
        }
        text.push_str("</svg>\n");
        text
    }
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}

fn escaped(name: &str) -> String {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    name.replace(|it: char| it.is_control(), "\u{fffd}")
}
