//! The command line.

mod check;
mod conform;
mod fmeca;
mod model;
mod new;
mod schema;

pub(crate) use check::{BudgetArgs, CheckArgs, EngineName, Semantics, StatespaceArgs, VerifyArgs};
pub(crate) use conform::ConformArgs;
pub(crate) use fmeca::{FmecaArgs, FmecaFormat};
pub(crate) use model::{DrawnAs, ExportArgs, Format, ModelsArgs, SimulateArgs};
pub(crate) use new::{NewArgs, NewKind};
pub(crate) use schema::{SchemaArgs, SchemaName};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Robot missions: split into activities, planned within their limits, run under faults, explained.
#[derive(Debug, Parser)]
#[command(
    name = "cotama",
    version,
    max_term_width = 100,
    after_help = AFTER,
    after_long_help = AFTER_LONG
)]
pub(crate) struct Cli {
    /// Whether to use colours
    #[arg(long, global = true, value_enum, default_value_t = Color::Auto, value_name = "WHEN")]
    pub(crate) color: Color,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER: &str = "Start with `cotama run patrol`.";

const AFTER_LONG: &str = "\
Exit codes: 0 success; 1 infeasible, or the mission is not completed; 2 bad input; 3 not known, a
limit was reached. With --json every answer is one object on standard output.

Examples:
  $ cotama list
  $ cotama plan patrol
  $ cotama run patrol
  $ cotama simulate door Call EndOpen +5000";

/// Whether to use colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, unless `NO_COLOR` is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Lists what comes with the program
    #[command(after_long_help = "\
Examples:
  $ cotama list
  $ cotama list --json")]
    List(ListArgs),
    /// Splits a mission into activities and plans it, without running it
    ///
    /// Objectives are cut at the borders of zones into activities. Each activity has candidates:
    /// one option for each of its tasks, as far as the constraints of the zones allow. A plan takes
    /// one candidate for each activity, so that duration and energy stay within their limits.
    #[command(after_long_help = "\
Examples:
  $ cotama plan patrol
  $ cotama plan patrol --objective quality
  $ cotama plan patrol --lost laser:1 --json
  $ cotama plan patrol --energy-limit 4000000   # infeasible: says why, exit code 1")]
    Plan(PlanArgs),
    /// Plans a mission, runs it with its faults, plans again where needed, and writes a report
    ///
    /// The run is simulated and deterministic: the same mission, faults and seed give the same run.
    /// Margins (limit less used less planned) are watched; when one falls below zero, or planned
    /// hardware fails, the rest of the mission is planned anew. A mission with `[supervision]` is
    /// driven by its supervisors, who find, judge and answer each failure, and ask the operator.
    #[command(after_long_help = "\
Examples:
  $ cotama run patrol
  $ cotama run delivery
  $ cotama run patrol --faults none --report quiet-patrol
  $ cotama run patrol --lost laser:1 --allocator exact --json
  $ cotama run patrol --trace patrol.jsonl && cotama replay patrol.jsonl")]
    Run(RunArgs),
    /// Solves a bare allocation problem, without a mission
    ///
    /// One candidate is chosen for each activity, so that both sums are at most the limits. The
    /// instance is a JSON object, as below; each candidate is a list of its quality, its duration
    /// and its energy.
    #[command(after_long_help = "\
Instance:
  {\"limits\":{\"duration_ms\":D,\"energy_mj\":E},
   \"activities\":[[[quality,duration_ms,energy_mj],...],...]}

Examples:
  $ echo '{\"limits\":{\"duration_ms\":9,\"energy_mj\":9},\"activities\":[[[3,5,8],[1,4,2]]]}' > \
  small.json
  $ cotama allocate small.json --objective quality
  $ cotama allocate small.json --objective min-energy --json
  $ echo '{\"limits\":{\"duration_ms\":9,\"energy_mj\":9},\"activities\":[[[1,2,3]]]}' | cotama \
  allocate -")]
    Allocate(AllocateArgs),
    /// Runs a stored trace or fault scenario again and compares
    ///
    /// A trace holds everything that its run needs: it is run again and both are compared, record
    /// by record. A file of faults needs a mission; it is run twice, and both runs are compared.
    #[command(after_long_help = "\
Examples:
  $ cotama run patrol --trace patrol.jsonl
  $ cotama replay patrol.jsonl
  $ cotama replay patrol.jsonl --json")]
    Replay(ReplayArgs),
    /// Shows the models: nets and systems, and what is known of one
    ///
    /// A model is a net, a family of nets (`philosophers:5` is one of it) or a system of nets. Nets
    /// of this program have laws, which were checked in all reachable markings while it was
    /// compiled; what a file claims is only said. PNML files are read up to 256 MiB, JSON files up
    /// to 64 MiB.
    #[command(after_long_help = model::MODELS_EXAMPLES)]
    Models(ModelsArgs),
    /// Writes a model as a file of another tool, or as a drawing
    #[command(after_long_help = model::EXPORT_EXAMPLES)]
    Export(ExportArgs),
    /// Checks whether properties of a model hold, and shows why
    ///
    /// Every verdict is a proof: where a limit is reached before, the answer is that it is not
    /// known, and how much was looked at. Transitions with intervals of time fire within them;
    /// events can come at any time. A system is checked as one net that acts in rounds, or in every
    /// interleaving. A property that is false comes with a run that shows it.
    #[command(after_long_help = check::CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Counts what is reachable in a model: markings, firings, deadlocks, tokens
    ///
    /// Of a time net, state classes are counted: markings with the times at which transitions can
    /// fire.
    #[command(after_long_help = check::STATESPACE_EXAMPLES)]
    Statespace(StatespaceArgs),
    /// Checks a certificate again, without the engine that found it
    #[command(after_long_help = check::VERIFY_EXAMPLES)]
    Verify(VerifyArgs),
    /// Plays a net or a system, with a list of events or by hand
    ///
    /// Each event is offered in its turn: a transition that is enabled fires, then those that fire
    /// by themselves; or the event is ignored, and it is said why. Between events, time passes only
    /// as you say. A net with neither events nor time does nothing by itself: there, each
    /// transition is fired by its name. Nets of a system read their mail in rounds, which take
    /// place as soon as something waits.
    #[command(after_long_help = model::SIMULATE_EXAMPLES)]
    Simulate(SimulateArgs),
    /// Says whether a recorded run is a run of a model, and where it departs
    ///
    /// What was recorded is told to the model again, at the same dates: a log of a real robot is
    /// held against its supervisors. At the first line that the model does not allow, it is said
    /// why, and what was allowed there.
    #[command(after_long_help = conform::CONFORM_EXAMPLES)]
    Conform(ConformArgs),
    /// Shows what can fail on the delivery robot, how it is seen, what is done, and what looks
    /// alike
    ///
    /// The failure modes, effects and criticality analysis (FMECA) of COTAMA's delivery robot, from
    /// the same typed data that its diagnosis and its decisions run on. The diagrams are of causes
    /// and effects (Ishikawa), one a function.
    #[command(after_long_help = fmeca::FMECA_EXAMPLES)]
    Fmeca(FmecaArgs),
    /// Begins a mission, a supervisor or a system of supervisors of your own
    ///
    /// What is written works as it is, and says what each part is for. Nothing is replaced.
    #[command(after_long_help = new::NEW_EXAMPLES)]
    New(NewArgs),
    /// Prints the file of a mission that comes with the program
    #[command(after_long_help = "\
Examples:
  $ cotama show patrol
  $ cotama show patrol > mine.toml && cotama plan mine.toml")]
    Show(MissionArg),
    /// Prints the tables of a mission as Rust source, for firmware
    #[command(after_long_help = "\
Examples:
  $ cotama table patrol > patrol_tables.rs
  $ cotama table patrol | head -1")]
    Table(MissionArg),
    /// Prints the JSON schema of a command's answer
    #[command(after_long_help = "\
Examples:
  $ cotama schema plan
  $ cotama schema run > run.schema.json")]
    Schema(SchemaArgs),
    /// Prints a completion script for a shell
    #[command(after_long_help = "\
Examples:
  $ cotama completions bash > cotama.bash
  $ cotama completions zsh > _cotama")]
    Completions(CompletionsArgs),
    /// Prints the manual page of the program, or of a command
    #[command(after_long_help = "\
Examples:
  $ cotama man > cotama.1
  $ cotama man run > cotama-run.1")]
    Man(ManArgs),
}

/// A mission.
#[derive(Args, Debug)]
pub(crate) struct MissionArg {
    /// The name of a mission that comes with the program, the path of a mission file, or `-`
    pub(crate) mission: String,
}

/// One JSON object in place of words.
#[derive(Args, Debug)]
pub(crate) struct Json {
    /// Prints the answer as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args, Debug)]
pub(crate) struct ListArgs {
    #[command(flatten)]
    pub(crate) json: Json,
}

/// Who plans, and with what.
#[derive(Args, Debug)]
pub(crate) struct Planning {
    /// Who plans: the rule of PANORAMA, or a complete search [default: panorama for the objective
    /// paper, else exact]
    #[arg(long, value_enum, value_name = "WHO", hide_possible_values = false)]
    pub(crate) allocator: Option<AllocatorName>,
    /// The most steps of a complete search
    #[arg(long, value_name = "N", default_value_t = 50_000_000)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) steps: u64,
    /// Hardware lost from the start, as `laser:1`; all units of the kind when no number is given
    #[arg(long, value_name = "KIND[:UNITS]", value_parser = lost)]
    pub(crate) lost: Vec<Lost>,
    /// A duration limit in place of the mission's own, in ms
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) duration_limit: Option<u64>,
    /// An energy limit in place of the mission's own, in mJ
    #[arg(long, value_name = "MJ", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) energy_limit: Option<u64>,
    /// How closely the robot is modelled
    #[arg(long, value_enum, value_name = "HOW", default_value_t = Fidelity::Mission)]
    pub(crate) fidelity: Fidelity,
}

#[derive(Args, Debug)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) mission: MissionArg,
    /// What a plan is chosen for: the paper's rule, the most quality, the least energy, or all
    /// plans of which none is better in duration, energy and quality [default: paper; quality for a
    /// supervised mission]
    #[arg(long, value_name = "WHAT")]
    #[arg(value_parser = objectives(&["paper", "quality", "min-energy", "front"]))]
    pub(crate) objective: Option<Objective>,
    #[command(flatten)]
    pub(crate) planning: Planning,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) mission: MissionArg,
    /// What a plan is chosen for: the paper's rule, the most quality, or the least energy [default:
    /// paper; quality for a supervised mission]
    #[arg(long, value_name = "WHAT")]
    #[arg(value_parser = objectives(&["paper", "quality", "min-energy"]))]
    pub(crate) objective: Option<Objective>,
    #[command(flatten)]
    pub(crate) planning: Planning,
    /// The seed of all random numbers; under supervisors nothing is random yet
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// What goes wrong: nothing (`none`), what the mission file says (`script`), or a file of
    /// faults
    #[arg(long, value_name = "none|script|FILE", default_value = "script")]
    pub(crate) faults: String,
    /// How often margins are checked, in ms [default: as the mission file says]
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) monitor_period: Option<u64>,
    /// Also looks for better plans when the margins have grown
    #[arg(long)]
    pub(crate) upward: bool,
    /// The folder of the report, `index.html` [default: report/NAME]
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Writes no report
    #[arg(long, conflicts_with = "report")]
    pub(crate) no_report: bool,
    /// Writes the trace of the run, as JSON lines
    #[arg(long, value_name = "FILE.jsonl")]
    pub(crate) trace: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct AllocateArgs {
    /// The instance, a JSON file, or `-`
    pub(crate) instance: String,
    /// What the plan is chosen for: the most quality, or the least energy within both limits
    #[arg(long, value_name = "WHAT", default_value = "quality",
          value_parser = objectives(&["quality", "min-energy"]))]
    pub(crate) objective: Objective,
    /// Who plans: a complete search, or the rule of PANORAMA, which pursues no objective
    #[arg(long, value_enum, value_name = "WHO", default_value_t = AllocatorName::Exact)]
    pub(crate) allocator: AllocatorName,
    /// The most steps of a complete search
    #[arg(long, value_name = "N", default_value_t = 50_000_000)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) steps: u64,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct ReplayArgs {
    /// A trace, or a file of faults
    pub(crate) file: String,
    /// The mission of a file of faults: its name, or the path of its file
    #[arg(long)]
    pub(crate) mission: Option<String>,
    /// The seed for a file of faults
    #[arg(long, value_name = "N", requires = "mission")]
    pub(crate) seed: Option<u64>,
    /// Writes a report of the run made again, `index.html`, to this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Writes the trace of the run made again, as JSON lines
    #[arg(long, value_name = "FILE.jsonl")]
    pub(crate) trace: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Args, Debug)]
