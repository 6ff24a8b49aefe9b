//! Nets in and out.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`export`] | a net as a file of another tool, or as a drawing |
//! | [`pnml`] | the exchange format of Petri nets, read and written |

pub mod export;
pub mod pnml;
