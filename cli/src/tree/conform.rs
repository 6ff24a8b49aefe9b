//! `cotama conform` of a behaviour tree: recorded runs, row by row.

use super::{load, only};
use crate::answers::check::tree::{TreeConformAnswer, TreeDepartsRow};
use crate::args::ConformArgs;
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::output::Screen;
use crate::render;
use cotama_trees::conform::{conform as compare, read};

/// Compares recorded runs with a tree.
pub(crate) fn conform(args: &ConformArgs, screen: &Screen) -> Result<Exit, Failure> {
    only(&[("--tolerance", args.tolerance != 0)])?;
    if args.tree.with.is_some() {
        let failure = Failure::new("--with: recorded runs have no moves of a supervisor");
        return Err(failure.help("leave --with and --bind out"));
    }
    let loaded = load(&args.model.model, &args.tree)?;
    let text = input::text(&args.trace, "a trace of a tree", input::TRACE_BYTES)?;
    let rows = read(&text).map_err(|(line, why)| {
        let name = input::name(&args.trace);
        Failure::Text(Box::new(FileErrors::at(name, text.clone(), line, 1, why)))
    })?;
    let compared = compare(&loaded.tree, &rows, args.clock);
    let mut answer = TreeConformAnswer {
        schema: "cotama/conform-tree/1",
        model: args.model.model.clone(),
        trace: args.trace.clone(),
        conforms: compared.is_ok(),
        runs: 0,
        rows: 0,
        departs: None,
    };
    match compared {
        Ok(accepted) => (answer.runs, answer.rows) = (accepted.runs, accepted.rows),
        Err(it) => {
            let found = match it.column {
                "events" => it.row.events.clone(),
                "status" => it.row.status.clone(),
                "blackboard" => it.row.blackboard.clone(),
                _ => String::new(),
            };
            answer.departs = Some(TreeDepartsRow {
                line: it.row.line,
                column: it.column,
                found,
                allowed: it.allowed.clone(),
                asked: it.asked.clone(),
            });
        }
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::tree::conform(&answer))?;
    }
    Ok(if answer.conforms { Exit::Success } else { Exit::Violated })
}
