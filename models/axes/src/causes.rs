//! Cause-effect diagrams: inducers act on indicators, these stand on axes (Lambert et al. 2024,
//! Sections 2.2 and 6.1, Table 2).

use crate::formula::Formula;
use crate::mission::{Constraint, Indicator, Mission};
use std::fmt::Write;

/// Inducers, indicators and axes, and which acts on which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Causes {
    /// Name of the mission.
    pub mission: String,
    /// Names of inducers, in alphabetical order, each once.
    pub inducers: Vec<String>,
    /// Indicators, in the order of the file.
    pub effects: Vec<Effect>,
    /// Names of axes.
    pub axes: Vec<String>,
}

/// An indicator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effect {
    /// Name and unit, then a line for each of its constraints.
    pub lines: Vec<String>,
    /// The inducers that act on it, by index.
    pub inducers: Vec<usize>,
    /// The axis, by index.
    pub axis: usize,
}

impl Causes {
    /// Finds what acts on what in a mission.
    ///
    /// ```
    /// use cotama_axes::{Case, PATROL, causes::Causes};
    /// let causes = Causes::of(&Case::parse(PATROL).unwrap().mission);
    /// let impact = &causes.effects[0];
    /// assert_eq!(impact.lines, ["safety.impact, mJ", "harmless < 4000"]);
    /// let names: Vec<_> = impact.inducers.iter().map(|&it| &causes.inducers[it]).collect();
    /// assert_eq!(names, ["robot.mass_g", "speed_mm_s"]);
    /// ```
    pub fn of(mission: &Mission) -> Self {
        let mut inducers: Vec<_> = mission.indicators.iter().flat_map(read_by).collect();
        inducers.sort();
        inducers.dedup();
        let effect = |(number, it): (usize, &Indicator)| Effect {
            lines: lines(mission, number, it),
            inducers: read_by(it).iter().filter_map(|it| inducers.binary_search(it).ok()).collect(),
            axis: it.axis,
        };
        let effects = mission.indicators.iter().enumerate().map(effect).collect();
        let axes = mission.axes.iter().map(|it| it.id.clone()).collect();
        Self { mission: mission.name.clone(), inducers, effects, axes }
    }

    /// Returns the diagram as a graph for Graphviz.
    pub fn dot(&self) -> String {
        let escaped = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
        let mut text = format!("digraph \"{}\" {{\n  rankdir=LR;\n", escaped(&self.mission));
        text += "  node [shape=box, fontname=\"sans-serif\"];\n";
        for (number, it) in self.inducers.iter().enumerate() {
            let _ = writeln!(text, "  i{number} [label=\"{}\", style=rounded];", escaped(it));
        }
        for (number, it) in self.effects.iter().enumerate() {
            let lines: Vec<_> = it.lines.iter().map(|it| escaped(it)).collect();
            let _ = writeln!(text, "  n{number} [label=\"{}\"];", lines.join("\\n"));
        }
        for (number, it) in self.axes.iter().enumerate() {
            let _ = writeln!(text, "  a{number} [label=\"{}\", shape=ellipse];", escaped(it));
        }
        for (from, to) in self.arrows() {
            let _ = writeln!(text, "  {from} -> {to};");
        }
        text + "}\n"
    }

    /// Returns the diagram for Mermaid.
    pub fn mermaid(&self) -> String {
        let mut text = "flowchart LR\n".to_owned();
        for (number, it) in self.inducers.iter().enumerate() {
            let _ = writeln!(text, "  i{number}([\"{}\"])", entities(it));
        }
        for (number, it) in self.effects.iter().enumerate() {
            let lines: Vec<_> = it.lines.iter().map(|it| entities(it)).collect();
            let _ = writeln!(text, "  n{number}[\"{}\"]", lines.join("<br>"));
        }
        for (number, it) in self.axes.iter().enumerate() {
            let _ = writeln!(text, "  a{number}{{{{\"{}\"}}}}", entities(it));
        }
        for (from, to) in self.arrows() {
            let _ = writeln!(text, "  {from} --> {to}");
        }
        text
    }

    /// Returns from where to where arrows lead: to indicators, then on to axes.
    fn arrows(&self) -> Vec<(String, String)> {
        let mut arrows = Vec::new();
        for (number, it) in self.effects.iter().enumerate() {
            arrows.extend(it.inducers.iter().map(|it| (format!("i{it}"), format!("n{number}"))));
        }
        let to_axis =
            |(number, it): (usize, &Effect)| (format!("n{number}"), format!("a{}", it.axis));
        arrows.extend(self.effects.iter().enumerate().map(to_axis));
        arrows
    }
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
fn lines(mission: &Mission, number: usize, it: &Indicator) -> Vec<String> {
    let own = mission.constraints.iter().filter(|it| it.indicator == number);
    let limit = |it: &Constraint| format!("{} {} {}", it.id, it.relation.sign(), it.goal);
    [format!("{}, {}", it.id, it.unit)].into_iter().chain(own.map(limit)).collect()
}

/// Returns the names of the inducers that an indicator reads, each once.
fn read_by(it: &Indicator) -> Vec<String> {
    let formulas = it.travel.iter().chain(&it.stand);
    let mut names: Vec<_> = formulas.flat_map(Formula::inducers).map(ToString::to_string).collect();
    names.sort();
    names.dedup();
    names
}
