//! The command line.

mod assign;
mod campaign;
mod check;
mod conform;
mod estimate;
mod explain;
mod fitted;
mod floor;
mod fmeca;
mod mission;
mod model;
mod new;
mod number;
mod recording;
mod risk;
mod schema;
mod team;
mod tree;
mod ways;

pub(crate) use assign::AssignArgs;
pub(crate) use campaign::{CampaignArgs, PolicyName};
pub(crate) use check::{BudgetArgs, CheckArgs, EngineName, Semantics, StatespaceArgs, VerifyArgs};
pub(crate) use conform::ConformArgs;
pub(crate) use estimate::{EstimateArgs, MOST_RUNS};
pub(crate) use explain::ExplainArgs;
pub(crate) use fitted::command;
pub(crate) use floor::FloorArgs;
pub(crate) use fmeca::{FmecaArgs, FmecaFormat};
pub(crate) use mission::{
    AllocateArgs, AllocatorName, Fidelity, Lost, Objective, OperatorName, PlanArgs, Planning,
    ReplayArgs, RunArgs, STEPS,
};
pub(crate) use model::{DrawnAs, ExportArgs, Format, ModelsArgs, PlayArgs, SimulateArgs};
pub(crate) use new::{NewArgs, NewKind};
pub(crate) use recording::RecordingArgs;
pub(crate) use risk::{
    CalibrateArgs, ChoiceRuleName, ChooseArgs, CoherenceArgs, DiscretiseArgs, FixedArgs, InferArgs,
    LearnArgs, Level, MemoryName, MethodName, ObserveArgs, RiskArgs, RiskCommand, RuleName,
    SampleArgs, ScoreName, SeparatedArgs,
};
pub(crate) use schema::{SchemaArgs, SchemaName};
pub(crate) use team::{Compare, TeamArgs};
pub(crate) use tree::{Deny, LeafName, TreeArgs};
pub(crate) use ways::WaysArgs;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Supervisors and missions of robots: checked, planned within limits, run under faults, explained
#[derive(Debug, Parser)]
#[command(
    name = "cotama",
    version,
    after_help = AFTER,
    after_long_help = AFTER_LONG
)]
pub(crate) struct Cli {
    /// Whether to use colours
    #[arg(long, global = true, value_enum, default_value_t = Color::Auto, value_name = "WHEN")]
    #[arg(display_order = 900)]
    pub(crate) color: Color,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER: &str = "Start with `cotama run patrol`.";

const AFTER_LONG: &str = "\
Exit codes: 0 success; 1 infeasible, or the mission is not completed; 2 bad input; 3 not known, a \
limit was reached. With --json every answer is one object on standard output, an error too.

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

/// The command.
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
    /// one candidate for each activity, so that duration and energy stay within their limits. It is
    /// found by a complete search for the most quality, or for the least energy, or by the rule of
    /// PANORAMA, a method to plan what a robot uses (Lambert et al. 2024), as the mission says.
    ///
    /// A mission with axes of its own, a file of the format `cotama-axes/1`, has indicators with
    /// formulas and constraints on them: speeds follow from these, and the plan is the best for
    /// what the file asks.
    #[command(after_long_help = "\
Examples:
  $ cotama plan patrol
  $ cotama plan patrol --objective quality
  $ cotama plan patrol --lost laser:1 --json
  $ cotama plan patrol --energy-limit 4000000   # infeasible: says why, exit code 1")]
    Plan(PlanArgs),
    /// Says why candidates of a mission with axes are not faster, or why robots of a team bid so
    ///
    /// A speed is the highest at which all core constraints hold. For each candidate of an activity
    /// it is said which constraint binds, by which inducers, what each allows alone, and which
    /// single number, changed as little as can be, allows more. Without an activity it is a table
    /// of all.
    ///
    /// Of a team each bid for a task is taken apart, as it is at the start of a run: ways, times of
    /// drives and hands, what failures add; or which skills are missing. Then the best coalition,
    /// its pledge, the second best, and the cost without each of its robots.
    #[command(after_long_help = explain::EXPLAIN_EXAMPLES)]
    Explain(ExplainArgs),
    /// Plans a mission, runs it with its faults, plans again where needed, and writes a report
    ///
    /// The run is simulated and deterministic: the same mission, faults and seed give the same run.
    /// Margins (limit less used less planned) are watched; when one falls below zero, or planned
    /// hardware fails, the rest of the mission is planned anew: plan 0 is the first one, plan 1
    /// that of the first replan. A mission that names its robot is driven by supervisors (tables
    /// that react to events), who find, judge and answer each failure, and ask the operator. The
    /// scenarios `fleet` and `service`, and files of teams, are such robots that bid for tasks. The
    /// scenario `two-ways` is an experiment: a robot learns of two ways among moving discs how
    /// likely a trial fails, and policies choose by the mean or a quantile of the cost.
    #[command(after_long_help = "\
Examples:
  $ cotama run patrol
  $ cotama run delivery
  $ cotama run service
  $ cotama run fleet --robots 12 --tasks 40 --loss 10
  $ cotama run two-ways --policy mean --policy 0.75 --runs 2
  $ cotama run patrol --faults none --report quiet-patrol
  $ cotama run patrol --lost laser:1 --allocator exact --json
  $ cotama run patrol --trace patrol.jsonl && cotama replay patrol.jsonl
  $ cotama run delivery --fidelity plane --mcap delivery.mcap --csv delivery.csv")]
    Run(Box<RunArgs>),
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
  $ echo '{\"limits\": {\"duration_ms\": 9, \"energy_mj\": 9}, \"activities\": [[[3,5,8], \
[1,4,2]]]}' > small.json
  $ cotama allocate small.json --objective quality
  $ cotama allocate small.json --objective min-energy --json
  $ cotama allocate - --allocator panorama < small.json")]
    Allocate(AllocateArgs),
    /// Says which robots do which tasks, alone or together, at the least cost
    ///
    /// A task is done by one robot, or by several in the roles of one of its plans; a robot has one
    /// role at most. A cost is a whole number, `null` where a robot is not capable. A task with
    /// `skip_cost` null must be done; another one may be left undone at that cost. The answer comes
    /// with what proves it, or with the tasks and robots in conflict.
    #[command(after_long_help = assign::ASSIGN_EXAMPLES)]
    Assign(AssignArgs),
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
    /// Says how likely a random run of a model is as a property says
    ///
    /// Runs are drawn: in each marking every enabled transition is equally likely, and time plays
    /// no part. A run that shows a property or refutes it is a proof; a share of runs is none,
    /// whatever its interval. Where there are too many states for `cotama check`, runs may still
    /// find what is wrong.
    #[command(after_long_help = estimate::ESTIMATE_EXAMPLES)]
    Estimate(EstimateArgs),
    /// Checks a certificate again, without the engine that found it
    #[command(after_long_help = check::VERIFY_EXAMPLES)]
    Verify(VerifyArgs),
    /// Shows a floor, its places and doors, and plans a path over it
    ///
    /// A path keeps the robot's radius from everything that its map has, goes where there is more
    /// room if that is not much longer, and is given with the spans in which it crosses zones, as
    /// a mission has them.
    #[command(after_long_help = floor::FLOOR_EXAMPLES)]
    Floor(FloorArgs),
    /// Plays a net or a system, with a list of events or by hand
    ///
    /// Each event is offered in its turn: a transition that is enabled fires, then those that fire
    /// by themselves; or the event is ignored, and it is said why. Between events, time passes only
    /// as you say. A net with neither events nor time does nothing by itself: there, each
    /// transition is fired by its name. Nets of a system read their mail in rounds, which take
    /// place as soon as something waits.
    #[command(after_long_help = model::SIMULATE_EXAMPLES)]
    Simulate(SimulateArgs),
    /// Writes a page in which a net, a system or a robot's supervisors are played
    ///
    /// One file that needs no other and no server: in it is the player of this program, compiled to
    /// WebAssembly, so a run in the page is a run of `cotama simulate`. Drawings are live; what is
    /// refused says why; runs go back, into links and into files, and runs that `cotama check
    /// --json` found can be opened. Of a mission under supervisors, faults are moved along the
    /// time, and what comes of them follows at once.
    #[command(after_long_help = model::PLAY_EXAMPLES)]
    Play(PlayArgs),
    /// Says whether a recorded run is a run of a model, and where it departs
    ///
    /// What was recorded is told to the model again, at the same dates: a log of a real robot is
    /// held against its supervisors. At the first line that the model does not allow, it is said
    /// why, and what was allowed there.
    #[command(after_long_help = conform::CONFORM_EXAMPLES)]
    Conform(ConformArgs),
    /// Shows what can fail on the delivery robot, or on one of your own: how it is seen, what is
    /// done, how critical it is, and what looks alike
    ///
    /// The failure modes, effects and criticality analysis (FMECA) of the delivery robot, from the
    /// same typed data that its diagnosis and its decisions run on; or of a file in TOML or CSV.
    /// The diagrams are of causes and effects (Ishikawa), one a function. The delivery robot is
    /// that of COTAMA (contextual task management), a control architecture: Durand et al., TAROS
    /// 2010.
    #[command(after_long_help = fmeca::FMECA_EXAMPLES)]
    Fmeca(FmecaArgs),
    /// Runs a mission many times under drawn faults, and hands each failure back as a small file
    ///
    /// Plans of faults are drawn from the seed, run, and held against requirements. Of each failure
    /// the smallest plan that still fails is looked for, and those with one cause are put together.
    /// Neither the number of threads nor the split into shards changes a byte of the results.
    #[command(after_long_help = campaign::CAMPAIGN_EXAMPLES)]
    Campaign(CampaignArgs),
    /// Learns from runs what performance depends on, and chooses with a known risk
    ///
    /// Bayesian networks: learned from a table of runs, asked for probabilities, and used to choose
    /// a way whose trials may fail, by the mean or a quantile of its cost (Rohrmueller, TU Munich
    /// 2011, chapter 4).
    #[command(after_long_help = risk::RISK_EXAMPLES)]
    Risk(RiskArgs),
    /// Begins a mission, an FMECA, a supervisor, a system of supervisors or a board of your own
    ///
    /// What is written works as it is, and says what each part is for. Nothing is replaced.
    #[command(after_long_help = new::NEW_EXAMPLES)]
    New(NewArgs),
    /// Prints the file of a mission, a team or a robot that comes with the program
    #[command(after_long_help = "\
Examples:
  $ cotama show patrol
  $ cotama show patrol > mine.toml && cotama plan mine.toml
  $ cotama show patrol --axes > mine.toml   # limits as constraints on axes")]
    Show(ShowArgs),
    /// Prints the tables of a mission, or the decisional level of a robot, as Rust for firmware
    #[command(after_long_help = "\
Examples:
  $ cotama table patrol > patrol_tables.rs
  $ cotama table patrol | head -1
  $ cotama table transport --mission shift > level.rs   # supervisors, facts, names")]
    Table(TableArgs),
    /// Prints the JSON schema of a command's answer, or of a file that you write
    ///
    /// An editor that knows the schema of a mission completes its keys, explains them and marks
    /// what is wrong while you write: let the first line be `#:schema ./mission.schema.json`.
    #[command(after_long_help = "\
Examples:
  $ cotama schema plan
  $ cotama schema run > run.schema.json
  $ cotama schema mission > mission.schema.json
  $ cotama schema faults > faults.schema.json")]
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
#[derive(Args, Clone, Debug)]
pub(crate) struct MissionArg {
    /// The name of a mission that comes with the program, the path of a mission file, or `-`
    pub(crate) mission: String,
}

#[derive(Args, Debug)]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(crate) mission: MissionArg,
    /// Writes a mission in the format with axes: its limits become constraints on the sums of
    /// duration and energy, all else stays
    #[arg(long)]
    pub(crate) axes: bool,
}

#[derive(Args, Debug)]
pub(crate) struct TableArgs {
    /// The name of a mission or a robot that comes with the program, the path of its file, or `-`
    pub(crate) mission: String,
    /// Mission of a robot: its global supervisor has these objectives
    #[arg(long = "mission", value_name = "MISSION")]
    pub(crate) of: Option<String>,
}

/// One JSON object in place of words.
#[derive(Args, Clone, Debug)]
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
