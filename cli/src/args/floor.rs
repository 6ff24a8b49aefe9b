//! The command line of `cotama floor`.

use super::Json;
use super::number::whole;
use clap::Args;
use std::path::PathBuf;

pub(crate) const FLOOR_EXAMPLES: &str = "\
A floor is `office` or `clinic`, which come with the program, a drawing of yours (FILE.toml, `cotama
new floor` begins one), or a map of ROS (FILE.yaml with its image, read as Nav2 reads them). A place
is one of the drawing, or X,Y in mm from its left lower corner; of a map, in the coordinates of its
origin.

Exit codes: 0 there is a path, or none is asked for; 1 there is none; 2 bad input.

Examples:
  $ cotama floor office
  $ cotama floor office --from dock --to 'office B'
  $ cotama floor office --from dock --to 'office D'    # its door is closed: exit code 1
  $ cotama floor office --from dock --to 'office D' --open 'door D' --output path.svg
  $ cotama floor office --from 1500,10000 --to kitchen --radius 400 --json";

#[derive(Args, Debug)]
pub(crate) struct FloorArgs {
    /// The floor: `office`, `clinic`, a drawing (.toml) or a map of ROS (.yaml)
    pub(crate) floor: String,
    /// Plans a path that begins here
    #[arg(long, value_name = "PLACE", requires = "to")]
    pub(crate) from: Option<String>,
    /// Plans a path that ends here
    #[arg(long, value_name = "PLACE", requires = "from")]
    pub(crate) to: Option<String>,
    /// Radius of the disc in which the robot turns, in mm
    #[arg(long, value_name = "MM", default_value_t = 260)]
    #[arg(value_parser = whole(0, 10_000))]
    pub(crate) radius: u64,
    /// Opens a door; may be repeated
    #[arg(long, value_name = "DOOR")]
    pub(crate) open: Vec<String>,
    /// Closes a door; may be repeated
    #[arg(long, value_name = "DOOR")]
    pub(crate) close: Vec<String>,
    /// Draws the floor, with the path, into this file (.svg)
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}
