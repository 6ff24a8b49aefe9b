//! Named forms of formulas, whose units are checked when they are read (Lambert et al. 2024,
//! Sections 6.1.2 and 6.1.4, equation 5).
//!
//! Keys say their units at their ends, as in `power_mw`. A form yields one unit, or a few.

use super::parser::Parser;
use super::{Formula, Inducer, Node, Operation};
use crate::fields::{Faults, Fields, index_of, text, wrong_type};
use crate::mission::Indicator;
use crate::tree::{self, Fault, Value};

/// A form reads at most so many inducers of a kind.
const MAX_TERMS: usize = 16;
/// A formula has at most so many parts.
const MAX_NODES: u64 = 128;

/// Ends of keys that say a unit.
const UNITS: [&str; 20] = [
    "mm_s2", "mm_s", "kb_s", "mm", "dm", "um", "m", "ms", "s", "mw", "w", "mj", "j", "wh", "kb",
    "kg", "g", "permille", "mhz", "hz",
];

/// A form, by its name in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// Length over speed: a time.
    LengthOverSpeed,
    /// Powers times the time: an energy.
    PowerTimesTime,
    /// Rates times the time: a quantity of any unit.
    RateTimesTime,
    /// A share of the length: a length.
    ShareOfLength,
    /// A sum of inducers, or of other indicators.
    Sum,
}

const FORMS: [(&str, Form); 5] = [
    ("length_over_speed", Form::LengthOverSpeed),
    ("power_times_time", Form::PowerTimesTime),
    ("rate_times_time", Form::RateTimesTime),
    ("share_of_length", Form::ShareOfLength),
    ("sum", Form::Sum),
];

impl Form {
    /// The unit that is yielded, in words, and the divisor for the unit of an indicator.
    fn yields(self, unit: &str) -> (&'static str, Option<i64>) {
        match self {
            Self::LengthOverSpeed => ("a time, in ms or s", pick(unit, &[("ms", 1), ("s", 1_000)])),
            // mW times ms are uJ.
            Self::PowerTimesTime => {
                let known = [("mJ", 1_000), ("J", 1_000_000), ("Wh", 3_600_000_000)];
                ("an energy, in mJ, J or Wh", pick(unit, &known))
            }
            // mm times permille are um.
            Self::ShareOfLength => {
                let known = [("um", 1), ("mm", 1_000), ("dm", 100_000), ("m", 1_000_000)];
                ("a length, in um, mm, dm or m", pick(unit, &known))
            }
            Self::RateTimesTime => ("what its rates are of", Some(1_000)),
            Self::Sum => ("what its terms are", Some(1)),
        }
    }
}

fn pick(unit: &str, known: &[(&str, i64)]) -> Option<i64> {
    known.iter().find(|it| it.0 == unit).map(|it| it.1)
}

/// Result of a look-up of a word of a form.
#[derive(Clone, Debug)]
pub(crate) enum Term {
    /// The word names no indicator: an inducer, if anything.
    Inducer,
    /// Another indicator.
    Indicator {
        /// The unit.
        unit: String,
        /// The formula where this one is used.
        formula: Formula,
    },
    /// The word names an indicator that cannot be read here, as was said.
    Wrong,
}

/// Finds the indicator that a word names.
type Others<'o> = dyn FnMut(usize, &str) -> Term + 'o;

/// Reads a form of an indicator; `travels` says in which activities it applies.
pub(crate) fn read(
    node: &tree::Node,
    whose: &Indicator,
    travels: bool,
    others: &mut Others<'_>,
    faults: &Faults,
) -> Option<Formula> {
    let mut fields = Fields::of(node, "a form", faults);
    let names = FORMS.map(|it| it.0);
    let (form_at, number) = fields.word("form", "form", &names)?;
    let (name, form) = FORMS.get(number).copied()?;
    fields.call(format!("the form `{name}`"));
    let (yields, divisor) = form.yields(&whose.unit);
    // A unit that could not be read is said already.
    if divisor.is_none() && !whose.unit.is_empty() {
        let message = format!("`{name}` yields {yields}, and `{}` is in {}", whose.id, whose.unit);
        faults.add(Fault::new(form_at, message).help("let `unit` be one of these"));
    }
    if !travels && matches!(form, Form::LengthOverSpeed | Form::ShareOfLength) {
        let message = format!("`{name}` is of activities that travel, and these stand");
        faults.say(form_at, message);
    }
    let divisor = divisor.unwrap_or(1);
    let unit = whose.unit.as_str();
    let mut terms = |key, wanted: &str, fields: &mut Fields<'_, '_>| {
        terms(fields.required(key)?, key, wanted, name, others, faults)
    };
    let main = match form {
        Form::LengthOverSpeed => {
            let (length, speed) = (Node::Read(Inducer::Length), Node::Read(Inducer::Speed));
            let round = rounding(&mut fields, faults);
            let thousand = Node::Number(if divisor == 1 { 1_000 } else { 1 });
            Some(binary(round, binary(Operation::Multiply, length, thousand), speed))
        }
        Form::PowerTimesTime => timed(terms("power", "mW", &mut fields)),
        Form::RateTimesTime => timed(terms("rate", &format!("{unit}/s"), &mut fields)),
        Form::ShareOfLength => {
            let share = terms("share", "permille", &mut fields).and_then(sum);
            share.map(|it| binary(Operation::Multiply, Node::Read(Inducer::Length), it))
        }
        Form::Sum => terms("of", unit, &mut fields).and_then(sum),
    };
    let divided = match form {
        Form::LengthOverSpeed | Form::Sum => main,
        _ => {
            let round = rounding(&mut fields, faults);
            main.map(|it| binary(round, it, Node::Number(divisor)))
        }
    };
    let mut plus = Some(Vec::new());
    if form != Form::Sum && fields.optional_is_there("plus") {
        plus = terms("plus", unit, &mut fields);
    }
    fields.finish();
    let root = plus?.into_iter().fold(divided?, |all, it| binary(Operation::Add, all, it));
    if root.size() > MAX_NODES {
        let message = format!("a formula has at most {MAX_NODES} parts, with those it reads");
        faults.say(node.at, message);
        return None;
    }
    Some(Formula { at: node.at, place: (1, 1), root })
}

