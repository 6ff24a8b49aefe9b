//! Evidence for a verdict, as a file that a sceptic can check again without the engine that found
//! it.
//!
//! A certificate holds a net, a question, the verdict and the evidence. [`verify`](verify()) reads
//! it and believes nothing: its checker is small, has a net and a firing rule of its own, and
//! shares only the data types of this page, and what questions mean, with the rest of the crate.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_verification::certificate::{Answer, Certificate, Evidence, Question, verify};
//! use cotama_verification::pt::Pt;
//!
//! let mut lamp = OwnedNet::new("lamp", "");
//! let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
//! let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
//! lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
//! let lamp = Pt::from(&lamp.view().net());
//!
//! let each_fires = Evidence::Each(vec![Evidence::trace(&lamp, &[])]);
//! let certificate = Certificate::of(&lamp, "all fire", Question::QuasiLive, true, each_fires);
//! let shown = verify(&certificate.text()).unwrap();
//! assert_eq!(
//!     shown.to_string(),
//!     "net lamp (2 places, 1 transition): quasi_live is true\n  \
//!      by 1 part, the first by a trace of 0 firings"
//! );
//! ```
//!
//! # Meaning
//!
//! Runs are maximal; after a deadlock the last marking lasts for ever. `EX` and `AX` speak of the
//! markings that follow, of which a deadlock has none: `EX` is false there, `AX` true. The global
//! questions stand for formulas:
//!
//! | question | formula |
//! | --- | --- |
//! | `bound` | `AG sum <= most`, and `EF sum >= most` |
//! | `live` | `AG EF fireable(t)` for each transition |
//! | `quasi_live` | `EF fireable(t)` for each transition |
//! | `stable` | `AG p = start(p)` for one of the places |
//! | `one_safe` | `AG` of `p <= 1` for each place |
//! | `unbounded` | `EF sum >= n` for each number `n` |
//!
//! Verdicts of LTL that are true have no certificate: no run is a counterexample, and to see that,
//! the checker would have to search the product of the markings with an automaton, as the engine
//! does. Those that are false have a [`Lasso`].
//!
//! Each kind of [`Evidence`] says what it shows, and why that is so.
#![cfg_attr(kani, allow(clippy::pedantic))]

mod about;
mod build;
mod display;
pub mod proof;
#[cfg(kani)]
pub mod proofs;
mod read;
mod structural;
mod sum;
mod verified;
pub mod verify;

pub use build::{Answer, Uncertifiable};
pub use read::most_markings;
pub use verified::{Verified, VerifyError};
/// ```
/// use cotama_verification::certificate::verify;
/// let door = r#"{"schema":"cotama-certificate/1","net":{"name":"door",
///     "places":[["shut",1],["open",0]],
///     "transitions":[{"name":"turn","take":[["shut",1]],"give":[["open",1]]}]},
///     "property":"all fire","question":"quasi_live","verdict":true,
///     "evidence":{"each":[{"trace":{"fire":[],"then":"state"}}]}}"#;
/// assert!(verify(door).unwrap().verdict);
/// // Nobody has to be believed: what is not shown is refused.
/// assert!(verify(&door.replace("\"verdict\":true", "\"verdict\":false")).is_err());
/// ```
pub use verify::verify;

use serde::{Deserialize, Serialize};

/// The schema of the files.
pub const SCHEMA: &str = "cotama-certificate/1";

/// A verdict with its evidence.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::certificate::{Certificate, Evidence, Formula, Question, verify};
/// use cotama_verification::pt::Pt;
/// let net = philosophers(2).unwrap();
/// let pt = Pt::from(&net.view().net());
/// let left: Vec<u32> = ["left_first_1", "left_first_2"]
///     .map(|name| pt.transition(name).unwrap().0).into();
/// let stuck = Question::Formula(Formula::reached(Formula::Deadlock));
/// let certificate = Certificate::of(&pt, "stuck", stuck, true, Evidence::trace(&pt, &left));
/// assert!(verify(&certificate.text()).unwrap().verdict);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`SCHEMA`].
    pub schema: String,
    /// The net that is spoken of.
    pub net: Net,
    /// The name of the property. Nothing is shown about it: what is shown is the answer to the
    /// question.
    pub property: String,
    /// The question.
    pub question: Question,
    /// Truth of the claim.
    pub verdict: bool,
    /// Evidence for the verdict.
    pub evidence: Evidence,
}

