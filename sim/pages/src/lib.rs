//! Pages that say what came of a mission, a team or a campaign; curves, and pictures of an FMECA.
//!
//! | module | page |
//! | --- | --- |
//! | [`campaign`] | outcomes, causes and coverage of many runs |
//! | [`causes`] | cause-effect diagrams of an FMECA |
//! | [`curves`] | work and messages of coalitions, by the number of robots |
//! | [`mission`] | a run: what was planned, what happened, what changed and why |
//! | [`team`] | a run of a team: who did what when |
//!
//! A page is made of a trace, or of results, alone and needs nothing else: no network, no fonts, no
//! scripts. It suits wide and narrow screens, light and dark ones, and paper; every drawing is
//! there twice, for wide and for narrow, so that its text can be read. Equal traces give equal
//! bytes.
#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // places on a page need no more than 52 bits

mod axis;
pub mod campaign;
pub mod causes;
mod chart;
pub mod curves;
mod format;
mod frame;
pub mod mission;
mod player;
mod svg;
pub mod team;

#[cfg(test)]
mod tests;
