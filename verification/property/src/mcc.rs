//! The property files of the Model Checking Contest, and the lines in which it wants answers.
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace};
//! use cotama_verification::property::{mcc, Ids};
//! use cotama_verification::pt::Pt;
//!
//! let mut net = OwnedNet::new("net", "");
//! net.place(OwnedPlace::new("p", 1)).unwrap();
//! let net = Pt::from(&net.view().net());
//! let file = "<property-set><property><id>never-two</id><formula><all-paths><globally><integer-le>
//!     <tokens-count><place>p</place></tokens-count><integer-constant>1</integer-constant>
//! </integer-le></globally></all-paths></formula></property></property-set>";
//! let properties = mcc::read("file.xml", file.as_bytes(), &net, Ids::default()).unwrap();
//! assert_eq!(properties[0].question.display(&net).to_string(), "AG p <= 1");
//! let line = mcc::answer(&properties[0].name, mcc::Answer::Verdict(true), &["EXPLICIT"]);
//! assert_eq!(line, "FORMULA never-two TRUE TECHNIQUES EXPLICIT");
//! ```

use super::error::Fault;
use super::linear::{Comparison, Sum};
use super::names::{First, Ids, Names};
use super::operand::too_large;
use super::xml::{Element, Xml, decode};
use super::{Atom, Formula, MAX_DEPTH, Property, PropertyError, Question};
use crate::pt::Pt;
use crate::source::quoted;
use cotama_core::net::PlaceId;
use cotama_core::text::marked;
use std::collections::HashSet;
use std::ops::Range;

/// Reads a file of properties: any of reachability, CTL, LTL and upper bounds. `name` is the name
/// of the file in messages. Nodes are called by id; where there is none, by name. A property is
/// called by its id, whatever that is; one without any, by its number in the file, and a second one
/// of a name by that with `#2` behind it.
///
/// # Errors
/// The first thing that is wrong with the file, and where.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::property::{Ids, mcc};
/// use cotama_verification::pt::Pt;
/// let net = philosophers(2).unwrap();
/// let text = br#"<property-set xmlns="http://mcc.lip6.fr/"><property><id>stuck</id><formula>
/// <exists-path><finally><deadlock/></finally></exists-path></formula></property></property-set>"#;
/// let pt = Pt::from(&net.view().net());
/// let properties = mcc::read("RF.xml", text, &pt, Ids::default()).unwrap();
/// assert_eq!(properties[0].name, "stuck");
/// assert_eq!(properties[0].question.display(&pt).to_string(), "EF deadlock");
/// ```
pub fn read(
    name: &str,
    bytes: &[u8],
    net: &Pt,
    ids: Ids<'_>,
) -> Result<Vec<Property>, PropertyError> {
    let text = decode(bytes).map_err(|(fault, text)| fault.located(name, &text))?;
    let mut file = File {
        xml: Xml::new(text),
        names: Names::new(net, ids, First::Ids),
        depth: 0,
        quantified: false,
        parts: Formula::MAX_PARTS,
    };
    file.properties().map_err(|fault| fault.located(name, text))
}

/// The question of an examination that has no file, named after it: `ReachabilityDeadlock`,
/// `Liveness`, `QuasiLiveness`, `StableMarking`, `OneSafe`. `None` for any other.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::property::mcc::{Answer, answer, examination};
/// let net = philosophers(3).unwrap();
/// let model = Model::from(&net.view().net());
/// let asked = examination("ReachabilityDeadlock").unwrap();
/// assert_eq!(check(&model, &asked, &Options::default()).verdict, Verdict::Holds(true));
/// let line = answer(&asked.name, Answer::Verdict(true), &["EXPLICIT"]);
/// assert_eq!(line, "FORMULA ReachabilityDeadlock TRUE TECHNIQUES EXPLICIT");
/// ```
pub fn examination(name: &str) -> Option<Property> {
    let question = match name {
        "ReachabilityDeadlock" => {
            let deadlock = Formula::Atom(Atom::Deadlock);
            Question::Formula(Formula::Exists(Formula::Finally(deadlock.into()).into()))
        }
        "Liveness" => Question::Liveness,
        "QuasiLiveness" => Question::QuasiLiveness,
        "StableMarking" => Question::StableMarking,
        "OneSafe" => Question::OneSafe,
        _ => return None,
    };
    Some(Property { name: name.to_owned(), question })
}

