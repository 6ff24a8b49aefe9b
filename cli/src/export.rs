//! `cotama export`: a model as a file of another tool, or as a drawing.

use crate::args::{DrawnAs, ExportArgs, Format};
use crate::catalogue::{self, Entry, Kind};
use crate::exit::{Exit, Failure};
use crate::model;
use crate::output::{self, Screen};
use crate::render::style::NAME;
use crate::render::visible;
use clap::ValueEnum;
use cotama_core::net::{Net, TransitionId};
use cotama_verification::export::drawing::Style;
use cotama_verification::export::{dot, jani, json, matrix, mermaid, overview, scxml, svg};
use cotama_verification::pnml;
use std::path::Path;

/// The most entries of a matrix: zeros are written as well.
const MOST_ENTRIES: usize = 1 << 25;

/// Writes a model.
pub(crate) fn export(args: &ExportArgs, screen: &Screen) -> Result<Exit, Failure> {
    let format = match (args.format, &args.output) {
        (Some(format), _) => format,
        (None, Some(output)) => by_name(output)?,
        (None, None) => {
            return Err(Failure::new("which format? neither --format nor --output says it")
                .help(format!("formats: {}", formats().join(", "))));
        }
    };
    if args.style.is_some() && !matches!(format, Format::Dot | Format::Svg | Format::Mermaid) {
        return Err(Failure::new(format!("--style is for drawings, and {} is none", name(format)))
            .help("drawings: dot, svg, mermaid"));
    }
    let text = match catalogue::entry(&args.model.model) {
        Some(Entry { kind: Kind::System(system), .. }) if format == Format::Svg => {
            overview::write(system)
        }
        _ => {
            let loaded = model::load(&args.model.model)?;
            written(&loaded.net.view().net(), format, args.style.unwrap_or(DrawnAs::Auto), screen)?
        }
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

fn written(
    net: &Net<'_>,
    format: Format,
    style: DrawnAs,
    screen: &Screen,
) -> Result<String, Failure> {
    let style = match style {
        DrawnAs::States => Style::States,
        DrawnAs::Net => Style::Net,
        DrawnAs::Auto => Style::Auto,
    };
    Ok(match format {
        Format::Dot => dot::write(net, style),
        Format::Svg => svg::write(net, style),
        Format::Mermaid => mermaid::write(net, style),
        Format::Pnml => pnml::write(net),
        Format::Scxml => state_chart(net, screen)?,
        Format::Jani => jani::write(net),
        Format::Matrix => matrices(net)?,
        Format::Json => json::write(net),
    })
}

fn matrices(net: &Net<'_>) -> Result<String, Failure> {
    let (places, transitions) = (net.places.len(), net.transitions.len());
    if places.saturating_mul(transitions) > MOST_ENTRIES {
        let size = format!("{places} places by {transitions} transitions");
        return Err(Failure::new(format!("{}: too large for matrices: {size}", visible(net.name)))
            .help(format!(
                "a matrix has at most {MOST_ENTRIES} entries; `--format json` lists the arcs only"
            )));
    }
    Ok(matrix::write(net))
}

fn state_chart(net: &Net<'_>, screen: &Screen) -> Result<String, Failure> {
    let refused = |why: scxml::NotAStateMachine| {
        Failure::new(visible(&format!("{}: SCXML holds state machines only: {why}", net.name)))
            .help("`--format pnml` and `--format json` hold every net")
    };
    let text = scxml::write(net).map_err(refused)?;
    for TransitionId(id) in scxml::unkept_intervals(net).map_err(refused)? {
        if let Some(transition) = net.transitions.get(id as usize) {
            screen.note(&format!(
                "note: no timer of the chart keeps the interval of `{}`; `cotama:within` says it",
                visible(transition.name)
            ));
        }
    }
    Ok(text)
}

/// The format that the end of a file's name stands for.
fn by_name(path: &Path) -> Result<Format, Failure> {
    let end = path.extension().map(|end| end.to_string_lossy().to_lowercase());
    Ok(match end.as_deref() {
        Some("dot" | "gv") => Format::Dot,
        Some("svg") => Format::Svg,
        Some("pnml") => Format::Pnml,
        Some("mmd" | "mermaid") => Format::Mermaid,
        Some("scxml") => Format::Scxml,
        Some("jani") => Format::Jani,
        Some("tsv") => Format::Matrix,
        Some("json") => Format::Json,
        _ => {
            let message = format!("{}: the end of this name says no format", path.display());
            return Err(Failure::new(message).help(format!("--format {}", formats().join("|"))));
        }
    })
}

fn formats() -> Vec<String> {
    Format::value_variants().iter().map(|&it| name(it)).collect()
}

fn name(format: Format) -> String {
    format.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}
