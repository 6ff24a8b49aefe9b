//! Labels that may stand in a file without a word about them: all others are read, or refused.
//!
//! PNML lets every tool add labels of its own. Some change what an arc or a transition means, so a
//! label is left out only when it is listed here.

use super::error::{Finding, Span};
use super::state::Context;
use super::xml::{Attribute, Tag, tag as shown};
use cotama_property::source::quoted;

/// How a picture looks, and what people write beside it.
const DRAWN: [&str; 16] = [
    "graphics",
    "name",
    "offset",
    "position",
    "dimension",
    "fill",
    "line",
    "font",
    "color",
    "colour",
    "description",
    "documentation",
    "comment",
    "labels",
    "label",
    "annotationgraphics",
];

/// Elements of a net or a page that say nothing about its firings.
const OF_NETS: [&str; 10] = [
    "token",
    "tokenclass",
    "variables",
    "declaration",
    "declarations",
    "text",
    "metainformation",
    "preferences",
    "configuration",
    "layout",
];

/// Elements of a transition that forbid no firing: rates and weights say how likely firings are,
/// data that are written do not forbid any.
const OF_TRANSITIONS: [&str; 8] = [
    "orientation",
    "rate",
    "infiniteserver",
    "weight",
    "readvariable",
    "writevariable",
    "angle",
    "shape",
];

/// Elements of an arc that say how it runs over the paper.
const OF_ARCS: [&str; 5] = ["arcpath", "tagged", "bendpoints", "path", "points"];

/// Tools whose own parts are about drawings, names and structure, but for what is read of them.
const TOOLS: [&str; 16] = [
    "nupn",
    "prom",
    "pm4py",
    "woped",
    "tina",
    "pipe",
    "tapaal",
    "pnml framework",
    "pnmlframework",
    "epnk",
    "yasper",
    "snoopy",
    "romeo",
    "lola",
    "workcraft",
    "stochasticpetrinet",
];

/// Whether an element in here may be left out.
pub(super) fn is_harmless(context: Context, name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let is_in = |list: &[&str]| list.contains(&name.as_str());
    is_in(&DRAWN)
        || match context {
            Context::Net | Context::Page => is_in(&OF_NETS),
            Context::Transition => is_in(&OF_TRANSITIONS),
            Context::Arc => is_in(&OF_ARCS),
            Context::Place | Context::Reference | Context::Delay | Context::Interval(_) => false,
            Context::Label(..) => name == "toolspecific",
            _ => true,
        }
}

/// Whether a tool is known to say nothing about firings in elements that are not read.
pub(super) fn is_tool(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    TOOLS.iter().any(|it| name.contains(it))
}

/// Whether files of P/T nets call themselves so; what goes beyond them is read arc by arc.
pub(super) fn is_net_type(of: &str) -> bool {
    let of: String = of.to_ascii_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
    let ends = ["ptnet", "ptnetb", "pnmlcoremodel", "basicpnml", "stnet", "specialarcs", "pnet"];
    of.is_empty() || ends.iter().any(|it| of.ends_with(it)) || of.contains("inhibitor")
}

/// Attributes that say nothing about firings: those of XML, of the place on paper, of colours.
fn is_drawn(name: &str) -> bool {
    let drawn = ["name", "label", "description", "x", "y", "fill", "color", "colour", "style"];
    drawn.contains(&name.to_ascii_lowercase().as_str())
}

/// The attributes of a tag that PNML does not know, without their prefixes.
pub(super) fn others<'t, 'a>(
    tag: &'t Tag<'a>,
    known: &'t [&str],
) -> impl Iterator<Item = (&'a str, &'t Attribute<'a>)> {
    tag.attributes.iter().filter_map(move |it| {
        let (prefix, local) = it.name.split_once(':').unwrap_or(("", it.name));
        let of_xml = it.name.starts_with("xml") || prefix == "xsi";
        (!of_xml && !known.contains(&local) && !is_drawn(local)).then_some((local, it))
    })
}

/// An element that is not known.
pub(super) fn unknown(tag: &Tag<'_>, place: &str) -> Finding {
    Finding::new(tag.span, format!("an element {} of {place}, which is not known", shown(tag.name)))
        .help(
            "it may change what the net means: remove it if it does not, or let the tool write \
             plain PNML",
        )
}

/// An attribute that is not known.
pub(super) fn unknown_attribute(tag: &Tag<'_>, name: &str, span: Span) -> Finding {
    let message =
        format!("{} has an attribute {}, which is not known", shown(tag.name), quoted(name));
    Finding::new(span, message).help(
        "it may change what the net means: remove it if it does not, or let the tool write plain \
         PNML",
    )
}

/// TAPAAL's own format, which looks like PNML.
pub(super) fn tapaal(span: Span) -> Finding {
    Finding::new(span, "this is TAPAAL's own format (`.tapn`), not PNML").help(
        "in TAPAAL choose File > Export > PNML, which leaves ages of tokens out; inhibitor arcs \
         are read",
    )
}

/// Attributes and elements by which TAPAAL's own format is known.
pub(super) fn is_tapaal(tag: &Tag<'_>) -> bool {
    let has = |name: &str| tag.get(name).is_some();
    match tag.name {
        "place" => has("initialMarking") || has("invariant"),
        "arc" => has("inscription") || tag.get("type").is_some_and(|it| it.value == "timed"),
        "transition" => has("urgent") || has("infiniteServer"),
        "shared-place" | "shared-transition" | "inputArc" | "outputArc" | "transportArc" => true,
        _ => false,
    }
}

/// Returns the way out for a file of another tool, by its element.
pub(super) fn other_format(root: &str) -> Option<&'static str> {
    Some(match root {
        "TPN" => "this is a net of Romeo: export it there as PNML",
        "Snoopy" => "this is a net of Snoopy: export it there as PNML",
        "workspaceElements" | "cpnet" => {
            "this is a coloured net of CPN Tools: unfold it into a P/T net first"
        }
        "nta" => "these are timed automata of UPPAAL: no PNML can hold them",
        "project" | "gspn" => "this is a project of GreatSPN's editor: export its net as PNML",
        "RDF" | "rdf" => "this is a net of an old Renew or PED: save it as PNML",
        "log" => "this is a log of events, not a model",
        _ => return None,
    })
}
