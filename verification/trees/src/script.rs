//! The scripting language of BehaviorTree.CPP 4: scripts of nodes, guards, what is run afterwards.

mod run;
mod syntax;
mod value;

pub use run::{Entries, ScriptError, evaluate, truth};
pub(crate) use run::{same, stored};
pub use syntax::{Assign, Expression, Script, SyntaxError, parse};
pub use value::Value;
pub(crate) use value::{as_integer, number_of};
