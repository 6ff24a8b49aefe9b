//! The command line of `cotama risk`.

use super::Json;
use super::number::whole;
use clap::{Args, Subcommand, ValueEnum};
use cotama_indicators::{MAX_PEOPLE, MAX_S};
use std::path::PathBuf;

pub(crate) const RISK_EXAMPLES: &str = "\
A network is `two-ways`, `asia` or `cancer`, which come with the program, or a file in BIF or \
XMLBIF; data is CSV with a header.

Examples:
  $ cotama risk sample asia --rows 2000 > runs.csv && cotama risk learn runs.csv
  $ cotama risk infer asia --query lung --evidence xray=yes
  $ cotama risk choose two-ways --measure 0.75 --known ratio=r3_1";

/// What is done with networks and data.
#[derive(Debug, Subcommand)]
pub(crate) enum RiskCommand {
    /// Learns a network from data, and says what is proven of it
    ///
    /// Exact search proves that no graph scores higher; it states its memory before it begins, and
    /// beyond the limits the best graph of hill climbing is the answer, with a bound. Arrows are no
    /// causes: graphs of a class are equally likely, and only the arrows that all of them have are
    /// called compelled.
    #[command(after_long_help = "\
Exit codes: 0 a network was learned; 2 bad input; 3 the limit of exact search was reached.

Examples:
  $ cotama risk sample asia --rows 2000 > runs.csv
  $ cotama risk learn runs.csv
  $ cotama risk learn runs.csv --score bdeu --ess 1 --tier asia,smoke --tier tub,lung,bronc
  $ cotama risk learn runs.csv --method k2 --order asia,smoke,tub,lung,bronc,either,xray,dysp
  $ cotama risk learn runs.csv --bootstrap 50
  $ cotama risk learn runs.csv --out asia.bif --json")]
    Learn(LearnArgs),
    /// Answers how likely the states of a variable are, given states of others
    #[command(after_long_help = "\
Examples:
  $ cotama risk infer asia --query dysp
  $ cotama risk infer asia --query lung --evidence dysp=yes --evidence xray=yes --json")]
    Infer(InferArgs),
    /// Says how strongly each two variables hang together
    ///
    /// The coherence is their mutual information over their joint entropy: 0 if and only if they
    /// are independent, 1 if and only if each fixes the other.
    #[command(after_long_help = "\
Examples:
  $ cotama risk coherence two-ways
  $ cotama risk coherence asia --svg asia.svg
  $ cotama risk observe plaza --seconds 60 > plaza.csv && cotama risk coherence plaza.csv
  $ cotama risk coherence asia --dot asia.dot --json")]
    Coherence(CoherenceArgs),
    /// Makes steps of measurements, so that a network can be learned of them
    ///
    /// Columns of numbers are cut, other columns stay as they are. Prints the new data as CSV.
    #[command(after_long_help = "\
Examples:
  $ printf 'l,way\\n1,a\\n2,a\\n3,b\\n9,b\\n' > runs.csv
  $ cotama risk discretise runs.csv --bins 3
  $ cotama risk discretise runs.csv --rule mdl --class way
  $ cotama risk discretise runs.csv --bins 2 --rule frequency --out steps.csv --json")]
    Discretise(DiscretiseArgs),
    /// Says whether one variable can tell anything of another, given states of others
    #[command(after_long_help = "\
Exit codes: 0 they are separated; 1 there is an open path, which is shown; 2 bad input.

Examples:
  $ cotama risk separated asia --x asia --y smoke
  $ cotama risk separated asia --x asia --y smoke --given xray   # exit code 1")]
    Separated(SeparatedArgs),
    /// Chooses a way whose trials may fail, by the mean or a quantile of its cost
    ///
    /// A model names the parts of a network: the way that the robot sets, what it only believes,
    /// the end of a trial and its cost.
    #[command(after_long_help = "\
Examples:
  $ cotama risk choose two-ways
  $ cotama risk choose two-ways --measure 0.75 --known ratio=r3_1
  $ cotama risk choose two-ways --measure 0.75 --known ratio=r3_1 --rule total
  $ cotama risk choose two-ways --failed short/low --failed short/low --json")]
    Choose(ChooseArgs),
    /// Learns from runs how much to hold back for the rest of a mission
    ///
    /// Of n runs the k-th smallest ratio of used over planned, k = ceil((n + 1) coverage), bounds
    /// that of the next run so often, if it is as exchangeable with them as they are with each
    /// other; nothing is assumed of how runs drift. With --against the margins of a file are held
    /// against further runs: how often they were missed, and whether that is still chance.
    ///
    /// The table has a row for each activity that a run came to, in their order: `mission`, `run`,
    /// `activity`, `planned_ms`, `used_ms`, `planned_mj`, `used_mj`, `done` (yes, or no where the
    /// run ended). A run that did not come to the end passed every bound.
    #[command(after_long_help = "\
Exit codes: 0 margins were learned, or hold; 1 the margins of --against no longer hold; 2 bad \
input; 3 too few runs for a bound.

Examples:
  $ cotama campaign patrol --rates drift --policy rigid --runs 2000 --seed 1 \
--require 'time<=999999999' --activities runs.csv
  $ cotama risk calibrate runs.csv --coverage 0.95 --out margins.toml
  $ cotama run patrol --margins margins.toml
  $ cotama risk calibrate runs.csv --against margins.toml")]
    Calibrate(CalibrateArgs),
    /// Prints a query in fixed point as Rust, for firmware without heap or floats
    ///
    /// The crate `cotama-inference` answers it for any states of the evidence, each time with a
    /// bound of the error. The order of elimination is fixed here.
    #[command(after_long_help = "\
Examples:
  $ cotama risk table asia --query lung --given dysp,xray > lung.rs
  $ cotama risk table two-ways --query status --given object_speed,way | head -1")]
    Table(FixedArgs),
    /// Draws rows from a network, as CSV
    #[command(after_long_help = "\
Examples:
  $ cotama risk sample asia --rows 3
  $ cotama risk sample two-ways --rows 2400 --seed 13 > runs.csv")]
    Sample(SampleArgs),
    /// Drives a robot over a floor among people, and prints its indicators as CSV, 2 a second
    ///
    /// The robot localises itself, maps what it sees, plans between the places of the floor and
    /// avoids people. The indicators are those of table 4.1 of the thesis: uncertainty of map and
    /// pose, information of the map; length, waypoints and angles of the path; speed and heading.
    #[command(after_long_help = "\
Examples:
  $ cotama risk observe sidewalk --seconds 20 | head -3
  $ cotama risk observe plaza --seconds 60 --people 24 > runs.csv
  $ cotama risk coherence runs.csv
  $ cotama risk discretise runs.csv --rule frequency --out steps.csv
  $ cotama risk learn steps.csv --out plaza.bif && cotama risk coherence plaza.bif")]
    Observe(ObserveArgs),
}

