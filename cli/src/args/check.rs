//! The command line of the commands that check.

use super::Json;
use super::number::whole;
use super::tree::{TreeArgs, TreeWishes};
use clap::{Args, ValueEnum};
#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;

pub(crate) const CHECK_EXAMPLES: &str = "\
Properties:
  AG !(a & b)              never both; a place is true when it is marked
  EF deadlock              some run comes to an end
  AG (fault -> AF safe)    every fault is followed by safety, on all runs
  A (G F a -> G F b)       linear time: one A in front, no quantifier inside
  bounds(a + b)            the most tokens that both ever hold together
  bound(t -> p)            time nets: the least and the most time from t to p
  AG (f -> AF<=200ms o)    time nets: at the latest after 200 ms
  AF a assuming weak(t)    not on runs that could fire t for ever and never do;
                           of LTL too, and of time nets
`AG a -> b` could be `AG (a -> b)` or `(AG a) -> b`: parentheses say which.
About one marking, behind a quantifier or with --initial:
  a, a <= 2, 2*a - b = 1   tokens of places
  fireable(t1, t2)         one of these transitions can fire
  deadlock                 nothing can fire
  true, false              always, never
By name:
  deadlock_free            AG !deadlock
  live, quasi_live         each transition can fire again and again; can fire
  one_safe, stable         no place holds two tokens; some place never changes

A file has one property a line, as `name: AG !(a & b)` or without a name; lines that begin with # \
are left out. A property file of the Model Checking Contest (XML) is read as well. Without \
properties, the laws of the model are checked, or the requirements of a robot's supervisors; where \
it has none, the usual three questions: is there no deadlock, is it 1-safe or else how many tokens \
are there, can each transition fire.

Engines: auto asks the cheapest first. structural looks at the net alone, stubborn and explicit \
pass through markings.

Systems: with --semantics rounds, the default, the place `round` is marked between two rounds, and \
`turn.outside` when it is the turn of what is outside. What happens in a round is shown, not the \
way of its token.

Teams: of a team at work (`service`, or a file as `cotama run` takes it) the protocol by which its \
robots give out its tasks is checked, with requirements S1 to S9 and L1 to L4: `r2.executing.t1` \
is its second robot in its first task. As many robots fail as its file has faults of robots. Where \
the net may have more than 100000 transitions, all is unknown.

Behaviour trees: of the XML of BehaviorTree.CPP 4 and Nav2 everything is asked that can go wrong, \
from a SUCCESS that is lost to a node that is never ticked; each finding has a run with the fewest \
ticks. Own properties speak of nodes after a tick: `AG !(Wait.running & BackUp.running)`, \
`EF root.success`, `AF done`. Findings that are errors end with exit code 1; --deny warnings \
ends so for warnings too. Timers go off when they like, unless --period says when ticks come.

Evidence: --certificate FILE writes what `cotama verify` checks again. Of several properties each \
has a file of its own, FILE-1.json, FILE-2.json and so on by its position; so for --trace.

Where quasi_live or live is false because transitions never fire, these are listed, and the places \
that are never marked; in --json as `unused`.

Exit codes: 0 all are true, or their bounds are known; 1 one is false; 3 none is false and one is \
not known; 2 bad input.

Examples:
  $ cotama check door
  $ cotama check door --property 'AG !(Closing & obstacle)'
  $ cotama check door --untimed --property deadlock_free
  $ cotama check philosophers:5 --property 'EF deadlock' --trace feast.html
  $ cotama check philosophers:3 --property deadlock_free --json   # it is not so: exit code 1
  $ cotama check kanban:2000 --property deadlock_free --certificate it.json; cotama verify it.json
  $ printf 'ends: EF deadlock\\nlive\\n' > two.txt
  $ cotama check kanban:2 --properties two.txt --mcc   # it has no deadlock: exit code 1
  $ cotama check kanban:2 --property 'P1 = 2' --initial
  $ cotama check watchdog --property 'bound(w1 -> Fault)'
  $ cotama check door --untimed --property 'AG (Opening -> AF Open) assuming weak(opened)'
  $ cotama check kanban:2 --junit kanban.xml --sarif kanban.sarif
  $ cotama check service
  $ cotama check delivery
  $ cotama check p3dx-patrol --mission patrol
  $ cotama check delivery_by_hand --property 'AG (round & gs.Safe -> ls.Idle)'";

pub(crate) const STATESPACE_EXAMPLES: &str = "\
What is counted of an incomplete search is shown as explored, and the exit code is 3. Of an \
unbounded net, it is shown which firings can be repeated to add tokens for ever.

Examples:
  $ cotama statespace door
  $ cotama statespace kanban:3 --json
  $ cotama statespace delivery
  $ cotama statespace door --untimed --mcc
  $ cotama export philosophers:4 --output four.pnml && cotama statespace four.pnml --jobs 2";

pub(crate) const VERIFY_EXAMPLES: &str = "\
A certificate that is refused does not show that its verdict is wrong; one that is accepted shows \
that it is right, whatever engine found it.

Exit codes: 0 it shows its verdict, 1 it does not, 2 it is no certificate.

Examples:
  $ cotama check philosophers:3 --property 'EF deadlock' --certificate deadlock.json
  $ cotama verify deadlock.json
  $ cotama verify - --json < deadlock.json
  $ sed s/left_first_1/then_right_1/ deadlock.json | cotama verify -   # another run: exit code 1";

