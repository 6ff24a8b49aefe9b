//! The command line of what is begun.

use super::Json;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(crate) const NEW_EXAMPLES: &str = "\
What is written:
  mission  NAME.toml, with every section explained; `plan` and `run` take it as it is; with \
--robot, a mission of that robot under its supervisors
  axes     NAME.toml, a mission with axes of its own, from whose constraints speeds follow; `plan` \
and `explain` take it as it is
  robot    NAME.toml, a robot with all that can fail on it, of which its supervisors are made; \
`check`, `statespace`, `simulate` and `export` take it as it is
  fmeca    NAME.toml, failure modes of a small robot with every key; `fmeca` takes it as it is
  team     NAME.toml, three robots in an office with every key; `run`, `assign` and `campaign` \
take it as it is
  floor    NAME.toml, two rooms with every key; `floor` takes it as it is
  net      the folder NAME: a crate with a supervisor, its laws, a program that plays it, tests of \
what it promises, and an example that writes it as JSON for `check` and `simulate`
  system   the same with two supervisors that work together
  board    the folder NAME-board: a crate that plays the supervisor of the crate NAME beside it \
on a microcontroller, in an emulator first

Examples:
  $ cotama new mission hall && cotama plan hall.toml && cotama run hall.toml
  $ cotama new axes tower && cotama plan tower.toml && cotama explain tower.toml A1
  $ cotama new robot cart && cotama check cart.toml
  $ cotama new mission round --robot cart.toml && cotama run round.toml
  $ cotama new mission tour --robot transport --floor office && cotama run tour.toml
  $ cotama new team crew && cotama run crew.toml
  $ cotama new fmeca arm && cotama fmeca arm.toml --diagnosability
  $ cotama new net gripper         # then: cd gripper && cargo test
  $ cotama new net hand && cotama new board hand
  $ cotama new system robot --json";

/// The kind of project to begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NewKind {
    /// A mission file
    Mission,
    /// A mission with performance axes of its own
    Axes,
    /// A robot with what can fail on it, of which its supervisors are made
    Robot,
    /// A file of failure modes, their effects and criticality
    Fmeca,
    /// A team of robots with tasks on a floor
    Team,
    /// A floor with walls, a door, places
    Floor,
    /// A crate with a supervisor
    Net,
    /// A crate with supervisors that work together
    System,
    /// A crate NAME-board that plays the crate NAME, made by `new net`, on a microcontroller
    Board,
}

#[derive(Args, Debug)]
pub(crate) struct NewArgs {
    /// Kind of project
    #[arg(value_enum)]
    pub(crate) kind: NewKind,
    /// Name of the project; or a path that ends with it, in a folder that exists
    pub(crate) name: String,
    /// The folder of this project's sources, on which a crate depends [default: `cotama` beside the
    /// crate, or the sources in which the crate stands]
    #[arg(long, value_name = "DIR")]
    pub(crate) sources: Option<PathBuf>,
    /// The robot of a mission, by name or as a file: its supervisors decide
    #[arg(long)]
    pub(crate) robot: Option<String>,
    /// The floor that a mission of a robot goes over: `office`, or a drawing
    #[arg(long)]
    pub(crate) floor: Option<String>,
    #[command(flatten)]
    pub(crate) json: Json,
}
