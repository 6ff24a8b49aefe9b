//! Formulas of indicators: integers, `+ - *`, brackets, divisions that say how they round, `min`,
//! `max`, and the inducers they read.

pub(crate) mod forms;
mod parser;

use crate::tree::{Fault, Wrong};
use parser::Parser;
use std::fmt;

/// A parameter that acts on indicators (Lambert et al. 2024, Section 2.2 and Table 2).
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Inducer {
    /// Length of the activity, mm.
    Length,
    /// Speed of the activity, mm/s.
    Speed,
    /// Duration of the activity, ms.
    Duration,
    /// Power of motion at the activity's speed, mW.
    MotionPower,
    /// An attribute of the robot.
    Robot(String),
    /// An attribute of the laptop.
    Laptop(String),
    /// The sum of an attribute over the chosen options.
    Options(String),
    /// The sum of an attribute over the hardware that is on, times its units.
    Hardware(String),
    /// The least of an attribute over the zones here.
    ZoneMin(String),
    /// An attribute of the detector that counts.
    Detector(String),
}

impl fmt::Display for Inducer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length => f.write_str("length_mm"),
            Self::Speed => f.write_str("speed_mm_s"),
            Self::Duration => f.write_str("duration_ms"),
            Self::MotionPower => f.write_str("motion_mw"),
            Self::Robot(key) => write!(f, "robot.{key}"),
            Self::Laptop(key) => write!(f, "laptop.{key}"),
            Self::Options(key) => write!(f, "option({key})"),
            Self::Hardware(key) => write!(f, "hardware({key})"),
            Self::ZoneMin(key) => write!(f, "zone_min({key})"),
            Self::Detector(key) => write!(f, "detector({key})"),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
    Add,
    Subtract,
    Multiply,
    DivideDown,
    DivideUp,
    DivideNear,
    Least,
    Most,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Node {
    Number(i64),
    Read(Inducer),
    /// The place is that of the operation, in bytes of the formula.
    Binary(Operation, usize, Box<[Node; 2]>),
}

/// A formula, read and within its bounds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Place in the file, in bytes.
    at: usize,
    /// Line and column in the file, from 1.
    place: (usize, usize),
    root: Node,
}

/// Arithmetic that does not come out: an overflow, or a division by zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NoValue {
    /// In bytes of the formula.
    at: usize,
    what: &'static str,
}

impl Formula {
    /// Reads a formula whose text begins at a place of the file.
    pub(crate) fn parse(text: &str, at: usize) -> Result<Self, Fault> {
        match Parser::new(text).whole() {
            Ok(root) => Ok(Self { at, place: (1, 1), root }),
            Err(fault) => Err(Fault { at: at + fault.at, ..fault }),
        }
    }

    /// Number of operations, numbers and inducers that the formula has.
    pub(crate) fn size(&self) -> u64 {
        self.root.size()
    }

    /// Returns the inducers that the formula reads, each once.
    pub fn inducers(&self) -> Vec<&Inducer> {
        let mut found = Vec::new();
        self.root.leaves(&mut found);
        found.sort();
        found.dedup();
        found
    }

    /// Returns the value, given that of each inducer.
    pub(crate) fn value(&self, read: &impl Fn(&Inducer) -> i64) -> Result<i64, NoValue> {
        self.root.value(read)
    }

    /// Returns the same formula with the inducers that are known put in.
    pub(crate) fn given(&self, read: &impl Fn(&Inducer) -> Option<i64>) -> Result<Self, NoValue> {
        let root = self.root.given(read)?;
        Ok(Self { root, ..*self })
    }

    /// Returns the inducers on which the value hangs: of `min` and `max` the part that decides.
    pub(crate) fn binding(
        &self,
        read: &impl Fn(&Inducer) -> i64,
    ) -> Result<Vec<&Inducer>, NoValue> {
        let mut found = Vec::new();
        self.root.binding(read, &mut found)?;
        found.sort();
        found.dedup();
        Ok(found)
    }

    /// Finds its line and column in the file.
    pub(crate) fn locate(&mut self, file: &str) {
        let Wrong { line, column, .. } = Fault::new(self.at, "").in_text(file);
        self.place = (line, column);
    }

    /// Says that a value is too large for sums over a mission.
    pub(crate) fn beyond(&self, whose: &str, most: i64) -> Wrong {
        let (line, column) = self.place;
        let message = format!("the value of `{whose}` is beyond {most}");
        Wrong { line, column, message, help: None }
    }

    /// Says where in the file arithmetic went wrong.
    pub(crate) fn wrong(&self, no_value: &NoValue, whose: &str) -> Wrong {
        let (line, column) = self.place;
        let message = format!("{} in the value of `{whose}`", no_value.what);
        Wrong { line, column: column + no_value.at, message, help: None }
    }
}

impl Node {
    fn size(&self) -> u64 {
        match self {
            Self::Number(_) | Self::Read(_) => 1,
            Self::Binary(_, _, sides) => 1 + sides.iter().map(Self::size).sum::<u64>(),
        }
    }

    /// The same as part of another formula, where its places mean nothing.
    fn placeless(self) -> Self {
        match self {
            Self::Binary(operation, _, sides) => {
                let sides = sides.map(Self::placeless);
                Self::Binary(operation, 0, Box::new(sides))
            }
            leaf => leaf,
        }
    }