#[derive(Args, Debug)]
pub(crate) struct RiskArgs {
    #[command(subcommand)]
    pub(crate) command: RiskCommand,
}

/// A score of structures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ScoreName {
    /// Bayesian information criterion
    Bic,
    /// Bayesian Dirichlet equivalent uniform
    Bdeu,
}

/// A search for a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    /// Of all graphs the best, which is proven
    Exact,
    /// Changes of one arc, with restarts: a local optimum
    Hill,
    /// Parents along a given order
    K2,
    /// A random walk over graphs: the best one seen
    Mcmc,
}

#[derive(Args, Debug)]
pub(crate) struct CalibrateArgs {
    /// The path of a table of runs in CSV, as `--activities` of `run` and `campaign` writes it, or
    /// `-`
    pub(crate) runs: String,
    /// How often the rest of a mission is to stay within its bound, at least
    #[arg(long, value_name = "SHARE", default_value_t = 0.95, value_parser = coverage)]
    #[arg(conflicts_with = "against")]
    pub(crate) coverage: f64,
    /// Writes the margins, as TOML
    #[arg(long, value_name = "FILE.toml", conflicts_with = "against")]
    pub(crate) out: Option<PathBuf>,
    /// Holds the margins of this file against the runs
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) against: Option<String>,
    #[command(flatten)]
    pub(crate) json: Json,
}

fn coverage(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|it: &f64| (0.000_001..=0.999_999).contains(it));
    number.ok_or_else(|| "a share between 0 and 1, as 0.95, is needed".into())
}