/// Returns how a form divides: near, unless it says something else.
fn rounding(fields: &mut Fields<'_, '_>, faults: &Faults) -> Operation {
    let node = fields.optional("round");
    let word = node.and_then(|it| text(it, "round", faults));
    let ways = [
        ("near", Operation::DivideNear),
        ("up", Operation::DivideUp),
        ("down", Operation::DivideDown),
    ];
    let names = ways.iter().map(|it| it.0);
    let number = word.and_then(|it| index_of(it.0, "way to round", it.1, names, faults));
    number.and_then(|it| ways.get(it)).map_or(Operation::DivideNear, |it| it.1)
}

/// Reads the inducers of a key, a list of words or one word, all in one unit.
fn terms(
    node: &tree::Node,
    key: &str,
    wanted: &str,
    form: &str,
    others: &mut Others<'_>,
    faults: &Faults,
) -> Option<Vec<Node>> {
    let items = match &node.value {
        Value::List(items) => items.as_slice(),
        Value::Text(_) => std::slice::from_ref(node),
        _ => {
            faults.add(wrong_type(node, key, "an inducer or a list of some"));
            return None;
        }
    };
    if items.is_empty() || items.len() > MAX_TERMS {
        let message =
            format!("`{key}` of `{form}` has 1 to {MAX_TERMS} inducers, not {}", items.len());
        faults.say(node.at, message);
        return None;
    }
    let all: Vec<_> = items.iter().map(|it| term(it, key, wanted, others, faults)).collect();
    all.into_iter().collect()
}

fn term(
    node: &tree::Node,
    key: &str,
    wanted: &str,
    others: &mut Others<'_>,
    faults: &Faults,
) -> Option<Node> {
    let (at, words) = text(node, key, faults)?;
    match others(at, words) {
        Term::Wrong => return None,
        Term::Indicator { unit, formula } => {
            if !unit.is_empty() && slug(&unit) != slug(wanted) {
                let message = format!("`{words}` is in {unit}, and `{key}` needs {wanted} here");
                faults.say(at, message);
            }
            return Some(formula.root.placeless());
        }
        Term::Inducer => {}
    }
    let read = Parser::new(words).whole();
    let inducer = match read.map_err(|it| Fault { at: at + 1 + it.at, ..it }) {
        Ok(Node::Read(inducer)) => inducer,
        Ok(_) => {
            let message = format!("`{key}` reads inducers alone, and this is a formula");
            faults.add(Fault::new(at, message).help("let `travel` or `stand` be a text"));
            return None;
        }
        Err(fault) => {
            faults.add(fault);
            return None;
        }
    };
    // A unit that could not be read is said already.
    if !slug(wanted).is_empty() && !wanted.starts_with('/') {
        check(at, &inducer, key, wanted, faults);
    }
    Some(Node::Read(inducer))
}

/// Says that an inducer is in another unit than the one that is needed.
fn check(at: usize, inducer: &Inducer, key: &str, wanted: &str, faults: &Faults) {
    let needed = slug(wanted);
    let own = match inducer {
        Inducer::Length => "mm",
        Inducer::Speed => "mm_s",
        Inducer::Duration => "ms",
        Inducer::MotionPower => "mw",
        Inducer::Robot(name)
        | Inducer::Laptop(name)
        | Inducer::Options(name)
        | Inducer::Hardware(name)
        | Inducer::ZoneMin(name)
        | Inducer::Detector(name) => {
            let ends = |unit: &&str| name.strip_suffix(*unit).is_some_and(|it| it.ends_with('_'));
            let known = UNITS.into_iter().chain([needed.as_str()]).filter(ends);
            let Some(own) = known.max_by_key(|it| it.len()) else {
                let message = format!("`{inducer}` says no unit, and `{key}` needs {wanted} here");
                let help = format!("let its key end with `_{needed}`");
                faults.add(Fault::new(at, message).help(help));
                return;
            };
            if own == needed {
                return;
            }
            let message =
                format!("`{inducer}` is in {own}, by its end, and `{key}` needs {wanted} here");
            faults.say(at, message);
            return;
        }
    };
    if own != needed {
        faults.say(at, format!("`{inducer}` is in {own}, and `{key}` needs {wanted} here"));
    }
}

/// Returns a unit as ends of keys say it.
fn slug(unit: &str) -> String {
    unit.to_lowercase().replace('/', "_").replace('\u{b2}', "2").replace('\u{b5}', "u")
}

fn binary(operation: Operation, left: Node, right: Node) -> Node {
    Node::Binary(operation, 0, Box::new([left, right]))
}

fn sum(terms: Vec<Node>) -> Option<Node> {
    terms.into_iter().reduce(|all, it| binary(Operation::Add, all, it))
}

fn timed(terms: Option<Vec<Node>>) -> Option<Node> {
    let time = Node::Read(Inducer::Duration);
    terms.and_then(sum).map(|it| binary(Operation::Multiply, it, time))
}
