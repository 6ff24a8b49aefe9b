//! Certificates of answers about trees.
//!
//! A certificate holds the files of a tree, how they were read, what was assumed, and which answers
//! are good. Whoever doubts them needs neither the exploration nor its states: [`verify`] reads the
//! tree again and walks it plainly (see [`crate::plain`]). A supervisor beside the tree is held as
//! the text of its model, with that of the bindings, and explored anew. No evidence makes this
//! shorter than the search was, since whatever a tree does, its executor must be asked.

use crate::explore::{Assumptions, End, Property, parse_assumption, parse_property};
use crate::findings::Wishes;
use crate::kinds::{Leaf, LeafKind};
use crate::plain::{Plain, walk};
use crate::reader::{Options, read};
use crate::supervisor::{Bindings, Supervisor};
use crate::tree::{Answer, Kind, Tree};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Schema of certificates.
pub const SCHEMA: &str = "cotama-tree-certificate/1";

/// Most states that a plain walk goes through.
pub const MOST_STATES: usize = 100_000;

/// Questions that a plain walk can answer.
pub const SHOWN: [&str; 15] = [
    "can-succeed",
    "exception",
    "halt-exception",
    "stuck",
    "never-ends",
    "restarted-forever",
    "spins",
    "success-lost",
    "recovery",
    "never-ticked",
    "never-succeeds",
    "exclusive",
    "running-together",
    "read-before-written",
    "refused",
];

/// Answers about a tree, with all that is needed to ask again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    schema: String,
    /// Name of the first file.
    model: String,
    /// Names and texts of all files that were read.
    files: BTreeMap<String, String>,
    reading: Reading,
    /// Whether leaves may answer SKIPPED.
    pub skips: bool,
    /// Time between two ticks, in ms.
    pub period: Option<u32>,
    /// Assumptions on answers.
    pub assume: Vec<String>,
    /// Actions that exclude each other.
    pub exclusive: Vec<String>,
    /// Entries that are written before the first tick.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given: Vec<String>,
    /// The supervisor beside the tree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beside: Option<Beside>,
    /// Questions and own properties that are answered well.
    pub shows: Vec<String>,
}

/// A supervisor beside a tree, as texts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beside {
    /// The model.
    pub model: String,
    /// The file that binds leaves.
    pub bindings: String,
}

/// Explores the model of a supervisor: its text, the time between two ticks in ms, events that do
/// not happen.
pub type Explore<'e> = &'e mut dyn FnMut(&str, Option<u32>, &[&str]) -> Result<Supervisor, String>;

/// Options of the reader, in words.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Reading {
    tree: Option<String>,
    /// Tag, kind, ports that it writes.
    leaves: Vec<(String, String, Vec<String>)>,
    models: Vec<String>,
    unknown: Option<String>,
    search: Vec<String>,
}

impl Reading {
    fn of(options: &Options) -> Reading {
        let leaf = |it: &Leaf| (it.tag.clone(), it.kind.word().to_owned(), it.writes.clone());
        Reading {
            tree: options.main.clone(),
            leaves: options.leaves.iter().map(leaf).collect(),
            models: options.models.clone(),
            unknown: options.unknown.map(|it| it.word().to_owned()),
            search: options.search.clone(),
        }
    }

    fn options(&self) -> Option<Options> {
        let leaves = self.leaves.iter().map(|(tag, kind, writes)| {
            let (tag, writes) = (tag.clone(), writes.clone());
            Some(Leaf { tag, kind: LeafKind::of_word(kind)?, writes })
        });
        let unknown = match &self.unknown {
            Some(word) => Some(LeafKind::of_word(word)?),
            None => None,
        };
        Some(Options {
            leaves: leaves.collect::<Option<_>>()?,
            models: self.models.clone(),
            unknown,
            main: self.tree.clone(),
            search: self.search.clone(),
        })
    }
}

/// Results of verifying a certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verified {
    /// Name of the tree.
    pub tree: String,
    /// Nodes.
    pub nodes: usize,
    /// States that were walked through.
    pub states: usize,
    /// Questions and own properties that are answered well.
    pub shows: Vec<String>,
}

