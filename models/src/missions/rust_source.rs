//! A scenario as Rust source, for firmware.

use super::scenario::Scenario;
use super::tables::Alternative;
use cotama_core::text::visible;
use std::fmt;

impl Scenario {
    /// The scenario as the source of a Rust module of constant tables; `name` is that of the
    /// mission.
    ///
    /// The module needs `cotama-core` and `cotama-models` without features. Activities with the
    /// same alternatives share them. `LABELS` has the names of the alternatives; when it is not
    /// used, the linker leaves it out.
    pub fn to_rust(&self, name: &str) -> String {
        Source { scenario: self, name }.to_string()
    }
}

struct Source<'s> {
    scenario: &'s Scenario,
    name: &'s str,
}

impl fmt::Display for Source<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let activities = &self.scenario.activities;
        let count = activities.len();
        // Activities with the same alternatives share one table.
        let mut tables: Vec<&[Alternative]> = Vec::new();
        let mut labels: Vec<&[String]> = Vec::new();
        writeln!(
            f,
            "//! The activities of the mission `{}`, printed from its file.",
            one_line(self.name)
        )?;
        f.write_str(HEAD)?;
        let [duration, energy] = self.scenario.limits.map(number);
        let [first, second] = self.scenario.order;
        let available = self.scenario.available.to_bits();
        writeln!(f, "/// The inclusive limits, in ms and mJ.")?;
        writeln!(f, "pub const LIMITS: [u64; 2] = [{duration}, {energy}];")?;
        writeln!(f, "/// The axes in their order of treatment.")?;
        writeln!(f, "pub const ORDER: [usize; 2] = [{first}, {second}];")?;
        writeln!(f, "/// All the hardware of the robot.")?;
        writeln!(f, "pub const AVAILABLE: Equipment = units({});\n", hex(available))?;
        writeln!(f, "/// The activities.\n#[rustfmt::skip]")?;
        writeln!(f, "pub static ACTIVITIES: [Activity<'static>; {count}] = [")?;
        for activity in activities {
            let (start, end) = (number(activity.x_start.0), number(activity.x_end.0));
            let table = place(&mut tables, &activity.alternatives[..]);
            writeln!(f, "    activity({start}, {end}, &ALTERNATIVES_{table}),")?;
        }
        writeln!(f, "];\n\n/// The names of the alternatives of each activity.\n#[rustfmt::skip]")?;
        writeln!(f, "pub static LABELS: [&[&str]; {count}] = [")?;
        for activity in activities {
            writeln!(f, "    &LABELS_{},", place(&mut labels, &activity.labels[..]))?;
        }
        writeln!(f, "];")?;
        for (index, table) in tables.iter().enumerate() {
            writeln!(f, "\n#[rustfmt::skip]")?;
            writeln!(f, "static ALTERNATIVES_{index}: [Alternative; {}] = [", table.len())?;
            for alternative in *table {
                writeln!(f, "    {},", constructor(alternative))?;
            }
            writeln!(f, "];")?;
        }
        for (index, labels) in labels.iter().enumerate() {
            writeln!(f, "\n#[rustfmt::skip]")?;
            write!(f, "static LABELS_{index}: [&str; {}] = [", labels.len())?;
            for (place, label) in labels.iter().enumerate() {
                let separator = if place.is_multiple_of(10) { "\n    " } else { " " };
                write!(f, "{separator}{label:?},")?;
            }
            writeln!(f, "\n];")?;
        }
        Ok(())
    }
}

const HEAD: &str = "
use cotama_core::hardware::Equipment;
#[allow(unused_imports)] // a mission may stand nowhere
use cotama_models::missions::tables::rows::{activity, stand, travel, units};
use cotama_models::missions::tables::{Activity, Alternative};

";

/// The index of a value, which is appended when it is new.
fn place<T: PartialEq>(values: &mut Vec<T>, value: T) -> usize {
    values.iter().position(|known| *known == value).unwrap_or_else(|| {
        values.push(value);
        values.len() - 1
    })
}

fn constructor(alternative: &Alternative) -> String {
    let Alternative { speed, duration, power, needs, quality } = *alternative;
    let (power, needs, quality) = (number(power.0), needs.to_bits(), number(quality.into()));
    if speed.0 > 0 {
        format!("travel({}, {power}, {}, {quality})", number(speed.0), hex(needs))
    } else {
        format!("stand({}, {power}, {}, {quality})", number(duration.0), hex(needs))
    }
}

/// An integer with separators, as it is written in Rust.
fn number(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('_');
        }
        text.push(digit);
    }
    text
}

/// Hexadecimal digits, in groups of four where there are more.
fn hex(bits: u64) -> String {
    let digits = format!("{bits:x}");
    if digits.len() <= 4 {
        return format!("0x{digits}");
    }
    let digits = format!("{}{digits}", "0".repeat(digits.len().next_multiple_of(4) - digits.len()));
    let groups: Vec<&str> = (0..digits.len()).step_by(4).map(|at| &digits[at..at + 4]).collect();
    format!("0x{}", groups.join("_"))
}

/// A name that cannot end its comment, and has nothing that the compiler refuses there.
fn one_line(name: &str) -> String {
    visible(name).to_string()
}
