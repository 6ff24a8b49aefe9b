//! The command line of `cotama conform`.

use super::Json;
use super::model::ModelArg;
use super::number::whole;
use clap::Args;
use cotama_verification::conform::MOST_STATES;

pub(crate) const CONFORM_EXAMPLES: &str = "\
A recorded run has one JSON object a line, in order; t_ms is the time in whole milliseconds:
  {\"schema\":\"cotama-recording/1\"}   first line, may be left out; may have members, see below
  {\"t_ms\":0,\"event\":\"Call\"}         the model was told this; \"ignored\":true or false says
                                    whether it used it
  {\"t_ms\":0,\"fired\":\"call\"}         this transition fired
  {\"t_ms\":0,\"output\":\"motor\"}       the model said this
  {\"t_ms\":100,\"round\":true}         each net of a system took its turn
  {\"t_ms\":9000,\"end\":true}          nothing else until then
Names of a system are NET.EVENT, NET.TRANSITION and NET.OUTPUT. A transition goes by its own name or
by that of its line in the definition. What fired or was said may be reported late, behind lines of
a later time: its own time counts. Other members of a line are not read.

The first line can say \"start_ms\":T, when the model started (0); \"round_every_ms\":T, how often a
round takes place, the first one at the start; \"rounds\":true, that a line says each round;
\"silent\":[NAME,...], the nets and transitions whose firings are not recorded; \"firings\":false,
that none is. Without that period and without lines that say `round`, a round takes place at
once whenever something waits in a mailbox. The trace of a supervised mission is read as well.
`cotama schema recording` prints the JSON schema of a line.

Every firing of the model must be recorded, in order, and none besides. A transition without event
that has an interval fires when the recording says so, within its interval, at its end at the
latest; others fire at once. A log of events and outputs alone is one of firings that are not
recorded: everything that may have fired is searched. So are transitions that a PNML file calls
$invisible$; those may be recorded as well.

Of a behaviour tree the trace has eight columns, separated by tabs: run, step, op (tick, once or
halt), wait in ms, set (x=1;y=2), events, status of the root, blackboard; `-` for nothing. Events:
LEAF:S (asked), LEAF~R (asked while running), LEAF=F (by its own rule), LEAF! (halted), GATE?T.

Exit codes: 0 it is a run of the model; 1 it departs; 2 bad input; 3 too many states are possible to
say so.

Examples:
  $ cotama simulate door Call EndOpen@2000 +5000 --trace door.jsonl
  $ cotama conform door door.jsonl
  $ sed /EndOpen/d door.jsonl | cotama conform door -   # nothing opens it: exit code 1
  $ sed s/7000/7020/ door.jsonl | cotama conform door - --tolerance 50 --json
  $ cotama run delivery --no-report --trace run.jsonl && cotama conform delivery run.jsonl";

#[derive(Args, Debug)]
pub(crate) struct ConformArgs {
    #[command(flatten)]
    pub(crate) model: ModelArg,
    /// The recorded run: a file of JSON lines, or `-`
    pub(crate) trace: String,
    /// How far recorded dates may be from those of the model, in ms
    #[arg(long, value_name = "MS", default_value_t = 0)]
    #[arg(value_parser = whole(0, 1_000_000))]
    pub(crate) tolerance: u64,
    /// The most states that are followed at one instant, where firings are not recorded
    #[arg(long, value_name = "N", default_value_t = MOST_STATES as u64)]
    #[arg(value_parser = whole(1, 1_000_000))]
    pub(crate) max_states: u64,
    #[command(flatten)]
    pub(crate) json: Json,
    #[command(flatten)]
    pub(crate) tree: super::tree::TreeArgs,
    /// Lets the timers of a behaviour tree go by the dates of the trace
    #[arg(long, help_heading = "Behaviour trees")]
    pub(crate) clock: bool,
}
