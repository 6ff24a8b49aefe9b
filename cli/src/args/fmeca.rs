//! The command line of `cotama fmeca`.

use super::Json;
use super::number::whole;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(crate) const FMECA_EXAMPLES: &str = "\
Severities: weak, medium, hard, fatal; the first while the robot drives itself, the second while \
the operator drives.
Criticality: the risk priority number (RPN) is severity rank x occurrence rank x detection rank, \
each from 1 to 10; the class (intolerable, undesirable, tolerable, negligible) is the field of \
severity against occurrence; the Action Priority (AP: high, medium, low) is a table of the three \
ranks. The tables: docs/dependability.md.

Examples:
  $ cotama fmeca
  $ cotama fmeca --diagnosability
  $ cotama fmeca --measure delivery --seeds 1               # detected by signals, in the plane
  $ cotama fmeca --measure delivery --output measured.toml
  $ cotama fmeca --measured p3dx-delivery                   # RPN and AP by runs, beside the assumed
  $ cotama fmeca --measured p3dx-delivery --detections      # the runs again, as a table
  $ cotama fmeca --format csv | head -1
  $ cotama fmeca --output fmeca.html                        # the format by the name of the file
  $ cotama fmeca --function localise --output localise.svg
  $ cotama fmeca --json
  $ cotama new fmeca gripper && cotama fmeca gripper.toml   # your own
  $ cotama fmeca gripper.toml --diagnosability
  $ cotama fmeca transport                                  # the failures of a robot's file
  $ cotama fmeca gripper.toml --output gripper.csv && cotama fmeca gripper.csv";

#[derive(Args, Debug)]
pub(crate) struct FmecaArgs {
    /// An analysis of your own, in TOML or CSV, or a robot [default: that of the delivery robot]
    #[arg(value_name = "FILE")]
    pub(crate) file: Option<String>,
    /// Writes it in this format [default: by the end of the name of the output]
    #[arg(long, value_enum, conflicts_with_all = ["json", "diagnosability"])]
    pub(crate) format: Option<FmecaFormat>,
    /// The file to write, in place of standard output
    #[arg(long, short, value_name = "FILE", conflicts_with_all = ["json", "diagnosability"])]
    pub(crate) output: Option<PathBuf>,
    /// Diagram of this function alone, as `localise`
    #[arg(long, value_name = "NAME", conflicts_with_all = ["json", "diagnosability"])]
    pub(crate) function: Option<String>,
    /// Shows which failure modes cannot be told apart, and what would help
    #[arg(long)]
    pub(crate) diagnosability: bool,
    /// Measures how signals detect the failures of this mission's robot, in place of showing them;
    /// and, with --output FILE.toml, writes every run to a file for --measured
    #[arg(long, value_name = "MISSION", conflicts_with_all = ["file", "format", "function",
        "diagnosability", "measured"])]
    pub(crate) measure: Option<String>,
    /// Shows beside the assumed detection what runs have shown: a file of --measure, or the name of
    /// a robot that comes measured, `p3dx-delivery`
    #[arg(long, value_name = "FILE", conflicts_with = "diagnosability")]
    pub(crate) measured: Option<String>,
    /// Shows the runs of --measured as --measure does: how often, after how long, taken for what
    #[arg(long, requires = "measured", conflicts_with_all = ["format", "output", "function"])]
    pub(crate) detections: bool,
    /// The runs of each failure that are measured, one a seed
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = whole(1, 10_000))]
    pub(crate) seeds: u64,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// The format of a written analysis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FmecaFormat {
    /// The table, for Markdown (.md)
    Md,
    /// The table with all columns, comma-separated (.csv)
    Csv,
    /// A page with table, diagrams and diagnosability (.html)
    Html,
    /// The cause-effect diagrams (.svg)
    Svg,
    /// The rows of a robot's file (.toml)
    Toml,
}
