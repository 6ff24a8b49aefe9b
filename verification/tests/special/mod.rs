//! Inhibitor arcs, read arcs, reset arcs and priorities: engines and the checker of certificates
//! against an explorer of these tests.

pub(crate) mod own;
mod random;
mod stories;
