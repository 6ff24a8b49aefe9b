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
mod axes;
mod bids;
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
mod floor;
mod fmeca;
mod foreign;
mod infeasible;
mod input;
mod junit;
mod kind;
mod last_word;
mod list;
mod margins;
mod measurement;
mod mission;
mod model;
mod models;
mod names;
mod new;
mod output;
mod plan;
mod play;
mod progress;
#[cfg(any(test, feature = "fuzz"))]
pub mod readers;
mod recording;
mod render;
mod replay;
mod risk;
mod robot;
mod run;
mod schemas;
mod show;
mod simulate;
mod solve;
mod statespace;
mod subject;
mod team;
mod tree;
mod verify;
mod ways;
mod words;

use answers::error::ErrorAnswer;
use args::{Cli, Color, Command};
use clap::FromArgMatches;
use clap::error::ContextKind;
use exit::{Exit, Failure};
use output::Screen;
use render::visible;
use std::ffi::OsString;
use std::process::ExitCode;

/// Does what the words of the command line say, and says how that ended.
pub fn main() -> ExitCode {
    let words: Vec<_> = std::env::args_os().collect();
    // A command line that cannot be understood may say, too, that a program reads the answer.
    let is_json = words.iter().take_while(|it| *it != "--").any(|it| it == "--json");
    let cli = match read(&words) {
        Ok(cli) => cli,
        Err(refused) => return refused.told(is_json),
    };
    let screen = Screen::new(cli.color);
    ended(cli.command, &screen)
        .unwrap_or_else(|failure| {
            screen.refuse(&failure, is_json);
            Exit::BadInput
        })
        .into()
}

/// The answer to a command line without any work: help, or why it cannot be understood.
#[derive(Debug)]
enum Refused {
    /// By the reader of command lines.
    Clap(Box<clap::Error>),
    Failure(Failure),
}

impl Refused {
    fn told(&self, is_json: bool) -> ExitCode {
        let screen = Screen::new(Color::Auto);
        let error = match self {
            Self::Failure(failure) => {
                screen.refuse(failure, is_json);
                return Exit::BadInput.into();
            }
            Self::Clap(error) => error,
        };
        if error.exit_code() != 0 {
            let said =
                is_json && Screen::json(&ErrorAnswer::from(&Failure::from(&**error))).is_ok();
            if !said {
                let _ = error.print();
            }
            return Exit::BadInput.into();
        }
        // Help and version are what was asked for, on standard output.
        screen.printed(&error.render()).map_or_else(
            |failure| {
                screen.explain(&failure);
                Exit::BadInput.into()
            },
            |()| Exit::Success.into(),
        )
    }
}

fn read(words: &[OsString]) -> Result<Cli, Refused> {
    let mut command = args::command(output::width());
    // Written files must be found again, and answers in JSON name them.
    if let Some(word) = words.iter().find(|it| it.to_str().is_none()) {
        let word = word.to_string_lossy();
        return Err(Refused::Failure(
            Failure::new(format!("`{word}`: this argument is no text in UTF-8"))
                .help("give files and folders names in UTF-8"),
        ));
    }
    let matched = command.try_get_matches_from_mut(words);
    let read = matched.and_then(|mut matches| Cli::from_arg_matches_mut(&mut matches));
    read.map_err(|error| {
        // The words stand in the message: there they are those that a terminal shows.
        let shown = words.iter().map(|it| visible(&it.to_string_lossy()));
        let again = command.try_get_matches_from_mut(shown).err();
        let Some(mut error) = again.filter(|it| it.kind() == error.kind()) else {
            return Refused::Failure(Failure::from(&error));
        };
        // A user who mistypes an option does not want its name as a value.
        if error.get(ContextKind::SuggestedArg).is_none() {
            error.remove(ContextKind::Suggested);
        }
        Refused::Clap(Box::new(error.format(&mut command)))
    })
}

fn ended(command: Command, screen: &Screen) -> Result<Exit, Failure> {
    match command {
        Command::List(args) => list::list(&args, screen),
        Command::Plan(args) => plan::plan(&args, screen),
        Command::Explain(args) => axes::explain::explain(&args, screen),
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
        Command::Play(args) => play::play(&args, screen),
        Command::Conform(args) => conform::conform(&args, screen),
        Command::Floor(args) => floor::floor(&args, screen),
        Command::Fmeca(args) => fmeca::fmeca(&args, screen),
        Command::Campaign(args) => campaign::campaign(&args, screen),
        Command::Risk(args) => risk::risk(&args, screen),
        Command::New(args) => new::new(&args, screen),
        Command::Show(args) => show::show(&args),
        Command::Table(args) => about::table(&args, screen),
        Command::Schema(args) => about::schema(&args),
        Command::Completions(args) => about::completions(&args),
        Command::Man(args) => about::man(&args),
    }
}
