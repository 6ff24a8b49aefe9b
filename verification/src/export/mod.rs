//! A net as a file of another tool, or as a drawing.

pub mod dot;
pub mod jani;
pub mod json;
pub mod matrix;
pub mod mermaid;
pub mod scxml;
pub mod svg;
