//! Labels of nodes and arcs: numbers, kinds of arcs, intervals.

use super::document::Text;
use super::error::{Finding, Span, Spanned};
use super::state::{Context, Label, Owner, Parser};
use super::xml::WHITESPACE;
use cotama_core::net::Within;
use cotama_property::source::quoted;

impl<'a> Parser<'a> {
    /// Takes the text of a label to the object that is open.
    pub(super) fn labelled(&mut self, label: Label, text: Option<Text<'a>>, span: Span) {
        let owner = self.contexts.last().copied();
        // A part of another tool belongs to the node around it.
        let owner = match owner {
            Some(Context::Foreign(Owner::Place)) => Some(Context::Place),
            Some(Context::Foreign(Owner::Transition)) => Some(Context::Transition),
            owner => owner,
        };
        let Some(text) = text else {
            let says = label == Label::Inscription && self.labels.contains(&Label::Wrapped);
            if matches!(label, Label::InitialMarking | Label::Inscription) && !says {
                let finding = Finding::new(span, "a label without `<text>`");
                self.findings.push(finding.help("write its number as in `<text>1</text>`"));
            }
            return;
        };
        match label {
            // PIPE writes it so where there is no token.
            Label::Name | Label::InitialMarking if text.value.is_empty() => {}
            Label::Name => match owner {
                Some(Context::Place) => {
                    self.document.places.last_mut().map(|place| place.name.replace(text.value));
                }
                Some(Context::Transition) => {
                    self.document
                        .transitions
                        .last_mut()
                        .map(|transition| transition.name.replace(text.value));
                }
                _ => self.document.name = Some(text.value),
            },
            Label::InitialMarking => {
                let tokens = number(&text)
                    .and_then(|tokens| u32::try_from(tokens).map_err(|_| too_large(&text)));
                if let (Some(tokens), Some(place)) =
                    (self.findings.keep(tokens), self.document.places.last_mut())
                {
                    place.initial = tokens;
                }
            }
            Label::Inscription => {
                let weight = number(&text).and_then(|weight| match weight {
                    0 => Err(Finding::new(text.span, "an arc of weight 0").help(
                        "remove the arc; if it is meant to forbid tokens, it is not an arc of a \
                         P/T net",
                    )),
                    weight => Ok(weight),
                });
                if let (Some(value), Some(arc)) =
                    (self.findings.keep(weight), self.document.arcs.last_mut())
                {
                    arc.weight = Some(Box::new(Spanned { value, span: text.span }));
                }
            }
            Label::ArcKind => self.kind(&text),
            Label::Wrapped => self.wrapped(&text),
            // PIPE: no limit
            Label::Capacity if number(&text).is_ok_and(|capacity| capacity == 0) => {}
            Label::Capacity => self.findings.push(
                Finding::new(
                    text.span,
                    "a place with a capacity, which a P/T net of PNML does not \
                    have",
                )
                .help(
                    "add a complement place that holds the room that is left, and remove the \
                        capacity",
                ),
            ),
            Label::Timed => {
                let said = text.value.to_ascii_lowercase();
                if !["", "false", "0", "immediate", "undefined"].contains(&said.as_str()) {
                    self.document.random.get_or_insert(text.span);
                    if let Some(transition) = self.document.transitions.last_mut() {
                        transition.is_random = true;
                    }
                }
            }
            Label::Priority => {
                let priority = number(&text)
                    .and_then(|number| u32::try_from(number).map_err(|_| too_large(&text)));
                if let (Some(priority), Some(transition)) =
                    (self.findings.keep(priority), self.document.transitions.last_mut())
                {
                    transition.priority = Some(priority);
                }
            }
            Label::Guard if ["", "true"].contains(&&*text.value.to_ascii_lowercase()) => {}
            Label::Guard => self.findings.push(
                Finding::new(
                    text.span,
                    format!("a transition with the guard {}", quoted(&text.value)),
                )
                .help(
                    "a guard over data is not read: put its data into places, or remove it if \
                         it always holds",
                ),
            ),
        }
    }

    /// The interval of a transition, as TINA writes it in `MathML`.
    pub(super) fn interval(&mut self, span: Span) -> Result<Within, Finding> {
        let [earliest, latest] = &self.bounds[..] else {
            return Err(Finding::new(span, "an interval has two bounds")
                .help("write them as in `<cn>4</cn><cn>9</cn>`, no limit as `<ci>infty</ci>`"));
        };
        let bound = |text: &Text<'_>| {
            number(text).and_then(|ms| u32::try_from(ms).map_err(|_| too_large(text)))
        };
        let infinite = matches!(&*latest.value, "infty" | "w" | "inf" | "infinity");
        match (&*self.closure, infinite) {
            ("closed", _) | ("closed-open", true) => {}
            _ => {
                return Err(Finding::new(
                    span,
                    format!("an interval with an open end: {}", quoted(&self.closure)),
                )
                .help(
                    "only closed intervals are read: give the first and the last moment that \
                     belong to it",
                ));
            }
        }
        let within = Within {
            earliest: bound(earliest)?,
            latest: if infinite { None } else { Some(bound(latest)?) },
        };
        match within.latest {
            Some(end) if end < within.earliest => {
                Err(Finding::new(span, "an interval that ends before it begins")
                    .help("swap its bounds"))
            }
            Some(end) if !within.is_sound() => {
                Err(Finding::new(span, format!("an interval that ends after {end} ms")).help(
                    format!(
                        "the largest end is {}; no limit is written `<ci>infty</ci>`",
                        Within::LATEST
                    ),
                ))
            }
            _ => Ok(within),
        }
    }
}

/// The number that a label says; PIPE writes the one colour that it has before it.
fn number(text: &Text<'_>) -> Result<u64, Finding> {
    let digits = text.value.trim_matches(WHITESPACE);
    let digits = digits.strip_prefix("Default,").unwrap_or(digits);
    let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if is_digits(digits) {
        digits
            .parse()
            .ok()
            .filter(|&number| number <= 2 * u64::from(u32::MAX))
            .ok_or_else(|| too_large(text))
    } else if digits.strip_prefix('-').is_some_and(is_digits) {
        Err(Finding::new(text.span, format!("{} is negative", quoted(&text.value)))
            .help("write a whole number from 0"))
    } else {
        let message = if digits.is_empty() {
            "a number is missing".to_owned()
        } else {
            format!("{} is not a whole number", quoted(&text.value))
        };
        Err(Finding::new(text.span, message).help(if digits.contains(',') {
            "if the net has tokens of several colours, unfold it into a P/T net first"
        } else {
            "write a number such as 1, in digits"
        }))
    }
}

fn too_large(text: &Text<'_>) -> Finding {
    Finding::new(text.span, format!("{} is too large", quoted(&text.value)))
        .help(format!("the largest number of tokens and milliseconds is {}", u32::MAX))
}
