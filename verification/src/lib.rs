//! The model checker, and nets in and out: a face over a crate for each purpose.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`certificate`] | evidence for a verdict, and a small checker of it |
//! | [`check`] | a question, its answer, and the choice among engines |
//! | [`conform`] | whether a recorded run is a run of a model, and where it departs |
//! | [`coverability`] | infinitely many markings: boundedness, and what more tokens keep true |
//! | [`diagnosis`] | what a person sees of a verdict |
//! | [`drawing`] | a net or a system as a drawing |
//! | [`engines`] | the parts of an engine of one's own |
//! | [`explicit`] | the engine that passes through reachable markings one by one |
//! | [`flat`] | a system of nets as one net |
//! | [`formats`] | nets as files of other tools |
//! | [`guide`] | how to check a net of one's own, and ten counterexamples |
//! | [`limits`] | what a search may use, and why it ended before its end |
//! | [`play`] | any net or system in play, whatever its size |
//! | [`pnml`] | the exchange format of Petri nets, read and written |
//! | [`pt`] | a net without time and priorities, as engines read it |
//! | [`property`] | what is asked of a net |
//! | [`structural`] | the structure of a net: invariants, siphons, classes |
//! | [`temporal`] | formulas of CTL and LTL |
//! | [`tina`] | the exchange format of time Petri nets, read and written |
//! | [`tpn`] | time Petri nets and their state classes |
//!
//! All else that engines are made of is in `cotama_checker`.

#![cfg_attr(kani, allow(clippy::pedantic))]

pub mod conform;
#[cfg(kani)]
pub mod proofs;

#[doc(inline)]
pub use cotama_certificate as certificate;
#[doc(inline)]
pub use cotama_checker::{assert_holds, check, flat};
#[doc(inline)]
pub use cotama_diagnosis as diagnosis;
#[doc(inline)]
pub use cotama_drawing as drawing;
#[doc(inline)]
pub use cotama_formats::{self as formats, pnml, tina};
#[doc(inline)]
pub use cotama_play as play;
#[doc(inline)]
pub use cotama_property::{self as property, limits, pt};

/// Infinitely many markings: boundedness, and what more tokens keep true.
pub mod coverability {
    #[doc(inline)]
    pub use cotama_checker::coverability::{
        Bounded, CoverabilitySet, Coverable, FIRINGS, Growth, Limit, Limits, Sequence, Tokens,
        Unfinished, bounded, coverable, is_upward_closed, reaches,
    };
}

/// Tasks, budgets and findings: the parts of an engine of one's own, and [`ALL`](engines::ALL) that
/// are here.
pub mod engines {
    #[doc(inline)]
    pub use cotama_checker::engines::{
        ALL, Bid, Budget, Engine, Extent, Finding, Found, Known, Made, Reason, Task,
    };
}

/// Reachable markings one by one: their figures, their graph, and paths to them.
pub mod explicit {
    #[cfg(kani)]
    pub use cotama_checker::explicit::proofs;
    #[doc(inline)]
    pub use cotama_checker::explicit::{
        Goal, Graph, Growth, Limit, Limits, Progress, Reached, StateSpace, Unfinished, reach,
        statespace,
    };
}

/// The structure of a net, without its markings: invariants, siphons, classes.
pub mod structural {
    #[doc(inline)]
    pub use cotama_checker::structural::{
        Class, Commoner, Flow, Semiflows, Siphon, Siphons, class, commoner, minimal_siphons,
        place_invariants, place_semiflows, transition_invariants, transition_semiflows,
    };
}

/// Formulas of CTL and LTL.
pub mod temporal {
    #[doc(inline)]
    pub use cotama_checker::temporal::{
        CtlAnswer, Fairness, Reason, Rest, Run, Verdict, all_runs, answer, ctl, some_runs,
    };
}

/// Time Petri nets: their state classes, what they can reach, how long they take to respond.
pub mod tpn {
    #[doc(inline)]
    pub use cotama_checker::tpn::{
        ClassId, Classes, Converted, Date, Difference, Interval, Limit, Limits, NoSchedule,
        NotANet, Reach, Response, Schedule, Step, Time, TimeNet, TimeNetDefect, TimePlace,
        TimeTransition, Untimed, bound, bound_from_start, classes, deadlock, exported, from_net,
        reach, schedule, to_net, untimed,
    };
}

/// The page of the languages: its blocks of Rust compile and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/language.md")]
mod language {}

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
