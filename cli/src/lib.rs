//! The program `cotama`: robot missions and supervisors, checked, simulated and flashed from one
//! definition.
//!
//! Each command reads its input, calls the libraries, renders the answer and says how it ended;
//! this file only sends to the commands and turns the end into an exit code.

mod about;
mod allocate;
mod answers;
mod args;
mod assign;
mod budget;
mod campaign;
mod catalogue;
mod check;
mod conform;
mod estimate;
mod exit;
mod export;
mod file_errors;
mod file_schemas;
mod fmeca;
mod infeasible;
mod input;
mod kind;
mod last_word;
mod list;
mod mission;
mod model;
mod models;
mod names;
mod new;
mod output;
mod plan;
mod progress;
#[cfg(any(test, feature = "fuzz"))]
pub mod readers;
mod render;
mod replay;
mod run;
mod show;
mod simulate;
mod solve;
mod statespace;
mod subject;
mod verify;
mod words;

use answers::error::ErrorAnswer;
use args::{Cli, Command};
use clap::FromArgMatches;
use clap::error::ContextKind;
use exit::{Exit, Failure};
use output::Screen;
use std::ffi::OsString;
use std::process::ExitCode;

/// Does what the words of the command line say, and says how that ended.
pub fn main() -> ExitCode {
    if let Some(code) = last_word::printed() {
        return code;
    }
    let words: Vec<_> = std::env::args_os().collect();
    // A command line that cannot be understood may say, too, that a program reads the answer.
    let is_json = words.iter().take_while(|it| *it != "--").any(|it| it == "--json");
    let cli = match read(&words) {
        Ok(cli) => cli,
        Err(error) if is_json && error.exit_code() != 0 => {
            let said = Screen::json(&ErrorAnswer::from(&Failure::from(&error)));
            return said.map_or_else(|_| error.exit(), |()| Exit::BadInput.into());
        }
        Err(error) => error.exit(),
    };
    let screen = Screen::new(cli.color);
    ended(cli.command, &screen)
        .unwrap_or_else(|failure| {
            screen.refuse(&failure, is_json);
            Exit::BadInput
        })
        .into()
}

fn read(words: &[OsString]) -> Result<Cli, clap::Error> {
    let mut command = args::command(output::width());
    command
        .try_get_matches_from_mut(words)
        .and_then(|mut matches| Cli::from_arg_matches_mut(&mut matches))
        .map_err(|mut error| {
            // Who mistypes an option does not want its name as a value.
            if error.get(ContextKind::SuggestedArg).is_none() {
                error.remove(ContextKind::Suggested);
            }
            error.format(&mut command)
        })
}

fn ended(command: Command, screen: &Screen) -> Result<Exit, Failure> {
    match command {
        Command::List(args) => list::list(&args, screen),
        Command::Plan(args) => plan::plan(&args, screen),
        Command::Run(args) => run::run(&args, screen),
        Command::Allocate(args) => allocate::allocate(&args, screen),
        Command::Assign(args) => assign::assign(&args, screen),
        Command::Replay(args) => replay::replay(&args, screen),
        Command::Models(args) => models::models(&args, screen),
        Command::Export(args) => export::export(&args, screen),
        Command::Check(args) => check::check(&args, screen),
        Command::Estimate(args) => estimate::estimate(&args, screen),
        Command::Statespace(args) => statespace::statespace(&args, screen),
        Command::Verify(args) => verify::verify(&args, screen),
        Command::Simulate(args) => simulate::simulate(&args, screen),
        Command::Conform(args) => conform::conform(&args, screen),
        Command::Fmeca(args) => fmeca::fmeca(&args, screen),
        Command::Campaign(args) => campaign::campaign(&args, screen),
        Command::New(args) => new::new(&args, screen),
        Command::Show(args) => show::show(&args),
        Command::Table(args) => about::table(&args),
        Command::Schema(args) => about::schema(&args),
        Command::Completions(args) => about::completions(&args),
        Command::Man(args) => about::man(&args),
    }
}
