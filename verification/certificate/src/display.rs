//! Nets, questions and evidence in words.

use super::{Case, Evidence, Fact, Formula, Linear, Net, Question};
use std::fmt;

/// A name as in the property language: in quotes where it could be taken for something else.
struct Name<'a>(&'a str);

impl fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = |it: char| it.is_ascii_alphanumeric() || it == '_';
        if self.0.starts_with(|it: char| it.is_ascii_alphabetic() || it == '_')
            && self.0.chars().all(plain)
        {
            f.write_str(self.0)
        } else {
            write!(f, "{:?}", self.0)
        }
    }
}

fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

impl fmt::Display for Net {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (places, transitions) = (self.places.len(), self.transitions.len());
        write!(
            f,
            "{} ({}, {})",
            Name(&self.name),
            count(places, "place"),
            count(transitions, "transition")
        )
    }
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Formula(formula) => formula.fmt(f),
            Self::Bound { places, most } => {
                let places: Vec<_> = places.iter().map(|it| Name(it).to_string()).collect();
                write!(f, "bounds({}) = {most}", places.join(" + "))
            }
            Self::Unbounded { places } => {
                let places: Vec<_> = places.iter().map(|it| Name(it).to_string()).collect();
                write!(f, "unbounded({})", places.join(" + "))
            }
            Self::Live => f.write_str("live"),
            Self::QuasiLive => f.write_str("quasi_live"),
            Self::Stable => f.write_str("stable"),
            Self::OneSafe => f.write_str("one_safe"),
        }
    }
}

impl Formula {
    /// Returns what is said of the next marking, if this is nothing else and needs no run itself.
    fn next_of_a_run(&self) -> Option<&Self> {
        match self {
            Self::Next(a) => Some(&**a).filter(|it| it.is_about_markings()),
            _ => None,
        }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |all: &[Self], sign: &str| {
            let all: Vec<_> = all.iter().map(|it| format!("({it})")).collect();
            all.join(sign)
        };
        match self {
            Self::AtMost(linear) => linear.fmt(f),
            Self::Fireable(names) => {
                let names: Vec<_> = names.iter().map(|it| Name(it).to_string()).collect();
                write!(f, "fireable({})", names.join(", "))
            }
            Self::Deadlock => f.write_str("deadlock"),
            Self::And(all) if all.is_empty() => f.write_str("true"),
            Self::Or(all) if all.is_empty() => f.write_str("false"),
            Self::And(all) => f.write_str(&list(all, " & ")),
            Self::Or(all) => f.write_str(&list(all, " | ")),
            Self::Not(a) => write!(f, "!({a})"),
            Self::ExistsNext(a) => write!(f, "EX ({a})"),
            Self::AllNext(a) => write!(f, "AX ({a})"),
            // In the language `E(X(a))` is a marking that follows. The next one of a run, which the
            // marking of a deadlock follows itself, is said by what is true of no run.
            Self::Exists(path) if path.next_of_a_run().is_some() => write!(f, "!(A(!({path})))"),
            Self::All(path) if path.next_of_a_run().is_some() => write!(f, "!(E(!({path})))"),
            Self::Exists(a) => write!(f, "E({a})"),
            Self::All(a) => write!(f, "A({a})"),
            Self::Next(a) => write!(f, "X({a})"),
            Self::Finally(a) => write!(f, "F({a})"),
            Self::Globally(a) => write!(f, "G({a})"),
            Self::Until(both) => write!(f, "({}) U ({})", both.0, both.1),
        }
    }
}

impl fmt::Display for Linear {
    /// Positive weights on the left, negative ones on the right.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |sign: i64, constant: bool| {
            let weights = self.weights.iter().filter(|it| it.1.signum() == sign);
            let mut terms: Vec<String> = weights
                .map(|(place, weight)| match weight.unsigned_abs() {
                    1 => Name(place).to_string(),
                    weight => format!("{weight}*{}", Name(place)),
                })
                .collect();
            if constant || terms.is_empty() {
                terms.push(if constant {
                    self.constant.unsigned_abs().to_string()
                } else {
                    "0".into()
                });
            }
            terms.join(" + ")
        };
        write!(f, "{} <= {}", side(1, self.constant > 0), side(-1, self.constant < 0))
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("nothing"),
            Self::State => f.write_str("looking at the marking"),
            Self::Each(all) => {
                write!(f, "{}", count(all.len(), "part"))?;
                // One line for each kind of part would say little more than their number.
                all.first().map_or(Ok(()), |it| write!(f, ", the first by {it}"))
            }
            Self::One(one) => write!(f, "part {}: {}", one.part, one.by),
            Self::Trace(trace) => {
                write!(f, "a trace of {}", count(trace.fire.len(), "firing"))?;
                if *trace.then == Self::State {
                    Ok(())
                } else {
                    write!(f, ", and there {}", trace.then)
                }
            }
            Self::Lasso(lasso) => write!(
                f,
                "a run of {} and a loop of {}",
                count(lasso.stem.len(), "firing"),
                count(lasso.cycle.len(), "firing")
            ),
            Self::Growth(growth) => write!(
                f,
                "{} that can be repeated after {}",
                count(growth.pump.len(), "firing"),
                count(growth.stem.len(), "firing")
            ),
            Self::Refutation(it) => {
                let traps = it.facts.iter().filter(|it| matches!(it, Fact::Trap(_))).count();
                let leaves =
                    it.cases.iter().filter(|it| matches!(it, Case::Contradiction(_))).count();
                let inductive = |it: &&Fact| matches!(it, Fact::Inductive(_));
                let inductive = it.facts.iter().filter(inductive).count();
                let facts = count(it.facts.len() - traps - inductive, "inequality");
                let mut facts = facts.replace("inequalitys", "inequalities");
                if inductive > 0 {
                    facts += ", ";
                    facts += &count(inductive, "inductive formula");
                }
                write!(
                    f,
                    "{facts} and {} that exclude {}",
                    count(traps, "trap"),
                    count(leaves, "case")
                )
            }
            Self::Graph(markings) => write!(f, "passing through {}", count(*markings, "marking")),
        }
    }
}