#[derive(Args, Debug)]
pub(crate) struct LearnArgs {
    /// The path of data in CSV, or `-`
    pub(crate) data: String,
    /// Score of a structure
    #[arg(long, value_enum, value_name = "SCORE", default_value_t = ScoreName::Bic)]
    pub(crate) score: ScoreName,
    /// Equivalent sample size of the score `bdeu` [default: 10]
    #[arg(long, value_name = "A", value_parser = positive)]
    pub(crate) ess: Option<f64>,
    /// Search
    #[arg(long, value_enum, value_name = "METHOD", default_value_t = MethodName::Exact)]
    pub(crate) method: MethodName,
    /// Order of the variables for `k2`, with commas [default: that of the columns]
    #[arg(long, value_name = "A,B,..", value_delimiter = ',')]
    pub(crate) order: Vec<String>,
    /// The most parents of a variable [default: no bound; 3 for `k2`]
    #[arg(long, value_name = "N", value_parser = whole(0, 63))]
    pub(crate) max_parents: Option<u64>,
    /// An arc that the graph has, as FROM->TO; may be repeated
    #[arg(long, value_name = "ARC", value_parser = arc)]
    pub(crate) require: Vec<(String, String)>,
    /// An arc that the graph has not, as FROM->TO; may be repeated
    #[arg(long, value_name = "ARC", value_parser = arc)]
    pub(crate) forbid: Vec<(String, String)>,
    /// Variables of a tier, with commas: no arc points from a later tier to an earlier one
    #[arg(long, value_name = "A,B,..")]
    pub(crate) tier: Vec<String>,
    /// The seed of `hill`, `mcmc` and --bootstrap [default: 1]
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX))]
    pub(crate) seed: Option<u64>,
    /// Steps of `mcmc` [default: 2000]
    #[arg(long, value_name = "N", value_parser = whole(1, 10_000_000))]
    pub(crate) steps: Option<u64>,
    /// Restarts of `hill` [default: 10]
    #[arg(long, value_name = "N", value_parser = whole(0, 10_000))]
    pub(crate) restarts: Option<u64>,
    /// Learns graphs of so many resamples of the rows as well, and says how often arcs came back
    #[arg(long, value_name = "N", value_parser = whole(1, 10_000))]
    pub(crate) bootstrap: Option<u64>,
    /// The most variables of `exact`
    #[arg(long, value_name = "N", default_value_t = 22, value_parser = whole(1, 26))]
    pub(crate) limit_variables: u64,
    /// The most memory of `exact`
    #[arg(long, value_name = "MiB", default_value_t = 1_024, value_parser = whole(1, 1 << 20))]
    pub(crate) limit_memory: u64,
    /// Equivalent sample size of the prior of the probabilities
    #[arg(long, value_name = "A", default_value = "1", value_parser = positive)]
    pub(crate) prior: f64,
    /// Writes the network into this file (.bif, .dot)
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct InferArgs {
    /// The name of a network that comes with the program, the path of a BIF file, or `-`
    pub(crate) network: String,
    /// The variable that is asked for
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) query: String,
    /// A state that is known, as VARIABLE=STATE; may be repeated
    #[arg(long, value_name = "V=S", value_parser = equals)]
    pub(crate) evidence: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct CoherenceArgs {
    /// The name of a network that comes with the program, the path of a BIF file, of data in CSV
    /// (.csv), of which a network is learned first, or `-`
    pub(crate) network: String,
    /// Steps of equal frequency that columns of measurements are cut into, of data [default: 3]
    #[arg(long, value_name = "N", value_parser = whole(2, 256))]
    pub(crate) bins: Option<u64>,
    /// Draws all pairs into this file (.svg)
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Writes the graph with its strengths into this file (.dot)
    #[arg(long, value_name = "FILE")]
    pub(crate) dot: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// A rule by which measurements are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RuleName {
    /// Steps of equal width
    Width,
    /// Steps with equally many rows
    Frequency,
    /// Cuts that tell most of a class
    Mdl,
}

#[derive(Args, Debug)]
pub(crate) struct DiscretiseArgs {
    /// The path of data in CSV, or `-`
    pub(crate) data: String,
    /// Steps of each column [default: 3]
    #[arg(long, value_name = "N", value_parser = whole(2, 256))]
    pub(crate) bins: Option<u64>,
    /// Rule of the cuts
    #[arg(long, value_enum, value_name = "RULE", default_value_t = RuleName::Width)]
    pub(crate) rule: RuleName,
    /// Column of the class, for `mdl`
    #[arg(long, value_name = "COLUMN", required_if_eq("rule", "mdl"))]
    pub(crate) class: Option<String>,
    /// Writes the new data into this file, and not on the screen
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct SeparatedArgs {
    /// The name of a network that comes with the program, the path of a BIF file, or `-`
    pub(crate) network: String,
    /// One variable
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) x: String,
    /// The other variable
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) y: String,
    /// Variables whose states are known, with commas
    #[arg(long, value_name = "C,..", value_delimiter = ',')]
    pub(crate) given: Vec<String>,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// A rule by which later trials are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ChoiceRuleName {
    /// As the thesis prints it
    Thesis,
    /// With what a trial tells
    Exact,
    /// The measure of the total cost
    Total,
}

