//! The answer of `cotama new`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama new`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct NewAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/new/1")))]
    pub(crate) schema: &'static str,
    /// The files that were written.
    pub(crate) files: Vec<String>,
}
