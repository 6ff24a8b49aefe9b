//! `cotama fmeca`: what can fail, how it is seen, what is done, and what looks alike.

mod diagnosability;
mod glossary;
mod markdown;
mod matrix;
mod measured;
mod page;
mod rows;

use crate::answers::fmeca::FmecaAnswer;
use crate::args::{FmecaArgs, FmecaFormat};
use crate::exit::{Exit, Failure};
use crate::input;
use crate::kind::{self, Kind};
use crate::measurement;
use crate::names::{near, quoted};
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use crate::robot;
use clap::ValueEnum;
use cotama_models::fmeca::Analysis;
use cotama_models::robots::{self, Measurement, Robot};
use cotama_pages::causes;
use std::path::Path;

/// The robot whose rows are shown where no file is named.
const DEFAULT: &str = "p3dx-delivery";

/// Shows the analysis, or writes it in a format.
pub(crate) fn fmeca(args: &FmecaArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(mission) = &args.measure {
        return measured::measure(mission, args, screen);
    }
    args.output.as_deref().map_or(Ok(()), output::place)?;
    let format = match (args.format, &args.output) {
        (Some(format), _) => Some(format),
        (None, Some(output)) => Some(by_name(output)?),
        (None, None) => None,
    };
    let (analysis, robot) = named(args.file.as_deref().unwrap_or(DEFAULT))?;
    let measurement = args.measured.as_deref().map(|it| by_runs(robot.as_ref(), it)).transpose()?;
    let analysis = match &measurement {
        Some((robot, it)) if args.detections => {
            measured::shown(robot, it, args, screen)?;
            return Ok(Exit::Success);
        }
        Some((robot, it)) => analysis.measured(robot, it),
        None => analysis,
    };
    let function = args.function.as_deref().map(|it| known(&analysis, it)).transpose()?;
    let answer = || rows::answer(&analysis, robot.as_ref());
    let Some(format) = format else {
        return shown(args, &answer(), screen);
    };
    let text = match (format, function) {
        (FmecaFormat::Svg, Some(function)) => causes::one(&analysis, function),
        (FmecaFormat::Svg, None) => causes::all(&analysis),
        (_, Some(_)) => return Err(only_drawings(name(format))),
        (FmecaFormat::Csv, None) => analysis.to_csv(),
        (FmecaFormat::Md, None) => markdown::write(&answer()),
        (FmecaFormat::Toml, None) => analysis.to_rows(),
        (FmecaFormat::Html, None) => page::write(&analysis, robot.as_ref(), &answer()),
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

/// The analysis in a file, and the robot whose it is.
fn read(path: &str) -> Result<(Analysis, Option<Robot>), Failure> {
    let end = Path::new(path).extension().map(|it| it.to_string_lossy().to_lowercase());
    let parse = match end.as_deref() {
        Some("toml") => Analysis::parse,
        Some("csv") => Analysis::parse_csv,
        _ => {
            let message = "the end of this name says neither TOML nor CSV";
            return Err(Failure::of(path, message)
                .help("give FILE.toml or FILE.csv; `cotama new fmeca NAME` writes one to begin"));
        }
    };
    let text = kind::text(path, "an FMECA", input::FMECA_BYTES, &[Kind::Fmeca, Kind::Robot])?;
    if kind::is_of(&text, Kind::Robot) {
        return of_robot(path, robot::robot_file(path, &text)?.robot().clone());
    }
    Ok((parse(path, &text)?, None))
}

/// The analysis of a robot that comes with the program, or of a file.
fn named(name: &str) -> Result<(Analysis, Option<Robot>), Failure> {
    match robots::embedded(name) {
        Some(it) => of_robot(name, Robot::parse(it.name, it.text)?),
        None => read(name),
    }
}

/// The measurement of a robot, with the robot.
fn by_runs<'r>(robot: Option<&'r Robot>, name: &str) -> Result<(&'r Robot, Measurement), Failure> {
    let Some(robot) = robot else {
        let message = "--measured is of a robot, and this is a table of rows";
        return Err(Failure::new(message).help("name the robot, or its file"));
    };
    Ok((robot, measurement::load(name, robot)?))
}

fn of_robot(name: &str, robot: Robot) -> Result<(Analysis, Option<Robot>), Failure> {
    let analysis = Analysis::try_from(&robot).map_err(|lacking| {
        Failure::of(name, lacking.to_string())
            .help("say how many hours pass between two failures on average, in `[[failure]]`")
    })?;
    Ok((analysis, Some(robot)))
}

fn shown(args: &FmecaArgs, answer: &FmecaAnswer<'_>, screen: &Screen) -> Result<Exit, Failure> {
    if args.function.is_some() {
        return Err(only_drawings("the screen"));
    }
    if args.json.json {
        Screen::json(answer)?;
    } else if args.diagnosability {
        screen.print(&render::fmeca::diagnosability(&answer.diagnosability, screen.width()))?;
    } else {
        let file = args.file.as_deref().map(quoted);
        screen.print(&render::fmeca::screen(answer, file.as_deref(), screen.width()))?;
    }
    Ok(Exit::Success)
}

fn only_drawings(what: &str) -> Failure {
    Failure::new(format!("--function chooses a diagram, and {what} has none to choose"))
        .help("add --format svg, or --output FILE.svg")
}

/// The function of this name.
fn known<'a>(analysis: &'a Analysis, name: &str) -> Result<&'a str, Failure> {
    let functions = analysis.functions();
    functions.iter().copied().find(|&it| it == name).ok_or_else(|| {
        let guess = near(name, functions.iter().copied())
            .map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
        Failure::new(format!("there is no function `{name}`{guess}"))
            .help(format!("functions: {}", functions.join(", ")))
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
        Some("toml") => FmecaFormat::Toml,
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
        FmecaFormat::Toml => "toml",
    }
}
