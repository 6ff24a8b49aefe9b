//! PNML, the exchange format of Petri nets (ISO/IEC 15909-2), read and written.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_verification::pnml;
//!
//! let mut lamp = OwnedNet::new("lamp", "It can be switched on once.");
//! let off = lamp.place(OwnedPlace::new("off", 1).at_most(1)).unwrap();
//! let on = lamp.place(OwnedPlace::new("on", 0).at_most(1)).unwrap();
//! lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
//! let text = pnml::write(&lamp.view().net());
//! assert_eq!(pnml::read("lamp.pnml", text.as_bytes()).unwrap(), lamp);
//! ```
//!
//! # What is read
//!
//! One place/transition net: nodes on any number of pages, pages in pages, references to nodes of
//! other pages, names, initial markings and inscriptions. Node by node the order of the file is
//! kept. The nets of the Model Checking Contest are such files. Also read are older files with
//! other net types or without pages, and `<value>` in place of `<text>`, as PIPE writes it.
//!
//! Graphics, names, colours of the drawing and other labels that say nothing about firings are
//! listed and left out; any other element or attribute of an arc, a place, a transition, a page or
//! the net is refused. Of what other tools add in `<toolspecific>` the kinds of arcs, guards,
//! priorities and capacities are read as outside of it; the rest is left out, with a
//! [note](Imported::notes) where the tool is not known.
//!
//! - A name is the `<text>` of `<name>` without white space around it; without one it is the id.
//!   Names become unique: of nodes with the same name the first keeps it, the others are named
//!   `name (id)`.
//! - Several arcs between the same two nodes in one direction are one arc with the sum of their
//!   weights.
//! - The kind of an arc is `normal`, `test` or `read`, `inhibitor`, or `reset`, in any of the ways
//!   in which tools say it: `<type>` or `<arctype>` with `<text>`, text alone, or an attribute
//!   `value`; an attribute `type`, `arctype`, or `inhibitor="true"`; an element `<inhibitor>`
//!   around the weight; an element `<inhibitorArc>` in place of `<arc>`; `<kind>` of any namespace.
//!   An arc of any other kind is refused. An inhibitor arc of weight `w` lets its transition fire
//!   only while the place holds fewer than `w` tokens; how nets with such arcs fire is told in
//!   [`Extras`].
//! - `<priority>` of PIPE: of enabled transitions only those of the highest priority fire. Guards
//!   other than `true`, and capacities, are refused. Random delays are an error for all who do not
//!   leave time out, see [`Imported::random`]; immediate transitions go before random ones.
//! - An empty initial marking is none.
//! - Ids of nodes differ. Nothing refers to those of arcs and pages, so these may be any.
//! - Coloured (high-level) nets are refused, and files with several P/T nets. A coloured net beside
//!   the only P/T net is skipped. A net without places, transitions or both is a net.
//! - Encodings: UTF-8, UTF-16, ISO-8859-1, US-ASCII.
//! - Namespaces are not told apart: elements are known by their local names.
//! - A transition may have a `<delay>` as TINA writes it: a closed `MathML` interval, in
//!   milliseconds here. In a file that has such intervals a transition without one has the interval
//!   from 0 without limit, as in TINA. In other files transitions have no interval; then time is
//!   not part of the net.
//! - The line of a transition is its position.
//!
//! Numbers are at most [`u32::MAX`]. [`Limits`] bound what a file may ask for. Time and memory grow
//! with the length of the file and no faster; there is no recursion, and entities are never
//! expanded.
//!
//! # What is written
//!
//! A P/T net of the standard on one page, with the ids `p0`, `t0`, `a0` and so on. A read arc is an
//! arc from the place and one back to it. What the standard cannot say stands in elements
//! `<toolspecific tool="cotama" version="1">`, which other tools skip:
//!
//! | in | element | attributes |
//! | --- | --- | --- |
//! | net | `net` | `name`, `doc` |
//! | | `event`, `output` | `id`, `name`, `doc` |
//! | | `ignored` | `event`, `place`; for each place of a guard an element `term`, as below |
//! | | `invariant` | `equals`; for each place an element `term` with `place`, `weight` |
//! | | `never-both` | `first`, `second` |
//! | | `reachable`, `always-can` | `place` |
//! | | `deadlock-free` | `end` (a place, optional) |
//! | | `handles-all`, `settles`, `deterministic` | |
//! | place | `place` | `name`, `doc`, `bound` |
//! | | | `role`: `state`, `data`, `complement`, `shared`, `mailbox` |
//! | | | `of`: the place of a complement |
//! | transition | `transition` | `name`, `doc`, `line`, `on` (an event), `emits` (outputs) |
//! | | | `earliest`, `latest` (milliseconds), `priority` |
//! | arc | `arc` | `read`: how many of its tokens belong to a read arc |
//!
//! Places, events and outputs are named by their ids. What is not there has its default: no
//! documentation, no bound, no event, priority 0, the line of its position. The attribute `name` is
//! there when `<name>` cannot hold the exact name: when it is empty, has white space around it, or
//! a character that XML 1.0 has not; for such a character `<name>` has U+FFFD. In the attributes
//! `name` and `doc` a backslash is written `\\`, and a character that XML 1.0 has not is written
//! `\u{1b}`. So every net that [`Net::defect`](cotama_core::net::Net::defect) finds nothing in and
//! whose names are unique is read back exactly as it was.

mod arcs;
mod document;
mod encoding;
mod error;
mod escape;
mod flow;
mod foreign;
mod kind;
mod known;
mod label;
mod names;
mod nodes;
mod own;
mod parser;
#[cfg(kani)]
pub mod proofs;
mod resolve;
mod state;
mod write;
mod xml;

