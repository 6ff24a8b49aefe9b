//! Structures learned from data: scores, searches, and what each search proves.

mod bootstrap;
mod chain;
mod constraints;
mod exact;
mod score;
mod search;
mod states;
mod subsets;
mod tail;

pub use bootstrap::{ArcCounts, bootstrap};
pub use chain::{Chain, chain};
pub use constraints::{Constraints, Wish};
pub use exact::{Exact, Limits, TooMuch, exact, memory, upper_bound};
pub use score::{Families, Score};
pub use search::{hill, k2};
