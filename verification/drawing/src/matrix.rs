//! The incidence matrix, as a table.

use cotama_core::net::{Arc, Net, Transition};
use cotama_core::text::marked;
use std::fmt::Write as _;

/// The matrices of a net as one table of tab-separated columns.
///
/// The lines that begin with `#` say what the table is. The line after them names the columns:
/// `part`, `place`, then the transitions in their order. Each further line belongs to one place in
/// one of four parts, in this order: `pre` (tokens that a transition removes), `read` (tokens that
/// must be there and stay), `post` (tokens that it adds) and `incidence`, which is `post` less
/// `pre`: what a firing changes. Reading changes nothing, so `read` is in neither.
///
/// A character of a name that a reader of tables could take for something else (white space other
/// than a blank, control characters, `#`, `"` and `\`) is written as `\u{..}` with its code point
/// in hexadecimal, so that
///
/// ```text
/// table = pandas.read_csv(
///     "net.tsv",
///     sep = "\t",
///     comment = "#",
///     index_col = [0, 1],
///     keep_default_na = False,
/// )
/// table.loc["incidence"].to_numpy()
/// ```
///
/// reads it. The table is dense: four numbers for each place and transition. Arcs to places that
/// the net does not have (see [`Net::defect`]) are left out.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::drawing::matrix;
///
/// let mut net = OwnedNet::new("light", "");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// net.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
/// let table = matrix::write(&net.view().net());
/// assert!(table.ends_with("incidence\toff\t-1\nincidence\ton\t1\n"));
/// ```
pub fn write(net: &Net<'_>) -> String {
    let mut text = format!(
        "# Matrices of the net {}: a row for each place, a column for each transition.\n",
        name(net.name)
    );
    text +=
        "# pre: tokens removed; read: tokens that must be there and stay; post: tokens added.\n";
    text += "# incidence = post - pre: what a firing changes.\n";
    text += "part\tplace";
    for transition in net.transitions {
        text.push('\t');
        text += &name(transition.name);
    }
    text.push('\n');
    let pre = |it: &Transition<'_>, place| weight(it.take, place);
    let read = |it: &Transition<'_>, place| weight(it.read, place);
    let post = |it: &Transition<'_>, place| weight(it.give, place);
    part(&mut text, net, "pre", pre);
    part(&mut text, net, "read", read);
    part(&mut text, net, "post", post);
    part(&mut text, net, "incidence", |it, place| post(it, place) - pre(it, place));
    text
}

fn part(
    text: &mut String,
    net: &Net<'_>,
    part: &str,
    entry: impl Fn(&Transition<'_>, usize) -> i64,
) {
    for (id, place) in net.places.iter().enumerate() {
        *text += part;
        text.push('\t');
        *text += &name(place.name);
        for transition in net.transitions {
            let _ = write!(text, "\t{}", entry(transition, id)); // a String takes everything
        }
        text.push('\n');
    }
}

fn weight(arcs: &[Arc], place: usize) -> i64 {
    arcs.iter().filter(|arc| arc.place.0 as usize == place).map(|arc| i64::from(arc.weight)).sum()
}

fn name(name: &str) -> String {
    let misread = |c: char| (c.is_whitespace() && c != ' ') || matches!(c, '#' | '"' | '\\');
    // A spreadsheet takes what begins so for a formula.
    let formula = |c: char| matches!(c, '=' | '+' | '-' | '@');
    marked(name).fold(String::with_capacity(name.len()), |mut text, (c, hidden)| {
        if hidden || misread(c) || (text.is_empty() && formula(c)) {
            text.extend(c.escape_unicode());
        } else {
            text.push(c);
        }
        text
    })
}
