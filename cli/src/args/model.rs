//! The command line of the commands about models.

use super::Json;
use super::check::Semantics;
use super::tree::TreeArgs;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(crate) const MODELS_EXAMPLES: &str = "\
Examples:
  $ cotama models
  $ cotama models door
  $ cotama models philosophers:5 --json
  $ cotama export door --format pnml --output door.pnml && cotama models door.pnml";

pub(crate) const EXPORT_EXAMPLES: &str = "\
Examples:
  $ cotama export door --format mermaid
  $ cotama export door --output door.svg                 # the format by the name of the file
  $ cotama export door --style net --output door.dot
  $ cotama export philosophers:5 --format pnml | cotama export - --format matrix
  $ cotama export watchdog --output watchdog.scxml
  $ cotama export watchdog --output watchdog.net
  $ cotama export delivery --format pnml > rounds.pnml   # a system as one net
  $ cotama export delivery --semantics interleaving --format json > any_order.json
  $ cotama export patrol-axes --format mermaid           # causes and effects of a mission's axes";

pub(crate) const SIMULATE_EXAMPLES: &str = "\
Words:
  EVENT     offers the event now
  EVENT@MS  offers it at this time
  +MS       lets so much time pass
  A,B       with --rounds: offers both in one round; there, +MS is a round without events

Events of a system are NET.EVENT, as in `gs.mission_received`: those that no other net causes.

Of a behaviour tree, words are answers to its questions, in their order: S, F, R, K of leaves, \
T or N of gates and timers; LEAF=S says for whom one is meant.

In a file or on standard input: one of these a line; lines that begin with # are left out.
On a terminal, and with --interactive, a line can also be the number of an event, the beginning of \
its name, `back`, `marking`, `help` or `quit`.

Examples:
  $ cotama simulate door Call EndOpen +5000
  $ cotama simulate watchdog Release Done@50 Release@200 +100 --json
  $ cotama simulate philosophers:3 left_first_1 then_right_1 end_1
  $ printf 'Call\\nEndOpen@2000\\n+5000\\n' | cotama simulate door
  $ printf '1\\nback\\nquit\\n' | cotama simulate door --interactive
  $ cotama simulate delivery gs.mission_received ls.Planning_done
  $ cotama simulate door EndOpen --strict   # nothing opens: exit code 1";

/// Examples of `cotama play`.
pub(crate) const PLAY_EXAMPLES: &str = "\
Examples:
  $ cotama play door
  $ cotama play delivery --output delivery.html
  $ cotama play philosophers:5 --json
  $ cotama play fleet                                    # the protocol of its first robots
  $ cotama run delivery --trace run.jsonl && cotama play run.jsonl

A failure of a campaign is played as it was written: cotama play found/failures/001.toml";

/// A model.
#[derive(Args, Debug)]
pub(crate) struct ModelArg {
    /// The name of a model that comes with the program, the path of a PNML, JSON or TINA (.net)
    /// file, or `-`
    pub(crate) model: String,
}

#[derive(Args, Debug)]
pub(crate) struct ModelsArgs {
    /// The name of a model, or the path of a PNML, JSON or TINA (.net) file: all that is known
    /// of it
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    pub(crate) model: ModelArg,
    /// The format [default: by the end of the name of the output]
    #[arg(long, value_enum)]
    pub(crate) format: Option<Format>,
    /// Meaning of a system of nets, for all but its svg [default: rounds]
    #[arg(long, value_enum, value_name = "MEANING")]
    pub(crate) semantics: Option<Semantics>,
    /// One net of a system or of a robot, by its name there
    #[arg(long, value_name = "NAME", conflicts_with = "semantics")]
    pub(crate) net: Option<String>,
    /// How dot, svg and mermaid draw it [default: auto]
    #[arg(long, value_enum)]
    pub(crate) style: Option<DrawnAs>,
    /// The file to write, in place of standard output
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
}

#[derive(Args, Debug)]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    pub(crate) model: ModelArg,
    /// Events offered, in this order; without any, they are read from standard input
    #[arg(value_name = "EVENT")]
    pub(crate) events: Vec<String>,
    /// Plays rounds: each word is one. Of a net it is a synchronous step, of a system the turns of
    /// its nets, and then what is offered
    #[arg(long)]
    pub(crate) rounds: bool,
    /// Ends with exit code 1 when an event is ignored
    #[arg(long)]
    pub(crate) strict: bool,
    /// Writes what was played as a recorded run, for `cotama conform`
    #[arg(long, value_name = "FILE.jsonl", conflicts_with = "interactive")]
    pub(crate) trace: Option<PathBuf>,
    /// Asks what to do and shows it, step by step, even if no terminal is there
    #[arg(long, short, conflicts_with_all = ["events", "json", "strict"])]
    pub(crate) interactive: bool,
    #[command(flatten)]
    pub(crate) json: Json,
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
}

#[derive(Args, Debug)]
pub(crate) struct PlayArgs {
    /// A model, robot, mission or team: its name, or the path of its file; a file of faults, such
    /// as a campaign's failure; the trace of a mission under supervisors; or `-`
    pub(crate) model: String,
    /// The mission of a file of faults [default: the one that it names]
    #[arg(long, value_name = "MISSION")]
    pub(crate) mission: Option<String>,
    /// The page to write [default: MODEL.html in this folder]
    #[arg(long, short, value_name = "FILE.html")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// The format of a written model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A graph for Graphviz (.dot, .gv)
    Dot,
    /// A drawing; of a system: which net says what to which (.svg)
    Svg,
    /// The exchange format of Petri nets; nothing is lost (.pnml)
    Pnml,
    /// A diagram for Mermaid (.mmd)
    Mermaid,
    /// A state chart, of state machines (.scxml)
    Scxml,
    /// A model for probabilistic and other checkers (.jani)
    Jani,
    /// Incidence matrices as a table (.tsv)
    Matrix,
    /// A time net for TINA and others that read its format (.net)
    Net,
    /// All of it as JSON; nothing is lost (.json)
    Json,
    /// A behaviour tree as compact XML of BehaviorTree.CPP 4 (.xml)
    Btcpp,
}

/// How a net is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DrawnAs {
    /// Places as states and transitions as arrows, where the net is a state machine
    States,
    /// Places as circles and transitions as bars
    Net,
    /// As states where it can be
    Auto,
}
