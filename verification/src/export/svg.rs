//! A drawing of a net.
