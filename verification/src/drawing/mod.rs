//! A net or a system as a drawing.

pub mod figure;
mod layout;
pub mod matrix;
pub mod overview;
pub mod svg;