pub use cotama_property::source::Location;
pub use error::{Diagnostic, MAX_DIAGNOSTICS, PnmlErrors};
pub use write::{write, write_extended, write_for_tina};

use cotama_core::net::TransitionId;
use cotama_core::net::owned::OwnedNet;
use cotama_property::Ids;
use cotama_property::pt::Extras;
use error::{Finding, Findings, Span};

/// How much a file may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The length of the file.
    pub bytes: usize,
    /// How deep elements may be nested.
    pub depth: usize,
    /// Attributes of one element.
    pub attributes: usize,
    /// The bytes of one attribute, and of one label.
    pub text: usize,
    /// Pages, places, transitions, references and arcs together; at most [`u32::MAX`] count.
    pub objects: usize,
}

impl Default for Limits {
    /// A file of 1 GiB, 256 elements deep, 64 attributes in an element, texts of 1 MiB, 2²⁸
    /// objects.
    fn default() -> Self {
        Self { bytes: 1 << 30, depth: 256, attributes: 64, text: 1 << 20, objects: 1 << 28 }
    }
}

/// A net from a file, with the ids that it had there: property files of the Model Checking Contest
/// use them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Imported {
    /// The net.
    pub net: OwnedNet,
    /// The id of each place.
    pub place_ids: Vec<String>,
    /// The id of each transition.
    pub transition_ids: Vec<String>,
    /// The transitions that `ProM` or pm4py calls invisible: no log shows them.
    pub invisible: Vec<TransitionId>,
    /// The names in the file of those transitions that share one and are called otherwise in the
    /// net.
    pub shared_names: Vec<(TransitionId, String)>,
    /// Inhibitor arcs, reset arcs and priorities, which the net itself cannot hold.
    pub extras: Extras,
    /// The error that transitions have random delays, at the first one, for all who do
    /// not leave time out.
    pub random: Option<PnmlErrors>,
    /// Notes on what was left out, a sentence each without its stop.
    pub notes: Vec<String>,
}

impl<'a> From<&'a Imported> for Ids<'a> {
    fn from(imported: &'a Imported) -> Self {
        Self { places: &imported.place_ids, transitions: &imported.transition_ids }
    }
}

impl Imported {
    /// The net, if it is all.
    ///
    /// # Errors
    /// When it has inhibitor arcs, reset arcs, priorities or random delays, which would be lost.
    pub fn plain(self, name: &str) -> Result<OwnedNet, PnmlErrors> {
        if let Some(random) = self.random {
            return Err(random);
        }
        if self.extras.is_empty() {
            return Ok(self.net);
        }
        let message = format!("a net with {}, which cannot be used here", self.extras.named());
        let finding = Finding::new(Span::default(), message)
            .help("`cotama check` and `cotama statespace` know what they mean");
        Err(PnmlErrors::new(name, String::new(), finding.into()))
    }
}

/// Reads the net of a PNML file. `name` is the name of the file in messages.
///
/// [`Net::defect`](cotama_core::net::Net::defect) finds nothing in the net, and the names of its
/// places and of its transitions are unique.
///
/// # Errors
/// All that is wrong with the file; after an error in its XML nothing further is looked for. Also
/// that it has inhibitor arcs, reset arcs, priorities or random delays, of which [`read_within`]
/// tells.
///
/// ```
/// use cotama_verification::pnml;
/// let text = r#"<pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml">
/// <net id="n" type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g">
///   <place id="p"><initialMarking><text>1</text></initialMarking></place>
///   <transition id="t"/>
///   <arc id="a" source="p" target="t"/>
/// </page></net></pnml>"#;
/// let net = pnml::read("mine.pnml", text.as_bytes()).unwrap();
/// assert_eq!((net.places[0].name.as_str(), net.places[0].initial), ("p", 1));
/// assert_eq!(net.transitions[0].take.len(), 1);
/// ```
pub fn read(name: &str, bytes: &[u8]) -> Result<OwnedNet, PnmlErrors> {
    read_within(name, bytes, Limits::default())?.plain(name)
}

/// Reads the net of a PNML file, and its ids, within other limits than the usual ones.
///
/// # Errors
/// As [`read`].
pub fn read_within(name: &str, bytes: &[u8], limits: Limits) -> Result<Imported, PnmlErrors> {
    let limits = Limits { objects: limits.objects.min(u32::MAX as usize), ..limits };
    if bytes.len() > limits.bytes {
        let message = format!("the file has {} bytes, more than {}", bytes.len(), limits.bytes);
        let finding =
            Finding::new(Span::default(), message).help("raise the limit, or make the net smaller");
        return Err(PnmlErrors::new(name, String::new(), finding.into()));
    }
    let text = encoding::decode(bytes)
        .map_err(|(text, finding)| PnmlErrors::new(name, text, finding.into()))?;
    let (document, mut findings): (_, Findings) = parser::parse(&text, limits);
    let imported = document.map(|document| resolve::resolve(document, &mut findings));
    match imported {
        Some((mut imported, random)) if findings.is_empty() => {
            let random = random.map(|span| {
                Finding::new(span, "a transition with a random delay, which is not read").help(
                    "--untimed leaves delays out: then enabled transitions fire in any order, \
                     immediate ones before the others",
                )
            });
            imported.random = random.map(|it| PnmlErrors::new(name, text.into_owned(), it.into()));
            Ok(imported)
        }
        _ => Err(PnmlErrors::new(name, text.into_owned(), findings)),
    }
}