    fn leaves<'n>(&'n self, found: &mut Vec<&'n Inducer>) {
        match self {
            Self::Number(_) => {}
            Self::Read(inducer) => found.push(inducer),
            Self::Binary(_, _, sides) => sides.iter().for_each(|it| it.leaves(found)),
        }
    }

    fn value(&self, read: &impl Fn(&Inducer) -> i64) -> Result<i64, NoValue> {
        match self {
            Self::Number(it) => Ok(*it),
            Self::Read(inducer) => Ok(read(inducer)),
            Self::Binary(operation, at, sides) => {
                let [left, right] = &**sides;
                operation.of(left.value(read)?, right.value(read)?, *at)
            }
        }
    }

    fn given(&self, read: &impl Fn(&Inducer) -> Option<i64>) -> Result<Self, NoValue> {
        Ok(match self {
            Self::Number(it) => Self::Number(*it),
            Self::Read(inducer) => {
                read(inducer).map_or_else(|| Self::Read(inducer.clone()), Self::Number)
            }
            Self::Binary(operation, at, sides) => {
                let [left, right] = &**sides;
                match (left.given(read)?, right.given(read)?) {
                    (Self::Number(left), Self::Number(right)) => {
                        Self::Number(operation.of(left, right, *at)?)
                    }
                    (left, right) => Self::Binary(*operation, *at, Box::new([left, right])),
                }
            }
        })
    }

    fn binding<'n>(
        &'n self,
        read: &impl Fn(&Inducer) -> i64,
        found: &mut Vec<&'n Inducer>,
    ) -> Result<(), NoValue> {
        let Self::Binary(operation, _, sides) = self else {
            self.leaves(found);
            return Ok(());
        };
        let [left, right] = &**sides;
        let [a, b] = [left.value(read)?, right.value(read)?];
        let (takes_left, takes_right) = match operation {
            Operation::Least => (a <= b, b <= a),
            Operation::Most => (a >= b, b >= a),
            _ => (true, true),
        };
        if takes_left {
            left.binding(read, found)?;
        }
        if takes_right {
            right.binding(read, found)?;
        }
        Ok(())
    }
}

impl Operation {
    fn of(self, left: i64, right: i64, at: usize) -> Result<i64, NoValue> {
        let [a, b] = [i128::from(left), i128::from(right)];
        // Two of them make no i128 too large.
        let divided = |a: i128| {
            if b == 0 {
                return Err(NoValue { at, what: "a division by zero" });
            }
            let [a, b] = if b < 0 { [-a, -b] } else { [a, b] };
            Ok((a, b))
        };
        let exact = match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Least => a.min(b),
            Self::Most => a.max(b),
            Self::DivideDown => divided(a).map(|(a, b)| a.div_euclid(b))?,
            Self::DivideUp => divided(-a).map(|(a, b)| -a.div_euclid(b))?,
            Self::DivideNear => divided(a).map(|(a, b)| (2 * a + b).div_euclid(2 * b))?,
        };
        i64::try_from(exact).map_err(|_| NoValue { at, what: "a number beyond 64 bits" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<i64, String> {
        let formula = Formula::parse(text, 0).map_err(|it| format!("{}: {}", it.at, it.message))?;
        let read = |it: &Inducer| if *it == Inducer::Speed { 410 } else { 7 };
        formula.value(&read).map_err(|it| format!("{}: {}", it.at, it.what))
    }

    #[test]
    fn a_division_rounds_as_its_name_says() {
        for (text, exact) in [
            ("div_down(7, 2) + div_down(0 - 7, 2) * 10", -37),
            ("div_up(7, 2) + div_up(0 - 7, 2) * 10", -26),
            ("div_near(7, 2) + div_near(0 - 7, 2) * 10", -26),
            ("2 + 3 * (4 - 1)", 11),
            ("min(speed_mm_s, 500, robot.mass_g)", 7),
        ] {
            assert_eq!(value(text), Ok(exact), "{text}");
        }
    }

    #[test]
    fn a_formula_that_is_none_is_refused_at_its_place() {
        let nested = format!("{}1{}", "(".repeat(20), ")".repeat(20));
        let long = vec!["1"; 80].join(" + ");
        for (text, said) in [
            ("speed_mm_s / 2", "11: no formula: this does not belong here"),
            ("2 * sped_mm_s", "4: unknown inducer `sped_mm_s`"),
            ("div(1, 2)", "0: unknown function `div`"),
            ("min(1)", "5: no formula: `,` is needed here"),
            ("1 +", "3: no formula: a number, an inducer or `(` is needed here"),
            ("option(3)", "7: no formula: the key of an attribute is needed here"),
            (&nested, "16: no formula: it is nested deeper than 16"),
            (&long, "258: no formula: it has more than 128 parts"),
            ("9000000000000000000 * speed_mm_s", "20: a number beyond 64 bits"),
            ("div_up(1, speed_mm_s - 410)", "0: a division by zero"),
        ] {
            let wrong = value(text).unwrap_err();
            assert!(wrong.starts_with(said), "{text}: {wrong}");
        }
    }
}
