//! `cotama statespace` of a behaviour tree.

use super::{limits, load, only, warn};
use crate::answers::check::tree::TreeSpaceAnswer;
use crate::args::StatespaceArgs;
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::render;
use cotama_trees::explore::{Assumptions, Space};
use std::time::Instant;

/// Counts the states of a tree between ticks.
pub(crate) fn statespace(args: &StatespaceArgs, screen: &Screen) -> Result<Exit, Failure> {
    only(&[
        ("--untimed", args.untimed),
        ("--semantics", args.semantics.is_some()),
        ("--mcc", args.mcc),
        ("--max-seconds", args.budget.max_seconds.is_some()),
        ("--jobs", args.budget.jobs != 1),
    ])?;
    let begun = Instant::now();
    let loaded = load(&args.model, &args.tree)?;
    warn(&loaded, screen);
    let tree = &loaded.tree;
    let limits = limits(&args.budget);
    let mut space = Space::explore(tree, false, Assumptions::default(), limits);
    let facts = space.facts(&[]);
    let complete = space.is_complete();
    let answer = TreeSpaceAnswer {
        schema: "cotama/statespace-tree/1",
        model: args.model.clone(),
        tree: tree.name.clone(),
        states: facts.states,
        questions: facts.questions,
        edges: facts.edges,
        minimal: complete.then(|| space.minimal()),
        ends: facts.ends.iter().map(|it| (it.0.shown(tree), *it.1)).collect(),
        stuck: facts.stuck,
        complete,
        seconds: begun.elapsed().as_secs_f64(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::tree::statespace(&answer))?;
    }
    Ok(if complete { Exit::Success } else { Exit::Unknown })
}
