//! `cotama fmeca`: what can fail, how it is seen, what is done, and what looks alike.

mod diagnosability;
mod glossary;
mod ishikawa;
mod markdown;
mod names;
mod page;
mod rows;
mod scene;
mod sheet;

use crate::args::{FmecaArgs, FmecaFormat};
use crate::exit::{Exit, Failure};
use crate::names::near;
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use clap::ValueEnum;
use cotama_models::cotama::{FmecaCsv, functions};
use std::path::Path;

/// Shows the analysis, or writes it in a format.
pub(crate) fn fmeca(args: &FmecaArgs, screen: &Screen) -> Result<Exit, Failure> {
    args.output.as_deref().map_or(Ok(()), output::place)?;
    let format = match (args.format, &args.output) {
        (Some(format), _) => Some(format),
        (None, Some(output)) => Some(by_name(output)?),
        (None, None) => None,
    };
    let function = args.function.as_deref().map(known).transpose()?;
    let Some(format) = format else {
        return shown(args, screen);
    };
    let text = match (format, function) {
        (FmecaFormat::Svg, Some(function)) => sheet::one(function),
        (FmecaFormat::Svg, None) => sheet::all(),
        (_, Some(_)) => return Err(only_drawings(name(format))),
        (FmecaFormat::Csv, None) => FmecaCsv.to_string(),
        (FmecaFormat::Md, None) => markdown::write(&rows::answer()),
        (FmecaFormat::Html, None) => page::write(&rows::answer()),
    };
    match &args.output {
        None => Screen::raw(text.as_bytes())?,
        Some(path) => {
            output::file(path, text.as_bytes())?;
            screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
        }
    }
    Ok(Exit::Success)
}

fn shown(args: &FmecaArgs, screen: &Screen) -> Result<Exit, Failure> {
    if args.function.is_some() {
        return Err(only_drawings("the screen"));
    }
    let answer = rows::answer();
    if args.json.json {
        Screen::json(&answer)?;
    } else if args.diagnosability {
        screen.print(&render::fmeca::diagnosability(&answer.diagnosability, screen.width()))?;
    } else {
        screen.print(&render::fmeca::screen(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn only_drawings(what: &str) -> Failure {
    Failure::new(format!("--function chooses a diagram, and {what} has none to choose"))
        .help("add --format svg, or --output FILE.svg")
}

/// The function of this name.
fn known(name: &str) -> Result<&'static str, Failure> {
    functions().find(|&it| it == name).ok_or_else(|| {
        let guess = near(name, functions())
            .map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
        Failure::new(format!("there is no function `{name}`{guess}"))
            .help(format!("functions: {}", functions().collect::<Vec<_>>().join(", ")))
    })
}

/// The format that the end of a file's name stands for.
fn by_name(path: &Path) -> Result<FmecaFormat, Failure> {
    let end = path.extension().map(|end| end.to_string_lossy().to_lowercase());
    Ok(match end.as_deref() {
        Some("md" | "markdown") => FmecaFormat::Md,
        Some("csv") => FmecaFormat::Csv,
        Some("html" | "htm") => FmecaFormat::Html,
        Some("svg") => FmecaFormat::Svg,
        _ => {
            let formats: Vec<_> =
                FmecaFormat::value_variants().iter().map(|&it| name(it)).collect();
            let message = format!("{}: the end of this name says no format", path.display());
            return Err(Failure::new(message).help(format!("--format {}", formats.join("|"))));
        }
    })
}

const fn name(format: FmecaFormat) -> &'static str {
    match format {
        FmecaFormat::Md => "md",
        FmecaFormat::Csv => "csv",
        FmecaFormat::Html => "html",
        FmecaFormat::Svg => "svg",
    }
}
