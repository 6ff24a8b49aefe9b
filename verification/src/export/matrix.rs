//! The incidence matrix.