/// A place/transition net. A read arc is a taking and a giving of the same weight.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Net {
    /// Name of the net.
    pub name: String,
    /// Places and their tokens at the start; names differ.
    pub places: Vec<(String, u32)>,
    /// Transitions; names differ.
    pub transitions: Vec<Transition>,
}

/// A transition: enabled when each place has the tokens that are taken, each inhibiting one fewer
/// than its weight, and no transition of a higher priority has both; firing takes, empties and then
/// gives. Who does not know one of these fields refuses the file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// Name of the transition.
    pub name: String,
    /// Places and weights that are taken; each place once, no weight zero.
    pub take: Vec<(String, u32)>,
    /// Places and weights that are given; each place once, no weight zero.
    pub give: Vec<(String, u32)>,
    /// Inhibiting places and the numbers of tokens from which on they inhibit; each place once, no
    /// weight zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inhibit: Vec<(String, u32)>,
    /// Places that are emptied, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reset: Vec<String>,
    /// The priority: only enabled transitions of the highest one can fire.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub priority: u32,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(priority: &u32) -> bool {
    *priority == 0
}

/// A question to the net.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Whether a formula holds at the start.
    Formula(Formula),
    /// Whether the most tokens that places ever hold together are just so many.
    Bound {
        /// The places; one that is named twice counts twice.
        places: Vec<String>,
        /// The most tokens.
        most: i64,
    },
    /// Whether there is no most of the tokens that places hold together.
    Unbounded {
        /// The places; one that is named twice counts twice.
        places: Vec<String>,
    },
    /// Whether every transition can fire again from every reachable marking.
    Live,
    /// Whether every transition can fire.
    QuasiLive,
    /// Whether some place always holds as many tokens as at the start.
    Stable,
    /// Whether no place ever holds more than one token.
    OneSafe,
}

/// A formula of CTL, or of LTL behind one `A` or `E`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Formula {
    /// A linear inequality.
    #[serde(rename = "at_most")]
    AtMost(Linear),
    /// One of these transitions is enabled.
    #[serde(rename = "fireable")]
    Fireable(Vec<String>),
    /// No transition is enabled.
    #[serde(rename = "deadlock")]
    Deadlock,
    /// The negation.
    #[serde(rename = "not")]
    Not(Box<Formula>),
    /// The conjunction: all parts hold.
    #[serde(rename = "and")]
    And(Vec<Formula>),
    /// The disjunction: some part holds.
    #[serde(rename = "or")]
    Or(Vec<Formula>),
    /// On some run.
    #[serde(rename = "E")]
    Exists(Box<Formula>),
    /// On every run.
    #[serde(rename = "A")]
    All(Box<Formula>),
    /// In some marking that follows; a deadlock has none.
    #[serde(rename = "EX")]
    ExistsNext(Box<Formula>),
    /// In every marking that follows; true of a deadlock.
    #[serde(rename = "AX")]
    AllNext(Box<Formula>),
    /// In the next marking of the run.
    #[serde(rename = "X")]
    Next(Box<Formula>),
    /// At some time.
    #[serde(rename = "F")]
    Finally(Box<Formula>),
    /// At all times.
    #[serde(rename = "G")]
    Globally(Box<Formula>),
    /// The first until the second, which comes.
    #[serde(rename = "U")]
    Until(Box<(Formula, Formula)>),
}

/// `constant + sum of weight * tokens <= 0`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Linear {
    /// Constant added to the weighted sum.
    pub constant: i64,
    /// Places, each once, and their weights.
    pub weights: Vec<(String, i64)>,
}

/// Why something holds, or does not hold, at a marking: the start of the net, or where a trace has
/// led.
///
/// `!` turns around what is to be shown, and `A` is read as `!E!`: evidence that `AG` is false is
/// evidence that `EF` of the opposite is true.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Evidence {
    /// There is none: the verdict is as good as the engine. [`verify`](verify()) refuses it.
    None,
    /// The formula is about this marking alone.
    State,
    /// All parts of an `and` hold, or no part of an `or`: evidence for each part, in order.
    Each(Vec<Evidence>),
    /// One part of an `or` holds, or one of an `and` does not.
    One(One),
    /// `EF`, `EU` or `EX` is true: the path there.
    Trace(Trace),
    /// `E` of something about runs is true: the run.
    Lasso(Lasso),
    /// A sum of tokens gets larger than any number: what makes it larger again and again.
    Growth(Growth),
    /// `EF` (or `EU`) is false: why the goal contradicts what holds of all reachable markings.
    Refutation(Refutation),
    /// Any formula of CTL: so many markings are reachable from here. The checker passes through
    /// them with its own firing rule: to see that a set of markings is left by no firing takes just
    /// as much, and a longer file.
    Graph(usize),
}

