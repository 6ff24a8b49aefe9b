//! Networks and data with known answers; `data/README.md` says how each was found.

#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

mod common;
mod formats;
mod inference;
