//! A net as a file of another tool, or as a drawing; a system as a drawing.

pub mod dot;
pub mod drawing;
mod effect;
mod identifier;
pub mod jani;
pub mod json;
mod layout;
pub mod matrix;
pub mod mermaid;
pub mod overview;
pub mod scxml;
pub mod svg;
