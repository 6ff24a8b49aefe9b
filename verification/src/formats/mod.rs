//! Nets as files of other tools.

pub mod dot;
mod effect;
mod identifier;
pub mod jani;
pub mod json;
pub mod mermaid;
pub mod pnml;
pub mod scxml;
pub mod tina;
