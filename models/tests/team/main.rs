//! Teams as data: laws of capabilities and bids, and the reader of instances.
#![allow(missing_docs)]

mod laws;