/// Cause of a refusal, and where in the certificate.
pub type Refused = (&'static str, String);

impl Certificate {
    /// Makes a certificate that shows nothing yet.
    pub fn new(model: &str, files: BTreeMap<String, String>, options: &Options) -> Certificate {
        Certificate {
            schema: SCHEMA.to_owned(),
            model: model.to_owned(),
            files,
            reading: Reading::of(options),
            skips: false,
            period: None,
            assume: Vec::new(),
            exclusive: Vec::new(),
            given: Vec::new(),
            beside: None,
            shows: Vec::new(),
        }
    }

    /// Writes the certificate as JSON.
    pub fn text(&self) -> String {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        text + "\n"
    }

    /// Asks everything again.
    ///
    /// # Errors
    ///
    /// Returns which answer is not so, or why there is none.
    pub fn verify(&self, explore: Explore) -> Result<Verified, Refused> {
        if self.schema != SCHEMA {
            return Err(("schema", format!("{} is not {SCHEMA}", self.schema)));
        }
        let Some(options) = self.reading.options() else {
            return Err(("reading", "a kind of leaf is unknown".to_owned()));
        };
        let mut from = |path: &str| {
            let text = self.files.get(path).map(|it| it.as_bytes().to_vec());
            text.ok_or_else(|| "it is not in the certificate".to_owned())
        };
        let loaded = read(&self.model, &mut from, &options);
        let mut tree = loaded.map_err(|it| ("files", it.to_string()))?.tree;
        if let Some(beside) = &self.beside {
            self.bind(&mut tree, beside, explore).map_err(|it| ("beside", it))?;
        }
        let assumptions = self.assume.iter().map(|it| parse_assumption(&tree, it));
        let assumptions =
            assumptions.collect::<Result<Vec<_>, _>>().map_err(|it| ("assume", it))?;
        let assumptions = Assumptions::new(assumptions).every(self.period);
        let exclusive = self
            .exclusive
            .iter()
            .map(|it| tree.find(it).ok_or_else(|| ("exclusive", format!("no node {it}"))));
        let exclusive = exclusive.collect::<Result<Vec<_>, _>>()?;
        let (skips, given) = (self.skips, self.given.clone());
        let wishes = Wishes { exclusive, given, skips, assumptions };
        let walked = |property: Option<&Property>| {
            walk(&tree, &wishes, property, MOST_STATES)
                .ok_or_else(|| ("files", format!("more than {MOST_STATES} states")))
        };
        let plain = walked(None)?;
        for text in &self.shows {
            let holds = if SHOWN.contains(&text.as_str()) {
                is_well(&tree, &plain, &wishes.exclusive, text)
            } else {
                let property = parse_property(&tree, text).map_err(|it| ("shows", it.1))?;
                walked(Some(&property))?.holds == Some(true)
            };
            if !holds {
                return Err(("shows", format!("{text} is not shown")));
            }
        }
        let (tree, nodes) = (tree.name.clone(), tree.nodes.len());
        Ok(Verified { tree, nodes, states: plain.states, shows: self.shows.clone() })
    }

    /// Sets the supervisor beside the tree again.
    fn bind(&self, tree: &mut Tree, beside: &Beside, explore: Explore) -> Result<(), String> {
        let bindings = Bindings::read(&beside.bindings).map_err(|it| it.message)?;
        let net = explore(&beside.model, self.period, &bindings.never())?;
        bindings.bind(tree, net).map_err(|it| it.message)
    }
}

/// Reads a certificate and verifies it.
///
/// # Errors
///
/// Returns the place and the cause; `certificate` where it is none.
pub fn verify(text: &str, explore: Explore) -> Result<Verified, Refused> {
    let read: Result<Certificate, _> = serde_json::from_str(text);
    read.map_err(|it| ("certificate", it.to_string()))?.verify(explore)
}

/// Returns whether a question is answered well.
fn is_well(tree: &Tree, plain: &Plain, exclusive: &[usize], question: &str) -> bool {
    let says = |node: usize, answer: Answer| plain.said[node] >> answer as u8 & 1 == 1;
    let mut nodes = tree.nodes.iter().enumerate();
    let mut pairs = plain.both.keys().chain(plain.overlap.keys());
    let forbidden = |it: &(usize, usize)| exclusive.contains(&it.0) && exclusive.contains(&it.1);
    match question {
        "can-succeed" => plain.ends.contains_key(&End::Answered(Answer::Success)),
        "exception" => !plain.ends.keys().any(|it| matches!(it, End::Thrown(_))),
        "halt-exception" => !plain.halting_throws,
        "stuck" => plain.stuck == 0 || plain.ends.is_empty(),
        "never-ends" => !plain.forever,
        "restarted-forever" => plain.restarted.is_empty(),
        "read-before-written" => plain.early.is_empty(),
        "refused" => tree.bonds.is_some() && plain.refused.is_empty(),
        "spins" => !plain.spins,
        "success-lost" => plain.lost.is_empty(),
        "recovery" => nodes.all(|(_, it)| match (&it.kind, it.children.as_slice()) {
            (Kind::RecoveryNode { .. }, [_, recovery]) => says(*recovery, Answer::Success),
            _ => true,
        }),
        "never-ticked" => plain.said.iter().all(|it| *it != 0),
        "never-succeeds" => nodes.all(|(at, it)| {
            let leaf = matches!(it.kind, Kind::Leaf(_));
            !leaf || plain.said[at] == 0 || says(at, Answer::Success)
        }),
        "exclusive" => !pairs.any(forbidden),
        "running-together" => pairs.all(forbidden),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn certificate(shows: &[&str]) -> Certificate {
        let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
          <ReactiveSequence><C1/><A1/></ReactiveSequence></BehaviorTree></root>"#;
        let files = BTreeMap::from([("tree.xml".to_owned(), text.to_owned())]);
        let shows = shows.iter().map(|it| (*it).to_owned()).collect();
        let new = Certificate::new("tree.xml", files, &Options::default());
        Certificate { shows, ..new }
    }

    #[test]
    fn a_certificate_of_what_does_not_hold_is_refused() {
        let mut none = |_: &str, _: Option<u32>, _: &[&str]| Err("no supervisor".to_owned());
        let ends = ["never-ends", "restarted-forever", "AF done", "AG (A1.running -> AF done)"];
        let good = ["exception", "spins", "read-before-written", "AG !(A1.running & C1.failure)"];
        let good = certificate(&[&good[..], &ends].concat());
        let verified = verify(&good.text(), &mut none).unwrap();
        assert_eq!((verified.nodes, verified.states), (3, 2));
        let wrong = ["AG !A1.running", "EF (A1.success & C1.failure)", "AF A1.ticked", "luck"];
        for wrong in wrong.into_iter().chain(["refused", "AG (A1.running -> AF A1.success)"]) {
            assert!(certificate(&["exception", wrong]).verify(&mut none).is_err(), "{wrong}");
        }
        let forever = good
            .text()
            .replace("<A1/>", "<KeepRunningUntilFailure><A1/></KeepRunningUntilFailure>");
        for name in ends {
            let shows = vec![name.to_owned()];
            let it: Certificate = serde_json::from_str(&forever).unwrap();
            let refused = Certificate { shows, ..it }.verify(&mut none).is_err();
            assert_eq!(refused, name != "restarted-forever", "{name}");
        }
        let other = good.text().replace("<A1/>", "<AlwaysSuccess/>");
        assert_eq!(verify(&other, &mut none).unwrap_err().0, "shows");
        assert_eq!(verify("{}", &mut none).unwrap_err().0, "certificate");
        let beside = Beside { model: "{}".to_owned(), bindings: "A1 starts go".to_owned() };
        let it = Certificate { beside: Some(beside), ..good }.verify(&mut none);
        assert_eq!(it.unwrap_err(), ("beside", "no supervisor".to_owned()));
    }
}