/// The answer to a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The property holds, or not.
    Verdict(bool),
    /// The most tokens.
    Bound(u64),
    /// No answer.
    Unknown,
}

/// The line, without its end, that tells the contest the answer to a property, and how it was
/// found.
///
/// The name of the property is one [`word`] in it.
///
/// ```
/// use cotama_verification::property::mcc::{Answer, answer};
/// let line = answer("Query Comment/Name Here", Answer::Verdict(true), &["EXPLICIT"]);
/// assert_eq!(line, r"FORMULA Query\u{20}Comment/Name\u{20}Here TRUE TECHNIQUES EXPLICIT");
/// ```
pub fn answer(property: &str, answer: Answer, techniques: &[&str]) -> String {
    let (property, techniques) = (word(property), techniques.join(" "));
    match answer {
        Answer::Verdict(true) => format!("FORMULA {property} TRUE TECHNIQUES {techniques}"),
        Answer::Verdict(false) => format!("FORMULA {property} FALSE TECHNIQUES {techniques}"),
        Answer::Bound(bound) => format!("FORMULA {property} {bound} TECHNIQUES {techniques}"),
        Answer::Unknown => format!("FORMULA {property} CANNOT_COMPUTE"),
    }
}

/// A name as the one word that stands for it in a line of an answer: in place of blanks and of what
/// is obeyed or hidden stand codes, as `\u{20}`.
pub fn word(name: &str) -> String {
    let coded = marked(name).fold(String::new(), |mut text, (c, hidden)| {
        if hidden || c.is_whitespace() || c == '\\' {
            text.extend(c.escape_unicode());
        } else {
            text.push(c);
        }
        text
    });
    if coded.is_empty() { "\\u{}".to_owned() } else { coded }
}

struct File<'a> {
    xml: Xml<'a>,
    names: Names<'a>,
    depth: usize,
    /// Whether a quantifier is around.
    quantified: bool,
    /// How many parts equivalences may still add.
    parts: usize,
}

impl<'a> File<'a> {
    fn properties(&mut self) -> Result<Vec<Property>, Fault> {
        match self.xml.child()? {
            Some(set) if set.name == "property-set" => {}
            Some(other) => {
                return Err(Fault::new(
                    other.span.clone(),
                    format!(
                        "the file is one of \
                    {}",
                        other.shown()
                    ),
                )
                .help(
                    "a property file of the Model Checking Contest has one `<property-set>` \
                        element",
                ));
            }
            None => return Ok(Vec::new()),
        }
        let mut properties = Vec::new();
        while let Some(element) = self.xml.child()? {
            if element.name != "property" {
                return Err(unexpected(&element, "a `<property>`"));
            }
            let property = self.property(&element, properties.len() + 1)?;
            properties.push(property);
        }
        self.xml.child()?; // finds what stands after the element of the file
        Property::tell_apart(&mut properties);
        Ok(properties)
    }

    /// The property of this number in the file.
    fn property(&mut self, property: &Element<'a>, number: usize) -> Result<Property, Fault> {
        let (mut name, mut question) = (None, None);
        while let Some(element) = self.xml.child()? {
            match element.name {
                "id" if name.is_none() => {
                    let (id, _) = self.xml.text()?;
                    name = Some(if id.is_empty() { format!("property-{number}") } else { id });
                }
                "formula" if question.is_none() => question = Some(self.question(&element)?),
                "id" | "formula" => return Err(unexpected(&element, "one of each")),
                _ => self.xml.skip()?,
            }
        }
        let missing = |what: &str| {
            Fault::new(property.span.clone(), format!("a property without `<{what}>`"))
                .help("it has an `<id>` and a `<formula>`")
        };
        let name = name.ok_or_else(|| missing("id"))?;
        Ok(Property { name, question: question.ok_or_else(|| missing("formula"))? })
    }

    fn question(&mut self, formula: &Element<'a>) -> Result<Question, Fault> {
        let element = self.first(formula, "a formula")?;
        let question = if element.name == "place-bound" {
            let places = self.list(&element, "place", Names::place)?;
            let mut seen = HashSet::new();
            if !places.iter().all(|place| seen.insert(*place)) {
                return Err(Fault::new(element.span, "a place stands twice in one sum")
                    .help("name it once"));
            }
            Question::Bound(places)
        } else {
            Question::Formula(self.formula(&element)?)
        };
        self.close("one formula")?;
        Ok(question)
    }

