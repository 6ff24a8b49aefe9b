//! Nets as files of other tools.
#![cfg_attr(kani, allow(clippy::pedantic))]

mod condition;
mod effect;
mod identifier;
pub mod jani;
pub mod json;
pub mod pnml;
pub mod scxml;
pub mod tina;

pub use condition::condition;
#[doc(inline)]
pub use cotama_drawing::{dot, mermaid};
