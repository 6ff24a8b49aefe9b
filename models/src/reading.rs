//! Parts for files of other crates, so that they are read as missions are: every error of a file at
//! once, each with its place, the known name that is nearest, and the remedy.
//!
//! ```
//! use cotama_models::reading::{Fields, Sink, document, errors};
//!
//! fn lamp(mut fields: Fields<'_>) -> Option<(u64, [i64; 2])> {
//!     let power = fields.integer("power_mw", 1..=9_000);
//!     let at = fields.point("at_mm", &(0..=5_000));
//!     fields.finish();
//!     Some((power?, at?.value))
//! }
//! let read = |text: &str| {
//!     let sink = Sink::default();
//!     let lamp = document(text, &sink, "lamp/1", lamp).filter(|_| sink.is_empty());
//!     lamp.ok_or_else(|| errors("lamp.toml", text, sink).to_string())
//! };
//! assert_eq!(read("format = 'lamp/1'\npower_mw = 60\nat_mm = [1, 2]"), Ok((60, [1, 2])));
//! let said = read("format = 'lamp/1'\npowr_mw = 60\nat_mm = [1]").unwrap_err();
//! assert!(said.contains("lamp.toml:2:1: unknown key `powr_mw` in the file; did you mean"));
//! assert!(said.contains("lamp.toml:3:9: `at_mm` must be a point `[x, y]`, not 1 number"));
//! ```

use crate::missions::MissionErrors;

pub use crate::missions::reader::fields::{Fields, Reported, Sink, document};
pub use crate::missions::{Diagnostic, Position, Spanned};
pub use crate::names::{quoted, unknown};

/// Returns what a reader reported of a file, for people: sorted, many of one cause as one.
pub fn errors(source_name: &str, text: &str, sink: Sink) -> MissionErrors {
    MissionErrors::new(source_name, text, sink.into_diagnostics())
}
