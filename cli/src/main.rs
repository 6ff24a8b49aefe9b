//! The program `cotama`: robot missions and supervisors, checked, simulated and flashed from one
//! definition.
//!
//! Each command reads its input, calls the libraries, renders the answer and says how it ended;
//! this file only sends to the commands and turns the end into an exit code.

mod about;
mod allocate;
mod answers;
mod args;
mod budget;
mod catalogue;
mod check;
mod conform;
mod exit;
mod export;
mod file_errors;
mod fmeca;
mod infeasible;
mod input;
mod list;
mod mission;
mod model;
mod models;
mod new;
mod output;
mod plan;
mod progress;
mod render;
mod replay;
mod run;
mod show;
mod simulate;
mod solve;
mod statespace;
mod subject;
mod verify;

use args::{Cli, Command};
use clap::Parser;
use output::Screen;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let screen = Screen::new(cli.color);
    let ended = match cli.command {
        Command::List(args) => list::list(&args, &screen),
        Command::Plan(args) => plan::plan(&args, &screen),
        Command::Run(args) => run::run(&args, &screen),
        Command::Allocate(args) => allocate::allocate(&args, &screen),
        Command::Replay(args) => replay::replay(&args, &screen),
        Command::Models(args) => models::models(&args, &screen),
        Command::Export(args) => export::export(&args, &screen),
        Command::Check(args) => check::check(&args, &screen),
        Command::Statespace(args) => statespace::statespace(&args, &screen),
        Command::Verify(args) => verify::verify(&args, &screen),
        Command::Simulate(args) => simulate::simulate(&args, &screen),
        Command::Conform(args) => conform::conform(&args, &screen),
        Command::Fmeca(args) => fmeca::fmeca(&args, &screen),
        Command::New(args) => new::new(&args, &screen),
        Command::Show(args) => show::show(&args),
        Command::Table(args) => about::table(&args),
        Command::Schema(args) => about::schema(&args),
        Command::Completions(args) => about::completions(&args),
        Command::Man(args) => about::man(&args),
    };
    ended
        .unwrap_or_else(|failure| {
            screen.explain(&failure);
            exit::Exit::BadInput
        })
        .into()
}
