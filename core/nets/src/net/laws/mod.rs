//! The laws of a small net, checked while compiling: of everything that a
//! [`Player`](super::Player) can do. One that does not hold is a compile error that names the
//! culprit and the shortest path there.

mod can;
mod cuts;
mod graph;
mod judge;
mod missing;
mod moves;
mod settling;
#[cfg(all(test, feature = "alloc"))]
mod tests;
mod timed;
mod way;
mod words;
mod zone;

pub use graph::{Graph, Limit, MARKINGS};
pub use judge::{Culprit, Violation};
pub use way::{Step, Way};
pub use zone::CLOCKS;

use super::data::Net;
use crate::player::code::Code;

/// The knowledge of a net at compile time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// All its laws hold: so many markings, and edges between them, were explored.
    Explored {
        /// Markings that a player reaches, also in passing while it settles.
        markings: usize,
        /// From how many of them which transitions fire or shared places change.
        firings: usize,
        /// The most transitions that fire at once by themselves one after another.
        settle: u32,
    },
    /// The net leaves its laws to the checker; it was not explored.
    LeftToChecker,
}

impl Known {
    /// The most transitions that fire at once one after another: proven, or a limit.
    pub const fn settle(self) -> u32 {
        match self {
            Self::Explored { settle, .. } => settle,
            Self::LeftToChecker => 1_000,
        }
    }

    /// Whether the bounds of the places are proven.
    pub const fn bounded(self) -> bool {
        matches!(self, Self::Explored { .. })
    }
}

/// Checks bounds, settling and the laws of a net. Ends the compilation with an explanation when one
/// does not hold, or when the net is too large and does not say that it is left to the checker.
#[must_use]
#[track_caller]
pub const fn check<const W: usize>(
    net: &Net<'_>,
    code: &Code<'_, W>,
    left_to_checker: bool,
) -> Known {
    if left_to_checker {
        return Known::LeftToChecker;
    }
    match judge(net, code) {
        Ok(known) => known,
        Err(violation) => violation.text(net, code).stop(),
    }
}

/// Explores a net and checks its bounds, that it settles, and its laws; usable at run time as well.
///
/// `code` is the same net, packed.
///
/// # Errors
/// The first of them that does not hold, with a shortest path there; or that the net is too large.
pub const fn judge<'n, const W: usize>(
    net: &Net<'n>,
    code: &Code<'_, W>,
) -> Result<Known, Violation<'n, W>> {
    let graph = Graph::of(net, code);
    let settle = match graph.settles(net, code) {
        Ok(settle) => settle,
        Err(violation) => return Err(violation),
    };
    let mut at = 0;
    while at < net.laws.len() {
        if let Some(violation) = graph.breaks(net, code, &net.laws[at]) {
            return Err(violation);
        }
        at += 1;
    }
    let (markings, firings) = graph.sizes();
    Ok(Known::Explored { markings, firings, settle })
}