    /// The first element inside of another one.
    fn first(&mut self, of: &Element<'a>, expected: &str) -> Result<Element<'a>, Fault> {
        self.xml.child()?.ok_or_else(|| {
            Fault::new(of.span.clone(), format!("{} is empty", of.shown()))
                .help(format!("{expected} is expected in it"))
        })
    }

    /// Finds that nothing follows in the element that is open.
    fn close(&mut self, expected: &str) -> Result<(), Fault> {
        self.xml.child()?.map_or(Ok(()), |more| Err(unexpected(&more, expected)))
    }

    /// The nodes that an element names.
    fn list<T>(
        &mut self,
        of: &Element<'a>,
        kind: &str,
        find: impl Fn(&Names<'a>, &str, Range<usize>) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let mut all = Vec::new();
        while let Some(element) = self.xml.child()? {
            if element.name != kind {
                return Err(unexpected(&element, &format!("a `<{kind}>`")));
            }
            let (name, span) = self.xml.text()?;
            all.push(find(&self.names, &name, span)?);
        }
        if all.is_empty() {
            let fault = Fault::new(of.span.clone(), format!("{} names nothing", of.shown()));
            return Err(fault.help(format!("a `<{kind}>` is expected in it")));
        }
        Ok(all)
    }

    /// Goes one level deeper.
    fn deeper(&mut self, element: &Element<'a>) -> Result<(), Fault> {
        if self.depth == MAX_DEPTH {
            let message = format!("formulas are nested more than {MAX_DEPTH} deep");
            let fault = Fault::new(element.span.clone(), message);
            return Err(fault.help("the file is damaged or made to do harm"));
        }
        self.depth += 1;
        Ok(())
    }

    /// The formula that an element is, up to its end.
    fn formula(&mut self, element: &Element<'a>) -> Result<Formula, Fault> {
        self.deeper(element)?;
        let formula = self.operator(element);
        self.depth -= 1;
        formula
    }

    fn operator(&mut self, element: &Element<'a>) -> Result<Formula, Fault> {
        if matches!(element.name, "finally" | "globally" | "next" | "until") && !self.quantified {
            let message =
                format!("the temporal operator {} stands outside of a quantifier", element.shown());
            return Err(Fault::new(element.span.clone(), message)
                .help("put `<all-paths>` or `<exists-path>` around it"));
        }
        Ok(match element.name {
            "all-paths" | "exists-path" => {
                let outer = std::mem::replace(&mut self.quantified, true);
                let path = self.only(element)?;
                self.quantified = outer;
                if element.name == "all-paths" { Formula::All(path) } else { Formula::Exists(path) }
            }
            "finally" => Formula::Finally(self.only(element)?),
            "globally" => Formula::Globally(self.only(element)?),
            "next" => Formula::Next(self.only(element)?),
            "negation" => Formula::Not(self.only(element)?),
            "until" => {
                let before = self.side(element, "before")?;
                let reach = self.side(element, "reach")?;
                self.close("nothing after `<reach>`")?;
                Formula::Until(before, reach)
            }
            "conjunction" => several(self.all(element)?, Formula::And),
            "disjunction" => several(self.all(element)?, Formula::Or),
            "implication" => {
                let [a, b] = self.two(element)?;
                Formula::Or(vec![Formula::Not(a.into()), b])
            }
            "equivalence" | "exclusive-disjunction" => {
                let [a, b] = self.two(element)?;
                let same = Formula::equivalence(a, b, &mut self.parts).ok_or_else(|| {
                    Fault::new(
                        element.span.clone(),
                        "the file is too long when its equivalences are written out",
                    )
                    .help("split it")
                })?;
                if element.name == "equivalence" { same } else { Formula::Not(same.into()) }
            }
            "true" | "false" | "deadlock" => {
                self.close("nothing")?;
                match element.name {
                    "true" => Formula::TRUE,
                    "false" => Formula::FALSE,
                    _ => Formula::Atom(Atom::Deadlock),
                }
            }
            "is-fireable" => {
                let transitions = self.list(element, "transition", Names::transition)?;
                Formula::Atom(Atom::Fireable(transitions))
            }
            "integer-le" => self.compared(element, Comparison::AtMost)?,
            "integer-lt" => self.compared(element, Comparison::Less)?,
            "integer-ge" => self.compared(element, Comparison::AtLeast)?,
            "integer-gt" => self.compared(element, Comparison::Greater)?,
            "integer-eq" => self.compared(element, Comparison::Equal)?,
            "integer-ne" => self.compared(element, Comparison::Unequal)?,
            _ => return Err(unexpected(element, "a formula")),
        })
    }

    fn only(&mut self, of: &Element<'a>) -> Result<Box<Formula>, Fault> {
        let element = self.first(of, "a formula")?;
        let formula = self.formula(&element)?;
        self.close("one formula")?;
        Ok(formula.into())
    }

    fn all(&mut self, of: &Element<'a>) -> Result<Vec<Formula>, Fault> {
        let first = self.first(of, "a formula")?;
        let mut all = vec![self.formula(&first)?];
        while let Some(element) = self.xml.child()? {
            all.push(self.formula(&element)?);
        }
        Ok(all)
    }

    fn two(&mut self, of: &Element<'a>) -> Result<[Formula; 2], Fault> {
        <[Formula; 2]>::try_from(self.all(of)?).map_err(|all| {
            Fault::new(of.span.clone(), format!("{} of {} formulas", of.shown(), all.len()))
                .help("it has two")
        })
    }

    fn side(&mut self, of: &Element<'a>, name: &str) -> Result<Box<Formula>, Fault> {
        let side = self.first(of, &format!("a `<{name}>`"))?;
        if side.name != name {
            return Err(unexpected(&side, &format!("a `<{name}>`")));
        }
        self.only(&side)
    }

    fn compared(&mut self, of: &Element<'a>, comparison: Comparison) -> Result<Formula, Fault> {
        let [left, right] = <[Sum; 2]>::try_from(self.numbers(of)?).map_err(|all| {
            Fault::new(of.span.clone(), format!("{} of {} numbers", of.shown(), all.len()))
                .help("it has two")
        })?;
        left.compare(comparison, &right).ok_or_else(|| too_large(of.span.clone()))
    }

    fn numbers(&mut self, of: &Element<'a>) -> Result<Vec<Sum>, Fault> {
        let first = self.first(of, "a number")?;
        let mut all = vec![self.number(&first)?];
        while let Some(element) = self.xml.child()? {
            all.push(self.number(&element)?);
        }
        Ok(all)
    }

    /// The number that an element is, up to its end.
    fn number(&mut self, element: &Element<'a>) -> Result<Sum, Fault> {
        self.deeper(element)?;
        let number = match element.name {
            "integer-constant" => {
                let (text, span) = self.xml.text()?;
                let number: Result<i64, _> = text.parse();
                number.map(|number| Sum::constant(i128::from(number))).map_err(|_| {
                    Fault::new(span, format!("{} is not a number", quoted(&text)))
                        .help(format!("the largest is {}", i64::MAX))
                })
            }
            "tokens-count" => {
                let places = self.list(element, "place", Names::place)?;
                let plus = |sum: Sum, place: PlaceId| sum.plus(1, &Sum::tokens(place));
                places
                    .into_iter()
                    .try_fold(Sum::default(), plus)
                    .ok_or_else(|| too_large(element.span.clone()))
            }
            "integer-sum" | "integer-difference" | "integer-product" => self.arithmetic(element),
            _ => Err(unexpected(element, "a number")),
        };
        self.depth -= 1;
        number
    }

    fn arithmetic(&mut self, element: &Element<'a>) -> Result<Sum, Fault> {
        let mut numbers = self.numbers(element)?.into_iter();
        let first = numbers.next().unwrap_or_default();
        numbers.try_fold(first, |sum, number| {
            let result = match element.name {
                "integer-sum" => sum.plus(1, &number),
                "integer-difference" => sum.plus(-1, &number),
                _ => sum.times(&number).map_err(|()| {
                    Fault::new(element.span.clone(), "a product of two numbers of tokens")
                        .help("one factor of a product is a constant")
                })?,
            };
            result.ok_or_else(|| too_large(element.span.clone()))
        })
    }
}

fn unexpected(element: &Element<'_>, expected: &str) -> Fault {
    let message = format!("the element {} is not expected here", element.shown());
    Fault::new(element.span.clone(), message).help(format!("{expected} is expected"))
}

fn several(mut all: Vec<Formula>, join: fn(Vec<Formula>) -> Formula) -> Formula {
    if all.len() == 1 { all.swap_remove(0) } else { join(all) }
}
