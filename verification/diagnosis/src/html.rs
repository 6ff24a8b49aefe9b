//! A diagnosis as a page.

use super::text::change;
use super::timeline::timeline;
use super::words::{counted, printable};
use super::{Diagnosis, Step, Tokens};
use cotama_core::text::markup;
use cotama_drawing::palette;
use std::fmt::Write as _;

/// Firings that are listed at the beginning and at the end of a long run.
const HEAD: usize = 100;
const TAIL: usize = 200;

const STYLE: &str = concat!(
    palette!(".diagnosis"),
    "\
body{margin:0;background:#fff}
.diagnosis{--rule:#d0d7de;--bar:#3b6ea5;--count:#fff;--good:#1a7f4b;--pale:#fff3e6;\
background:var(--paper);color:var(--ink);font-size:15px;line-height:1.5;\
max-width:1352px;margin:0 auto;padding:24px}
@media screen and (prefers-color-scheme:dark){body{background:#14181d}
.diagnosis{--rule:#343c46;--bar:#6ea8e0;--count:#10151b;--good:#4ac27f;--pale:#33230f}}
.diagnosis h1{font-size:20px;line-height:1.35;margin:0 0 12px;overflow-wrap:anywhere}
.diagnosis h2{font-size:15px;margin:28px 0 8px}
.diagnosis .net{color:var(--quiet);margin:0 0 4px}
.diagnosis code{font-family:'DejaVu Sans Mono',Menlo,Consolas,monospace;font-size:.9em;\
background:var(--fill);\
border-radius:4px;padding:1px 4px;overflow-wrap:anywhere}
.diagnosis table code,.diagnosis table span{white-space:nowrap}
.diagnosis .cause{border-left:4px solid var(--hot);background:var(--pale);padding:8px 14px;margin:0}
.diagnosis .holds .cause{border-color:var(--good);background:var(--fill)}
.diagnosis .cause p{margin:2px 0}
.diagnosis .scroll{overflow-x:auto}
.diagnosis table{border-collapse:collapse;width:100%}
.diagnosis th{text-align:left;font-weight:600;color:var(--quiet);\
border-bottom:1px solid var(--rule)}
.diagnosis th,.diagnosis td{padding:4px 12px 4px 0;vertical-align:top}
.diagnosis td{border-bottom:1px solid var(--rule)}
.diagnosis td.number{color:var(--quiet);text-align:right;width:3em;\
font-variant-numeric:tabular-nums}
.diagnosis tr.last td{background:var(--pale)}
.diagnosis tr.note td{color:var(--quiet);font-style:italic}
.diagnosis .more{color:var(--good)}
.diagnosis .less{color:var(--quiet)}
.diagnosis .turn{color:var(--hot)}
.diagnosis dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 16px;margin:0}
.diagnosis dd{margin:0}
.diagnosis .timeline text{fill:var(--ink);font-size:12px}
.diagnosis .timeline .row{text-anchor:end}
.diagnosis .timeline .number{text-anchor:middle;fill:var(--quiet);font-size:11px}
.diagnosis .timeline .count{text-anchor:middle;fill:var(--count);font-weight:600}
.diagnosis .timeline .grid{stroke:var(--rule);stroke-width:1}
.diagnosis .timeline .bar{fill:var(--bar)}
.diagnosis .timeline .atom{fill:var(--hot)}
.diagnosis .timeline .cycle{fill:var(--hot);opacity:.14}
.diagnosis tr.now td{background:var(--fill)}
.diagnosis figure{margin:0}
.diagnosis .player{display:flex;gap:8px;align-items:center;position:sticky;top:0;padding:8px 0;\
background:var(--paper)}
.diagnosis .player[hidden]{display:none}
.diagnosis .player input{flex:1;max-width:420px;accent-color:var(--bar)}
.diagnosis .player button{font:inherit;color:inherit;background:var(--fill);\
border:1px solid var(--rule);border-radius:4px;padding:2px 10px}
.diagnosis figure svg{display:block}
"
);

impl Diagnosis {
    /// A page of its own: what [`Display`](std::fmt::Display) says, bars of the places that the
    /// property speaks of, and the net as the run leaves it, if it is small; a slider and the arrow
    /// keys go through the run. It needs no other file, and without its script it shows the last
    /// step; colours follow the reader's light or dark mode.
    pub fn html(&self) -> String {
        page(&format!("{}: {}", printable(&self.net), printable(&self.name)), &self.html_section())
    }

    /// The style sheet that [`html_section`](Self::html_section) asks for.
    pub const fn html_style() -> &'static str {
        STYLE
    }

    /// The same without the page around it, to be put into another one.
    pub fn html_section(&self) -> String {
        let mut out = String::new();
        let class = if self.holds { "holds" } else { "fails" };
        let space = if self.doc.is_empty() { "" } else { ": " };
        let about = format!("{}{space}{}", printable(&self.net), printable(&self.doc));
        let _ = write!(
            out,
            "<section class=\"diagnosis\">\n<div class=\"{class}\">\n<p class=\"net\">{}</p>\n\
             <h1>{}</h1>\n",
            markup(&about),
            sentence(&self.summary)
        );
        if !self.cause.is_empty() || !self.notes.is_empty() {
            out.push_str("<div class=\"cause\">\n");
            for line in std::iter::once(&self.cause).chain(&self.notes).filter(|it| !it.is_empty())
            {
                let _ = writeln!(out, "<p>{}</p>", sentence(line));
            }
            out.push_str("</div>\n");
        }
        out.push_str("</div>\n");
        if let Some(timeline) = timeline(self) {
            let _ = write!(
                out,
                "<h2>Tokens after each step</h2>\n<div class=\"scroll\">\n{timeline}</div>\n"
            );
        }
        self.steps(&mut out);
        if !self.legend.is_empty() {
            out.push_str("<h2>What the names mean</h2>\n<dl>\n");
            for it in self.legend.iter().filter(|it| self.shows(&it.name)) {
                let (name, doc) = (markup(&printable(&it.name)), markup(&it.doc));
                let _ = writeln!(out, "<dt><code>{name}</code></dt><dd>{doc}</dd>");
            }
            out.push_str("</dl>\n");
        }
        if let Some(picture) = &self.picture {
            let heading = "The net after the last step; the keys ← and → go through the run";
            let heading = if self.trace.is_empty() { "The net at the start" } else { heading };
            out += &picture.figure(heading, &self.trace);
        }
        out.push_str("</section>\n");
        out
    }

    fn steps(&self, out: &mut String) {
        let has_date = self.trace.iter().any(|it| it.at.is_some());
        let has_event = self.trace.iter().any(|it| it.event.is_some());
        let has_output = self.trace.iter().any(|it| !it.outputs.is_empty());
        let columns: Vec<&str> = [
            (true, "Step"),
            (has_date, "ms"),
            (true, "Fires"),
            (has_event, "On event"),
            (has_output, "Emits"),
            (true, "Changes"),
        ]
        .iter()
        .filter(|it| it.0)
        .map(|it| it.1)
        .collect();
        out.push_str("<h2>Step by step</h2>\n<div class=\"scroll\">\n<table>\n<thead><tr>");
        for it in &columns {
            let _ = write!(out, "<th>{it}</th>");
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        let span = columns.len() - 1;
        let edge = |out: &mut String, name: &str, text: &str| {
            let _ = writeln!(
                out,
                "<tr><td class=\"number\">{name}</td><td colspan=\"{span}\">{text}</td></tr>"
            );
        };
        let note = |out: &mut String, text: &str| {
            let _ = writeln!(
                out,
                "<tr class=\"note\"><td></td><td colspan=\"{span}\">{text}</td></tr>"
            );
        };
        edge(out, "start", &self.marking_as_code(&self.initial));
        let count = self.trace.len();
        for (at, step) in self.trace.iter().enumerate() {
            if self.cycle_starts_at == Some(at) {
                note(out, &format!("From here on steps {} to {count} repeat for ever.", at + 1));
            }
            if count > HEAD + TAIL && (HEAD..count - TAIL).contains(&at) {
                if at == HEAD {
                    note(out, &format!("{} left out.", counted(count - TAIL - HEAD, "step")));
                }
                continue;
            }
            let class = if at + 1 == count && self.cycle_starts_at.is_none() {
                " class=\"last\""
            } else {
                ""
            };
            let number = at + 1;
            let _ =
                write!(out, "<tr{class} data-step=\"{number}\"><td class=\"number\">{number}</td>");
            if has_date {
                let date = step.at.map_or_else(String::new, |it| it.to_string());
                let _ = write!(out, "<td class=\"number\">{date}</td>");
            }
            let _ = write!(out, "<td>{}</td>", code(&step.transition));
            if has_event {
                let _ = write!(
                    out,
                    "<td>{}</td>",
                    step.event.as_deref().map_or_else(String::new, code)
                );
            }
            if has_output {
                let outputs: Vec<String> = step.outputs.iter().map(|it| code(it)).collect();
                let _ = write!(out, "<td>{}</td>", outputs.join(" "));
            }
            let _ = writeln!(out, "<td>{}</td></tr>", self.changed(step));
        }
        match self.cycle_starts_at {
            Some(0) => note(out, "As at the start."),
            Some(start) => note(out, &format!("As after step {start}.")),
            None if count > 0 => edge(out, "end", &self.marking_as_code(&self.last)),
            None => {}
        }
        out.push_str("</tbody>\n</table>\n</div>\n");
    }

    /// Returns the changes of a step, and the atoms that it turns beyond those of marked places.
    fn changed(&self, step: &Step) -> String {
        let one = |it: &super::Change| {
            let class = if it.before < it.after { "more" } else { "less" };
            format!("<span class=\"{class}\">{}</span>", markup(&change(it)))
        };
        let turn = |it: &super::Turn| {
            let verb = if it.holds { "now" } else { "no more" };
            format!("<span class=\"turn\">({verb} {})</span>", markup(&printable(&it.atom)))
        };
        let shown = step.changes.iter().filter(|it| self.shows(&it.place));
        let all: Vec<String> = shown.map(one).chain(self.turns(step).map(turn)).collect();
        if all.is_empty() { "no change".to_owned() } else { all.join(" ") }
    }
}

/// A page around a section.
pub(super) fn page(title: &str, section: &str) -> String {
    cotama_drawing::page::write(title, &[STYLE], section)
}

impl Diagnosis {
    fn marking_as_code(&self, tokens: &[Tokens]) -> String {
        let one = |it: &Tokens| match it.tokens {
            1 => code(&it.place),
            more => format!("{} {more}", code(&it.place)),
        };
        let all: Vec<String> = tokens.iter().filter(|it| self.shows(&it.place)).map(one).collect();
        if all.is_empty() { "nothing is marked".to_owned() } else { all.join(" ") }
    }
}

pub(super) fn code(name: &str) -> String {
    format!("<code>{}</code>", markup(&printable(name)))
}

/// A sentence with names in backticks, of which there are two for each.
pub(super) fn sentence(text: &str) -> String {
    let mut out = String::new();
    for (at, part) in text.split('`').enumerate() {
        if at % 2 == 1 {
            let _ = write!(out, "<code>{}</code>", markup(part));
        } else {
            out.push_str(&markup(part));
        }
    }
    out
}
