//! Findings as one HTML page: each run frame by frame on the tree, without scripts from elsewhere.

use crate::explore::Run;
use crate::export::{escaped, sign, words};
use crate::picture::{details, levels};
use crate::replay::{Frame, frames};
use crate::tree::Tree;
use std::fmt::Write as _;

/// A part of the page.
#[derive(Clone, Debug)]
pub struct Section<'r> {
    /// Class: `error`, `warning` or `note`.
    pub class: &'static str,
    /// Finding, in words.
    pub title: String,
    /// Remedy.
    pub help: String,
    /// The run that shows it.
    pub run: Option<&'r Run>,
}

/// Writes the page.
pub fn html(tree: &Tree, title: &str, sections: &[Section]) -> String {
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>\n\
         <style>\n{}</style></head><body>\n<h1>{}</h1>\n",
        escaped(title),
        include_str!("page.css"),
        escaped(title)
    );
    if sections.is_empty() {
        out.push_str("<p>Nothing was found.</p>\n");
    }
    out.push_str(
        "<p>S success, F failure, R running, K skipped; pale: not ticked. Arrow keys, or a \
         click on a tick, show it.</p>\n",
    );
    for it in sections {
        section(tree, it, &mut out);
    }
    let _ = write!(out, "<script>\n{}</script></body></html>\n", include_str!("page.js"));
    out
}

fn section(tree: &Tree, it: &Section, out: &mut String) {
    let told = it.run.map(|run| (run, frames(tree, run).unwrap_or_default()));
    let told = told.filter(|it| !it.1.is_empty());
    let data = told.as_ref().map(|(_, all)| escaped(&json(all)));
    let data = data.map(|it| format!(" tabindex=\"0\" data-frames=\"{it}\"")).unwrap_or_default();
    let _ = writeln!(
        out,
        "<section class=\"{}\"{data}><h2>{}</h2><p class=\"help\">{}</p>",
        it.class,
        escaped(&it.title),
        escaped(&it.help)
    );
    if let Some((run, frames)) = told {
        out.push_str(
            "<p><button class=\"back\">◀ tick</button> <button class=\"on\">tick ▶</button></p>\
             \n<div class=\"run\"><div><table>\n",
        );
        rows(tree, frames.last(), out);
        out.push_str("</table></div><div><ol>\n");
        for (at, frame) in frames.iter().enumerate() {
            let again = if run.again_from == Some(at) { " class=\"again\"" } else { "" };
            let events = escaped(&frame.events.join(" "));
            let _ = writeln!(out, "<li{again}>{events} → {}</li>", escaped(&frame.status));
        }
        out.push_str("</ol>");
        if run.again_from.is_some() {
            out.push_str("<p>From the dashed line on it goes on so for ever.</p>");
        }
        let board = frames.last().map_or(String::new(), beside);
        let _ = writeln!(out, "<pre>{}</pre></div></div>", escaped(&board.replace(';', "\n")));
    }
    out.push_str("</section>\n");
}

fn rows(tree: &Tree, frame: Option<&Frame>, out: &mut String) {
    let letters: Vec<char> = frame.map_or(Vec::new(), |it| it.answers.chars().collect());
    for (at, level) in levels(tree).into_iter().enumerate() {
        let node = &tree.nodes[at];
        let letter = letters.get(at).copied().filter(|it| *it != '-');
        let letter = letter.map_or(String::new(), String::from);
        let indent = "\u{a0}\u{a0}".repeat(level);
        let _ = writeln!(
            out,
            "<tr><td class=\"s {letter}\">{letter}</td><td title=\"{}\">{indent}{} {}</td></tr>",
            escaped(&details(tree, at)),
            sign(&node.kind),
            escaped(&words(node))
        );
    }
}

/// Writes the blackboard, and the marked places of a supervisor below it.
fn beside(frame: &Frame) -> String {
    match frame.marked.join(", ") {
        it if it.is_empty() => frame.blackboard.clone(),
        it => format!("{};net at {it}", frame.blackboard),
    }
}

/// Writes frames for the script of the page.
fn json(frames: &[Frame]) -> String {
    let text = |it: &str| {
        let mut out = String::from("\"");
        for it in it.chars() {
            match it {
                '"' => out.push_str("\\\""),
                '\\' => out.push_str("\\\\"),
                it if (it as u32) < 32 => {
                    let _ = write!(out, "\\u{:04x}", it as u32);
                }
                it => out.push(it),
            }
        }
        out + "\""
    };
    let all = frames.iter().map(|it| {
        format!(
            "{{\"answers\":{},\"statuses\":{},\"blackboard\":{}}}",
            text(&it.answers),
            text(&it.statuses),
            text(&beside(it))
        )
    });
    format!("[{}]", all.collect::<Vec<_>>().join(","))
}
