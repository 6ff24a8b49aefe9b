//! `cotama export`: a model as a file of another tool, or as a drawing.

use crate::args::{DrawnAs, ExportArgs, Format, Semantics};
use crate::axes;
use crate::exit::{Exit, Failure};
use crate::model::{self, Found};
use crate::names::near;
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use crate::render::visible;
use crate::tree;
use clap::ValueEnum;
use cotama_axes::causes::Causes;
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Net, TransitionId};
use cotama_core::system::System;
use cotama_verification::drawing::figure::Style;
use cotama_verification::drawing::{matrix, overview, svg};
use cotama_verification::flat;
use cotama_verification::formats::{dot, jani, json, mermaid, scxml};
use cotama_verification::pnml;
use cotama_verification::tina;
use cotama_verification::tpn;
use std::path::Path;

/// The most names of a note.
const SHOWN: usize = 8;
/// The most entries of a matrix: zeros are written as well.
const MOST_ENTRIES: usize = 1 << 25;

/// Writes a model.
pub(crate) fn export(args: &ExportArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.output {
        output::place(path)?;
    }
    let format = match (args.format, &args.output) {
        (Some(format), _) => format,
        (None, Some(output)) => by_name(output)?,
        (None, None) => {
            return Err(Failure::new("which format? neither --format nor --output says it")
                .help(format!("formats: {}", formats().join(", "))));
        }
    };
    if tree::is(&args.model.model) {
        return tree::export(args, format, screen);
    }
    tree::idle(args.tree.given(), &args.model.model)?;
    if format == Format::Btcpp {
        return Err(of_trees());
    }
    if let Some(file) = axes::file(&args.model.model)? {
        return causes(&file, args, format, screen);
    }
    if args.style.is_some() && !matches!(format, Format::Dot | Format::Svg | Format::Mermaid) {
        return Err(Failure::new(format!("--style is for drawings, and {} is none", name(format)))
            .help("drawings: dot, svg, mermaid"));
    }
    let style = args.style.unwrap_or(DrawnAs::Auto);
    let name = &args.model.model;
    let found = model::find(name)?;
    let part = args.net.as_deref().map(|net| match &found {
        Found::System(it) => written_part(it, name, net, format, style, screen),
        Found::Owned(it) => it.system.with(|it| written_part(it, name, net, format, style, screen)),
        _ => Err(Failure::new(format!("`{name}` is one net: --net is for systems"))
            .help("leave --net out")),
    });
    let text = match part {
        Some(part) => part?,
        None => whole(found, args, format, style, screen)?,
    };
    match &args.output {
        None if format == Format::Net => Screen::raw(shown(&text, screen).as_bytes())?,
        output => put(&text, output.as_deref(), screen)?,
    }
    Ok(Exit::Success)
}

/// Writes a text to a file, or to standard output.
pub(crate) fn put(text: &str, output: Option<&Path>, screen: &Screen) -> Result<(), Failure> {
    let Some(path) = output else { return Screen::raw(text.as_bytes()) };
    output::file(path, text.as_bytes())?;
    screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    Ok(())
}

/// Writes which inducers act on the indicators of a mission with axes.
fn causes(
    file: &axes::File,
    args: &ExportArgs,
    format: Format,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let name = &args.model.model;
    let given = [
        ("--style", args.style.is_some()),
        ("--net", args.net.is_some()),
        ("--semantics", args.semantics.is_some()),
    ];
    if let Some((option, _)) = given.into_iter().find(|it| it.1) {
        let message = format!("{option} is for models, and `{name}` is a mission with axes");
        return Err(Failure::new(message).help(format!("leave {option} out")));
    }
    let causes = Causes::of(&file.case.mission);
    let text = match format {
        Format::Dot => causes.dot(),
        Format::Mermaid => causes.mermaid(),
        Format::Svg => render::causes::svg(&causes),
        other => {
            let message = format!("{}: no format for causes and effects", self::name(other));
            return Err(Failure::new(message)
                .help(format!("`{name}` is a mission with axes: --format dot|mermaid|svg")));
        }
    };
    put(&text, args.output.as_deref(), screen)?;
    Ok(Exit::Success)
}

