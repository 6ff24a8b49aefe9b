//! Teams as data: laws of capabilities and bids; instances from files, and their answers.
#![allow(missing_docs)]

#[cfg(feature = "std")]
mod answers;
#[cfg(feature = "std")]
mod broken;
#[cfg(feature = "std")]
mod choices;
mod laws;
