//! A time net as text.

use super::parser::is_keyword;
use super::token::in_name;
use cotama_core::net::Arc;
use cotama_property::time::{Interval, TimeNet};
use std::fmt::Write as _;

/// A file that [`read`](super::read) reads as the same net: all places in their order, then all
/// transitions.
///
/// Every interval is written but `[0,w[`, which is the one of a transition without interval.
///
/// ```
/// use cotama_verification::tina;
/// let net = tina::read("egg.net", b"tr boil [300,360] raw -> hard  pl raw (1)").unwrap();
/// assert_eq!(tina::write(&net), "pl raw (1)\npl hard\ntr boil [300,360] raw -> hard\n");
/// ```
pub fn write(net: &TimeNet) -> String {
    let mut text = String::new();
    if !net.name().is_empty() {
        text += "net ";
        name(&mut text, net.name());
        text += "\n";
    }
    for place in net.places() {
        text += "pl ";
        named(&mut text, &place.name, place.label.as_deref());
        if place.initial > 0 {
            let _ = write!(text, " ({})", place.initial); // writing to a String cannot fail
        }
        text += "\n";
    }
    for transition in net.transitions() {
        text += "tr ";
        named(&mut text, &transition.name, transition.label.as_deref());
        if transition.interval != Interval::ANY {
            let _ = write!(text, " {}", transition.interval);
        }
        arcs(&mut text, net, &transition.take, '*');
        arcs(&mut text, net, &transition.read, '?');
        text += " ->";
        arcs(&mut text, net, &transition.give, '*');
        text += "\n";
    }
    text
}

fn named(text: &mut String, of: &str, label: Option<&str>) {
    name(text, of);
    if let Some(label) = label {
        *text += " : ";
        name(text, label);
    }
}

fn arcs(text: &mut String, net: &TimeNet, arcs: &[Arc], sign: char) {
    for arc in arcs {
        *text += " ";
        name(text, &net.places()[arc.place.0 as usize].name);
        if sign == '?' || arc.weight > 1 {
            let _ = write!(text, "{sign}{}", arc.weight);
        }
    }
}

/// A name, in braces where it needs them.
fn name(text: &mut String, name: &str) {
    // Some readers want a letter in front.
    if name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(in_name)
        && !is_keyword(name)
    {
        *text += name;
        return;
    }
    text.push('{');
    for c in name.chars() {
        if matches!(c, '{' | '}' | '\\') {
            text.push('\\');
        }
        text.push(c);
    }
    text.push('}');
}
