//! The model checker, and nets in and out.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`bounds`] | bounds of places that the structure of a net proves |
//! | [`certificate`] | evidence for a verdict, and a small checker of it |
//! | [`check`] | a question, its answer, and the choice among engines |
//! | [`conform`] | whether a recorded run is a run of a model, and where it departs |
//! | [`coverability`] | infinitely many markings: boundedness, and what more tokens keep true |
//! | [`diagnosis`] | what a person sees of a verdict |
//! | [`drawing`] | a net or a system as a drawing |
//! | [`engines`] | what engines have in common, and all of them |
//! | [`explicit`] | the engine that passes through reachable markings one by one |
//! | [`flat`] | a system of nets as one net |
//! | [`formats`] | nets as files of other tools |
//! | [`guide`] | how to check a net of one's own, and ten counterexamples |
//! | [`limits`] | what a search may use, and why it ended before its end |
//! | [`play`] | any net or system in play, whatever its size |
//! | [`pnml`] | the exchange format of Petri nets, read and written |
//! | [`pt`] | a net without time and priorities, as engines read it |
//! | [`property`] | what is asked of a net |
//! | [`reductions`] | smaller nets with the same answer |
//! | [`structural`] | the engine that looks at the structure of a net and visits no marking |
//! | [`stubborn`] | the engine that fires only some transitions in each marking |
//! | [`temporal`] | formulas of CTL and LTL |
//! | [`tina`] | the exchange format of time Petri nets, read and written |
//! | [`tpn`] | time Petri nets and their state classes |

#![cfg_attr(kani, allow(clippy::pedantic))]

pub mod certificate;
pub mod check;
pub mod conform;
pub mod diagnosis;
pub mod drawing;
pub mod engines;
pub mod flat;
pub mod formats;
mod integer;
pub mod limits;
pub mod play;
#[cfg(kani)]
pub mod proofs;
pub mod property;
pub mod pt;
mod source;

pub(crate) use engines::components;
#[doc(inline)]
pub use engines::{
    bounds, coverability, explicit, reductions, structural, stubborn, temporal, tpn,
};
#[doc(inline)]
pub use formats::{pnml, tina};

#[doc = include_str!("guide.md")]
#[doc = "## Two trains\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/trains.txt")]
#[doc = "```\n"]
#[doc = "## A crossing whose lights do not wait for each other\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/crossing.txt")]
#[doc = "```\n"]
#[doc = "## A charger that gets hot\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/charger.txt")]
#[doc = "```\n"]
#[doc = "## Philosophers\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/philosophers.txt")]
#[doc = "```\n"]
#[doc = "## A mailbox that is too small\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/mailbox.txt")]
#[doc = "```\n"]
#[doc = "## Two belts on one fuse\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/belts.txt")]
#[doc = "```\n"]
#[doc = "## A server that is unfair\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/server.txt")]
#[doc = "```\n"]
#[doc = "## A watchdog whose clock is started anew\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/watchdog.txt")]
#[doc = "```\n"]
#[doc = "## Nothing to be afraid of: true for no reason\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/alarm.txt")]
#[doc = "```\n"]
#[doc = "## What never happens\n\n```text"]
#[doc = include_str!("../tests/golden/diagnosis/unused.txt")]
#[doc = "```\n"]
pub mod guide {}