/// The text of a whole model.
fn whole(
    found: Found,
    args: &ExportArgs,
    format: Format,
    style: DrawnAs,
    screen: &Screen,
) -> Result<String, Failure> {
    let name = &args.model.model;
    Ok(match (found, args.semantics) {
        (Found::System(_) | Found::Owned(_), None)
            if format == Format::Svg && args.style.is_some() =>
        {
            let message = "--style: the drawing of a system is of its nets and what they say";
            return Err(
                Failure::new(message).help("--semantics rounds draws the places of all its nets")
            );
        }
        (Found::System(system), None) if format == Format::Svg => overview::write(system),
        (Found::Owned(it), None) if format == Format::Svg => it.system.with(overview::write),
        (Found::System(system), None) if format == Format::Json => json::write_system(system),
        (Found::Owned(it), None) if format == Format::Json => it.system.with(json::write_system),
        (Found::System(system), semantics) => {
            let net = one_net(system, semantics.unwrap_or(Semantics::Rounds))?;
            written(&net.view().net(), format, style, screen)?
        }
        (Found::Owned(it), semantics) => {
            let semantics = semantics.unwrap_or(Semantics::Rounds);
            let net = it.system.with(|system| one_net(system, semantics))?;
            written(&net.view().net(), format, style, screen)?
        }
        (_, Some(_)) => {
            return Err(Failure::new(format!("`{name}` is one net: --semantics is for systems"))
                .help("leave --semantics out"));
        }
        // The intervals of a time net can be those of no net.
        (Found::Time(net), _) if format == Format::Net => tina::write(&net),
        (Found::Time(net), _) => {
            written(&model::played(name, &net)?.view().net(), format, style, screen)?
        }
        (Found::Net(loaded), _) if format == Format::Pnml && loaded.random.is_none() => {
            notes(&loaded.notes, screen);
            pnml::write_extended(&loaded.net.view().net(), &loaded.extras)
        }
        (Found::Net(loaded), _) => {
            notes(&loaded.notes, screen);
            let what = format!("written as {}", self::name(format));
            written(&loaded.plain(name, &what)?.view().net(), format, style, screen)?
        }
    })
}

/// A `.net` file as a screen may show it: the format cannot escape characters of a name that a
/// screen obeys, so they become their codes here, and a note says so.
fn shown(text: &str, screen: &Screen) -> String {
    let Ok(net) = tina::read("net", text.as_bytes()) else { return visible(text) };
    let shown = tina::write(&net.relabelled(visible));
    if shown != text {
        screen.note("note: characters that a screen obeys are codes here; --output keeps them");
    }
    shown
}

fn notes(all: &[String], screen: &Screen) {
    all.iter().for_each(|it| screen.note(&format!("note: {}", visible(it))));
}

/// Writes a net in a format.
pub(crate) fn written(
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
        Format::Net => time_net(net, screen)?,
        Format::Btcpp => return Err(of_trees()),
    })
}

fn of_trees() -> Failure {
    Failure::new("btcpp is a format of behaviour trees").help("nets are written as pnml or json")
}

/// One net of a system.
fn written_part(
    system: &System<'_>,
    model: &str,
    net: &str,
    format: Format,
    style: DrawnAs,
    screen: &Screen,
) -> Result<String, Failure> {
    let names = || system.components.iter().map(|it| it.name);
    let Some(it) = system.components.iter().find(|it| it.name == net) else {
        let guess =
            near(net, names()).map_or_else(String::new, |it| format!("; did you mean `{it}`?"));
        return Err(Failure::new(format!("`{model}` has no net `{net}`{guess}"))
            .help(format!("its nets: {}", names().collect::<Vec<_>>().join(", "))));
    };
    written(it.net, format, style, screen)
}

/// A system as one net.
fn one_net(system: &System<'_>, semantics: Semantics) -> Result<OwnedNet, Failure> {
    let net = match semantics {
        Semantics::Rounds => flat::rounds(system).and_then(|it| it.net()),
        Semantics::Interleaving => flat::flat(system),
    };
    net.map_err(|error| {
        let failure = Failure::new(format!("`{}` cannot be one net: {error}", system.name));
        match semantics {
            Semantics::Rounds => failure.help("try --semantics interleaving"),
            Semantics::Interleaving => failure,
        }
    })
}

/// A net as a time net; what it allows beyond the net is noted.
fn time_net(net: &Net<'_>, screen: &Screen) -> Result<String, Failure> {
    let converted = tpn::exported(net).map_err(|defect| {
        Failure::new(visible(&format!("{}: no time net can say it: {defect}", net.name)))
    })?;
    for difference in &converted.differences {
        screen.note(&format!("note: in the file, {difference}"));
    }
    Ok(tina::write(&converted.net))
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
    let waiting = scxml::waiting(net).map_err(refused)?;
    let shown: Vec<_> = waiting
        .iter()
        .take(SHOWN)
        .filter_map(|it| Some(format!("`{}`", visible(net.transitions.get(it.0 as usize)?.name))))
        .collect();
    if !shown.is_empty() && waiting.len() == net.transitions.len() {
        screen.note(
            "note: the net has neither events nor time: each transition of the chart waits for an \
             event of its name, as `cotama simulate` plays it",
        );
    } else if !shown.is_empty() {
        let more = if waiting.len() > SHOWN { ", ..." } else { "" };
        screen.note(&format!(
            "note: at the start these would fire for ever, and wait for events of their names: \
             {}{more}",
            shown.join(", ")
        ));
    }
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
        Some("net") => Format::Net,
        Some("xml") => Format::Btcpp,
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