/// The budget of a search.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct BudgetArgs {
    /// On how many threads
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = whole(1, 1024))]
    pub(crate) jobs: u64,
    /// The most markings, or state classes of a time net [default: no limit]
    #[arg(long, value_name = "N", value_parser = whole(1, u64::MAX))]
    pub(crate) max_states: Option<u64>,
    /// The most memory of a search, in MiB
    #[arg(long, value_name = "MiB", default_value_t = 4096)]
    #[arg(value_parser = whole(1, 1 << 40))]
    pub(crate) max_memory: u64,
    /// The most time of all work together, in seconds [default: no limit]
    #[arg(long, value_name = "s", value_parser = seconds)]
    pub(crate) max_seconds: Option<Duration>,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let wanted = text.parse().ok().and_then(|it| Duration::try_from_secs_f64(it).ok());
    wanted.ok_or_else(|| "a number of seconds is expected, as 60 or 0.5".to_owned())
}

#[allow(clippy::struct_excessive_bools)] // each is a flag of its own
#[derive(Args, Debug)]
pub(crate) struct CheckArgs {
    /// The name of a model that comes with the program, the path of a PNML, JSON or TINA (.net)
    /// file, or `-`; a robot or its mission, for its supervisors; a team at work, for its protocol;
    /// a behaviour tree of BehaviorTree.CPP 4 (.xml)
    pub(crate) model: String,
    /// Of a robot: its supervisors in this mission, whose objectives its global supervisor has
    #[arg(long, value_name = "MISSION")]
    pub(crate) mission: Option<String>,
    /// A property, or the name of a usual question; any number of them
    #[arg(long, value_name = "TEXT")]
    pub(crate) property: Vec<String>,
    /// A file of properties: one a line, or of the Model Checking Contest
    #[arg(long, value_name = "FILE")]
    pub(crate) properties: Option<String>,
    /// Asks properties without a quantifier of the marking at the start
    #[arg(long)]
    pub(crate) initial: bool,
    /// Which engine looks for the answer. What speaks of runs, and nets with time, have one engine,
    /// which each choice asks
    #[arg(long, value_enum, value_name = "ENGINE", default_value_t = EngineName::Auto)]
    pub(crate) engine: EngineName,
    /// Leaves the intervals of transitions out: they fire in any order, at any time
    #[arg(long)]
    pub(crate) untimed: bool,
    /// Meaning of a system of nets [default: rounds]
    #[arg(long, value_enum, value_name = "MEANING")]
    pub(crate) semantics: Option<Semantics>,
    #[command(flatten)]
    pub(crate) budget: BudgetArgs,
    /// Writes evidence for the verdict that `cotama verify` checks again
    #[arg(long, value_name = "FILE")]
    pub(crate) certificate: Option<PathBuf>,
    /// Writes the run that shows the verdict: as a page (.html), a drawing (.svg) or JSON (.json)
    #[arg(long, value_name = "FILE")]
    pub(crate) trace: Option<PathBuf>,
    /// Checks again whenever the file of the model or of the properties changes
    #[arg(long, conflicts_with_all = ["json", "mcc"])]
    pub(crate) watch: bool,
    /// Writes the verdicts as test cases (JUnit XML), which most build servers show
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    /// Writes the verdicts as findings (SARIF 2.1.0), which editors and forges show
    #[arg(long, value_name = "FILE")]
    pub(crate) sarif: Option<PathBuf>,
    /// Prints the lines of the Model Checking Contest
    #[arg(long, conflicts_with = "json")]
    pub(crate) mcc: bool,
    #[command(flatten)]
    pub(crate) json: Json,
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
    #[command(flatten)]
    pub(crate) wishes: TreeWishes,
}

#[derive(Args, Debug)]
pub(crate) struct StatespaceArgs {
    /// The name of a model that comes with the program, the path of a PNML, JSON or TINA (.net)
    /// file, or `-`
    pub(crate) model: String,
    /// Leaves the intervals of transitions out: they fire in any order, at any time
    #[arg(long)]
    pub(crate) untimed: bool,
    /// Meaning of a system of nets [default: rounds]
    #[arg(long, value_enum, value_name = "MEANING")]
    pub(crate) semantics: Option<Semantics>,
    #[command(flatten)]
    pub(crate) budget: BudgetArgs,
    /// Prints the lines of the Model Checking Contest
    #[arg(long, conflicts_with = "json")]
    pub(crate) mcc: bool,
    #[command(flatten)]
    pub(crate) json: Json,
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
}

#[derive(Args, Debug)]
pub(crate) struct VerifyArgs {
    /// The certificate, a JSON file, or `-`
    pub(crate) certificate: String,
    /// Also that it is about this model, by its name or its file, without its time
    #[arg(long, value_name = "MODEL", requires = "property")]
    pub(crate) model: Option<String>,
    /// And about this property
    #[arg(long, value_name = "TEXT", requires = "model")]
    pub(crate) property: Option<String>,
    /// Meaning of a system of nets [default: rounds]
    #[arg(long, value_name = "MEANING", requires = "model")]
    pub(crate) semantics: Option<Semantics>,
    #[command(flatten)]
    pub(crate) json: Json,
}

/// The meaning of a system of nets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ValueEnum)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Semantics {
    /// They act in any order, at any time: what never happens so never happens in rounds
    Interleaving,
    /// As they are executed: each net settles and reads its mailboxes in its turn, then one event
    /// comes from outside, or none
    Rounds,
}

/// Which engine looks for the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EngineName {
    /// Engines that suit the question, the cheapest first
    Auto,
    /// All markings, one by one
    Explicit,
    /// Markings one by one, only some transitions in each
    Stubborn,
    /// The structure of the net, without its markings
    Structural,
    /// Not in this version
    #[value(hide = true)]
    Symbolic,
    /// Not in this version
    #[value(hide = true)]
    Sat,
}