pub(crate) struct ManArgs {
    /// The command; the program as a whole when there is none
    pub(crate) command: Option<String>,
}

/// Who plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AllocatorName {
    /// A complete search; for the objective paper, only where the rule finds nothing
    Exact,
    /// The rule of PANORAMA: fast, can miss a plan, pursues no objective
    Panorama,
}

/// How closely the robot is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Fidelity {
    /// Travel, energy, drift and faults
    Mission,
}

/// What a plan is chosen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Objective {
    /// The rule of PANORAMA: the highest plan that meets the limits
    Paper,
    /// The most quality
    Quality,
    /// The least energy
    MinEnergy,
    /// All plans of which none is better in duration, energy and quality
    Front,
}

impl Objective {
    /// Its name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Quality => "quality",
            Self::MinEnergy => "min-energy",
            Self::Front => "front",
        }
    }
}

fn objectives(names: &'static [&'static str]) -> impl TypedValueParser<Value = Objective> {
    PossibleValuesParser::new(names).try_map(|name| Objective::from_str(&name, false))
}

/// Hardware lost from the start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Lost {
    /// The kind, not yet looked up.
    pub(crate) kind: String,
    /// The units; all if none.
    pub(crate) units: Option<u8>,
}

fn lost(text: &str) -> Result<Lost, String> {
    let (kind, units) = match text.rsplit_once(':') {
        None => (text, None),
        Some((kind, units)) => match units.parse() {
            Ok(units @ 1..) => (kind, Some(units)),
            _ => return Err(format!("`{units}` is not a number of units from 1 to 255")),
        },
    };
    if kind.is_empty() {
        return Err("a kind of hardware is missing before the colon".into());
    }
    Ok(Lost { kind: kind.into(), units })
}
