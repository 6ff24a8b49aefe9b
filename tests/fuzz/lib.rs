//! Mutated inputs for everything that reads: no input makes a reader panic, hang or take much
//! memory, and what is refused is refused with its place.
//!
//! A test names a [`Reader`], which is called with mutants of the texts in `tests/corpora`. The
//! mutants are numbered: the same number is the same mutant everywhere, so a failure says all that
//! is needed to see it again.

mod mutant;
mod random;
mod run;
mod split_mix;

pub use mutant::{MAX_BYTES, mutant};
pub use random::Random;
pub use run::{Figures, Reader};
pub use split_mix::split_mix;
