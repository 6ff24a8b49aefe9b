//! The answer of `cotama new`.

use schemars::JsonSchema;
use serde::Serialize;

/// The answer of `cotama new`.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct NewAnswer {
    #[schemars(extend("const" = "cotama/new/1"))]
    pub(crate) schema: &'static str,
    /// The files that were written.
    pub(crate) files: Vec<String>,
}
