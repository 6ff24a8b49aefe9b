//! Nets as files of other tools.
#![cfg_attr(kani, allow(clippy::pedantic))]

mod effect;
mod identifier;
pub mod jani;
pub mod json;
pub mod pnml;
pub mod scxml;
pub mod tina;

#[doc(inline)]
pub use cotama_drawing::{dot, mermaid};
