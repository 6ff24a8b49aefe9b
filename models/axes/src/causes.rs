//! Cause-effect diagrams: inducers act on indicators, these stand on axes (Lambert et al. 2024,
//! Sections 2.2 and 6.1, Table 2).

use crate::formula::Formula;
use crate::mission::{Axis, Constraint, Indicator, Mission};
use std::fmt::Write;

/// Returns the diagram as a graph for Graphviz.
///
/// ```
/// let case = cotama_axes::Case::parse(cotama_axes::PATROL).unwrap();
/// let dot = cotama_axes::causes::dot(&case.mission);
/// assert!(dot.contains("\"i:robot.mass_g\" -> \"safety.impact\""));
/// ```
pub fn dot(mission: &Mission) -> String {
    let escaped = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
    let mut text = format!("digraph \"{}\" {{\n  rankdir=LR;\n", escaped(&mission.name));
    text += "  node [shape=box, fontname=\"sans-serif\"];\n";
    let inducers = inducers(mission);
    for it in &inducers {
        let it = escaped(it);
        let _ = writeln!(text, "  \"i:{it}\" [label=\"{it}\", style=rounded];");
    }
    for it in &mission.indicators {
        let lines = lines(mission, it).map(|it| escaped(&it)).collect::<Vec<_>>().join("\\n");
        let _ = writeln!(text, "  \"{}\" [label=\"{lines}\"];", escaped(&it.id));
    }
    for it in &mission.axes {
        let it = escaped(&it.id);
        let _ = writeln!(text, "  \"a:{it}\" [label=\"{it}\", shape=ellipse];");
    }
    for it in &mission.indicators {
        for inducer in read_by(it) {
            let _ = writeln!(text, "  \"i:{}\" -> \"{}\";", escaped(&inducer), escaped(&it.id));
        }
    }
    for (axis, it) in of_axes(mission) {
        let _ = writeln!(text, "  \"{}\" -> \"a:{}\";", escaped(&it.id), escaped(&axis.id));
    }
    text + "}\n"
}

/// Returns the diagram for Mermaid.
///
/// ```
/// let case = cotama_axes::Case::parse(cotama_axes::PATROL).unwrap();
/// assert!(cotama_axes::causes::mermaid(&case.mission).starts_with("flowchart LR\n"));
/// ```
pub fn mermaid(mission: &Mission) -> String {
    let mut text = "flowchart LR\n".to_owned();
    let inducers = inducers(mission);
    for (number, it) in inducers.iter().enumerate() {
        let _ = writeln!(text, "  i{number}([\"{}\"])", entities(it));
    }
    for (number, it) in mission.indicators.iter().enumerate() {
        let lines = lines(mission, it).map(|it| entities(&it)).collect::<Vec<_>>().join("<br>");
        let _ = writeln!(text, "  n{number}[\"{lines}\"]");
    }
    for (number, it) in mission.axes.iter().enumerate() {
        let _ = writeln!(text, "  a{number}{{{{\"{}\"}}}}", entities(&it.id));
    }
    for (number, it) in mission.indicators.iter().enumerate() {
        for inducer in read_by(it) {
            if let Ok(from) = inducers.binary_search(&inducer) {
                let _ = writeln!(text, "  i{from} --> n{number}");
            }
        }
    }
    for (number, it) in mission.indicators.iter().enumerate() {
        let _ = writeln!(text, "  n{number} --> a{}", it.axis);
    }
    text
}

/// Returns a text with the characters that Mermaid reads as its own written as entities.
fn entities(text: &str) -> String {
    let mut written = String::new();
    for it in text.chars() {
        match it {
            '"' => written += "#quot;",
            '#' => written += "#35;",
            '<' => written += "#lt;",
            '>' => written += "#gt;",
            '&' => written += "#amp;",
            other => written.push(other),
        }
    }
    written
}

/// Returns the lines of an indicator: its name, its unit, its constraints.
fn lines<'m>(mission: &'m Mission, it: &'m Indicator) -> impl Iterator<Item = String> + 'm {
    let number = mission.indicator(&it.id);
    let own = mission.constraints.iter().filter(move |it| Some(it.indicator) == number);
    let limit = |it: &Constraint| format!("{} {} {}", it.id, it.relation.sign(), it.goal);
    [format!("{}, {}", it.id, it.unit)].into_iter().chain(own.map(limit))
}

/// Returns the names of all inducers, in alphabetical order, each once.
fn inducers(mission: &Mission) -> Vec<String> {
    let mut all: Vec<_> = mission.indicators.iter().flat_map(read_by).collect();
    all.sort();
    all.dedup();
    all
}

/// Returns the names of the inducers that an indicator reads, each once.
fn read_by(it: &Indicator) -> Vec<String> {
    let formulas = it.travel.iter().chain(&it.stand);
    let mut names: Vec<_> = formulas.flat_map(Formula::inducers).map(ToString::to_string).collect();
    names.sort();
    names.dedup();
    names
}

fn of_axes(mission: &Mission) -> impl Iterator<Item = (&Axis, &Indicator)> {
    mission.indicators.iter().filter_map(|it| Some((mission.axes.get(it.axis)?, it)))
}