/// Evidence for one part of several.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct One {
    /// Which part, from 0.
    pub part: usize,
    /// Evidence for it.
    pub by: Box<Evidence>,
}

/// A path to a marking.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Transitions fired one after the other; for `EX` one. For `EU`, the first operand holds
    /// before each of them and speaks of one marking.
    pub fire: Vec<String>,
    /// Why the marking where they lead is the one looked for.
    pub then: Box<Evidence>,
}

/// A run that goes on for ever: a stem, and then a loop again and again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lasso {
    /// Transitions fired once.
    pub stem: Vec<String>,
    /// Transitions that lead back to the end of the stem; none when that is a deadlock, which
    /// lasts.
    #[serde(rename = "loop")]
    pub cycle: Vec<String>,
}

/// A sequence that can be repeated for ever, and each time adds tokens to the places asked for:
/// after one round every place has as many tokens as before, or more, so that the round can fire
/// again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Growth {
    /// Transitions fired once.
    pub stem: Vec<String>,
    /// Transitions fired again and again.
    pub pump: Vec<String>,
}

/// Why no reachable marking is a goal: facts about all reachable markings, and a tree of cases.
///
/// The goal is read with negations moved inward. A transition that is enabled is an `and` of
/// `weight - tokens <= 0` over the places that it takes from, in the order of the places; one that
/// is not, an `or` of `tokens - weight + 1 <= 0`. A deadlock is the `and` of the latter over all
/// transitions.
///
/// What is known are two lists, numbered from 0: inequalities, which start with the facts, and
/// `or`s. Assuming an `and` assumes each part in order. An inequality is put at the end of the
/// first list; an `or` with one part is that part; any other one is put at the end of the second
/// list. What a node assumes is known to its children as well. So for a deadlock, the facts are
/// followed by the transitions that take from one place, and the `or`s start with all others, both
/// in order.
///
/// Transitions that never fire break no fact. All of them are shown together, from the same facts:
/// these hold until one of them fires, so the first one that fires would do so in a marking where
/// they hold, and there it is not enabled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refutation {
    /// Transitions that never fire; for each of them a tree of cases that starts from the
    /// assumption that it is enabled.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dead: Vec<(String, Vec<Case>)>,
    /// The facts that hold of all markings reachable from here.
    pub facts: Vec<Fact>,
    /// The tree, each node before its children, which follow in order. The first node stands for
    /// the goal.
    pub cases: Vec<Case>,
}

/// Something that holds of all markings reachable from here.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fact {
    /// An inequality that holds here, and whose left side no transition raises.
    AtMost(Linear),
    /// Places of which one is marked here; each transition that takes from one of them gives to one
    /// of them, so that one is always marked. As an inequality: `1 - sum of tokens <= 0`.
    Trap(Vec<String>),
    /// A formula that holds here, and that every transition keeps. As what an `and` assumes.
    Inductive(Inductive),
}

/// A formula of inequalities that holds here, and that no transition makes false. Facts before it
/// may be used to show that.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inductive {
    /// The formula: `and`, `or` and `not` of inequalities.
    pub holds: Formula,
    /// For each transition that changes one of its sums, and may fire, a tree of cases. It starts
    /// from an `and`: the formula holds, the transition is enabled, and after it the formula does
    /// not hold.
    pub kept: Vec<(String, Vec<Case>)>,
}

/// A node of the tree of cases.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Case {
    /// A leaf: these multiples of inequalities, by their numbers, add up to `constant + sum of
    /// weight * tokens <= 0` with a constant above 0 and no weight below 0. There are no such
    /// numbers of tokens.
    Contradiction(Vec<(usize, u64)>),
    /// A child for each part of this open `or`, in order.
    Split(usize),
    /// A child in which this inequality holds, and one in which its left side is at least 1.
    Cut(Linear),
}
