//! Failure modes, effects and criticality analyses (FMECA) as data: from a file of rows, or from a
//! robot.
//!
//! [`Analysis::parse`] reads a `cotama-fmeca/1` file in TOML, [`Analysis::parse_csv`] a table with
//! a heading; both report every error at once, with its place. The rows of a
//! [robot](crate::robots::Robot) become one by `TryFrom`. What follows is the same for all of
//! them and cannot fail: [criticality](Analysis::criticality), [what is alike](Analysis::diagnose),
//! [cause-effect diagrams](Analysis::ribs), [comma-separated values](Analysis::to_csv).
//!
//! ```
//! use cotama_models::fmeca::Analysis;
//! let text = r#"
//! format = "cotama-fmeca/1"
//! title = "A gripper"
//! [[mode]]
//! id = "GRP1"
//! function = "hold an object"
//! component = "gripper"
//! failure = "loses its grip"
//! cause = "worn pads"
//! effect = "the object falls"
//! severity = "hard"
//! flags = ["force low"]
//! latency_ms = 300
//! mtbf_h = 500
//! "#;
//! let gripper = Analysis::parse("gripper.toml", text).unwrap();
//! let criticality = gripper.criticality(&gripper.modes()[0]);
//! assert_eq!((criticality.severity, criticality.occurrence, criticality.detection), (8, 7, 3));
//! assert_eq!(criticality.rpn(), 168);
//! assert_eq!(criticality.class().name(), "undesirable");
//! ```

mod analysis;
mod criticality;
mod csv;
mod diagnosis;
mod groups;
mod label;
mod own_robot;
mod priority;
mod reader;
mod rows;
mod set;

pub use analysis::{Analysis, Flag, MAX_FLAGS, MAX_MODES, MAX_PROBES, Mode, Probe, Rib};
pub use criticality::{
    Criticality, CriticalityClass, OccurrenceClass, SeverityClass, measured_rank,
};
pub use csv::COLUMNS;
pub use diagnosis::{Diagnosability, MAX_PAIRS, Pair, Status};
pub use groups::{Groups, MAX_GROUPED};
pub use label::Label;
pub use own_robot::NoRate;
pub use priority::ActionPriority;
pub use reader::FORMAT;
pub(crate) use reader::thousandths;
pub use set::Set;
