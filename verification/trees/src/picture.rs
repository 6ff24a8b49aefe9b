//! A tree as SVG: one row a node, indented, with lines from parent to child.
//!
//! Rows never overlap and lines never cross, whatever the size of the tree. Types are told by a
//! sign, statuses by a letter and a colour.

use crate::export::{escaped, scripts, sign, words};
use crate::tree::Tree;
use std::fmt::Write as _;

/// Height of a row, width of a level, of a character.
const ROW: usize = 24;
const LEVEL: usize = 26;
const CHARACTER: usize = 8;
const MARGIN: usize = 12;

/// Returns how deep each node is.
pub(crate) fn levels(tree: &Tree) -> Vec<usize> {
    let mut levels: Vec<usize> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        levels.push(node.parent.map_or(0, |it| levels[it] + 1));
    }
    levels
}

/// Returns what is said of a node besides its name: ports and scripts.
pub(crate) fn details(tree: &Tree, node: usize) -> String {
    let it = &tree.nodes[node];
    let ports = it.ports.iter().map(|(name, text)| format!("{name}={text}"));
    let scripts = scripts(it).into_iter().map(|(name, text)| format!("{name}=\"{text}\""));
    let all: Vec<_> = ports.chain(scripts).collect();
    let text = all.join("  ");
    let cut: String = text.chars().take(90).collect();
    if cut.len() < text.len() { format!("{cut}…") } else { cut }
}

/// Draws a tree; `statuses` has a letter for each node: S, F, R, K, or `-` and I for none.
pub fn svg(tree: &Tree, statuses: Option<&str>) -> String {
    let levels = levels(tree);
    let width_of = |at: usize| {
        let text = words(&tree.nodes[at]).chars().count() + details(tree, at).chars().count();
        MARGIN * 2 + levels[at] * LEVEL + (text + 8) * CHARACTER
    };
    let width = (0..tree.nodes.len()).map(width_of).max().unwrap_or(100);
    let height = MARGIN * 2 + tree.nodes.len() * ROW;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" role=\"img\" aria-label=\"{}\">\n",
        escaped(&tree.name)
    );
    out.push_str(
        "<style>svg{background:#fff}text{font:13px ui-monospace,monospace;fill:#111}\
         .detail{fill:#666}\
         path{fill:none;stroke:#999}rect{stroke:#444;fill:#fff}\
         .S{fill:#b7e3c0}.F{fill:#f3b8a8}.R{fill:#f6dc8c}.K{fill:#d5d5d5}\
         @media screen and (prefers-color-scheme:dark){svg{background:#161616}\
         text{fill:#eee}.detail{fill:#aaa}\
         rect{stroke:#bbb;fill:#222}.S{fill:#23633a}.F{fill:#8a3a26}.R{fill:#775c0c}\
         .K{fill:#555}}</style>\n",
    );
    let x = |at: usize| MARGIN + levels[at] * LEVEL;
    let y = |at: usize| MARGIN + at * ROW;
    for (at, node) in tree.nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            let (from, middle) = (x(parent) + 9, y(at) + ROW / 2);
            let _ =
                writeln!(out, "<path d=\"M{from} {}V{middle}H{}\"/>", y(parent) + ROW - 3, x(at));
        }
    }
    let letters: Vec<char> = statuses.unwrap_or("").chars().collect();
    for (at, node) in tree.nodes.iter().enumerate() {
        let letter = letters.get(at).copied().filter(|it| "SFRK".contains(*it));
        let shown = letter.map_or(String::new(), String::from);
        let _ = writeln!(
            out,
            "<rect x=\"{}\" y=\"{}\" width=\"18\" height=\"18\" rx=\"3\" class=\"{shown}\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{shown}</text>\
             <text x=\"{}\" y=\"{}\">{} {} <tspan class=\"detail\">{}</tspan></text>",
            x(at),
            y(at) + 3,
            x(at) + 9,
            y(at) + 17,
            x(at) + 26,
            y(at) + 17,
            sign(&node.kind),
            escaped(&words(node)),
            escaped(&details(tree, at)),
        );
    }
    out.push_str("</svg>\n");
    out
}
