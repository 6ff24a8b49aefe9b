//! Files that other programs need of this one: tables for firmware, schemas, completions, manual
//! pages.

use crate::args::{self, Cli, CompletionsArgs, ManArgs, SchemaArgs, SchemaName, TableArgs};
use crate::catalogue::{self, Kind};
use crate::exit::{Exit, Failure};
use crate::file_schemas;
use crate::output::Screen;
use crate::robot;
use crate::schemas::AnswerSchema;
use crate::team::Team;
use crate::{mission, model};
use clap::builder::PossibleValuesParser;
use clap::{CommandFactory, ValueEnum};
use clap_complete::Shell;
use cotama_models::missions::embedded;
use cotama_models::robots::to_rust;
use cotama_verification::conform::LINE_SCHEMA;
use serde::Serialize;

/// `cotama table`: the tables of a mission, or the decisional level of a robot, as Rust source.
pub(crate) fn table(args: &TableArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(robot) = robot::robot(&args.mission)? {
        let of = args.of.as_ref().map(|it| model::steps(&args.mission, &robot, it));
        let steps = of.transpose()?.unwrap_or_default();
        Screen::raw(LEVEL_HEAD.as_bytes())?;
        Screen::raw(to_rust(&robot, &steps).as_bytes())?;
        return Ok(Exit::Success);
    }
    if args.of.is_some() {
        let message = format!("--mission: `{}` is no robot", args.mission);
        let help = "give the name of a robot, or the path of its file, before it";
        return Err(Failure::new(message).help(help));
    }
    let mission = mission::load(&args.mission, Some(screen))?;
    Screen::raw(mission.scenario().to_rust(&mission.name).as_bytes())?;
    Ok(Exit::Success)
}

const LEVEL_HEAD: &str = "\
//! The decisional level of a robot, printed from its file.
#![allow(nonstandard_style)] // names are those of the file

";

/// `cotama schema`: the JSON schema of an answer, or of a file that users write.
pub(crate) fn schema(args: &SchemaArgs) -> Result<Exit, Failure> {
    match args.of {
        SchemaName::Recording => {
            Screen::raw(LINE_SCHEMA.as_bytes())?;
            Ok(Exit::Success)
        }
        SchemaName::Mission => print(&file_schemas::mission()),
        SchemaName::Robot => print(&file_schemas::robot_file()),
        SchemaName::Faults => print(&file_schemas::faults()),
        of => {
            let command = of.to_possible_value();
            let schema = command.as_ref().and_then(|it| AnswerSchema::of(it.get_name()));
            print(&schema.ok_or_else(|| Failure::new("there is no schema of this name"))?)
        }
    }
}

fn print(schema: &impl Serialize) -> Result<Exit, Failure> {
    Screen::json(schema)?;
    Ok(Exit::Success)
}

/// `cotama completions`: a completion script.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    let program = Cli::command();
    // Bash looks among files if no known word begins so; other shells would not.
    let mut program = if args.shell == Shell::Bash { named(program) } else { program };
    clap_complete::generate(args.shell, &mut program, "cotama", &mut script);
    Screen::raw(&script)?;
    Ok(Exit::Success)
}

/// The width of a manual page, less its margins.
const PAGE_WIDTH: usize = 72;
/// The program with the names of what it comes with as values; it is not to be run so.
fn named(program: clap::Command) -> clap::Command {
    let models: Vec<_> = catalogue::entries()
        .iter()
        .filter(|it| !matches!(it.kind, Kind::Family(_)))
        .map(|it| it.name)
        .collect();
    let missions: Vec<_> = embedded::embedded().iter().map(|it| it.name).collect();
    let of = |command: &str, argument: &str, names: &[&'static str], program: clap::Command| {
        let values = PossibleValuesParser::new(names.to_vec());
        let valued = |it: clap::Arg| {
            if it.get_id() == argument { it.value_parser(values.clone()) } else { it }
        };
        program.mut_subcommand(command, |it| it.mut_args(valued))
    };
    let commands = ["export", "check", "estimate", "statespace", "simulate", "play", "conform"];
    let program = commands.iter().fold(program, |it, command| of(command, "model", &models, it));
    let program = of("models", "name", &models, program);
    let teams = Team::ALL.iter().map(|it| it.0.name());
    let run: Vec<_> = missions.iter().copied().chain(teams).collect();
    let program = of("run", "mission", &run, program);
    let program = of("table", "mission", &missions, program);
    let with_axes: Vec<_> = cotama_axes::EMBEDDED.iter().map(|it| it.name).collect();
    let program = of("explain", "mission", &with_axes, program);
    of("plan", "mission", &[missions, with_axes].concat(), program)
}

/// `cotama man`: a manual page.
pub(crate) fn man(args: &ManArgs) -> Result<Exit, Failure> {
    let mut program = args::command(PAGE_WIDTH);
    program.build();
    let command = match &args.command {
        None => program,
        Some(name) => program.find_subcommand(name).cloned().ok_or_else(|| {
            Failure::new(format!("there is no command `{name}`"))
                .help("`cotama help` lists the commands")
        })?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command)
        .render(&mut page)
        .map_err(|error| Failure::new(format!("the page cannot be made: {error}")))?;
    Screen::raw(&page)?;
    Ok(Exit::Success)
}
