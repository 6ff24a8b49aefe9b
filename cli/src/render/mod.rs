//! What people see.

pub(crate) mod allocate;
pub(crate) mod numbers;
pub(crate) mod plan;
pub(crate) mod reason;
pub(crate) mod run;
pub(crate) mod snippet;
pub(crate) mod sparkline;
pub(crate) mod style;
pub(crate) mod table;
