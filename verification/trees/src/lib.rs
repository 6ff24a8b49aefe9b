//! Behaviour trees as BehaviorTree.CPP 4 and Nav2 run them.
//!
//! ```text
//! XML       -> Tree      reader    includes, subtrees, ports, guards; errors with places
//! Tree      -> Machine   machine   ticked with given replies: every choice is a question
//! Machine   -> Accepted  conform   a recorded run is one of the tree, or departs in a row
//! Machine   -> Space     explore   all runs when the world answers as it likes, breadth first
//! Machine   -> Plain     plain     the same walked plainly, to compare and to verify certificates
//! System    -> Bonds     supervisor  a supervisor beside the tree, and which leaves act on it
//! Space     -> Facts     explore   how it ends, what is lost, what never ends, with shortest runs
//! ```
//!
//! ```
//! use cotama_trees::machine::{Machine, Reply, Stop};
//! use cotama_trees::{reader, tree::Answer};
//! let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
//!   <ReactiveFallback><GoalUpdated/><Spin/></ReactiveFallback>
//! </BehaviorTree></root>"#;
//! let loaded = reader::read_text(text).unwrap();
//! let mut machine = Machine::new(&loaded.tree);
//! // GoalUpdated answers FAILURE by itself when it begins: only Spin is asked.
//! let Stop::Asked(question) = machine.tick() else { panic!() };
//! assert_eq!(loaded.tree.nodes[question.node].label, "Spin");
//! let stop = machine.reply(Reply::Leaf(Answer::Success));
//! assert_eq!(stop, Stop::Answered(Answer::Success));
//! ```
//!
//! Semantics: BehaviorTree.CPP 4.10.0 and Nav2 of 2026.

#![allow(
    clippy::cast_precision_loss, // 53 bits and less
    clippy::cast_possible_wrap,  // numbers of nodes and children
    clippy::cast_sign_loss,      // clamped before
    clippy::unnecessary_wraps    // steps of nodes have one type
)]
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]

pub mod certificate;
pub mod conform;
pub mod diagnostic;
pub mod explore;
pub mod export;
pub mod findings;
pub mod kinds;
pub mod machine;
pub mod page;
pub mod picture;
pub mod plain;
pub mod reader;
pub mod replay;
pub mod script;
mod signature;
pub mod supervisor;
pub mod tree;
mod xml;
