//! A net or a system as a drawing: SVG, and the languages of Graphviz and Mermaid; the frame and
//! the theme of pages.

pub mod dot;
pub mod elements;
pub mod figure;
mod layout;
pub mod matrix;
pub mod mermaid;
pub mod overview;
pub mod page;
pub mod svg;
