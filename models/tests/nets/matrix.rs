//! A net as a table: what each event does in each marking that lasts, and what happens there by
//! itself.

use crate::textbook::{Graph, Marking, enabled, fired, first, immediate, settled, words};
use crate::time::{Answer, Timed};
use cotama_core::net::Net;
use std::fmt::Write;

/// Returns the table of each event in each marking that lasts, and of transitions that fire by
/// themselves.
pub(crate) fn matrix(net: &Net<'_>, graph: &Graph) -> String {
    let mut text = String::new();
    let width = net.events.iter().map(|it| it.name.len()).chain(["by itself".len()]).max().unwrap();
    for marking in graph.markings.iter().filter(|it| settled(net, it)) {
        writeln!(text, "\n{}", words(net, marking)).unwrap();
        for (number, event) in net.events.iter().enumerate() {
            let able = first(net, |it| {
                it.on.is_some_and(|on| on.0 as usize == number) && enabled(it, marking)
            });
            let does = able.map_or_else(
                || said(net, Timed::new(net, marking).offer(number)),
                |(transition, _)| told(net, marking, transition),
            );
            writeln!(text, "  {:width$}  {does}", event.name).unwrap();
        }
        for (transition, it) in net.transitions.iter().enumerate() {
            if it.on.is_none() && enabled(it, marking) {
                writeln!(text, "  {:width$}  {}", "by itself", told(net, marking, transition))
                    .unwrap();
            }
        }
    }
    text
}

/// A firing, with what follows at once and where it leads.
fn told(net: &Net<'_>, marking: &Marking, transition: usize) -> String {
    let mut text = line(net, transition).to_owned();
    if let Some(within) = net.transitions[transition].within {
        let _ = match within.latest {
            Some(latest) if latest == within.earliest => write!(text, " (at {latest} ms)"),
            Some(latest) => write!(text, " (from {} to {latest} ms)", within.earliest),
            None => write!(text, " (from {} ms on)", within.earliest),
        };
    }
    let mut after = fired(&net.transitions[transition], marking);
    while let Some((at, it)) = first(net, |it| immediate(it) && enabled(it, &after)) {
        after = fired(it, &after);
        let _ = write!(text, ", {}", line(net, at));
    }
    format!("{text} -> {}", words(net, &after))
}

/// Returns the outcome of an event, in words.
pub(crate) fn said(net: &Net<'_>, answer: Answer) -> String {
    match answer {
        Answer::Fired { transition, settled } => {
            format!("{}, then {settled}", line(net, transition))
        }
        Answer::OnPurpose => "ignored".into(),
        Answer::NotEnabled => "-".into(),
        Answer::TooEarly(transition) => format!("too early for {}", line(net, transition)),
        Answer::TooLate(transition) => format!("too late for {}", line(net, transition)),
    }
}

/// The line of a transition: its name up to the first dot.
fn line<'n>(net: &Net<'n>, transition: usize) -> &'n str {
    net.transitions[transition].name.split('.').next().unwrap()
}
