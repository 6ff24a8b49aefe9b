//! What other programs need of this one: tables for firmware, schemas, completions, manual pages.

use crate::answers::{AllocateAnswer, ListAnswer, PlanAnswer, ReplayAnswer, RunAnswer};
use crate::args::{Cli, CompletionsArgs, ManArgs, MissionArg, SchemaArgs, SchemaName};
use crate::exit::{Exit, Failure};
use crate::mission;
use crate::output::Screen;
use clap::CommandFactory;
use schemars::schema_for;

/// `cotama table`: the tables of a mission as Rust source.
pub(crate) fn table(args: &MissionArg, screen: &Screen) -> Result<Exit, Failure> {
    let loaded = mission::load(&args.mission)?;
    screen.raw(loaded.mission.scenario().to_rust(&loaded.mission.name).as_bytes())?;
    Ok(Exit::Success)
}

/// `cotama schema`: the JSON schema of an answer.
pub(crate) fn schema(args: &SchemaArgs, screen: &Screen) -> Result<Exit, Failure> {
    let schema = match args.command {
        SchemaName::List => schema_for!(ListAnswer),
        SchemaName::Plan => schema_for!(PlanAnswer),
        SchemaName::Run => schema_for!(RunAnswer),
        SchemaName::Allocate => schema_for!(AllocateAnswer),
        SchemaName::Replay => schema_for!(ReplayAnswer),
    };
    screen.json(&schema)?;
    Ok(Exit::Success)
}

/// `cotama completions`: a completion script.
pub(crate) fn completions(args: &CompletionsArgs, screen: &Screen) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "cotama", &mut script);
    screen.raw(&script)?;
    Ok(Exit::Success)
}

/// `cotama man`: a manual page.
pub(crate) fn man(args: &ManArgs, screen: &Screen) -> Result<Exit, Failure> {
    let mut program = Cli::command();
    program.build();
    let command = match &args.command {
        None => program,
        Some(name) => program.find_subcommand(name).cloned().ok_or_else(|| {
            Failure::new(format!("there is no command `{name}`")).help("`cotama help` lists the commands")
        })?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command)
        .render(&mut page)
        .map_err(|error| Failure::new(format!("the page cannot be made: {error}")))?;
    screen.raw(&page)?;
    Ok(Exit::Success)
}
