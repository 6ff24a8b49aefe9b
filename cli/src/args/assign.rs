//! The command line of `cotama assign`.

use super::Json;
use super::number::whole;
use clap::Args;
use cotama_models::team::curves::MOST_ROBOTS;
use std::path::PathBuf;

/// The usual limit of a search over all tasks at once: some tens of seconds.
const STEPS: u64 = 200_000_000;

pub(crate) const ASSIGN_EXAMPLES: &str = "\
Kinds of instances:
  single           each task has `cost`, one entry a robot
  coalition-mean   one task; the mean of the costs of its roles counts: how fast it is
  coalition-max    one task; the largest counts: the slowest member
  simultaneous     any tasks at once, each with its own `combine`: sum, mean or max

Instance:
  {\"format\":\"cotama-team-assignment/1\", \"name\":\"home\", \"kind\":\"simultaneous\",
   \"cost_denominator\":1, \"robots\":[\"anna\",\"ben\"],
   \"tasks\":[{\"name\":\"mop\", \"skip_cost\":30, \"cost\":[8,null]},
            {\"name\":\"carry\", \"skip_cost\":null, \"combine\":\"max\", \"plans\":[
              {\"name\":\"both\", \"extra_cost\":0, \"roles\":[
                {\"name\":\"left\", \"cost\":[5,6]}, {\"name\":\"right\", \"cost\":[4,9]}]}]}]}

`cost_denominator` D is a multiple of the number of roles of each plan whose mean counts, and 1 \
where there is none: all costs of the answer are in parts, D of which make a unit. `extra_cost` is \
what a plan yields less than the best one.

Of a team at work (`cotama-team/1`, which `cotama run` runs) all tasks are given out at once, as \
if they were known at the start: each robot bids from its place, in ms. That a task comes later, \
or after another one, is left out.

Examples:
  $ echo '{\"format\": \"cotama-team-assignment/1\", \"name\": \"home\", \"kind\": \"single\", \
\"cost_denominator\": 1, \"robots\": [\"anna\", \"ben\"], \"tasks\": [{\"name\": \"mop\", \
\"skip_cost\": null, \"cost\": [3, 2]}, {\"name\": \"cook\", \"skip_cost\": 9, \"cost\": \
[null, 1]}]}' > home.json
  $ cotama assign home.json
  $ cotama assign home.json --greedy
  $ cotama assign - --json < home.json
  $ cotama assign service
  $ cotama assign --curves 8 --report curves";

#[derive(Args, Debug)]
pub(crate) struct AssignArgs {
    /// The instance, a JSON file, or `-`; or a team at work, its file (TOML or JSON) or `service`
    /// or `fleet`
    #[arg(required_unless_present = "curves")]
    pub(crate) instance: Option<String>,
    /// The most steps of a search over all tasks at once
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    #[arg(value_parser = whole(1, u64::MAX))]
    pub(crate) steps: u64,
    /// Also says what greedy rounds cost: task after task, first what is dearest to leave undone
    #[arg(long)]
    pub(crate) greedy: bool,
    /// In place of an instance: how the work for one task grows with the robots, up to so many,
    /// when all coalitions are looked at, as Rohrmueller does (2011, 3.4.4); how many messages are
    /// sent; and what it saves to pass over coalitions that are not capable. Counts of steps, no
    /// times
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "12")]
    #[arg(value_parser = whole(2, MOST_ROBOTS as u64))]
    #[arg(conflicts_with_all = ["instance", "greedy", "steps"])]
    pub(crate) curves: Option<u64>,
    /// Also draws the curves as a page, `index.html` in this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) json: Json,
}
