//! Nets in and out.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`export`] | a net as a file of another tool, or as a drawing |
//! | [`flat`] | a system of nets as one net |
//! | [`pnml`] | the exchange format of Petri nets, read and written |
//! | [`pt`] | a net without time and priorities, as engines read it |
//! | [`property`] | what is asked of a net |

pub mod export;
pub mod flat;
pub mod pnml;
pub mod property;
pub mod pt;