/// A rule by which failures change the belief.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MemoryName {
    /// Bayes
    Product,
    /// As the thesis prints it
    Sum,
}

#[derive(Args, Debug)]
pub(crate) struct ChooseArgs {
    /// The model `two-ways`, the path of a model in TOML, or `-`
    pub(crate) model: String,
    /// `mean`, or the level of a quantile between 0 and 1
    #[arg(long, value_name = "MEASURE", default_value = "mean", value_parser = measure)]
    pub(crate) measure: Level,
    /// Rule for later trials
    #[arg(long, value_enum, value_name = "RULE", default_value_t = ChoiceRuleName::Thesis)]
    pub(crate) rule: ChoiceRuleName,
    /// The state of the hidden variable, if it is known, as VARIABLE=STATE
    #[arg(long, value_name = "V=S", value_parser = equals)]
    pub(crate) known: Option<(String, String)>,
    /// A failed trial, as WAY/OBSERVATION; may be repeated
    #[arg(long, value_name = "TRIAL")]
    pub(crate) failed: Vec<String>,
    /// Rule by which failed trials change the belief
    #[arg(long, value_enum, value_name = "RULE", default_value_t = MemoryName::Product)]
    pub(crate) memory: MemoryName,
    #[command(flatten)]
    pub(crate) json: Json,
}

#[derive(Args, Debug)]
pub(crate) struct FixedArgs {
    /// The name of a network that comes with the program, the path of a BIF file, or `-`
    pub(crate) network: String,
    /// The variable that is asked for
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) query: String,
    /// Variables whose states will be known, with commas
    #[arg(long, value_name = "C,..", value_delimiter = ',')]
    pub(crate) given: Vec<String>,
}

#[derive(Args, Debug)]
pub(crate) struct SampleArgs {
    /// The name of a network that comes with the program, the path of a BIF file, or `-`
    pub(crate) network: String,
    /// How many rows
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = whole(1, 1_000_000))]
    pub(crate) rows: u64,
    /// The seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole(0, u64::MAX))]
    pub(crate) seed: u64,
}

#[derive(Args, Debug)]
pub(crate) struct ObserveArgs {
    /// The floor `sidewalk` or `plaza`, another one of the program, or a drawing in TOML
    pub(crate) floor: String,
    /// How long the robot drives, in seconds
    #[arg(long, value_name = "S", default_value_t = 600, value_parser = whole(1, MAX_S))]
    pub(crate) seconds: u64,
    /// How many people walk between the places
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = whole(0, MAX_PEOPLE as u64))]
    pub(crate) people: u64,
    /// The seed of people, noise and goals
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole(0, u64::MAX))]
    pub(crate) seed: u64,
}

/// A measure of a cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Level {
    Mean,
    Quantile(f64),
}

fn measure(text: &str) -> Result<Level, String> {
    if text == "mean" {
        return Ok(Level::Mean);
    }
    let level = text.parse().ok().filter(|it| *it > 0.0 && *it < 1.0);
    level.map(Level::Quantile).ok_or_else(|| "`mean` or a number between 0 and 1".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|it| *it > 0.0 && *it <= 1e9);
    number.ok_or_else(|| "a number above 0, at most 1000000000".to_owned())
}

fn equals(text: &str) -> Result<(String, String), String> {
    let parts = text.split_once('=').filter(|it| !it.0.is_empty() && !it.1.is_empty());
    let (one, two) = parts.ok_or_else(|| "VARIABLE=STATE is needed".to_owned())?;
    Ok((one.to_owned(), two.to_owned()))
}

fn arc(text: &str) -> Result<(String, String), String> {
    let parts = text.split_once("->").filter(|it| !it.0.is_empty() && !it.1.is_empty());
    let (from, to) = parts.ok_or_else(|| "FROM->TO is needed, in quotes".to_owned())?;
    Ok((from.trim().to_owned(), to.trim().to_owned()))
}
