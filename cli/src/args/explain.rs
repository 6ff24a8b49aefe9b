//! The command line of `cotama explain`.

use super::number::whole;
use super::{Json, STEPS};
use clap::Args;

pub(crate) const EXPLAIN_EXAMPLES: &str = "\
Examples:
  $ cotama explain patrol-axes
  $ cotama explain patrol-axes A9
  $ cotama explain patrol-axes A1 --candidate \"M3 L2\" --json
  $ cotama explain service
  $ cotama explain service serve";

#[derive(Args, Debug)]
pub(crate) struct ExplainArgs {
    /// The name of a mission with axes, or of a team, that comes with the program, or the path of
    /// its file
    pub(crate) mission: String,
    /// The activity, as `A9`, or the task of a team [default: a table of all]
    pub(crate) activity: Option<String>,
    /// One combination of options alone, as `M5 L2`
    #[arg(long, value_name = "OPTIONS", requires = "activity")]
    pub(crate) candidate: Option<String>,
    /// The most steps of the work
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    #[arg(value_parser = whole(1, u64::MAX))]
    pub(crate) steps: u64,
    #[command(flatten)]
    pub(crate) json: Json,
}
